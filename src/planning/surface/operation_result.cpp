#include "operation_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "planning/limits/limit_table.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::planning {
namespace {

constexpr double kBinding = 1e-6;  // ln: closer than any machine can tell

struct Chosen {
  const Chain& chain;
  const Choice<double>& c;
  std::array<cutting::Forces<double>, 2> F;
  double cap_rpm(std::size_t i) const {
    const auto& o = chain.operations[i];
    return spindle_cap(o, limiting_forces(o, c.f[i], c.a), c.a);
  }
};

cutting::Duty<double> duty_of(const Chosen& x, std::size_t i) {
  const auto& o = x.chain.operations[i];
  const double life =
      cutting::tool_life_min(o.cut, x.c.v[i], x.c.f[i], o.depth_mm(x.c.a));
  return duty(o, x.c.v[i], x.c.f[i], x.c.a, x.cap_rpm(i), life);
}

std::vector<Pass> passes(const Chosen& x, std::size_t i) {
  const auto& o = x.chain.operations[i];
  const double v = x.c.v[i], f = x.c.f[i], ap = o.depth_mm(x.c.a);
  const double n_cap = x.cap_rpm(i);
  const double life = cutting::tool_life_min(o.cut, v, f, ap);
  std::vector<Pass> all;
  for (const auto& p : o.passes) {
    const auto s = sweep(o, p, x.c.a);
    Pass pass;
    pass.ap_mm = ap;
    pass.f_mm_rev = f;
    pass.vc_m_min = v;
    pass.n_rpm = std::min(n_cap, units::spindle_rpm(v, s.D_large_mm));
    pass.time_min = cutting::duty(s, v, f, life, n_cap, o.cut.taylor.n).time_min;
    pass.Fc_N = x.F[i].Fc_N;
    pass.Ff_N = x.F[i].Ff_N;
    pass.Fp_N = x.F[i].Fp_N;
    pass.Pc_kW = units::power_kW(x.F[i].Fc_N, v);
    pass.T_min = life;
    all.push_back(pass);
  }
  return all;
}

ConstraintValue priced(ConstraintValue c, double multiplier) {
  c.shadow_price = multiplier;
  return c;
}

// Chatter stiffness at conditions, K_ww and where the edge yields along the feed K_zz too,
// against the largest that part and tool allow.  `limit_N_mm` is that of K_ww alone.
ConstraintValue chatter(const Chosen& x, std::size_t i, double limit_N_mm) {
  const auto& limit = limit_row(Check::chatter);
  ConstraintValue c;
  c.name = limit.name;
  c.unit = limit.unit;
  const auto& o = x.chain.operations[i];
  const double f = x.c.f[i], a = x.c.a;
  const double gain = chatter_gain(o, f, a, 1 / limit_N_mm);
  if (o.chatter_zz_mm_N > 0) {
    const auto K = cutting::chatter_stiffnesses_N_mm(o.cut, o.depth_mm(a), f);
    c.value = std::max(K.ww, -o.chatter_inwards * K.ww) + K.zz;
  } else {
    c.value = gain * limit_N_mm;
  }
  c.limit = c.value / std::max(gain, 1e-300);
  c.margin = -std::log(std::max(gain, 1e-300));
  c.binding = c.margin < kBinding;
  return c;
}

// One line per check: the tightest row, with the sum of the rows' prices.
void merge(std::vector<ConstraintValue>& all, const ConstraintValue& c) {
  const auto it = std::find_if(
      all.begin(), all.end(), [&](const ConstraintValue& o) { return o.name == c.name; });
  if (it == all.end()) {
    all.push_back(c);
    return;
  }
  const double price = it->shadow_price + c.shadow_price;
  if (c.margin < it->margin) *it = c;
  it->shadow_price = price;
}

// A tolerance as constraint: the error of the whole surface against the cut's room.
ConstraintValue tolerance_constraint(const PreparedPart& plan, const CutTolerance& d,
                                     const tolerance::PiecewisePolynomial& e,
                                     double price) {
  ConstraintValue c;
  const auto& t = plan.drawing.tolerances[d.tolerance];
  c.name = t.id + " " + part::name(t.kind);
  c.unit = "mm";
  c.limit = d.upper;
  const double excess = worst_excess({d}, e);
  c.value = d.upper * (1 + excess);
  c.margin = -std::log(std::max(1 + excess, 1e-300));
  c.binding = c.margin < kBinding;
  c.shadow_price = price;
  return c;
}

// "s1-face-d3-d4": an id that a request may carry.
std::string own_id(std::size_t setup, OperationKind kind, std::string surface) {
  std::replace(surface.begin(), surface.end(), '|', '-');
  return fmt::format("s{}-{}-{}", setup + 1, name(kind), surface);
}

OperationKind kind_of(const MachinedSurface& feature, bool rough) {
  if (feature.is_face()) return OperationKind::face;
  if (feature.kind() == MachinedSurface::Kind::bore)
    return rough ? OperationKind::bore_rough : OperationKind::bore_finish;
  return rough ? OperationKind::rough : OperationKind::finish;
}

}  // namespace

