#include "jaw_squeeze.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planning/clamping/held_tube.hpp"
#include "planning/clamping/jaws.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "planning/clamping/positions.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/deflection/ring.hpp"

namespace turnwright::planning {
namespace {

// The first of a setup's clampings that has jaws.
std::optional<Clamping> with_jaws(const PreparedPart& p, std::size_t setup) {
  for (const auto c : p.setups[setup].clampings)
    if (c != Clamping::between_centres) return c;
  return std::nullopt;
}

// Distance from the jaws to the beginning of an element; 0 if it reaches between them.
double beyond_jaws_mm(const PreparedPart& p, const std::string& surface,
                      std::size_t setup, Clamping clamping) {
  const auto at = part::extent(p.drawing, surface);
  if (!at) return 0;
  const double jaws = root_z_mm(p, setup, clamping);
  const bool left = p.setups[setup].hold == part::End::left;
  return std::max(0.0, left ? at->z0_mm - jaws : jaws - at->z1_mm);
}

double gentle_grip_N(const PreparedPart& p, std::size_t setup, double most) {
  constexpr double kOfZone = 0.25, kLeast = 0.05;
  const auto jaws = with_jaws(p, setup);
  if (!jaws || !(gripped_bore_mm(p, setup) > 0)) return most;
  double share = 1;
  for (const auto& t : p.drawing.tolerances) {
    if (setup_of(p, t.of) != setup) continue;
    const double um = squeeze_um(p, t, setup, *jaws, most);
    share =
        std::min(share, kOfZone * units::um_from_mm(width_mm(t)) / std::max(um, 1e-9));
  }
  return most * std::max(kLeast, share);
}

}  // namespace

double squeeze_um(const PreparedPart& p, const part::Tolerance& t, std::size_t setup,
                  Clamping clamping, double force_N) {
  const auto tube = held_tube(p, setup, clamping);
  if (!tube.hollow() || !part::facts(t.kind).sees_lobes) return 0;
  const double R = tube.R_mm(), wall = tube.wall_mm(), decay = tube.decay_1_mm();
  const auto ring = deflection::with_shear(
      {R, deflection::wall_EI_Nmm2(p.material.E_MPa, tube.width_mm(p.grips_mm[setup]),
                                   wall)},
      wall);
  const double F = force_N / kJaws;
  const double lobes = part::has_two_ends(t.kind)
                           ? 2 * deflection::squeeze_mm(ring, kJaws, F, 0)
                           : deflection::lobing_mm(ring, kJaws, F);
  return units::um_from_mm(lobes) *
         std::exp(-decay * beyond_jaws_mm(p, t.of, setup, clamping));
}

std::vector<JawForces> jaw_forces(const PreparedPart& p) {
  std::vector<JawForces> all;
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    const auto& setup = p.setups[s];
    const double chuck_N = p.machine.chuck.grip_force_N;
    const auto held = with_jaws(p, s);
    const double elastic_N = held ? elastic_grip_N(p, s, *held) : chuck_N;
    JawForces jaws{setup.grip_force_N.value_or(std::min(chuck_N, elastic_N))};
    jaws.spares_tube = !setup.grip_force_N && jaws.roughing_N < chuck_N;
    jaws.finishing_N = setup.finishing_grip_force_N
                           ? *setup.finishing_grip_force_N
                           : gentle_grip_N(p, s, jaws.roughing_N);
    jaws.eased = !setup.finishing_grip_force_N && jaws.finishing_N < jaws.roughing_N;
    all.push_back(jaws);
  }
  return all;
}

}  // namespace turnwright::planning
