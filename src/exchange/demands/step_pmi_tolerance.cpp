#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

#include "base/say.hpp"
#include "step_pmi_place.hpp"

namespace turnwright::exchange {
namespace {

using part::DatumFeature;
using part::Toleranced;
using part::ToleranceKind;

constexpr double kWidest_mm = 10;  // as the part document has it

std::string described_datum(const DatumReference& d) {
  auto text = fmt::format("{}", fmt::join(d.letters, "-"));
  if (!d.modifiers.empty()) text += fmt::format(" ({})", fmt::join(d.modifiers, ", "));
  return text;
}

/// "position of diameter 1.27 mm (maximum material requirement) to A, B".
std::string described_tolerance(const GeometricTolerance& t) {
  auto text = say("{} tolerance", tr(name(t.symbol)));
  if (t.width_mm)
    text += t.diametral ? say(" of diameter {} mm", *t.width_mm)
                        : say(" of {} mm", *t.width_mm);
  if (!t.modifiers.empty()) text += fmt::format(" ({})", fmt::join(t.modifiers, ", "));
  for (std::size_t i = 0; i < t.datums.size(); ++i)
    text += i == 0 ? say(" to {}", described_datum(t.datums[i]))
                   : ", " + described_datum(t.datums[i]);
  return text;
}

void leave_tolerance_out(const GeometricTolerance& t, const std::string& reason,
                         Outline& outline) {
  outline.ignored.push_back(
      {t.at, say("The {} is left out: {}.", described_tolerance(t), reason)});
}

// The kind of a symbol on an element or on a face; nothing for those a part document lacks.
std::optional<ToleranceKind> tolerance_kind(Symbol symbol, bool face, bool datum) {
  switch (symbol) {
    case Symbol::angularity:
      return ToleranceKind::angularity;
    case Symbol::circular_runout:
      return face ? ToleranceKind::circular_axial_runout
                  : ToleranceKind::circular_radial_runout;
    case Symbol::coaxiality:
    case Symbol::concentricity:
      return ToleranceKind::coaxiality;
    case Symbol::cylindricity:
      return ToleranceKind::cylindricity;
    case Symbol::flatness:
      return ToleranceKind::flatness;
    case Symbol::line_profile:
    case Symbol::surface_profile:
      return datum ? ToleranceKind::profile : ToleranceKind::profile_without_datum;
    case Symbol::parallelism:
      return ToleranceKind::parallelism;
    case Symbol::perpendicularity:
      return ToleranceKind::perpendicularity;
    case Symbol::position:
      return ToleranceKind::position;
    case Symbol::roundness:
      return ToleranceKind::circularity;
    case Symbol::straightness:
      return ToleranceKind::straightness;
    case Symbol::total_runout:
      return face ? ToleranceKind::total_axial_runout
                  : ToleranceKind::total_radial_runout;
    case Symbol::symmetry:
      break;
  }
  return std::nullopt;
}

bool suits(Toleranced of, const Place& place) {
  switch (of) {
    case Toleranced::cylinder:
      return place.kind == PlaceKind::cylinder;
    case Toleranced::element:
      return place.is_element();
    case Toleranced::face:
      return place.is_face();
    case Toleranced::element_or_face:
      return place.is_element() || place.is_face();
    case Toleranced::two_faces:
      break;
  }
  return false;
}

Toleranced datum_suits(DatumFeature wanted, const Place& toleranced) {
  if (wanted == DatumFeature::element) return Toleranced::element;
  if (wanted == DatumFeature::face) return Toleranced::face;
  if (wanted == DatumFeature::other)
    return toleranced.is_face() ? Toleranced::element : Toleranced::face;
  return Toleranced::element_or_face;
}

std::string wanted_feature(Toleranced of) {
  if (of == Toleranced::cylinder) return tr("a cylinder");
  if (of == Toleranced::element) return tr("a cylinder or cone");
  return of == Toleranced::face ? tr("a face") : tr("an element or a face");
}

// What is said of the axis of a feature, as the zone or the aspect has it.
bool is_of_axis(const GeometricTolerance& t) { return t.of.axis || t.diametral; }

// What stands in the way whatever the tolerance is of; "" if nothing does.
std::string obstacle(const GeometricTolerance& t) {
  if (!t.width_mm) return tr("the file gives no value");
  if (!(*t.width_mm > 0 && *t.width_mm <= kWidest_mm))
    return tr("a part document has values > 0 and up to 10 mm");
  if (!t.modifiers.empty()) return tr("a part document has no such modifier");
  for (const auto& d : t.datums)
    if (!d.modifiers.empty()) return tr("a part document has no modifiers of datums");
  const bool form = t.symbol == Symbol::straightness || t.symbol == Symbol::flatness ||
                    t.symbol == Symbol::roundness || t.symbol == Symbol::cylindricity ||
                    t.symbol == Symbol::circular_runout ||
                    t.symbol == Symbol::total_runout;
  if (form && is_of_axis(t))
    return tr("a part document has it of a surface, not of an axis or median plane");
  if (t.symbol == Symbol::position && !is_of_axis(t))
    return tr("a part document has the position of an axis, in a cylindrical zone");
  return "";
}

struct DatumPlace {
  std::optional<Place> place = {};
  std::string reason = {};  ///< why there is none; "" if the tolerance has no datum
};

using Datums = std::map<std::string, DatumPlace, std::less<>>;

// By their letters; writers may repeat a datum for every tolerance that names it.
Datums datums_of(const Pmi& pmi, const Places& places) {
  std::map<std::string, Datum, std::less<>> merged;
  for (const auto& datum : pmi.datums) {
    auto& one = merged[datum.letter];
    one.targets = one.targets || datum.targets;
    one.of.faces.insert(one.of.faces.end(), datum.of.faces.begin(), datum.of.faces.end());
  }
  Datums all;
  for (const auto& [letter, datum] : merged) {
    const auto found = places.of(datum.of);
    auto& place = all[letter];
    if (datum.targets)
      place.reason = say("datum {} is made of datum targets", letter);
    else if (found.empty())
      place.reason = say("datum {} is not in the outline", letter);
    else if (found.size() > 1)
      place.reason = say("datum {} is on more than one feature: {}", letter, ids(found));
    else
      place.place = found.front();
  }
  return all;
}

DatumPlace datum_of(const std::string& letter, const Datums& datums) {
  const auto found = datums.find(letter);
  if (found != datums.end()) return found->second;
  return {.reason = say("the file has no datum {}", letter)};
}

// What a tolerance refers to: nothing, one place, or two for a common datum A-B.
struct Reference {
  std::vector<Place> places = {};
  std::string reason = {};  ///< why it cannot be told
};

// The reason against a system of several datums says where they are, so that the author of
// the document can choose.
Reference reference_of(const GeometricTolerance& t, const Datums& datums) {
  std::vector<std::string> letters;
  for (const auto& d : t.datums)
    letters.insert(letters.end(), d.letters.begin(), d.letters.end());
  if (letters.empty() && !t.datums.empty())
    return {.reason = tr("its datum has no letter")};
  const bool common = t.datums.size() == 1 && letters.size() == 2;
  if (letters.size() > 1 && !common) {
    std::string where;
    for (const auto& letter : letters)
      if (const auto datum = datum_of(letter, datums); datum.place)
        where += (where.empty() ? "; " : ", ") + say("{} is {}", letter, datum.place->id);
    return {.reason =
                tr("a part document has one datum, or the common one of two elements") +
                where};
  }
  Reference all;
  for (const auto& letter : letters) {
    const auto datum = datum_of(letter, datums);
    if (!datum.place) return {.reason = datum.reason};
    all.places.push_back(*datum.place);
  }
  return all;
}

// Why a tolerance of a kind cannot refer to these places; "" if it can.
std::string unsuitable(const std::vector<Place>& datum, const part::ToleranceFacts& facts,
                       const Place& of) {
  if ((facts.datum == DatumFeature::none) != datum.empty())
    return datum.empty() ? tr("it has no datum")
                         : tr("it has no datum in a part document");
  const bool common = datum.size() > 1;
  if (common && datum.front().id == datum.back().id)
    return say("both elements of its common datum are {}", datum.front().id);
  for (const auto& place : datum) {
    if (!common && place.id == of.id) return say("its datum is {} itself", place.id);
    auto wanted = datum_suits(facts.datum, of);
    if (common && wanted == Toleranced::element_or_face) wanted = Toleranced::element;
    if (!suits(wanted, place))
      return say("its datum is {} in a part document, and {} is {}",
                 wanted_feature(wanted), place.id, tr(name(place.kind)));
  }
  if (common && datum_suits(facts.datum, of) == Toleranced::face)
    return tr("its datum is one face in a part document");
  return "";
}

void add_to(const Place& place, const GeometricTolerance& t,
            const std::vector<Place>& datum, Outline& outline) {
  const auto kind = tolerance_kind(t.symbol, place.is_face(), !datum.empty());
  if (!kind)
    return leave_tolerance_out(t, tr("a part document has no tolerance of this kind"),
                               outline);
  if (place.kind == PlaceKind::cut)
    return leave_tolerance_out(t, say("{} is made at fixed conditions", place.id),
                               outline);
  const auto& facts = part::facts(*kind);
  if (!suits(facts.of, place))
    return leave_tolerance_out(
        t,
        say("it is of {} in a part document, and {} is {}", wanted_feature(facts.of),
            place.id, tr(name(place.kind))),
        outline);
  if (const auto reason = unsuitable(datum, facts, place); !reason.empty())
    return leave_tolerance_out(t, reason, outline);
  outline.tolerances.push_back(
      {.id = fmt::format("t{}", outline.tolerances.size() + 1),
       .kind = *kind,
       .of = place.id,
       .datum = datum.empty() ? std::string() : datum.front().id,
       .between = {},
       .value_mm = *t.width_mm,
       .limits = {},
       .common_datum = datum.size() > 1 ? datum.back().id : std::string()});
}

void add_tolerance(const GeometricTolerance& t, const Datums& datums,
                   const Places& places, Outline& outline) {
  if (const auto reason = obstacle(t); !reason.empty())
    return leave_tolerance_out(t, reason, outline);
  const auto of = places.of(t.of);
  if (of.empty())
    return leave_tolerance_out(t, tr("its feature is not in the outline"), outline);
  const auto datum = reference_of(t, datums);
  if (!datum.reason.empty()) return leave_tolerance_out(t, datum.reason, outline);
  for (const auto& place : of) add_to(place, t, datum.places, outline);
}

}  // namespace

void add_tolerances(const Pmi& pmi, const Places& places, Outline& outline) {
  const auto datums = datums_of(pmi, places);
  for (const auto& t : pmi.tolerances) add_tolerance(t, datums, places, outline);
}

}  // namespace turnwright::exchange
