#include "stability_chart.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "base/say.hpp"
#include "chart.hpp"

namespace turnwright::report {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

// Millimetres of paper.
constexpr double kPage = 190, kHeight = 128, kLeft = 20, kRight = 182, kTop = 20,
                 kBottom = 104, kMark = 0.9;
constexpr int kShades = 4;

/// One speed with the width it stands for.
struct Column {
  double n_rpm = 0, from_rpm = 0, to_rpm = 0;
  const ordered_json* speed = nullptr;  ///< none of a speed that is undecided
};

std::vector<Column> columns(const ordered_json& result) {
  std::vector<Column> out;
  const auto add = [&](double n, const ordered_json* s) { out.push_back({n, n, n, s}); };
  for (const auto& s : result.at("speeds")) add(s.at("n_rpm"), &s);
  if (result.contains("undecided"))
    for (const auto& u : result.at("undecided"))
      if (u.at("pointer").get_ref<const std::string&>().starts_with("/speeds_rpm"))
        add(u.at("n_rpm"), nullptr);
  std::ranges::stable_sort(out, {}, &Column::n_rpm);
  for (std::size_t i = 0; i + 1 < out.size(); ++i)
    out[i].to_rpm = out[i + 1].from_rpm = (out[i].n_rpm + out[i + 1].n_rpm) / 2;
  if (out.front().n_rpm == out.back().n_rpm) {  // one speed alone: a tenth of it wide
    out.front().from_rpm *= 0.95;
    out.back().to_rpm *= 1.05;
  }
  return out;
}

class Chart {
 public:
  Chart(const ordered_json& result, double deepest_mm)
      : result_(result), columns_(columns(result)), deepest_(deepest_mm) {
    speed_ = {columns_.front().from_rpm, columns_.back().to_rpm, kLeft, kRight};
    depth_ = {0, deepest_, kBottom, kTop};
  }

  void fill() {
    for (const Column& c : columns_) {
      if (!c.speed)
        box("outside", place(c.from_rpm, deepest_), place(c.to_rpm, 0));
      else if (c.speed->contains("unstable_multipliers"))
        fill_counts(c);
      else
        fill_between_crossings(c);
      if (c.speed && c.speed->contains("searched_mm"))
        box("outside", place(c.from_rpm, deepest_),
            place(c.to_rpm, c.speed->at("searched_mm").get<double>()));
    }
  }

  void crossings() {
    for (const Column& c : columns_) {
      if (!c.speed) continue;
      for (const auto& at : c.speed->at("crossings")) {
        const double depth = at.at("ap_mm");
        folds_ = folds_ || at.at("kind") == "fold";
        svg_.line(at.at("kind").get<std::string>(), place(c.from_rpm, depth),
                  place(c.to_rpm, depth));
      }
    }
  }

  /// The line of a depth of every speed, broken where one is undecided or an island ends;
  /// null is the deepest.
  template <class F>
  void limit_line(const std::string& css_class, F depth_of) {
    std::vector<Point> line;
    const auto draw = [&] {
      if (line.size() > 1) svg_.polyline(css_class, line);
      line.clear();
    };
    const Column* before = nullptr;
    for (const Column& c : columns_) {
      if (!c.speed || (before && island_ends(*before, c))) draw();
      before = c.speed ? &c : nullptr;
      if (!before) continue;
      const ordered_json depth = depth_of(*c.speed);
      line.push_back(place(c.n_rpm, depth.is_null() ? deepest_ : depth.get<double>()));
    }
    draw();
  }

  void points() {
    if (!result_.contains("points")) return;
    for (const auto& p : result_.at("points")) {
      const double n = p.at("n_rpm"), depth = p.at("ap_mm");
      if (!(n >= speed_.low && n <= speed_.high && depth <= deepest_)) continue;
      const Point at = place(n, depth);
      if (p.at("stable").get<bool>()) {
        diamond("stable", at);
      } else {
        svg_.line("", {at.x - kMark, at.y - kMark}, {at.x + kMark, at.y + kMark});
        svg_.line("", {at.x - kMark, at.y + kMark}, {at.x + kMark, at.y - kMark});
      }
    }
  }

  void best() {
    if (result_.at("best").is_null()) return;
    const double n = result_.at("best").at("n_rpm"),
                 depth = result_.at("best").at("ap_mm");
    const Point at = place(n, depth);
    diamond("best", at);
    diamond("best", {kLeft + kMark, kTop - 4});
    svg_.text({kLeft + 3, kTop - 3}, Anchor::start,
              say("best with margins: {}/min, {} mm", plain(n, 0), plain(depth, 2)),
              "path");
    for (const auto& magic : result_.at("magic_speeds")) {
      const double x = place(magic.at("n_rpm"), 0).x;
      svg_.line("", {x, kTop - 2}, {x, kTop});
    }
  }

  /// Shades what lies outside the machine's speeds.
  void machine(double from_rpm, double to_rpm) {
    const auto shade = [&](double from, double to) {
      if (to > from) box("outside", place(from, deepest_), place(to, 0));
    };
    shade(speed_.low, std::min(from_rpm, speed_.high));
    shade(std::max(to_rpm, speed_.low), speed_.high);
  }

  void axes() {
    frame(svg_, speed_, depth_, tr("spindle speed, 1/min"), tr("axial depth, mm"), 8, 6);
  }

