// Crossings against the zero of the same determinant by an independent integration: the
// equation of motion without its delay, by Bulirsch and Stoer's extrapolation.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <random>

#include "chatter/fundamental_matrix/stability_crossings.hpp"
#include "cutters.hpp"
#include "turnwright/chatter/limits.hpp"

namespace turnwright::chatter {
namespace {

using Complex = std::complex<double>;
using State = std::vector<double>;  // of each mode: eta, eta'/wn, real and imaginary

/// u' of (1) and (2) of system.hpp with q(t - tau) = z q(t), kappa = w (1 - z), by the
/// angle of the spindle.
State slope(const System& s, double n_rpm, const Arc& arc, Complex kappa, const State& u,
            double angle) {
  const double seconds = 60 / (2 * units::kPi * n_rpm);
  const Directional h =
      arc.offsets_rad.empty() ? Directional{} : directional_MPa(s, n_rpm, arc, angle);
  std::array<Complex, 2> q{};
  const auto axis = [&](std::size_t i) {
    return s.modes[i].axis == Axis::x ? std::size_t{0} : std::size_t{1};
  };
  for (std::size_t i = 0; i < s.modes.size(); ++i)
    q[axis(i)] += Complex(u[4 * i], u[4 * i + 1]);
  const std::array<Complex, 2> force{-kappa * (h.xx * q[0] + h.xy * q[1]),
                                     -kappa * (h.yx * q[0] + h.yy * q[1])};
  State out(u.size());
  for (std::size_t i = 0; i < s.modes.size(); ++i) {
    const Mode& m = s.modes[i];
    const Complex x(u[4 * i], u[4 * i + 1]), v(u[4 * i + 2], u[4 * i + 3]);
    const Complex dx = m.wn_rad_s * v,
                  dv = m.wn_rad_s * (-x - 2 * m.zeta * v + force[axis(i)] / m.k_N_mm);
    out[4 * i] = seconds * dx.real();
    out[4 * i + 1] = seconds * dx.imag();
    out[4 * i + 2] = seconds * dv.real();
    out[4 * i + 3] = seconds * dv.imag();
  }
  return out;
}

/// det(I - z Phi) at |z| = 1, integrated column by column.
Complex determinant(const System& s, double n_rpm, double w, double theta) {
  namespace odeint = boost::numeric::odeint;
  const Complex z = std::polar(1.0, -theta), kappa = w * (1.0 - z);
  const auto m = static_cast<Eigen::Index>(2 * s.modes.size());
  Eigen::MatrixXcd a = Eigen::MatrixXcd::Identity(m, m);
  for (Eigen::Index column = 0; column < m; ++column) {
    State u(static_cast<std::size_t>(2 * m), 0.0);
    u[static_cast<std::size_t>(2 * column)] = 1;
    for (const Arc& arc : arcs(s)) {
      odeint::bulirsch_stoer<State> stepper(1e-14, 1e-13);
      odeint::integrate_adaptive(
          stepper,
          [&](const State& x, State& dx, double angle) {
            dx = slope(s, n_rpm, arc, kappa, x, angle);
          },
          u, arc.begin_rad, arc.end_rad, (arc.end_rad - arc.begin_rad) / 8);
    }
    for (Eigen::Index row = 0; row < m; ++row)
      a(row, column) -= z * Complex(u[static_cast<std::size_t>(2 * row)],
                                    u[static_cast<std::size_t>(2 * row) + 1]);
  }
  return a.determinant();
}

/// Newton's step from a crossing towards the zero of `determinant`, relative to its
/// depth.
double off(const System& s, double n_rpm, const Crossing& at) {
  constexpr double kStep = 1e-5;
  const auto g = [&](double w, double theta) { return determinant(s, n_rpm, w, theta); };
  const Complex here = g(at.ap_mm, at.theta_rad);
  const Complex by_w = (g(at.ap_mm * (1 + kStep), at.theta_rad) - here) / kStep;
  if (at.flip) return std::abs(here.real() / by_w.real());
  const Complex by_theta = (g(at.ap_mm, at.theta_rad + kStep) - here) / kStep;
  return std::abs(std::imag(std::conj(here) * by_theta) /
                  std::imag(std::conj(by_w) * by_theta));
}

/// Speeds looked at in each case; TURNWRIGHT_LONG_TESTS asks for 200.
int speeds() { return std::getenv("TURNWRIGHT_LONG_TESTS") ? 200 : 15; }

struct Case {
  System system;
  double deepest;
};

std::vector<Case> cases() {
  return {{benchmark(Directions::one, down_milling(0.1)), 6},
          {benchmark(Directions::one, down_milling(0.05)), 6},
          {benchmark(Directions::one, down_milling(1)), 2},
          {benchmark(Directions::two, down_milling(0.1)), 4},
          {benchmark(Directions::two, up_milling(0.3)), 1},
          {benchmark(Directions::two, down_milling(1)), 0.3},
          {many_modes(3, down_milling(0.1)), 1.5},
          {many_modes(4, up_milling(0.3)), 0.4},
          {slot_cutter(), 60}};
}

TEST(Accuracy, EveryCrossingIsWhereAnIndependentIntegrationHasIt) {
  std::mt19937 random(41);
  std::uniform_real_distribution<double> share(0, 1);
  for (const Case& c : cases()) {
    int crossings = 0;
    for (int i = 0; i < speeds(); ++i) {
      const double n = 5000 + 20000 * share(random);
      for (const Crossing& at : speed_limits(c.system, n, c.deepest).crossings) {
        ++crossings;
        EXPECT_LT(at.relative_error, 1e-8) << n;
        EXPECT_LT(off(c.system, n, at), 2e-10 + at.relative_error)
            << n << " " << at.ap_mm << " estimated " << at.relative_error;
      }
    }
    EXPECT_GT(crossings, speeds() / 4);
  }
}

// Stretches half as long with rounding-free nodes, searched anew about each crossing.
TEST(Accuracy, OverResolvedRunsFindTheSameCrossings) {
  constexpr Resolution kOver{2.5, 1e-22}, kFiner{2, 1e-23};
  std::mt19937 random(43);
  std::uniform_real_distribution<double> share(0, 1);
  double worst = 0;
  for (const Case& c : cases())
    for (int i = 0; i < speeds(); ++i) {
      const double n = 5000 + 20000 * share(random);
      const Characteristic over(c.system, n, kOver), finer(c.system, n, kFiner);
      for (const Crossing& at : speed_limits(c.system, n, c.deepest).crossings) {
        const auto found =
            on_circle(over, finer, at.ap_mm * (1 - 1e-6), at.ap_mm * (1 + 1e-6));
        ASSERT_EQ(found.size(), 1u) << n << " " << at.ap_mm;
        const double error = std::abs(found[0].w_mm / at.ap_mm - 1);
        EXPECT_LT(error, 1e-9) << n << " " << at.ap_mm;
        worst = std::max(worst, error);
      }
    }
  RecordProperty("worst", std::to_string(worst * 1e12) + "e-12");
}

}  // namespace
}  // namespace turnwright::chatter
