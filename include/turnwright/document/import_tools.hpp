#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>

namespace turnwright::document {

/// The largest tool library that is read, and what an archive may unpack to [bytes].
inline constexpr std::size_t kLargestLibrary = 20'000'000;

/// The result of `import-tools` (schemas/import-tools.result.json): documents of turning
/// tools (schemas/tool.json) and of taps, reamers and countersinks (schemas/fixed-tool.json)
/// made from a tool library of another program, what they assume, where the library
/// contradicts itself, and what of it was ignored.
///
/// The library, given as `text` or in `base64`, is a library of Autodesk Fusion (.json,
/// .tools), a table with symbols of ISO 13399 (.csv), cutting tool assets of MTConnect
/// (.xml) or bits of FreeCAD (.fctb, or a zip archive of them).  Every document is one that
/// the catalogue's reader accepts.
/// @throws InputError with all problems; those of the library stand at "/text" (or
///   "/base64"), their place in the file before what was found there.
nlohmann::ordered_json import_tools(const nlohmann::json& request);

}  // namespace turnwright::document
