// Figures 2, 5, 6 and 7 of [Ozoegwu 2013] from our own
// computation: published_figures FOLDER writes them there and prints the tables of
// docs/milling.md.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "../tests/chatter/cutters.hpp"
#include "report/picture/chart.hpp"
#include "report/picture/stability_chart.hpp"
#include "turnwright/chatter/limits.hpp"
#include "turnwright/chatter/reference_methods.hpp"
#include "turnwright/document/stability.hpp"

namespace turnwright {
namespace {

using nlohmann::ordered_json;

constexpr double kSlowest = 1000, kFastest = 20000, kDeepest_mm = 20;

struct Cut {
  double n_rpm = 0, ap_mm = 0;
  bool stable = false;
};

/// Cuts all over the chart, judged by integrating the delay equation.
std::vector<Cut> simulated_cuts() {
  constexpr int kCuts = 120;
  std::mt19937 random(2011);
  const auto share = [&] { return static_cast<double>(random()) / 4294967296.0; };
  std::vector<Cut> out;
  for (int i = 0; i < kCuts; ++i) {
    Cut c{kSlowest + (kFastest - kSlowest) * share(), kDeepest_mm * share()};
    c.stable =
        std::abs(
            chatter::simulation(chatter::slot_cutter(), c.n_rpm, c.ap_mm).multiplier) < 1;
    out.push_back(c);
  }
  return out;
}

ordered_json request(int count, double ap_max_mm) {
  return {{"model", "power-law"},
          {"teeth", 3},
          {"mass_kg", 0.431},
          {"natural_frequency_rad_s", 5700},
          {"damping_ratio", 0.02},
          {"C", 3.5e7},
          {"gamma", 0.75},
          {"feed_speed_m_s", 0.0025},
          {"normal_ratio", 0.3},
          {"ap_max_mm", ap_max_mm},
          {"speeds_rpm", {{"from", kSlowest}, {"to", kFastest}, {"count", count}}}};
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// Specific force over one turn at 1000/min.
std::string figure_2() {
  constexpr double kWidth = 190, kHeight = 90, kLeft = 25, kScale = 150, kZero = 55;
  const chatter::System s = chatter::slot_cutter();
  const auto arcs = chatter::arcs(s);
  const double pitch = 2 * units::kPi / s.teeth;
  std::vector<report::Point> line;
  double most = 0;
  constexpr int kSamples = 600;
  for (int i = 0; i <= kSamples; ++i) {
    const double turn = static_cast<double>(i) / kSamples;
    double angle = std::fmod(2 * units::kPi * turn, pitch);
    if (angle < arcs.front().begin_rad) angle += pitch;
    for (const auto& arc : arcs)
      if (angle >= arc.begin_rad && angle <= arc.end_rad) {
        const double h = chatter::directional_MPa(s, 1000, arc, angle).xx;
        most = std::max(most, std::abs(h));
        line.push_back({kLeft + kScale * turn, h});
        break;
      }
  }
  for (auto& p : line) p.y = kZero - 35 * p.y / most;
  report::Svg svg;
  svg.text({10, 9}, report::Anchor::start, "Specific force h(t) at 1000/min", "title");
  svg.line("thin", {kLeft, kZero}, {kLeft + kScale, kZero});
  svg.line("thin", {kLeft, kZero - 36}, {kLeft, kZero + 30});
  svg.text({kLeft - 2, kZero - 34}, report::Anchor::end, report::plain(most, 1) + " MPa");
  svg.text({kLeft - 2, kZero + 1}, report::Anchor::end, "0");
  svg.text({kLeft + kScale, kZero + 4}, report::Anchor::end, "0.06 s");
  svg.polyline("made", line);
  return svg.page(kWidth, kHeight, "h(t) over one turn");
}

/// The chart of E elements, or of the certified method for 0, with the cuts simulated.
std::string figure_5(int elements, const std::vector<Cut>& cuts) {
  ordered_json asked = request(elements == 0 ? 400 : 120, kDeepest_mm);
  if (elements > 0) {
    asked["method"] = "tfea";
    asked["elements"] = elements;
  }
  ordered_json result = document::stability(asked);
  result["points"] = ordered_json::array();
  for (const Cut& c : cuts)
    result["points"].push_back(
        {{"n_rpm", c.n_rpm}, {"ap_mm", c.ap_mm}, {"stable", c.stable}});
  return report::stability_chart(asked, result);
}

/// How E elements place the simulated cuts.
struct Placed {
  int elements = 0;
  int right = 0;   ///< stable ones called stable, what [Ozoegwu 2013] counts
  int unsafe = 0;  ///< unstable ones called stable
};

Placed placed(int elements, const std::vector<Cut>& cuts) {
  Placed out{.elements = elements};
  for (const Cut& c : cuts) {
    const auto found =
        chatter::time_finite_elements(chatter::slot_cutter(), c.n_rpm, c.ap_mm, elements);
    if (std::abs(found.multiplier) < 1) ++(c.stable ? out.right : out.unsafe);
  }
  return out;
}

/// Cuts rightly called stable and wrongly called so, over the number of elements.
std::string figure_6(const std::vector<Cut>& cuts) {
  constexpr double kWidth = 190, kHeight = 110;
  constexpr int kMost = 40;
  const auto stable = std::ranges::count(cuts, true, &Cut::stable);
  const report::Scale x{0, kMost, 20, 182},
      y{0, 10 * (2 + std::floor(static_cast<double>(stable) / 10)), 92, 20};
  std::vector<report::Point> right, unsafe;
  fmt::print(
      "{} cuts, {} of them stable\n\n| E | stable cuts called stable | unstable cuts "
      "called stable (unsafe) |\n| --- | --- | --- |\n",
      cuts.size(), stable);
  for (int elements = 1; elements <= kMost; ++elements) {
    const Placed p = placed(elements, cuts);
    right.push_back({x.place(elements), y.place(p.right)});
    unsafe.push_back({x.place(elements), y.place(p.unsafe)});
    if (std::ranges::count(std::array{1, 3, 6, 10, 14, 20, 40}, elements) > 0)
      fmt::print("| {} | {} | {} |\n", elements, p.right, p.unsafe);
  }
  report::Svg svg;
  svg.text({20, 9}, report::Anchor::start,
           fmt::format("{} cuts placed by E elements", cuts.size()), "title");
  report::frame(svg, x, y, "elements E", "cuts called stable", 8, 6);
  svg.line("thin", {x.from, y.place(static_cast<double>(stable))},
           {x.to, y.place(static_cast<double>(stable))});
  svg.polyline("path", right);
  svg.polyline("made", unsafe);
  svg.text({x.to, y.place(static_cast<double>(stable)) - 1.5}, report::Anchor::end,
           fmt::format("{} are stable", stable));
  svg.text({right[8].x, right[8].y + 6}, report::Anchor::start, "rightly", "path");
  svg.text({unsafe[6].x, unsafe[6].y - 2}, report::Anchor::start, "wrongly: they chatter",
           "bad");
  return svg.page(kWidth, kHeight, "Cuts called stable over the number of elements");
}

/// The most productive cut of machines of unlike speed ranges.
void figure_7() {
  fmt::print(
      "\n| machine up to | best n | depth mm | limited by |\n| --- | --- | --- | --- "
      "|\n");
  for (const double fastest : {2000, 5000, 10000, 12000, 15000, 18000, 20000}) {
    ordered_json asked = request(1901, 70);
    asked["machine_rpm"] = {{"from", kSlowest}, {"to", fastest}};
    asked["stability_margin"] = asked["speed_margin"] = 0;  // the paper has none
    const auto best = document::stability(asked).at("best");
    fmt::print("| {} | {} | {:.4g} | {} |\n", fastest, best.at("n_rpm").get<double>(),
               best.at("ap_mm").get<double>(), best.at("limited_by").get<std::string>());
  }
}

}  // namespace
}  // namespace turnwright

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  using namespace turnwright;
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const auto cuts = simulated_cuts();
  write(folder / "figure-2.svg", figure_2());
  for (const int elements : {1, 3, 6, 10, 14})
    write(folder / fmt::format("figure-5-{}.svg", elements), figure_5(elements, cuts));
  write(folder / "figure-7.svg", figure_5(0, cuts));
  write(folder / "figure-6.svg", figure_6(cuts));
  figure_7();
}
