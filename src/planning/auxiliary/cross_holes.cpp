#include "cross_holes.hpp"

#include <algorithm>

#include "base/say.hpp"
#include "fixed_operation.hpp"
#include "milled_choice.hpp"
#include "planning/surface/operation_result.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::planning {
namespace {

using fixed::Asked;
using fixed::Fitted;
using fixed::Site;

// Of the point of a hole that does not go through: to the bore, else to the other side.
double behind_mm(const PreparedPart& p, const Milled& m) {
  const double R = p.drawing.outer[m.element].left_mm / 2;
  const double hole = part::largest_hole_mm(p.drawing, m.z_mm, m.z_mm + m.length_mm) / 2;
  return hole > 0 ? R - hole : 2 * R;
}

AuxiliaryOperation drilled(const Site& s, const Asked& a, const Fitted& f,
                           const MilledPlace& m) {
  const double D = f.size_mm, n_cap = fixed::n_cap_rpm(s);
  const auto kc = cutting::kienzle_at(s.p.material, f.tool->gamma_deg);
  const auto way = fixed::drill_way(*f.tool, D, cross_hole_tip_mm(m, *f.tool), kAbove_mm);
  auto o = fixed::at_best(s, f, {D}, n_cap, [&](const Fitted& at) {
    const fixed::Duty d{cutting::drill(kc, D, at.at.f_mm_rev, at.tool->point_deg),
                        std::min(units::spindle_rpm(at.at.vc_m_min, D), n_cap), D};
    const double vf = at.at.f_mm_rev * d.n_rpm;
    auto made = fixed::operation(s, a, at, {fixed::pass_of(d, D / 2, way.fed_mm / vf)},
                                 {kAbove_mm / vf, way.rapid_mm, false, 0, 0}, {d});
    made.plan.constraints.push_back(constraint(
        Check::milled_feed_max, vf, s.p.machine.driven_tools->feed_max_mm_min));
    return made;
  });
  o.plan.kind = OperationKind::cross_drill;
  name_after(m, s.setup, o.plan);
  o.order = milled_order(s.p, m, s.setup, o.order.tool + ", driven");
  return o;
}

}  // namespace

double cross_hole_tip_mm(const Milled& m, const catalogue::FixedTool& drill) {
  const double beyond = m.through == Through::no ? 0 : kBehind_mm;
  return m.depth_mm + beyond + cutting::drill_point_mm(m.width_mm, drill.point_deg);
}

void add_cross_hole(const PreparedPart& p, const MilledPlace& m, std::size_t setup,
                    Clamping clamping, const Economy& economy, AuxiliaryWork& out) {
  const Site s{p,        setup,
               clamping, p.work.setups[setup],
               economy,  Stage::finishing,
               out,      cutting::speed_ranges(*p.machine.driven_tools),
               true};
  OperationRequest given;  // its conditions alone count
  given.conditions = m.drilling;
  const double deep = depth_beside_mm(p, setup, m, m.width_mm, {});
  const double behind = behind_mm(p, m);
  const bool fixes = m.drilling.vc_m_min || m.drilling.f_mm_rev;
  const Asked a{FixedUse::drilling,
                to_translate("drill"),
                m.id,
                false,
                fixes ? &given : nullptr,
                [&](const catalogue::FixedTool& t, double size) {
                  return size == m.width_mm && deep <= t.reach * size &&
                         (m.through != Through::no || cross_hole_tip_mm(m, t) < behind) &&
                         (m.drills.empty() || std::ranges::count(m.drills, t.id) > 0);
                }};
  const auto f = fixed::fitted_if(p, a, [&](const Fitted& each) {
    return std::ranges::all_of(
        drilled(s, a, {each.tool, each.size_mm, each.at, {}, {}}, m).plan.constraints,
        [](const auto& c) { return c.margin >= 0; });
  });
  if (!f.tool)
    return fixed::refuse(
        s, a,
        say("none of the drills{} is for {}, {:g} mm in diameter, reaches {:.4g} mm "
            "with its holder clear of what stands beside the hole{}",
            m.drills.empty() ? "" : tr(" that it may have"), p.material.name, m.width_mm,
            deep,
            m.through == Through::no
                ? say(" and has a point that ends before {:.4g} mm", behind)
                : ""));
  out.after.push_back(drilled(s, a, f, m));
}

}  // namespace turnwright::planning
