#include "drawing.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "base/say.hpp"
#include "chart.hpp"
#include "clamping_drawing.hpp"
#include "contour.hpp"
#include "report/text/layout.hpp"
#include "report/text/result_words.hpp"
#include "setup_view.hpp"
#include "spread.hpp"
#include "svg.hpp"
#include "thread_label.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::report {
namespace {

using part::End;
using planning::Clamping;
using planning::Deviation;
using planning::PreparedPart;
using planning::ProcessPlan;

// Millimetres of paper.
constexpr double kWidth = SetupView::kWidth, kBeside = 16, kHighest = 40, kError = 6;
constexpr double kTop = 17, kAround = SetupView::kJaw + 2.5, kLabelGap = 3.6,
                 kNumberGap = 3.2;
constexpr double kCharacter = 1.7;  // of 2.8 mm type, on average of a wide face
constexpr double kWords = 70;       // of the legend
constexpr double kLeft = 4, kRight = kWidth - 2;              // of what is spread
constexpr double kArrow = 12, kArrowHead = 2.2, kZero = 1.5;  // of the program's zero
constexpr std::size_t kNameLength = 60, kIdLength = 24;

/// What a deviation is of: its surface as drawn; none for a face.
std::optional<Run> surface_of(const part::Drawing& d, const std::string& id) {
  const auto at = part::extent(d, id);
  if (!at) return std::nullopt;
  return Run{at->z0_mm, at->z1_mm, at->left_mm / 2, at->right_mm / 2};
}

Scales scales(const PreparedPart& p, const ProcessPlan& plan) {
  const auto& stock = p.drawing.stock;
  Scales s;
  s.length =
      std::min((kWidth - 2 * kBeside) / stock.length_mm, kHighest / stock.outer_mm);
  if (!(s.length > 0) || !std::isfinite(s.length))
    throw std::domain_error("setup_drawings: the stock must have a length and diameter");
  double largest = 0;
  const auto show = [&](const auto& table) {
    if (!surface_of(p.drawing, table.on)) return;
    for (const auto& [z, e] : table.table_mm) {
      if (!std::isfinite(e))
        throw std::domain_error("setup_drawings: deviations must be finite");
      largest = std::max(largest, std::abs(e));
    }
  };
  std::ranges::for_each(plan.deviations, show);
  std::ranges::for_each(plan.compensation, show);
  if (largest > 0) s.factor = round_below(kError / (s.length * largest));
  return s;
}

struct Label {
  double x = 0, y = 0;  ///< where its leader ends
  std::string text, css_class;
};

template <class Element>
std::string id_and_size(const part::Drawing& d, const Element& e) {
  const auto id = clipped(e.id, kIdLength);
  if (part::stays(e) && part::flats(d.stock.kind) > 0)
    return id + (d.stock.kind == part::StockKind::hexagon ? tr("  hex ") : tr("  sq ")) +
           plain(part::across_mm(d.stock));
  const auto size = e.cut ? e.cut->drawn : part::Ends{e.left_mm, e.right_mm};
  if (e.cut && e.cut->kind == part::CutKind::thread)
    return id + "  " + thread_label(*e.cut);
  std::string text = id + "  \u00d8" + plain(size.left_mm);
  if (e.cut && e.cut->kind == part::CutKind::knurl)
    text += ' ' + part::designation(part::Knurl{e.cut->knurl, e.cut->pitch_mm});
  if (size.left_mm != size.right_mm) text += "\u2013" + plain(size.right_mm);
  if (e.cut && e.cut->kind == part::CutKind::arc) text += " R" + plain(e.cut->radius_mm);
  return e.fit ? text + ' ' + clipped(*e.fit, kIdLength) : text;
}

bool corrected(const SetupView& s, const std::string& id) {
  return std::any_of(s.plan.compensation.begin(), s.plan.compensation.end(),
                     [&](const auto& c) { return c.setup == s.setup && c.on == id; });
}

/// All, or of more than have room on the page `gap` apart evenly chosen ones.
template <class T>
std::vector<T> thinned(const std::vector<T>& all, double gap) {
  const auto most = static_cast<std::size_t>((kRight - kLeft) / gap);
  if (all.size() <= most) return all;
  std::vector<T> some;
  for (std::size_t i = 0; i < most; ++i)
    some.push_back(all[i * (all.size() - 1) / (most - 1)]);
  return some;
}

/// The run of an element over its middle.
Run middle(const Runs& runs) {
  const double z = (runs.front().z0 + runs.back().z1) / 2;
  return *std::ranges::find_if(runs, [&](const Run& run) { return run.z1 >= z; });
}

/// Ids and sizes of what is cut so far, of the other outer elements the id alone; left to
/// right.
std::vector<Label> labels(const SetupView& s, const planning::Finished& finished) {
  std::vector<Label> all;
  const auto add = [&](const auto& e, const Run& run) {
    const Point end = s.at((run.z0 + run.z1) / 2, (run.r0 + run.r1) / 2);
    const auto text = id_and_size(s.part.drawing, e);
    if (corrected(s, e.id))
      all.push_back({end.x, end.y, say("{}, path corrected", text), "path"});
    else
      all.push_back({end.x, end.y, text, ""});
  };
  const auto& d = s.part.drawing;
  for (std::size_t i = 0; i < d.outer.size(); ++i) {
    const Run run = middle(outer_runs(d, i));
    if (finished.outer[i]) {
      add(d.outer[i], run);
    } else {
      const Point end = s.at((run.z0 + run.z1) / 2, part::stock_of(d, i).most_mm / 2);
      all.push_back(
          {end.x, end.y, say("{} uncut", clipped(d.outer[i].id, kIdLength)), "later"});
    }
  }
  for (std::size_t i = 0; i < d.inner.size(); ++i)
    if (finished.inner[i]) add(d.inner[i], middle(inner_runs(d, i)));
  std::stable_sort(all.begin(), all.end(),
                   [](const Label& a, const Label& b) { return a.x < b.x; });
  return thinned(all, kLabelGap);
}

double text_width(const std::string& text) {
  return kCharacter * static_cast<double>(characters(text));
}

/// Whether the labels have room side by side, each over its element.
bool fit_side_by_side(const std::vector<Label>& all) {
  double end = 0;
  for (const auto& label : all) {
    const double half = text_width(label.text) / 2;
    if (label.x - half < end + 1.5 || label.x + half > kWidth) return false;
    end = label.x + half;
  }
  return true;
}

double label_height(const std::vector<Label>& all) {
  if (fit_side_by_side(all)) return 3;
  double longest = 0;
  for (const auto& label : all) longest = std::max(longest, text_width(label.text));
  return longest;
}

void draw_labels(SetupView& s, const std::vector<Label>& all) {
  const double foot = s.axis - s.stock_height() - kAround - 3;
  std::vector<double> x;
  for (const auto& label : all) x.push_back(label.x);
  const bool flat = fit_side_by_side(all);
  if (!flat) x = spread(std::move(x), kLabelGap, kLeft, kRight);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string& css_class = all[i].css_class;
    if (flat)
      s.svg.text({x[i], foot}, Anchor::middle, all[i].text, css_class);
    else
      s.svg.text_upwards({x[i] + 1, foot}, Anchor::start, all[i].text, css_class);
    s.svg.polyline("leader", {{x[i], foot + 0.8},
                              {x[i], foot + 2},
                              {all[i].x, foot + 4},
                              {all[i].x, all[i].y}});
  }
}

