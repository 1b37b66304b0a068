#pragma once
#include <optional>

#include "planning/clamping/made_surfaces.hpp"

/// The edges of the drawing as the tools of a setup meet them.  A chamfer is cut in a setup
/// in which it faces the free end.
namespace turnwright::planning {

/// The end of the part that a setup leaves free.
part::End free_end(const PreparedPart& plan, std::size_t setup);

/// z of an end of an element.
double end_z_mm(const part::Drawing& drawing, const Element& element, part::End end);

/// The element that meets an end of another; none at a face of the part.
std::optional<Element> neighbour(const part::Drawing& drawing, const Element& element,
                                 part::End end);

/// The chamfer of an element at one of its ends.
const std::optional<part::Chamfer>& chamfer_at(const part::Drawing& drawing,
                                               const Element& element, part::End end);

/// A chamfer if turning cuts it, not a grooving blade.
std::optional<part::Chamfer> turned(const std::optional<part::Chamfer>& chamfer);

/// The chamfer of an element at its end towards the free end of a setup that turning cuts.
std::optional<part::Chamfer> front_chamfer(const PreparedPart& plan, std::size_t setup,
                                           const Element& element);

/// The chamfers at the rims of a groove that its blade cuts: towards the free end of a
/// setup, and away from it.
struct Rims {
  std::optional<part::Chamfer> front, back;
};
Rims rims_of(const PreparedPart& plan, std::size_t setup, const Element& groove);

/// Largest radius [mm] that may stay in the inner corner behind an element, as its setup's
/// tool goes; nothing if any may.
std::optional<double> fillet_behind_mm(const PreparedPart& plan, std::size_t setup,
                                       const Element& element);

/// Where the tip of a corner goes in an undercut, heights over its floor and distances from
/// the shoulder: on the shoulder it passes the foot, of the forms F to H on a line into the
/// shoulder, then it goes around the centre to the floor.  Without a larger radius than the
/// corner's the arc is a point.
struct UndercutWay {
  double foot_h = 0, arc_h = 0, arc_z = 0, centre_h = 0, centre_z = 0, radius_mm = 0;
  double lean_rad = 0;  ///< by which the arc turns further than a right angle
};
UndercutWay undercut_way(const part::Undercut& undercut, double corner_mm);
/// How much longer [mm] the slope of an undercut is than what it falls on.
double slope_excess_mm(const part::Undercut& undercut);

/// The undercut behind an outer element, as its setup's tool goes.
std::optional<part::Undercut> undercut_behind(const PreparedPart& plan, std::size_t setup,
                                              const Element& element);

/// Whether a setup faces the shoulder behind an outer element by itself, and cuts the
/// undercut there in that operation.
bool faces_behind(const PreparedPart& plan, std::size_t setup, const SetupWork& work,
                  const Element& element);

/// Whether a setup faces the shoulder between two neighbours by itself, outside or between
/// bores, the second one further from the free end.
bool faces_between(const SetupWork& work, const Element& front, const Element& behind);

/// The tools that may face the shoulder between two neighbours: boring bars between bores,
/// outside those for finishing if an undercut stands before it.
std::vector<const catalogue::Tool*> shoulder_tools(const PreparedPart& plan,
                                                   const Element& front,
                                                   const Element& behind);

/// Whether a setup makes an element.
bool makes(const SetupWork& work, const Element& element);

/// How far [mm] a tool goes on along the chamfer of an element that another setup makes.  Into
/// stock it goes beyond the surface that is made later, and is drawn out from there: the
/// fillet that a corner of radius r leaves, r tan((pi/2 - angle)/2), and a twentieth of a
/// millimetre stay above that surface.  At a rounded edge, which ends along the surface, the
/// fillet stands on it.  Off a surface that is made already it goes on until it is clear;
/// at a rounded edge it is lifted where that ends.
double beyond_edge_mm(const part::Chamfer& chamfer, bool in_stock, double corner_mm);

/// Distance along either axis from which a tool comes up on a slope of 45 deg, from a
/// distance, to the beginning of a rounded edge.
double before_rounding_mm(double distance_mm);

/// Depth of cut [mm] of the ring of stock above such a chamfer, which the tool takes in one
/// cut, with what stands on the wall.
double ring_depth_mm(const part::Chamfer& chamfer, double corner_mm, double on_wall_mm);
/// Whether a tool takes it with its least depth on the wall.
bool takes_ring(const catalogue::Tool& tool, const part::Chamfer& chamfer);

}  // namespace turnwright::planning
