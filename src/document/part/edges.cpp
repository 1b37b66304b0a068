#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "document/json/fields.hpp"
#include "document/json/reference.hpp"
#include "part_sections.hpp"
#include "turnwright/base/pattern.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::document {
namespace {

using part::End;

constexpr double kDiffers_mm = 1e-6;    // of diameters
constexpr double kLeastWall_mm = 0.05;  // that a chamfer leaves of a step
constexpr double kShareOfWall = 0.45;   // that a chamfer may take of a face

// The end of an element that stands beyond its neighbour or meets a face of the part:
// its edge, and the inner corner at the neighbour's foot.
struct Step {
  std::vector<std::string> names;  // in a document; the first one is told
  bool inner = false;
  std::size_t standing = 0;
  End end = End::left;               // of the standing element
  std::optional<std::size_t> lower;  // the neighbour; none at a face of the part
  double most_mm = 0;                // that a chamfer may take of the radius
  // A cylinder or a thread stands there, and no arc is beside it.
  bool plain = true;
  bool by_blade = false;  // the rim of a groove in a blank as high
};

std::vector<std::string> both_ways(const std::string& a, const std::string& b) {
  return {a + '|' + b, b + '|' + a};
}

template <class Element>
bool can_have_edge(const Element& e) {
  return e.kind == part::ElementKind::cylinder &&
         (!e.cut || e.cut->kind == part::CutKind::thread ||
          e.cut->kind == part::CutKind::hole || e.cut->kind == part::CutKind::knurl);
}

template <class Element>
bool can_be_beside(const Element& e) {
  return !e.cut || !part::replaces_blank(e.cut->kind) || part::is_groove(e);
}

// From the drawn radius to the middle of its limits, where it is cut.
template <class Element>
double to_middle_mm(const Element& e) {
  return e.limits ? (e.limits->lower_mm + e.limits->upper_mm) / 4 : 0;
}

// Between neighbours of which `left` ends where `right` begins.
template <class Element>
void add_between(const std::vector<Element>& all, std::size_t left, std::size_t right,
                 bool inner, std::vector<Step>& steps) {
  const double rises_mm = (all[right].left_mm - all[left].right_mm) / 2;
  const bool rim = part::is_groove(all[left]) != part::is_groove(all[right]);
  if (!(std::abs(rises_mm) > kDiffers_mm)) {
    // Between two floors of a neck no edge is cut.
    if (!rim && (!part::is_groove(all[left]) ||
                 all[left].cut->core.right_mm == all[right].cut->core.left_mm))
      return;
    const bool on_left = part::is_groove(all[right]);
    const std::size_t standing = on_left ? left : right, groove = on_left ? right : left;
    steps.push_back({both_ways(all[left].id, all[right].id), inner, standing,
                     on_left ? End::right : End::left, groove,
                     all[groove].cut->depth_mm - kLeastWall_mm,
                     rim && can_have_edge(all[standing]), true});
    return;
  }
  const bool right_stands = (rises_mm > 0) != inner;
  const double cut_mm = rises_mm + to_middle_mm(all[right]) - to_middle_mm(all[left]);
  const double least_mm =
      rises_mm > 0 ? std::min(rises_mm, cut_mm) : std::min(-rises_mm, -cut_mm);
  const std::size_t standing = right_stands ? right : left;
  const std::size_t lower = right_stands ? left : right;
  steps.push_back({both_ways(all[left].id, all[right].id), inner, standing,
                   right_stands ? End::left : End::right, lower, least_mm - kLeastWall_mm,
                   can_have_edge(all[standing]) && can_be_beside(all[lower])});
}

template <class Element>
void add_at_face(const std::vector<Element>& all, std::size_t i, End end, bool inner,
                 double wall_mm, std::vector<Step>& steps) {
  const std::string face = end == End::left ? "left" : "right";
  auto names = both_ways(face, all[i].id);
  if (!inner) names.insert(names.begin(), face);
  steps.push_back({names, inner, i, end, std::nullopt, kShareOfWall * wall_mm,
                   can_have_edge(all[i])});
}

// Indices of the bores along the axis.
std::vector<std::size_t> along_the_axis(const part::Drawing& d) {
  std::vector<std::size_t> order(d.inner.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return part::inner_left_z_mm(d, a) < part::inner_left_z_mm(d, b);
  });
  return order;
}

