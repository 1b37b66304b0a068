#include "report/sheet/setup_sheet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "../../nc/plans.hpp"
#include "report/page/sheet_html.hpp"
#include "turnwright/nc/text.hpp"

namespace turnwright::report::setup_sheet_test {
namespace {

using nc::test::Planned;

// The drilled bush is parted off the bar in the first setup and faced in the second.
struct Sheets {
  Planned planned;
  nc::Programs programs;
  std::vector<SetupSheet> all;
};

Sheets sheets_of(nlohmann::json document) {
  document.erase("what_if");
  Sheets s{nc::test::planned(document), {}, {}};
  s.programs = nc::programs(s.planned.part, s.planned.plan);
  ShopPrograms shop{{}, "G54"};
  for (const auto& p : s.programs.setups)
    shop.files.push_back("program-" + std::to_string(p.setup));
  s.all = setup_sheets(s.planned.part, s.planned.plan, s.programs, shop);
  return s;
}

nlohmann::json bush() {
  auto document = document::parse_file(nc::test::source("parts/drilled-bush.json"));
  document["drawing_number"] = "4711-02";
  document["revision"] = "C";
  document["customer"] = "Gear <Works>";
  return document;
}

const Sheets& bush_sheets() {
  static const Sheets kSheets = sheets_of(bush());
  return kSheets;
}

std::string value(const Entries& all, const std::string& name) {
  const auto found =
      std::ranges::find(all, name, &std::pair<std::string, std::string>::first);
  return found == all.end() ? "" : found->second;
}

TEST(SetupSheet, EverySetupWithAProgramHasOneCountedFromOne) {
  const auto& s = bush_sheets();
  ASSERT_EQ(s.all.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(s.all[i].setup, i + 1);
    EXPECT_EQ(s.all[i].setups, 2u);
    EXPECT_EQ(s.all[i].program, "program-" + std::to_string(i));
  }
}

TEST(SetupSheet, NamesThePartAsItsTitleBlockDoes) {
  const auto& title = bush_sheets().all[0].title;
  EXPECT_EQ(value(title, "Drawing"), "4711-02");
  EXPECT_EQ(value(title, "Revision"), "C");
  EXPECT_EQ(value(title, "Customer"), "Gear <Works>");
  const auto& m = bush_sheets().planned.part.material;
  EXPECT_NE(value(title, "Material").find(m.condition), std::string::npos);
  EXPECT_NE(value(title, "Material").find(" HB"), std::string::npos);
  auto without = bush();
  without.erase("revision");
  EXPECT_EQ(value(sheets_of(without).all[0].title, "Revision"), "");
}

// Bar 50 x 102, 2 mm of it before Z0, 30 mm in the jaws: 72 mm stick out.
TEST(SetupSheet, TellsWhatSticksOutOfTheJaws) {
  const auto& s = bush_sheets();
  EXPECT_EQ(value(s.all[0].clamping, "Stock"), "bar \u00d850 \u00d7 102 mm");
  EXPECT_EQ(value(s.all[0].clamping, "Stick-out"),
            "70.0 mm from the jaws to Z0, 72.0 mm with what is faced off");
  EXPECT_EQ(value(s.all[1].clamping, "Stock"), "the part from setup 1, turned round");
  EXPECT_NE(value(s.all[0].clamping, "Jaws").find("soft"), std::string::npos);
  EXPECT_NE(value(s.all[0].clamping, "Jaws").find("60.0 kN"), std::string::npos);
  EXPECT_EQ(value(s.all[0].clamping, "Support"), "");
}

// The lines of all tools have every operation once, and every edge that the plan changes.
TEST(SetupSheet, ToolsShareTheSetupsOperationsAndItsEdges) {
  const auto& s = bush_sheets();
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& plan = s.planned.plan.setups[i];
    std::size_t operations = 0, edges = 0;
    for (const auto& row : s.all[i].tools) {
      operations += row.operations.size();
      if (!row.edge) continue;
      ++edges;
      EXPECT_EQ(row.edge->tool, row.id);
    }
    EXPECT_EQ(operations, plan.operations.size());
    EXPECT_EQ(edges, plan.edges.size());
  }
}

TEST(SetupSheet, NumbersAreTheShops) {
  auto programs = bush_sheets().programs;
  const auto& planned = bush_sheets().planned;
  nc::number_tools(programs.setups, {.tools = {{"PCLNL-CNMG120408-PM", 7, 17}}});
  const auto sheet =
      setup_sheets(planned.part, planned.plan, programs, {{"a", "b"}, "G55"})[0];
  const auto row = std::ranges::find(sheet.tools, "PCLNL-CNMG120408-PM", &ToolRow::id);
  ASSERT_NE(row, sheet.tools.end());
  EXPECT_EQ(row->number, 7);
  EXPECT_EQ(row->offset, 17);
  EXPECT_TRUE(value(sheet.clamping, "Zero").starts_with("G55: X on"));
}

TEST(SetupSheet, OnlyABoringBarsStickOutIsKnown) {
  for (const auto& row : bush_sheets().all[0].tools) {
    const bool bar = row.id == "E12Q-SCLCR-CCMT060204-PF";
    EXPECT_EQ(row.stick_out_mm.has_value(), bar) << row.id;
    EXPECT_EQ(row.insert == "CCMT 060204-PF", bar) << row.insert;
  }
}

// Every tolerance is checked once, in the setup that completes it.
TEST(SetupSheet, EveryToleranceIsCheckedOnce) {
  const auto& s = bush_sheets();
  std::size_t checked = 0;
  for (const auto& sheet : s.all)
    checked += static_cast<std::size_t>(std::ranges::count_if(
        sheet.checks, [](const Check& c) { return c.what != "roughness Ra"; }));
  EXPECT_EQ(checked, s.planned.part.drawing.tolerances.size());
}

const Check& check(const SetupSheet& sheet, const std::string& what) {
  const auto found = std::ranges::find(sheet.checks, what, &Check::what);
  EXPECT_NE(found, sheet.checks.end()) << what;
  return *found;
}

// An Rz of 6.3 um may be an Ra of 1.6 um, which plates do not tell from better ones.
TEST(SetupSheet, RoughnessIsCheckedByItsOwnParameter) {
  auto d = bush();
  auto& element = d["outer"][1];
  element.erase("Ra_um");
  element["Rz_um"] = 6.3;
  const auto s = sheets_of(d);
  const auto& one = check(s.all[0], "roughness Rz");
  EXPECT_EQ(one.of, element["id"].get<std::string>());
  EXPECT_EQ(one.limits, "6.3 \u00b5m");
  EXPECT_NE(one.predicted, "not predicted");
  EXPECT_EQ(one.gauge, "roughness tester");
}

// ISO 286: 36 h7 is 0 / -25 um, 22 H7 +21 / 0.
TEST(SetupSheet, LimitsAreThoseOfTheSizes) {
  const auto& sheet = bush_sheets().all[0];
  const auto& shaft = check(sheet, "\u00d836 h7");
  EXPECT_EQ(shaft.of, "d2");
  EXPECT_EQ(shaft.limits, "35.975 .. 36.000");
  EXPECT_EQ(shaft.gauge, "micrometer");
  const auto& bore = check(sheet, "\u00d822 H7");
  EXPECT_EQ(bore.limits, "22.000 .. 22.021");
  EXPECT_EQ(bore.gauge, "three-point micrometer");
}

// The turned size is checked; what it is turned for stands beside it.
TEST(SetupSheet, SizesForGrindingSayWhatTheyAreFor) {
  auto d = bush();
  for (auto& e : d["outer"])
    if (e.value("fit", "") == "h7") e["grinding_allowance_mm"] = 0.3;
  const auto s = sheets_of(d);
  const auto& shaft = check(s.all[0], "\u00d836.3, for grinding to \u00d836 h7");
  EXPECT_EQ(shaft.limits, "36.250 .. 36.350");
}

// The length from end to end can be measured after the second setup only.
TEST(SetupSheet, ALengthIsCheckedOnceBothItsFacesAreMade) {
  const auto lengths = [](const SetupSheet& sheet) {
    return std::ranges::count_if(sheet.checks,
                                 [](const Check& c) { return c.what == "length 40"; });
  };
  EXPECT_EQ(lengths(bush_sheets().all[0]), 0);
  EXPECT_EQ(lengths(bush_sheets().all[1]), 1);
}

// A size is checked when the corrections fall due: that share of what an edge lasts.
TEST(SetupSheet, SizesAreCheckedWhenCorrectionsFallDue) {
  const auto& s = bush_sheets();
  const auto& sheet = s.all[0];
  const auto finishing = std::ranges::find_if(sheet.tools, [](const ToolRow& t) {
    return std::ranges::find(t.operations, "s1-finish-d2") != t.operations.end();
  });
  ASSERT_NE(finishing, sheet.tools.end());
  const double due =
      s.planned.part.shop.life_between_offsets / finishing->edge->edges_per_part;
  EXPECT_EQ(check(sheet, "\u00d836 h7").when,
            "first, then 1 in " + std::to_string(static_cast<int>(due)));
  auto small = bush();
  small["batch"] = 2;
  EXPECT_EQ(check(sheets_of(small).all[0], "\u00d836 h7").when, "first part");
}

TEST(SetupSheet, AThreadIsGauged) {
  const auto s =
      sheets_of(document::parse_file(nc::test::source("parts/threaded-spindle.json")));
  std::size_t threads = 0;
  for (const auto& sheet : s.all)
    for (const auto& c : sheet.checks) threads += c.gauge.starts_with("thread ");
  const auto& d = s.planned.part.drawing;
  const auto cut = [](const auto& e) {
    return e.cut && e.cut->kind == part::CutKind::thread;
  };
  EXPECT_EQ(threads, static_cast<std::size_t>(std::ranges::count_if(d.outer, cut) +
                                              std::ranges::count_if(d.inner, cut)));
  EXPECT_GT(threads, 0u);
}

nlohmann::json keyed() {
  return document::parse_file(nc::test::source("parts/keyed-shaft.json"));
}

// The same on a machine without axis C.
nlohmann::json keyed_by_hand() {
  auto part = keyed();
  auto machine = document::parse_file(nc::test::source("machines/turn-mill.json"));
  for (const char* axis : {"c_axis", "y_max_mm"}) machine["driven_tools"].erase(axis);
  part["machine"] = machine;
  return part;
}

// Where the program mills, its cutters are tools like others.
TEST(SetupSheet, CuttersOfTheProgramHaveTheirNumbers) {
  const auto s = sheets_of(keyed());
  int milled = 0;
  for (std::size_t i = 0; i < s.all.size(); ++i) {
    EXPECT_EQ(std::ranges::count(s.all[i].tools, 0, &ToolRow::number), 0);
    for (const auto& o : s.planned.plan.setups[i].operations) {
      if (o.kind != planning::OperationKind::mill) continue;
      ++milled;
      EXPECT_EQ(std::ranges::count(s.all[i].tools, o.tool, &ToolRow::id), 1);
      for (const auto& stop : s.all[i].stops) EXPECT_NE(stop.before, o.id);
    }
  }
  EXPECT_EQ(milled, 2);
}

// The keyed shaft: the tailstock is brought up, then the keyway is milled elsewhere.
TEST(SetupSheet, StopsSayBeforeWhatTheyStand) {
  const auto s = sheets_of(keyed_by_hand());
  std::size_t told = 0;
  for (std::size_t i = 0; i < s.all.size(); ++i) {
    double minutes = 0;
    for (const auto& stop : s.all[i].stops) {
      minutes += stop.minutes;
      EXPECT_FALSE(stop.what.starts_with("stop")) << stop.what;
      const auto& operations = s.planned.plan.setups[i].operations;
      const auto o =
          std::ranges::find(operations, stop.before, &planning::OperationPlan::id);
      ASSERT_NE(o, operations.end()) << stop.before;
      EXPECT_EQ(o->kind == planning::OperationKind::mill, stop.minutes == 0);
      ++told;
    }
    EXPECT_NEAR(minutes, s.programs.setups[i].minutes.operator_stops, 1e-12);
  }
  EXPECT_GE(told, 2u);
  std::set<std::string> driven;
  for (const auto& o : s.planned.plan.setups[0].operations)
    if (o.kind == planning::OperationKind::mill) driven.insert(o.tool);
  EXPECT_FALSE(driven.empty());
  EXPECT_EQ(std::ranges::count(s.all[0].tools, 0, &ToolRow::number),
            static_cast<long>(driven.size()));
}

TEST(SetupSheet, ProgramsOfAnotherPlanAreRefused) {
  const auto& s = bush_sheets();
  auto plan = s.planned.plan;
  plan.setups[0].operations.pop_back();
  EXPECT_THROW(setup_sheets(s.planned.part, plan, s.programs, {{"a", "b"}, ""}),
               std::domain_error);
  EXPECT_THROW(setup_sheets(s.planned.part, s.planned.plan, s.programs, {{"a"}, ""}),
               std::domain_error);
}

// Whole micrometres, where they change; the sheet says nothing where none does.
TEST(SetupSheetPage, TellsHowOffsetsFollowTheEdge) {
  SetupSheet sheet;
  ToolRow row{2, 2, "finisher", {}, {}};
  row.edge = planning::EdgeSchedule{"finisher", 0.025, 40, 3, {{"d2", {}}}};
  auto& steps = row.edge->offsets[0].steps;
  steps = {{0, -0.4}, {10, -1.2}, {20, -1.4}, {30, -2.6}};
  sheet.tools = {row};
  const auto page = sheet_html(sheet, {});
  EXPECT_NE(page.find("10: -1, 30: -3"), std::string::npos);
  EXPECT_NE(page.find("40 parts"), std::string::npos);
  EXPECT_EQ(page.find("20: "), std::string::npos);
  steps = {{0, -0.4}};
  sheet.tools = {row};
  EXPECT_EQ(sheet_html(sheet, {}).find("Offsets while"), std::string::npos);
}

TEST(SetupSheetPage, HasNothingOfThePlannersAlone) {
  const auto page = sheet_html(bush_sheets().all[0],
                               {{"setup-1.svg", "<svg/>"}, {"path-1.svg", "<svg/>"}});
  for (const char* has : {"Setup 1 of 2", "program-0", "4711-02", "Gear &lt;Works&gt;",
                          "first part released by", "new edge every", "35.975 .. 36.000"})
    EXPECT_NE(page.find(has), std::string::npos) << has;
  for (const char* not_here : {"cost", "gap", "proven", "window", "<Works>"})
    EXPECT_EQ(page.find(not_here), std::string::npos) << not_here;
  EXPECT_NE(page.find("the program's zero"), std::string::npos);
  EXPECT_NE(page.find("tool path"), std::string::npos);
}

}  // namespace
}  // namespace turnwright::report::setup_sheet_test
