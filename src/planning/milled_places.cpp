#include "turnwright/planning/milled_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "milled_geometry.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/cutting/fixed.hpp"
#include "turnwright/cutting/milled.hpp"
#include "turnwright/milling/lobes.hpp"

namespace turnwright::planning {
namespace {

constexpr double kSlack = 1e-9;  // mm

bool jaws_cover(const PartPlan& p, std::size_t setup, Clamping clamping, double z0,
                double z1) {
  if (clamping == Clamping::between_centres) return false;
  const double root = root_z_mm(p, setup, clamping);
  return p.setups[setup].hold == part::End::left ? z0 < root - kSlack
                                                 : z1 > root + kSlack;
}

milling::System system_of(const std::vector<catalogue::TipMode>& modes, int teeth,
                          const Engagement& e, double force, double normal_ratio) {
  milling::System s;
  for (const auto& m : modes)
    s.modes.push_back({m.along_feed ? milling::Axis::x : milling::Axis::y,
                       2 * units::kPi * m.frequency_Hz, m.damping_ratio,
                       m.stiffness_N_mm});
  s.teeth = teeth;
  const auto arc = milling::down_milling(e.immersion);
  s.entry_rad = arc.entry_rad;
  s.exit_rad = arc.exit_rad;
  s.force = milling::LinearForce{force, force * normal_ratio};
  return s;
}

// Of unit force where the widest cut is; others have thinner chips and so more.
std::shared_ptr<const milling::Lobes> lobes_of(const PartPlan& p, const Milled& m,
                                               const catalogue::MillingCutter& cutter,
                                               int lanes) {
  const auto kc = cutting::kienzle_at(p.material, cutter.gamma_deg);
  const auto all = engagements(m, cutter, lanes);
  const double thick = cutter.conditions_in(p.material.group)->hex_mm.upper;
  const auto hm = [&](const Engagement& e) {
    return thick * e.chip.hm_over_fz / all[0].chip.hex_over_fz;
  };
  const auto K = [&](const Engagement& e) {
    return cutting::chip_stiffness(kc, p.material, hm(e));
  };
  std::vector<milling::System> systems;
  for (const auto& e : all)
    systems.push_back(system_of(tip_modes(p, cutter), cutter.teeth, e,
                                K(e).Kt_MPa / K(all[0]).Kt_MPa,
                                K(e).Kn_MPa / K(e).Kt_MPa));
  return std::make_shared<const milling::Lobes>(std::move(systems));
}

}  // namespace

const std::vector<catalogue::TipMode>& tip_modes(const PartPlan& p,
                                                 const catalogue::MillingCutter& cutter) {
  const auto& measured = p.machine.driven_tools->modes;
  const auto found = measured.find(cutter.id);
  return found == measured.end() ? cutter.modes : found->second;
}

std::string milled_obstacle(const PartPlan& p, const Assignment& work, const Milled& m,
                            std::size_t setup, Clamping clamping) {
  const auto& id = p.drawing.outer[m.element].id;
  const auto turned = setup_of(p, work, id);
  if (turned && *turned > setup)
    return fmt::format("{} is turned in setup {} only", id, *turned);
  const double z0 = m.z_mm, z1 = m.z_mm + m.length_mm;
  if (jaws_cover(p, setup, clamping, z0, z1))
    return fmt::format("the jaws hold the part up to z = {:g} mm",
                       root_z_mm(p, setup, clamping));
  const double steady = p.setups[setup].steady_z_mm;
  if (clamping == Clamping::chuck_steady && steady + kSteadyWidth_mm / 2 > z0 + kSlack &&
      steady - kSteadyWidth_mm / 2 < z1 - kSlack)
    return fmt::format("the steady rest stands at z = {:g} mm", steady);
  return {};
}

std::optional<std::size_t> milled_setup(const PartPlan& p, const Assignment& work,
                                        const Milled& m) {
  for (std::size_t s = 0; s < p.setups.size(); ++s)
    for (const auto clamping : p.setups[s].clampings)
      if (milled_obstacle(p, work, m, s, clamping).empty()) return s;
  return {};
}

std::optional<std::size_t> gripped_later(const PartPlan& p, const Milled& m) {
  for (std::size_t s = m.setup + 1; s < p.setups.size(); ++s)
    for (const auto clamping : p.setups[s].clampings)
      if (jaws_cover(p, s, clamping, m.z_mm, m.z_mm + m.length_mm)) return s;
  return {};
}

std::string does_not_fit(const PartPlan& p, const Milled& m,
                         const catalogue::MillingCutter& c) {
  const double D = c.dc_mm, w = m.width_mm;
  if (!c.conditions_in(p.material.group))
    return fmt::format("has no conditions for {}", p.material.name);
  if (c.lu_mm < m.depth_mm - kSlack)
    return fmt::format("reaches {:g} mm deep, not {:g} mm", c.lu_mm, m.depth_mm);
  if (c.re_mm > m.corner_mm.value_or(INFINITY) + kSlack)
    return fmt::format("has a corner of {:g} mm where {:g} mm is allowed", c.re_mm,
                       *m.corner_mm);
  if (c.ap_mm.lower > m.depth_mm + kSlack)
    return fmt::format("takes {:g} mm at least, which is deeper than {:g} mm",
                       c.ap_mm.lower, m.depth_mm);
  if (m.kind == MilledKind::flat)
    return m.lanes && w / *m.lanes > D + kSlack
               ? fmt::format("is {:g} mm wide, a lane {:.4g} mm", D, w / *m.lanes)
               : "";
  if (D > w + kSlack) return fmt::format("is {:g} mm wide, the place {:g} mm", D, w);
  if (2 * D < w - kSlack)
    return fmt::format("of {:g} mm is less than half as wide as the place, {:g} mm", D,
                       w);
  if (m.kind == MilledKind::slot) return {};
  if (D > m.length_mm - kSlack)
    return fmt::format("of {:g} mm does not go into {:g} mm of length", D, m.length_mm);
  return c.centre_cutting ? "" : "does not cut over its centre, so it cannot plunge";
}

std::vector<MilledWay> milled_ways(const PartPlan& p, const Milled& m) {
  std::vector<MilledWay> ways;
  for (std::size_t i = 0; i < m.cutters.size(); ++i) {
    const auto& c = m.cutters[i];
    if (!does_not_fit(p, m, c).empty()) continue;
    if (m.kind != MilledKind::flat) {
      ways.push_back({i, 1, lobes_of(p, m, c, 1)});
      continue;
    }
    if (m.lanes) {
      ways.push_back({i, *m.lanes, lobes_of(p, m, c, *m.lanes)});
      continue;
    }
    const int fewest =
        static_cast<int>(std::ceil(m.width_mm / (kLaneStep * c.dc_mm) - kSlack));
    for (const int times : {1, 2})  // Eq. (2)
      ways.push_back({i, fewest * times, lobes_of(p, m, c, fewest * times)});
  }
  return ways;
}

}  // namespace turnwright::planning
