#pragma once
#include <string>
#include <vector>

#include "dxf_file.hpp"
#include "dxf_plane.hpp"
#include "turnwright/exchange/outline.hpp"

/// The lines and arcs that a DXF file draws, blocks drawn out, in mm.
namespace turnwright::exchange::dxf {

/// A text of the drawing and where it stands.
struct Note {
  Place at;
  std::string text;  ///< as in the file
  std::string name;  ///< of its entity
};

/// A dimension: what it measures between its definition points.
struct Dimension {
  enum class Kind { linear, aligned, other };
  Kind kind = Kind::other;
  Place first, second;   ///< definition points
  double angle_rad = 0;  ///< direction of what a linear one measures
  std::string text;      ///< that stands in place of the measured value, as in the file
  std::optional<part::Limits> limits = {};  ///< of the dimension's own style
  std::string name;
};

struct Drawn {
  double unit_mm = 1;  ///< length of the drawing's unit
  std::vector<Stroke> strokes;
  std::vector<const Entity*> sources;  ///< of the strokes
  std::vector<Dimension> dimensions;
  std::vector<Note> notes;
  std::vector<Remark> assumed, ignored;
};

/// @param unit_mm  length of the drawing's unit, if the file is not to say it.
/// @throws InputError naming the entity.
Drawn draw(const File& file, std::optional<double> unit_mm);

/// Length of the drawing's unit; what had to be assumed is added.
double unit_mm(const File& file, std::vector<Remark>& assumed);

/// What lines on a layer and of a line type are for: by the words in their names.
Role role_of(const std::string& layer, const std::string& linetype);

/// The strokes of a LINE, ARC, LWPOLYLINE or POLYLINE; `to_mm` leads from the entity's own
/// coordinates to the drawing's.
/// @throws InputError for an arc that the transformation would make an ellipse.
void add_strokes(const Entity& entity, const Affine& to_mm, const Stroke& form,
                 std::vector<Stroke>& out);

}  // namespace turnwright::exchange::dxf
