#pragma once
#include <optional>
#include <string>
#include <vector>

#include "turnwright/planning/setup_geometry.hpp"

/// Where places are milled, and with what.
namespace turnwright::planning {

/// Why a place cannot be milled in a setup held so: its element is not turned before, or
/// jaws or a steady rest stand on it.  Empty if it can.
std::string milled_obstacle(const PreparedPart& part, const Milled& place,
                            std::size_t setup, Clamping clamping);

/// The first setup in which some clamping leaves the place free, if any does.
std::optional<std::size_t> milled_setup(const PreparedPart& part, const Milled& place);

/// A later setup whose jaws close on the place, if any.
std::optional<std::size_t> gripped_later(const PreparedPart& part,
                                         const MilledPlace& place);

/// Share of its stiffness in bending, the softest way, that the section keeps where a
/// place is, with the places beside it.  Later cuts do not count what is lost.
double stiffness_kept(const PlanRequest& request, const Milled& place);

/// Largest radial step of a lane over the cutter's diameter, in a flat.
inline constexpr double kLaneStep = 0.7;

/// The cutters that fit and their lanes, with limits of stability of their own:
///
///     keyway, slot:  D <= w <= 2 D, one lane of ae = D; if D < w both sides after it,
///                    down-milled, ae = (w - D)/2                                   (1)
///     flat:          lanes of equal ae <= kLaneStep D across the chord, down-milled;
///                    also twice as many                                           (2)
///
/// A cutter fits if it has conditions for the material, reaches the floor, has no larger
/// corner than the place allows, is shorter across than a closed place is long, and cuts
/// over its centre where it must plunge, and its tool point yields across the feed, as
/// the part does.  Tool points are those measured on the machine, else the cutter's.
///
/// Kn/Kt changes with the feed where the material's mf is not its mc.  The feeds are then
/// split into ways over each of which it changes by kRatioStep at most, their lobes the
/// least of those at both ends.
std::vector<MilledWay> milled_ways(const PreparedPart& plan, const Milled& place);

inline constexpr double kRatioStep = 0.05;

/// Why a cutter does not fit; empty if it does.
std::string does_not_fit(const PreparedPart& plan, const Milled& place,
                         const catalogue::MillingCutter& cutter);

/// The tool point of a cutter on the plan's machine.
const std::vector<catalogue::TipMode>& tip_modes(const PreparedPart& plan,
                                                 const catalogue::MillingCutter& cutter);

}  // namespace turnwright::planning
