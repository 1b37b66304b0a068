#include "loads.hpp"

#include <algorithm>
#include <cmath>

#include "planning/clamping/clamping_speed.hpp"
#include "planning/clamping/jaws.hpp"
#include "planning/limits/check.hpp"
#include "planning/surface/operation_result.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/cutting/cut.hpp"
#include "turnwright/cutting/fixed.hpp"
#include "turnwright/cutting/spindle.hpp"

namespace turnwright::review {
namespace {

using catalogue::FixedUse;
using planning::Check;
using planning::Clamping;

constexpr double kHeavier = 1.001;        // a pass that is not like those before
constexpr double kLongestLife_min = 1e6;  // longer ones are told as this
constexpr double kAxis_mm = 0.05;         // radii below it count as the axis

// Cutting, feed and passive force of one depth.
using Force = cutting::Forces<double>;

double rpm(const toolpath::Step& s, double x_mm) {
  if (!s.constant_surface_speed) return s.S;
  return std::min(s.n_max_rpm, units::spindle_rpm(s.S, 2 * std::max(x_mm, kAxis_mm)));
}

// A tool with the part's material.
class Edge {
 public:
  Edge(const planning::PreparedPart& part, const MountedTool& tool)
      : material_(part.material), tool_(tool) {
    if (!tool.turning) return;
    cut_ = cutting::cut_of(part.material, *tool.turning);
  }

  bool fixed() const { return tool_.fixed.has_value(); }
  FixedUse use() const { return tool_.fixed->use; }
  bool on_axis() const { return fixed() && catalogue::on_axis(use()); }
  bool drills() const {
    return fixed() && (use() == FixedUse::drilling || use() == FixedUse::centring);
  }
  bool widens() const {
    return fixed() && (use() == FixedUse::reaming || use() == FixedUse::counterboring ||
                       use() == FixedUse::countersinking);
  }

  /// Of a pass at a depth; `D_mm` is its diameter.
  Force force(const PassCut& p, double ap_mm, double f_mm_rev) const {
    if (!fixed()) return cutting::forces_N(cut_, ap_mm, f_mm_rev);
    const auto& t = *tool_.fixed;
    const auto kc = cutting::kienzle_at(material_, t.gamma_deg);
    const auto thrust = catalogue::thrust_of(material_);
    const double D = 2 * p.x_to_mm;
    switch (t.use) {
      case FixedUse::centring:
      case FixedUse::drilling: {
        const auto load = cutting::drill(kc, tool_.size_mm, f_mm_rev, t.point_deg);
        return {load.Fc_N, load.Ff_N, 0};
      }
      case FixedUse::counterboring:
      case FixedUse::countersinking:
      case FixedUse::reaming: {
        const double lead_deg = t.use == FixedUse::reaming ? 45 : t.point_deg / 2;
        const auto load =
            cutting::ream(kc, D, D - 2 * p.most_mm, f_mm_rev, t.edges, lead_deg);
        return {load.Fc_N, load.Ff_N, 0};
      }
      case FixedUse::tapping: {
        const auto load = cutting::tap(kc, D, f_mm_rev, ap_mm, t.lead, t.edges);
        return {load.Fc_N, 0, 0};
      }
      case FixedUse::threading: {
        const auto load =
            cutting::thread_infeed(kc, thrust, p.before_mm, p.before_mm + ap_mm, D);
        return {load.Fc_N, 0, load.Ff_N};
      }
      case FixedUse::grooving:
      case FixedUse::parting: {
        const auto load = cutting::plunge(kc, thrust, ap_mm, f_mm_rev, D);
        return {load.Fc_N, 0, load.Ff_N};
      }
      case FixedUse::knurling:  // its ways are not followed
      case FixedUse::profiling:
        break;
    }
    const auto load = cutting::plunge(kc, thrust, ap_mm, f_mm_rev, D);
    return {load.Fc_N, load.Ff_N, 0};
  }

  double life_min(double vc_m_min, double f_mm_rev, double ap_mm) const {
    if (!fixed())
      return std::min(kLongestLife_min,
                      cutting::tool_life_min(cut_, vc_m_min, f_mm_rev, ap_mm));
    const auto* given = tool_.fixed->conditions_in(material_.group);
    if (!given) return 0;
    const auto at = catalogue::of_size(*given, use(), tool_.size_mm);
    return std::min(kLongestLife_min, catalogue::at(at, vc_m_min, f_mm_rev).T_min);
  }

 private:
  const catalogue::Material& material_;
  const MountedTool& tool_;
  cutting::Cut cut_;
};

// The diameter on which the cutting force has its lever.
double lever_mm(const Edge& edge, const PassCut& p) {
  const double D = 2 * p.x_to_mm;
  return edge.drills() ? D / 2 : edge.widens() ? D - p.most_mm : D;
}

Loads loads_of(const Edge& edge, const Cut& cut, const PassCut& p) {
  Loads l;
  const double D = 2 * p.x_to_mm;
  l.n_rpm = rpm(cut.at, D / 2);
  l.vc_m_min = units::cutting_speed_m_min(l.n_rpm, D);
  const auto F = edge.force(p, p.ap_mm, cut.at.f_mm_rev);
  l.Fc_N = F.Fc_N;
  l.Ff_N = F.Ff_N;
  l.Fp_N = F.Fp_N;
  l.Pc_kW = units::shaft_power_kW(units::torque_Nm(F.Fc_N, lever_mm(edge, p)), l.n_rpm);
  l.T_min = edge.life_min(l.vc_m_min, cut.at.f_mm_rev, p.ap_mm);
  return l;
}

// The limits of one pass, of which the tightest of each name is kept.
class Limits {
 public:
  explicit Limits(std::vector<planning::ConstraintValue>& all) : all_(all) {}
  void add(Check check, double value, double limit) {
    if (!(value > 0 && limit > 0)) return;
    const auto c = planning::constraint(check, value, limit);
    const auto it = std::ranges::find(all_, c.name, &planning::ConstraintValue::name);
    if (it == all_.end())
      all_.push_back(c);
    else if (c.margin < it->margin)
      *it = c;
  }

