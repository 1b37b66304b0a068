#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "stack.hpp"

/// What a plan's result says, in words and rounded numbers; the report for a terminal and
/// the one for a browser say the same.
namespace turnwright::report {

/// The member's sentence; its limit where it has none.
std::string sentence_of(const nlohmann::ordered_json& member);
std::vector<std::string> sentences_of(const nlohmann::ordered_json& members);

/// Limits in conflict, each with its set where there are several.
std::vector<std::string> conflict_sentences(const nlohmann::ordered_json& result);

/// What would have to give, the smallest opening first, with its size in percent.
std::vector<std::string> opening_sentences(const nlohmann::ordered_json& result);

/// Whether the members belong to more than one set.
bool several_sets(const nlohmann::ordered_json& members);

/// A number of mm, or a pair, in um.
std::string micrometres(const nlohmann::ordered_json& tolerance, const char* key);

std::string verdict(const nlohmann::ordered_json& tolerance);

/// The published equations' verdict, where it is another.
std::string other_verdict(const nlohmann::ordered_json& tolerance);

/// A sentence, where the probability does not round to certainty.
std::string conformance(const nlohmann::ordered_json& tolerance);

/// What takes the tolerance's width.
Stack stack_of(const nlohmann::ordered_json& tolerance);

/// Minutes and money of one kind, per part.
struct SpendingRow {
  std::string name;
  double time_min = 0, cost = 0;
};
/// Where time and cost per part go, what takes nothing left out; the last row is their
/// sum.  Empty where the result does not tell.
std::vector<SpendingRow> spending(const nlohmann::ordered_json& result);

/// ", 30.000 of them to prepare the machine", where that takes anything.
std::string preparing(const nlohmann::ordered_json& result);

/// A string bare, anything else as JSON.
std::string value_text(const nlohmann::ordered_json& value);

}  // namespace turnwright::report
