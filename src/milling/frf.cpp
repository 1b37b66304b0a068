#include "turnwright/milling/frf.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "turnwright/base/cancelled.hpp"

namespace turnwright::milling {
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

/// The lines as rows: real parts, then imaginary ones.
class Lines {
 public:
  explicit Lines(const FrequencyResponse& r) : w_(r.w_rad_s), y_(2 * rows()) {
    for (Eigen::Index i = 0; i < rows(); ++i) {
      const Complex iw(0, w(i));
      gain_.push_back(r.derivative == 0 ? 1.0 : r.derivative == 1 ? iw : iw * iw);
      enter(i, r.value[static_cast<std::size_t>(i)], y_);
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

/// 1/k, c and b are linear: the best ones for the peaks' places.
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

/// Levenberg and Marquardt; what a last step changes is far below rounding or what is
/// left.
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

/// Where one more peak explains most of what is left, as far as small changes of those
/// there are cannot: the best places, apart from each other.
std::vector<Peak> places(const Lines& lines, const Model& m) {
  constexpr Eigen::Index kTried = 250;
  constexpr std::array kDamping{0.004, 0.02, 0.1};
  constexpr std::size_t kKept = 3;
  const MatrixXd J = lines.jacobian(m);
  const Normal normal(J);
  const VectorXd e = lines.left(m);
  std::vector<std::pair<double, Peak>> all;  // what it explains
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

/// What speaks against a fit: the first peak that does not stand.
std::optional<NoFit> fault(const Lines& lines, const Model& m) {
  constexpr double kHeavy = 0.5, kVague = 0.5;
  if (m.peaks.empty() || !std::isfinite(m.left)) return NoFit{Why::no_peak, 0};
  const VectorXd u = uncertainties(lines, m);
  Eigen::Index i = 0;
  for (const Peak& p : m.peaks) {
    const double wn = p.wn();
    if (!(wn >= lines.w(0) && wn <= lines.w(lines.rows() - 1) && p.zeta() < kHeavy))
      return NoFit{Why::no_peak, wn};
    if (!(p.a > 0)) return NoFit{Why::negative, wn};
    if (!(std::max({u[i], u[i + 1], u[i + 2] / p.a}) <= kVague))
      return NoFit{Why::not_told, wn};
    i += kColumns;
  }
  return std::nullopt;
}

/// Whether a mode of negative stiffness stands out.
bool stands_out(const Model& m) {
  constexpr double kShare = 0.05;
  double highest = 0, negative = 0;
  for (const Peak& p : m.peaks) {
    highest = std::max(highest, p.height());
    if (p.a < 0) negative = std::max(negative, p.height());
  }
  return negative > kShare * highest;
}

/// The line at which the modes' velocity is highest; its receptance lags behind the
/// force.
std::optional<NoFit> wrong_way(const FrequencyResponse& r) {
  std::size_t top = 0;
  const auto speed = [&](std::size_t i) {
    return std::abs(r.value[i]) * std::pow(r.w_rad_s[i], 1 - r.derivative);
  };
  for (std::size_t i = 1; i < r.w_rad_s.size(); ++i)
    if (speed(i) > speed(top)) top = i;
  const Complex H = r.value[top] / std::pow(Complex(0, r.w_rad_s[top]), r.derivative);
  if (H.imag() > 0.5 * std::abs(H)) return NoFit{Why::negative, r.w_rad_s[top]};
  return std::nullopt;
}

ModalFit described(const Lines& lines, Model m) {
  std::ranges::sort(m.peaks, {}, &Peak::ln_wn);
  const VectorXd u = uncertainties(lines, m), e = lines.left(m);
  ModalFit out;
  Eigen::Index i = 0;
  for (const Peak& p : m.peaks) {
    out.modes.push_back({.wn_rad_s = {p.wn(), p.wn() * u[i]},
                         .zeta = {p.zeta(), p.zeta() * u[i + 1]},
                         .k_N_mm = {1 / p.a, u[i + 2] / (p.a * p.a)}});
    i += kColumns;
  }
  out.above_mm_N = {m.c, u[i]};
  out.below_mm_N_s2 = {m.b, u[i + 1]};
  const auto L = static_cast<double>(lines.rows());
  const double all = lines.y().squaredNorm();
  out.explained = 1 - m.left / all;
  out.rms_measured = std::sqrt(all / L);
  out.rms_left = std::sqrt(m.left / L);
  double together = 0;
  for (Eigen::Index k = 0; k < e.size() - 1; ++k)
    if (k != lines.rows() - 1) together += e[k] * e[k + 1];
  out.correlation = m.left > 0 ? together / m.left : 0;
  return out;
}

/// Whether there are lines for so many modes.
bool enough(const Lines& lines, int modes) { return lines.rows() >= 3 * modes + 2; }

std::variant<ModalFit, NoFit> asked(const Lines& lines, int modes) {
  Model fewer, m = without_peaks(lines);
  for (int n = 0; n < modes; ++n) {
    if (nothing_left(lines, m)) return NoFit{n == 0 ? Why::no_peak : Why::not_told, 0};
    fewer = std::exchange(m, with_one_more(lines, m));
  }
  if (const auto why = fault(lines, m)) return *why;
  if (!(schwarz(lines, m) < schwarz(lines, fewer)))
    return NoFit{modes == 1 ? Why::no_peak : Why::not_told, m.peaks.back().wn()};
  return described(lines, std::move(m));
}

std::variant<ModalFit, NoFit> chosen(const Lines& lines) {
  Model m = without_peaks(lines);
  for (int n = 1; n <= kMostModes && enough(lines, n) && !nothing_left(lines, m); ++n) {
    Model next = with_one_more(lines, m);
    if (!(schwarz(lines, next) < schwarz(lines, m))) break;
    const auto why = fault(lines, next);
    if (why && (n == 1 || (why->why == Why::negative && stands_out(next)))) return *why;
    if (why) break;
    m = std::move(next);
  }
  if (m.peaks.empty()) return NoFit{Why::no_peak, 0};
  return described(lines, std::move(m));
}

}  // namespace

std::variant<ModalFit, NoFit> modal_fit(const FrequencyResponse& response,
                                        std::optional<int> modes) {
  const Lines lines(response);
  if (!enough(lines, modes.value_or(1))) return NoFit{Why::too_few_lines, 0};
  if (const auto why = wrong_way(response)) return *why;
  return modes ? asked(lines, *modes) : chosen(lines);
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

}  // namespace turnwright::milling
