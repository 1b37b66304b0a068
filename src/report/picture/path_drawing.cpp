#include "path_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/say.hpp"
#include "chart.hpp"
#include "planning/clamping/jaws.hpp"
#include "planning/clamping/positions.hpp"
#include "program_removal.hpp"
#include "report/text/layout.hpp"
#include "spread.hpp"
#include "svg.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::report {
namespace {

using planning::PreparedPart;

// Millimetres of paper.
constexpr double kWidth = 190, kLeft = 18, kRight = 184, kTop = 24, kHighest = 100;
constexpr double kLine = 4.2, kJaw = 6, kToolGap = 7;
constexpr double kBeside = 5;  // mm of the machine, around the stock
constexpr std::size_t kNameLength = 60, kLegend = 90;
constexpr int kColours = 6;
constexpr double kNothing_mm = 1e-6;

struct Sheet {
  const PreparedPart& part;
  const planning::SetupPlan& setup;
  const toolpath::SetupProgram& program;
  Scale z, x;  ///< x of radii
  Svg svg = {};
  Point place(double z_mm, double x_mm) const { return {z.place(z_mm), x.place(x_mm)}; }
};

std::string colour(const Sheet& s, int tool) {
  const auto at = std::ranges::find(s.program.tools, tool, &toolpath::TableTool::number);
  return fmt::format("tool{}", (at - s.program.tools.begin()) % kColours);
}

/// Without points between others on a line.
std::vector<Point> corners_of(const std::vector<Point>& all) {
  constexpr double kStraight = 0.004;  // mm of paper
  std::vector<Point> kept;
  for (const auto& p : all) {
    while (kept.size() > 1) {
      const Point &a = kept[kept.size() - 2], &b = kept.back();
      const double length = std::hypot(p.x - a.x, p.y - a.y);
      const double off = std::abs((p.x - a.x) * (b.y - a.y) - (p.y - a.y) * (b.x - a.x));
      if (off > kStraight * length) break;
      kept.pop_back();
    }
    kept.push_back(p);
  }
  return kept;
}

/// The area between two heights over a range of columns, counted from the grid's column
/// `first`.
template <class Upper, class Lower>
std::vector<Point> band(const Sheet& s, const Work& grid, std::size_t first,
                        std::size_t from, std::size_t to, Upper upper, Lower lower) {
  std::vector<Point> outline, back;
  for (std::size_t i = from; i < to; ++i) {
    outline.push_back(s.place(grid.z(first + i), upper(i)));
    back.push_back(s.place(grid.z(first + i), lower(i)));
  }
  outline = corners_of(outline);
  back = corners_of(back);
  outline.insert(outline.end(), back.rbegin(), back.rend());
  return outline;
}

/// Calls `draw` with every range of columns for which something holds.
template <class Holds, class Draw>
void each_range(std::size_t count, Holds holds, Draw draw) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!holds(i)) continue;
    const std::size_t from = i;
    while (i < count && holds(i)) ++i;
    draw(from, i);
  }
}

void draw_work(Sheet& s, const Work& work, const char* css_class) {
  const auto& rings = work.rings;
  each_range(
      rings.size(), [&](std::size_t i) { return !rings[i].empty(); },
      [&](std::size_t from, std::size_t to) {
        s.svg.polygon(css_class, band(
                                     s, work, 0, from, to,
                                     [&](std::size_t i) { return rings[i].outer_mm; },
                                     [&](std::size_t i) { return rings[i].inner_mm; }));
      });
}

void draw_removed(Sheet& s, const Work& grid, const CutPass& pass, bool deep) {
  const auto& a = pass.before;
  const auto& b = pass.after;
  const auto css_class = "off " + colour(s, pass.tool) + (deep ? " deep" : "");
  const auto paint = [&](auto holds, auto upper, auto lower) {
    each_range(a.size(), holds, [&](std::size_t from, std::size_t to) {
      s.svg.polygon(css_class, band(s, grid, pass.from, from, to, upper, lower));
    });
  };
  const auto outer_floor = [&](std::size_t i) {
    return std::max(b[i].outer_mm, a[i].inner_mm);
  };
  const auto inner_roof = [&](std::size_t i) {
    return std::min(b[i].inner_mm, a[i].outer_mm);
  };
  paint([&](std::size_t i) { return a[i].outer_mm > outer_floor(i) + kNothing_mm; },
        [&](std::size_t i) { return a[i].outer_mm; }, outer_floor);
  paint([&](std::size_t i) { return inner_roof(i) > a[i].inner_mm + kNothing_mm; },
        inner_roof, [&](std::size_t i) { return a[i].inner_mm; });
}

void draw_jaw(Sheet& s) {
  const auto clamping = s.setup.clamping;
  const double held = planning::grip_diameter_mm(s.part, s.program.setup, clamping) / 2;
  if (!(held > 0)) return;
  const double sign = s.setup.hold == part::End::left ? 1 : -1;
  const double root = sign * (planning::root_z_mm(s.part, s.program.setup, clamping) -
                              planning::free_z_mm(s.part, s.program.setup));
  const Point from = s.place(root - s.part.grips_mm[s.program.setup], held);
  const Point to = s.place(root, held);
  s.svg.polygon("jaw", {from, to, {to.x, to.y - kJaw}, {from.x, from.y - kJaw}});
}

