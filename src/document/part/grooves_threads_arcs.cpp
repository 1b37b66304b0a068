#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/say.hpp"
#include "document/json/fields.hpp"
#include "part_sections.hpp"
#include "turnwright/base/pattern.hpp"
#include "turnwright/part/inch_thread.hpp"
#include "turnwright/part/metric_thread.hpp"
#include "turnwright/tolerance/iso286.hpp"

namespace turnwright::document {
namespace {

using part::CutKind;
using part::Where;

void read_demands(Draft& draft, Reader& r, double least_mm) {
  r.optional_number("Ra_um", above_up_to(0, 100, "um"));
  r.optional_number("Rz_um", above_up_to(0, 400, "um"));
  if (r.has("limits_mm") && least_mm + read_limits(r).lower_mm <= 0)
    r.problem_at("limits_mm", tr("limits that leave a diameter > 0 mm"), "conflict");
  if (r.has("fit") && r.has("limits_mm"))
    r.problem_at("limits_mm", tr("fit or limits_mm, not both"), "conflict");
  leave_to_the_tool(draft, r);
}

struct Size {
  double d_mm = std::numeric_limits<double>::quiet_NaN();
  double P_mm = std::numeric_limits<double>::quiet_NaN();
};

// "M30x1.5", or "M30" of the coarse series; "1/2-13 UNC" in inches.
Size read_designation(Reader& r) {
  const auto text = r.text("designation", 20);
  for (const char* key : {"diameter_mm", "pitch_mm"})
    if (r.has(key))
      r.problem_at(key, tr("designation, or diameter_mm and pitch_mm, not both"),
                   "conflict");
  if (text.empty()) return {};
  if (const auto inch = part::inch_thread(text)) return {inch->d_mm, inch->pitch_mm};
  const auto metric = part::metric_thread(text);
  if (metric && metric->pitch_mm) return {metric->d_mm, *metric->pitch_mm};
  r.problem_at("designation",
               metric ? say("a pitch too: \"{}\" has no coarse one", text)
                      : tr("an ISO metric thread like \"M30x1.5\" or \"M30\", or a "
                           "Unified inch thread like \"1/2-13 UNC\""),
               "choice");
  return {};
}

Size read_thread_size(Draft& draft, Reader& r) {
  if (r.has("designation")) return read_designation(r);
  Size s;
  s.d_mm = r.number("diameter_mm", kSize);
  const auto coarse = part::coarse_pitch_mm(s.d_mm);
  if (r.has("pitch_mm")) {
    s.P_mm = r.number("pitch_mm", above_up_to(0, 50, "mm"));
  } else if (!coarse) {
    if (std::isfinite(s.d_mm))
      r.problem_at("pitch_mm",
                   say("a pitch: {} mm has no coarse one", number_text(s.d_mm)),
                   "conflict");
  } else {
    s.P_mm = *coarse;
    draft.assume(r.pointer_of("pitch_mm"), s.P_mm, tr("the coarse pitch of ISO 261"));
  }
  return s;
}

void check_thread_class(Reader& r) {
  static const Pattern kClass("[3-9][a-hA-H]([3-9][a-hA-H])?|[123][AB]");
  const auto fit = r.optional_text("fit", 8);
  if (fit && !fit->empty() && !kClass.match(*fit))
    r.problem_at("fit", tr("a thread's tolerance class like \"6g\", \"6H\" or \"2A\""),
                 "choice");
}

part::Shaped read_thread(Draft& draft, Reader& r, Where where) {
  const auto s = read_thread_size(draft, r);
  check_thread_class(r);
  read_demands(draft, r, s.d_mm);
  const char* key = r.has("designation") ? "designation" : "pitch_mm";
  if (!(s.d_mm > 0 && s.d_mm <= 20000 && s.P_mm > 0)) {
    if (r.has("designation") && std::isfinite(s.d_mm))
      r.problem_at(key, tr("a diameter > 0 and <= 20000 mm and a pitch > 0 mm"), "range");
    return {};
  }
  if (s.P_mm > s.d_mm / 3)
    r.problem_at(key, tr("a pitch of at most a third of the diameter"), "conflict");
  return part::thread(s.d_mm, s.P_mm, where);
}

// Diameter of a groove's floor or of a hole.
double read_diameter(Draft& draft, Reader& r) {
  const double floor = r.number("diameter_mm", kSize);
  if (const auto fit = r.optional_text("fit", 8);
      fit && !fit->empty() && std::isfinite(floor)) {
    try {
      tolerance::fit_limits_mm(floor, *fit);
    } catch (const std::domain_error& error) {
      r.problem_at("fit", say("an ISO 286 tolerance class ({})", error.what()), "choice");
    }
  }
  read_demands(draft, r, floor);
  return floor;
}

part::Shaped read_arc(Draft& draft, Reader& r, double length_mm) {
  const part::Ends ends{r.number("left_mm", kSize), r.number("right_mm", kSize)};
  const double radius = r.number("radius_mm", kSize);
  const bool convex = r.choice_or("bulge", {{"convex", true}, {"concave", false}}, true);
  if (!r.has("bulge")) draft.assume(r.pointer_of("bulge"), "convex", tr("default"));
  read_demands(draft, r, std::min(ends.left_mm, ends.right_mm));
  if (!std::isfinite(length_mm + ends.left_mm + ends.right_mm + radius)) return {};
  try {
    return part::arc(length_mm, ends, radius, convex);
  } catch (const std::domain_error& error) {
    r.problem_at("radius_mm", error.what(), "conflict");
    return {};
  }
}

template <class Element>
void read(Draft& draft, Reader& r, Element& e, CutKind kind, Where where) {
  e.length_mm = r.number("length_mm", kSize);
  part::Shaped s;
  if (kind == CutKind::thread) s = read_thread(draft, r, where);
  if (kind == CutKind::groove) {
    const double floor = read_diameter(draft, r);
    s = part::groove(floor, floor);
  }
  if (kind == CutKind::hole) s = part::hole(read_diameter(draft, r));
  if (kind == CutKind::arc) s = read_arc(draft, r, e.length_mm);
  s.cut.kind = kind;
  r.finish();
  const bool readable = s.blank.left_mm > 0;
  e.left_mm = readable ? s.blank.left_mm : std::numeric_limits<double>::quiet_NaN();
  e.right_mm = readable ? s.blank.right_mm : e.left_mm;
  e.kind =
      e.left_mm == e.right_mm ? part::ElementKind::cylinder : part::ElementKind::cone;
  e.cut = s.cut;
}

using part::is_groove;

bool same_bore(const part::OuterElement&, const part::OuterElement&) { return true; }
bool same_bore(const part::InnerElement& a, const part::InnerElement& b) {
  return a.from == b.from;
}

// Whether the next element of a list lies on the right.
bool rightwards(const part::OuterElement&) { return true; }
bool rightwards(const part::InnerElement& e) { return e.from == part::End::left; }

// The diameter of element k at its side towards groove i.
template <class Element>
double towards(const std::vector<Element>& list, std::size_t k, std::size_t i) {
  const bool on_the_right = (k > i) == rightwards(list[i]);
  return on_the_right ? list[k].left_mm : list[k].right_mm;
}

// The smaller (inside the larger) of the nearest elements that are not grooves.
template <class Element>
std::optional<std::size_t> neighbour(const std::vector<Element>& list, std::size_t i,
                                     Where where) {
  std::optional<std::size_t> before, after;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (is_groove(list[k]) || !same_bore(list[k], list[i])) continue;
    if (k < i) before = k;
    if (k > i && !after) after = k;
  }
  if (!before || !after) return before ? before : after;
  const double b = towards(list, *before, i), a = towards(list, *after, i);
  const bool first = where == Where::outside ? b <= a : b >= a;
  return first ? before : after;
}

template <class Element>
void give_blanks(std::vector<Element>& list, const std::vector<Reader>& items,
                 Where where) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    auto& e = list[i];
    if (!is_groove(e)) continue;
    const auto k = beside(list, i);
    if (!k) {
      items[i].problem_at("kind",
                          tr("a groove beside another element: its blank is turned to "
                             "that one's diameter"),
                          "conflict");
      continue;
    }
    if (part::stays(list[*k])) {
      items[i].problem_at("kind",
                          say("no groove or neck there: its blank would be turned to the "
                              "diameter of {} beside it, which stays as the stock is",
                              list[*k].id),
                          "conflict");
      continue;
    }
    const double blank = towards(list, *k, i), floor = e.cut->drawn.left_mm;
    const bool outside = where == Where::outside;
    if (outside ? floor >= blank : floor <= blank)
      items[i].problem_at("diameter_mm",
                          outside ? say("less than the {} mm of {} beside the groove",
                                        number_text(blank), list[*k].id)
                                  : say("more than the {} mm of {} beside the groove",
                                        number_text(blank), list[*k].id),
                          "conflict");
    const auto s = part::groove(blank, floor);
    e.left_mm = e.right_mm = blank;
    e.cut = s.cut;
  }
}

