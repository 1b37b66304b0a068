#pragma once
#include "reach.hpp"
#include "turnwright/planning/prepared_part.hpp"

/// Assignment of surfaces to setups.
namespace turnwright::planning {

/// Gives every element to the first setup that can cut it: it lies outside the jaws and
/// nothing between it and the free end is larger than it.  An end face goes to the first
/// setup whose free end it is, if the stock leaves material there; a shoulder to the
/// setup of its smaller element, if a face, tolerance or roughness of the drawing names
/// it.  A bore goes to the first setup whose free end it opens to, if nothing before it
/// is narrower.
/// Given operations decide the setup; a surface that none of them makes is unreachable.
/// Needs `grips_mm` of the part.
/// @throws Cancelled if a stop was requested.
Assignment assign(const PreparedPart& part);
/// The same with the ways of that part, which its grips do not change.
Assignment assign(const PreparedPart& part, const Ways& ways);
/// How many surfaces no setup can cut: of `unreachable`.
std::size_t left_out(const PreparedPart& part, const Ways& ways);

}  // namespace turnwright::planning
