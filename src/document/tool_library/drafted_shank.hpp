#pragma once
#include <nlohmann/json.hpp>

#include "drafted_insert.hpp"

/// What carries the insert, as groups of a tool's document.
namespace turnwright::document {

/// "bar" of a boring tool: shank, overhang and smallest bore.  A bar's designation wins over
/// the library's shank.
/// @throws std::domain_error saying what is missing.
nlohmann::ordered_json drafted_bar(const DraftSource& from, const DraftedInsert& insert);

/// "holder" of an external tool: the printed one if the library's sizes agree with it, else
/// one that is named by its letters and sizes; null if there is none of both with all
/// sizes.
nlohmann::ordered_json drafted_holder(const DraftSource& from,
                                      const DraftedInsert& insert);

}  // namespace turnwright::document
