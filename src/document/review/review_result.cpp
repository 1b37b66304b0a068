#include <algorithm>
#include <cmath>

#include "turnwright/document/process_plan.hpp"
#include "turnwright/document/review.hpp"

namespace turnwright::document {
namespace {

using nlohmann::ordered_json;
using planning::Spending;
using review::Cut;
using review::ReviewedSetup;

constexpr double kKept = 0.01;  // a limit that is passed by less counts as kept

ordered_json limit_json(const planning::ConstraintValue& c) {
  return {{"name", c.name},   {"unit", c.unit},       {"value", c.value},
          {"limit", c.limit}, {"at_most", c.at_most}, {"kept", c.margin >= -kKept}};
}

ordered_json pass_json(const review::PassCut& p) {
  return {{"line", p.line},
          {"ap_mm", p.ap_mm},
          {"largest_mm", p.most_mm},
          {"largest_line", p.most_line},
          {"diameters_mm", {2 * p.x_from_mm, 2 * p.x_to_mm}},
          {"length_mm", p.length_mm},
          {"time_min", p.time_min}};
}

ordered_json cut_json(const Cut& c) {
  ordered_json out{{"on", c.on},
                   {"kind", planning::name(c.kind)},
                   {"tool", review::label(c.tool_id, c.size_mm)},
                   {"number", c.tool},
                   {"f_mm_rev", c.at.f_mm_rev},
                   {"vc_m_min", c.loads.vc_m_min},
                   {"n_rpm", c.loads.n_rpm},
                   {"Fc_N", c.loads.Fc_N},
                   {"Ff_N", c.loads.Ff_N},
                   {"Fp_N", c.loads.Fp_N},
                   {"Pc_kW", c.loads.Pc_kW},
                   {"T_min", c.loads.T_min},
                   {"largest_Fc_N", c.most_Fc_N},
                   {"edges", c.edges},
                   {"passes", ordered_json::array()},
                   {"limits", ordered_json::array()}};
  for (const auto& p : c.passes) out["passes"].push_back(pass_json(p));
  for (const auto& l : c.limits) out["limits"].push_back(limit_json(l));
  return out;
}

// What a setup's program and its edges take.
Spending spent(const ReviewedSetup& s, double machine_per_min) {
  const double min = s.minutes.total() + s.edge_min;
  return {min, machine_per_min * min + s.edge_cost};
}

// The same of a plan's setup.
Spending spent(const planning::Breakdown& b) {
  Spending sum;
  for (const auto& s : {b.cutting, b.air, b.tool_changes, b.edges}) sum += s;
  return sum;
}

// And of all programs.
Spending spent(const review::Review& review, double machine_per_min) {
  Spending sum;
  for (const auto& s : review.setups) sum += spent(s, machine_per_min);
  return sum;
}

ordered_json json_of(const Spending& s) {
  return {{"time_min", s.time_min}, {"cost", s.cost}};
}

ordered_json setup_json(const ReviewedSetup& s, double machine_per_min) {
  ordered_json out{{"setup", s.setup},
                   {"cuts", ordered_json::array()},
                   {"minutes",
                    {{"cutting", s.minutes.cutting},
                     {"air", s.minutes.air},
                     {"tool_changes", s.minutes.tool_changes},
                     {"edges", s.edge_min}}},
                   {"stops", s.stops},
                   {"spent", json_of(spent(s, machine_per_min))},
                   {"rapids_in_material", ordered_json::array()},
                   {"unknown", ordered_json::array()},
                   {"taken", s.assumed}};
  for (const auto& c : s.cuts) out["cuts"].push_back(cut_json(c));
  for (const auto& r : s.rapids)
    out["rapids_in_material"].push_back({{"line", r.line}, {"mm", r.mm}});
  for (const auto& u : s.unknown)
    out["unknown"].push_back({{"line", u.line}, {"what", u.what}, {"why", u.why}});
  return out;
}

// How far a size lies beyond its limits.
double beyond_mm(const review::MadeSize& s) {
  if (!s.limits) return 0;
  const double off = s.diameter_mm - s.nominal_mm;
  return std::max({0.0, off - s.limits->upper_mm, s.limits->lower_mm - off});
}

ordered_json size_json(const review::MadeSize& s) {
  ordered_json out{{"on", s.on},
                   {"setup", s.setup},
                   {"diameter_mm", s.diameter_mm},
                   {"nominal_mm", s.nominal_mm}};
  if (s.limits)
    out["allowed_mm"] = {s.nominal_mm + s.limits->lower_mm,
                         s.nominal_mm + s.limits->upper_mm};
  out["beyond_mm"] = beyond_mm(s);
  return out;
}

bool all_kept(const review::Review& review) {
  const auto kept = [](const ReviewedSetup& s) {
    return s.rapids.empty() && std::ranges::all_of(s.cuts, [](const Cut& c) {
             return std::ranges::all_of(c.limits,
                                        [](const auto& l) { return l.margin >= -kKept; });
           });
  };
  return std::ranges::all_of(review.setups, kept);
}

// What the plan takes for the setups that were reviewed, and what it would save.
ordered_json compared(const review::Review& review, const planning::ProcessPlan& plan,
                      double machine_per_min) {
  const auto programs = spent(review, machine_per_min);
  Spending planned;
  for (const auto& s : review.setups) planned += spent(plan.setups[s.setup].breakdown);
  return {
      {"spent", json_of(planned)},
      {"saves",
       json_of({programs.time_min - planned.time_min, programs.cost - planned.cost})},
      {"cost_per_part", plan.cost_per_part},
      {"time_per_part_min", plan.time_per_part_min},
      {"lower_bound", plan.certificate.lower_bound},
      {"certificate",
       plan.certificate.kind == planning::CertificateKind::global ? "global" : "none"}};
}

// Tolerances, and the limits of the programs' operations that are not kept, chatter among
// them.
ordered_json predicted_json(const planning::ProcessPlan& predicted) {
  ordered_json out{{"tolerances", to_json(predicted, {})["tolerances"]},
                   {"limits", ordered_json::array()},
                   {"cost_per_part", predicted.cost_per_part},
                   {"time_per_part_min", predicted.time_per_part_min}};
  for (const auto& s : predicted.setups)
    for (const auto& o : s.operations)
      for (const auto& c : o.constraints) {
        if (c.margin >= -kKept) continue;
        ordered_json limit{{"operation", o.id}};
        limit.update(limit_json(c));
        out["limits"].push_back(std::move(limit));
      }
  return out;
}

bool limits_kept(const planning::ProcessPlan& predicted) {
  return std::ranges::all_of(predicted.setups, [](const auto& s) {
    return std::ranges::all_of(s.operations, [](const auto& o) {
      return std::ranges::all_of(o.constraints,
                                 [](const auto& c) { return c.margin >= -kKept; });
    });
  });
}

bool tolerances_kept(const planning::ProcessPlan& predicted) {
  return std::ranges::none_of(predicted.tolerances, [](auto& t) {
    return t.verdict == planning::Verdict::not_met;
  });
}

const char* status(const review::Review& review, const ReviewedPlan& plan) {
  const bool kept = all_kept(review) &&
                    (!plan.predicted ||
                     (tolerances_kept(*plan.predicted) && limits_kept(*plan.predicted)));
  return kept ? "kept" : "not-kept";
}

ordered_json text_json(std::size_t setup, const review::CorrectedText& t) {
  ordered_json out{{"setup", setup}, {"words", ordered_json::array()}, {"text", t.text}};
  for (const auto& w : t.words)
    out["words"].push_back({{"line", w.line}, {"was", w.was}, {"is", w.is}});
  return out;
}

void add_corrected(ordered_json& out, const ReviewRequest& request,
                   const review::Review& review, const CorrectedPrograms& corrected,
                   double machine_per_min) {
  out["not_corrected"] = corrected.cannot;
  if (!corrected.cannot.empty()) return;
  const auto takes = spent(corrected.review, machine_per_min);
  const auto took = spent(review, machine_per_min);
  ordered_json all{
      {"status", status(corrected.review, corrected.plan)},
      {"spent", json_of(takes)},
      {"saves", json_of({took.time_min - takes.time_min, took.cost - takes.cost})},
      {"programs", ordered_json::array()}};
  for (std::size_t i = 0; i < corrected.texts.size(); ++i)
    all["programs"].push_back(text_json(request.programs[i].setup, corrected.texts[i]));
  if (corrected.plan.predicted)
    all["predicted"] = predicted_json(*corrected.plan.predicted);
  out["corrected"] = std::move(all);
}

}  // namespace

ordered_json review_result(const ReviewRequest& request, const PreparedDocument& document,
                           const ReviewInput& input, const review::Review& review,
                           const ReviewedPlan& plan,
                           const std::optional<CorrectedPrograms>& corrected) {
  const double rate = document.part.machine_per_min;
  ordered_json out{{"name", document.part.drawing.name},
                   {"control", gcode::dialect(request.control).id},
                   {"status", status(review, plan)},
                   {"tools", ordered_json::array()},
                   {"setups", ordered_json::array()},
                   {"sizes", ordered_json::array()}};
  for (const auto& t : input.tools)
    out["tools"].push_back(
        {{"number", t.number}, {"tool", review::label(review::id(t), t.size_mm)}});
  for (const auto& s : review.setups) out["setups"].push_back(setup_json(s, rate));
  for (const auto& s : review.sizes) out["sizes"].push_back(size_json(s));
  if (plan.predicted) out["predicted"] = predicted_json(*plan.predicted);
  out["not_predicted"] = plan.cannot;
  if (plan.plan.status == planning::PlanStatus::ok)
    out["plan"] = compared(review, plan.plan, rate);
  if (corrected) add_corrected(out, request, review, *corrected, rate);
  out["assumed"] = to_json(document.assumed);
  return out;
}

}  // namespace turnwright::document
