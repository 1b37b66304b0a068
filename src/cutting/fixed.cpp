#include "turnwright/cutting/fixed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "turnwright/base/units.hpp"

namespace turnwright::cutting {

catalogue::Kienzle kienzle_at(const catalogue::Material& material, double gamma_deg) {
  const double K_gamma =
      std::clamp(1 - (gamma_deg - material.gamma0_deg) / 100, 0.7, 1.3);
  return {material.kc.k11_MPa * K_gamma, material.kc.m};
}

Load drill(const catalogue::Kienzle& k, double D, double f, double point_deg) {
  const double sine = std::sin(units::rad_from_deg(point_deg / 2));
  const double kc = k.k11_MPa * std::pow(f / 2 * sine, -k.m);  // Eq. (1)
  const double Fc = kc * f * D / 2;                            // Eq. (2)
  return {Fc, 0.5 * kc * f * D / 2 * sine, units::torque_Nm(Fc, D / 2)};
}

Load ream(const catalogue::Kienzle& k, double D, double d, double f, int edges,
          double lead_deg) {
  const double sine = std::sin(units::rad_from_deg(lead_deg)), a = (D - d) / 2;
  const double kc = k.k11_MPa * std::pow(f / edges * sine, -k.m);  // Eq. (7)
  const double Fc = kc * f * a;                                    // Eq. (8)
  return {Fc, 0.5 * Fc * sine, units::torque_Nm(Fc, (D + d) / 2)};
}

Load tap(const catalogue::Kienzle& k, double d, double P, double depth, double lead,
         int edges) {
  const double kc = k.k11_MPa * std::pow(depth / (lead * edges), -k.m);  // Eq. (9)
  const double Fc = kc * P * P / 4;
  return {Fc, 0, units::torque_Nm(Fc, d)};
}

double drill_point_mm(double D, double point_deg) {
  return D / 2 / std::tan(units::rad_from_deg(point_deg / 2));
}

std::vector<double> peck_depths_mm(const std::optional<catalogue::Pecking>& pecking,
                                   double D, double depth) {
  const double first = pecking ? pecking->first_diameters * D : depth;
  if (!(first < depth)) return {depth};
  const double steps = (depth - first) / (pecking->step_diameters * D);
  const int pecks = static_cast<int>(std::ceil(steps - 1e-9));  // Eq. (6)
  std::vector<double> all;
  for (int i = 0; i <= pecks; ++i) all.push_back(first + (depth - first) * i / pecks);
  return all;
}

Load plunge(const catalogue::Kienzle& k, const catalogue::Thrust& thrust, double b,
            double f, double D) {
  const double Fc = k.k11_MPa * b * std::pow(f, 1 - k.m);  // Eq. (3)
  return {Fc, thrust.ratio * Fc + thrust.edge_N_mm * b, units::torque_Nm(Fc, D)};
}

Load thread_infeed(const catalogue::Kienzle& k, const catalogue::Thrust& thrust,
                   double before, double a, double D) {
  const double half = units::rad_from_deg(30);
  const double A = std::tan(half) * (a * a - before * before);
  const double L = 2 * a / std::cos(half);
  const double Fc = k.k11_MPa * std::pow(L, k.m) * std::pow(A, 1 - k.m);  // Eq. (5)
  const double Ff = thrust.ratio * Fc + thrust.edge_N_mm * L * std::sin(half);
  return {Fc, Ff, units::torque_Nm(Fc, D)};
}

std::vector<Infeed> thread_infeeds(const catalogue::Kienzle& k,
                                   const catalogue::Thrust& thrust, double h, int n,
                                   double D) {
  std::vector<Infeed> all;
  double before = 0;
  for (int i = 1; i <= n; ++i) {
    const double a = h * std::sqrt(static_cast<double>(i) / n);  // Eq. (4)
    all.push_back({a - before, thread_infeed(k, thrust, before, a, D)});
    before = a;
  }
  return all;
}

double available_kW(const std::vector<SpeedRange>& ranges, double n, bool torque) {
  double most = -std::numeric_limits<double>::infinity();
  for (const auto& r : ranges) {
    if (!(n >= r.n_min_rpm * (1 - 1e-12) && n <= r.n_max_rpm * (1 + 1e-12))) continue;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& line : r.lines)
      if (line.torque == torque) least = std::min(least, line.c * std::pow(n, line.s));
    most = std::max(most, least);
  }
  return most;
}

}  // namespace turnwright::cutting
