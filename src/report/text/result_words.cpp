#include "result_words.hpp"

#include <algorithm>
#include <string_view>

#include "base/say.hpp"

namespace turnwright::report {
namespace {

constexpr const char* kWords[] = {
    // kinds of tolerance, as documents have them and as kind_words() says them
    to_translate("diameter"), to_translate("length"), to_translate("straightness"),
    to_translate("circularity"), to_translate("flatness"), to_translate("cylindricity"),
    to_translate("profile"), to_translate("profile-without-datum"),
    to_translate("profile without datum"), to_translate("parallelism"),
    to_translate("perpendicularity"), to_translate("angularity"),
    to_translate("position"), to_translate("coaxiality"),
    to_translate("circular-radial-runout"), to_translate("circular radial run-out"),
    to_translate("circular-axial-runout"), to_translate("circular axial run-out"),
    to_translate("total-radial-runout"), to_translate("total radial run-out"),
    to_translate("total-axial-runout"), to_translate("total axial run-out"),
    // verdicts and states
    to_translate("met"), to_translate("met-with-offset"), to_translate("not-met"),
    to_translate("infeasible"), to_translate("unsettled"), to_translate("optimal"),
    to_translate("local"), to_translate("none"), to_translate("at-lower-bound"),
    to_translate("at-upper-bound"), to_translate("given"),
    // clampings and jaws
    to_translate("chuck"), to_translate("chuck-tailstock"),
    to_translate("between-centres"), to_translate("chuck-steady"),
    to_translate("tailstock-follow"), to_translate("hard"), to_translate("soft"),
    to_translate("collet"), to_translate("hard_jaws"), to_translate("soft_jaws"),
    to_translate("centres"),
    // kinds of operation
    to_translate("face"), to_translate("rough"), to_translate("finish"),
    to_translate("bore-rough"), to_translate("bore-finish"), to_translate("fixed"),
    to_translate("mill"), to_translate("cross-drill"),
    // sources of a budget and factors of models
    to_translate("deflection"), to_translate("machine"), to_translate("forces"),
    to_translate("jaw-squeeze"), to_translate("chain"), to_translate("drift"),
    to_translate("repeatability"), to_translate("wear"), to_translate("life"),
    to_translate("heat"), to_translate("rechucking"), to_translate("measurement"),
    to_translate("passive force"), to_translate("compliance"),
    // limits
    to_translate("power"), to_translate("torque"), to_translate("feed force"),
    to_translate("cutting force"), to_translate("grip of the chuck"),
    to_translate("chatter stiffness"), to_translate("roughness Ra"),
    to_translate("roughness Rz"), to_translate("least depth of cut"),
    to_translate("largest depth of cut"), to_translate("depth of cut"),
    to_translate("least feed"), to_translate("largest feed"),
    to_translate("least feed of the chip breaker"),
    to_translate("largest feed of the chip breaker"), to_translate("feed speed"),
    to_translate("least cutting speed"), to_translate("largest cutting speed"),
    to_translate("cutting speed"), to_translate("least spindle speed"),
    to_translate("largest spindle speed"), to_translate("spindle speed"),
    to_translate("spindle speed that leaves a third of the grip"),
    to_translate("least tool life"), to_translate("longest tool life"),
    to_translate("stable depth with its margin"), to_translate("compliance of the part"),
    to_translate("chip thickness"), to_translate("least chip thickness"),
    // effects in a ball-bar test
    to_translate("centre offset"), to_translate("mean scale"),
    to_translate("scale mismatch"), to_translate("squareness"),
    to_translate("straightness v of u"), to_translate("straightness u of v"),
    to_translate("backlash u"), to_translate("backlash v"),
    to_translate("lateral play v of u"), to_translate("lateral play u of v"),
    to_translate("servo mismatch")};

}  // namespace

std::string spoken(const std::string& word) {
  const bool known = std::ranges::find(kWords, word) != std::end(kWords);
  return known ? tr(word) : word;
}

std::string spoken_limit(const std::string& name) {
  constexpr std::string_view kCost = "cost ";
  if (name.starts_with(kCost)) return say("cost {}", name.substr(kCost.size()));
  const auto kind = name.rfind(' ') + 1;
  const auto whole = spoken(name);
  return whole != name || kind == 0 ? whole
                                    : name.substr(0, kind) + spoken(name.substr(kind));
}

}  // namespace turnwright::report
