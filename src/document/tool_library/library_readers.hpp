#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "document/json/reader.hpp"
#include "library_tool.hpp"
#include "zip_archive.hpp"

/// Readers of tool libraries, a format each.  A file that is not of the format is an error;
/// a tool that cannot be read, or is none for turning, is told among what is ignored, with
/// its place and the reason.
namespace turnwright::document {

/// The member of an object, not copied, for it may be large; null if there is none.
inline const nlohmann::json& member_of(const nlohmann::json& object, const char* key) {
  static const nlohmann::json kNothing;
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found == object.end() ? kNothing : *found;
}

/// A library of Autodesk Fusion, `{"data": [..]}`: the tools "turning general" and "turning
/// boring".  Every tool has its unit, and so may its holder.  INSD is the edge's length with
/// SIZE_SPECIFICATION_MODE "CE", and otherwise that or the inscribed circle.  Zeros are not
/// said.  Speeds of inch tools are in ft/min.
ToolLibrary read_fusion_library(const Reader& library);

/// Turning bits of FreeCAD (.fctb), by the name of each file.  EdgeLength is the diameter of
/// the inscribed circle, and Rotation the angle from the axis to the bisector of the corner,
/// as [LibLathe] uses them, so that
///
///     KAPR = 180 deg - Rotation - TipAngle/2.                                        (1)
///
/// Source: (1) derived here from `get_tool_cutting_angle` of [LibLathe].
struct NamedJson {
  std::string name;
  const nlohmann::json* value;
};
ToolLibrary read_freecad_bits(const std::vector<NamedJson>& bits);

/// The bits that libraries of FreeCAD (.fctl), `{"tools": [{"nr": 1, "path": "a.fctb"}]}`,
/// name, in their order and as "T1 Bit/a.fctb", then the others.  A path is the file's or its
/// end; bits that are named and not given are told among what is ignored.
ToolLibrary read_freecad_libraries(const std::vector<NamedJson>& libraries,
                                   const std::vector<NamedJson>& bits);

/// A table (document/json/csv.hpp) whose columns are symbols of ISO 13399 and `id`, `name`,
/// `type` (turning or boring), `unit`, `insert` (or MIID), `holder`, `grade groups`
/// (TMC1ISO).  Numbers have a decimal point or comma.
/// @param others  names of columns that are not read
ToolLibrary read_tool_table(const Reader& csv, const std::string& unit,
                            std::vector<std::string>& others);

/// Cutting tool assets of MTConnect, in a document or alone.
/// @param pointer  place of the XML in the request, for errors
ToolLibrary read_mtconnect(std::string_view xml, Problems& problems,
                           const std::string& pointer);

}  // namespace turnwright::document