std::vector<Step> steps(const part::Drawing& d) {
  std::vector<Step> all;
  const auto bores = along_the_axis(d);
  const double length = part::length_mm(d);
  const auto ends_at = [&](std::size_t i, double z) {
    return std::abs(part::inner_left_z_mm(d, i) + d.inner[i].length_mm - z) < kDiffers_mm;
  };
  const auto begins_at = [&](std::size_t i, double z) {
    return std::abs(part::inner_left_z_mm(d, i) - z) < kDiffers_mm;
  };
  const double hole = d.stock.inner_mm;
  const bool left_bore = !bores.empty() && begins_at(bores.front(), 0);
  const bool right_bore = !bores.empty() && ends_at(bores.back(), length);
  const double left_wall =
      (d.outer.front().left_mm - (left_bore ? d.inner[bores.front()].left_mm : hole)) / 2;
  const double right_wall =
      (d.outer.back().right_mm - (right_bore ? d.inner[bores.back()].right_mm : hole)) /
      2;
  add_at_face(d.outer, 0, End::left, false, left_wall, all);
  add_at_face(d.outer, d.outer.size() - 1, End::right, false, right_wall, all);
  for (std::size_t k = 1; k < d.outer.size(); ++k)
    add_between(d.outer, k - 1, k, false, all);
  if (left_bore) add_at_face(d.inner, bores.front(), End::left, true, left_wall, all);
  if (right_bore) add_at_face(d.inner, bores.back(), End::right, true, right_wall, all);
  for (std::size_t k = 1; k < bores.size(); ++k)
    if (ends_at(bores[k - 1], part::inner_left_z_mm(d, bores[k])))
      add_between(d.inner, bores[k - 1], bores[k], true, all);
  return all;
}

template <class Element>
auto& chamfer_at(Element& e, End end) {
  return end == End::left ? e.left_chamfer : e.right_chamfer;
}
template <class Element>
auto& undercut_at(Element& e, End end) {
  return end == End::left ? e.left_undercut : e.right_undercut;
}

// Length that the edge at an end takes of an element.
template <class Element>
double edge_length_mm(const Element& e, End end) {
  const auto& chamfer = chamfer_at(e, end);
  if constexpr (requires { e.left_undercut; })
    if (const auto& undercut = undercut_at(e, end)) return undercut->width_mm;
  return chamfer ? chamfer->axial_mm : 0;
}

// Height that the other edge of a step takes of it: an undercut at its foot.
double foot_mm(const part::Drawing& d, const Step& step) {
  if (step.inner || !step.lower) return 0;
  const auto& u = undercut_at(d.outer[*step.lower], opposite(step.end));
  return u ? std::max(0.0, part::height_mm(*u) - u->depth_mm) : 0;
}

constexpr double kDigits = 1e4;  // of millimetres in messages

std::string rounded(double mm) { return number_text(std::round(kDigits * mm) / kDigits); }

// What is free, not more than there is; none is told as 0.
std::string at_most(double mm) {
  return number_text(std::floor(kDigits * std::max(mm, 0.0)) / kDigits);
}

// A chamfer of the given length along the axis, in the standing element; `most_mm` of its
// radius are free for it.
template <class Element>
void read_chamfer(const Draft& draft, Reader& r, const Step& step, double most_mm,
                  Element& e) {
  const double axial = r.number("chamfer_mm", above_up_to(0, 1000, "mm"));
  const double angle = r.number_or("angle_deg", within(1, 89, "deg"), 45);
  auto& mine = chamfer_at(e, step.end);
  if (mine) {
    r.problem_at("at", tr("each edge once"), "duplicate");
    return;
  }
  // As drawn once its element is ground or knurled.
  const double slope = std::tan(units::rad_from_deg(angle)),
               more = draft.ground(e.id) / 2;
  const double radial = axial * slope + more, turned = axial + more / slope;
  const double taken = edge_length_mm(e, opposite(step.end)), free = e.length_mm - taken;
  if (!std::isfinite(axial) || !std::isfinite(angle)) return;  // reported already
  if (!step.plain)
    r.problem_at("at",
                 tr("an edge of a cylinder, a thread or a hole that has no arc beside it "
                    "and is in no neck"),
                 "conflict");
  else if (!(radial > 0))
    r.problem_at("chamfer_mm",
                 say("a chamfer that takes more than {} mm of the radius: so much lower "
                     "{} is turned before it is knurled",
                     rounded(-more), e.id),
                 "conflict");
  else if (!(turned < free))
    r.problem_at("chamfer_mm",
                 taken > 0
                     ? say("less than the {} mm that {} is long beside the edge at its "
                           "other end",
                           rounded(free), e.id)
                     : say("less than the {} mm that {} is long", rounded(free), e.id),
                 "conflict");
  else if (!(radial <= most_mm))
    r.problem_at(
        "chamfer_mm",
        say("a chamfer that takes at most {} mm of the radius there (this one takes {})",
            at_most(most_mm), rounded(radial)),
        "conflict");
  else
    mine = part::Chamfer{turned, radial, step.by_blade};
}

