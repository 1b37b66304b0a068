#include "turnwright/document/process_plan.hpp"

#include <string>

#include "document/json/finite.hpp"
#include "title_block.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::document {
namespace {

using nlohmann::ordered_json;
using namespace planning;

const char* word(part::End end) { return end == part::End::left ? "left" : "right"; }

const char* word(PlanStatus status) {
  return status == PlanStatus::ok ? "ok" : "infeasible";
}

const char* word(CertificateKind kind) {
  switch (kind) {
    case CertificateKind::global:
      return "global";
    case CertificateKind::local:
      return "local";
    case CertificateKind::none:
      break;
  }
  return "none";
}

template <class T, class F>
ordered_json list(const std::vector<T>& values, F convert) {
  auto out = ordered_json::array();
  for (const auto& value : values) out.push_back(convert(value));
  return out;
}

ordered_json json_of(const Certificate& c) {
  ordered_json out{{"kind", word(c.kind)},
                   {"lower_bound", c.lower_bound},
                   {"gap", c.gap},
                   {"nodes", c.nodes}};
  if (!c.engine.empty()) out["engine"] = c.engine;
  if (!c.reason.empty()) out["reason"] = c.reason;
  return out;
}

ordered_json json_of(const Pass& p) {
  return {{"ap_mm", p.ap_mm}, {"f_mm_rev", p.f_mm_rev}, {"vc_m_min", p.vc_m_min},
          {"n_rpm", p.n_rpm}, {"time_min", p.time_min}, {"Fc_N", p.Fc_N},
          {"Ff_N", p.Ff_N},   {"Fp_N", p.Fp_N},         {"Pc_kW", p.Pc_kW},
          {"T_min", p.T_min}};
}

ordered_json json_of(const ConstraintValue& c) {
  return {{"name", c.name},       {"value", c.value},
          {"limit", c.limit},     {"unit", c.unit},
          {"at_most", c.at_most}, {"margin", c.margin},
          {"binding", c.binding}, {"shadow_price", c.shadow_price}};
}

ordered_json json_of(const OperatingWindow& w) {
  return {{"percent", w.percent},
          {"vc_m_min", w.vc_m_min},
          {"f_mm_rev", w.f_mm_rev},
          {"limits", w.limits}};
}

// Where the first loss of stability is deeper than the chart there is no limit.
ordered_json json_of(const MilledCut& m) {
  return {{"kind", name(m.kind)},
          {"lanes", m.lanes},
          {"ae_mm", m.ae_mm},
          {"fz_mm", m.fz_mm},
          {"hm_mm", m.hm_mm},
          {"vf_mm_min", m.vf_mm_min},
          {"Kt_MPa", m.Kt_MPa},
          {"Kn_MPa", m.Kn_MPa},
          {"stability_margin", m.depth_margin},
          {"speed_margin", m.speed_margin},
          {"part_share", m.part_share},
          {"limit_mm", m.limit_mm},
          {"shown_mm", m.shown_mm},
          {"chart",
           {{"n_rpm", m.n_rpm},
            {"limit_mm", list(m.limits_mm, [](const std::optional<double>& x) {
               return x ? ordered_json(*x) : ordered_json();
             })}}}};
}

ordered_json json_of(const OperationPlan& op) {
  ordered_json out{
      {"id", op.id},
      {"kind", name(op.kind)},
      {"on", op.on},
      {"tool", op.tool},
      {"direction", name(op.direction)},
      {"passes", list(op.passes, [](const Pass& p) { return json_of(p); })},
      {"time_min", op.time_min},
      {"cost", op.cost},
      {"constraints",
       list(op.constraints, [](const ConstraintValue& c) { return json_of(c); })},
      {"certificate", json_of(op.certificate)}};
  if (op.window) out["window"] = json_of(*op.window);
  if (op.milled) out["milling"] = json_of(*op.milled);
  return out;
}

ordered_json json_of(const RejectedClamping& r) {
  ordered_json out{{"clamping", name(r.clamping)}, {"why", r.why}};
  if (r.cost) out["cost"] = *r.cost;
  return out;
}

ordered_json json_of(const RejectedTool& r) {
  ordered_json out{{"tool", r.tool}, {"use", r.use}, {"why", r.why}};
  if (r.at_least) out["at_least"] = *r.at_least;
  return out;
}

ordered_json json_of(const Spending& s) {
  return {{"time_min", s.time_min}, {"cost", s.cost}};
}

ordered_json json_of(const Breakdown& b) {
  ordered_json out{{"cutting", json_of(b.cutting)},
                   {"air", json_of(b.air)},
                   {"tool_changes", json_of(b.tool_changes)},
                   {"operator_stops", json_of(b.operator_stops)},
                   {"edges", json_of(b.edges)},
                   {"loading", json_of(b.loading)},
                   {"setup_share", json_of(b.setup_share)}};
  if (b.stock.cost > 0) out["stock"] = json_of(b.stock);
  return out;
}

ordered_json json_of(const EdgeSchedule& e) {
  ordered_json out{{"tool", e.tool},
                   {"edges_per_part", e.edges_per_part},
                   {"parts_per_edge", e.parts_per_edge}};
  if (e.edges_per_batch) out["edges_per_batch"] = *e.edges_per_batch;
  out["offsets"] = list(e.offsets, [](const FollowedOffset& o) {
    return ordered_json{
        {"on", o.on},
        {"steps", list(o.steps, [](const OffsetStep& step) {
           return ordered_json{{"after_part", step.after_part}, {"um", step.um}};
         })}};
  });
  return out;
}

ordered_json json_of(const SetupPlan& s) {
  ordered_json out{
      {"hold", word(s.hold)},
      {"clamping", name(s.clamping)},
      {"grip_force_N", s.grip_force_N},
      {"finishing_grip_force_N", s.finishing_grip_force_N},
      {"rejected",
       list(s.rejected, [](const RejectedClamping& r) { return json_of(r); })},
      {"rejected_tools",
       list(s.rejected_tools, [](const RejectedTool& r) { return json_of(r); })},
      {"operations",
       list(s.operations, [](const OperationPlan& op) { return json_of(op); })}};
  if (!s.edges.empty())
    out["edges"] = list(s.edges, [](const EdgeSchedule& e) { return json_of(e); });
  if (s.breakdown.total().time_min > 0) out["breakdown"] = json_of(s.breakdown);
  return out;
}

// A size has [min, max], a form one value.
ordered_json value_or_pair(const std::vector<double>& values) {
  if (values.size() == 1) return values[0];
  return values;
}

ordered_json json_of(const ToleranceResult& t) {
  return {{"id", t.id},
          {"kind", part::name(t.kind)},
          {"of", t.of},
          {"predicted_mm", value_or_pair(t.predicted_mm)},
          {"allowed_mm", value_or_pair(t.allowed_mm)},
          {"margin_mm", t.margin_mm},
          {"width_mm", t.width_mm},
          {"verdict", name(t.verdict)},
          {"published_verdict", t.published_verdict},
          {"shares", list(t.shares,
                          [](const Share& s) {
                            return ordered_json{{"source", s.source}, {"um", s.um}};
                          })},
          {"P_conform", t.P_conform}};
}

ordered_json rows(const Compensation::Table& table) {
  return list(table, [](const std::pair<double, double>& row) {
    return ordered_json::array({row.first, row.second});
  });
}

// The template type is Compensation or Deviation.
template <class Table>
ordered_json json_of_table(const Table& c) {
  return {{"on", c.on}, {"setup", c.setup}, {"table_mm", rows(c.table_mm)}};
}

ordered_json json_of_deviation(const Deviation& d) {
  auto out = json_of_table(d);
  if (!d.at_change_mm.empty()) out["at_change_mm"] = rows(d.at_change_mm);
  return out;
}

ordered_json json_of(const ParetoPoint& x) {
  ordered_json out{{"cost_per_part", x.cost_per_part},
                   {"time_per_part_min", x.time_per_part_min}};
  if (x.minute_worth) out["minute_worth"] = *x.minute_worth;
  return out;
}

ordered_json or_null(const std::optional<double>& x) {
  if (!x) return nullptr;
  return *x;
}

ordered_json json_of(const SettingUp& s) {
  return {{"min", s.minutes},
          {"cost", s.cost},
          {"min_per_part", or_null(s.minutes_per_part)},
          {"cost_per_part", or_null(s.cost_per_part)}};
}

ordered_json json_of(const Price& p) {
  return {{"limit", p.limit},
          {"now", p.now},
          {"unit", p.unit},
          {"saves_per_part_for_10_percent", p.saves_per_part_for_10_percent},
          {"saves_per_batch_for_10_percent", or_null(p.saves_per_batch_for_10_percent)},
          {"binds_in", p.binds_in},
          {"sentence", p.sentence}};
}

ordered_json json_of(const WhatIfAnswer& a) {
  const auto if_planned = [&](double x) {
    return or_null(a.feasible ? std::optional(x) : std::nullopt);
  };
  return {{"name", a.name},
          {"status", word(a.feasible ? PlanStatus::ok : PlanStatus::infeasible)},
          {"cost_per_part", if_planned(a.cost_per_part)},
          {"time_per_part_min", if_planned(a.time_per_part_min)},
          {"saves_per_part", or_null(a.saves_per_part)},
          {"saves_per_batch", or_null(a.saves_per_batch)},
          {"saves_min_per_part", or_null(a.saves_min_per_part)},
          {"first_order_saves_per_part", or_null(a.first_order_saves_per_part)},
          {"sentence", a.sentence}};
}

ordered_json json_of(const Conflict& c) {
  ordered_json out{{"limit", c.limit},     {"where", c.where}, {"value", c.value},
                   {"allowed", c.allowed}, {"unit", c.unit},   {"sentence", c.sentence}};
  if (c.set > 0) out["set"] = c.set;
  return out;
}

ordered_json json_of(const Relaxation& r) {
  ordered_json out{{"limit", r.limit},
                   {"now", r.now},
                   {"needed", r.needed},
                   {"unit", r.unit},
                   {"sentence", r.sentence}};
  if (r.set > 0) out["set"] = r.set;
  return out;
}

ordered_json json_of(const RequestChange& c) {
  using Kind = RequestChange::Kind;
  ordered_json out;
  switch (c.kind) {
    case Kind::clamping:
      out = {{"change", "clamping"}, {"setup", c.setup}, {"clamping", name(c.clamping)}};
      if (c.clamping == Clamping::chuck_steady) out["steady_mm"] = c.steady_mm;
      break;
    case Kind::grip:
      out = {{"change", "grip"}, {"setup", c.setup}, {"grip_mm", c.grip_mm}};
      break;
    case Kind::tool:
      out = {{"change", "tool"}, {"tool", c.name}};
      break;
    case Kind::operation:
      out = {{"change", "operation"}, {"operation", c.name}, {"leave", c.key}};
      break;
  }
  return out;
}

ordered_json json_of(const Remedy& r) {
  auto out = json_of(r.changes.front());
  if (r.changes.size() > 1) out["together_with"] = json_of(r.changes[1]);
  out["sentence"] = r.sentence;
  out["cost_per_part"] = r.cost_per_part;
  out["time_per_part_min"] = r.time_per_part_min;
  return out;
}

ordered_json json_of(const Alternative& a) {
  ordered_json out{{"name", a.name}, {"feasible", a.feasible}, {"chosen", a.chosen}};
  if (a.cost_per_part) out["cost_per_part"] = *a.cost_per_part;
  if (a.time_per_part_min) out["time_per_part_min"] = *a.time_per_part_min;
  if (a.lower_bound) out["lower_bound"] = *a.lower_bound;
  out["sentence"] = a.sentence;
  return out;
}

ordered_json json_of(const TriedChange& t) {
  auto out = json_of(t.change);
  out["sentence"] = t.sentence;
  return out;
}

ordered_json json_of(const Assumption& a) {
  return {{"pointer", a.pointer}, {"value", a.value}, {"why", a.why}};
}

}  // namespace

