#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "stack.hpp"

/// Contents of a plan's result in words and rounded numbers, which are the same for the
/// terminal and for the browser.
namespace turnwright::report {

/// The sentence of a member; its limit if it has no sentence.
std::string sentence_of(const nlohmann::ordered_json& member);
std::vector<std::string> sentences_of(const nlohmann::ordered_json& members);

/// The limits in conflict, each with its set if there are several.
std::vector<std::string> conflict_sentences(const nlohmann::ordered_json& result);

/// The relaxations that would make the part feasible, smallest first, up to twice the
/// limit also in percent.
std::vector<std::string> opening_sentences(const nlohmann::ordered_json& result);
/// A sentence where conflicts stay that no relaxation answers, else "".
std::string what_stays(const nlohmann::ordered_json& result);

/// Whether the members belong to more than one set.
bool several_sets(const nlohmann::ordered_json& members);

/// "total-radial-runout" as a drawing's reader says it, "total radial run-out".
std::string kind_words(std::string kind);

/// "4711-02, revision C, for Gear works", what the result has of it.
std::string title_block(const nlohmann::ordered_json& result);

/// A number of mm, or a pair, in um.
std::string micrometres(const nlohmann::ordered_json& tolerance, const char* key);

std::string verdict(const nlohmann::ordered_json& tolerance);

/// The verdict of the published equations, if it differs.
std::string other_verdict(const nlohmann::ordered_json& tolerance);

/// Whether the published equations judge any of the tolerances otherwise.
bool published_differ(const nlohmann::ordered_json& tolerances);

/// Percentage of the parts that keep a tolerance.
std::string kept_by(const nlohmann::ordered_json& tolerance);

/// Whether fewer parts keep some tolerance than are wanted.
bool keeps_too_few(const nlohmann::ordered_json& result);

/// What the limits of a feasible plan come to: kept, by what share of the parts the
/// tolerance that fewest of them keep.
std::string kept(const nlohmann::ordered_json& result);

/// money(), with the currency that the result names.
std::string money_of(const nlohmann::ordered_json& result, std::optional<double> value);

/// Preparing the machine, and what each part bears of it; empty if nothing is known.
std::string setting_up(const nlohmann::ordered_json& result);

/// The shares of the tolerance's width.
Stack stack_of(const nlohmann::ordered_json& tolerance);

/// Minutes and money of one kind, per part.
struct SpendingRow {
  std::string name;
  double time_min = 0, cost = 0;
};
/// Where time and cost per part go, what takes nothing left out; the last row is their
/// sum.  Empty where the result does not tell.
std::vector<SpendingRow> spending(const nlohmann::ordered_json& result);

/// ", 30 min of it to prepare the machine", where that takes anything.
std::string preparing(const nlohmann::ordered_json& result);

/// A value without the marks of JSON: "drift_um 1, tools (A, B)".
std::string value_text(const nlohmann::ordered_json& value);

}  // namespace turnwright::report
