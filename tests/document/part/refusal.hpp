#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "../test_catalogue.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/document/part_plan.hpp"

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

}  // namespace turnwright::document
