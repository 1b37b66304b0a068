#include "clamping_checks.hpp"

#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "held_tube.hpp"
#include "jaws.hpp"
#include "positions.hpp"
#include "setup_body.hpp"
#include "supports.hpp"
#include "turnwright/deflection/thrust.hpp"

namespace turnwright::planning {
namespace {

// The surface in the way of a tailstock, a centre or a steady rest; empty if there is
// none.
std::string in_the_way(const PreparedPart& p, std::size_t setup, Clamping c,
                       const SetupWork& work) {
  const auto& d = p.drawing;
  if (c != Clamping::chuck_steady)
    return work.bores.empty() ? ""
                              : say("the centre stands where bore {} is cut",
                                    d.inner[work.bores.front()].id);
  const double z = p.setups[setup].steady_z_mm;
  if (!rest_stands_free(p, setup))
    return say("the steady rest at z = {:g} mm does not stand between jaws and free end",
               z);
  for (const std::size_t i : work.elements) {
    const double z0 = part::left_z_mm(d, i), z1 = z0 + d.outer[i].length_mm;
    if (z + kSteadyWidth_mm / 2 > z0 && z - kSteadyWidth_mm / 2 < z1)
      return say(
          "the steady rest at z = {:g} mm stands on {}, which this setup "
          "cuts",
          z, d.outer[i].id);
  }
  return {};
}

// Beyond it the bound (3) of thrust.hpp is too pessimistic.
constexpr double kOfBuckling = 0.5;

// The tailstock's thrust compared with the buckling load of the part after the setup.
std::string buckles(const PreparedPart& p, std::size_t setup, Clamping c,
                    const SetupWork& work, Finished done) {
  if (!has_tailstock(c) || !(p.machine.tail_thrust_N > 0)) return {};
  finish(done, work);
  const double P_cr = deflection::critical_thrust_N(SetupBody(p, setup, c, done).shaft(),
                                                    planes(p.machine, c).radial);
  if (p.machine.tail_thrust_N <= kOfBuckling * P_cr) return {};
  return say(
      "the tailstock's thrust of {:.0f} N is more than half of the {:.0f} N that buckle "
      "the part",
      p.machine.tail_thrust_N, P_cr);
}

// A force that the request gives, against what a hollow part bears.
std::string strains(const PreparedPart& p, std::size_t setup, Clamping c) {
  const auto& s = p.setups[setup];
  const auto force_N = std::max(s.grip_force_N, s.finishing_grip_force_N);
  const double most_N = elastic_grip_N(p, setup, c);
  if (!force_N || *force_N <= most_N) return {};
  return say(
      "the jaws' {:.4g} kN would strain the hollow part to {:.0f} MPa, more than two "
      "thirds of its yield strength, {:g} MPa: at most {:.4g} kN",
      *force_N / 1000, squeeze_MPa(p, setup, c, *force_N), *p.material.yield_MPa,
      std::floor(most_N) / 1000);
}

}  // namespace

bool rest_stands_free(const PreparedPart& p, std::size_t setup) {
  const double z = p.setups[setup].steady_z_mm;
  const auto [low, high] =
      std::minmax({root_z_mm(p, setup, Clamping::chuck_steady), free_z_mm(p, setup)});
  return z > low && z < high;
}

std::string unusable(const PreparedPart& p, std::size_t setup, Clamping c,
                     const SetupWork& work, const Finished& done) {
  const auto& m = p.machine;
  const auto& d = p.drawing.stock;
  if (c != Clamping::between_centres) {
    const double grip = grip_diameter_mm(p, setup, c);
    if (grip < m.chuck.diameter_mm.lower || grip > m.chuck.diameter_mm.upper)
      return say("the chuck holds {:g} to {:g} mm, not {:g} mm",
                 m.chuck.diameter_mm.lower, m.chuck.diameter_mm.upper, grip);
    if (auto why = strains(p, setup, c); !why.empty()) return why;
  }
  if (c != Clamping::chuck && d.length_mm > m.between_centres_mm)
    return say("the machine takes {:g} mm between centres, not {:g} mm",
               m.between_centres_mm, d.length_mm);
  if (d.outer_mm > m.swing_mm)
    return say("the stock of {:g} mm does not swing in {:g} mm", d.outer_mm, m.swing_mm);
  if (c == Clamping::chuck) return {};
  const auto why = in_the_way(p, setup, c, work);
  return why.empty() ? buckles(p, setup, c, work, done) : why;
}

}  // namespace turnwright::planning
