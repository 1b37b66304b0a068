#include "turnwright/cutting/milled.hpp"

#include <algorithm>
#include <cmath>

#include "turnwright/base/units.hpp"

namespace turnwright::cutting {

MilledChip milled_chip(double a) {
  const double arc = std::acos(1 - 2 * a);                                  // Eq. (1)
  const double peak = a >= 0.5 ? 1 : 2 * std::sqrt(a * (1 - a));            // Eq. (2)
  return {.arc_rad = arc, .hex_over_fz = peak, .hm_over_fz = 2 * a / arc};  // Eq. (3)
}

ChipStiffness chip_stiffness(const catalogue::Kienzle& kc,
                             const catalogue::Material& material, double hm) {
  const double Kt = kc.k11_MPa * std::pow(hm, -kc.m);  // Eq. (4)
  const auto& kf = material.kf;
  return {Kt, kf ? kf->k11_MPa * std::pow(hm, -kf->m)
                 : catalogue::thrust_of(material).ratio * Kt};
}

double milled_power_kW(const catalogue::Kienzle& kc, double hm, double ap, double ae,
                       double vf) {
  return kc.k11_MPa * std::pow(hm, -kc.m) * ap * ae * vf / 60e6;  // Eq. (5)
}

double teeth_sum(double arc, int teeth, double mc) {
  constexpr int kAngles = 720;
  const double pitch = 2 * units::kPi / teeth;
  double most = 0;
  for (int k = 1; k <= kAngles; ++k) {  // phi is that of the tooth that leaves next
    double sum = 0;
    for (double phi = arc - pitch + pitch * k / kAngles; phi > 0; phi -= pitch)
      sum += std::pow(std::sin(std::min(phi, units::kPi)), 1 - mc);  // Eq. (6)
    most = std::max(most, sum);
  }
  return most;
}

}  // namespace turnwright::cutting
