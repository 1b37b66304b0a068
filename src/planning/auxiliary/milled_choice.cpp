#include "milled_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "milled_ways.hpp"
#include "planning/clamping/jaws.hpp"
#include "planning/clamping/setup_body.hpp"
#include "planning/clamping/supports.hpp"
#include "planning/surface/operation_result.hpp"
#include "turnwright/base/dual.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/cutting/fixed.hpp"
#include "turnwright/deflection/rest.hpp"

namespace turnwright::planning {
namespace {

constexpr double kBinding = 1e-4;   // ln: the search stays so far inside a lobe
constexpr double kLeast_mm = 1e-6;  // least depth that is reported

double force_N(const MilledSite& s, const MilledChoice& c, double fz) {
  return c.kc.k11_MPa * c.ap_mm(s.m) * std::pow(fz, 1 - c.kc.m) * c.teeth;  // Eq. (3)
}

double power_kW(const MilledSite& s, const MilledChoice& c, double n, double fz) {
  return cutting::milled_power_kW(c.kc, fz, c.ap_mm(s.m), c.ae_sum,
                                  fz * c.cutter->teeth * n);  // Eq. (2)
}

double back_min(const MilledSite& s, const MilledChoice& c) {
  return c.passes * c.way->lanes * (s.m.length_mm + 2 * kApproach_mm) /
         s.p.machine.rapid_mm_min;
}

double grip_N(const MilledSite& s, double normal) {
  if (s.clamping == Clamping::between_centres) return INFINITY;
  const double force = jaw_force_N(s.p, s.setup, s.clamping, Stage::finishing);
  const cutting::Grip grip{force, s.p.machine.chuck.jaw_mass_radius_kg_m,
                           s.p.machine.chuck.friction,
                           grip_diameter_mm(s.p, s.setup, s.clamping)};
  const double F = std::sqrt(1 + sqr(normal));  // of one newton around the cutter
  return force /
         cutting::grip_needed_N(grip, F, F, s.p.drawing.outer[s.m.element].left_mm);
}

// The limits and their values at the choice, evaluated anew at speed and feed.
std::vector<ConstraintValue> cutter_limits(const MilledSite& s, const MilledChoice& c,
                                           double n, double fz, double stable_mm) {
  const auto& cutter = *c.cutter;
  const auto& driven = *s.p.machine.driven_tools;
  const auto ranges = cutting::speed_ranges(driven);
  const double ap = c.ap_mm(s.m), vc = units::cutting_speed_m_min(n, cutter.dc_mm);
  const double held = std::clamp(n, ranges.front().n_min_rpm, ranges.back().n_max_rpm);
  const double P = power_kW(s, c, n, fz), M = P / units::shaft_power_kW(1, n);
  const double F = force_N(s, c, fz);
  std::vector<ConstraintValue> all{
      constraint(Check::stable_depth, ap * (1 + s.m.depth_margin),
                 std::max(stable_mm, kLeast_mm)),
      constraint(Check::part_compliance, 1e6 * s.part_mm_N,
                 1e6 * tip_mm_N(tip_modes(s.p, cutter))),
      constraint(Check::milled_depth_max, ap, cutter.ap_mm.upper),
      constraint(Check::depth_min, ap, cutter.ap_mm.lower),
      constraint(Check::chip_thickness_max, fz * c.hex_over_fz, c.grade->hex_mm.upper),
      constraint(Check::chip_thickness_min, fz * c.hex_over_fz, c.grade->hex_mm.lower),
      constraint(Check::milled_vc_max, vc, c.grade->vc_m_min.upper),
      constraint(Check::vc_min, vc, c.grade->vc_m_min.lower),
      constraint(Check::milled_n_max, n, ranges.back().n_max_rpm),
      constraint(Check::spindle_min, n, ranges.front().n_min_rpm),
      constraint(Check::milled_feed_max, fz * cutter.teeth * n, driven.feed_max_mm_min),
      constraint(Check::power, P, cutting::available_kW(ranges, held, false)),
      constraint(
          Check::torque, M,
          cutting::available_kW(ranges, held, true) / units::shaft_power_kW(1, held)),
      constraint(Check::force, F, cutter.Fc_max_N)};
  if (std::isfinite(c.grip_N)) {
    const double force = jaw_force_N(s.p, s.setup, s.clamping, Stage::finishing);
    all.push_back(constraint(Check::grip, F / c.grip_N * force, force));
  }
  for (auto& limit : all) limit.binding = limit.margin < kBinding;
  return all;
}

MilledCut cut_at(const MilledSite& s, const MilledChoice& c, const MilledCase& k,
                 double n, double fz) {
  MilledCut cut;
  cut.kind = s.m.kind;
  cut.lanes = c.way->lanes;
  cut.ae_mm = c.ae_mm;
  cut.fz_mm = fz;
  cut.hm_mm = fz * c.hm_over_fz;
  cut.vf_mm_min = fz * c.cutter->teeth * n;
  const auto K = cutting::chip_stiffness(c.kc, s.p.material, cut.hm_mm);
  cut.Kt_MPa = K.Kt_MPa;
  cut.Kn_MPa = K.Kn_MPa;
  cut.depth_margin = s.m.depth_margin;
  cut.speed_margin = s.m.speed_margin;
  cut.part_share = c.rho;
  // Stable depths are searched up to this one, deep enough to show by how much they exceed
  // the required margin.
  cut.shown_mm =
      std::max(2 * c.ap_mm(s.m) * (1 + s.m.depth_margin), 1.5 * c.cutter->ap_mm.lower);
  const double per_mm = (1 + c.rho) * cut.Kt_MPa;
  cut.limit_mm = stable_around_N_mm(k, n, cut.shown_mm * per_mm) / per_mm;
  return cut;
}

}  // namespace

double part_mm_N(const PreparedPart& p, const Milled& m, std::size_t setup,
                 Clamping clamping) {
  const SetupBody body(p, setup, clamping, finished_after(p, setup));
  const auto shaft = body.shaft();
  const auto supports = planes(p.machine, clamping).tangential;
  const deflection::Beam beam(shaft);
  double most = 0;
  for (const double share : {0.0, 0.5, 1.0}) {
    const double x = body.x_mm(m.z_mm + share * m.length_mm);
    const double at = std::clamp(x, 0.0, body.length_mm());
    if (clamping == Clamping::chuck_steady) {
      const deflection::RestedBeam rested(shaft, shaft, supports,
                                          {body.x_mm(p.setups[setup].steady_z_mm),
                                           p.machine.steady_rest.tangential_mm_N});
      most = std::max(most, rested.at(at).part.f_ww_mm_N);
    } else {
      most = std::max(most, beam.at(at, supports).f_ww_mm_N);
    }
  }
  return most;
}

double tip_mm_N(const std::vector<catalogue::TipMode>& modes) {
  double across = 0;
  for (const auto& m : modes)
    if (!m.along_feed) across += 1 / m.stiffness_N_mm;
  return across;
}

MilledChoice milled_choice(const MilledSite& s, const MilledWay& way, int passes) {
  MilledChoice c;
  c.way = &way;
  c.cutter = &s.m.cutters[way.cutter];
  c.grade = c.cutter->conditions_in(s.p.material.group);
  c.passes = passes;
  c.out = run_out(s.p, s.setup, s.clamping, s.m, c.cutter->dc_mm);
  c.kc = cutting::kienzle_at(s.p.material, c.cutter->gamma_deg);
  const auto all = engagements(s.m, *c.cutter, way.lanes);
  c.hm_over_fz = all[0].chip.hm_over_fz;
  c.hex_over_fz = all[0].chip.hex_over_fz;
  c.ae_mm = all[0].ae_mm;
  c.ae_sum = c.teeth = 0;
  for (const auto& e : all) {
    c.ae_sum = std::max(c.ae_sum, e.ae_mm * std::pow(e.chip.hm_over_fz, -c.kc.m));
    c.teeth =
        std::max(c.teeth, cutting::teeth_sum(e.chip.arc_rad, c.cutter->teeth, c.kc.m));
  }
  c.rho = s.part_mm_N / tip_mm_N(tip_modes(s.p, *c.cutter));
  c.grip_N = grip_N(s, way.normal);
  return c;
}

catalogue::Range speeds_rpm(const PreparedPart& p,
                            const catalogue::MillingCutter& cutter) {
  const auto ranges = cutting::speed_ranges(*p.machine.driven_tools);
  const auto& vc = cutter.conditions_in(p.material.group)->vc_m_min;
  return {std::max(ranges.front().n_min_rpm, units::spindle_rpm(vc.lower, cutter.dc_mm)),
          std::min(ranges.back().n_max_rpm, units::spindle_rpm(vc.upper, cutter.dc_mm))};
}

MilledCase milled_case(const MilledSite& s, const MilledChoice& c,
                       const cutting::SpeedRange& range) {
  const auto& cutter = *c.cutter;
  const double ap = c.ap_mm(s.m), mc = c.kc.m, root = 1 / (1 - mc);
  const auto speeds = speeds_rpm(s.p, cutter);
  MilledCase k;
  k.lobes = c.way->lobes.get();
  k.between = c.way->between.get();
  k.n_min_rpm = std::max(range.n_min_rpm, speeds.lower);
  k.n_max_rpm = std::min(range.n_max_rpm, speeds.upper);
  const auto constant = [&](double fz) { k.caps.push_back({fz, 0}); };
  constant(std::min(c.grade->hex_mm.upper / c.hex_over_fz, c.way->fz_to_mm));
  k.caps.push_back({s.p.machine.driven_tools->feed_max_mm_min / cutter.teeth, -1});
  for (const auto& line : range.lines)
    k.caps.push_back(
        {std::pow(line.c / power_kW(s, c, 1, 1), root), (line.s - 1) * root});
  constant(std::pow(cutter.Fc_max_N / force_N(s, c, 1), root));
  if (std::isfinite(c.grip_N)) constant(std::pow(c.grip_N / force_N(s, c, 1), root));
  k.fz_min_mm = std::max(c.grade->hex_mm.lower / c.hex_over_fz, c.way->fz_from_mm);
  if (s.m.n_rpm) {
    k.n_min_rpm = std::max(k.n_min_rpm, *s.m.n_rpm);
    k.n_max_rpm = std::min(k.n_max_rpm, *s.m.n_rpm);
  }
  k.path_mm = c.passes * layer_mm(s.m, cutter.dc_mm, c.way->lanes, c.out);  // Eq. (1)
  if (s.m.kind == MilledKind::keyway) k.path_mm += s.m.depth_mm / kPlungeFeed;
  k.teeth = cutter.teeth;
  k.minute = s.economy.minute;
  k.edge = s.economy.minute * cutter.change_min + s.economy.edge * cutter.edge_cost;
  k.besides = s.economy.minute * back_min(s, c);
  k.T0_min = c.grade->T0_min;
  k.n0_rpm = units::spindle_rpm(c.grade->v0_m_min, cutter.dc_mm);
  k.nT = c.grade->n;
  k.mc = mc;
  k.load = ap * (1 + s.m.depth_margin) * (1 + c.rho) * c.kc.k11_MPa *
           std::pow(c.hm_over_fz, -mc);  // Eq. (4)
  k.speed_margin = s.m.speed_margin;
  return k;
}

InOrder milled_order(const PreparedPart& p, const Milled& m, std::size_t setup,
                     std::string tool) {
  const double sign = p.setups[setup].hold == part::End::left ? 1 : -1;
  const double z = sign * (m.z_mm + m.length_mm / 2 - free_z_mm(p, setup));
  return {.tool = std::move(tool),
          .stage = Stage::finishing,
          .from_mm = z,
          .to_mm = z,
          .milled = true,
          .over_mm = p.drawing.outer[m.element].left_mm / 2 + kAbove_mm};
}

void name_after(const Milled& m, std::size_t setup, OperationPlan& operation) {
  const char* does = m.kind == MilledKind::cross_hole ? "drill" : "mill";
  operation.id = fmt::format("s{}-{}-{}", setup + 1, does, m.id);
  operation.on = {m.id};
}

AuxiliaryOperation milled_operation(const MilledSite& s, const MilledChoice& c,
                                    const MilledCase& k, double n, double fz) {
  AuxiliaryOperation o;
  auto& plan = o.plan;
  plan.kind = OperationKind::mill;
  name_after(s.m, s.setup, plan);
  plan.tool = c.cutter->id;
  Pass pass;
  pass.ap_mm = c.ap_mm(s.m);
  pass.f_mm_rev = fz * c.cutter->teeth;
  pass.n_rpm = n;
  pass.vc_m_min = units::cutting_speed_m_min(n, c.cutter->dc_mm);
  pass.time_min = k.path_mm / (fz * c.cutter->teeth * n) / c.passes;
  pass.Fc_N = force_N(s, c, fz);
  pass.Pc_kW = power_kW(s, c, n, fz);
  pass.T_min = life_min(k, n);
  plan.passes.assign(static_cast<std::size_t>(c.passes), pass);
  plan.time_min = c.passes * pass.time_min;
  plan.edges = plan.time_min / pass.T_min;
  o.air_min = back_min(s, c);
  o.change_min = c.cutter->change_min * plan.edges;
  o.edges_cost = c.cutter->edge_cost * plan.edges;
  plan.cost = s.p.machine_per_min * o.minutes() + o.edges_cost;
  plan.milled = cut_at(s, c, k, n, fz);
  plan.constraints = cutter_limits(s, c, n, fz, plan.milled->limit_mm);
  return o;
}

}  // namespace turnwright::planning
