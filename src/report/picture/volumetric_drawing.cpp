#include "volumetric_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "base/say.hpp"
#include "chart.hpp"
#include "report/text/result_words.hpp"
#include "svg.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::report {
namespace {

using namespace volumetric;
using std::numbers::pi;

constexpr double kWidth = 190, kMargin = 8;
// The circle of a ball-bar test, and how far traces may stand off it.
constexpr double kCentreX = 72, kCentreY = 80, kRadius = 42, kRoom = 14;
constexpr const char *kCcw = "made", *kCw = "path";

std::string um(double mm, int decimals = 2) {
  return plain(units::um_from_mm(mm), decimals);
}

struct Circle {
  double e_u = 0, e_v = 0, factor = 1;
  Point at(double theta, double value) const {
    const double c = std::cos(theta), s = std::sin(theta);
    const double r = kRadius + factor * (value - e_u * c - e_v * s);
    return {kCentreX + r * c, kCentreY - r * s};
  }
};

/// The largest deviation from the common centre.
double largest(const Trace& t, const Circle& c) {
  double out = 0;
  for (std::size_t k = 0; k < t.theta_rad.size(); ++k) {
    const double centre =
        c.e_u * std::cos(t.theta_rad[k]) + c.e_v * std::sin(t.theta_rad[k]);
    out = std::max({out, std::abs(t.ccw_mm[k] - centre), std::abs(t.cw_mm[k] - centre)});
  }
  return out;
}

std::vector<Point> ring(double radius) {
  std::vector<Point> out;
  for (int k = 0; k <= 180; ++k)
    out.push_back({kCentreX + radius * std::cos(k * pi / 90),
                   kCentreY - radius * std::sin(k * pi / 90)});
  return out;
}

/// Rings of round deviations, axes with their names; returns the rings' distance [mm].
double dial(Svg& svg, const Circle& c, Plane plane) {
  const double step = round_below(kRoom / c.factor * 1.0001) / 2;
  for (int k = -2; k <= 2; ++k)
    svg.polyline(k == 0 ? "stock" : "leader", ring(kRadius + k * step * c.factor));
  const double reach = kRadius + kRoom + 3;
  svg.line("axis", {kCentreX - reach, kCentreY}, {kCentreX + reach, kCentreY});
  svg.line("axis", {kCentreX, kCentreY + reach}, {kCentreX, kCentreY - reach});
  const auto [u, v] = axes_of(plane);
  svg.text({kCentreX + reach + 1, kCentreY + 1}, Anchor::start, std::string("+") + u);
  svg.text({kCentreX, kCentreY - reach - 1.5}, Anchor::middle, std::string("+") + v);
  return step;
}

/// Amplitude of the n-th undulation of a path [mm], by quadrature over its angles.
double lobe(const std::vector<double>& theta, const std::vector<double>& path, int n) {
  double a = 0, b = 0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    a += path[k] * std::cos(n * theta[k]);
    b += path[k] * std::sin(n * theta[k]);
  }
  return 2 * std::hypot(a, b) / static_cast<double>(path.size());
}

void lobes(Svg& svg, const Trace& t, double top) {
  constexpr int kFirst = 2, kLast = 8;
  double most = 0;
  std::vector<std::array<double, 2>> all;
  for (int n = kFirst; n <= kLast; ++n) {
    all.push_back({lobe(t.theta_rad, t.ccw_mm, n), lobe(t.theta_rad, t.cw_mm, n)});
    most = std::max({most, all.back()[0], all.back()[1]});
  }
  if (!(most > 0)) return;
  const Scale x{kFirst - 0.7, kLast + 0.7, 150, 184},
      y{0, units::um_from_mm(most) * 1.1, top + 30, top};
  frame(svg, x, y, tr("undulations per turn"), tr("amplitude, um"), 7, 4);
  for (int n = kFirst; n <= kLast; ++n)
    for (const int path : {0, 1}) {
      const double at = x.place(n) + (path == 0 ? -0.6 : 0.6);
      const double value =
          all[static_cast<std::size_t>(n - kFirst)][static_cast<std::size_t>(path)];
      svg.line(path == 0 ? kCcw : "path", {at, y.from},
               {at, y.place(units::um_from_mm(value))});
    }
}

std::string in_words(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return spoken(name);
}