 private:
  std::vector<planning::ConstraintValue>& all_;
};

// Beside its own surface an edge takes what its corner meets, in the cut of that surface.
bool has_least_depth(const planning::PreparedPart& part, CutOrder order, const Cut& cut,
                     const PassCut& p) {
  const bool meets_blank = order == CutOrder::first && &p == &cut.passes.front() &&
                           !part.drawing.stock.outline.empty();
  return !p.beside && !meets_blank;
}

void add_tool_limits(const catalogue::Tool& t, const PassCut& p, const Loads& l,
                     double f_mm_rev, Limits& limits) {
  limits.add(Check::depth_max, p.ap_mm, t.ap_mm.upper);
  limits.add(Check::feed_min, f_mm_rev, t.f_mm_rev.lower);
  limits.add(Check::feed_max, f_mm_rev, std::min(t.f_mm_rev.upper, 0.8 * t.re_mm));
  limits.add(Check::vc_min, l.vc_m_min, t.vc_m_min.lower);
  limits.add(Check::vc_max, l.vc_m_min, t.vc_m_min.upper);
  limits.add(Check::life_min, l.T_min, t.T_min.lower);
  limits.add(Check::force, l.Fc_N, t.Fc_max_N);
}

void add_machine_limits(const planning::PreparedPart& part, std::size_t setup,
                        const Loads& l, double lever, double D_grip_lever, bool radial,
                        double n_most, Limits& limits) {
  const auto& m = part.machine;
  const auto ranges = cutting::speed_ranges(m);
  const double n = std::clamp(l.n_rpm, ranges.front().n_min_rpm, ranges.back().n_max_rpm);
  const double torque = units::torque_Nm(l.Fc_N, lever);
  limits.add(Check::power, units::shaft_power_kW(torque, n),
             cutting::available_kW(ranges, n, false));
  limits.add(Check::torque, torque,
             cutting::available_kW(ranges, n, true) / units::shaft_power_kW(1, n));
  limits.add(Check::feed_force, l.Ff_N, m.feed_force_max_N);
  limits.add(Check::spindle_min, l.n_rpm, m.n_min_rpm);
  const auto clamping = part.setups[setup].clampings.front();
  limits.add(Check::spindle_max, n_most, planning::clamping_rpm(part, clamping));
  const double force =
      planning::jaw_force_N(part, setup, clamping, planning::Stage::roughing);
  if (!(force > 0)) return;
  const cutting::Grip grip{force, m.chuck.jaw_mass_radius_kg_m, m.chuck.friction,
                           planning::grip_diameter_mm(part, setup, clamping)};
  const double needed =
      cutting::grip_needed_N(grip, l.Fc_N, radial ? 0.0 : l.Ff_N, D_grip_lever);
  limits.add(Check::grip, needed + cutting::grip_loss_N(grip, l.n_rpm), force);
}

}  // namespace

void add_loads(const planning::PreparedPart& part, std::size_t setup,
               const MountedTool& tool, CutOrder order, Cut& cut) {
  const Edge edge(part, tool);
  Limits limits(cut.limits);
  for (const auto& p : cut.passes) {
    const auto l = loads_of(edge, cut, p);
    if (l.Fc_N > kHeavier * cut.loads.Fc_N) cut.loads = l;
    cut.most_Fc_N =
        std::max(cut.most_Fc_N, edge.force(p, p.most_mm, cut.at.f_mm_rev).Fc_N);
    if (l.T_min > 0) cut.edges += p.time_min / l.T_min;
    if (tool.turning && has_least_depth(part, order, cut, p))
      limits.add(Check::depth_min, p.ap_mm, catalogue::least_depth_mm(*tool.turning));
    if (tool.turning) add_tool_limits(*tool.turning, p, l, cut.at.f_mm_rev, limits);
    if (tool.fixed && tool.fixed->Fc_max_N)
      limits.add(Check::force, l.Fc_N, *tool.fixed->Fc_max_N);
    const bool radial = tool.fixed && !edge.on_axis() && l.Fp_N > 0;
    // The cutting force acts on the part where it is thickest: before the cut.
    const bool outside =
        !radial && !edge.on_axis() && !(tool.turning && tool.turning->bar);
    const bool faces = cut.kind == planning::OperationKind::face;
    const double lever = lever_mm(edge, p);
    add_machine_limits(part, setup, l, lever,
                       lever + (outside && !faces ? 2 * p.ap_mm : 0), radial,
                       rpm(cut.at, p.x_from_mm), limits);
  }
}

}  // namespace turnwright::review
