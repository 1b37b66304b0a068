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

const std::optional<part::Cut>& cut_of(const Site& site, const Surface& s);
/// The arc drawn on an element.
Arc drawn_arc(const Site& site, const Surface& s);

/// What is drawn from the free end to the beginning of element k; outside the axis is the
/// lowest.
std::vector<Piece> drawn_before(const Site& site, const Side& side, std::size_t k);
/// The last of the elements that follow on each other from element k; between bores from
/// both ends is a gap.
std::size_t end_of_run(const Side& side, std::size_t k);
/// Whether the hole goes on behind bores that end at a place and a height.
bool hole_goes_on(const Site& site, const Side& side, double z_mm, double h_mm);
/// What is drawn behind element k: elements as far as they follow on each other, and what
/// is left of the hole.
std::vector<Piece> drawn_behind(const Site& site, const Side& side, std::size_t k);
/// Nothing goes beyond a place.
Piece wall(double z_mm);
/// Tells in `site.cannot` if the jaws keep a tip from going as far as the end of element k
/// needs, and no other setup takes off what is left there.
void tell_jaws(Site& site, std::size_t k, const std::string& operation,
               double needed_z_mm);

/// Whether a tool comes down to the beginning of a way and goes along it, past what is
/// drawn.
bool comes_in(const std::vector<Point>& way, const std::vector<Piece>& pieces,
              const Corner& corner);

}  // namespace turnwright::nc