void draw_body(SetupView& s) {
  std::vector<Point> section;
  for (const auto& run : s.contour.outer) {
    section.push_back(s.at(run.z0, run.r0));
    section.push_back(s.at(run.z1, run.r1));
  }
  for (auto run = s.contour.inner.rbegin(); run != s.contour.inner.rend(); ++run) {
    section.push_back(s.at(run->z1, run->r1));
    section.push_back(s.at(run->z0, run->r0));
  }
  s.svg.polygon("body", section);
}

void draw_stock(SetupView& s) {
  const auto& stock = s.part.drawing.stock;
  const double z0 = -stock.left_allowance_mm, z1 = z0 + stock.length_mm;
  const double hole = stock.inner_mm / 2;
  const auto corners = part::half_section(stock);
  const auto outside = corners.size() - 2;  // the others are the hole's
  std::vector<Point> outline{s.at(corners[0][1], -corners[0][0])};
  for (std::size_t k = 0; k < outside; ++k)
    outline.push_back(s.at(corners[k][1], corners[k][0]));
  for (std::size_t k = outside; k-- > 0;)
    outline.push_back(s.at(corners[k][1], -corners[k][0]));
  s.svg.polyline("stock", outline);
  if (hole > 0)
    for (const double side : {hole, -hole})
      s.svg.line("stock", s.at(z0, side), s.at(z1, side));
}

