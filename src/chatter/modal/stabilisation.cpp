// Departure from [Peeters 2004]: complex coefficients over the band alone, so that a band far
// from 0 needs no higher order than one near it.
#include "turnwright/chatter/stabilisation.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::chatter {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;
using Stable = DiagramPole::Stable;

constexpr int kHighestOrder = 40;
constexpr double kArc = 0.9;  // of the unit circle, filled by the lines
constexpr double kSameFrequency = 0.01, kSameDamping = 0.05, kSameCompliance = 0.1;
constexpr int kSettled = 3, kUnfitted = 5;  // orders in a row

/// z of a frequency, and back.
class UnitCircle {
 public:
  explicit UnitCircle(const FrequencyResponse& r)
      : from_(r.w_rad_s.front()),
        T_(2 * units::kPi * kArc / (r.w_rad_s.back() - r.w_rad_s.front())) {}
  double T() const { return T_; }
  Complex z(double w) const { return std::polar(1.0, (w - from_) * T_); }
  Complex s(Complex z) const {
    double turn = std::arg(z);
    if (turn < -units::kPi * (1 - kArc)) turn += 2 * units::kPi;
    return {std::log(std::abs(z)) / T_, from_ + turn / T_};  // Eq. (3)
  }

 private:
  double from_, T_;
};

/// The normal equations of the highest order.
struct NormalBlocks {
  MatrixXcd PP, PQ, QQ;
  NormalBlocks(const FrequencyResponse& r, const UnitCircle& circle, int order) {
    MatrixXcd P(static_cast<Eigen::Index>(r.value.size()), order + 1), Q = P;
    for (Eigen::Index i = 0; i < P.rows(); ++i) {
      const auto line = static_cast<std::size_t>(i);
      const Complex z = circle.z(r.w_rad_s[line]);
      P(i, 0) = r.error.empty() ? 1 : 1 / r.error[line];
      for (Eigen::Index j = 0; j < order; ++j) P(i, j + 1) = P(i, j) * z;
      Q.row(i) = -r.value[line] * P.row(i);
    }
    PP = P.adjoint() * P;
    PQ = P.adjoint() * Q;
    QQ = Q.adjoint() * Q;
  }
};

/// A and B of (1), the lowest power first.
struct Fraction {
  VectorXcd a, b;
};

Fraction fraction(const NormalBlocks& all, int order) {
  const Eigen::Index m = order + 1;
  const MatrixXcd PQ = all.PQ.topLeftCorner(m, m);
  const Eigen::LDLT<MatrixXcd> PP(all.PP.topLeftCorner(m, m));
  const MatrixXcd M = all.QQ.topLeftCorner(m, m) - PQ.adjoint() * PP.solve(PQ);  // (2)
  Fraction out;
  out.a = VectorXcd::Ones(m);
  out.a.tail(order) =
      M.bottomRightCorner(order, order).ldlt().solve(-M.col(0).tail(order));
  out.b = -PP.solve(PQ * out.a);
  return out;
}

/// The value of a polynomial and its derivative.
std::pair<Complex, Complex> horner(const VectorXcd& c, Complex z) {
  Complex value = 0, slope = 0;
  for (Eigen::Index j = c.size() - 1; j >= 0; --j) {
    slope = slope * z + value;
    value = value * z + c[j];
  }
  return {value, slope};
}

/// The roots of a polynomial; none where rounding leaves no polynomial.
std::vector<Complex> roots(const VectorXcd& c) {
  const Eigen::Index n = c.size() - 1;
  const VectorXcd last = -c.head(n) / c[n];
  if (!last.allFinite()) return {};
  MatrixXcd companion = MatrixXcd::Zero(n, n);
  companion.diagonal(-1).setOnes();
  companion.col(n - 1) = last;
  const VectorXcd all = companion.eigenvalues();
  return {all.begin(), all.end()};
}

/// The damped poles in the band, Eq. (3).
std::vector<DiagramPole> poles(const Fraction& f, const FrequencyResponse& r,
                               const UnitCircle& circle) {
  std::vector<DiagramPole> out;
  for (const Complex& z : roots(f.a)) {
    const Complex measured = circle.s(z), s = measured + r.decay_1_s;
    const double wn = std::abs(s);
    if (!(s.real() < 0 && s.imag() >= r.w_rad_s.front() && s.imag() <= r.w_rad_s.back()))
      continue;
    const Complex residue =
        horner(f.b, z).first / (horner(f.a, z).second * circle.T() * z);
    const Complex compliance =
        Complex(0, 2 * s.imag()) * residue / (std::pow(measured, r.derivative) * wn * wn);
    out.push_back(
        {.wn_rad_s = wn, .zeta = -s.real() / wn, .compliance_mm_N = compliance});
  }
  std::ranges::sort(out, {}, &DiagramPole::wn_rad_s);
  return out;
}

double apart(double a, double b) { return std::abs(std::log(a / b)); }

/// Compares the poles of an order with those of the order below.
void mark_stable(const std::vector<DiagramPole>& below, std::vector<DiagramPole>& poles) {
  if (below.empty()) return;
  for (DiagramPole& p : poles) {
    const DiagramPole& q = *std::ranges::min_element(
        below, {}, [&](const DiagramPole& b) { return apart(b.wn_rad_s, p.wn_rad_s); });
    if (!(apart(q.wn_rad_s, p.wn_rad_s) <= kSameFrequency)) continue;
    p.stable = Stable::frequency;
    if (!(std::abs(p.zeta - q.zeta) <= kSameDamping * q.zeta)) continue;
    p.stable = Stable::damping;
    if (!(std::abs(p.compliance_mm_N - q.compliance_mm_N) <=
          kSameCompliance * std::abs(q.compliance_mm_N)))
      continue;
    p.stable = Stable::all;
    p.in_a_row = q.in_a_row + 1;
  }
}

