#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "turnwright/exchange/outline.hpp"

/// The geometry of an imported drawing as members of a part document.
namespace turnwright::document {

/// "cylinder", as the documents name it.
const char* shape_name(exchange::Shape shape);

/// "outer", "inner", "edges", "faces", "tolerances", "milling", and what the title block
/// says, as schemas/part.json wants them; empty lists are left out.
nlohmann::ordered_json part_members(const exchange::Outline& outline);

/// The outline of a part document that a reader has taken: what part_members() makes again.
exchange::Outline outline_of_part(const nlohmann::json& document);

/// A part document that a reader has taken as lines of text (exchange/notation.hpp).
std::string part_notation(const nlohmann::json& document);

}  // namespace turnwright::document
