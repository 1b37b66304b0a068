#include "turnwright/multipass/problem.hpp"

#include <cmath>
#include <numbers>

namespace turnwright::multipass {

Load load(const Problem& m, const Pass& x) {
  Load l;
  l.T = m.C0 / (std::pow(x.V, m.p) * std::pow(x.f, m.q) * std::pow(x.d, m.r));  // (4)
  l.F = m.kf * std::pow(x.f, m.mu) * std::pow(x.d, m.nu);                       // (5)
  l.P = l.F * x.V / (6120 * m.eta);
  l.stability = std::pow(x.V, m.lambda) * x.f * std::pow(x.d, m.nu2);  // (6)
  l.Q = m.kq * std::pow(x.V, m.tau) * std::pow(x.f, m.phi) * std::pow(x.d, m.delta);
  return l;
}

double unit_cost(const Problem& m, int n, const Pass& rough, const Pass& finish) {
  const double K = std::numbers::pi * m.D_mm * m.L_mm / 1000;  // (2)
  const double tr = K / (rough.V * rough.f), ts = K / (finish.V * finish.f);
  const double t = n * tr + ts;
  const double Tr = load(m, rough).T, Ts = load(m, finish).T;
  const double N = m.cost == Cost::literal ? t / (m.theta * Tr + (1 - m.theta) * Ts)
                                           : n * tr / Tr + ts / Ts;  // (3)
  return m.k0 * t + m.k0 * (m.tc + (m.h1 * m.L_mm + m.h2) * (n + 1)) +
         (m.k0 * m.te + m.kt) * N;  // (1)
}

}  // namespace turnwright::multipass
