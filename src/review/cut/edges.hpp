#pragma once
#include "section.hpp"
#include "turnwright/catalogue/tool_outline.hpp"

/// What cuts of a tool, as convex polygons in the tool's coordinates: x out of the material
/// into the air, z towards the free end, the origin in the programmed point.
namespace turnwright::review {

Polygon polygon_of(const catalogue::ConvexOutline& outline);
Polygon rectangle(double x0, double x1, double z0, double z1);
/// An insert: chords of the corner that cuts are within 1e-5 mm, of the others 1e-3 mm.
Polygon insert_edge(const catalogue::ToolOutline& outline);
/// The edges of a profiling tool, whose insert's width is in no document: the minor edge at
/// the angle that it is taken to clear, the major edge at 93 deg.
Polygon profiling_edge(double re_mm);
/// A tool on the axis of any length that grows to its diameter over `point_mm`: a drill, its
/// point in the origin, or a reamer, the end of its lead there.
Polygon pointed_edge(double D_mm, double point_mm);
/// The tooth of a threading tool of a pitch; the insert beside it is in no document.
Polygon thread_edge(double pitch_mm);

}  // namespace turnwright::review
