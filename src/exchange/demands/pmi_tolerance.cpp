#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "base/say.hpp"
#include "pmi_read.hpp"

namespace turnwright::exchange {
namespace {

struct SymbolFacts {
  Symbol symbol = Symbol::position;
  std::string_view entity;
  const char* name = nullptr;
};

constexpr std::array<SymbolFacts, 15> kSymbols{
    {{Symbol::angularity, "ANGULARITY_TOLERANCE", to_translate("angularity")},
     {Symbol::circular_runout, "CIRCULAR_RUNOUT_TOLERANCE",
      to_translate("circular run-out")},
     {Symbol::coaxiality, "COAXIALITY_TOLERANCE", to_translate("coaxiality")},
     {Symbol::concentricity, "CONCENTRICITY_TOLERANCE", to_translate("concentricity")},
     {Symbol::cylindricity, "CYLINDRICITY_TOLERANCE", to_translate("cylindricity")},
     {Symbol::flatness, "FLATNESS_TOLERANCE", to_translate("flatness")},
     {Symbol::line_profile, "LINE_PROFILE_TOLERANCE", to_translate("line profile")},
     {Symbol::parallelism, "PARALLELISM_TOLERANCE", to_translate("parallelism")},
     {Symbol::perpendicularity, "PERPENDICULARITY_TOLERANCE",
      to_translate("perpendicularity")},
     {Symbol::position, "POSITION_TOLERANCE", to_translate("position")},
     {Symbol::roundness, "ROUNDNESS_TOLERANCE", to_translate("roundness")},
     {Symbol::straightness, "STRAIGHTNESS_TOLERANCE", to_translate("straightness")},
     {Symbol::surface_profile, "SURFACE_PROFILE_TOLERANCE",
      to_translate("surface profile")},
     {Symbol::symmetry, "SYMMETRY_TOLERANCE", to_translate("symmetry")},
     {Symbol::total_runout, "TOTAL_RUNOUT_TOLERANCE", to_translate("total run-out")}}};

// Bounds of what one frame says of its datums; drawings have three letters.  Frames may
// share a system, so that without them a small file could ask for much.
constexpr std::size_t kMostDatums = 6;
constexpr std::size_t kMostModifiers = 12;

/// The record with name, description, magnitude and feature; the datums if there are any.
struct ToleranceFrame {
  Record record;
  std::optional<Parameter> datums;
};

ToleranceFrame tolerance_frame(const Instance& tolerance, std::string_view entity) {
  const auto general = tolerance.find("GEOMETRIC_TOLERANCE");
  const auto record = general && general->size() >= 4 ? *general : tolerance.as(entity);
  ToleranceFrame found{record, std::nullopt};
  if (record.size() >= 5 && record[4].is(ValueKind::list)) found.datums = record[4];
  const auto with = tolerance.find("GEOMETRIC_TOLERANCE_WITH_DATUM_REFERENCE");
  if (with && with->size() >= 1) found.datums = of_last(*with, 1, 0);
  return found;
}

// Modifiers of a datum: enumerations in a typed value, or an instance with a value.
std::vector<std::string> datum_modifiers(const Parameter& list) {
  std::vector<std::string> all;
  if (list.absent()) return all;
  if (list.size() > kMostModifiers) list.refuse(tr("at most 12 modifiers"));
  for (std::size_t i = 0; i < list.size(); ++i) {
    auto modifier = list[i];
    while (modifier.is(ValueKind::typed)) modifier = modifier.inner();
    if (modifier.is(ValueKind::reference))
      all.push_back(in_words(of_last(modifier.instance().record(0), 2, 0)));
    else
      all.push_back(in_words(modifier));
  }
  return all;
}

// Letters of the datums that could be read, by their instances: a letter is decoded once,
// however many refer to it.
using Letters = std::map<Id, std::string>;

const std::string& letter(const Instance& datum, const Letters& letters) {
  const auto found = letters.find(datum.id());
  if (found == letters.end())
    datum.record(0).refuse(tr("no datum"), tr("a datum with a letter"));
  return found->second;
}

// DATUM_REFERENCE_COMPARTMENT, DATUM_REFERENCE_ELEMENT: a base and modifiers come last.
Record general_reference(const Instance& reference) {
  for (const auto name : {"GENERAL_DATUM_REFERENCE", "DATUM_REFERENCE_COMPARTMENT",
                          "DATUM_REFERENCE_ELEMENT"})
    if (const auto r = reference.find(name); r && r->size() >= 2) return *r;
  reference.record(0).refuse(tr("no datum"), tr("a datum reference"));
}

void append_words(std::vector<std::string>& to, std::vector<std::string> more) {
  std::move(more.begin(), more.end(), std::back_inserter(to));
}

DatumReference compartment(const Instance& reference, const Letters& letters) {
  if (reference.is("DATUM")) return {{letter(reference, letters)}, {}};
  const auto r = general_reference(reference);
  DatumReference found{{}, datum_modifiers(of_last(r, 2, 1))};
  for (const auto& base : references(of_last(r, 2, 0), kMostDatums)) {
    if (base.is("DATUM")) {
      found.letters.push_back(letter(base, letters));
      continue;
    }
    const auto element = general_reference(base);
    for (const auto& datum : references(of_last(element, 2, 0), kMostDatums))
      found.letters.push_back(letter(datum, letters));
    append_words(found.modifiers, datum_modifiers(of_last(element, 2, 1)));
  }
  return found;
}

// The form of AP214: each datum with its rank, a modifier in a subtype.
std::pair<std::int64_t, DatumReference> ranked(const Instance& reference,
                                               const Letters& letters) {
  const auto modified = reference.find("REFERENCED_MODIFIED_DATUM");
  const bool whole = modified && modified->size() >= 3;
  const auto r = whole ? *modified : reference.as("DATUM_REFERENCE");
  DatumReference found{{letter(r[1].instance(), letters)}, {}};
  if (modified) found.modifiers.push_back(in_words(of_last(*modified, 1, 0)));
  return {r[0].integer(), found};
}

std::vector<DatumReference> datums(const Parameter& list, const Letters& known) {
  std::vector<DatumReference> all;
  std::vector<std::pair<std::int64_t, DatumReference>> old;
  for (const auto& reference : references(list, kMostDatums)) {
    if (const auto system = reference.find("DATUM_SYSTEM")) {
      for (const auto& part : references(of_last(*system, 1, 0), kMostDatums))
        all.push_back(compartment(part, known));
    } else if (reference.is("DATUM_REFERENCE") ||
               reference.is("REFERENCED_MODIFIED_DATUM")) {
      old.push_back(ranked(reference, known));
    } else {
      all.push_back(compartment(reference, known));
    }
  }
  std::stable_sort(old.begin(), old.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [rank, datum] : old) all.push_back(std::move(datum));
  std::size_t modifiers = 0, letters = 0;
  for (const auto& datum : all) {
    modifiers += datum.modifiers.size();
    letters += datum.letters.size();
  }
  if (modifiers > kMostModifiers || letters > kMostDatums)
    list.refuse(tr("at most 6 datums with 12 modifiers in all"));
  return all;
}

std::string length_text(const Parameter& measure) {
  return fmt::format("{} mm", length_mm(measure.instance()));
}

std::string per_unit(const Instance& tolerance) {
  const auto unit = tolerance.find("GEOMETRIC_TOLERANCE_WITH_DEFINED_UNIT");
  if (!unit) return "";
  auto text = say("per {}", length_text(of_last(*unit, 1, 0)));
  const auto area = tolerance.find("GEOMETRIC_TOLERANCE_WITH_DEFINED_AREA_UNIT");
  if (!area) return text;
  text += " " + in_words(of_last(*area, 2, 0));
  const auto second = of_last(*area, 2, 1);
  return second.absent() ? text : say("{} by {}", text, length_text(second));
}

std::vector<std::string> own_modifiers(const Instance& tolerance) {
  std::vector<std::string> all;
  if (const auto r = tolerance.find("GEOMETRIC_TOLERANCE_WITH_MODIFIERS")) {
    const auto list = of_last(*r, 1, 0);
    for (std::size_t i = 0; i < list.size(); ++i) all.push_back(in_words(list[i]));
  }
  if (const auto r = tolerance.find("MODIFIED_GEOMETRIC_TOLERANCE"))
    all.push_back(in_words(of_last(*r, 1, 0)));
  if (const auto r = tolerance.find("UNEQUALLY_DISPOSED_GEOMETRIC_TOLERANCE"))
    all.push_back(say("unequally disposed by {}", length_text(of_last(*r, 1, 0))));
  if (const auto r = tolerance.find("GEOMETRIC_TOLERANCE_WITH_MAXIMUM_TOLERANCE"))
    all.push_back(say("at most {}", length_text(of_last(*r, 1, 0))));
  if (auto unit = per_unit(tolerance); !unit.empty()) all.push_back(std::move(unit));
  return all;
}

void read_one_tolerance(const Instance& tolerance, const SymbolFacts& facts,
                        const Letters& letters, Features& features, Pmi& pmi) {
  const auto all = tolerance_frame(tolerance, facts.entity);
  GeometricTolerance found{.at = name_of(tolerance.id()),
                           .symbol = facts.symbol,
                           .name = all.record[0].text_or_empty()};
  if (const auto width = all.record[2]; !width.absent())
    found.width_mm = length_mm(width.instance());
  found.of = features.of(all.record[3].instance());
  if (all.datums) found.datums = datums(*all.datums, letters);
  found.modifiers = own_modifiers(tolerance);
  if (!found.of.extent.empty()) found.modifiers.push_back(found.of.extent);
  pmi.tolerances.push_back(std::move(found));
}

}  // namespace

const char* name(Symbol symbol) {
  return kSymbols[static_cast<std::size_t>(symbol)].name;
}

void read_tolerances(const Exchange& file, Features& features, Pmi& pmi) {
  std::vector<std::pair<Instance, const SymbolFacts*>> all;
  for (const auto& facts : kSymbols)
    for (const auto& tolerance : file.all(facts.entity))
      all.emplace_back(tolerance, &facts);
  std::sort(all.begin(), all.end());
  Letters letters;
  for (const auto& datum : pmi.datums)
    letters.emplace(std::stoull(datum.at.substr(1)), datum.letter);
  for (const auto& [tolerance, facts] : all)
    read_or_tell(tolerance, pmi.unread, [&, symbol = facts](const Instance& i) {
      read_one_tolerance(i, *symbol, letters, features, pmi);
    });
  read_zones(file, pmi);
}

}  // namespace turnwright::exchange
