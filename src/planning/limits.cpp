#include "limits.hpp"

#include <algorithm>
#include <cmath>

namespace turnwright::planning {
namespace {

using catalogue::CurvePoint;
using catalogue::Range;
using catalogue::Tool;

std::string of(const char* what, const std::string& whom) {
  return std::string(what) + " of " + whom;
}
std::string grip_name(const char* what, std::size_t setup) {
  return std::string(what) + " in setup " + std::to_string(setup);
}
constexpr const char* kPower = "power";  // and torque, of one motor
constexpr const char* kDampingRatio = "damping ratio";
constexpr const char* kGrip = "grip force";
constexpr const char* kEasedGrip = "finishing grip force";

// "t1, the cylindricity of d1," and for what the drawing gives no id "the diameter k6 of
// d1".
std::string called(const PreparedPart& p, const part::Tolerance& t) {
  const auto surface = t.of.empty() ? t.between[0] + " .. " + t.between[1] : t.of;
  const auto kind = std::string("the ") + part::name(t.kind);
  if (t.id.find(':') == std::string::npos)
    return t.id + ", " + of(kind.c_str(), surface) + ",";
  const auto fit = [&](const auto& elements) {
    for (const auto& e : elements)
      if (e.id == t.of && e.fit) return " " + *e.fit;
    return std::string();
  };
  return of((kind + fit(p.drawing.outer) + fit(p.drawing.inner)).c_str(), surface);
}

// A limit that has no other words than its name.
Limit limit(const std::string& name, const char* unit, bool at_most, double now,
            std::function<void(PlanRequest&, double)> scale) {
  return {name, (at_most ? "raising " : "lowering ") + name,
          unit, at_most,
          now,  std::move(scale)};
}

void add_tolerances(const PreparedPart& p, std::vector<Limit>& all) {
  const auto& tolerances = p.drawing.tolerances;
  for (std::size_t i = 0; i < tolerances.size(); ++i)
    all.push_back({tolerances[i].id, "opening " + called(p, tolerances[i]), "mm", true,
                   width_mm(tolerances[i]), [i](PlanRequest& plan, double k) {
                     widen(plan.drawing.tolerances[i], k);
                   }});
}

template <class Surface>
void add_roughness(const std::vector<Surface>& surfaces,
                   std::vector<Surface> part::Drawing::*list, std::vector<Limit>& all) {
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    for (const auto& [what, value] :
         {std::pair{"roughness Ra", &Surface::Ra_um}, {"roughness Rz", &Surface::Rz_um}})
      if (surfaces[i].*value)
        all.push_back(limit(of(what, surfaces[i].id), "um", true, *(surfaces[i].*value),
                            [i, list, member = value](PlanRequest& plan, double k) {
                              *((plan.drawing.*list)[i].*member) *= k;
                            }));
}

// The line through the last two points, log-log, goes on.
void stretch(std::vector<CurvePoint>& curve, double k) {
  auto& last = curve.back();
  if (curve.size() > 1) {
    const auto& before = curve[curve.size() - 2];
    const double per_n = std::log(k) / std::log(last.n_rpm / before.n_rpm);
    last.P_kW *= std::pow(last.P_kW / before.P_kW, per_n);
    last.M_Nm *= std::pow(last.M_Nm / before.M_Nm, per_n);
  }
  last.n_rpm *= k;
}

// What ends at the same speed - curve, spindle, chuck - moves along.
void raise_speed(double end_rpm, double k, PlanRequest& plan) {
  auto& m = plan.machine;
  const auto ends_there = [&](double n) { return std::abs(n / end_rpm - 1) < 1e-9; };
  if (ends_there(m.curve.back().n_rpm)) stretch(m.curve, k);
  for (double* n : {&m.n_max_rpm, &m.chuck.n_max_rpm})
    if (ends_there(*n)) *n *= k;
}

// Whether the jaws finish with a force of their own.
bool has_finishing_force(const PreparedPart& p, std::size_t s) {
  return p.setups[s].finishing_grip_force_N || p.jaws[s].eased;
}

void add_machine(const PreparedPart& p, std::vector<Limit>& all) {
  const auto& m = p.machine;
  const auto number = [](double catalogue::Lathe::*value) {
    return [value](PlanRequest& plan, double k) { plan.machine.*value *= k; };
  };
  all.push_back(limit(of(kPower, m.id), "kW", true, most_power_kW(m.curve),
                      [](PlanRequest& plan, double k) {
                        for (auto& point : plan.machine.curve) {
                          point.P_kW *= k;
                          point.M_Nm *= k;
                        }
                      }));
  all.push_back(limit(of(kDampingRatio, m.id), "", true, p.damping_ratio,
                      [](PlanRequest& plan, double k) { plan.damping_ratio *= k; }));
  all.push_back(limit(of("feed force", m.id), "N", true, m.feed_force_max_N,
                      number(&catalogue::Lathe::feed_force_max_N)));
  const double end = std::min(m.n_max_rpm, m.curve.back().n_rpm);
  all.push_back(limit(of("largest spindle speed", m.id), "1/min", true, end,
                      [end](PlanRequest& plan, double k) { raise_speed(end, k, plan); }));
  all.push_back(limit(of("least spindle speed", m.id), "1/min", false, m.n_min_rpm,
                      number(&catalogue::Lathe::n_min_rpm)));
  if (m.chuck.n_max_rpm < end)
    all.push_back(
        limit("largest speed of the chuck", "1/min", true, m.chuck.n_max_rpm,
              [](PlanRequest& plan, double k) { plan.machine.chuck.n_max_rpm *= k; }));
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    const double full = p.jaws[s].roughing_N;
    all.push_back(limit(grip_name(kGrip, s), "N", true, full,
                        [s, full](PlanRequest& plan, double k) {
                          plan.setups[s].grip_force_N = k * full;
                        }));
    if (has_finishing_force(p, s))
      all.push_back(
          limit(grip_name(kEasedGrip, s), "N", true, p.jaws[s].finishing_N,
                [s, force = p.jaws[s].finishing_N](PlanRequest& plan, double k) {
                  plan.setups[s].finishing_grip_force_N = k * force;
                }));
  }
}

// What a tool's numbers are called, and which check holds them.
struct ToolLimit {
  Check check;
  const char* what;
  Range Tool::*range;  ///< or the force
  double Range::*end;
};
constexpr ToolLimit kToolLimits[] = {
    {Check::depth_min, "least depth of cut", &Tool::ap_mm, &Range::lower},
    {Check::depth_max, "largest depth of cut", &Tool::ap_mm, &Range::upper},
    {Check::feed_min, "least feed", &Tool::f_mm_rev, &Range::lower},
    {Check::feed_max, "largest feed", &Tool::f_mm_rev, &Range::upper},
    {Check::vc_min, "least cutting speed", &Tool::vc_m_min, &Range::lower},
    {Check::vc_max, "largest cutting speed", &Tool::vc_m_min, &Range::upper},
    {Check::life_min, "least tool life", &Tool::T_min, &Range::lower},
    {Check::life_max, "longest tool life", &Tool::T_min, &Range::upper}};

void add_tools(const PreparedPart& p, std::vector<Limit>& all) {
  for (std::size_t i = 0; i < p.tools.size(); ++i) {
    const auto& tool = p.tools[i];
    for (const auto& l : kToolLimits)
      all.push_back(limit(
          of(l.what, tool.id), check_name(l.check).unit, check_name(l.check).at_most,
          tool.*l.range.*l.end,
          [i, l](PlanRequest& plan, double k) { plan.tools[i].*l.range.*l.end *= k; }));
    if (tool.bar && tool.bar->damping_ratio)
      all.push_back(limit(
          of(kDampingRatio, tool.id), "", true, *tool.bar->damping_ratio,
          [i](PlanRequest& plan, double k) { *plan.tools[i].bar->damping_ratio *= k; }));
    all.push_back(
        limit(of("cutting force", tool.id), "N", true, tool.Fc_max_N,
              [i](PlanRequest& plan, double k) { plan.tools[i].Fc_max_N *= k; }));
  }
}

// The jaws' force that an operation has.
std::string grip_of(const PreparedPart& p, const SolvedFeature& f,
                    const OperationModel& o) {
  const std::size_t s = f.task.making.setup;
  const bool eased = o.finishing && f.task.feature.kind() != Feature::Kind::end_face &&
                     has_finishing_force(p, s);
  return grip_name(eased ? kEasedGrip : kGrip, s);
}

}  // namespace

