#include "turnwright/document/process_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../schema_check.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::document::process_plan_test {
namespace {

using nlohmann::ordered_json;
using namespace planning;

// Every list has one member and every field its own value.
ProcessPlan every_field() {
  ProcessPlan p;
  p.cost_per_part = 1.5;
  p.time_per_part_min = 2.5;
  p.profit_per_min = 3.5;
  p.setting_up = {40, 48, 0.4, {}};
  p.worst_conformance = WorstConformance{"d1:diameter", 0.99, 0.9973};
  p.certificate = {CertificateKind::global, 1.4, 0.06, 7, "convex", ""};
  OperationPlan op;
  op.id = "rough d1";
  op.kind = OperationKind::rough;
  op.on = {"d1", "c1"};
  op.tool = "T1";
  op.direction = Direction::from_chuck;
  op.passes = {{1, 2, 3, 4, 5, 6, 7, 8, 9, 10}};
  op.time_min = 11;
  op.cost = 12;
  op.constraints = {{"power", "kW", 13, 14, true, 15, true, 16}};
  op.certificate = {CertificateKind::local, 17, 18, 19, "branch-and-bound", "budget"};
  SetupPlan setup;
  setup.hold = part::End::right;
  setup.clamping = Clamping::chuck_tailstock;
  setup.grip_force_N = 60000;
  setup.finishing_grip_force_N = 15000;
  setup.rejected = {{Clamping::chuck, "dearer", 20},
                    {Clamping::between_centres, "no", {}}};
  setup.rejected_tools = {{"T2", "facing", "dear", 2.5},
                          {"T3", "boring, rough", "no", {}}};
  setup.operations = {op};
  p.setups = {setup};
  ToleranceResult size;
  size.id = "d1:diameter";
  size.of = "d1";
  size.predicted_mm = {-0.01, 0.01};
  size.allowed_mm = {-0.02, 0.02};
  size.margin_mm = 0.01;
  size.width_mm = 0.05;
  size.verdict = Verdict::met_with_offset;
  size.published_verdict = false;
  size.shares = {{"deflection", 21}};
  size.P_conform = 0.99;
  ToleranceResult form = size;
  form.kind = part::ToleranceKind::total_radial_runout;
  form.predicted_mm = {0.004};
  form.allowed_mm = {0.01};
  form.verdict = Verdict::not_met;
  p.tolerances = {size, form};
  p.deviations = {{"d1", 1, {{22, 0.5}, {24, 0.25}}}};
  p.breakdown.cutting = {41, 42};
  p.offsets = {{"d1", 1, -0.004}};
  p.compensation = {{"d1", 1, {{22, 23}, {24, 25}}}};
  p.prices = {{"d1: diameter", 26, "mm", 27, 270, {"op1"}, "saves"}};
  p.conflicts = {{"t1", "op1", 28, 29, "mm", "clash", 1},
                 {"setups", "all setups", 0, 0, "", "no"}};
  p.relax = {{"t1", 30, 31, "mm", "open", 1}, {"t2", 32, 33, "mm", "wider"}};
  using Kind = RequestChange::Kind;
  const RequestChange steady{.kind = Kind::clamping,
                             .setup = 1,
                             .clamping = Clamping::chuck_steady,
                             .steady_mm = 34};
  const RequestChange grip{.kind = Kind::grip, .setup = 2, .grip_mm = 37};
  const RequestChange passes{.kind = Kind::operation, .name = "op2", .key = "passes"};
  p.remedies = {{{steady}, "steady", 35, 36}, {{grip, passes}, "both", 38, 39}};
  p.tried = {{{.kind = Kind::tool, .name = "T4"}, "the tool T4"}};
  return p;
}

const std::vector<Assumption> kAssumed{{"/batch", 1, "default"}};

TEST(ProcessPlan, EveryFieldHasItsKeyInTheOrderOfTheInterface) {
  EXPECT_EQ(
      to_json(every_field(), kAssumed).dump(),
      R"({"status":"ok","cost_per_part":1.5,"time_per_part_min":2.5,"breakdown":{)"
      R"("cutting":{"time_min":41.0,"cost":42.0},"air":{"time_min":0.0,"cost":0.0},)"
      R"("tool_changes":{"time_min":0.0,"cost":0.0},)"
      R"("operator_stops":{"time_min":0.0,"cost":0.0},"edges":{"time_min":0.0,"cost":0.0},)"
      R"("loading":{"time_min":0.0,"cost":0.0},"setup_share":{"time_min":0.0,"cost":0.0}},)"
      R"("profit_per_min":3.5,)"
      R"("setting_up":{"min":40.0,"cost":48.0,"min_per_part":0.4,"cost_per_part":null},)"
      R"("worst_conformance":{"tolerance":"d1:diameter","P_conform":0.99,"wanted":0.9973},)"
      R"("certificate":{"kind":"global","lower_bound":1.4,"gap":0.06,"nodes":7,)"
      R"("engine":"convex"},)"
      R"("setups":[{"hold":"right","clamping":"chuck-tailstock",)"
      R"("grip_force_N":60000.0,"finishing_grip_force_N":15000.0,"rejected":[)"
      R"({"clamping":"chuck","why":"dearer","cost":20.0},)"
      R"({"clamping":"between-centres","why":"no"}],)"
      R"("rejected_tools":[{"tool":"T2","use":"facing","why":"dear","at_least":2.5},)"
      R"({"tool":"T3","use":"boring, rough","why":"no"}],)"
      R"("operations":[{"id":"rough d1","kind":"rough","on":["d1","c1"],"tool":"T1",)"
      R"("direction":"from-chuck","passes":[{"ap_mm":1.0,"f_mm_rev":2.0,"vc_m_min":3.0,)"
      R"("n_rpm":4.0,"time_min":5.0,"Fc_N":6.0,"Ff_N":7.0,"Fp_N":8.0,"Pc_kW":9.0,)"
      R"("T_min":10.0}],"time_min":11.0,"cost":12.0,"constraints":[{"name":"power",)"
      R"("value":13.0,"limit":14.0,"unit":"kW","at_most":true,"margin":15.0,)"
      R"("binding":true,"shadow_price":16.0}],"certificate":{"kind":"local",)"
      R"("lower_bound":17.0,"gap":18.0,"nodes":19,"engine":"branch-and-bound",)"
      R"("reason":"budget"}}]}],)"
      R"("tolerances":[{"id":"d1:diameter","kind":"diameter","of":"d1",)"
      R"("predicted_mm":[-0.01,0.01],"allowed_mm":[-0.02,0.02],"margin_mm":0.01,)"
      R"("width_mm":0.05,"verdict":"met-with-offset","published_verdict":false,"shares":[)"
      R"({"source":"deflection","um":21.0}],"P_conform":0.99},)"
      R"({"id":"d1:diameter","kind":"total-radial-runout","of":"d1",)"
      R"("predicted_mm":0.004,"allowed_mm":0.01,"margin_mm":0.01,"width_mm":0.05,)"
      R"("verdict":"not-met","published_verdict":false,"shares":[{"source":"deflection","um":21.0}],)"
      R"("P_conform":0.99}],)"
      R"("deviations":[{"on":"d1","setup":1,"table_mm":[[22.0,0.5],[24.0,0.25]]}],)"
      R"("offsets":[{"on":"d1","setup":1,"offset_mm":-0.004}],)"
      R"("compensation":[{"on":"d1","setup":1,"table_mm":[[22.0,23.0],[24.0,25.0]]}],)"
      R"("prices":[{"limit":"d1: diameter","now":26.0,"unit":"mm",)"
      R"("saves_per_part_for_10_percent":27.0,"saves_per_batch_for_10_percent":270.0,)"
      R"("binds_in":["op1"],"sentence":"saves"}],)"
      R"("conflicts":[{"limit":"t1","where":"op1","value":28.0,"allowed":29.0,)"
      R"("unit":"mm","sentence":"clash","set":1},)"
      R"({"limit":"setups","where":"all setups","value":0.0,"allowed":0.0,)"
      R"("unit":"","sentence":"no"}],)"
      R"("relax":[{"limit":"t1","now":30.0,"needed":31.0,"unit":"mm",)"
      R"("sentence":"open","set":1},)"
      R"({"limit":"t2","now":32.0,"needed":33.0,"unit":"mm","sentence":"wider"}],)"
      R"("remedies":[{"change":"clamping","setup":1,"clamping":"chuck-steady",)"
      R"("steady_mm":34.0,"sentence":"steady","cost_per_part":35.0,)"
      R"("time_per_part_min":36.0},)"
      R"({"change":"grip","setup":2,"grip_mm":37.0,"together_with":)"
      R"({"change":"operation","operation":"op2","leave":"passes"},"sentence":"both",)"
      R"("cost_per_part":38.0,"time_per_part_min":39.0}],)"
      R"("tried":[{"change":"tool","tool":"T4","sentence":"the tool T4"}],)"
      R"("assumed":[{"pointer":"/batch","value":1,"why":"default"}]})");
}

TEST(ProcessPlan, TheResultNamesItsPart) {
  const SchemaCheck schema("plan.result.json");
  PreparedDocument document;
  document.part.drawing.name = "Shaft";
  document.part.drawing.title = {"4711-02", "", "Works"};
  document.assumed = kAssumed;
  auto result = plan_result(every_field(), document);
  EXPECT_EQ(schema.fault(result), "");
  EXPECT_EQ(result["name"], "Shaft");
  EXPECT_EQ(result["drawing_number"], "4711-02");
  EXPECT_FALSE(result.contains("revision"));
  EXPECT_EQ(result["customer"], "Works");
  for (const char* key : {"name", "drawing_number", "customer"}) result.erase(key);
  EXPECT_EQ(result, to_json(every_field(), kAssumed));
}

TEST(ProcessPlan, TheSchemaTakesWhatIsWritten) {
  const SchemaCheck schema("plan.result.json");
  EXPECT_EQ(schema.fault(to_json(every_field(), kAssumed)), "");
  EXPECT_EQ(schema.fault(to_json({}, {})), "");
  auto infeasible = every_field();
  infeasible.status = PlanStatus::infeasible;
  infeasible.profit_per_min.reset();
  const auto json = to_json(infeasible, {});
  EXPECT_EQ(json["status"], "infeasible");
  EXPECT_FALSE(json.contains("profit_per_min"));
  EXPECT_EQ(schema.fault(json), "");
  for (const auto& [key, value] : json.items()) {
    // There where something would help, or where there is a plan.
    if (key == "remedies" || key == "tried" || key == "breakdown" ||
        key == "setting_up" || key == "worst_conformance")
      continue;
    auto without = json;
    without.erase(key);
    EXPECT_NE(schema.fault(without), "") << key;
  }
}

TEST(ProcessPlan, NumbersComeBackToTheLastBit) {
  auto plan = every_field();
  plan.cost_per_part = 0.1 + 0.2;
  plan.time_per_part_min = std::nextafter(1.0, 2.0);
  const auto back = ordered_json::parse(to_json(plan, {}).dump());
  EXPECT_EQ(back["cost_per_part"].get<double>(), plan.cost_per_part);
  EXPECT_EQ(back["time_per_part_min"].get<double>(), plan.time_per_part_min);
}

TEST(ProcessPlan, ANumberThatIsNoneIsABrokenPromise) {
  auto plan = every_field();
  plan.setups[0].operations[0].passes[0].T_min = std::numeric_limits<double>::infinity();
  try {
    to_json(plan, {});
    FAIL() << "written";
  } catch (const ModelRangeError& error) {
    EXPECT_STREQ(error.what(),
                 "process plan/setups/0/operations/0/passes/0/T_min: the result is "
                 "not a finite number, so the request is outside the model's range");
  }
  plan = every_field();
  plan.tolerances[1].predicted_mm = {std::nan("")};
  EXPECT_THROW(to_json(plan, {}), ModelRangeError);
}

}  // namespace
}  // namespace turnwright::document::process_plan_test
