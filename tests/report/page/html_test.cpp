#include "report/page/html.hpp"

#include <gtest/gtest.h>

#include <regex>

#include "report/picture/svg.hpp"

namespace turnwright::report::html_test {
namespace {

using nlohmann::ordered_json;

// Keys as in schemas/plan.result.json.
ordered_json feasible() {
  return ordered_json::parse(R"({
    "status": "ok", "cost_per_part": 12.34567, "time_per_part_min": 8.25,
    "certificate": {"kind": "global", "lower_bound": 12.3, "gap": 0.004, "nodes": 128},
    "setups": [
      {"hold": "left", "clamping": "chuck", "grip_force_N": 60000,
       "rejected": [{"clamping": "chuck-tailstock", "why": "costs 3 against 2"}],
       "operations": [
         {"id": "s1-rough-d2", "kind": "rough", "on": ["d2"], "tool": "PCLNL-12",
          "direction": "to-chuck",
          "passes": [
            {"ap_mm": 2.5, "f_mm_rev": 0.31, "vc_m_min": 240, "n_rpm": 1500},
            {"ap_mm": 2.5, "f_mm_rev": 0.31, "vc_m_min": 240, "n_rpm": 1750}],
          "time_min": 0.75, "cost": 1.125,
          "constraints": [{"name": "power", "binding": true}],
          "certificate": {"kind": "global", "gap": 0.0012}}]}],
    "tolerances": [
      {"id": "t1", "kind": "straightness", "of": "d2", "predicted_mm": 0.004,
       "allowed_mm": 0.01, "margin_mm": 0.006, "width_mm": 0.01, "verdict": "met",
       "published_verdict": false, "shares": [{"source": "deflection", "um": 4}],
       "P_conform": 0.9973}],
    "prices": [{"limit": "power", "sentence": "raising power saves 0.02 per part"}],
    "assumed": [{"pointer": "/batch", "value": 1, "why": "default"}],
    "turnwright_version": "0.1.0", "request_digest": "0123456789abcdef"})");
}

std::string without_percent(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += text[i];
      continue;
    }
    out += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
    i += 2;
  }
  return out;
}

bool holds(const std::string& page, const std::string& what) {
  return page.find(what) != std::string::npos;
}

TEST(Html, SaysTheNumbersOfTheDocument) {
  const auto page = html("Shaft", feasible(), {});
  for (const char* what :
       {"<h1>Shaft</h1>", "12.35", "8 min 15 s", "0.40 %", "s1-rough-d2", "1500-1750",
        "bound by power", "not chuck-tailstock: costs 3 against 2", "jaws with 60.0 kN",
        "raising power saves 0.02 per part", "0123456789abcdef", "/batch"})
    EXPECT_TRUE(holds(page, what)) << what;
}

TEST(Html, DrawsHowMuchOfATolerancesWidthIsUsed) {
  // 4 um of 10 um: 40 % of a bar of 60.
  const auto page = html("Shaft", feasible(), {});
  EXPECT_TRUE(holds(page, ">40 % <svg width=\"60\""));
  EXPECT_TRUE(holds(page, "<rect width=\"24.00\""));
  auto over = feasible();
  over["tolerances"][0]["shares"][0]["um"] = 14;
  over["tolerances"][0]["margin_mm"] = -0.004;
  over["tolerances"][0]["verdict"] = "not-met";
  const auto worse = html("Shaft", over, {});
  EXPECT_TRUE(holds(worse, ">140 % <svg"));
  EXPECT_TRUE(holds(worse, "<rect width=\"60.00\""));
  EXPECT_TRUE(holds(worse, "NOT MET"));
  EXPECT_TRUE(holds(worse, "fill=\"#b00d26\""));
  // A margin used to its end, as the cheapest plan's often is, is not a fault.
  auto full = over;
  full["tolerances"][0]["margin_mm"] = -1e-15;
  full["tolerances"][0]["verdict"] = "met";
  EXPECT_FALSE(holds(html("Shaft", full, {}), "fill=\"#b00d26\""));
}

// A4 with margins of 12 mm shows a picture of 190 mm 186 mm wide; a point is 25.4/72 mm.
TEST(Html, NoTypeIsBelowSevenPoints) {
  constexpr double kPoint = 25.4 / 72, kShown = 186.0 / 190;
  const auto page = html("Shaft", feasible(), {});
  std::size_t sizes = 0;
  const std::regex points("font(?:-size)?: ([0-9.]+)pt");
  for (std::sregex_iterator i(page.begin(), page.end(), points), end; i != end; ++i) {
    EXPECT_GE(std::stod((*i)[1]), 7) << (*i)[0];
    ++sizes;
  }
  EXPECT_GT(sizes, 5u);
  EXPECT_TRUE(holds(page, "small { font-size: inherit }"));
  EXPECT_TRUE(holds(page, "figure img { width: 100%"));
  const auto picture = Svg{}.page(190, 10, "");
  const std::regex millimetres("font-size: ([0-9.]+)px");
  sizes = 0;
  for (std::sregex_iterator i(picture.begin(), picture.end(), millimetres), end; i != end;
       ++i) {
    EXPECT_GE(std::stod((*i)[1]) * kShown / kPoint, 7) << (*i)[0];
    ++sizes;
  }
  EXPECT_EQ(sizes, 2u);
}

