#include "turnwright/part/tolerance_kind.hpp"

#include "turnwright/base/language.hpp"

namespace turnwright::part {
namespace {

using K = ToleranceKind;
using Of = Toleranced;
using Datum = DatumFeature;
using Rule = ToleranceRule;

// A switch, so that a kind without a row does not compile.
constexpr ToleranceFacts row(ToleranceKind kind) {
  switch (kind) {
    case K::diameter:
      return {kind, to_translate("diameter"), Of::element, Datum::none, Rule::size};
    case K::length:
      return {kind, to_translate("length"), Of::two_faces, Datum::none, Rule::size};
    case K::straightness:
      return {kind, to_translate("straightness"), Of::element, Datum::none,
              Rule::straightness};
    case K::circularity:
      return {.kind = kind,
              .name = to_translate("circularity"),
              .of = Of::element,
              .rule = Rule::machine,
              .sees_lobes = true};
    case K::flatness:
      return {kind, to_translate("flatness"), Of::face, Datum::none, Rule::range};
    case K::cylindricity:
      return {.kind = kind,
              .name = to_translate("cylindricity"),
              .of = Of::cylinder,
              .rule = Rule::range,
              .sees_lobes = true};
    case K::profile:
      return {.kind = kind,
              .name = to_translate("profile"),
              .of = Of::element,
              .datum = Datum::element_or_face,
              .rule = Rule::profile,
              .sees_lobes = true,
              .rechucked = Rechucked::displaced};
    case K::profile_without_datum:
      return {.kind = kind,
              .name = to_translate("profile-without-datum"),
              .of = Of::element,
              .rule = Rule::floating_profile,
              .sees_lobes = true};
    case K::parallelism:
      return {.kind = kind,
              .name = to_translate("parallelism"),
              .of = Of::face,
              .datum = Datum::face,
              .rule = Rule::range,
              .rechucked = Rechucked::tilted};
    case K::perpendicularity:
      return {.kind = kind,
              .name = to_translate("perpendicularity"),
              .datum = Datum::other,
              .rule = Rule::range,
              .axis_rule = Rule::machine,
              .rechucked = Rechucked::tilted};
    case K::angularity:
      return {.kind = kind,
              .name = to_translate("angularity"),
              .datum = Datum::element_or_face,
              .rule = Rule::machine,
              .rechucked = Rechucked::tilted};
    case K::position:
      return {.kind = kind,
              .name = to_translate("position"),
              .of = Of::element,
              .datum = Datum::element_or_face,
              .rule = Rule::machine,
              .rechucked = Rechucked::run_out};
    case K::coaxiality:
      return {.kind = kind,
              .name = to_translate("coaxiality"),
              .of = Of::element,
              .datum = Datum::element,
              .rule = Rule::machine,
              .rechucked = Rechucked::run_out};
    case K::circular_radial_runout:
      return {.kind = kind,
              .name = to_translate("circular-radial-runout"),
              .of = Of::element,
              .datum = Datum::element,
              .rule = Rule::machine,
              .sees_lobes = true,
              .rechucked = Rechucked::run_out};
    case K::circular_axial_runout:
      return {.kind = kind,
              .name = to_translate("circular-axial-runout"),
              .of = Of::face,
              .datum = Datum::element,
              .rule = Rule::machine,
              .rechucked = Rechucked::tilted};
    case K::total_radial_runout:
      return {.kind = kind,
              .name = to_translate("total-radial-runout"),
              .of = Of::cylinder,
              .datum = Datum::element,
              .rule = Rule::runout,
              .sees_lobes = true,
              .rechucked = Rechucked::run_out};
    case K::total_axial_runout:
      return {.kind = kind,
              .name = to_translate("total-axial-runout"),
              .of = Of::face,
              .datum = Datum::element,
              .rule = Rule::runout,
              .rechucked = Rechucked::tilted};
  }
  return {};
}

std::vector<ToleranceFacts> rows() {
  std::vector<ToleranceFacts> all;
  for (int k = 0; row(static_cast<K>(k)).name; ++k) all.push_back(row(static_cast<K>(k)));
  return all;
}

}  // namespace

const std::vector<ToleranceFacts>& tolerance_kinds() {
  static const auto kAll = rows();
  return kAll;
}

const ToleranceFacts& facts(ToleranceKind kind) {
  return tolerance_kinds()[static_cast<std::size_t>(kind)];
}

const char* name(ToleranceKind kind) { return facts(kind).name; }

bool has_two_ends(ToleranceKind kind) {
  const auto rule = facts(kind).rule;
  return rule == Rule::size || rule == Rule::profile;
}

}  // namespace turnwright::part