// A rounded edge of the standing element; `most_mm` of its radius are free for it.  It may
// meet the edge at the other end, as both do of a rim that is round all over.
template <class Element>
void read_rounding(const Draft& draft, Reader& r, const Step& step, double most_mm,
                   Element& e) {
  const double radius = r.number("radius_mm", above_up_to(0, 1000, "mm"));
  if (!std::isfinite(radius)) return;  // reported already
  auto& mine = chamfer_at(e, step.end);
  const double free = e.length_mm - edge_length_mm(e, opposite(step.end));
  if (mine)
    r.problem_at("at", tr("each edge once"), "duplicate");
  else if (!step.plain || step.by_blade || e.cut)
    r.problem_at("at",
                 tr("an edge of a cylinder that has no arc or groove beside it: only a "
                    "chamfer_mm is cut there"),
                 "conflict");
  else if (draft.ground(e.id) > 0)
    r.problem_at(
        "radius_mm",
        say("a chamfer_mm: {} is ground, which would leave a part of the radius alone",
            e.id),
        "conflict");
  else if (!(chamfer_at(e, opposite(step.end)) ? radius <= free + kDiffers_mm
                                               : radius < free))
    r.problem_at("radius_mm",
                 say("less than the {} mm that are free of {}", rounded(free), e.id),
                 "conflict");
  else if (!(radius <= most_mm))
    r.problem_at("radius_mm",
                 say("a radius that takes at most {} mm there", at_most(most_mm)),
                 "conflict");
  else
    mine = part::Chamfer{.axial_mm = radius, .radial_mm = radius, .round = true};
}

template <class Element>
void read_fillet(Reader& r, const Step& step, Element& e) {
  auto& mine = opposite(step.end) == End::left ? e.left_fillet_mm : e.right_fillet_mm;
  if (mine) r.problem_at("at", tr("each corner once"), "duplicate");
  mine = r.number("fillet_mm", above_up_to(0, 100, "mm"));
}

// "DIN 76-A" or "DIN 76-B": the undercut of that form behind an outer thread.
std::optional<part::Undercut> read_thread_undercut(const Reader& r, double pitch_mm) {
  const auto text = r.as_text(40);
  static const Pattern kForm(R"(\s*(?:DIN\s*76(?:-1)?)[\s-]*([AB])\s*)");
  std::optional<part::Undercut> found;
  if (const auto m = kForm.match(text)) {
    found = part::thread_undercut((*m)[1][0], pitch_mm);
    if (!found)
      r.problem(say("a thread with a pitch of DIN 76's table, 0.5 to 6 mm, not {} mm",
                    number_text(pitch_mm)),
                "choice");
  } else if (!text.empty()) {
    r.problem(tr("an undercut of DIN 76 behind a thread, \"DIN 76-A\" or \"DIN 76-B\""),
              "choice");
  }
  return found;
}

// "E0.8x0.3", "H0.8x0.3", also "DIN 509-E0,8x0,3": the undercut of that radius and depth.
std::optional<part::Undercut> read_undercut(const Reader& r) {
  const auto text = r.as_text(40);
  static const Pattern kForm(
      R"(\s*(?:DIN\s*509)?[\s-]*([A-Z])\s*(\d+(?:[.,]\d+)?)\s*(?:[xX]|×)\s*(\d+(?:[.,]\d+)?)\s*)");
  std::optional<part::Undercut> found;
  if (const auto m = kForm.match(text))
    found = part::undercut((*m)[1][0], decimal((*m)[2]), decimal((*m)[3]));
  if (!found && !text.empty())
    r.problem(tr("an undercut of DIN 509 with a radius and a depth of its table: of form "
                 "E or F like \"E0.8x0.3\", \"G0.4x0.2\", \"H0.8x0.3\" or \"H1.2x0.3\""),
              "choice");
  return found;
}

// In the lower element; `most_mm` of the step are free for its radius.  It is as deep as drawn
// once its element is ground.
void read_undercut(const Draft& draft, Reader& r, const Step& step, double most_mm,
                   part::OuterElement& e) {
  auto& mine = undercut_at(e, opposite(step.end));
  const double free = e.length_mm - edge_length_mm(e, step.end);
  const bool thread = e.cut && e.cut->kind == part::CutKind::thread;
  auto found = thread ? read_thread_undercut(r.at("undercut"), e.cut->pitch_mm)
                      : read_undercut(r.at("undercut"));
  if (!found) return;
  const double more = draft.ground(e.id) / 2;
  found->depth_mm += more;
  found->width_mm += more / std::tan(part::falls_rad(*found));
  if (mine)
    r.problem_at("at", tr("each corner once"), "duplicate");
  else if (!can_have_edge(e) || part::is_knurled(e))
    r.problem_at("at", tr("the inner corner beside a cylinder or a thread"), "conflict");
  else if (!(found->width_mm < free))
    r.problem_at("undercut",
                 say("an undercut that is less wide than the {} mm that are left of {}",
                     rounded(free), e.id),
                 "conflict");
  else if (part::height_mm(*found) - found->depth_mm > most_mm)
    r.problem_at(
        "undercut",
        say("an undercut that takes at most {} mm of the shoulder", at_most(most_mm)),
        "conflict");
  else
    mine = found;
}

