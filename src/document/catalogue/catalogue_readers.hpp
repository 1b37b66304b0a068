#pragma once
#include "document/json/reader.hpp"
#include "turnwright/catalogue/fixed_tool.hpp"
#include "turnwright/catalogue/machine.hpp"
#include "turnwright/catalogue/material.hpp"
#include "turnwright/catalogue/milling_cutter.hpp"
#include "turnwright/catalogue/tool.hpp"

/// Readers of the catalogue's documents, one document each; errors are added to the
/// reader's problems.
namespace turnwright::document {

catalogue::Material read_material(Reader document);
catalogue::Tool read_tool(Reader document);
catalogue::FixedTool read_fixed_tool(Reader document);
catalogue::MillingCutter read_milling_cutter(Reader document);
catalogue::Lathe read_lathe(Reader document);

}  // namespace turnwright::document