std::string row_name(const PreparedPart& plan, const Chain& chain, const Row& row) {
  if (row.check == Check::spindle_max && chain.operations[row.operation].n_cap_of_grip)
    return to_translate("spindle speed that leaves a third of the grip");
  if (row.check != Check::tolerance) return limit_row(row.check).name;
  const auto& t = plan.drawing.tolerances[chain.functionals[row.operation].tolerance];
  return t.id + " " + part::name(t.kind);
}

ConstraintValue constraint(const PreparedPart& plan, const Chain& chain,
                           const Choice<double>& choice, const RowValue& r) {
  const auto& limit = limit_row(r.row.check);
  ConstraintValue c;
  c.name = row_name(plan, chain, r.row);
  c.unit = limit.unit;
  c.at_most = limit.at_most();
  c.value = c.at_most ? r.value : r.limit;
  c.limit = c.at_most ? r.limit : r.value;
  if (r.row.check == Check::power || r.row.check == Check::torque) {  // from their share
    const auto& o = chain.operations[r.row.operation];
    const double Fc = limiting_forces(o, choice.f[r.row.operation], choice.a).Fc_N;
    c.value =
        r.row.check == Check::power
            ? units::power_kW(Fc, choice.v[r.row.operation])
            : units::torque_Nm(Fc, limiting_sweep(o, o.widest(), choice.a).D_large_mm);
    c.limit = c.value / (r.value / r.limit);
  }
  c.margin = -violation(r);
  if (r.row.check == Check::chatter) {
    double most = 0;
    for (const auto& place : chain.operations[r.row.operation].chatter_mm_N)
      most = std::max(most, place(choice.a));
    return chatter({chain, choice, forces(chain, choice)}, r.row.operation, 1 / most);
  }
  c.binding = c.margin < kBinding;
  return c;
}

ConstraintValue constraint(Check check, double value, double limit) {
  const auto& row = limit_row(check);
  ConstraintValue c{row.name, row.unit, value, limit, row.at_most()};
  c.margin = (c.at_most ? -1 : 1) * std::log(value / limit);
  c.binding = c.margin < kBinding;
  return c;
}

Spent spent(const SurfaceAnswer& answer) {
  const Chosen x{answer.model->chain(), answer.choice,
                 forces(answer.model->chain(), answer.choice)};
  Spent s;
  for (std::size_t i = 0; i < x.chain.operations.size(); ++i) {
    const auto d = duty_of(x, i);
    const auto& o = x.chain.operations[i];
    const auto& tool = *o.tool;
    s.cut_min += d.time_min;
    s.air_min += air_min(o, d, answer.choice.a);
    s.change_min += tool.change_min * d.edges;
    s.edges_cost += tool.edge_cost * d.edges;
  }
  return s;
}

std::vector<OperationPlan> operation_results(const PreparedPart& plan, std::size_t setup,
                                             const SolvedSurface& solved,
                                             const Rates& rates) {
  const auto& a = solved.answer;
  const Chosen x{a.model->chain(), a.choice, forces(a.model->chain(), a.choice)};
  const auto& feature = solved.task.feature;
  const auto values = a.model->values(a.choice);
  const auto chatter_limits = feature.chatter_limits_N_mm(x.chain, a.choice.a);
  std::vector<OperationPlan> all;
  for (std::size_t i = 0; i < x.chain.operations.size(); ++i) {
    const auto& o = x.chain.operations[i];
    const bool last = i + 1 == x.chain.operations.size();
    const bool rough = a.model->recipe().rough && i == 0;
    OperationPlan p;
    p.kind = kind_of(feature, rough);
    p.id = i < solved.operation_ids.size() ? solved.operation_ids[i]
                                           : own_id(setup, p.kind, feature.surface());
    p.on = {feature.surface()};
    p.tool = o.tool->id;
    p.direction =
        rough ? feature.fixed().rough_direction : feature.fixed().finish_direction;
    p.passes = passes(x, i);
    const auto d = duty_of(x, i);
    p.time_min = d.time_min;
    p.edges = d.edges;
    p.cost = rates.machine_per_min *
                 (d.time_min + air_min(o, d, a.choice.a) + o.tool->change_min * d.edges) +
             o.tool->edge_cost * d.edges;
    std::map<std::size_t, double> tolerance_price;
    for (std::size_t r = 0; r < values.size(); ++r) {
      if (values[r].row.check == Check::tolerance)
        tolerance_price[x.chain.functionals[values[r].row.operation].tolerance] +=
            a.multipliers[r];
      else if (values[r].row.operation == i)
        merge(p.constraints,
              priced(constraint(plan, x.chain, a.choice, values[r]), a.multipliers[r]));
    }
    if (o.chatter_mm_N.empty()) p.constraints.push_back(chatter(x, i, chatter_limits[i]));
    if (last)
      for (const auto& cut_tolerance : solved.task.cut_tolerances)
        if (cut_tolerance.shape != CutTolerance::Shape::none)
          p.constraints.push_back(tolerance_constraint(
              plan, cut_tolerance, a.profile, tolerance_price[cut_tolerance.tolerance]));
    p.certificate = a.certificate;
    all.push_back(std::move(p));
  }
  return all;
}

}  // namespace turnwright::planning
