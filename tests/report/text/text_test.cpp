#include "report/text/text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "../words.hpp"

namespace turnwright::report::text_test {
namespace {

using nlohmann::ordered_json;

// One of everything, keys as in schemas/plan.result.json.
ordered_json feasible() {
  return ordered_json::parse(R"({
    "status": "ok", "cost_per_part": 12.34567, "time_per_part_min": 8.25,
    "profit_per_min": 0.5,
    "certificate": {"kind": "global", "lower_bound": 12.3, "gap": 0.004, "nodes": 128,
                    "engine": "convex"},
    "setups": [
      {"hold": "left", "clamping": "chuck-tailstock",
       "rejected": [{"clamping": "chuck", "why": "d2: t1 straightness is 0.02 mm"}],
       "operations": [
         {"id": "s1-rough-d2", "kind": "rough", "on": ["d2"], "tool": "PCLNL-12",
          "direction": "to-chuck",
          "passes": [
            {"ap_mm": 2.5, "f_mm_rev": 0.31, "vc_m_min": 240, "n_rpm": 1500,
             "time_min": 0.25, "Fc_N": 1, "Ff_N": 1, "Fp_N": 1, "Pc_kW": 1, "T_min": 15},
            {"ap_mm": 2.5, "f_mm_rev": 0.31, "vc_m_min": 240, "n_rpm": 1750,
             "time_min": 0.25, "Fc_N": 1, "Ff_N": 1, "Fp_N": 1, "Pc_kW": 1, "T_min": 15},
            {"ap_mm": 1.5, "f_mm_rev": 0.25, "vc_m_min": 260, "n_rpm": 2000,
             "time_min": 0.25, "Fc_N": 1, "Ff_N": 1, "Fp_N": 1, "Pc_kW": 1, "T_min": 15}],
          "time_min": 0.75, "cost": 1.125,
          "constraints": [
            {"name": "power", "value": 5, "limit": 5, "unit": "kW", "at_most": true,
             "margin": 0, "binding": true, "shadow_price": 0.2},
            {"name": "feed force", "value": 5, "limit": 9, "unit": "N", "at_most": true,
             "margin": 0.6, "binding": false, "shadow_price": 0},
            {"name": "least tool life", "value": 15, "limit": 15, "unit": "min",
             "at_most": false, "margin": 0, "binding": true, "shadow_price": 0.1}],
          "certificate": {"kind": "global", "lower_bound": 1.1, "gap": 0.0012,
                          "nodes": 12, "engine": "convex"}}]},
      {"hold": "right", "clamping": "chuck", "rejected": [],
       "operations": [
         {"id": "s2-finish-d1", "kind": "finish", "on": ["d1", "c1"], "tool": "PDJNL-15",
          "direction": "from-chuck",
          "passes": [
            {"ap_mm": 0.5, "f_mm_rev": 0.125, "vc_m_min": 300, "n_rpm": 3000,
             "time_min": 0.5, "Fc_N": 1, "Ff_N": 1, "Fp_N": 1, "Pc_kW": 1, "T_min": 15}],
          "time_min": 0.5, "cost": 0.625, "constraints": [],
          "certificate": {"kind": "local", "lower_bound": 0.5, "gap": 0.2, "nodes": 9,
                          "engine": "branch-and-bound", "reason": "budget spent"}}]}],
    "tolerances": [
      {"id": "d1:diameter", "kind": "diameter", "of": "d1", "predicted_mm": [-0.0105, 0.0025],
       "allowed_mm": [-0.016, 0.016], "margin_mm": 0.0055, "verdict": "met",
       "published_verdict": true, "shares": [{"source": "deflection", "um": 5}],
       "P_conform": 0.9973},
      {"id": "t1", "kind": "straightness", "of": "d2", "predicted_mm": 0.004,
       "allowed_mm": 0.0095, "margin_mm": 0.0055, "verdict": "met", "published_verdict": false,
       "shares": [], "P_conform": 1}],
    "compensation": [{"on": "d2", "setup": 0, "table_mm": [[30, 0.001], [60, -0.00225]]}],
    "prices": [{"limit": "s1-rough-d2: power", "now": 5, "unit": "kW",
                "saves_per_part_for_10_percent": 0.25, "sentence": "raising power saves"}],
    "conflicts": [], "relax": [],
    "assumed": [{"pointer": "/batch", "value": 1, "why": "default"},
                {"pointer": "/machine", "value": "lathe-medium", "why": "no machine given"}],
    "format": "turnwright-plan-result/1", "turnwright_version": "0.1.0",
    "request_digest": "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef"
  })");
}

ordered_json infeasible() {
  return ordered_json::parse(R"({
    "status": "infeasible", "cost_per_part": null, "time_per_part_min": null,
    "certificate": {"kind": "none", "lower_bound": 0, "gap": 0, "nodes": 12,
                    "reason": "proved: no plan keeps every limit"},
    "setups": [
      {"hold": "left", "clamping": "chuck", "rejected": [],
       "operations": [{"id": "op", "kind": "finish", "on": ["d1"], "tool": "T",
                       "direction": "to-chuck", "passes": [], "time_min": 1, "cost": 2,
                       "constraints": [], "certificate": {"kind": "none", "lower_bound": 0,
                       "gap": 0, "nodes": 0}}]},
      {"hold": "right", "clamping": "chuck",
       "rejected": [{"clamping": "chuck", "why": "jaws too small"}], "operations": []}],
    "tolerances": [], "compensation": [], "prices": [],
    "conflicts": [
      {"limit": "t1 straightness", "where": "d1", "value": 0.006, "allowed": 0.004,
       "unit": "mm", "sentence": "t1 against the wall"},
      {"limit": "least feed", "where": "d1", "value": 0.1, "allowed": 0.1,
       "unit": "mm/rev", "sentence": "least feed against the wall"}],
    "relax": [
      {"limit": "t1", "now": 0.004, "needed": 0.006, "unit": "mm", "sentence": "open t1"},
      {"limit": "grip", "now": 0, "needed": 1, "unit": "N", "sentence": "more grip"},
      {"limit": "least feed", "now": 0.1, "needed": 0.08, "unit": "mm/rev",
       "sentence": "lower the feed"}],
    "assumed": []})");
}