/// The outline above (section) and below (view) the centre line, with the edges that are
/// seen; of bores below what is hidden.
void draw_contour(SetupView& s) {
  std::vector<Point> above, below;
  const auto& outer = s.contour.outer;
  above.push_back(s.at(s.left_z(), s.contour.inner.front().r0));
  below.push_back(s.at(s.left_z(), 0));
  for (std::size_t i = 0; i < outer.size(); ++i) {
    for (const auto& [z, r] :
         {std::pair{outer[i].z0, outer[i].r0}, {outer[i].z1, outer[i].r1}}) {
      above.push_back(s.at(z, r));
      below.push_back(s.at(z, -r));
    }
    if (i > 0 && outer[i - 1].r1 != outer[i].r0)
      s.svg.line("thin", s.at(outer[i].z0, 0), s.at(outer[i].z0, -outer[i].r0));
  }
  above.push_back(s.at(s.right_z(), s.contour.inner.back().r1));
  below.push_back(s.at(s.right_z(), 0));
  s.svg.polyline("contour", above);
  s.svg.polyline("contour", below);
  const auto& inner = s.contour.inner;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    const auto& run = inner[i];
    if (run.r0 > 0 || run.r1 > 0) {
      s.svg.line("contour", s.at(run.z0, run.r0), s.at(run.z1, run.r1));
      s.svg.line("hidden", s.at(run.z0, -run.r0), s.at(run.z1, -run.r1));
    }
    if (i > 0 && inner[i - 1].r1 != run.r0) {
      s.svg.line("contour", s.at(run.z0, 0),
                 s.at(run.z0, std::max(inner[i - 1].r1, run.r0)));
      s.svg.line("hidden", s.at(run.z0, -inner[i - 1].r1), s.at(run.z0, -run.r0));
    }
  }
}

/// What this setup cuts, in thick lines.
void draw_cut(SetupView& s) {
  const auto& d = s.part.drawing;
  const auto both = [&](double z0, double r0, double z1, double r1) {
    s.svg.line("cut", s.at(z0, r0), s.at(z1, r1));
    s.svg.line("cut", s.at(z0, -r0), s.at(z1, -r1));
  };
  for (const std::size_t i : s.work.elements)
    for (const Run& run : outer_runs(d, i)) both(run.z0, run.r0, run.z1, run.r1);
  for (const std::size_t i : s.work.bores)
    for (const Run& run : inner_runs(d, i))
      s.svg.line("cut", s.at(run.z0, run.r0), s.at(run.z1, run.r1));
  for (const std::size_t k : s.work.shoulders) {
    const double z = part::left_z_mm(d, k);
    both(z, d.outer[k - 1].right_mm / 2, z, d.outer[k].left_mm / 2);
  }
  for (const std::size_t i : s.work.inner_shoulders) {
    const auto shoulder = *part::shoulder_behind(d, i);
    const auto ring = *planning::shoulder_ring(d, shoulder.id);
    const double z = shoulder.z_mm;
    s.svg.line("cut", s.at(z, ring.small_mm / 2), s.at(z, ring.large_mm / 2));
  }
  if (!s.work.end_face) return;
  const bool right = s.holds_left();
  const double bore = right ? s.contour.inner.back().r1 : s.contour.inner.front().r0;
  const double z = right ? s.right_z() : s.left_z();
  both(z, bore, z, right ? s.contour.outer.back().r1 : s.contour.outer.front().r0);
}