void key(Svg& svg, Point at, const char* line, const char* words,
         const std::string& text) {
  svg.line(line, {at.x, at.y - 1}, {at.x + 8, at.y - 1});
  svg.text({at.x + 10, at.y}, Anchor::start, text, words);
}

void polar_key(Svg& svg, double y) {
  key(svg, {kMargin, y}, kCcw, "accent", tr("counter-clockwise"));
  key(svg, {kMargin + 48, y}, kCw, "path", tr("clockwise"));
  key(svg, {kMargin + 84, y}, "thin", "", tr("fit of twelve terms, both ways"));
}

}  // namespace

std::string ball_bar_drawing(const Trace& t) {
  const BallBarFit fit = decompose(t);
  const Iso230_4 iso = iso230_4(t);
  Circle c{.e_u = fit.value[0], .e_v = fit.value[1]};
  const double most = largest(t, c);
  c.factor = most > 0 ? round_below(kRoom / most * 1.0001) : 1;
  Svg svg;
  const auto [u, v] = axes_of(t.plane);
  const std::string name = say("Ball bar {}{}, R = {} mm", u, v, plain(t.R_mm));
  svg.text({kMargin, 11}, Anchor::start, name, "title");
  const double ring_mm = dial(svg, c, t.plane);
  for (const double dir : {1.0, -1.0}) {
    std::vector<Point> trace, fitted;
    const auto& path = dir > 0 ? t.ccw_mm : t.cw_mm;
    for (std::size_t k = 0; k < path.size(); ++k)
      trace.push_back(c.at(t.theta_rad[k], path[k]));
    trace.push_back(trace.front());
    for (int k = 0; k <= 720; ++k) {
      const double theta = (k + 0.5) * pi / 360;
      fitted.push_back(c.at(theta, fitted_mm(fit, t.R_mm, theta, dir)));
    }
    svg.polyline("thin", fitted);
    svg.polyline(dir > 0 ? kCcw : kCw, trace);
  }
  const double below = kCentreY + kRadius + kRoom + 12;
  polar_key(svg, below);
  svg.text({kMargin, below + 5}, Anchor::start,
           say("deviations {} : 1 about the common centre ({} {}, {} {} um); rings {} "
               "um apart, dashed: 0; 1 mm of paper is {} um",
               plain(c.factor), u, um(c.e_u), v, um(c.e_v), um(ring_mm, 4),
               um(1 / c.factor, 4)));
  lobes(svg, t, 22);
  double y = 74;
  const auto row = [&](const std::string& what, const std::string& value) {
    svg.text({141, y}, Anchor::start, what);
    svg.text({184, y}, Anchor::end, value);
    y += 4;
  };
  row(tr("RANGE OF EACH EFFECT"), "um");
  for (const Contribution& of : fit.ranking) row(in_words(of.name), um(of.range_mm));
  y += 2;
  row(tr("G ccw, G cw"), um(iso.G_ccw_mm) + ", " + um(iso.G_cw_mm));
  row(tr("hysteresis H"), um(iso.H_mm));
  row(tr("left by the fit, RMS"), um(fit.rms_mm, 3));
  return svg.page(kWidth, below + 10, name);
}

