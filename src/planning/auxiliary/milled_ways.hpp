#pragma once
#include <optional>
#include <string>
#include <vector>

#include "turnwright/planning/prepared_part.hpp"

/// The setups in which keyways, slots and flats are milled, and the cutters that fit.
namespace turnwright::planning {

/// The reason why a place cannot be milled in a setup and clamping: its element is not
/// turned before, or jaws or a steady rest stand on it.  Empty if it can be milled.
std::string milled_obstacle(const PreparedPart& part, const Milled& place,
                            std::size_t setup, Clamping clamping);

/// The first setup in which some clamping leaves the place free, if any does.
std::optional<std::size_t> milled_setup(const PreparedPart& part, const Milled& place);

/// A later setup whose jaws close on the place, if any.
std::optional<std::size_t> gripped_later(const PreparedPart& part,
                                         const MilledPlace& place);

/// Remaining share of the section's bending stiffness in its softest direction at a
/// milled place, with the places beside it but for cross holes, which are short along the
/// part.  The loss is not counted in later cuts.
double stiffness_kept(const PlanRequest& request, const Milled& place);

/// Largest radial step of a lane over the cutter's diameter, in a flat.
inline constexpr double kLaneStep = 0.7;

/// The cutters that fit with their lanes, and the limits of stability of each:
///
///     keyway, slot:  D <= w <= 2 D, one lane of ae = D; if D < w both sides after it,
///                    down-milled, ae = (w - D)/2                                   (1)
///     flat:          lanes of equal ae <= kLaneStep D across the chord, down-milled;
///                    also twice as many                                           (2)
///
/// A cutter fits if it has conditions for the material, reaches the floor, has no larger
/// corner than the place allows, is not wider than a closed place is long, cuts over its
/// centre if it must plunge, and if its tool point has a compliance across the feed.
/// Tool points are those measured on the machine, otherwise those of the cutter's
/// document.
///
/// Kn/Kt changes with the feed if the material's mf differs from its mc.  The feeds are
/// then split into ranges over which the ratio changes by kRatioStep at most; the
/// stability of each range is the lesser one of its two ends.
std::vector<MilledWay> milled_ways(const PreparedPart& plan, const Milled& place);

inline constexpr double kRatioStep = 0.05;

/// The reason why a cutter does not fit; empty if it fits.
std::string does_not_fit(const PreparedPart& plan, const Milled& place,
                         const catalogue::MillingCutter& cutter);

/// The tool point of a cutter on the plan's machine.
const std::vector<catalogue::TipMode>& tip_modes(const PreparedPart& plan,
                                                 const catalogue::MillingCutter& cutter);

}  // namespace turnwright::planning
