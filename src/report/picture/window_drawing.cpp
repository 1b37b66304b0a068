#include "window_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "base/say.hpp"
#include "report/text/layout.hpp"
#include "svg.hpp"
#include "turnwright/planning/limit_words.hpp"

namespace turnwright::report {
namespace {

// Millimetres of paper.
constexpr double kWidth = 190, kLeft = 22, kRight = 130, kTop = 20, kBottom = 115;
constexpr double kKey = 136, kKeyGap = 4.2, kPointSize = 1.2;
constexpr std::size_t kNameLength = 34;
constexpr double kAround = 1.25;  // of what the window holds

struct Axis {
  double low = 0, high = 0, from = 0, to = 0;  // values, and their places on paper
  double place(double value) const {
    return from + (to - from) * std::log(value / low) / std::log(high / low);
  }
};

Axis axis_over(const std::vector<double>& values, double from, double to) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low / kAround, *high * kAround, from, to};
}

struct Sheet {
  Axis v, f;
  Svg svg = {};
  double key = kTop + 4;
  std::set<std::string> named = {};

  std::vector<Point> points(const std::vector<double>& speeds,
                            const std::vector<double>& feeds) const {
    std::vector<Point> all;
    for (std::size_t k = 0; k < speeds.size(); ++k)
      all.push_back({v.place(speeds[k]), f.place(feeds[k])});
    return all;
  }
};

// Once for every name: a letter at the line and what it stands for beside the picture.
void name_line(Sheet& s, const std::string& name, Point at,
               const std::string& css_class) {
  if (!s.named.insert(name).second) return;
  const std::string letter(1, static_cast<char>('a' + (s.named.size() - 1) % 26));
  s.svg.text({at.x + 0.8, at.y - 0.8}, Anchor::start, letter, css_class);
  s.svg.text({kKey, s.key}, Anchor::start,
             letter + "  " + clipped(planning::limit_words(name), kNameLength),
             css_class);
  s.key += kKeyGap;
}

// 1, 2, 5, 10, .. inside the axis, and its ends' neighbours where these are few.
std::vector<double> ticks(const Axis& axis) {
  for (const int parts : {1, 2, 5, 10, 20}) {
    std::vector<double> all;
    const double step =
        std::pow(10, std::floor(std::log10(axis.high - axis.low))) / parts;
    for (double x = std::ceil(axis.low / step) * step; x <= axis.high; x += step)
      all.push_back(x);
    if (all.size() >= 4) return all;
  }
  return {axis.low, axis.high};
}

void draw_axes(Sheet& s) {
  s.svg.polyline("thin", {{kLeft, kTop},
                          {kLeft, kBottom},
                          {kRight, kBottom},
                          {kRight, kTop},
                          {kLeft, kTop}});
  for (const double x : ticks(s.v)) {
    s.svg.line("thin", {s.v.place(x), kBottom}, {s.v.place(x), kBottom + 1.5});
    s.svg.text({s.v.place(x), kBottom + 5}, Anchor::middle, plain(x));
  }
  for (const double y : ticks(s.f)) {
    s.svg.line("thin", {kLeft - 1.5, s.f.place(y)}, {kLeft, s.f.place(y)});
    s.svg.text({kLeft - 2.5, s.f.place(y) + 1}, Anchor::end, plain(y));
  }
  s.svg.text({(kLeft + kRight) / 2, kBottom + 10}, Anchor::middle, "vc [m/min]");
  s.svg.text_upwards({7, (kTop + kBottom) / 2}, Anchor::middle, "f [mm/rev]");
}

void draw_curves(Sheet& s, const std::vector<planning::WindowCurve>& curves,
                 const std::string& css_class) {
  for (const auto& c : curves) {
    std::vector<double> speeds, feeds;  // inside the axes
    for (std::size_t k = 0; k < c.vc_m_min.size(); ++k)
      if (c.vc_m_min[k] >= s.v.low && c.vc_m_min[k] <= s.v.high &&
          c.f_mm_rev[k] >= s.f.low && c.f_mm_rev[k] <= s.f.high) {
        speeds.push_back(c.vc_m_min[k]);
        feeds.push_back(c.f_mm_rev[k]);
      }
    if (speeds.size() < 2) continue;
    const auto points = s.points(speeds, feeds);
    s.svg.polyline(css_class, points);
    name_line(s, c.name, points.back(), css_class);
  }
}

}  // namespace

std::string window_drawing(const planning::OperationPlan& operation) {
  if (!operation.window || operation.passes.empty())
    throw std::domain_error("window_drawing: the operation must have a window");
  const auto& w = *operation.window;
  Sheet s{axis_over(w.vc_m_min, kLeft, kRight), axis_over(w.f_mm_rev, kBottom, kTop)};
  const auto title =
      say("{}: window of speed and feed", clipped(operation.id, kNameLength));
  s.svg.text({10, 9}, Anchor::start, title, "title");
  s.svg.text({10, 14}, Anchor::start,
             say("every limit kept, at most {} % above the optimum (the diamond)",
                 plain(w.percent)));
  const auto corners = s.points(w.vc_m_min, w.f_mm_rev);
  s.svg.polygon("error", corners);
  draw_axes(s);
  draw_curves(s, w.cost_curves, "hidden");
  draw_curves(s, w.limit_curves, "cut");
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto& next = corners[(k + 1) % corners.size()];
    name_line(s, w.limits[k], {(corners[k].x + next.x) / 2, (corners[k].y + next.y) / 2},
              "accent");
  }
  auto outline = corners;
  outline.push_back(corners.front());
  s.svg.polyline("made", outline);
  const auto& pass = operation.passes.front();
  const Point optimum{s.v.place(pass.vc_m_min), s.f.place(pass.f_mm_rev)};
  s.svg.polygon("centre", {{optimum.x - kPointSize, optimum.y},
                           {optimum.x, optimum.y - kPointSize},
                           {optimum.x + kPointSize, optimum.y},
                           {optimum.x, optimum.y + kPointSize}});
  return s.svg.page(kWidth, std::max(kBottom + 16, s.key + 4), title);
}

}  // namespace turnwright::report
