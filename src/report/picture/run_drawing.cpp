#include "run_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/say.hpp"
#include "chart.hpp"
#include "report/text/json_fields.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

constexpr double kRunWidth = 190, kRunLeft = 24, kRunRight = 184, kRunTop = 22,
                 kRunBottom = 92, kMark = 0.6;

struct Run {
  const ordered_json& of;
  double nominal_mm = 0;
  Scale x, y;
  double um(double mm) const { return units::um_from_mm(mm - nominal_mm); }
  double place(double mm) const { return y.place(um(mm)); }
};

Run run_of(const ordered_json& c) {
  Run run{c, number(c, "nominal_mm").value_or(0), {}, {}};
  const auto& values = list(c, "values");
  double low = HUGE_VAL, high = -HUGE_VAL;
  const auto reach = [&](std::optional<double> mm) {
    if (!mm) return;
    low = std::min(low, run.um(*mm));
    high = std::max(high, run.um(*mm));
  };
  reach(number(c, "upper_mm"));
  reach(number(c, "lower_mm").value_or(run.nominal_mm));
  for (const auto& v : values)
    if (v.contains("fitted_mm")) reach(number(v, "value_mm"));
  const double room = 0.08 * std::max(high - low, 1e-6);
  run.y = {low - room, high + room, kRunBottom, kRunTop};
  run.x = {0, static_cast<double>(values.size()) + 1, kRunLeft, kRunRight};
  return run;
}

void limit(Svg& svg, const Run& run, const char* key) {
  const auto at = number(run.of, key);
  if (!at) return;
  const double y = run.place(*at);
  svg.line("made", {kRunLeft, y}, {kRunRight, y});
}

// Crosses; a value that does not count stands in the other colour, outside of the frame on
// its edge.
void marks(Svg& svg, const Run& run) {
  double i = 0;
  for (const auto& v : list(run.of, "values")) {
    const bool counts = v.contains("fitted_mm");
    const double x = run.x.place(++i),
                 y = std::clamp(run.place(number(v, "value_mm").value_or(0)), kRunTop,
                                kRunBottom);
    const char* line = counts ? "thin" : "made";
    const double size = counts ? kMark : 2 * kMark;
    svg.line(line, {x - size, y - size}, {x + size, y + size});
    svg.line(line, {x - size, y + size}, {x + size, y - size});
    if (!counts)
      svg.text({x, y + (y > (kRunTop + kRunBottom) / 2 ? -2 : 4)}, Anchor::middle,
               word(v, "part"), "accent");
  }
}

void fit_and_edges(Svg& svg, const Run& run) {
  std::vector<Point> line;
  std::string edge;
  double i = 0;
  const auto end = [&] {
    if (line.size() > 1) svg.polyline("path", line);
    line.clear();
  };
  for (const auto& v : list(run.of, "values")) {
    const double x = run.x.place(++i);
    if (i > 1 && word(v, "edge") != edge) {
      end();
      const double between = run.x.place(i - 0.5);
      svg.line("leader", {between, kRunTop}, {between, kRunBottom});
    }
    edge = word(v, "edge");
    if (const auto fitted = number(v, "fitted_mm"))
      line.push_back({x, run.place(*fitted)});
  }
  end();
}

std::string index(const ordered_json& c, const char* group, const char* key) {
  const auto& e = object(object(c, group), key);
  if (e.empty()) return "";
  return say("{} {} ({} to {})", key, shown(number(e, "value"), 2),
             shown(number(e, "lower"), 2), shown(number(e, "upper"), 2));
}

std::string um_of(const ordered_json& e, const char* key) {
  const auto mm = number(e, key);
  return mm ? plain(units::um_from_mm(*mm), 1) : "-";
}

std::string advice_line(const ordered_json& c) {
  const auto& a = object(c, "advice");
  if (a.empty()) return "";
  const auto& by = object(a, "correction_mm");
  auto text =
      say("next part: correct by {} um (u {} um)", um_of(by, "value"), um_of(by, "u"));
  if (!flag(a, "worthwhile")) text += tr(", which may be nothing");
  if (const auto due = number(a, "due_in_parts"))
    text += say("; again after {} parts", shown(due, 0));
  return text;
}

std::string run_drawing(const ordered_json& c) {
  const Run run = run_of(c);
  Svg svg;
  const std::string name = word(c, "id");
  svg.text({8, 11}, Anchor::start, name, "title");
  svg.text({8, 17}, Anchor::start,
           say("nominal {} mm; {} values, {} left out; red: limits, dashed: fit "
               "within edges",
               plain(run.nominal_mm, 6), shown(number(c, "n"), 0),
               shown(number(c, "left_out"), 0)));
  frame(svg, run.x, run.y, tr("values in the order of making"), tr("deviation, um"), 8,
        6);
  fit_and_edges(svg, run);
  limit(svg, run, "upper_mm");
  limit(svg, run, "lower_mm");
  marks(svg, run);
  std::vector<std::string> words;
  for (const auto& text :
       {index(c, "within", "Cp"), index(c, "within", "Cpk"), index(c, "overall", "Ppk")})
    if (!text.empty()) words.push_back(text);
  svg.text({8, kRunBottom + 14}, Anchor::start, joined(words, "; "));
  svg.text({8, kRunBottom + 19}, Anchor::start, advice_line(c));
  return svg.page(kRunWidth, kRunBottom + 24, say("Run of {}", name));
}

}  // namespace

std::vector<Figure> run_drawings(const ordered_json& result) {
  std::vector<Figure> all;
  for (const auto& c : list(result, "characteristics"))
    all.push_back({fmt::format("run-{}.svg", all.size() + 1), run_drawing(c)});
  return all;
}

}  // namespace turnwright::report