std::vector<std::string> lines(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> all;
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

bool has_line(const std::string& text, const std::string& line) {
  const auto all = lines(text);
  return std::find(all.begin(), all.end(), line) != all.end();
}

// Every run of blanks and line ends as one blank.
std::string squeezed(const std::string& text) {
  std::istringstream in(text);
  std::string out;
  for (std::string word; in >> word;) out += (out.empty() ? "" : " ") + word;
  return out;
}

// The line that begins with `start`, squeezed.
std::string row(const std::string& text, const std::string& start) {
  for (const auto& line : lines(text))
    if (squeezed(line).rfind(start, 0) == 0) return squeezed(line);
  return "";
}

void expect_printable(const std::string& text) {
  for (const auto& line : lines(text)) {
    EXPECT_LE(std::count_if(
                  line.begin(), line.end(),
                  [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }),
              100)
        << line;
    EXPECT_TRUE(line.empty() || line.back() != ' ') << '"' << line << '"';
    EXPECT_TRUE(std::none_of(line.begin(), line.end(), [](char c) {
      return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    })) << line;
  }
}

TEST(Text, HeadSaysWhatThePlanCostsAndWhatIsProven) {
  const auto out = text(feasible());
  EXPECT_TRUE(has_line(out, "PROCESS PLAN"));
  EXPECT_TRUE(has_line(out, "status  every limit is kept"));
  EXPECT_TRUE(has_line(out, "cost    12.35 per part"));
  EXPECT_TRUE(has_line(out, "time    8 min 15 s per part"));
  EXPECT_TRUE(has_line(out, "profit  0.500 per minute"));
  EXPECT_TRUE(
      has(squeezed(out),
          "proof proven: no choice of clamping, tools and conditions is better by "
          "more than 0.40 %"));
  EXPECT_FALSE(has(out, "boxes"));
  EXPECT_TRUE(has_line(out, "made by turnwright 0.1.0 from request 0123456789ab"));
  EXPECT_FALSE(has(out, "CONFLICTS"));
  EXPECT_FALSE(has(out, "GIVE"));
  expect_printable(out);
}

TEST(Text, HeadNamesTheToleranceThatFewestPartsKeep) {
  auto result = feasible();
  result["worst_conformance"] = {
      {"tolerance", "d2:diameter"}, {"P_conform", 0.99734}, {"wanted", 0.9973}};
  EXPECT_TRUE(
      has_line(text(result),
               "status  every limit is kept, d2:diameter by the fewest parts, 99.73 %"));
  result["worst_conformance"]["P_conform"] = 0.5;
  const auto half = text(result);
  EXPECT_FALSE(has(half, "every limit is kept"));
  EXPECT_TRUE(
      has(squeezed(half),
          "kept nominally only: 50.00 % of the parts keep d2:diameter, wanted are "
          "99.73 %"));
  result["worst_conformance"]["P_conform"] = 0.99727;
  EXPECT_TRUE(
      has(squeezed(text(result)),
          "kept nominally only: 99.727 % of the parts keep d2:diameter, wanted are "
          "99.730 %"));
}

TEST(Text, HeadTellsThePreparingOfTheMachineApart) {
  auto result = feasible();
  result["setting_up"] = {
      {"min", 40}, {"cost", 48}, {"min_per_part", 0.8}, {"cost_per_part", 0.96}};
  EXPECT_TRUE(has(squeezed(text(result)),
                  "set up 40 min and 48.00 once per batch, of which 48 s and 0.960 are "
                  "counted per part"));
  result["setting_up"]["min_per_part"] = nullptr;
  result["setting_up"]["cost_per_part"] = nullptr;
  EXPECT_TRUE(has(squeezed(text(result)),
                  "once per batch; not counted per part, because the request gives no "
                  "batch size"));
}

TEST(Text, OffsetsAreListedInMicrometres) {
  auto result = feasible();
  result["offsets"] = {{{"on", "d2"}, {"setup", 0}, {"offset_mm", -0.0125}}};
  const auto out = text(result);
  EXPECT_TRUE(has(out, "OFFSETS"));
  EXPECT_TRUE(has(squeezed(out), "d2 1 -12.5"));
  EXPECT_FALSE(has(text(feasible()), "OFFSETS"));
}

TEST(Text, NameAndGripShowWhereTheDocumentHasThem) {
  auto result = feasible();
  result["name"] = "Welle \xc3\xbc";
  result["setups"][1]["grip_mm"] = 25;
  const auto out = text(result);
  EXPECT_TRUE(has_line(out, "PROCESS PLAN  Welle \xc3\xbc"));
  EXPECT_TRUE(has_line(out, "SETUP 2  hold right end in the chuck, 25.0 mm gripped"));
}

TEST(Text, TheTitleBlockShowsWhatTheDocumentHasOfIt) {
  auto result = feasible();
  EXPECT_FALSE(has(text(result), "drawing "));
  result["customer"] = "Gear works";
  EXPECT_TRUE(has_line(text(result), "drawing for Gear works"));
  result["drawing_number"] = "4711-02";
  result["revision"] = "C";
  EXPECT_TRUE(has_line(text(result), "drawing 4711-02, revision C, for Gear works"));
}

TEST(Text, AProofThatIsNotGlobalSaysSo) {
  auto result = feasible();
  auto& certificate = result["certificate"];
  certificate = {{"kind", "local"},
                 {"lower_bound", 10},
                 {"gap", 0.25},
                 {"nodes", 5},
                 {"reason", "d1: budget spent"}};
  // Nothing costs less than 75 % of it: it costs at most 4/3 of the best.
  EXPECT_TRUE(has_line(text(result),
                       "proof   not proven: may be up to 33.4 % dearer than the best"));
  EXPECT_FALSE(has(text(result), "budget spent"));
  certificate["gap"] = 1;
  EXPECT_TRUE(has_line(text(result), "proof   not proven: a better plan may exist"));
  certificate = {{"kind", "none"}, {"lower_bound", 0}, {"gap", 0}, {"nodes", 0}};
  EXPECT_TRUE(has_line(text(result), "proof   not proven"));
}

TEST(Text, SetupsSayHowThePartIsHeldAndWhyNotOtherwise) {
  auto result = feasible();
  auto out = text(result);
  EXPECT_TRUE(has_line(
      out, "SETUP 1  hold left end in the chuck, right end on the tailstock centre"));
  EXPECT_TRUE(has_line(out, "  not chuck: d2: t1 straightness is 0.02 mm"));
  EXPECT_TRUE(has_line(out, "SETUP 2  hold right end in the chuck"));
  result["setups"][1]["clamping"] = "between-centres";
  EXPECT_TRUE(has(text(result), "hold between centres, right end at the headstock"));
}

TEST(Text, PassesOfTheSameConditionsShareALine) {
  const auto out = text(feasible());
  EXPECT_EQ(row(out, "s1-rough-d2"),
            "s1-rough-d2 PCLNL-12 2 2.500 0.310 240.0 1500-1750 45.0 1.12 0.12 %");
  EXPECT_EQ(row(out, "1 1.500"), "1 1.500 0.250 260.0 2000");
  EXPECT_EQ(row(out, "s2-finish-d1"),
            "s2-finish-d1 PDJNL-15 1 0.500 0.125 300.0 3000 30.0 0.625 local");
}

TEST(Text, EveryOperationNamesWhatBindsIt) {
  const auto out = text(feasible());
  EXPECT_TRUE(has_line(out, "    rough d2; bound by power, least tool life"));
  EXPECT_TRUE(has_line(out,
                       "    finish d1, c1, away from the chuck; no limit binds; may be "
                       "up to 25.0 % dearer than the best"));
}

TEST(Text, TolerancesAreInMicrometres) {
  const auto out = text(feasible());
  EXPECT_EQ(row(out, "d1:diameter"),
            "d1:diameter diameter d1 -10.5..2.5 -16.0..16.0 5.5 99.73 met");
  EXPECT_EQ(row(out, "t1"), "t1 straightness d2 4.0 9.5 5.5 100.00 met");
}

TEST(Text, TheUsualTolerancesKeepTheirWordsWhole) {
  auto result = feasible();
  auto& t = result["tolerances"][0];
  t["kind"] = "circular-radial-runout";
  t["of"] = "left .. right";
  t["predicted_mm"] = {-0.15, 0.15};
  t["allowed_mm"] = {-0.15, 0.15};
  t["published_verdict"] = false;
  const auto out = text(result);
  for (const auto* word : {"d1:diameter", "circular", "radial", "run-out", "left ..",
                           "right", "-150.0..150.0"})
    EXPECT_TRUE(has(out, word)) << word << '\n' << out;
  expect_printable(out);
}

TEST(Text, ThePublishedVerdictShowsOnlyWhereItDiffers) {
  auto result = feasible();
  result["tolerances"].erase(1);
  auto& t = result["tolerances"][0];
  const auto end = [&](const char* verdict, bool published) {
    t["verdict"] = verdict;
    t["published_verdict"] = published;
    const auto out = text(result);
    const auto line = row(out, "d1:diameter");
    const auto note = row(out, "by the published acceptance equations");
    return line.substr(line.find(" 99.73 ") + 7) + "|" +
           note.substr(note.empty() ? 0 : note.find(": ") + 2);
  };
  EXPECT_EQ(end("met", true), "met|");
  EXPECT_EQ(end("met", false), "met|not met");
  EXPECT_EQ(end("met-with-offset", true), "offset|");
  EXPECT_EQ(end("met-with-offset", false), "offset|not met");
  EXPECT_EQ(end("not-met", true), "NOT MET|met");
  EXPECT_EQ(end("not-met", false), "NOT MET|");
}

TEST(Text, CorrectionsLieAcrossThePage) {
  auto result = feasible();
  auto out = text(result);
  EXPECT_TRUE(has_line(out, "  d2 in setup 1"));
  EXPECT_EQ(row(out, "z mm"), "z mm 30.00 60.00");
  EXPECT_EQ(row(out, "dr \u00b5m"), "dr \u00b5m 1.00 -2.25");
  auto rows = ordered_json::array();
  for (int k = 0; k < 11; ++k) rows.push_back({k, 0.001 * k});
  result["compensation"][0]["table_mm"] = rows;
  out = text(result);
  EXPECT_EQ(row(out, "dr \u00b5m 9.00"), "dr \u00b5m 9.00 10.00");
  expect_printable(out);
  result["compensation"].clear();
  EXPECT_FALSE(has(text(result), "COMPENSATION"));
}

TEST(Text, ManyAlternativesAreTheChosenAndTheCheapest) {
  auto result = feasible();
  auto all = ordered_json::array();
  for (int k = 0; k < 12; ++k)
    all.push_back({{"feasible", k > 0},
                   {"chosen", k == 5},
                   {"cost_per_part", 30.0 - k},
                   {"sentence", "way " + std::to_string(k)}});
  result["alternatives"] = all;
  auto out = text(result);
  EXPECT_TRUE(has_line(out, "  1. way 5"));
  EXPECT_TRUE(has_line(out, "  2. way 11"));
  EXPECT_EQ(row(out, "10. way"), "10. way 2");
  EXPECT_TRUE(has_line(out, "  and 2 more, in the result as JSON"));
  EXPECT_FALSE(has(out, "way 0"));
  all.erase(10);
  all.erase(10);
  result["alternatives"] = all;
  out = text(result);
  EXPECT_TRUE(has_line(out, "  1. way 0"));
  EXPECT_FALSE(has(out, " more, in the result"));
}

TEST(Text, TheEightLargestPricesAreRanked) {
  auto result = feasible();
  for (int k = 2; k <= 11; ++k) {
    auto price = result["prices"][0];
    price["sentence"] = "price " + std::to_string(k);
    result["prices"].push_back(price);
  }
  const auto out = text(result);
  EXPECT_TRUE(has_line(out, "  1. raising power saves"));
  EXPECT_TRUE(has_line(out, "  8. price 8"));
  EXPECT_FALSE(has(out, "price 9"));
  EXPECT_TRUE(has_line(out, "  3 smaller ones are in the result document."));
}

TEST(Text, WhatEachRuleOfTheShopCostsIsTold) {
  auto result = feasible();
  EXPECT_FALSE(has(text(result), "RULES"));
  result["rules"] = {{{"sentence", "without the rule that T is forbidden: saves 1"}}};
  EXPECT_TRUE(
      has_line(text(result), "RULES  of the shop, the part planned without each"));
  EXPECT_TRUE(
      has_line(text(result), "  1. without the rule that T is forbidden: saves 1"));
}

TEST(Text, EveryAssumptionTakesOneLine) {
  auto result = feasible();
  result["assumed"].push_back(
      {{"pointer", "/tools"},
       {"value", std::vector<std::string>(40, "PCLNL-CNMG120408")},
       {"why", "the whole catalogue"}});
  const auto out = text(result);
  EXPECT_TRUE(has_line(out, "  /batch = 1: default"));
  EXPECT_TRUE(has_line(out, "  /machine = lathe-medium: no machine given"));
  const auto last = lines(out).back();
  EXPECT_EQ(last.size(), 100u) << last;
  EXPECT_EQ(last.rfind("  /tools = PCLNL-CNMG120408, PCLNL", 0), 0u) << last;
  EXPECT_TRUE(has(last, "...: the whole catalogue")) << last;
}

TEST(Text, AnInfeasiblePartNamesConflictsAndTheSmallestOpeningFirst) {
  const auto out = text(infeasible());
  EXPECT_TRUE(has_line(out, "status  infeasible"));
  EXPECT_FALSE(has(out, "per part"));
  EXPECT_TRUE(has_line(out, "proof   proved: no plan keeps every limit"));
  EXPECT_TRUE(has_line(out, "  1. t1 against the wall"));
  EXPECT_TRUE(has_line(out, "  2. least feed against the wall"));
  // ln(0.1/0.08) = 0.22 is less than ln(0.006/0.004) = 0.41; from zero no ratio is known.
  EXPECT_TRUE(has_line(out, "  1. lower the feed [-20.0 %]"));
  EXPECT_TRUE(has_line(out, "  2. open t1 [+50.0 %]"));
  EXPECT_TRUE(has_line(out, "  3. more grip"));
  EXPECT_TRUE(has(out, "do not cut with them"));
  EXPECT_TRUE(has_line(out, "SETUP 2  hold right end, no clamping allowed can"));
  expect_printable(out);
}

TEST(Text, SeveralConflictsAreNumberedAndWhatElseWouldDoFollows) {
  auto result = infeasible();
  EXPECT_FALSE(has(text(result), "OTHER CHANGES"));
  result["conflicts"][0]["set"] = result["relax"][0]["set"] = 1;
  result["conflicts"][1]["set"] = result["relax"][2]["set"] = 2;
  result["remedies"] = {{{"change", "tool"},
                         {"tool", "T9"},
                         {"sentence", "the tool T9 makes it possible"},
                         {"cost_per_part", 3.5},
                         {"time_per_part_min", 1.5}}};
  const auto out = text(result);
  EXPECT_TRUE(has_line(out, "  1. set 1: t1 against the wall"));
  EXPECT_TRUE(has_line(out, "  2. set 2: least feed against the wall"));
  EXPECT_TRUE(
      has_line(out, "LIMITS TO RELAX  one of every set, the smallest change first"));
  EXPECT_TRUE(has_line(out, "  1. set 2: lower the feed [-20.0 %]"));
  EXPECT_TRUE(has_line(out, "OTHER CHANGES  each line alone makes the part feasible"));
  EXPECT_TRUE(has_line(out, "  1. the tool T9 makes it possible"));
  expect_printable(out);
  const std::string stays =
      "Relaxing limits is not enough: the conflicts that belong to no set stay.";
  EXPECT_FALSE(has(out, stays));
  result["conflicts"][1].erase("set");
  EXPECT_FALSE(has(text(result), stays));  // the second relaxation is of no set either
  result["relax"][1]["set"] = 1;
  EXPECT_TRUE(has(text(result), stays));
}

TEST(Text, WithoutAKnownOpeningTheReportSaysSo) {
  auto result = infeasible();
  result["relax"].clear();
  EXPECT_TRUE(has_line(text(result),
                       "  No limit was found whose relaxation alone helps; the other "
                       "changes tried are listed below."));
}

// Calls `change` on a copy of the document for each of its places.
template <class F>
void at_every_place(const ordered_json& document, const F& change) {
  const auto places = document.flatten();
  for (const auto& [pointer, value] : places.items()) {
    for (ordered_json::json_pointer p(pointer); !p.empty(); p.pop_back()) {
      auto copy = document;
      change(copy, p);
      SCOPED_TRACE(p.to_string());
      expect_printable(text(copy));
    }
  }
}

TEST(Text, AnyMissingOrEmptyPlaceIsSurvived) {
  for (const auto& document : {feasible(), infeasible()}) {
    at_every_place(document, [](ordered_json& d, const ordered_json::json_pointer& p) {
      auto& parent = d[p.parent_pointer()];
      if (parent.is_object())
        parent.erase(p.back());
      else
        parent.erase(std::stoul(p.back()));
    });
    for (const auto& value : {ordered_json(), ordered_json("x"), ordered_json(1e300),
                              ordered_json::array({1}), ordered_json::object()})
      at_every_place(document, [&](ordered_json& d, const ordered_json::json_pointer& p) {
        d[p] = value;
      });
  }
  expect_printable(text(ordered_json::object()));
}

TEST(Text, LongOrHostileNamesStayInsideThePage) {
  const std::string longest(150, 'w');
  std::string umlauts;
  for (int k = 0; k < 120; ++k) umlauts += "\xc3\xa4";
  for (const auto& document : {feasible(), infeasible()})
    for (const auto& name : {longest, umlauts, std::string("a\x1b[2J\nb\x7f\tc")})
      at_every_place(document, [&](ordered_json& d, const ordered_json::json_pointer& p) {
        if (d[p].is_string()) d[p] = name;
      });
  auto result = feasible();
  result["setups"][0]["operations"][0]["tool"] = umlauts;
  const auto out = text(result);
  std::size_t kept = 0;
  for (std::size_t i = out.find("\xc3\xa4"); i != std::string::npos;
       i = out.find("\xc3\xa4", i + 2))
    ++kept;
  EXPECT_EQ(kept, 120u);
}

}  // namespace
}  // namespace turnwright::report::text_test
