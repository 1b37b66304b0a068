#pragma once
#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <span>
#include <vector>

#include "turnwright/deflection/beam.hpp"
#include "turnwright/deflection/rest.hpp"

/// An independent model of the same beam: Timoshenko elements between all segment ends
/// and load positions, assembled into a banded stiffness matrix and solved with 113 bits.
/// An element's stiffness is the inverse of its flexibility as a cantilever, integrated
/// over the section as it stands, 1/(re^4 - ri^4) and all; nothing is shared with Beam.
namespace turnwright::deflection::finite_elements {

using Real = boost::multiprecision::cpp_bin_float_quad;

struct Section {
  Real EI, GA_chi;
};

inline Section section(const part::Shaft& shaft, const Real& de, const Real& di) {
  const Real pi = boost::math::constants::pi<Real>(), E = shaft.E_MPa, nu = shaft.nu;
  const Real m2 = (di / de) * (di / de), n = (1 + m2) * (1 + m2);
  const Real chi = ((7 + 6 * nu) * n + (20 + 12 * nu) * m2) / (6 * (1 + nu) * n);
  const Real G = E / (2 * (1 + nu));
  return {E * pi * (de * de * de * de - di * di * di * di) / 64,
          G * pi * (de * de - di * di) / 4 / chi};
}

/// Stiffness of the element from x0 to x1 of a segment, order (w0, phi0, w1, phi1).
inline std::array<std::array<Real, 4>, 4> stiffness(const part::Shaft& shaft,
                                                    const part::Segment& s,
                                                    const Real& x0, const Real& x1) {
  const Real h = x1 - x0, length = s.length_mm;
  const auto at = [&](double left, double right, const Real& x) -> Real {
    return left + (Real(right) - left) * (x / length);
  };
  const bool cylinder =
      s.outer_left_mm == s.outer_right_mm && s.inner_left_mm == s.inner_right_mm;
  Real f11 = 0, f12 = 0, f22 = 0;  // the right end's, per force and couple there
  if (cylinder) {
    const auto [EI, GA] = section(shaft, s.outer_left_mm, s.inner_left_mm);
    f11 = h * h * h / (3 * EI) + h / GA;
    f12 = h * h / (2 * EI);
    f22 = h / EI;
  } else {
    // panels until the wall and the radius change by less than 5 % in each
    Real x = x0;
    while (x < x1) {
      const Real wall = at(s.outer_left_mm, s.outer_right_mm, x) -
                        at(s.inner_left_mm, s.inner_right_mm, x);
      const Real steepest = (abs(Real(s.outer_right_mm) - s.outer_left_mm) +
                             abs(Real(s.inner_right_mm) - s.inner_left_mm)) /
                            length;
      Real next = x + wall / steepest / 20;
      if (next > x1) next = x1;
      using boost::math::quadrature::gauss;
      const auto integrate = [&](auto weight) {
        return gauss<Real, 15>::integrate(weight, x, next);
      };
      const auto here = [&](const Real& y) {
        return section(shaft, at(s.outer_left_mm, s.outer_right_mm, y),
                       at(s.inner_left_mm, s.inner_right_mm, y));
      };
      f11 += integrate([&](const Real& y) -> Real {
        const Section c = here(y);
        return (x1 - y) * (x1 - y) / c.EI + 1 / c.GA_chi;
      });
      f12 += integrate([&](const Real& y) -> Real { return (x1 - y) / here(y).EI; });
      f22 += integrate([&](const Real& y) -> Real { return 1 / here(y).EI; });
      x = next;
    }
  }
  const Real det = f11 * f22 - f12 * f12;
  const Real k11 = f22 / det, k12 = -f12 / det, k22 = f11 / det;
  // the right end's motion beyond the rigid one of the left end: v = u1 - R u0
  std::array<std::array<Real, 4>, 2> B{{{-1, -h, 1, 0}, {0, -1, 0, 1}}};
  std::array<std::array<Real, 4>, 4> k;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      k[i][j] = B[0][i] * (k11 * B[0][j] + k12 * B[1][j]) +
                B[1][i] * (k12 * B[0][j] + k22 * B[1][j]);
  return k;
}

struct Solved {
  std::vector<Flexibility> flexibility;
  std::vector<double> deflection_per_couple;  ///< the other entry of Maxwell's pair
  std::vector<double> rest_per_N, rest_per_Nmm;
};

/// At rising positions in (0, L].  An elastic rest stands at one of them.
inline Solved solved(const part::Shaft& shaft, std::span<const double> a_mm,
                     const Supports& supports, const SteadyRest* rest = nullptr) {
  std::vector<std::array<std::array<Real, 4>, 4>> elements;
  std::vector<std::size_t> node_of;  // of each position
  Real z = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < shaft.segments.size(); ++i) {
    const part::Segment& s = shaft.segments[i];
    const bool last = i + 1 == shaft.segments.size();
    const Real end = z + s.length_mm;
    Real x = z;
    while (next < a_mm.size() && (a_mm[next] < end || last)) {
      const Real a = a_mm[next] < end ? Real(a_mm[next]) : end;
      if (a > x) elements.push_back(stiffness(shaft, s, x - z, a - z));
      node_of.push_back(elements.size());
      x = a;
      ++next;
    }
    if (x < end) elements.push_back(stiffness(shaft, s, x - z, s.length_mm));
    z = end;
  }