  void key(bool robust) {
    double x = kLeft;
    const double y = kBottom + 17;
    const auto stroke = [&](const std::string& css_class, const std::string& text) {
      svg_.line(css_class, {x, y}, {x + 6, y});
      svg_.text({x + 7.5, y + 1}, Anchor::start, text);
      x += 24;
    };
    stroke("flip", tr("flip"));
    stroke("hopf", "Hopf");
    if (folds_) stroke("fold", tr("fold"));
    stroke("", tr("first limit"));
    if (robust) stroke(tr("robust"), tr("robust"));
    box("count1", {x, y - 1.5}, {x + 4, y + 1.5});
    box("count" + std::to_string(kShades), {x + 4, y - 1.5}, {x + 8, y + 1.5});
    svg_.text({x + 9.5, y + 1}, Anchor::start, tr("unstable; more multipliers"));
    svg_.text({kLeft, 9}, Anchor::start, tr("Stability of the cut"), "title");
    const bool undecided = std::ranges::any_of(columns_, [](const Column& c) {
      return !c.speed || c.speed->contains("searched_mm");
    });
    svg_.text({kRight, kTop - 3}, Anchor::end,
              undecided ? tr("ticks: magic speeds; shaded: undecided")
                        : tr("ticks: magic speeds"));
  }

  std::string page() const {
    return svg_.page(kPage, kHeight,
                     tr("Stability chart: axial depth over spindle speed"));
  }

 private:
  Point place(double n_rpm, double depth_mm) const {
    return {speed_.place(n_rpm), depth_.place(depth_mm)};
  }

  void box(const std::string& css_class, Point a, Point b) {
    svg_.polygon(css_class, {a, {b.x, a.y}, b, {a.x, b.y}});
  }

  void diamond(const std::string& css_class, Point at) {
    svg_.polygon(css_class, {{at.x - kMark, at.y},
                             {at.x, at.y - kMark},
                             {at.x + kMark, at.y},
                             {at.x, at.y + kMark}});
  }

  double first_limit(const Column& c) const {
    const auto& depth = c.speed->at("limit_mm");
    return depth.is_null() ? deepest_ : depth.get<double>();
  }

  /// Whether the first limit jumps between neighbours, because the lower one belongs to an
  /// island that the other has no more: it is stable again below the other's first limit.
  bool island_ends(const Column& a, const Column& b) const {
    const Column& lower = first_limit(a) < first_limit(b) ? a : b;
    const double other = std::max(first_limit(a), first_limit(b));
    const auto& crossings = lower.speed->at("crossings");
    return crossings.size() > 1 && crossings[1].at("ap_mm").get<double>() < other;
  }

  void fill(const Column& c, double from_mm, double to_mm, int unstable) {
    if (unstable > 0)
      box("count" + std::to_string(std::min(unstable, kShades)), place(c.from_rpm, to_mm),
          place(c.to_rpm, from_mm));
  }

  void fill_between_crossings(const Column& c) {
    double from = 0;
    bool unstable = false;
    for (const auto& at : c.speed->at("crossings")) {
      const double depth = at.at("ap_mm");
      fill(c, from, depth, unstable ? 2 : 0);
      unstable = at.at("sense") == "loss";
      from = depth;
    }
    fill(c, from, deepest_, unstable ? 2 : 0);
  }

  /// Runs of one count; a run changes half way between two depths counted, but where
  /// stability is lost or regained at the crossing between them.
  void fill_counts(const Column& c) {
    const auto& counts = c.speed->at("unstable_multipliers");
    const auto& depths = result_.at("depths_mm");
    double from = 0, before = 0;
    int count = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const int next = counts[i];
      const double depth = depths[i];
      if (next != count) {
        const double at = border(c, before, depth, (count == 0) != (next == 0));
        fill(c, from, at, count);
        from = at;
        count = next;
      }
      before = depth;
    }
    fill(c, from, deepest_, count);
  }

  static double border(const Column& c, double above, double below, bool crossed) {
    if (crossed)
      for (const auto& at : c.speed->at("crossings"))
        if (const double depth = at.at("ap_mm"); depth > above && depth <= below)
          return depth;
    return (above + below) / 2;
  }

  const ordered_json& result_;
  std::vector<Column> columns_;
  double deepest_ = 0;
  bool folds_ = false;  // among the crossings drawn
  Scale speed_, depth_;
  Svg svg_;
};

}  // namespace

std::string stability_chart(const json& request, const ordered_json& result) {
  if (!result.contains("speeds")) return {};
  Chart chart(result, request.at("ap_max_mm"));
  chart.fill();
  chart.crossings();
  chart.limit_line("", [](const ordered_json& s) { return s.at("limit_mm"); });
  const bool robust = result.at("speeds").front().contains("uncertain");
  if (robust)
    chart.limit_line(tr("robust"), [](const ordered_json& s) {
      return s.at("uncertain").at("robust_mm");
    });
  chart.points();
  if (request.contains("machine_rpm"))
    chart.machine(request.at("machine_rpm").at("from"),
                  request.at("machine_rpm").at("to"));
  chart.best();
  chart.axes();
  chart.key(robust);
  return chart.page();
}

}  // namespace turnwright::report