void draw_rapids(Sheet& s) {
  toolpath::Point at{s.program.change_x_mm, s.program.change_z_mm};
  for (const auto& step : s.program.steps) {
    if (step.milling) continue;
    for (const auto& move : step.moves) {
      if (move.kind == toolpath::Move::Kind::rapid)
        s.svg.line("rapid", s.place(at.z_mm, at.h_mm), s.place(move.z_mm, move.x_mm));
      at = {move.x_mm, move.z_mm};
    }
  }
}

/// Where each tool first comes to the work: its number above, a line down to it.
void draw_tool_changes(Sheet& s, const std::vector<CutPass>& all) {
  std::vector<std::pair<double, int>> first;
  for (const auto& pass : all)
    if (&pass == all.data() || (&pass)[-1].tool != pass.tool)
      first.emplace_back(std::clamp(s.z.place(pass.way.front().z_mm), s.z.from, s.z.to),
                         pass.tool);
  std::stable_sort(first.begin(), first.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<double> x;
  for (const auto& [place, tool] : first) x.push_back(place);
  const double room = kRight - kLeft;
  x = spread(x, std::min(kToolGap, room / static_cast<double>(first.size() + 1)), kLeft,
             kRight);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto& [place, tool] = first[i];
    s.svg.text({x[i], kTop - 3.5}, Anchor::middle, fmt::format("T{}", tool));
    s.svg.polyline("leader", {{x[i], kTop - 2.8}, {place, kTop}});
  }
}

double draw_legend(Sheet& s, const std::vector<CutPass>& all, double y) {
  for (const auto& tool : s.program.tools) {
    std::vector<std::string> operations;
    for (const auto& pass : all)
      if (pass.tool == tool.number &&
          std::ranges::find(operations, pass.operation) == operations.end())
        operations.push_back(pass.operation);
    std::string text = fmt::format("T{} {}: ", tool.number, tool.id);
    for (const auto& o : operations) text += (&o == operations.data() ? "" : ", ") + o;
    const double top = y - 2.4;
    s.svg.polygon("off deep " + colour(s, tool.number),
                  {{kLeft, top}, {kLeft + 6, top}, {kLeft + 6, y}, {kLeft, y}});
    s.svg.line("feed " + colour(s, tool.number), {kLeft, y - 1.2}, {kLeft + 6, y - 1.2});
    s.svg.text({kLeft + 8, y}, Anchor::start, clipped(text, kLegend));
    y += kLine;
  }
  s.svg.line("rapid", {kLeft, y - 1}, {kLeft + 6, y - 1});
  s.svg.text(
      {kLeft + 8, y}, Anchor::start,
      tr("rapid; solid: feed of the programmed point; shaded: what each pass takes off"));
  y += kLine;
  s.svg.text({kLeft + 8, y}, Anchor::start, tr("T above the frame: that tool comes in"));
  return y;
}

std::string drawn(const PreparedPart& part, const planning::SetupPlan& setup,
                  const toolpath::SetupProgram& program) {
  const auto [all, grid] = removal(part, setup, program);
  const double end = grid.z(grid.rings.size() - 1);
  const double most = part.drawing.stock.outer_mm / 2 + kBeside, least = -1;
  const double along = (kRight - kLeft) / (end - grid.from_z + 2 * kBeside);
  const double stretch =  // by halves
      std::max(1.0, std::floor(2 * kHighest / (along * (most - least))) / 2);
  const double height = std::min(kHighest, along * stretch * (most - least));
  Sheet s{part,
          setup,
          program,
          {grid.from_z - kBeside, end + kBeside, kLeft, kRight},
          {least, most, kTop + height, kTop}};
  const auto title = clipped(part.drawing.name, kNameLength);
  const auto heading = say("Setup {}: the cut", program.setup + 1);
  s.svg.text({10, 9}, Anchor::start, title, "title");
  s.svg.text(
      {10, 14}, Anchor::start,
      heading +
          (stretch > 1 ? say(", X drawn {} times as large as Z", plain(stretch)) : ""));
  const Scale diameters{2 * least, 2 * most, s.x.from, s.x.to};
  frame(s.svg, s.z, diameters, "Z [mm]", tr("X, diameter [mm]"), 8, 5);
  s.svg.clip({kLeft, kTop}, {kRight, kTop + height});
  draw_work(s, grid, "body");
  bool deep = false;
  for (const auto& pass : all) {
    leave_if_asked();
    draw_removed(s, grid, pass, deep = !deep);
  }
  draw_jaw(s);
  draw_rapids(s);
  for (const auto& pass : all) {
    std::vector<Point> points;
    for (const auto& p : pass.way) points.push_back(s.place(p.z_mm, p.h_mm));
    s.svg.polyline("feed " + colour(s, pass.tool), points);
  }
  s.svg.line("axis", s.place(s.z.low, 0), s.place(s.z.high, 0));
  s.svg.end_clip();
  draw_tool_changes(s, all);
  const double foot = draw_legend(s, all, kTop + height + 14);
  return s.svg.page(kWidth, foot + 4, title + " - " + heading);
}

}  // namespace

std::vector<std::string> path_drawings(const PreparedPart& part,
                                       const planning::ProcessPlan& plan,
                                       const nc::Programs& programs) {
  std::vector<std::string> all;
  for (const auto& program : programs.setups)
    all.push_back(drawn(part, plan.setups.at(program.setup), program));
  return all;
}

}  // namespace turnwright::report