ordered_json to_json(const std::vector<Assumption>& assumed) {
  return list(assumed, [](const Assumption& a) { return json_of(a); });
}

ordered_json to_json(const ProcessPlan& plan, const std::vector<Assumption>& assumed) {
  const auto if_planned = [&](double x) -> ordered_json {
    if (!(plan.time_per_part_min > 0)) return nullptr;
    return x;
  };
  ordered_json out{{"status", word(plan.status)},
                   {"cost_per_part", if_planned(plan.cost_per_part)},
                   {"time_per_part_min", if_planned(plan.time_per_part_min)}};
  if (plan.time_per_part_min > 0) out["breakdown"] = json_of(plan.breakdown);
  if (plan.profit_per_min) out["profit_per_min"] = *plan.profit_per_min;
  if (plan.time_per_part_min > 0) out["setting_up"] = json_of(plan.setting_up);
  if (const auto& w = plan.worst_conformance)
    out["worst_conformance"] = {
        {"tolerance", w->tolerance}, {"P_conform", w->P_conform}, {"wanted", w->wanted}};
  out["certificate"] = json_of(plan.certificate);
  out["setups"] = list(plan.setups, [](const SetupPlan& s) { return json_of(s); });
  out["tolerances"] =
      list(plan.tolerances, [](const ToleranceResult& t) { return json_of(t); });
  out["deviations"] =
      list(plan.deviations, [](const Deviation& d) { return json_of_deviation(d); });
  out["offsets"] = list(plan.offsets, [](const ToolOffset& o) {
    ordered_json json{{"on", o.on}, {"setup", o.setup}, {"offset_mm", o.offset_mm}};
    if (o.at_change_mm) json["at_change_mm"] = *o.at_change_mm;
    return json;
  });
  out["compensation"] =
      list(plan.compensation, [](const Compensation& c) { return json_of_table(c); });
  if (!plan.pareto.empty())
    out["pareto"] = list(plan.pareto, [](const ParetoPoint& x) { return json_of(x); });
  out["prices"] = list(plan.prices, [](const Price& p) { return json_of(p); });
  if (!plan.what_if.empty())
    out["what_if"] = list(plan.what_if, [](const WhatIfAnswer& a) { return json_of(a); });
  if (!plan.rules.empty())
    out["rules"] = list(plan.rules, [](const WhatIfAnswer& a) {
      auto json = json_of(a);
      json.erase("first_order_saves_per_part");
      return json;
    });
  if (!plan.alternatives.empty())
    out["alternatives"] =
        list(plan.alternatives, [](const Alternative& a) { return json_of(a); });
  out["conflicts"] = list(plan.conflicts, [](const Conflict& c) { return json_of(c); });
  out["relax"] = list(plan.relax, [](const Relaxation& r) { return json_of(r); });
  if (!plan.remedies.empty())
    out["remedies"] = list(plan.remedies, [](const Remedy& r) { return json_of(r); });
  if (!plan.tried.empty())
    out["tried"] = list(plan.tried, [](const TriedChange& t) { return json_of(t); });
  out["assumed"] = to_json(assumed);
  require_finite(out, tr("process plan"));
  return out;
}

ordered_json plan_result(const ProcessPlan& plan, const PreparedDocument& document) {
  auto out = title_block(document.part.drawing);
  if (!document.part.currency.empty()) out["currency"] = document.part.currency;
  out.update(to_json(plan, document.assumed));
  return out;
}

}  // namespace turnwright::document