std::string compensation_drawing(const Compensated& compensated) {
  constexpr double kFloor_um = 1e-4;
  constexpr std::size_t kColumns = 800;
  const auto& all = compensated.distances_mm;
  const std::size_t columns = std::min(kColumns, all.size());
  std::array<std::vector<double>, 2> log_um;
  double most = std::log10(kFloor_um) + 1;
  for (std::size_t i = 0; i < columns; ++i)
    for (const std::size_t k : {0u, 1u}) {
      float here = 0;
      for (std::size_t j = i * all.size() / columns; j < (i + 1) * all.size() / columns;
           ++j)
        here = std::max(here, all[j][k]);
      log_um[k].push_back(
          std::log10(std::max(kFloor_um, units::um_from_mm(double{here}))));
      most = std::max(most, log_um[k].back());
    }
  const Scale x{0, std::max(1.0, static_cast<double>(all.size())), 24, 182},
      y{std::log10(kFloor_um), std::ceil(most - 1e-6), 92, 26};  // floats: 1.00000005
  Svg svg;
  svg.text({kMargin, 11}, Anchor::start, tr("Distance of the tip from its target"),
           "title");
  svg.polyline(
      "",
      {{x.from, y.from}, {x.to, y.from}, {x.to, y.to}, {x.from, y.to}, {x.from, y.from}});
  for (double power = y.low; power <= y.high; ++power) {
    svg.line("leader", {x.from, y.place(power)}, {x.to, y.place(power)});
    svg.text({x.from - 1, y.place(power) + 1}, Anchor::end,
             plain(std::pow(10, power), 4));
  }
  for (const double t : ticks(x, 6)) {
    svg.line("thin", {x.place(t), y.from}, {x.place(t), y.from - 1});
    svg.text({x.place(t), y.from + 3.6}, Anchor::middle, plain(t, 0));
  }
  svg.text({(x.from + x.to) / 2, y.from + 8}, Anchor::middle, tr("moves of the program"));
  svg.text_upwards({11, (y.from + y.to) / 2}, Anchor::middle, "um");
  for (const std::size_t k : {0u, 1u}) {
    std::vector<Point> line;
    for (std::size_t i = 0; i < columns; ++i)
      line.push_back({x.place((static_cast<double>(i) + 0.5) * x.high /
                              static_cast<double>(columns)),
                      y.place(log_um[k][i])});
    if (!line.empty()) svg.polyline(k == 0 ? kCcw : "path", line);
  }
  const auto told = [](const Deviation& d) {
    return say("largest {} um, RMS {} um", um(d.max_mm, 4), um(d.rms_mm, 4));
  };
  key(svg, {kMargin, 17}, kCcw, "accent", say("before: {}", told(compensated.before)));
  key(svg, {kMargin + 92, 17}, kCw, "path", say("after: {}", told(compensated.after)));
  return svg.page(kWidth, 104, tr("Distance of the tip from its target"));
}

namespace {

bool zero(const ErrorFunction& e) {
  const auto none = [](double c) { return c == 0; };
  return std::ranges::all_of(e.c, none) && e.b == 0 &&
         std::ranges::all_of(e.f, [](const Harmonic& h) { return h.a == 0 && h.d == 0; });
}

/// One axis' shifts (first = 0) or turns (first = 3) in a frame; false if all are zero.
bool errors_of(Svg& svg, const Axis& axis, std::size_t first, double left, double top) {
  constexpr int kSteps = 120;
  constexpr std::array<const char*, 3> kLine = {"made", "path", ""},
                                       kWord = {"accent", "path", ""};
  const bool turns = first > 0, rotary = is_rotary(axis.name);
  const double unit = turns ? 1e6 : units::um_from_mm(1);
  const double travel = rotary ? 180 / pi * axis.Q : axis.Q;
  struct Curve {
    std::size_t k;
    std::vector<std::array<double, 2>> points;
  };
  std::vector<Curve> curves;
  double low = 0, high = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const ErrorFunction& e = axis.errors[first + k];
    if (zero(e)) continue;
    for (const double sign : {1.0, -1.0}) {
      if (sign < 0 && e.b == 0) continue;
      Curve c{k, {}};
      for (int i = -kSteps; i <= kSteps; ++i) {
        const double share = static_cast<double>(i) / kSteps;
        const double v = unit * error_at(e, share * axis.Q, axis.Q, sign);
        low = std::min(low, v);
        high = std::max(high, v);
        c.points.push_back({share * travel, v});
      }
      curves.push_back(c);
    }
  }
  if (curves.empty()) return false;
  if (low == high) high = low + 1;
  const double room = 0.08 * (high - low);
  const Scale x{-travel, travel, left, left + 68},
      y{low - room, high + room, top + 36, top};
  frame(svg, x, y, std::string(1, axis.name) + (rotary ? ", deg" : ", mm"),
        turns ? "urad" : "um", 4, 5);
  double at = left;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Curve& c = curves[i];
    std::vector<Point> line;
    for (const auto& [q, v] : c.points) line.push_back({x.place(q), y.place(v)});
    svg.polyline(kLine[c.k], line);
    if (i > 0 && curves[i - 1].k == c.k) continue;
    const std::string name{'E', kLetters[first + c.k], axis.name};
    svg.line(kLine[c.k], {at, top - 2.6}, {at + 6, top - 2.6});
    svg.text({at + 7, top - 1.6}, Anchor::start, name, kWord[c.k]);
    at += 18;
  }
  return true;
}

}  // namespace