/// The roots of threads that are cut so far, thin as on a drawing.
void draw_threads(SetupView& s, const planning::Finished& finished) {
  const auto root = [&](const auto& e, double z, bool inner) {
    if (!e.cut || e.cut->kind != part::CutKind::thread) return;
    const double r = e.cut->core.left_mm / 2;
    s.svg.line("thin", s.at(z, r), s.at(z + e.length_mm, r));
    if (!inner) s.svg.line("thin", s.at(z, -r), s.at(z + e.length_mm, -r));
  };
  const auto& d = s.part.drawing;
  for (std::size_t i = 0; i < d.outer.size(); ++i)
    if (finished.outer[i]) root(d.outer[i], part::left_z_mm(d, i), false);
  for (std::size_t i = 0; i < d.inner.size(); ++i)
    if (finished.inner[i]) root(d.inner[i], part::inner_left_z_mm(d, i), true);
}

/// Knurls that are pressed so far, thin lines on a part of the side that is seen: along the
/// axis, leaning as their hand does, or crossed.
void draw_knurls(SetupView& s, const planning::Finished& finished) {
  constexpr int kLines = 4;
  const double leans = std::tan(std::numbers::pi / 6);
  const auto& d = s.part.drawing;
  for (std::size_t i = 0; i < d.outer.size(); ++i) {
    const auto& e = d.outer[i];
    if (!finished.outer[i] || !part::is_knurled(e)) continue;
    const double r = e.left_mm / 2, z0 = part::left_z_mm(d, i), z1 = z0 + e.length_mm;
    const double seen = std::min(r / 2, e.length_mm / 2), step = seen / kLines;
    const auto across = [&](double lean) {
      for (double z = z0 + seen; z <= z1 - seen; z += step)
        s.svg.line("thin", s.at(z, -r), s.at(z + lean * seen, -r + seen));
    };
    const auto along = [&] {
      for (int k = 1; k <= kLines; ++k)
        s.svg.line("thin", s.at(z0, -r + k * step), s.at(z1, -r + k * step));
    };
    using enum part::KnurlType;
    const auto type = e.cut->knurl;
    if (type == RAA || type == RKE || type == RKV) along();
    if (type == RKE || type == RKV) across(0);
    if (type == RBL || type == RGE || type == RGV) across(-leans);
    if (type == RBR || type == RGE || type == RGV) across(leans);
  }
}

/// Places of a table on its surface, its values enlarged outwards by `factor`; none
/// unless this setup cuts the surface.
template <class Table>
std::vector<Point> stand_off(const SetupView& s, const Table& table, double factor) {
  const auto surface = surface_of(s.part.drawing, table.on);
  std::vector<Point> points;
  if (table.setup != s.setup || !surface) return points;
  for (const auto& [z, e] : table.table_mm)
    points.push_back(s.at(z, radius_mm(*surface, z) + factor * e));  // Eq. (1)
  return points;
}

void draw_errors(SetupView& s) {
  if (!(s.scale.factor > 0)) return;
  for (const auto& d : s.plan.deviations) {
    const auto made = stand_off(s, d, s.scale.factor);
    if (made.empty()) continue;
    auto outline = stand_off(s, d, 0);
    outline.insert(outline.end(), made.rbegin(), made.rend());
    s.svg.polygon("error", outline);
    s.svg.polyline("made", made);
  }
  for (const auto& c : s.plan.compensation)
    if (const auto path = stand_off(s, c, s.scale.factor); !path.empty())
      s.svg.polyline("path", path);
}

bool corrects(const SetupView& s) {
  return std::ranges::any_of(s.plan.compensation,
                             [&](const auto& c) { return !stand_off(s, c, 0).empty(); });
}

/// Within an arc or a rounded edge of an element that begins at z0, where its chords meet.
template <class Element>
bool within_a_curve(const Element& e, double z0, double z) {
  constexpr double kRounding_mm = 1e-6;
  const auto within = [&](double from, double to) {
    return z > from + kRounding_mm && z < to - kRounding_mm;
  };
  const auto radius = [](const std::optional<part::Chamfer>& c) {
    return c && c->round ? c->axial_mm : 0.0;
  };
  const double z1 = z0 + e.length_mm;
  return (e.cut && e.cut->kind == part::CutKind::arc && within(z0, z1)) ||
         within(z0, z0 + radius(e.left_chamfer)) ||
         within(z1 - radius(e.right_chamfer), z1);
}

