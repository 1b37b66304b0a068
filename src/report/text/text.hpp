#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// Writers of results for people; they know the documents' keys and nothing of the
/// planner.
namespace turnwright::report {

/// The result document of `plan` (schemas/plan.result.json) as text for a planner to hand
/// to the shop: setups and conditions, tolerances, corrections, prices and assumptions,
/// or the limits in conflict and what would have to give.
///
/// Lines are at most 100 characters; setups are counted from 0, as in the document and
/// its sentences.  Numbers are rounded for reading, the document has them whole.  A key
/// that is missing shows as "-" or leaves its line out; a part's `name` and a setup's
/// `grip_mm` are shown where the document has them.
std::string text(const nlohmann::ordered_json& plan_result);

/// The result document of `chuck` (schemas/chuck.result.json): compliance, springs and
/// predictions with their standard errors, what a design cannot tell and which cut is
/// missing, the deviation graph's polynomial and steps.
std::string chuck_text(const nlohmann::ordered_json& chuck_result);

/// The result document of `thermal` (schemas/thermal.result.json): parameters with their
/// standing, errors on the rows fitted and held out, the network's beside them, and what
/// a shift does to a batch.
std::string thermal_text(const nlohmann::ordered_json& thermal_result);

/// The result document of `multipass` (schemas/multipass.result.json), of a single pass
/// too: cost with its bound, conditions, the limits that bind with their prices, every
/// number of passes; or the limits in conflict and how far each would have to open.
std::string multipass_text(const nlohmann::ordered_json& multipass_result);

/// The result document of `calibrate-material` (schemas/calibrate-material.result.json):
/// constants with their intervals, what was left out, warnings.
std::string material_text(const nlohmann::ordered_json& calibration_result);

}  // namespace turnwright::report
