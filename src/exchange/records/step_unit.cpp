#include "step_unit.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "turnwright/base/language.hpp"

namespace turnwright::exchange {
namespace {

constexpr int kMostConversions = 16;  // more is a cycle, or a joke

double si_prefix(const Parameter& prefix) {
  if (prefix.absent()) return 1;
  static constexpr std::array<std::pair<std::string_view, double>, 16> kPrefixes{
      {{"EXA", 1e18},
       {"PETA", 1e15},
       {"TERA", 1e12},
       {"GIGA", 1e9},
       {"MEGA", 1e6},
       {"KILO", 1e3},
       {"HECTO", 1e2},
       {"DECA", 1e1},
       {"DECI", 1e-1},
       {"CENTI", 1e-2},
       {"MILLI", 1e-3},
       {"MICRO", 1e-6},
       {"NANO", 1e-9},
       {"PICO", 1e-12},
       {"FEMTO", 1e-15},
       {"ATTO", 1e-18}}};
  for (const auto& [word, factor] : kPrefixes)
    if (prefix.word() == word) return factor;
  prefix.refuse(tr("a prefix of the SI such as .MILLI."));
}

// SI_UNIT has prefix and name last, whether it stands alone or is part of a complex one.
std::optional<Unit> si_unit(const Record& si) {
  if (si.size() < 2) si.refuse(tr("fewer than 2 parameters"), tr("a prefix and a name"));
  const auto name = si[si.size() - 1].word();
  const double prefix = si_prefix(si[si.size() - 2]);
  constexpr double kMm = 1000;
  if (name == "METRE") return Unit{Quantity::length, kMm * prefix};
  if (name == "RADIAN") return Unit{Quantity::angle, prefix};
  return std::nullopt;
}

struct Parts {
  Parameter value, unit;
};

std::optional<Parts> parts(const Instance& measure) {
  for (const auto name :
       {"MEASURE_WITH_UNIT", "LENGTH_MEASURE_WITH_UNIT", "PLANE_ANGLE_MEASURE_WITH_UNIT"})
    if (const auto r = measure.find(name); r && r->size() >= 2)
      return Parts{(*r)[0], (*r)[1]};
  if (const auto r = measure.find("MEASURE_REPRESENTATION_ITEM"); r && r->size() >= 3)
    return Parts{(*r)[1], (*r)[2]};
  return std::nullopt;
}

}  // namespace

std::optional<Unit> step_unit(const Instance& unit) {
  double size = 1;
  auto at = unit;
  for (int conversions = 0; conversions < kMostConversions; ++conversions) {
    if (const auto si = at.find("SI_UNIT")) {
      auto found = si_unit(*si);
      if (found) found->size *= size;
      return found;
    }
    const auto conversion = at.find("CONVERSION_BASED_UNIT");
    if (!conversion) return std::nullopt;
    const auto factor = (*conversion)[conversion->size() - 1];
    const auto measured = parts(factor.instance());
    if (!measured) factor.refuse(tr("a measure with unit"));
    size *= measured->value.measure();
    if (!(size > 0)) measured->value.refuse(tr("a factor > 0"));
    at = measured->unit.instance();
  }
  unit.record(0).refuse(tr("a unit that is defined by itself"),
                        tr("a unit of the SI in the end"));
}

std::optional<Measure> step_measure(const Instance& measure) {
  const auto found = parts(measure);
  if (!found || found->unit.absent()) return std::nullopt;
  const auto unit = step_unit(found->unit.instance());
  if (!unit) return std::nullopt;
  return Measure{unit->quantity, found->value.measure() * unit->size};
}

std::string measure_name(const Instance& measure) {
  for (const auto name : {"REPRESENTATION_ITEM", "MEASURE_REPRESENTATION_ITEM"})
    if (const auto r = measure.find(name); r && r->size() >= 1)
      return (*r)[0].short_text().value_or("");
  return "";
}

}  // namespace turnwright::exchange
