// Departures from [Ozoegwu 2013]: any number of modes, each with its own Hermite
// coefficients; integrals of h by Gauss quadrature between its kinks.
#include <Eigen/Dense>
#include <array>

#include "chatter/model/eigenvalues.hpp"
#include "chatter/model/quadrature.hpp"
#include "chatter/model/samples.hpp"
#include "turnwright/chatter/reference_methods.hpp"

namespace turnwright::chatter {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The trial functions of Eq. (6) or a derivative of them at x = theta / t_k.
std::array<double, 4> trial(double x, double t, int derivative) {
  if (derivative == 0)
    return {1 - x * x * (3 - 2 * x), x * (1 - x) * (1 - x) * t, x * x * (3 - 2 * x),
            x * x * (x - 1) * t};
  if (derivative == 1)
    return {6 * x * (x - 1) / t, (1 - x) * (1 - 3 * x), 6 * x * (1 - x) / t,
            x * (3 * x - 2)};
  return {(12 * x - 6) / (t * t), (6 * x - 4) / t, (6 - 12 * x) / (t * t),
          (6 * x - 2) / t};
}

double weight(int p, double x) { return p == 0 ? 1 : x - 0.5; }  // Eq. (9)

double factor(const Directional& h, Axis row, Axis column) {
  if (row == Axis::x) return column == Axis::x ? h.xx : h.xy;
  return column == Axis::x ? h.yx : h.yy;
}

}  // namespace

Dominant time_finite_elements(const System& system, double n_rpm, double ap_mm,
                              int elements) {
  const auto n = static_cast<Index>(system.modes.size()), node = 2 * n;
  const Index size = node * (elements + 1);
  const double t = period_s(system, n_rpm) / elements;
  const auto all_arcs = arcs(system);
  const Quadrature& rule = quadrature(4);  // exact for the polynomials of Eq. (15)

  MatrixXd P = MatrixXd::Zero(size, size), D = MatrixXd::Zero(size, size);
  P.topLeftCorner(node, node).setIdentity();  // Eq. (12): a_1 = a^tau of the last node
  D.topRightCorner(node, node).setIdentity();
  for (Index k = 0; k < elements; ++k) {
    const double begin = static_cast<double>(k) * t;
    // Rows: weight p of mode i; columns: a_1, a_2 of node k, a_3, a_4 of node k + 1.
    const auto row = [&](Index i, int p) { return node * (k + 1) + 2 * i + p; };
    const auto column = [&](Index j, int a) {
      return node * (k + a / 2) + 2 * j + a % 2;
    };
    for (Index i = 0; i < n; ++i) {  // Eq. (15) without h
      const Mode& m = system.modes[static_cast<std::size_t>(i)];
      for (std::size_t g = 0; g < rule.size; ++g) {
        const double x = rule.nodes[g];
        const auto f0 = trial(x, t, 0), f1 = trial(x, t, 1), f2 = trial(x, t, 2);
        for (int p = 0; p < 2; ++p)
          for (int a = 0; a < 4; ++a) {
            const auto b = static_cast<std::size_t>(a);
            P(row(i, p), column(i, a)) += t * rule.weights[g] * weight(p, x) *
                                          (f2[b] + 2 * m.zeta * m.wn_rad_s * f1[b] +
                                           m.wn_rad_s * m.wn_rad_s * f0[b]);
          }
      }
    }
    for (const Sample& s : samples(system, n_rpm, all_arcs, begin, begin + t)) {
      const double x = (s.t_s - begin) / t;
      const auto f0 = trial(x, t, 0);
      for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) {
          const Mode& to = system.modes[static_cast<std::size_t>(i)];
          const Mode& of = system.modes[static_cast<std::size_t>(j)];
          const double force = s.weight_s * ap_mm * factor(s.h, to.axis, of.axis) *
                               to.wn_rad_s * to.wn_rad_s / to.k_N_mm;
          for (int p = 0; p < 2; ++p)
            for (int a = 0; a < 4; ++a) {
              const double term = force * weight(p, x) * f0[static_cast<std::size_t>(a)];
              P(row(i, p), column(j, a)) += term;
              D(row(i, p), column(j, a)) += term;
            }
        }
    }
  }
  return dominant(P.partialPivLu().solve(D));  // Eq. (14)
}

}  // namespace turnwright::chatter