// Whether something larger stands on both sides of outer element i.
bool in_a_neck(const std::vector<part::OuterElement>& outer, std::size_t i) {
  const double own = std::max(outer[i].left_mm, outer[i].right_mm);
  const auto larger = [&](std::size_t from, std::size_t to) {
    return std::any_of(outer.begin() + static_cast<long>(from),
                       outer.begin() + static_cast<long>(to), [&](const auto& e) {
                         return !is_groove(e) && std::max(e.left_mm, e.right_mm) > own;
                       });
  };
  return larger(0, i) && larger(i + 1, outer.size());
}

bool is_plain_cylinder(const part::OuterElement& e) {
  return !e.cut && e.kind == part::ElementKind::cylinder;
}

// Whether walls enclose the elements first to end - 1, which are cylinders or grooves.
bool is_walled(const std::vector<part::OuterElement>& outer, std::size_t first,
               std::size_t end) {
  return outer[first - 1].right_mm > outer[first].left_mm &&
         outer[end].left_mm > outer[end - 1].right_mm &&
         std::all_of(outer.begin() + static_cast<long>(first),
                     outer.begin() + static_cast<long>(end),
                     [](const auto& e) { return is_plain_cylinder(e) || is_groove(e); });
}

// The cylinders of a neck, between larger diameters on both sides, become grooves; a neck
// that holds anything else is left as it is.
void plunge_necks(Draft& draft, const std::vector<Reader>& items) {
  auto& outer = draft.drawing().outer;
  for (std::size_t first = 0; first < outer.size(); ++first) {
    std::size_t end = first;
    while (end < outer.size() && in_a_neck(outer, end)) ++end;
    const bool plain = first < end && is_walled(outer, first, end);
    for (; first < end; ++first) {
      auto& e = outer[first];
      if (!plain || is_groove(e)) continue;
      draft.assume(items[first].pointer_of("kind"), "groove",
                   tr("a neck between larger diameters is plunged by a grooving blade"));
      make_at_catalogue_conditions(draft, items[first], e,
                                   part::groove(e.left_mm, e.left_mm).cut);
    }
  }
}

}  // namespace

