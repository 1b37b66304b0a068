#include "milled_ways.hpp"

#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "milled_paths.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "planning/clamping/positions.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/chatter/lobes.hpp"
#include "turnwright/cutting/fixed.hpp"
#include "turnwright/cutting/milled.hpp"
#include "turnwright/deflection/ovality.hpp"

namespace turnwright::planning {
namespace {

bool jaws_cover(const PreparedPart& p, std::size_t setup, Clamping clamping, double z0,
                double z1) {
  if (clamping == Clamping::between_centres) return false;
  const double root = root_z_mm(p, setup, clamping);
  return p.setups[setup].hold == part::End::left ? z0 < root - kSlack_mm
                                                 : z1 > root + kSlack_mm;
}

chatter::System system_of(const std::vector<catalogue::TipMode>& modes, int teeth,
                          const Engagement& e, double force, double normal_ratio) {
  chatter::System s;
  for (const auto& m : modes)
    s.modes.push_back({m.along_feed ? chatter::Axis::x : chatter::Axis::y,
                       2 * units::kPi * m.frequency_Hz, m.damping_ratio,
                       m.stiffness_N_mm});
  s.teeth = teeth;
  const auto arc = chatter::down_milling(e.immersion);
  s.entry_rad = arc.entry_rad;
  s.exit_rad = arc.exit_rad;
  s.force = chatter::LinearForce{force, force * normal_ratio};
  return s;
}

// System with unit force for the widest cut; other cuts have thinner chips and so more
// force.
struct Forces {
  const PreparedPart& p;
  const catalogue::MillingCutter& cutter;
  Engagement widest;
  std::vector<double> feeds_mm;

