#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "turnwright/multipass/problem.hpp"

/// The problem a second time, straight from the literature's equations, for searches that
/// share nothing with the program but the request.
namespace turnwright::multipass {

using Five = std::array<double, 5>;  // ln Vr, ln fr, ln dr, ln Vs, ln fs

struct Oracle {
  Problem m;
  double n = 1;  ///< a whole number, but for solvers that relax it

  double ds(const Five& x) const { return m.dt_mm - n * std::exp(x[2]); }

  double cost(const Five& x) const {
    const double Vr = std::exp(x[0]), fr = std::exp(x[1]), dr = std::exp(x[2]);
    const double Vs = std::exp(x[3]), fs = std::exp(x[4]);
    const double tr = M_PI * m.D_mm * m.L_mm / (1000 * Vr * fr);
    const double ts = M_PI * m.D_mm * m.L_mm / (1000 * Vs * fs);
    const double Tr = life(Vr, fr, dr), Ts = life(Vs, fs, ds(x));
    const double used = m.cost == Cost::physical
                            ? n * tr / Tr + ts / Ts
                            : (n * tr + ts) / (m.theta * Tr + (1 - m.theta) * Ts);
    const double cutting = m.k0 * (n * tr + ts);
    const double idle = m.k0 * (m.tc + (n + 1) * (m.h1 * m.L_mm + m.h2));
    return cutting + idle + m.k0 * m.te * used + m.kt * used;
  }

  /// ln(value/limit) of every limit, nowhere positive where they are kept.
  void limits(const Five& x, std::vector<double>& out) const {
    const double Vr = std::exp(x[0]), fr = std::exp(x[1]), dr = std::exp(x[2]);
    const double Vs = std::exp(x[3]), fs = std::exp(x[4]);
    const double d_s = std::max(ds(x), 1e-12);  // far below any range
    out.clear();
    pass(Vr, fr, dr, out);
    pass(Vs, fs, d_s, out);
    at_most(fs * fs / (8 * m.R_mm), m.SRu_um / 1000, out);
    at_most(Vr, m.VrU.value_or(1e9), out);
    at_most(m.k3 * Vr, Vs, out);
    at_most(m.k4 * fs, fr, out);
    at_most(m.k5 * d_s, dr, out);
  }

  double worst(const Five& x) const {
    thread_local std::vector<double> all;
    limits(x, all);
    return *std::max_element(all.begin(), all.end());
  }

 private:
  static void at_most(double value, double limit, std::vector<double>& out) {
    // a factor of zero asks for nothing
    out.push_back(value > 0 ? std::log(value / limit) : -1e3);
  }
  static void within(double x, const Range& range, std::vector<double>& out) {
    at_most(x, range.upper, out);
    at_most(range.lower, x, out);
  }
  double life(double V, double f, double d) const {
    return m.C0 * std::pow(V, -m.p) * std::pow(f, -m.q) * std::pow(d, -m.r);
  }
  void pass(double V, double f, double d, std::vector<double>& out) const {
    within(V, m.V, out);
    within(f, m.f, out);
    within(d, m.d, out);
    within(life(V, f, d), m.T, out);
    const double F = m.kf * std::pow(f, m.mu) * std::pow(d, m.nu);
    at_most(F, m.FU, out);
    at_most(F * V / 6120 / m.eta, m.PU, out);
    at_most(m.SC, std::pow(V, m.lambda) * f * std::pow(d, m.nu2), out);
    at_most(m.kq * std::pow(V, m.tau) * std::pow(f, m.phi) * std::pow(d, m.delta), m.QU,
            out);
  }
};

inline Five point(const PassCount& c) {
  return {std::log(c.rough.V), std::log(c.rough.f), std::log(c.rough.d),
          std::log(c.finish.V), std::log(c.finish.f)};
}

/// The corners of V, f, d for five variables.
struct Span {
  Five lower, upper;
  bool empty() const { return !(lower[2] <= upper[2]); }
};
inline Span span(const Oracle& o) {
  const Problem& m = o.m;
  const double most = std::min(m.d.upper, m.dt_mm / o.n * (1 - 1e-9));
  return {{std::log(m.V.lower), std::log(m.f.lower), std::log(m.d.lower),
           std::log(m.V.lower), std::log(m.f.lower)},
          {std::log(m.V.upper), std::log(m.f.upper), std::log(most), std::log(m.V.upper),
           std::log(m.f.upper)}};
}

/// A problem with every constant drawn anew around the literature's; some are impossible.
inline Problem random_problem(std::mt19937& seed) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto between = [&](double a, double b) { return a + (b - a) * unit(seed); };
  const auto ratio = [&](double a, double b) { return a * std::pow(b / a, unit(seed)); };
  const auto perhaps = [&](double share) { return unit(seed) < share; };
  Problem m;
  m.cost = perhaps(0.6) ? Cost::literal : Cost::physical;
  m.D_mm = ratio(20, 200);
  m.L_mm = ratio(50, 800);
  m.dt_mm = between(2.5, 14);
  if (perhaps(0.5)) m.V = {ratio(5, 100), ratio(120, 600)};
  if (perhaps(0.5)) m.f = {ratio(0.02, 0.2), ratio(0.3, 1.5)};
  if (perhaps(0.5)) m.d = {ratio(0.2, 1.5), ratio(1.8, 5)};
  if (perhaps(0.6)) m.T = {ratio(2, 30), ratio(35, 400)};
  if (perhaps(0.1)) m.T = {30, 30};
  m.k0 = ratio(0.1, 2);
  m.kt = perhaps(0.1) ? 0 : ratio(0.2, 10);
  m.te = perhaps(0.1) ? 0 : ratio(0.3, 4);
  m.theta = perhaps(0.2) ? (perhaps(0.5) ? 0 : 1) : unit(seed);
  if (perhaps(0.4)) {
    m.p = between(2, 7);
    m.q = between(0.2, 4);
    m.r = between(-0.2, 2);
    m.C0 = 30 * std::pow(ratio(100, 200), m.p) * std::pow(0.4, m.q) * std::pow(2, m.r);
  }
  if (perhaps(0.3)) {
    m.mu = between(0.4, 1);
    m.nu = between(0.6, 1.2);
  }
  if (perhaps(0.5)) m.FU = ratio(120, 400);
  if (perhaps(0.5)) m.PU = ratio(2, 6);
  if (perhaps(0.5)) m.QU = ratio(850, 1000);
  if (perhaps(0.6)) {
    m.lambda = between(-1.5, 2.5);
    m.nu2 = between(-2, 2);
    m.SC = std::pow(120, m.lambda) * ratio(0.1, 0.3) * std::pow(2, m.nu2);
  }
  if (perhaps(0.3)) {
    m.tau = between(0.1, 0.8);
    m.phi = between(-0.2, 0.4);
    m.delta = between(0, 0.3);
    m.kq = 750 * std::pow(120, -m.tau);
  }
  if (perhaps(0.5)) m.SRu_um = ratio(3, 40);
  if (perhaps(0.5)) m.k3 = between(0, 1.6);
  if (perhaps(0.5)) m.k4 = between(0, 4);
  if (perhaps(0.5)) m.k5 = between(0, 1.5);
  if (perhaps(0.2)) m.VrU = ratio(60, 150);
  return m;
}

}  // namespace turnwright::multipass