bool within_a_curve(const part::Drawing& d, bool inner, double z) {
  for (std::size_t i = 0; i < (inner ? d.inner.size() : d.outer.size()); ++i)
    if (inner ? within_a_curve(d.inner[i], part::inner_left_z_mm(d, i), z)
              : within_a_curve(d.outer[i], part::left_z_mm(d, i), z))
      return true;
  return false;
}

/// A place along the axis: where it is drawn, and the program's Z.
struct Place {
  double x = 0, Z = 0;
};

/// Every end of an element, from the chuck outwards.
std::vector<Place> ends_of_elements(const SetupView& s) {
  std::vector<double> z;
  for (const bool inner : {false, true})
    for (const auto& run : inner ? s.contour.inner : s.contour.outer)
      for (const double end : {run.z0, run.z1})
        if (!within_a_curve(s.part.drawing, inner, end)) z.push_back(end);
  std::sort(z.begin(), z.end());
  z.erase(std::unique(z.begin(), z.end(),
                      [](double a, double b) { return std::abs(a - b) < 1e-6; }),
          z.end());
  if (!s.holds_left()) std::reverse(z.begin(), z.end());
  std::vector<Place> all;
  for (const double end : z) all.push_back({s.x(end), s.program_z(end)});
  return all;
}

/// The program's Z of every end of an element, with lines down from the part; y of the
/// foot.
double draw_ruler(SetupView& s) {
  const auto ends = thinned(ends_of_elements(s), kNumberGap);
  std::vector<double> x;
  for (const auto& end : ends) x.push_back(end.x);
  const auto labels_x = spread(x, kNumberGap, kLeft, kRight);
  const double ruler = s.axis + s.stock_height() + kAround + 1, foot = ruler + 4.5;
  double longest = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const auto text = plain(ends[i].Z);
    longest = std::max(longest, text_width(text));
    s.svg.polyline("leader", {{x[i], s.axis + s.stock_height() + 1},
                              {x[i], ruler + 1.2},
                              {labels_x[i], foot - 0.8}});
    s.svg.text_upwards({labels_x[i] + 1, foot}, Anchor::end, text);
  }
  s.svg.line("thin", {x.front(), ruler}, {x.back(), ruler});
  s.svg.text({x.front() - 3, ruler + 1}, Anchor::end, "Z [mm]");
  return foot + longest;
}

void draw_bar(SetupView& s, Point from, Point to) {
  s.svg.line("bar", from, to);
  const Point tick = from.x == to.x ? Point{1, 0} : Point{0, 1};
  for (const auto& end : {from, to})
    s.svg.line("thin", {end.x - tick.x, end.y - tick.y},
               {end.x + tick.x, end.y + tick.y});
}

/// The bars of both scales and what the lines mean; y of the foot.
double draw_legend(SetupView& s, double top) {
  const double foot = top + kError + 2, mm = round_below(30 / s.scale.length);
  draw_bar(s, {10, foot}, {10 + s.scale.length * mm, foot});
  s.svg.text({10, foot - 2}, Anchor::start, plain(mm) + " mm");
  s.svg.text({kWords, foot - 3.6}, Anchor::start,
             tr("thick: cut in this setup; dashed: stock; above the axis in section"));
  if (!(s.scale.factor > 0)) {
    s.svg.text({kWords, foot}, Anchor::start,
               tr("no deviation of a radius is predicted"));
    return foot;
  }
  const double drawn = s.scale.length * s.scale.factor;  // paper mm of a mm of error
  const double bar_mm = round_below(kError / drawn);
  draw_bar(s, {54, foot}, {54, foot - drawn * bar_mm});
  s.svg.text({56.5, foot - drawn * bar_mm / 2 + 1}, Anchor::start,
             plain(units::um_from_mm(bar_mm)) + " \u00b5m", "accent");
  s.svg.text({kWords, foot}, Anchor::start,
             say("red: the surface as made, its error {}:1 to the lengths",
                 plain(s.scale.factor)),
             "accent");
  if (!corrects(s)) return foot;
  s.svg.text({kWords, foot + 3.6}, Anchor::start,
             tr("blue: the tool path as corrected, likewise"), "path");
  return foot + 3.6;
}

