#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "turnwright/document/catalogue.hpp"

namespace turnwright::document {

/// The largest drawing that is read [bytes].
inline constexpr std::size_t kLargestDrawing = 512'000'000;

/// The result of `import` (schemas/import.result.json): the part document that a foreign
/// drawing becomes, ready for `plan`, with what was assumed and what was ignored.
///
/// The drawing is a STEP file (ISO 10303-21), a DXF file or lines of text, given as `text`
/// or in `base64`.  Stock that the request does not give is the next round bar; the material
/// is the request's, or the one of the catalogue that the drawing names.
/// @throws InputError with all problems; those of the drawing stand at "/text" (or
///   "/base64"), their place in the file before what was found there.
nlohmann::ordered_json import(const nlohmann::json& request, const Catalogue& catalogue);

/// A request with the bytes of a drawing: as `text` if they are UTF-8, else in `base64`.
nlohmann::json import_request(std::string bytes);

}  // namespace turnwright::document
