#include "milled_drawing.hpp"

#include <algorithm>
#include <stdexcept>

#include "base/say.hpp"
#include "chart.hpp"
#include "report/text/layout.hpp"

namespace turnwright::report {
namespace {

// Millimetres of paper.
constexpr double kWidth = 190, kHeight = 118, kLeft = 20, kRight = 182, kTop = 20,
                 kBottom = 100, kMark = 1.1;
constexpr std::size_t kNameLength = 34;

struct Sheet {
  Scale n, depth;
  Svg svg = {};
  Point place(double n_rpm, double depth_mm) const {
    return {n.place(std::clamp(n_rpm, n.low, n.high)),
            depth.place(std::clamp(depth_mm, depth.low, depth.high))};
  }
};

// The line of the first losses, and all that lies above it.
void draw_limit(Sheet& s, const planning::MilledCut& cut) {
  std::vector<Point> line;
  for (std::size_t k = 0; k < cut.n_rpm.size(); ++k)
    line.push_back(s.place(cut.n_rpm[k], cut.limits_mm[k].value_or(cut.shown_mm)));
  auto above = line;
  above.push_back(s.place(s.n.high, s.depth.high));
  above.push_back(s.place(s.n.low, s.depth.high));
  s.svg.polygon("count2", above);
  s.svg.polyline("", line);
}

// The chosen pass with what its margins reach.
void draw_choice(Sheet& s, const planning::MilledCut& cut, const planning::Pass& pass) {
  const double n = pass.n_rpm, ap = pass.ap_mm;
  const double deep = ap * (1 + cut.depth_margin);
  s.svg.polyline("accent", {s.place(n * (1 - cut.speed_margin), 0),
                            s.place(n * (1 - cut.speed_margin), deep),
                            s.place(n * (1 + cut.speed_margin), deep),
                            s.place(n * (1 + cut.speed_margin), 0)});
  const Point at = s.place(n, ap);
  s.svg.polygon("best", {{at.x - kMark, at.y},
                         {at.x, at.y - kMark},
                         {at.x + kMark, at.y},
                         {at.x, at.y + kMark}});
  const bool left = at.x > (kLeft + kRight) / 2;
  s.svg.text({at.x + (left ? -4 : 4), at.y + 1}, left ? Anchor::end : Anchor::start,
             plain(n, 0) + "/min, " + plain(ap) + " mm", "path");
}

}  // namespace

std::string milled_drawing(const planning::OperationPlan& operation) {
  if (!operation.milled || operation.passes.empty() || operation.milled->n_rpm.size() < 2)
    throw std::domain_error("milled_drawing: the operation must mill");
  const auto& cut = *operation.milled;
  Sheet s{{cut.n_rpm.front(), cut.n_rpm.back(), kLeft, kRight},
          {0, cut.shown_mm, kBottom, kTop}};
  if (!(s.n.low < s.n.high)) s.n.high = s.n.low * 1.01;
  const auto title =
      say("{}: stable depth over speed", clipped(operation.id, kNameLength));
  s.svg.text({10, 9}, Anchor::start, title, "title");
  s.svg.text({10, 14}, Anchor::start,
             say("shaded: chatter; box: the margins asked for, {} % of speed and {} % of "
                 "depth; diamond: the pass chosen",
                 plain(100 * cut.speed_margin), plain(100 * cut.depth_margin)));
  draw_limit(s, cut);
  frame(s.svg, s.n, s.depth, tr("spindle speed, 1/min"), tr("depth of a pass, mm"), 8, 6);
  draw_choice(s, cut, operation.passes.front());
  return s.svg.page(kWidth, kHeight, title);
}

}  // namespace turnwright::report