/// An arrow along the paper's axes.
void draw_arrow(SetupView& s, Point from, Point to) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const Point along{(to.x - from.x) / length, (to.y - from.y) / length};
  const Point neck{to.x - kArrowHead * along.x, to.y - kArrowHead * along.y};
  const double half = kArrowHead / 3;
  s.svg.line("zero", from, neck);
  s.svg.polygon("zero", {to,
                         {neck.x + half * along.y, neck.y + half * along.x},
                         {neck.x - half * along.y, neck.y - half * along.x}});
}

/// Program zero, a disk with two quarters filled, and the axes of the program.
void draw_zero(SetupView& s) {
  constexpr int kQuarter = 8;  // chords of a quarter of the disk
  const Point zero = s.at(planning::free_z_mm(s.part, s.setup), 0);
  draw_arrow(s, zero, {zero.x + kArrow, zero.y});
  draw_arrow(s, zero, {zero.x, zero.y - kArrow});
  for (int quarter = 0; quarter < 4; ++quarter) {
    std::vector<Point> points{zero};
    for (int k = 0; k <= kQuarter; ++k) {
      const double turned =
          units::kPi / 2 * (quarter + static_cast<double>(k) / kQuarter);
      points.push_back(
          {zero.x + kZero * std::cos(turned), zero.y + kZero * std::sin(turned)});
    }
    s.svg.polygon(quarter % 2 == 0 ? "zero" : "zero open", points);
  }
  s.svg.text({zero.x + kArrow + 1, zero.y + 1}, Anchor::start, "Z", "zero");
  s.svg.text({zero.x + 1.4, zero.y - kArrow + 1.5}, Anchor::start, "X", "zero");
}

std::string heading(const SetupView& s) {
  const auto setup = s.setup + 1;
  const auto clamping = spoken(name(s.clamping()));
  auto text = s.holds_left() ? say("Setup {}: {}, left end held", setup, clamping)
                             : say("Setup {}: {}, right end held", setup, clamping);
  if (s.clamping() != Clamping::between_centres)
    text += say(", grip {} mm", plain(s.part.grips_mm[s.setup]));
  return text;
}

std::string drawn(SetupView s, const planning::Finished& finished) {
  s.axis = kTop + label_height(labels(s, finished)) + 3 + kAround + s.stock_height();
  const auto title = clipped(s.part.drawing.name, kNameLength);
  s.svg.text({10, 9}, Anchor::start, title, "title");
  s.svg.text({10, 14}, Anchor::start, heading(s));
  if (s.plan.status == planning::PlanStatus::infeasible)
    s.svg.text({kWidth - 10, 14}, Anchor::end, tr("no plan keeps every limit"), "accent");
  draw_body(s);
  draw_stock(s);
  draw_contour(s);
  draw_labels(s, labels(s, finished));
  draw_clamping(s);  // over the leaders of what it holds
  draw_cut(s);
  draw_threads(s, finished);
  draw_knurls(s, finished);
  draw_errors(s);
  const auto [from, to] = std::minmax({s.x(s.left_z()), s.x(s.right_z())});
  s.svg.line("axis", {from - 10, s.axis}, {to + 10, s.axis});
  draw_zero(s);
  const double foot = draw_legend(s, draw_ruler(s) + 2);
  return s.svg.page(kWidth, foot + 6, title + " - " + heading(s));
}

}  // namespace

std::vector<std::string> setup_drawings(const PreparedPart& part,
                                        const ProcessPlan& plan) {
  if (plan.setups.size() > part.setups.size())
    throw std::domain_error("setup_drawings: the plan has more setups than the part");
  const auto& work = part.work;
  const auto scale = scales(part, plan);
  auto finished = planning::nothing_finished(part.drawing);
  std::vector<std::string> all;
  for (std::size_t i = 0; i < plan.setups.size(); ++i) {
    planning::finish(finished, work.setups[i]);
    all.push_back(
        drawn({part, plan, work.setups[i], i, scale, contour_after(part, i)}, finished));
  }
  return all;
}

}  // namespace turnwright::report
