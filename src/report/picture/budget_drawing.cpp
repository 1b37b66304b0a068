#include "budget_drawing.hpp"

#include <algorithm>
#include <vector>

#include "base/say.hpp"
#include "report/text/layout.hpp"
#include "report/text/plan_words.hpp"
#include "report/text/result_words.hpp"
#include "report/text/stack.hpp"
#include "svg.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::report {
namespace {

using planning::ToleranceResult;

// Millimetres of paper.
constexpr double kPage = 190, kNamesEnd = 66, kWhole = 100, kMost = 1.2;  // of kWhole
constexpr double kRow = 6.5, kBar = 4, kTop = 20, kKey = 3, kKeyWidth = 30;
constexpr std::size_t kName = 60, kLabel = 36, kKeysARow = 6;

Stack stack_of(const ToleranceResult& t) {
  Shares shares;
  for (const auto& s : t.shares) shares.emplace_back(s.source, s.um);
  return stack(units::um_from_mm(t.width_mm), units::um_from_mm(t.margin_mm),
               static_cast<int>(t.predicted_mm.size()), shares);
}

/// The style's class of a source (svg.cpp), grey for any that has none.
std::string paint(const std::string& source) {
  static const std::vector<std::string> kPainted = {
      "deflection", "machine", "jaw-squeeze", "drift",      "repeatability",
      "wear",       "heat",    "rechucking",  "measurement"};
  return std::find(kPainted.begin(), kPainted.end(), source) == kPainted.end()
             ? "share"
             : "share " + source;
}

void box(Svg& svg, const std::string& css_class, double x0, double x1, double y0,
         double y1) {
  svg.polygon(css_class, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

void draw_bar(Svg& svg, const ToleranceResult& t, const Stack& s, double y) {
  const double scale = kWhole / units::um_from_mm(t.width_mm);
  const double last = kNamesEnd + kMost * kWhole;
  const auto label = say("{}: {} of {}", t.id, kind_words(part::name(t.kind)), t.of);
  svg.text({kNamesEnd - 2, y + kBar - 1}, Anchor::end, clipped(label, kLabel));
  double x = kNamesEnd;
  for (const auto& [source, um] : s.slices) {
    const double to = std::min(last, x + scale * std::max(0.0, um));
    if (to > x) box(svg, paint(source), x, to, y, y + kBar);
    x = to;
  }
  box(svg, "frame", kNamesEnd, kNamesEnd + kWhole, y, y + kBar);
  svg.text({std::max(x, kNamesEnd + kWhole) + 1.5, y + kBar - 1}, Anchor::start,
           plain(units::um_from_mm(t.width_mm), 1) + " \u00b5m" +
               (s.over() ? tr(", over") : ""),
           s.over() ? "accent" : "");
}

double draw_key(Svg& svg, const std::vector<std::string>& sources, double y) {
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const double x = 10 + kKeyWidth * static_cast<double>(i % kKeysARow);
    if (i > 0 && i % kKeysARow == 0) y += 5;
    box(svg, paint(sources[i]), x, x + kKey, y, y + kKey);
    svg.text({x + kKey + 1.2, y + kKey - 0.5}, Anchor::start,
             clipped(spoken(sources[i]), 16));
  }
  return y + 5;
}

}  // namespace

std::string budget_drawing(const planning::PreparedPart& part,
                           const planning::ProcessPlan& plan) {
  std::vector<Stack> stacks;
  for (const auto& t : plan.tolerances) stacks.push_back(stack_of(t));
  if (stacks.empty()) return {};
  Svg svg;
  const auto title = clipped(part.drawing.name, kName);
  svg.text({10, 9}, Anchor::start, title, "title");
  svg.text({10, 14}, Anchor::start,
           tr("What takes each tolerance's width; the white rest is left"));
  double y = kTop;
  for (std::size_t i = 0; i < stacks.size(); ++i, y += kRow)
    draw_bar(svg, plan.tolerances[i], stacks[i], y);
  y = draw_key(svg, sources(stacks), y + 3);
  return svg.page(kPage, y + 3, say("{} - tolerance budget", title));
}

}  // namespace turnwright::report
