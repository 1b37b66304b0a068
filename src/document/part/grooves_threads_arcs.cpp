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
#include "turnwright/part/thread.hpp"
#include "turnwright/tolerance/iso286.hpp"

namespace turnwright::document {
namespace {

using part::CutKind;
using part::Where;

// The limits_mm, beside what is left to the tool.
std::optional<part::Limits> read_demands(Draft& draft, Reader& r, double least_mm,
                                         bool to_middle) {
  r.optional_number("Ra_um", above_up_to(0, 100, "um"));
  r.optional_number("Rz_um", above_up_to(0, 400, "um"));
  std::optional<part::Limits> limits;
  if (r.has("limits_mm")) limits = read_limits(r);
  if (limits && least_mm + limits->lower_mm <= 0)
    r.problem_at("limits_mm", tr("limits that leave a diameter > 0 mm"), "conflict");
  if (r.has("fit") && limits)
    r.problem_at("limits_mm", tr("fit or limits_mm, not both"), "conflict");
  leave_to_the_tool(draft, r, to_middle);
  return limits;
}

double middle_mm(const std::optional<part::Limits>& limits) {
  return limits ? (limits->lower_mm + limits->upper_mm) / 2 : 0;
}

struct Size {
  double d_mm = std::numeric_limits<double>::quiet_NaN();
  double P_mm = std::numeric_limits<double>::quiet_NaN();
  bool inch = false;
  std::string tolerance_class = {};
};

// "M30x1.5", or "M30" of the coarse series; "1/2-13 UNC" in inches.
Size read_designation(Reader& r) {
  const auto text = r.text("designation", 20);
  for (const char* key : {"diameter_mm", "pitch_mm"})
    if (r.has(key))
      r.problem_at(key, tr("designation, or diameter_mm and pitch_mm, not both"),
                   "conflict");
  if (text.empty()) return {};
  if (const auto inch = part::inch_thread(text))
    return {inch->d_mm, inch->pitch_mm, true, inch->tolerance_class};
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
  s.inch = part::inch_designation(s.d_mm, s.P_mm).has_value();
  return s;
}

struct Thread {
  part::Shaped shape = {};
  std::string tolerance_class = {};
  part::ThreadLimits limits = {};
};

// The class of the drawing, or the usual one.
Thread read_thread_class(Draft& draft, Reader& r, const Size& s, Where where) {
  const bool outside = where == Where::outside, named = !s.tolerance_class.empty();
  const auto fit = r.optional_text("fit", 8).value_or("");
  if (named && !fit.empty() && fit != s.tolerance_class)
    r.problem_at("fit", say("{} as in the designation, or no fit", s.tolerance_class),
                 "conflict");
  Thread t;
  t.tolerance_class = named ? s.tolerance_class : fit;
  if (t.tolerance_class.empty()) {
    t.tolerance_class = s.inch ? outside ? "2A" : "2B" : outside ? "6g" : "6H";
    if (!r.has("fit"))
      draft.assume(
          r.pointer_of("fit"), t.tolerance_class,
          s.inch ? tr("the usual class of ASME B1.1") : tr("the usual class of ISO 965"));
  }
  const auto limits = part::thread_limits(t.tolerance_class, s.d_mm, s.P_mm, where);
  if (limits) t.limits = *limits;
  if (!limits)
    r.problem_at(named ? "designation" : "fit",
                 outside ? tr("an outer thread's tolerance class like \"6g\" or \"2A\"")
                         : tr("an inner thread's tolerance class like \"6H\" or \"2B\""),
                 "choice");
  return t;
}

// Its crests are turned or bored as sizes are, to the middle of their limits.
Thread read_thread(Draft& draft, Reader& r, Where where) {
  const auto s = read_thread_size(draft, r);
  auto t = read_thread_class(draft, r, s, where);
  const auto given =
      read_demands(draft, r, s.d_mm, where == Where::outside || r.has("fit"));
  if (given && where == Where::outside) {
    t.limits.crest = *given;
    if (std::max(-given->lower_mm, given->upper_mm) > s.P_mm / 2)
      r.problem_at(
          "limits_mm",
          say("limits of the crests within half the pitch, {} mm, of the diameter",
              number_text(s.P_mm / 2)),
          "conflict");
  }
  const char* key = r.has("designation") ? "designation" : "pitch_mm";
  if (!(s.d_mm > 0 && s.d_mm <= 20000 && s.P_mm > 0)) {
    if (r.has("designation") && std::isfinite(s.d_mm))
      r.problem_at(key, tr("a diameter > 0 and <= 20000 mm and a pitch > 0 mm"), "range");
    return {};
  }
  if (s.P_mm > s.d_mm / 3)
    r.problem_at(key, tr("a pitch of at most a third of the diameter"), "conflict");
  t.shape = part::thread(s.d_mm, s.P_mm, where, t.limits);
  return t;
}

struct Diameter {
  double drawn_mm = 0;
  std::optional<part::Limits> limits = {};
};

// Of a groove's floor or of a hole.
Diameter read_diameter(Draft& draft, Reader& r, bool to_middle) {
  Diameter d{r.number("diameter_mm", kSize)};
  if (const auto fit = r.optional_text("fit", 8);
      fit && !fit->empty() && std::isfinite(d.drawn_mm)) {
    try {
      d.limits = tolerance::fit_limits_mm(d.drawn_mm, *fit);
    } catch (const std::domain_error& error) {
      r.problem_at("fit", say("an ISO 286 tolerance class ({})", error.what()), "choice");
    }
  }
  if (const auto given = read_demands(draft, r, d.drawn_mm, to_middle)) d.limits = given;
  return d;
}

part::Shaped read_arc(Draft& draft, Reader& r, double length_mm) {
  const part::Ends ends{r.number("left_mm", kSize), r.number("right_mm", kSize)};
  const double radius = r.number("radius_mm", kSize);
  const bool convex = r.choice_or("bulge", {{"convex", true}, {"concave", false}}, true);
  if (!r.has("bulge")) draft.assume(r.pointer_of("bulge"), "convex", tr("default"));
  read_demands(draft, r, std::min(ends.left_mm, ends.right_mm), false);
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
  if (kind == CutKind::thread) {
    const auto t = read_thread(draft, r, where);
    s = t.shape;
    e.fit = t.tolerance_class;
    e.limits = t.limits.crest;
  }
  if (kind == CutKind::groove) {
    const auto d = read_diameter(draft, r, true);
    s = part::groove(d.drawn_mm, d.drawn_mm, d.drawn_mm + middle_mm(d.limits));
  }
  if (kind == CutKind::hole) s = part::hole(read_diameter(draft, r, false).drawn_mm);
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

// A floor whose middle is not below what is cut beside it.
void refuse_floor(Reader item, const std::string& beside, double floor_mm,
                  double made_mm) {
  const auto made = number_text(std::round(1e4 * made_mm) / 1e4);
  if (!item.has("fit") && !item.has("limits_mm"))
    return item.problem_at(
        "diameter_mm",
        say("a groove in {} beside it, which is cut to {} mm", beside, made), "conflict");
  item.problem_at(
      item.has("fit") ? "fit" : "limits_mm",
      say("limits whose middle, {} mm, leaves a groove in {} beside it, which "
          "is cut to {} mm",
          number_text(floor_mm), beside, made),
      "conflict");
}

// The limits in whose middle the lowest neighbour (in a bore the widest) is cut that ends as
// high as a groove's blank; none if none is cut lower than it is drawn.
template <class Element>
std::optional<part::Limits> limits_beside(const std::vector<Element>& list, std::size_t i,
                                          double blank_mm, Where where) {
  const double out = where == Where::outside ? 1 : -1;
  std::optional<part::Limits> lowest;
  for (const std::size_t k : {i - 1, i + 1})
    if (k < list.size() && !is_groove(list[k]) && same_bore(list[k], list[i]) &&
        towards(list, k, i) == blank_mm &&
        out * middle_mm(list[k].limits) < out * middle_mm(lowest))
      lowest = list[k].limits;
  return lowest;
}

template <class Element>
void give_limits(std::vector<Element>& list, Where where) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (is_groove(list[i]))
      list[i].limits = limits_beside(list, i, list[i].left_mm, where);
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
    const double blank = towards(list, *k, i);
    const double made = blank + middle_mm(limits_beside(list, i, blank, where));
    const double drawn = e.cut->drawn.left_mm, floor = e.cut->core.left_mm;
    const bool outside = where == Where::outside;
    const auto reaches = [&](double d, double rim) {
      return outside ? d >= rim : d <= rim;
    };
    if (reaches(drawn, blank))
      items[i].problem_at("diameter_mm",
                          outside ? say("less than the {} mm of {} beside the groove",
                                        number_text(blank), list[*k].id)
                                  : say("more than the {} mm of {} beside the groove",
                                        number_text(blank), list[*k].id),
                          "conflict");
    else if (reaches(floor, blank) || reaches(floor, made))
      refuse_floor(items[i], list[*k].id, floor, made);
    const auto s = part::groove(blank, drawn, floor);
    e.left_mm = e.right_mm = blank;
    e.cut = s.cut;
    e.cut->depth_mm = std::abs(made - floor) / 2;
  }
}

// Whether something larger stands on both sides of outer element i, as drawn and as cut.
bool in_a_neck(const std::vector<part::OuterElement>& outer, std::size_t i) {
  const auto drawn_mm = [](const auto& e) { return std::max(e.left_mm, e.right_mm); };
  const auto made_mm = [&](const auto& e) { return drawn_mm(e) + middle_mm(e.limits); };
  const auto larger = [&](std::size_t from, std::size_t to) {
    return std::any_of(outer.begin() + static_cast<long>(from),
                       outer.begin() + static_cast<long>(to), [&](const auto& e) {
                         return !is_groove(e) && drawn_mm(e) > drawn_mm(outer[i]) &&
                                made_mm(e) > made_mm(outer[i]);
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
      make_at_catalogue_conditions(
          draft, items[first], e,
          part::groove(e.left_mm, e.left_mm, e.left_mm + middle_mm(e.limits)).cut);
    }
  }
}

}  // namespace

void leave_to_the_tool(Draft& draft, Reader& r, bool to_middle) {
  for (const char* key : {"fit", "limits_mm", "Ra_um", "Rz_um"}) {
    const bool size =
        std::string_view(key) == "fit" || std::string_view(key) == "limits_mm";
    if (const auto value = r.find(key); value && !value->broken())
      draft.assume(
          r.pointer_of(key), value->json(),
          size && to_middle
              ? tr("cut to the middle of its limits: what the tool leaves is not "
                   "predicted")
              : tr("left to the tool at its catalogue conditions: not predicted"));
  }
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

void give_grooves_their_limits(Draft& draft) {
  give_limits(draft.drawing().outer, Where::outside);
  give_limits(draft.drawing().inner, Where::inside);
}

void give_grooves_their_blanks(Draft& draft, const std::vector<Reader>& outer,
                               const std::vector<Reader>& inner) {
  plunge_necks(draft, outer);
  give_blanks(draft.drawing().outer, outer, Where::outside);
  give_blanks(draft.drawing().inner, inner, Where::inside);
}

}  // namespace turnwright::document