TEST(Html, EscapesWhateverTheRequestCallsThings) {
  const std::string name = "<script>alert(1)</script> \"a\" & b";
  const std::string shown = "&lt;script&gt;alert(1)&lt;/script&gt; &quot;a&quot; &amp; b";
  auto document = feasible();
  auto& setup = document["setups"][0];
  setup["clamping"] = name;
  setup["operations"][0]["id"] = name;
  setup["operations"][0]["tool"] = name;
  setup["operations"][0]["on"] = {name};
  setup["rejected"][0]["why"] = name;
  document["tolerances"][0]["id"] = name;
  document["tolerances"][0]["of"] = name;
  document["prices"][0]["sentence"] = name;
  document["assumed"][0]["value"] = name;
  document["certificate"] = {{"kind", "none"}, {"reason", name}};
  const auto page =
      html(name, document, {{"window-" + name + ".svg", "<svg><title>t</title></svg>"}});
  EXPECT_FALSE(holds(page, "<script"));
  EXPECT_TRUE(holds(page, "<h1>" + shown + "</h1>"));
  EXPECT_TRUE(holds(page, "<title>" + shown + " - process plan</title>"));
  EXPECT_TRUE(holds(page, "alt=\"Speeds and feeds of " + shown + "\""));
  EXPECT_FALSE(holds(page, "\"a\" & b"));
}

TEST(Html, CarriesItsPicturesInside) {
  const std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\"><text fill=\"#fff\">100 % \xc2\xb5m "
      "'&amp;'</text></svg>\n";
  const auto page =
      html("Shaft", feasible(),
           {{"setup-1.svg", svg}, {"budget.svg", svg}, {"window-s1-rough-d2.svg", svg}});
  const std::regex image(
      "<img alt=\"[^\"]*\" src=\"data:image/svg\\+xml,([^\"<>#& ]*[^\"<>#]*)\">");
  int count = 0;
  for (std::sregex_iterator i(page.begin(), page.end(), image), end; i != end; ++i) {
    EXPECT_EQ(without_percent((*i)[1]), svg);
    ++count;
  }
  EXPECT_EQ(count, 3);
  EXPECT_EQ(std::string::npos, page.find("src=\"http"));
  EXPECT_FALSE(holds(page, "<link"));
}

TEST(Html, ShowsTheWindowsOfTheFourOperationsThatCostMost) {
  auto document = feasible();
  auto& operations = document["setups"][0]["operations"];
  const auto one = operations[0];
  operations = ordered_json::array();
  std::vector<Figure> figures;
  for (int i = 0; i < 6; ++i) {
    operations.push_back(one);
    operations.back()["id"] = "op" + std::to_string(i);
    operations.back()["cost"] = i % 3 + 0.1 * i;  // 0, 1.1, 2.2, 0.3, 1.4, 2.5
    figures.push_back({"window-op" + std::to_string(i) + ".svg", "<svg/>"});
  }
  const auto page = html("Shaft", document, figures);
  std::string order;
  for (auto at = page.find("Speeds and feeds of op"); at != std::string::npos;
       at = page.find("Speeds and feeds of op", at + 1))
    order += page[at + 22];
  EXPECT_EQ(order, "5241");
}

TEST(Html, TellsWhyThereIsNoPlan) {
  auto document = feasible();
  document["status"] = "infeasible";
  document["cost_per_part"] = nullptr;
  document["conflicts"] = {{{"limit", "t1"}, {"sentence", "t1 and power conflict"}}};
  document["relax"] = {
      {{"limit", "a"}, {"now", 1.0}, {"needed", 2.0}, {"sentence", "open a"}},
      {{"limit", "b"}, {"now", 1.0}, {"needed", 1.1}, {"sentence", "open b"}}};
  const auto page = html("Shaft", document, {});
  EXPECT_TRUE(holds(page, "Infeasible"));
  EXPECT_TRUE(holds(page, "t1 and power conflict"));
  EXPECT_LT(page.find("open b [+10.0 %]"), page.find("open a [+100.0 %]"));
  EXPECT_TRUE(holds(page, "do not cut with them"));
}

TEST(Html, ADocumentWithoutAnythingIsStillAPage) {
  const auto page = html("", ordered_json::object(), {});
  EXPECT_TRUE(holds(page, "<!doctype html>"));
  EXPECT_TRUE(holds(page, "</html>"));
}

}  // namespace
}  // namespace turnwright::report::html_test