/// The root in the upper half plane, in units of another frequency.
Complex place(double wn, double zeta, double unit) {
  return wn / unit * Complex(-zeta, std::sqrt(1 - std::min(1.0, zeta * zeta)));
}

/// The fitted mode to which a pole belongs, if any: the nearest one, if its frequency is
/// within 1 % or half of its damping ratio.
std::optional<std::size_t> mode_of(const DiagramPole& p, const ModalFit& fit) {
  const auto nearest = std::ranges::min_element(fit.modes, {}, [&](const FittedMode& m) {
    return std::abs(place(p.wn_rad_s, p.zeta, p.wn_rad_s) -
                    place(m.wn_rad_s.value, m.zeta.value, p.wn_rad_s));
  });
  if (!(apart(nearest->wn_rad_s.value, p.wn_rad_s) <=
        std::max(kSameFrequency, nearest->zeta.value / 2)))
    return std::nullopt;
  return static_cast<std::size_t>(nearest - fit.modes.begin());
}

/// -min Re H of (4), at the flanks of every mode.
double most_negative(const std::vector<FittedMode>& modes) {
  constexpr int kSteps = 40;
  double least = 0;
  for (const FittedMode& flank : modes)
    for (int i = 1; i <= kSteps; ++i) {
      const double w = flank.wn_rad_s.value * std::sqrt(1 + 0.1 * i * flank.zeta.value);
      const ModalFit alone{.modes = modes,
                           .above_mm_N = {},
                           .below_mm_N_s2 = {},
                           .error_floor = {},
                           .hidden = {}};
      least = std::min(least, receptance_mm_N(alone, w).real());
    }
  return -least;
}

std::vector<SettledMode> settled(const ModalFit& fit,
                                 const std::vector<DiagramOrder>& orders) {
  std::vector<SettledMode> out(fit.modes.size());
  for (const DiagramOrder& o : orders) {
    std::vector<int> here(out.size(), 0);  // two stable poles may be of one mode
    for (const DiagramPole& p : o.poles) {
      const auto mode = p.stable == Stable::all ? mode_of(p, fit) : std::nullopt;
      if (!mode) continue;
      SettledMode& m = out[*mode];
      here[*mode] = 1;
      if (!m.from_order && p.in_a_row >= kSettled)
        m.from_order = o.order - p.in_a_row + 1;
    }
    for (std::size_t i = 0; i < out.size(); ++i) out[i].orders += here[i];
  }
  const double all = most_negative(fit.modes);
  for (std::size_t i = 0; i < out.size() && out.size() > 1; ++i) {
    auto others = fit.modes;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    out[i].depth_without = all / most_negative(others);
  }
  return out;
}

/// Whether a pole could be a mode that none of the fitted ones explains: compliant, and
/// apart from them by more than their half widths.
bool is_unfitted(const DiagramPole& p, const ModalFit& fit) {
  constexpr double kReal = 0.5;
  const double a = p.compliance_mm_N.real();
  return p.in_a_row >= kUnfitted && a > 0 &&
         std::abs(p.compliance_mm_N.imag()) <= kReal * a &&
         std::ranges::none_of(fit.modes, [&](const FittedMode& m) {
           return apart(m.wn_rad_s.value, p.wn_rad_s) <=
                  std::max({kSameFrequency, m.zeta.value, p.zeta});
         });
}

std::vector<UnfittedMode> unfitted(const ModalFit& fit,
                                   const std::vector<DiagramOrder>& orders) {
  std::vector<UnfittedMode> out;
  const double told = most_negative(fit.modes);
  for (const DiagramOrder& o : orders)
    for (const DiagramPole& p : o.poles) {
      if (!is_unfitted(p, fit)) continue;
      auto with = fit.modes;
      UnfittedMode m{.wn_rad_s = p.wn_rad_s,
                     .zeta = p.zeta,
                     .k_N_mm = 1 / p.compliance_mm_N.real(),
                     .from_order = o.order - p.in_a_row + 1,
                     .to_order = o.order};
      with.push_back({{m.wn_rad_s, 0}, {m.zeta, 0}, {m.k_N_mm, 0}});
      m.depth_with = told / most_negative(with);
      const auto same = std::ranges::find_if(out, [&](const UnfittedMode& u) {
        return apart(u.wn_rad_s, m.wn_rad_s) <= std::max(kSameFrequency, u.zeta);
      });
      if (same == out.end())
        out.push_back(m);
      else if (m.to_order - m.from_order >= same->to_order - same->from_order)
        *same = m;
    }
  std::ranges::sort(out, {}, &UnfittedMode::wn_rad_s);
  return out;
}

}  // namespace

Stabilisation stabilisation(const FrequencyResponse& response, const ModalFit& fit) {
  const int most = std::min(kHighestOrder, static_cast<int>(response.w_rad_s.size() / 3));
  const UnitCircle circle(response);
  const NormalBlocks all(response, circle, most);
  Stabilisation out;
  for (int n = 1; n <= most; ++n) {
    leave_if_asked();
    DiagramOrder o{.order = n, .poles = poles(fraction(all, n), response, circle)};
    if (n > 1) mark_stable(out.orders.back().poles, o.poles);
    out.orders.push_back(std::move(o));
  }
  out.modes = settled(fit, out.orders);
  out.unfitted = unfitted(fit, out.orders);
  return out;
}

}  // namespace turnwright::chatter
