#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "../test_catalogue.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/document/part_plan.hpp"
#include "turnwright/document/prepared_part.hpp"

namespace turnwright::document {

/// What is wrong with a part's document, or "accepted".
inline std::string refusal_of(const nlohmann::json& document) {
  try {
    load_part_plan(document, test_catalogue(), "t");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// The problems of a part's document, a line each without its name; "" if it is accepted.
inline std::string problems_of(const nlohmann::json& document, const Catalogue& catalogue,
                               Purpose purpose = Purpose::plan) {
  std::string text;
  try {
    prepared_part(document, catalogue, "t", purpose);
  } catch (const InputError& error) {
    for (const auto& p : error.problems())
      text += p.pointer + ": got " + p.got + ", expected " + p.expected + "\n";
  }
  return text;
}

}  // namespace turnwright::document
