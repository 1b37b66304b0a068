#pragma once
#include "turnwright/planning/prepared_part.hpp"

/// Positions of a setup along the part: where its jaws end, and the ends of the part.
namespace turnwright::planning {

/// Whether the jaws, or the headstock's centre, hold the part's left end.
bool holds_left(const PlanRequest& request, std::size_t setup);
/// "left" or "right": the end that a setup leaves free.
const char* free_face(const PreparedPart& part, std::size_t setup);

/// z at which the jaws end.  The first setup grips stock, the later ones the part.
double jaws_z_mm(const PreparedPart& part, std::size_t setup);
/// z of the front of the jaws in part coordinates; between centres, of the end at the
/// headstock.
double root_z_mm(const PreparedPart& part, std::size_t setup, Clamping clamping);
/// z of the free end once this setup has faced it.
double free_z_mm(const PreparedPart& part, std::size_t setup);
/// Largest diameter [mm] of the stock before the free end of a setup.
double end_stock_mm(const PreparedPart& part, std::size_t setup);

/// Material [mm] before the finished face of an end once it is free: the parting-off
/// allowance at the end that the first setup holds, else the stock's allowance.
double face_stock_mm(const PreparedPart& part, part::End end);
/// True if an operation of this plan makes the face (its end has stock, or it is a
/// shoulder).
bool face_is_cut(const PreparedPart& plan, const std::string& face);

/// Whether a profiling tool that comes from the end a setup leaves free clears an outer
/// element: false only for arcs that fall more than `part::kProfilingClears_rad`.
bool cleared(const PreparedPart& part, std::size_t setup, std::size_t element);

/// Bores nearer to each other than this [mm] are one through hole; no thinner wall is
/// left standing.
inline constexpr double kNoWall_mm = 0.01;

/// Width of a steady rest along the axis [mm]; the surface below it is not cut.
inline constexpr double kSteadyWidth_mm = 20;

}  // namespace turnwright::planning
