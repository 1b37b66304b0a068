#include "turnwright/chatter/frf.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "turnwright/base/cancelled.hpp"

namespace turnwright::chatter {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Why = NoFit::Why;

constexpr double kRounding = 1e-12;  // of |Y|
constexpr Eigen::Index kColumns = 3, kApart = 2;

/// Parameters of a mode: ln wn, ln zeta, 1/k.
struct Peak {
  double ln_wn = 0, ln_zeta = 0, a = 0;
  double wn() const { return std::exp(ln_wn); }
  double zeta() const { return std::exp(ln_zeta); }
  double height() const { return std::abs(a) / (2 * zeta()); }
};

struct Model {
  std::vector<Peak> peaks;
  double c = 0, b = 0;
  double left = std::numeric_limits<double>::infinity();  // sum |e|^2
};

/// Relative size of the errors at each line.
using Sizes = std::vector<double>;

/// Those given, or alike.
Sizes given(const FrequencyResponse& r) {
  return r.error.empty() ? Sizes(r.w_rad_s.size(), 1.0) : r.error;
}

/// The lines as rows: real parts, then imaginary parts, divided by the size of their
/// errors.
class Lines {
 public:
  Lines(const FrequencyResponse& r, const Sizes& sizes) : w_(r.w_rad_s), y_(2 * rows()) {
    for (Eigen::Index i = 0; i < rows(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Complex iw(0, w(i)), power = r.derivative == 0   ? 1.0
                                         : r.derivative == 1 ? iw
                                                             : iw * iw;
      gain_.push_back(power / sizes[at]);
      enter(i, r.value[at] / sizes[at], y_);
    }
  }

  Eigen::Index rows() const { return static_cast<Eigen::Index>(w_.size()); }
  double w(Eigen::Index i) const { return w_[static_cast<std::size_t>(i)]; }
  const VectorXd& y() const { return y_; }
  double numbers() const { return 2 * static_cast<double>(rows()); }

  /// Y of one unit of 1/k.
  VectorXd shape(double wn, double zeta) const {
    VectorXd out(2 * rows());
    for (Eigen::Index i = 0; i < rows(); ++i) enter(i, gain(i) / D(w(i) / wn, zeta), out);
    return out;
  }

  /// Derivatives of Y by the parameters: three of each peak, then c and b.
  MatrixXd jacobian(const Model& m) const {
    const auto n = static_cast<Eigen::Index>(m.peaks.size());
    MatrixXd J(2 * rows(), kColumns * n + kApart);
    for (Eigen::Index i = 0; i < rows(); ++i) {
      for (Eigen::Index k = 0; k < n; ++k) {
        const Peak& p = m.peaks[static_cast<std::size_t>(k)];
        const double x = w(i) / p.wn();
        const Complex d = D(x, p.zeta()), one = gain(i) / d, turn(0, 2 * p.zeta() * x);
        enter(i, -p.a * one / d * (2 * x * x - turn), J.col(kColumns * k));
        enter(i, -p.a * one / d * turn, J.col(kColumns * k + 1));
        enter(i, one, J.col(kColumns * k + 2));
      }
      enter(i, gain(i), J.col(kColumns * n));
      enter(i, -gain(i) / (w(i) * w(i)), J.col(kColumns * n + 1));
    }
    return J;
  }

  VectorXd left(const Model& m) const {
    VectorXd e = y_;
    for (Eigen::Index i = 0; i < rows(); ++i) {
      Complex H = m.c - m.b / (w(i) * w(i));
      for (const Peak& p : m.peaks) H += p.a / D(w(i) / p.wn(), p.zeta());
      e[i] -= (gain(i) * H).real();
      e[rows() + i] -= (gain(i) * H).imag();
    }
    return e;
  }

 private:
  static Complex D(double x, double zeta) { return {(1 - x) * (1 + x), 2 * zeta * x}; }
  Complex gain(Eigen::Index i) const { return gain_[static_cast<std::size_t>(i)]; }
  template <class Column>
  void enter(Eigen::Index i, Complex value, Column&& column) const {
    column[i] = value.real();
    column[rows() + i] = value.imag();
  }

  const std::vector<double>& w_;
  std::vector<Complex> gain_;
  VectorXd y_;
};

/// Normal equations with columns of length 1.
struct Normal {
  VectorXd scale;
  MatrixXd matrix;  // its lower half, which LDL^T takes
  explicit Normal(const MatrixXd& J) : scale(J.colwise().norm()) {
    for (double& s : scale) s = s > 0 ? 1 / s : 1;
    const MatrixXd unit = J * scale.asDiagonal();
    matrix = MatrixXd::Zero(J.cols(), J.cols());
    matrix.selfadjointView<Eigen::Lower>().rankUpdate(unit.transpose());
  }
  VectorXd step(const VectorXd& slope, double damping) const {
    const MatrixXd damped =
        matrix + damping * MatrixXd::Identity(matrix.rows(), matrix.cols());
    return scale.cwiseProduct(damped.ldlt().solve(scale.cwiseProduct(slope)));
  }
  MatrixXd inverse() const {
    const MatrixXd in =
        matrix.ldlt().solve(MatrixXd::Identity(matrix.rows(), matrix.cols()));
    return scale.asDiagonal() * in * scale.asDiagonal();
  }
};

Model moved(Model m, const VectorXd& step) {
  constexpr double kMost = 1;  // of a logarithm in one step
  Eigen::Index i = 0;
  for (Peak& p : m.peaks) {
    p.ln_wn += std::clamp(step[i++], -kMost, kMost);
    p.ln_zeta += std::clamp(step[i++], -kMost, kMost);
    p.a += step[i++];
  }
  m.c += step[i++];
  m.b += step[i];
  return m;
}

/// The best 1/k, c and b, which are linear, for given frequencies and damping ratios.
Model with_heights(const Lines& lines, Model m) {
  for (Peak& p : m.peaks) p.a = 0;
  m.c = m.b = 0;
  const MatrixXd J = lines.jacobian(m);
  const auto n = static_cast<Eigen::Index>(m.peaks.size());
  MatrixXd linear(J.rows(), n + kApart);
  for (Eigen::Index k = 0; k < n; ++k) linear.col(k) = J.col(kColumns * k + 2);
  linear.rightCols(kApart) = J.rightCols(kApart);
  const VectorXd x = Normal(linear).step(linear.transpose() * lines.y(), 1e-14);
  for (Eigen::Index k = 0; k < n; ++k) m.peaks[static_cast<std::size_t>(k)].a = x[k];
  m.c = x[n];
  m.b = x[n + 1];
  return m;
}

/// [Levenberg 1944], [Marquardt 1963]; the changes by the last step are far below
/// rounding or below the residual.
Model fitted(const Lines& lines, Model m, int steps) {
  constexpr double kSmall = 1e-14, kUnfelt = 1e-9, kStiff = 1e12;
  VectorXd e = lines.left(m);
  m.left = e.squaredNorm();
  double damping = 1e-3;
  for (int i = 0; i < steps && damping < kStiff; ++i) {
    const MatrixXd J = lines.jacobian(m);
    const Normal normal(J);
    const VectorXd slope = J.transpose() * e;
    bool small = false;
    for (; damping < kStiff; damping *= 8) {
      const VectorXd step = normal.step(slope, damping);
      Model next = moved(m, step);
      VectorXd left = lines.left(next);
      next.left = left.squaredNorm();
      if (!(next.left <= m.left)) continue;
      small = step.cwiseQuotient(normal.scale).norm() <=
              std::max(kSmall * lines.y().norm(), kUnfelt * std::sqrt(m.left));
      m = std::move(next);
      e = std::move(left);
      damping = std::max(damping / 16, 1e-16);
      break;
    }
    if (small) break;
  }
  return m;
}

Model without_peaks(const Lines& lines) {
  Model m = with_heights(lines, {});
  m.left = lines.left(m).squaredNorm();
  return m;
}

/// The best frequencies of one more peak, apart from each other: those where it explains
/// most of the residual that small changes of the present peaks cannot explain.
std::vector<Peak> places(const Lines& lines, const Model& m) {
  constexpr Eigen::Index kTried = 250;
  constexpr std::array kDamping{0.004, 0.02, 0.1};
  constexpr std::size_t kKept = 3;
  const MatrixXd J = lines.jacobian(m);
  const Normal normal(J);
  const VectorXd e = lines.left(m);
  std::vector<std::pair<double, Peak>> all;  // with the sum of squares it explains
  const Eigen::Index stride = 1 + lines.rows() / kTried;
  for (Eigen::Index i = 0; i < lines.rows(); i += stride) {
    std::pair<double, Peak> best;
    for (const double zeta : kDamping) {
      const VectorXd shape = lines.shape(lines.w(i), zeta), along = J.transpose() * shape;
      const double own = shape.squaredNorm() - along.dot(normal.step(along, 1e-12));
      const double part = shape.dot(e);
      if (own > 1e-9 * shape.squaredNorm() && part * part / own > best.first)
        best = {part * part / own, {std::log(lines.w(i)), std::log(zeta), 0}};
    }
    if (best.first > 0) all.push_back(best);
  }
  std::ranges::sort(all, std::ranges::greater(), &std::pair<double, Peak>::first);
  std::vector<Peak> out;
  for (const auto& [gain, p] : all) {
    const bool near = std::ranges::any_of(out, [&, &peak = p](const Peak& q) {
      return std::abs(q.ln_wn - peak.ln_wn) < 2 * std::max(q.zeta(), peak.zeta());
    });
    if (!near) out.push_back(p);
    if (out.size() == kKept) break;
  }
  return out;
}

/// The best fit with one more peak.
Model with_one_more(const Lines& lines, const Model& m) {
  leave_if_asked();
  std::vector<Model> starts;
  for (const Peak& p : places(lines, m)) {
    starts.push_back(m);
    starts.back().peaks.push_back(p);
  }
  for (std::size_t k = 0; k < m.peaks.size(); ++k) {
    Peak half = m.peaks[k];
    const double apart = half.zeta() / 2;
    half.ln_zeta -= std::log(2.0);
    starts.push_back(m);
    starts.back().peaks[k] = starts.back().peaks.emplace_back(half);
    starts.back().peaks[k].ln_wn -= apart;
    starts.back().peaks.back().ln_wn += apart;
  }
  constexpr int kFew = 8, kAll = 100;
  constexpr std::size_t kBest = 2;
  for (Model& start : starts) start = fitted(lines, with_heights(lines, start), kFew);
  std::ranges::sort(starts, {}, &Model::left);
  Model best;
  for (std::size_t i = 0; i < std::min(kBest, starts.size()); ++i)
    if (Model now = fitted(lines, starts[i], kAll); now.left < best.left)
      best = std::move(now);
  return best;
}

/// Standard uncertainties of the parameters.
VectorXd uncertainties(const Lines& lines, const Model& m) {
  const MatrixXd J = lines.jacobian(m);
  const double dof = static_cast<double>(J.rows() - J.cols());
  return (Normal(J).inverse().diagonal() * (m.left / dof)).cwiseMax(0).cwiseSqrt();
}

/// Eq. (2).
double schwarz(const Lines& lines, const Model& m) {
  const double n = lines.numbers(), p = 5 * static_cast<double>(m.peaks.size()) + 2;
  return n * std::log(m.left / n) + p * std::log(n);
}

bool nothing_left(const Lines& lines, const Model& m) {
  return m.left <= kRounding * kRounding * lines.y().squaredNorm();
}

double highest(const Model& m) {
  double out = 0;
  for (const Peak& p : m.peaks) out = std::max(out, p.height());
  return out;
}

/// Eq. (4), by octaves.
std::vector<HiddenMode> hidden_modes(const Lines& lines, const Model& m) {
  constexpr double kZeta = 0.01, kBeside = 2;
  constexpr Eigen::Index kTried = 500;
  const MatrixXd J = lines.jacobian(m);
  const Normal normal(J);
  const double sigma = std::sqrt(m.left / static_cast<double>(J.rows() - J.cols())),
               seen = (std::sqrt(5 * std::log(lines.numbers())) + 2) * sigma;
  std::vector<HiddenMode> out;
  double octave = 0;  // its end
  const Eigen::Index stride = 1 + lines.rows() / kTried;
  for (Eigen::Index i = 0; i < lines.rows(); i += stride) {
    const double wn = lines.w(i);
    const bool beside = std::ranges::any_of(m.peaks, [&](const Peak& p) {
      return std::abs(std::log(wn) - p.ln_wn) < kBeside * std::max(kZeta, p.zeta());
    });
    const VectorXd shape = lines.shape(wn, kZeta), along = J.transpose() * shape;
    const double own = shape.squaredNorm() - along.dot(normal.step(along, 1e-12));
    if (beside || !(own > 1e-9 * shape.squaredNorm()) || !(seen > 0)) continue;
    const double a = seen / std::sqrt(own);
    const HiddenMode here{wn, kZeta, 1 / a, a / (2 * kZeta) / highest(m)};
    if (wn > octave) {
      octave = 2 * wn;
      out.push_back(here);
    } else if (here.share > out.back().share) {
      out.back() = here;
    }
  }
  return out;
}

/// A mode without the damping A of the window on the time series.
struct Unwindowed {
  double wn = 0, zeta = 0, k_over = 1;  ///< k_over: stiffness over the windowed one
  Unwindowed(const Peak& p, double A) {
    const double a = p.zeta() * p.wn() - A, square = 1 - p.zeta() * p.zeta();
    wn = std::sqrt(p.wn() * p.wn() * square + a * a);
    zeta = a / wn;
    k_over = wn * wn / (p.wn() * p.wn());
  }
};

/// The reason against a fit: its first invalid peak.
std::optional<NoFit> fault(const Lines& lines, const Model& m, double A) {
  constexpr double kHeavy = 0.5, kVague = 0.5;
  if (m.peaks.empty() || !std::isfinite(m.left)) return NoFit{Why::no_peak, 0};
  const VectorXd u = uncertainties(lines, m);
  Eigen::Index i = 0;
  for (const Peak& p : m.peaks) {
    const double wn = p.wn();
    if (!(wn >= lines.w(0) && wn <= lines.w(lines.rows() - 1) && p.zeta() < kHeavy))
      return NoFit{Why::no_peak, wn};
    if (!(p.a > 0)) return NoFit{Why::negative, wn};
    const double of_damping = u[i + 1] * p.zeta() * p.wn();
    if (!(std::max(u[i], u[i + 2] / p.a) <= kVague) ||
        !(of_damping <= kVague * (p.zeta() * p.wn() - A)))
      return NoFit{Why::not_told, wn};
    i += kColumns;
  }
  return std::nullopt;
}

/// Whether a mode of negative stiffness is significant: its model leaves a far smaller
/// residual than the model without it.
bool stands_out(const Model& m, const Model& without) {
  constexpr double kShare = 0.05, kLeft = 0.25;
  return m.left < kLeft * without.left &&
         std::ranges::any_of(m.peaks, [&](const Peak& p) {
           return p.a < 0 && p.height() > kShare * highest(m);
         });
}

/// Whether a peak is too low compared with the highest one to change a limit.
constexpr double kLow = 1e-3;

Model without_low_peaks(const Lines& lines, Model m) {
  const double least = kLow * highest(m);
  std::erase_if(m.peaks, [&](const Peak& p) { return p.height() < least; });
  m.left = lines.left(m).squaredNorm();
  return m;
}

/// At a driving point the structure absorbs power at every line, so the part of the
/// response in quadrature with the force has one sign.  Returns the line that contradicts
/// this most; the sum over the lines decides, so that noise at one line does not matter.
std::optional<NoFit> wrong_way(const FrequencyResponse& r) {
  constexpr std::array<Complex, 3> kTurn{Complex(1, 0), Complex(0, -1), Complex(-1, 0)};
  const Sizes size = given(r);
  double taken = 0, all = 0, worst = 0, at = 0;
  for (std::size_t i = 0; i < r.w_rad_s.size(); ++i) {
    const Complex H =
        r.value[i] / size[i] * kTurn[static_cast<std::size_t>(r.derivative)];
    taken -= H.imag() * std::abs(H.imag());
    all += H.imag() * H.imag();
    if (H.imag() > worst) worst = H.imag(), at = r.w_rad_s[i];
  }
  if (taken < -0.5 * all) return NoFit{Why::negative, at};
  return std::nullopt;
}

/// Sum of the squares of real and imaginary part, which are separate rows.
VectorXd squares(const VectorXd& y) {
  const Eigen::Index L = y.size() / 2;
  return y.head(L).cwiseAbs2() + y.tail(L).cwiseAbs2();
}

/// sum e_i e_(i+1) over sum e_i^2, for real and imaginary parts separately.
double correlation(const VectorXd& e) {
  double together = 0;
  for (Eigen::Index k = 0; k < e.size() - 1; ++k)
    if (k != e.size() / 2 - 1) together += e[k] * e[k + 1];
  const double all = e.squaredNorm();
  return all > 0 ? together / all : 0;
}

ModalFit described(const FrequencyResponse& r, const Lines& lines, Model m) {
  std::ranges::sort(m.peaks, {}, &Peak::ln_wn);
  const VectorXd u = uncertainties(lines, m);
  ModalFit out;
  Eigen::Index i = 0;
  for (const Peak& p : m.peaks) {
    const Unwindowed mode(p, r.decay_1_s);
    const double shift = p.wn() / mode.wn;
    out.modes.push_back(
        {.wn_rad_s = {mode.wn, p.wn() * u[i]},
         .zeta = {mode.zeta, shift * p.zeta() * u[i + 1]},
         .k_N_mm = {mode.k_over / p.a, mode.k_over * u[i + 2] / (p.a * p.a)}});
    i += kColumns;
  }
  out.above_mm_N = {m.c, u[i]};
  out.below_mm_N_s2 = {m.b, u[i + 1]};
  const Lines even(r, given(r));
  const auto L = static_cast<double>(lines.rows());
  const double all = even.y().squaredNorm(), left = even.left(m).squaredNorm();
  out.explained = 1 - left / all;
  out.rms_measured = std::sqrt(all / L);
  out.rms_left = std::sqrt(left / L);
  out.correlation = correlation(lines.left(m));
  out.hidden = hidden_modes(lines, m);
  return out;
}

/// Whether there are enough lines for a number of modes.
bool enough(const Lines& lines, int modes) { return lines.rows() >= 3 * modes + 2; }

struct Choice {
  Model model;
  std::optional<NoFit> no;  // the reason against it
};

Choice asked(const Lines& lines, int modes, double A) {
  Model fewer, m = without_peaks(lines);
  for (int n = 0; n < modes; ++n) {
    if (nothing_left(lines, m)) return {m, NoFit{n == 0 ? Why::no_peak : Why::not_told}};
    fewer = std::exchange(m, with_one_more(lines, m));
  }
  if (const auto why = fault(lines, m, A)) return {m, why};
  const auto lowest = std::ranges::min_element(m.peaks, {}, &Peak::height);
  if (!(lowest->height() >= kLow * highest(m)))
    return {m, NoFit{Why::not_told, lowest->wn()}};
  if (!(schwarz(lines, m) < schwarz(lines, fewer)))
    return {m, NoFit{modes == 1 ? Why::no_peak : Why::not_told, m.peaks.back().wn()}};
  return {m, {}};
}

/// Continues past an invalid model, because modes that are still missing may cause that.
Choice chosen(const Lines& lines, double A) {
  constexpr std::size_t kAhead = 3;
  Model best = without_peaks(lines), m = best;
  std::optional<NoFit> first;  // the reason against the first invalid model
  for (int n = 1; n <= kMostModes && enough(lines, n) && !nothing_left(lines, m) &&
                  m.peaks.size() < best.peaks.size() + kAhead;
       ++n) {
    Model next = with_one_more(lines, m);
    if (!(schwarz(lines, next) < schwarz(lines, m))) break;
    m = std::move(next);
    const auto why = fault(lines, m, A);
    if (!why) best = m;
    if (why && !first) first = why;
  }
  if (best.peaks.empty()) return {m, first.value_or(NoFit{Why::no_peak})};
  if (stands_out(m, best)) {
    const auto negative = std::ranges::min_element(m.peaks, {}, &Peak::a);
    return {m, NoFit{Why::negative, negative->wn()}};
  }
  return {without_low_peaks(lines, std::move(best)), {}};
}

/// Eq. (3), with the floor for which the residuals are likeliest; none if equal errors
/// are not clearly less likely.
std::optional<double> error_floor(const FrequencyResponse& r, const Model& m) {
  const Lines lines(r, given(r));
  const VectorXd e = lines.left(m), left = squares(e), fit = squares(lines.y() - e);
  const double n = lines.numbers(), top = fit.maxCoeff();
  std::optional<double> best;
  double least = n * std::log(e.squaredNorm() / n) - 5 * std::log(n);
  for (const double floor : {0.1, 0.03, 0.01, 0.003, 0.001}) {
    const Eigen::ArrayXd variance = fit.array() / top + floor * floor;
    const double now =
        n * std::log((left.array() / variance).sum() / n) + 2 * variance.log().sum();
    if (now < least) {
      least = now;
      best = floor;
    }
  }
  return best;
}

Sizes sizes(const FrequencyResponse& r, const Model& m, double floor) {
  const Lines lines(r, given(r));
  const VectorXd fit = squares(lines.y() - lines.left(m));
  Sizes out;
  for (const double square : fit)
    out.push_back(std::sqrt(square / fit.maxCoeff() + floor * floor));
  return out;
}

/// A fit with equal errors, repeated with errors estimated from its residuals until their
/// floor does not change.
std::variant<ModalFit, NoFit> best_fit(const FrequencyResponse& r,
                                       std::optional<int> modes) {
  constexpr int kRounds = 3;
  Sizes errors = given(r);
  std::optional<double> floor;
  for (int round = 1;; ++round) {
    const Lines lines(r, errors);
    const double A = r.decay_1_s;
    Choice choice = modes ? asked(lines, *modes, A) : chosen(lines, A);
    const bool known = !r.error.empty() || nothing_left(lines, choice.model);
    const auto next = known ? floor : error_floor(r, choice.model);
    if (round == kRounds || next == floor) {
      if (choice.no) return *choice.no;
      ModalFit out = described(r, lines, std::move(choice.model));
      out.error_floor = floor;
      return out;
    }
    floor = next;
    errors = floor ? sizes(r, choice.model, *floor) : given(r);
  }
}

/// The residual sum of squares of a response taken for another derivative.
double left_as(FrequencyResponse r, int derivative) {
  r.derivative = derivative;
  const Lines lines(r, given(r));
  if (wrong_way(r)) return lines.y().squaredNorm();
  const Choice choice = chosen(lines, r.decay_1_s);
  return choice.no ? lines.y().squaredNorm() : choice.model.left;
}

/// The derivative with a far smaller residual than `left`, if there is one.
std::optional<NoFit> other_quantity(const FrequencyResponse& r, double left) {
  constexpr double kFarLess = 0.1;
  std::optional<NoFit> out;
  for (const int derivative : {0, 1, 2}) {
    if (derivative == r.derivative) continue;
    const double as = left_as(r, derivative);
    if (!(as < kFarLess * left)) continue;
    left = as / kFarLess;
    out = NoFit{Why::other_quantity, 0, derivative};
  }
  return out;
}

/// The explanation of a response whose motion leads the force: another quantity, or the
/// opposite sign.
NoFit turned(const FrequencyResponse& r, const NoFit& negative) {
  FrequencyResponse other = r;
  for (Complex& y : other.value) y = -y;
  return other_quantity(r, left_as(other, r.derivative)).value_or(negative);
}

}  // namespace

std::variant<ModalFit, NoFit> modal_fit(const FrequencyResponse& response,
                                        std::optional<int> modes) {
  constexpr double kDoubtful = 0.98;  // of the squares explained
  const auto lines = static_cast<int>(response.w_rad_s.size());
  if (lines < 3 * modes.value_or(1) + 2) return NoFit{Why::too_few_lines};
  if (const auto why = wrong_way(response)) return turned(response, *why);
  const auto out = best_fit(response, modes);
  const auto* fit = std::get_if<ModalFit>(&out);
  if (fit && fit->explained > kDoubtful) return out;
  const double left = fit ? lines * fit->rms_left * fit->rms_left
                          : left_as(response, response.derivative);
  if (const auto why = other_quantity(response, left)) return *why;
  return out;
}

Complex receptance_mm_N(const ModalFit& fit, double w) {
  Complex H = fit.above_mm_N.value - fit.below_mm_N_s2.value / (w * w);
  for (const FittedMode& m : fit.modes) {
    const double x = w / m.wn_rad_s.value;
    H +=
        1 / m.k_N_mm.value / Complex((1 - x) * (1 + x), 2 * m.zeta.value * x);  // Eq. (1)
  }
  return H;
}

}  // namespace turnwright::chatter