std::vector<Limit> limits(const PreparedPart& p) {
  std::vector<Limit> all;
  add_tolerances(p, all);
  const auto& d = p.drawing;
  add_roughness(d.outer, &part::Drawing::outer, all);
  add_roughness(d.inner, &part::Drawing::inner, all);
  add_roughness(d.faces, &part::Drawing::faces, all);
  add_machine(p, all);
  add_tools(p, all);
  return all;
}

double most_power_kW(const std::vector<CurvePoint>& curve) {
  double most = 0;
  for (const auto& point : curve) most = std::max(most, point.P_kW);
  return most;
}

std::vector<std::string> spindle_limit_names(const PreparedPart& p,
                                             const SolvedFeature& f,
                                             std::size_t operation) {
  const auto& o = f.answer.model->chain().operations[operation];
  return {of("largest spindle speed", p.machine.id), "largest speed of the chuck",
          grip_of(p, f, o)};
}

std::vector<std::string> limit_names(const PreparedPart& p, const SolvedFeature& f,
                                     const Row& row) {
  const auto& chain = f.answer.model->chain();
  if (row.check == Check::tolerance)
    return {p.drawing.tolerances[chain.functionals[row.operation].tolerance].id};
  const auto& o = chain.operations[row.operation];
  for (const auto& l : kToolLimits)
    if (row.check == l.check) return {of(l.what, o.tool->id)};
  const auto& surface = f.task.feature.surface();
  switch (row.check) {
    case Check::force:
      return {of("cutting force", o.tool->id)};
    case Check::feed_force:
      return {of("feed force", p.machine.id)};
    case Check::power:
    case Check::torque:
      return {of(kPower, p.machine.id)};
    case Check::spindle_min:
      return {of("least spindle speed", p.machine.id)};
    case Check::spindle_max:
      return spindle_limit_names(p, f, row.operation);
    case Check::grip:
      return {grip_of(p, f, o)};
    case Check::chatter:
      return {of(kDampingRatio, p.machine.id), of(kDampingRatio, o.tool->id)};
    case Check::Ra:
      return {of("roughness Ra", surface)};
    case Check::Rz:
      return {of("roughness Rz", surface)};
    default:
      return {};
  }
}

}  // namespace turnwright::planning
