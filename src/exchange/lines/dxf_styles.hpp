#pragma once
#include <vector>

#include "dxf_file.hpp"
#include "turnwright/exchange/outline.hpp"

namespace turnwright::exchange::dxf {

/// Names the styles of dimensions that add limits or a text, which are not read, under
/// `ignored`.
/// @throws InputError if a dimension shows a multiple of what is drawn (DIMLFAC): the part
///         is drawn at a scale.
void check_styles(const File& file, std::vector<Remark>& ignored);

}  // namespace turnwright::exchange::dxf
