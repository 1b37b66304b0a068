#include "result_words.hpp"

#include <algorithm>

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

}  // namespace turnwright::report
