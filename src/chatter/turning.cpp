#include "turning.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "chatter/model/engagement.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/dual.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::chatter {
namespace {

using Enclosure = Dual<Interval, 1>;

/// Real and imaginary part.
template <class T>
struct Parts {
  T re, im;
};

class Loop {
 public:
  Loop(const Cutter& cutter, double n_rpm)
      : K_(std::get<ConstantForce>(cutter.system.force).K_MPa),
        tau_s_(period_s(cutter, n_rpm)),
        damping_(flank_damping_N_s_mm2(cutter, n_rpm)) {
    for (const Mode& m : cutter.system.modes)
      if (m.axis == Axis::x) modes_.push_back(m);
  }

  double tau_s() const { return tau_s_; }

  /// D(i omega) of (1).
  template <class T>
  Parts<T> at(const T& omega) const {
    using std::cos;
    using std::sin;
    Parts<T> G{T(0.0), T(0.0)};
    for (const Mode& m : modes_) {
      const double square = m.wn_rad_s * m.wn_rad_s;
      const T re = square - sqr(omega), im = 2 * m.zeta * m.wn_rad_s * omega;
      const T over = square / m.k_N_mm / (sqr(re) + sqr(im));
      G.re = G.re + re * over;
      G.im = G.im - im * over;
    }
    const T turned = tau_s_ * omega;
    const T re = K_ * (1 - cos(turned)), im = K_ * sin(turned) + damping_ * omega;
    return {G.re * re - G.im * im, G.re * im + G.im * re};
  }

  /// An angular frequency [rad/s] beyond which |D| stays below `least` [1/mm]; 0 if there
  /// are no modes.
  double reach(double least) const {
    double omega = 0;
    for (const Mode& m : modes_) omega = std::max(omega, m.wn_rad_s);
    const auto bound = [&] {
      double G = 0;
      for (const Mode& m : modes_)
        G += sqr(m.wn_rad_s) / m.k_N_mm / (sqr(omega) - sqr(m.wn_rad_s));
      return G * (2 * K_ + damping_ * omega);
    };
    if (omega == 0) return 0;
    do omega *= 2;
    while (bound() >= least);
    return omega;
  }

  /// Relative rounding error of D at a zero of Im D.
  double noise(double omega) const {
    constexpr double kEach = 4 * std::numeric_limits<double>::epsilon();
    const auto d = at(variable<double, 1>(omega, 0));
    const double turned = K_ * (2 + tau_s_ * omega) + damping_ * omega;
    double G = 0;
    for (const Mode& m : modes_)
      G += sqr(m.wn_rad_s) / m.k_N_mm /
           std::hypot(sqr(m.wn_rad_s) - sqr(omega), 2 * m.zeta * m.wn_rad_s * omega);
    return kEach * G * turned * (1 + std::abs(d.re.d[0] / d.im.d[0])) / std::abs(d.re.v);
  }

 private:
  std::vector<Mode> modes_;
  double K_, tau_s_, damping_;
};

/// A range of frequencies, and the signs of Im D at its ends.
struct Piece {
  Interval omega;
  bool from_below = false, to_above = false;
};

class FrequencySearch {
 public:
  FrequencySearch(const Loop& loop, double ap_max_mm)
      : loop_(loop), least_(1 / ap_max_mm) {
    const double reach = loop.reach(least_);
    left_.push_back({{0, reach}, is_above(0), is_above(reach)});
    for (long pieces = 0; !left_.empty(); ++pieces) {
      leave_if_asked();
      if (pieces > kMostPieces)
        throw TooManyVibrations(tr(
            "milling: a revolution holds too many vibrations; ask for a higher speed or "
            "a smaller depth"));
      const Piece piece = left_.back();
      left_.pop_back();
      settle(piece);
    }
    std::ranges::sort(found_, {}, &OnCircle::w_mm);
  }

  const std::vector<OnCircle>& found() const { return found_; }

 private:
  bool is_above(double omega) const { return loop_.at(omega).im >= 0; }

  void settle(const Piece& p) {
    const bool crosses = p.from_below != p.to_above;
    const double middle = mid(p.omega);
    const auto d = loop_.at(variable<Interval, 1>(p.omega, 0));
    if (d.re.v.lo > -least_) return;
    const bool smallest = !(p.omega.lo < middle && middle < p.omega.hi);
    if (smallest || d.im.d[0].lo > 0 || d.im.d[0].hi < 0) {
      if (crosses) enter(p);
      return;
    }
    if (!crosses && !may_be_zero(d.im, p.omega, middle)) return;
    const bool above = is_above(middle);
    left_.push_back({{middle, p.omega.hi}, above, p.to_above});
    left_.push_back({{p.omega.lo, middle}, p.from_below, above});
  }

  /// Enclosure of Im D, directly and by the mean value theorem.
  bool may_be_zero(const Enclosure& im, const Interval& omega, double middle) const {
    const Interval mean =
        Interval(loop_.at(middle).im) + im.d[0] * (omega - Interval(middle));
    return std::max(im.v.lo, mean.lo) <= 0 && std::min(im.v.hi, mean.hi) >= 0;
  }

  void enter(const Piece& p) {
    constexpr int kBits = 52;
    std::uintmax_t steps = 200;
    const auto [lo, hi] = boost::math::tools::toms748_solve(
        [&](double omega) { return loop_.at(omega).im; }, p.omega.lo, p.omega.hi,
        boost::math::tools::eps_tolerance<double>(kBits), steps);
    const double omega = std::midpoint(lo, hi), w = -1 / loop_.at(omega).re;
    if (!(w > 0 && w <= 1 / least_)) return;
    found_.push_back(
        {.w_mm = w,
         .theta = std::abs(std::remainder(omega * loop_.tau_s(), 2 * units::kPi)),
         .change = p.to_above ? 2 : -2,
         .relative_error = loop_.noise(omega),
         .frequency_Hz = omega / (2 * units::kPi)});
  }

  const Loop& loop_;
  double least_;  // least |D| that matters up to the largest depth
  std::vector<Piece> left_;
  std::vector<OnCircle> found_;
};

}  // namespace

std::vector<OnCircle> turning_on_circle(const Cutter& cutter, double n_rpm,
                                        double ap_max_mm) {
  const Loop loop(cutter, n_rpm);
  return FrequencySearch(loop, ap_max_mm).found();
}

}  // namespace turnwright::chatter