  cutting::ChipStiffness at(const Engagement& e, double fz) const {
    return cutting::chip_stiffness(cutting::kienzle_at(p.material, cutter.gamma_deg),
                                   p.material, fz * e.chip.hm_over_fz);
  }
  double ratio(const Engagement& e, double fz) const {
    return at(e, fz).Kn_MPa / at(e, fz).Kt_MPa;
  }
  std::shared_ptr<const chatter::Lobes> lobes(const std::vector<Engagement>& cuts) const {
    std::vector<chatter::System> systems;
    for (const double fz : feeds_mm)
      for (const auto& e : cuts)
        systems.push_back(system_of(tip_modes(p, cutter), cutter.teeth, e,
                                    at(e, fz).Kt_MPa / at(widest, fz).Kt_MPa,
                                    ratio(e, fz)));
    if (systems.empty()) return nullptr;
    return std::make_shared<const chatter::Lobes>(std::move(systems));
  }
};

MilledWay way_of(const PreparedPart& p, const Milled& m, std::size_t index, int lanes,
                 double fz_from, double fz_to) {
  const auto& cutter = m.cutters[index];
  const auto cuts = engagements(m, cutter, lanes);
  const auto between = engagements_between(m, cutter, lanes);
  Forces forces{p, cutter, cuts[0], {fz_to}};
  if (p.material.kf && p.material.kf->m != p.material.kc.m && fz_from < fz_to)
    forces.feeds_mm.push_back(fz_from);
  MilledWay way{
      index, lanes, fz_from, fz_to, 0, forces.lobes(cuts), forces.lobes(between)};
  for (const auto& list : {cuts, between})
    for (const double fz : forces.feeds_mm)
      for (const auto& e : list) way.normal = std::max(way.normal, forces.ratio(e, fz));
  return way;
}

// The ways of a cutter with a number of lanes, one for each range of feeds.
void add_ways(const PreparedPart& p, const Milled& m, std::size_t index, int lanes,
              std::vector<MilledWay>& ways) {
  const auto& cutter = m.cutters[index];
  const auto& hex = cutter.conditions_in(p.material.group)->hex_mm;
  const double per_fz = engagements(m, cutter, lanes)[0].chip.hex_over_fz;
  const double lo = m.fz_mm.value_or(hex.lower / per_fz);
  const double hi = m.fz_mm.value_or(hex.upper / per_fz);
  const auto& kf = p.material.kf;
  const double changes = kf ? std::abs((p.material.kc.m - kf->m) * std::log(hi / lo)) : 0;
  const int n =
      std::max(1, static_cast<int>(std::ceil(changes / std::log1p(kRatioStep))));
  for (int k = 0; k < n; ++k)
    ways.push_back(way_of(p, m, index, lanes, lo * std::pow(hi / lo, 1.0 * k / n),
                          lo * std::pow(hi / lo, (k + 1.0) / n)));
}

}  // namespace

const std::vector<catalogue::TipMode>& tip_modes(const PreparedPart& p,
                                                 const catalogue::MillingCutter& cutter) {
  const auto& measured = p.machine.driven_tools->modes;
  const auto found = measured.find(cutter.id);
  return found == measured.end() ? cutter.modes : found->second;
}

std::string milled_obstacle(const PreparedPart& p, const Milled& m, std::size_t setup,
                            Clamping clamping) {
  const auto& id = p.drawing.outer[m.element].id;
  const auto turned = setup_of(p, id);
  if (turned && *turned > setup)
    return say("{} is turned in {} only", id, setup_label(*turned));
  const double z0 = m.z_mm, z1 = m.z_mm + m.length_mm;
  if (jaws_cover(p, setup, clamping, z0, z1))
    return say("the jaws hold the part up to z = {:g} mm", root_z_mm(p, setup, clamping));
  const double steady = p.setups[setup].steady_z_mm;
  if (clamping == Clamping::chuck_steady &&
      steady + kSteadyWidth_mm / 2 > z0 + kSlack_mm &&
      steady - kSteadyWidth_mm / 2 < z1 - kSlack_mm)
    return say("the steady rest stands at z = {:g} mm", steady);
  return {};
}

std::optional<std::size_t> milled_setup(const PreparedPart& p, const Milled& m) {
  for (std::size_t s = 0; s < p.setups.size(); ++s)
    for (const auto clamping : p.setups[s].clampings)
      if (milled_obstacle(p, m, s, clamping).empty()) return s;
  return {};
}

std::optional<std::size_t> gripped_later(const PreparedPart& p, const MilledPlace& m) {
  for (std::size_t s = m.setup.value() + 1; s < p.setups.size(); ++s)
    for (const auto clamping : p.setups[s].clampings)
      if (jaws_cover(p, s, clamping, m.z_mm, m.z_mm + m.length_mm)) return s;
  return {};
}

double stiffness_kept(const PlanRequest& p, const Milled& m) {
  if (m.kind == MilledKind::cross_hole) return 1;
  const double D = p.drawing.outer[m.element].left_mm;
  const auto whole = deflection::round_section(
      D, part::largest_hole_mm(p.drawing, m.z_mm, m.z_mm + m.length_mm));
  auto s = whole;
  for (const auto& x : p.milled)
    if (x.kind != MilledKind::cross_hole && x.element == m.element &&
        x.z_mm < m.z_mm + m.length_mm && m.z_mm < x.z_mm + x.length_mm)
      s = deflection::without_slot(
          s, D, {x.width_mm, D / 2 - x.depth_mm, units::rad_from_deg(x.angle_deg)});
  return deflection::least_second_moment_mm4(s) / whole.xx_mm4;
}

std::string does_not_fit(const PreparedPart& p, const Milled& m,
                         const catalogue::MillingCutter& c) {
  const double D = c.dc_mm, w = m.width_mm;
  if (!c.conditions_in(p.material.group))
    return say("has no conditions for {}", p.material.name);
  const auto& modes = tip_modes(p, c);
  if (std::ranges::all_of(modes, &catalogue::TipMode::along_feed))
    return tr(
        "has no mode across the feed (axis y) at its tool point, where the part "
        "yields with it");
  if (c.lu_mm < m.depth_mm - kSlack_mm)
    return say("reaches {:g} mm deep, not {:g} mm", c.lu_mm, m.depth_mm);
  if (c.re_mm > m.corner_mm.value_or(INFINITY) + kSlack_mm)
    return say("has a corner of {:.12g} mm where {:.12g} mm is allowed", c.re_mm,
               *m.corner_mm);
  if (c.ap_mm.lower > m.depth_mm + kSlack_mm)
    return say("takes {:g} mm at least, which is deeper than {:g} mm", c.ap_mm.lower,
               m.depth_mm);
  if (m.kind == MilledKind::flat)
    return m.lanes && w / *m.lanes > D + kSlack_mm
               ? say("is {:g} mm wide, a lane {:.4g} mm", D, w / *m.lanes)
               : "";
  if (D > w + kSlack_mm) return say("is {:g} mm wide, the place {:g} mm", D, w);
  if (2 * D < w - kSlack_mm)
    return say("of {:g} mm is less than half as wide as the place, {:g} mm", D, w);
  if (m.kind == MilledKind::slot) return {};
  if (D > m.length_mm - kSlack_mm)
    return say("of {:g} mm does not go into {:g} mm of length", D, m.length_mm);
  return c.centre_cutting ? "" : tr("does not cut over its centre, so it cannot plunge");
}

std::vector<MilledWay> milled_ways(const PreparedPart& p, const Milled& m) {
  std::vector<MilledWay> ways;
  for (std::size_t i = 0; i < m.cutters.size(); ++i) {
    const auto& c = m.cutters[i];
    if (!does_not_fit(p, m, c).empty()) continue;
    const int fewest =
        m.kind == MilledKind::flat
            ? static_cast<int>(std::ceil(m.width_mm / (kLaneStep * c.dc_mm) - kSlack_mm))
            : 1;
    add_ways(p, m, i, m.lanes.value_or(fewest), ways);
    if (m.kind == MilledKind::flat && !m.lanes)
      add_ways(p, m, i, 2 * fewest, ways);  // Eq. (2)
  }
  return ways;
}

}  // namespace turnwright::planning
