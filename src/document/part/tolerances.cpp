#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/say.hpp"
#include "document/json/fields.hpp"
#include "document/json/reference.hpp"
#include "part_sections.hpp"
#include "turnwright/tolerance/general.hpp"

namespace turnwright::document {
namespace {

using part::ToleranceKind;
using Datum = part::DatumFeature;
using Of = part::Toleranced;

std::vector<std::string> names(const std::vector<NamedFeature>& features,
                               bool (*wanted)(Feature)) {
  std::vector<std::string> out;
  for (const auto& named : features)
    if (wanted(named.feature)) out.push_back(named.id);
  return out;
}

struct Found {
  std::string id;
  std::optional<Feature> feature;  // none if the id is unknown, which is reported
};

Found find_feature(const Reader& value, const part::Drawing& drawing,
                   const std::vector<NamedFeature>& features) {
  const auto all = names(features, [](Feature) { return true; });
  Found found{checked_reference(value, all, tr("an element or face of the part")), {}};
  for (const auto& named : features)
    if (named.id == found.id) found.feature = named.feature;
  found.id = checked_wall(value, drawing, std::move(found.id));
  return found;
}

bool fits(Of of, Feature feature) {
  switch (of) {
    case Of::cylinder:
      return feature == Feature::cylinder;
    case Of::element:
      return !is_face(feature);
    case Of::face:
      return is_face(feature);
    case Of::element_or_face:
      return true;
    case Of::two_faces:
      break;
  }
  return false;
}

std::string wanted_feature(Of of) {
  switch (of) {
    case Of::cylinder:
      return tr("a cylinder");
    case Of::element:
      return tr("a cylinder or cone");
    case Of::face:
      return tr("a face");
    case Of::element_or_face:
      return tr("an element or a face");
    case Of::two_faces:
      break;
  }
  return tr("two faces");
}

// What `datum` must be for a toleranced feature.
Of datum_of(Datum datum, Feature toleranced) {
  switch (datum) {
    case Datum::element:
      return Of::element;
    case Datum::face:
      return Of::face;
    case Datum::other:
      return is_face(toleranced) ? Of::element : Of::face;
    case Datum::none:
    case Datum::element_or_face:
      break;
  }
  return Of::element_or_face;
}

class ToleranceReader {
 public:
  ToleranceReader(Draft& draft, std::vector<NamedFeature> features)
      : draft_(draft), features_(std::move(features)) {}

  part::Tolerance read(Reader r) {
    r = r.as_object();
    part::Tolerance t;
    t.id = read_id(r);
    const auto& list = draft_.drawing().tolerances;
    if (!t.id.empty() && std::any_of(list.begin(), list.end(),
                                     [&](const auto& other) { return other.id == t.id; }))
      r.problem_at("id", tr("an id no other tolerance has"), "duplicate");
    const auto before = r.problems().list.size();
    t.kind = r.choice<ToleranceKind>("kind", kinds());
    if (r.problems().list.size() > before) return t;  // the other keys depend on it
    const auto& facts = part::facts(t.kind);
    if (facts.of == Of::two_faces)
      read_between(r, t);
    else
      read_features(r, t);
    if (facts.rule == part::ToleranceRule::size) {
      t.limits = read_limits(r);
      t.value_mm = t.limits->upper_mm - t.limits->lower_mm;
    } else {
      t.value_mm = r.number("value_mm", above_up_to(0, 10, "mm"));
    }
    r.finish();
    return t;
  }

 private:
  Found found(const Reader& value) const {
    return find_feature(value, draft_.drawing(), features_);
  }

  static Choices<ToleranceKind> kinds() {
    Choices<ToleranceKind> out;
    for (const bool faces : {true, false})
      for (const auto& row : part::tolerance_kinds())
        if ((row.of == Of::two_faces) == faces) out.emplace_back(row.name, row.kind);
    return out;
  }

  void read_between(Reader& r, part::Tolerance& t) const {
    const auto faces = names(features_, is_face);
    const auto ends = r.items("between", 2, 2);
    if (ends.size() != 2) return;
    for (std::size_t i = 0; i < 2; ++i)
      t.between[i] =
          checked_wall(ends[i], draft_.drawing(),
                       checked_reference(ends[i], faces, tr("a face of the part")));
    if (t.between[0] == t.between[1] && !t.between[0].empty())
      r.problem_at("between", tr("two different faces"), "conflict");
  }

