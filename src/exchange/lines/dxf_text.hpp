#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "turnwright/exchange/outline.hpp"

/// Texts of a DXF drawing.
namespace turnwright::exchange::dxf {

/// The text if it is UTF-8, else what its bytes are in ISO 8859-1: files before AutoCAD 2007
/// are written in a code page, and the signs of dimensions are the same in western ones.
std::string in_utf8(std::string_view text);

/// A text as it is shown, in UTF-8: without formats, %%c and \U+2205 as their characters
/// (Ø for every sign of a diameter), a stacked tolerance \S+0.02^-0.01; as " +0.02/-0.01".
std::string shown_text(std::string_view text);

/// What the text of a dimension says, in the units of the drawing; threads in mm.
struct Said {
  std::optional<double> size;  ///< nothing where the measured value stands, "<>"
  bool diameter = false, thread = false;
  double pitch = 0;
  Demands demands = {};
};

/// "Ø50 k6", "<> h7", "M24x1.5 6g", "1/2-13 UNC-2A", "50 +0.02/-0.01 Ra 1.6"; nothing if there are other
/// words.
std::optional<Said> said(const std::string& shown);

}  // namespace turnwright::exchange::dxf
