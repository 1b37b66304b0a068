#pragma once
#include <nlohmann/json.hpp>
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

/// The relaxations that would make the part feasible, smallest first, in percent.
std::vector<std::string> opening_sentences(const nlohmann::ordered_json& result);

/// Whether the members belong to more than one set.
bool several_sets(const nlohmann::ordered_json& members);

/// A number of mm, or a pair, in um.
std::string micrometres(const nlohmann::ordered_json& tolerance, const char* key);

std::string verdict(const nlohmann::ordered_json& tolerance);

/// The verdict of the published equations, if it differs.
std::string other_verdict(const nlohmann::ordered_json& tolerance);

/// A sentence with the probability, unless it rounds to certainty.
std::string conformance(const nlohmann::ordered_json& tolerance);

/// The shares of the tolerance's width.
Stack stack_of(const nlohmann::ordered_json& tolerance);

/// A string without quotation marks, anything else as JSON.
std::string value_text(const nlohmann::ordered_json& value);

}  // namespace turnwright::report