  void read_features(Reader& r, part::Tolerance& t) const {
    const auto& facts = part::facts(t.kind);
    const auto of = found(r.at("of", wanted_feature(facts.of)));
    t.of = of.id;
    if (of.feature == Feature::fixed)
      r.problem_at("of",
                   tr("a surface that is turned, faced or bored: no tolerance is "
                      "predicted of what catalogue conditions make"),
                   "unsupported");
    else if (of.feature && !fits(facts.of, *of.feature))
      r.problem_at("of", say("{} for {}", wanted_feature(facts.of), part::name(t.kind)),
                   "kind");
    read_datum(r, t, facts.datum, of);
  }

  void read_datum(Reader& r, part::Tolerance& t, Datum wants, const Found& of) const {
    if (wants == Datum::none) {
      if (r.has("datum"))
        r.problem_at("datum", say("no datum: {} has none", part::name(t.kind)), "kind");
      return;
    }
    if (t.kind == ToleranceKind::profile && !r.has("datum")) {
      t.kind = ToleranceKind::profile_without_datum;
      draft_.assume(r.pointer_of("kind"), part::name(t.kind), tr("no datum given"));
      return;
    }
    const Of want = of.feature ? datum_of(wants, *of.feature) : Of::element_or_face;
    const Reader value = r.at("datum", wanted_feature(want));
    if (value.is_array()) return read_common_datum(r, t, want);
    const auto datum = found(value);
    t.datum = datum.id;
    if (datum.feature && !fits(want, *datum.feature))
      r.problem_at("datum",
                   say("{} as datum for {}", wanted_feature(want), part::name(t.kind)),
                   "kind");
    else if (!t.datum.empty() && t.datum == t.of)
      r.problem_at("datum", tr("another feature than the toleranced one"), "conflict");
  }

  // "datum": ["d2", "d6"], written A-B in a tolerance frame.
  void read_common_datum(Reader& r, part::Tolerance& t, Of want) const {
    if (want == Of::face)
      return r.problem_at("datum", tr("one face: only elements have a common axis"),
                          "kind");
    const auto ends = r.items("datum", 2, 2);
    if (ends.size() != 2) return;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto end = found(ends[i]);
      (i == 0 ? t.datum : t.common_datum) = end.id;
      if (end.feature && !fits(Of::element, *end.feature))
        ends[i].problem(tr("a cylinder or cone, for only elements have a common axis"),
                        "kind");
    }
    const auto a = part::extent(draft_.drawing(), t.datum),
               b = part::extent(draft_.drawing(), t.common_datum);
    if (a && b && !(std::abs(a->z0_mm + a->z1_mm - b->z0_mm - b->z1_mm) > 0))
      r.problem_at("datum",
                   tr("two elements whose middles lie apart along the axis, which goes "
                      "through both"),
                   "conflict");
  }

  Draft& draft_;
  std::vector<NamedFeature> features_;
};

part::Tolerance size_tolerance(const std::string& element, const part::Limits& limits) {
  return {.id = element + ":diameter",
          .kind = ToleranceKind::diameter,
          .of = element,
          .datum = "",
          .between = {},
          .value_mm = limits.upper_mm - limits.lower_mm,
          .limits = limits};
}

// An explicit tolerance of an element's diameter is the element's size, once.
template <class Element>
void take_diameter(Reader& r, const part::Tolerance& t, std::vector<Element>& elements) {
  for (auto& e : elements) {
    if (e.id != t.of) continue;
    if (e.limits && !e.cut)
      r.problem_at("of", tr("a diameter without fit, limits_mm or another tolerance"),
                   "conflict");
    e.limits = t.limits;
  }
}

void read_listed(Draft& draft) {
  auto& drawing = draft.drawing();
  ToleranceReader reader(draft, features(drawing));
  for (Reader r : draft.root.optional_items("tolerances", 0, 500)) {
    auto t = reader.read(r);
    if (draft.ground(t.of) > 0) {
      draft.assume(r.pointer(), t.id, tr("made by grinding: not predicted"));
      continue;
    }
    if (t.kind == ToleranceKind::diameter && t.limits) {
      take_diameter(r, t, drawing.outer);
      take_diameter(r, t, drawing.inner);
    }
    drawing.tolerances.push_back(std::move(t));
  }
}

nlohmann::json limits_pair(const part::Limits& limits) {
  return {limits.lower_mm, limits.upper_mm};
}

// Sizes the drawing leaves open get ISO 2768-1's deviations; of a cone's diameters the
// smaller counts, whose deviations are never the larger ones.
template <class Element>
void assume_sizes(Draft& draft, std::vector<Element>& elements, const std::string& list,
                  tolerance::LinearClass linear, const std::string& why) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    auto& e = elements[i];
    const double size_mm = std::min(e.left_mm, e.right_mm);
    if (e.limits || e.cut || part::stays(e) || !(size_mm > 0)) continue;
    try {
      e.limits = tolerance::general_limits_mm(size_mm, linear);
    } catch (const std::domain_error&) {
      continue;  // the standard has no value for this size: it stays open
    }
    draft.assume("/" + list + "/" + std::to_string(i) + "/limits_mm",
                 limits_pair(*e.limits), why);
  }
}