  // Banded matrix over all nodes; rigid supports are taken out with a unit diagonal.
  const std::size_t n = 2 * (elements.size() + 1);
  std::vector<std::array<Real, 4>> K(n);  // K[i][j]: row i, column i + j
  for (auto& row : K) row.fill(0);
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i; j < 4; ++j) K[2 * e + i][j - i] += elements[e][i][j];
  std::vector<bool> fixed(n, false);
  const auto spring = [&](std::size_t dof, double compliance) {
    if (compliance > 0)
      K[dof][0] += 1 / Real(compliance);
    else
      fixed[dof] = true;
  };
  if (supports.method == Method::between_centres) {
    spring(0, supports.head_mm_N);
  } else {
    const Real c0 = supports.root.c0_mm_N, c1 = supports.root.c1_rad_N,
               c2 = supports.root.c2_rad_Nmm;
    if (c2 > 0) {
      const Real det = c0 * c2 - c1 * c1;
      K[0][0] += c2 / det;
      K[0][1] -= c1 / det;
      K[1][0] += c0 / det;
    } else {
      spring(0, supports.root.c0_mm_N);
      fixed[1] = true;
    }
  }
  if (supports.method != Method::chuck) spring(n - 2, supports.tail_mm_N);
  std::size_t rest_dof = 0;
  if (rest) {
    const auto place = std::find(a_mm.begin(), a_mm.end(), rest->z_mm) - a_mm.begin();
    rest_dof = 2 * node_of.at(static_cast<std::size_t>(place));
    spring(rest_dof, rest->compliance_mm_N);
  }
  std::array<Real, 4> tail_row{};  // equations of the last two nodes' forces
  for (std::size_t j = 0; j < 4; ++j) tail_row[j] = elements.back()[2][j];
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < 4 && i + j < n; ++j)
      if (fixed[i] || fixed[i + j]) K[i][j] = i + j == i ? 1 : 0;

  for (std::size_t i = 0; i < n; ++i)  // L D L^T in place
    for (std::size_t j = 1; j < 4 && i + j < n; ++j) {
      const Real l = K[i][j] / K[i][0];
      for (std::size_t m = j; m < 4 && i + m < n; ++m) K[i + j][m - j] -= l * K[i][m];
    }
  const auto solve = [&](std::size_t dof) {
    std::vector<Real> u(n, 0);
    if (!fixed[dof]) u[dof] = 1;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 1; j < 4 && i + j < n; ++j)
        u[i + j] -= K[i][j] / K[i][0] * u[i];
    for (std::size_t i = n; i-- > 0;) {
      u[i] /= K[i][0];
      for (std::size_t j = 1; j < 4 && i + j < n; ++j)
        u[i] -= K[i][j] / K[i][0] * u[i + j];
    }
    return u;
  };
  // The tail's force against the load is what its spring, or the last element and the
  // load on the last node, leave over.
  const auto tail = [&](const std::vector<Real>& u, std::size_t dof) -> Real {
    if (supports.method == Method::chuck) return 0;
    if (supports.tail_mm_N > 0) return u[n - 2] / supports.tail_mm_N;
    Real force = dof == n - 2 ? 1 : 0;
    for (std::size_t j = 0; j < 4; ++j) force -= tail_row[j] * u[n - 4 + j];
    return force;
  };
  Solved out;
  for (const std::size_t node : node_of) {
    const auto force = solve(2 * node), couple = solve(2 * node + 1);
    out.flexibility.push_back({static_cast<double>(force[2 * node]),
                               static_cast<double>(force[2 * node + 1]),
                               static_cast<double>(couple[2 * node + 1]),
                               static_cast<double>(tail(force, 2 * node)),
                               static_cast<double>(tail(couple, 2 * node + 1))});
    out.deflection_per_couple.push_back(static_cast<double>(couple[2 * node]));
    if (rest) {
      const Real c = rest->compliance_mm_N;
      out.rest_per_N.push_back(static_cast<double>(Real(force[rest_dof] / c)));
      out.rest_per_Nmm.push_back(static_cast<double>(Real(couple[rest_dof] / c)));
    }
  }
  return out;
}

inline std::vector<Flexibility> flexibilities(const part::Shaft& shaft,
                                              std::span<const double> a_mm,
                                              const Supports& supports) {
  return solved(shaft, a_mm, supports).flexibility;
}

}  // namespace turnwright::deflection::finite_elements
