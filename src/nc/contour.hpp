#pragma once
#include <optional>
#include <vector>

#include "site.hpp"

/// What is drawn beside a pass.
namespace turnwright::nc {

/// The finished line of an element with the plan's correction; of what is cut later its
/// blank.
std::vector<Point> corrected(const Site& site, const Side& side, const Surface& s);
/// The plan's correction of a surface, in the setup that finishes it; empty: none is
/// proposed.
const planning::Compensation::Table& correction(const Site& site,
                                                const std::string& surface);

const part::Cut& cut_of(const Site& site, const Surface& s);
/// The arc drawn on an element.
Arc drawn_arc(const Site& site, const Surface& s);

/// What is drawn from the free end to the beginning of element k; outside the axis is the
/// lowest.
std::vector<Piece> drawn_before(const Site& site, const Side& side, std::size_t k);
/// What is drawn behind element k: elements as far as they follow on each other, what is
/// left of the hole, or the jaws.
std::vector<Piece> drawn_behind(const Site& site, const Side& side, std::size_t k);
/// Nothing goes beyond a place.
Piece wall(double z_mm);

/// From where a tip comes level to the beginning of its way, if what is drawn before lets
/// it.
std::optional<Point> level(const Point& tip, const std::vector<Piece>& before,
                           double re_mm);

}  // namespace turnwright::nc