bool has_overall_length(const part::Drawing& drawing) {
  return std::any_of(drawing.tolerances.begin(), drawing.tolerances.end(),
                     [](const part::Tolerance& t) {
                       return (t.between[0] == "left" && t.between[1] == "right") ||
                              (t.between[0] == "right" && t.between[1] == "left");
                     });
}

void assume_length(Draft& draft, tolerance::LinearClass linear, const std::string& why) {
  auto& drawing = draft.drawing();
  const double length_mm = part::length_mm(drawing);
  if (has_overall_length(drawing) || !(length_mm > 0)) return;
  try {
    const auto limits = tolerance::general_limits_mm(length_mm, linear);
    part::Tolerance t{.id = "part:length",
                      .kind = ToleranceKind::length,
                      .of = "",
                      .datum = "",
                      .between = {"left", "right"},
                      .value_mm = limits.upper_mm - limits.lower_mm,
                      .limits = limits};
    draft.assume("/tolerances",
                 {{"id", t.id},
                  {"kind", part::name(t.kind)},
                  {"between", t.between},
                  {"limits_mm", limits_pair(limits)}},
                 why);
    drawing.tolerances.push_back(std::move(t));
  } catch (const std::domain_error&) {
    return;  // the standard has no value for this length: it stays open
  }
}

void assume_form(Draft& draft, tolerance::GeometricalClass form, const std::string& why) {
  for (auto& t : tolerance::implied_form_tolerances(draft.drawing(), form)) {
    if (draft.ground(t.of) > 0) continue;
    draft.assume("/tolerances",
                 {{"id", t.id},
                  {"kind", part::name(t.kind)},
                  {"of", t.of},
                  {"value_mm", t.value_mm}},
                 why);
    draft.drawing().tolerances.push_back(std::move(t));
  }
}

void read_general(Draft& draft) {
  const auto value = draft.root.find("general");
  if (!value) return;
  const auto text = value->as_text();
  if (text.empty()) return;
  try {
    const auto general = tolerance::general_tolerance(text);
    auto& drawing = draft.drawing();
    if (general.linear) {
      assume_sizes(draft, drawing.outer, "outer", *general.linear, text);
      assume_sizes(draft, drawing.inner, "inner", *general.linear, text);
      assume_length(draft, *general.linear, text);
    }
    if (general.geometrical) assume_form(draft, *general.geometrical, text);
  } catch (const std::domain_error&) {
    value->problem(tr("\"ISO 2768-\" with f, m, c or v for sizes and H, K or L for form, "
                      "such as \"ISO 2768-mK\""),
                   "choice");
  }
}

// A diameter tolerance for every sized element that no listed one speaks of.
template <class Element>
void add_sizes(part::Drawing& drawing, const std::vector<Element>& elements) {
  for (const auto& e : elements) {
    const auto& list = drawing.tolerances;
    const bool listed = std::any_of(list.begin(), list.end(), [&](const auto& t) {
      return t.kind == ToleranceKind::diameter && t.of == e.id;
    });
    if (e.limits && !e.cut && !listed)
      drawing.tolerances.push_back(size_tolerance(e.id, *e.limits));
  }
}

}  // namespace

part::Limits read_limits(Reader& r) {
  const auto ends = r.numbers("limits_mm", within(-100, 100, "mm"), 2, 2);
  if (ends.size() != 2) return {};
  if (ends[0] >= ends[1])
    r.problem_at("limits_mm", tr("[lower, upper] with lower < upper"), "order");
  return {.lower_mm = ends[0], .upper_mm = ends[1]};
}

void read_tolerances(Draft& draft) {
  auto& drawing = draft.drawing();
  read_listed(draft);
  read_general(draft);
  add_sizes(drawing, drawing.outer);
  add_sizes(drawing, drawing.inner);
}

}  // namespace turnwright::document