namespace {

/// A mean by position, with twice a standard deviation to either side.
struct Course {
  std::optional<double> PositionValues::*mean, PositionValues::*s;
  const char *line, *words;
  std::string name;
};

std::vector<Course> courses() {
  return {{&PositionValues::mean_plus_mm, &PositionValues::s_plus_mm, kCcw, "accent",
           tr("mean in +")},
          {&PositionValues::mean_minus_mm, &PositionValues::s_minus_mm, kCw, "path",
           tr("mean in -")}};
}

/// Points of a course at the positions that have it, `coverage` standard deviations away.
std::vector<Point> points_of(const Course& course, const Iso230_2& values,
                             double coverage) {
  std::vector<Point> out;
  for (const PositionValues& p : values.positions) {
    const auto &mean = p.*course.mean, &s = p.*course.s;
    if (mean && (coverage == 0 || s))
      out.push_back({p.q_mm, units::um_from_mm(*mean + coverage * s.value_or(0))});
  }
  return out;
}

constexpr double kBand = 2;  // standard deviations

/// A scale with some room beyond all points; of one value 1 to either side.
Scale scale_of(const std::vector<double>& values, double from, double to, double room) {
  const auto [low, high] = std::ranges::minmax(values);
  const double more = low == high ? 1 : room * (high - low);
  return {low - more, high + more, from, to};
}

/// How far an extent reaches, as a dimension beside the frame.
void dimension(Svg& svg, const Scale& y, double x, const char* name,
               const std::optional<Extent>& extent) {
  if (!extent) return;
  const double low = y.place(units::um_from_mm(extent->low_mm)),
               high = y.place(units::um_from_mm(extent->high_mm));
  svg.line("", {x, low}, {x, high});
  for (const double end : {low, high}) svg.line("", {x - 1.5, end}, {x + 1.5, end});
  svg.text({x, high - 4.4}, Anchor::middle, name);
  svg.text({x, high - 1.2}, Anchor::middle, um(extent->width_mm()));
}

}  // namespace

std::string positioning_drawing(char axis, const Iso230_2& values) {
  constexpr double kTop = 34, kBottom = 108;
  const std::string name = say("Positioning of axis {}, ISO 230-2", axis);
  Svg svg;
  svg.text({kMargin, 11}, Anchor::start, name, "title");
  std::vector<double> places, um_all{0};
  for (const Course& course : courses())
    for (const double coverage : {-kBand, 0.0, kBand})
      for (const Point& p : points_of(course, values, coverage)) {
        places.push_back(p.x);
        um_all.push_back(p.y);
      }
  if (places.empty()) return svg.page(kWidth, 20, name);
  const Scale x = scale_of(places, 24, 142, 0.03),
              y = scale_of(um_all, kBottom, kTop, 0.06);
  frame(svg, x, y, std::string(1, axis) + ", mm", tr("deviation, um"), 6, 6);
  double at = kMargin;
  for (const Course& course : courses()) {
    if (points_of(course, values, 0).empty()) continue;
    key(svg, {at, 18}, course.line, course.words, course.name);
    at += 44;
    for (const double coverage : {-kBand, 0.0, kBand}) {
      auto line = points_of(course, values, coverage);
      if (line.empty()) continue;
      for (Point& p : line) p = {x.place(p.x), y.place(p.y)};
      svg.polyline(coverage == 0 ? course.line : "thin", line);
    }
  }
  key(svg, {at, 18}, "thin", "", tr("two standard deviations off"));
  dimension(svg, y, 151, "A", values.A);
  dimension(svg, y, 165, "E", values.E);
  dimension(svg, y, 179, "M", values.M);
  return svg.page(kWidth, kBottom + 12, name);
}

std::string error_map(const Machine& machine) {
  Svg svg;
  svg.text({kMargin, 11}, Anchor::start,
           say("Errors along the axes of {}", machine.chain), "title");
  svg.text({kMargin, 17}, Anchor::start, tr("pairs of lines: moving in + and in -"));
  double top = 27;
  for (const Axis& axis : machine.axes) {
    const bool shifts = errors_of(svg, axis, 0, 24, top),
               turns = errors_of(svg, axis, 3, 116, top);
    if (shifts || turns) top += 56;
  }
  if (top == 27) svg.text({kMargin, 23}, Anchor::start, tr("none along any axis"));
  return svg.page(kWidth, std::max(30.0, top - 6),
                  say("Errors along the axes of {}", machine.chain));
}

}  // namespace turnwright::report
