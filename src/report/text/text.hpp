#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// Writers of text reports.  They know the keys of the documents and nothing of the
/// planner.
namespace turnwright::report {

/// The result document of `plan` (schemas/plan.result.json) as text for the shop: setups
/// and conditions, tolerances, corrections, prices and assumptions, or the limits in
/// conflict with their relaxations.
///
/// Lines have at most 100 characters.  Setups count from 1, in the document from 0.
/// Numbers are rounded for reading; the document has all their digits.  A
/// missing key is shown as "-", or its line is omitted; a part's `name` and a setup's
/// `grip_mm` are shown if the document has them.
std::string text(const nlohmann::ordered_json& plan_result);

/// The result document of `chuck` (schemas/chuck.result.json): compliance, springs and
/// predictions with their standard errors, directions that a set of cuts does not
/// determine with the missing cut, and the deviation graph's polynomial and steps.
std::string chuck_text(const nlohmann::ordered_json& chuck_result);

/// The result document of `thermal` (schemas/thermal.result.json): parameters with their
/// status, errors on the rows fitted and held out, those of the network, and the drift
/// over a shift and a batch.
std::string thermal_text(const nlohmann::ordered_json& thermal_result);

/// The result document of `multipass` (schemas/multipass.result.json), also of a single
/// pass: cost with its bound, conditions, binding limits with their prices, every number
/// of passes; or the limits in conflict with their relaxations.
std::string multipass_text(const nlohmann::ordered_json& multipass_result);

/// The result document of `quote` (schemas/quote.result.json): what one part costs in each
/// batch and of what, by which way it is made, what cannot be made and why.
std::string quote_text(const nlohmann::ordered_json& quote_result);

/// The result document of `calibrate-material` (schemas/calibrate-material.result.json):
/// constants with their intervals, omitted cuts, warnings.
std::string material_text(const nlohmann::ordered_json& calibration_result);

/// The result document of `learn` (schemas/learn.result.json): each characteristic with its
/// intervals and advice, what was left out and why.
std::string learn_text(const nlohmann::ordered_json& learn_result);

/// The result document of `stability` (schemas/stability.result.json): the best cut, each
/// requested cut with its margin or its chatter and the nearest cure, limits of at most 24
/// of the speeds, modes of measured responses, what is undecided.
std::string stability_text(const nlohmann::ordered_json& stability_result);

/// The result document of `overhang` (schemas/overhang.result.json): the least limit and the
/// best cut with each overhang, requested cuts, the modes at the tip.
std::string overhang_text(const nlohmann::ordered_json& overhang_result);

/// The result document of `listen` (schemas/listen.result.json): whether the cut chatters, at
/// which frequency, speeds without it, the lines of the sound.
std::string listen_text(const nlohmann::ordered_json& listen_result);

/// The result document of `positioning` (schemas/positioning.result.json): accuracy,
/// repeatability, systematic deviation and reversal of the axis, the values of each position,
/// what the test lacks.
std::string positioning_text(const nlohmann::ordered_json& positioning_result);

/// The result document of `review` (schemas/review.result.json): the cuts of each program
/// with the limits that they do not keep, what is not known, sizes, and what a plan saves.
std::string review_text(const nlohmann::ordered_json& review_result);

}  // namespace turnwright::report
