#pragma once
#include "part_sections.hpp"

/// Cross holes of a part document's `milling`.
namespace turnwright::document {

/// Reads what a cross hole has of its own into a place on the outer element `on`, which is
/// null where that could not be read: the middle and the diameter, how deep it goes or
/// through what, its limits, drill and conditions.  Limits that no drill keeps are refused.
void read_cross_hole(Draft& draft, Reader& r, const part::OuterElement* on,
                     planning::Milled& hole);

/// Checks that a cross hole lies on its element, is narrower than that, and ends or opens
/// where it says, and sets the depth of one that goes through.
void check_cross_hole(const part::Drawing& drawing, Reader& r, planning::Milled& hole);

}  // namespace turnwright::document