void read_edge(Draft& draft, Reader& r, const std::vector<Step>& all) {
  auto& d = draft.drawing();
  std::vector<std::string> names, told;
  for (const auto& s : all) {
    names.insert(names.end(), s.names.begin(), s.names.end());
    told.push_back(s.names.front());
  }
  const auto at = r.at("at", tr("the name of an edge"));
  const auto id = at.as_text();
  const auto step = std::find_if(all.begin(), all.end(), [&](const Step& s) {
    return std::find(s.names.begin(), s.names.end(), id) != s.names.end();
  });
  const bool chamfer = r.has("chamfer_mm"), radius = r.has("radius_mm"),
             fillet = r.has("fillet_mm"), undercut = r.has("undercut");
  const int asked = chamfer + radius + fillet + undercut;
  if (!id.empty() && !all.empty() && step == all.end())
    at.problem(expected_reference(id, told, tr("an edge of the part")), "unknown-id");
  if (asked != 1)
    r.problem(
        asked == 0 ? tr("an edge without a shape") : tr("an edge with several shapes"),
        tr("chamfer_mm or radius_mm for the edge, or fillet_mm or undercut for the inner "
           "corner at its foot"),
        "conflict");
  if (step == all.end() || asked != 1) {
    for (const char* key :
         {"chamfer_mm", "angle_deg", "radius_mm", "fillet_mm", "undercut"})
      r.find(key);
  } else if (chamfer || radius) {
    const double most_mm = step->most_mm - foot_mm(d, *step);
    const auto read = [&](auto& e) {
      chamfer ? read_chamfer(draft, r, *step, most_mm, e)
              : read_rounding(draft, r, *step, most_mm, e);
    };
    step->inner ? read(d.inner[step->standing]) : read(d.outer[step->standing]);
  } else if (undercut && step->lower && !step->inner) {
    const auto& edge = chamfer_at(d.outer[step->standing], step->end);
    read_undercut(draft, r, *step, step->most_mm - (edge ? edge->radial_mm : 0),
                  d.outer[*step->lower]);
  } else if (undercut) {
    r.problem_at("undercut", tr("the inner corner between two outer elements, \"d1|d2\""),
                 "conflict");
  } else if (!step->lower) {
    r.problem_at(
        "fillet_mm",
        tr("a chamfer_mm or radius_mm: there is no inner corner at a face of the part"),
        "conflict");
  } else {
    step->inner ? read_fillet(r, *step, d.inner[*step->lower])
                : read_fillet(r, *step, d.outer[*step->lower]);
  }
  r.finish();
}

// A chamfer of the given size on an edge that has none and takes it; its element is ground
// by `ground_mm` of its radius once it is cut, or raised by knurling if that is negative.
template <class Element>
void break_edge(const Step& step, double size_mm, double ground_mm, double most_mm,
                Element& e) {
  auto& mine = chamfer_at(e, step.end);
  const double free = e.length_mm - edge_length_mm(e, opposite(step.end));
  const bool drilled = e.cut && e.cut->drilled_mm > 0;
  const double turned = size_mm + ground_mm;
  if (!mine && !drilled && 0 < turned && turned < free && turned <= most_mm)
    mine = part::Chamfer{turned, turned, step.by_blade, true};
}

}  // namespace

void read_general_edges(Draft& draft) {
  const auto given = draft.root.find("general_edges_mm");
  if (!given) return;
  const auto sizes = given->as_numbers(above_up_to(0, 5, "mm"), 2, 2);
  if (sizes.size() != 2) return;
  if (sizes[0] > sizes[1]) given->problem(tr("the smaller size first"), "order");
  auto& d = draft.drawing();
  if (!sizes_were_read(d) || features(d).empty()) return;
  const double size = (sizes[0] + sizes[1]) / 2;
  for (const auto& step : steps(d)) {
    if (!step.plain) continue;
    const double most = step.most_mm - foot_mm(d, step);
    const auto broken = [&](auto& e) {
      break_edge(step, size, draft.ground(e.id) / 2, most, e);
    };
    step.inner ? broken(d.inner[step.standing]) : broken(d.outer[step.standing]);
  }
}

void read_edges(Draft& draft) {
  const auto items = draft.root.optional_items("edges", 0, 400);
  const auto& d = draft.drawing();
  const bool known = sizes_were_read(d) && !features(d).empty();
  const auto all = known ? steps(d) : std::vector<Step>{};
  for (Reader r : items) {
    r = r.as_object();
    if (!r.broken()) read_edge(draft, r, all);
  }
}

}  // namespace turnwright::document
