#pragma once
#include <vector>

#include "dxf_axis.hpp"
#include "dxf_graph.hpp"
#include "dxf_strokes.hpp"

/// The contour of one half of a drawing.
namespace turnwright::exchange::dxf {

/// Names for what a message speaks of: entities, and places as they are drawn.
struct View {
  const Drawn* drawn = nullptr;
  Axis axis;
  bool other_side = false;  ///< the half on the right of the axis

  std::string source(std::uint32_t index) const { return drawn->sources[index]->name(); }
  /// "x = 12.5, y = 3" in the drawing's units.
  std::string where(Place local) const;
};

struct Half {
  Graph graph;
  std::vector<Link> outside;                ///< from the left face to the right one
  std::vector<Link> left_face, right_face;  ///< up and down
  std::vector<Link> from_right;  ///< bore from the right face to the axis or the left one
  std::vector<Link> from_left;   ///< bore from the axis to the left face
  bool through = false;          ///< `from_right` ends on the left face
  /// The bores are solid lines, as in a section, but shoulder lines are seen from outside.
  bool doubtful = false;
  std::vector<std::uint32_t> unused;  ///< sources of lines that are none of these

  bool bored() const { return !from_right.empty() || !from_left.empty(); }
};

/// @throws InputError naming places where the contour is open or goes apart.
Half read_half(const std::vector<Stroke>& strokes, double join_mm, const View& view);

/// A place of a chain of one half that does not lie on that of the other.
std::optional<Place> difference(const Half& a, const Half& b,
                                std::vector<Link> Half::*chain, double within_mm);

}  // namespace turnwright::exchange::dxf