void leave_to_the_tool(Draft& draft, Reader& r) {
  for (const char* key : {"fit", "limits_mm", "Ra_um", "Rz_um"})
    if (const auto value = r.find(key); value && !value->broken())
      draft.assume(r.pointer_of(key), value->json(),
                   tr("left to the tool at its catalogue conditions: not predicted"));
}

void read_cut(Draft& draft, Reader& r, part::OuterElement& e, CutKind kind) {
  if (kind == CutKind::hole)
    r.problem_at("kind", tr("a kind that an outer element can have: not \"hole\""),
                 "kind");
  read(draft, r, e, kind, Where::outside);
}

void read_cut(Draft& draft, Reader& r, part::InnerElement& e, CutKind kind) {
  if (kind == CutKind::arc)
    r.problem_at("kind", tr("a kind that a bore can have: not \"arc\""), "kind");
  read(draft, r, e, kind, Where::inside);
}

std::optional<std::size_t> beside(const std::vector<part::OuterElement>& list,
                                  std::size_t groove) {
  return neighbour(list, groove, Where::outside);
}

std::optional<std::size_t> beside(const std::vector<part::InnerElement>& list,
                                  std::size_t groove) {
  return neighbour(list, groove, Where::inside);
}

void give_grooves_their_blanks(Draft& draft, const std::vector<Reader>& outer,
                               const std::vector<Reader>& inner) {
  plunge_necks(draft, outer);
  give_blanks(draft.drawing().outer, outer, Where::outside);
  give_blanks(draft.drawing().inner, inner, Where::inside);
}

}  // namespace turnwright::document
