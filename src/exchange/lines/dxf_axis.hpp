#pragma once
#include <vector>

#include "dxf_plane.hpp"
#include "turnwright/exchange/outline.hpp"

/// The axis of the part in a drawing.
namespace turnwright::exchange::dxf {

/// A line with a direction: to the right, or upwards.  Coordinates along it and to its left
/// are the z and r of the part.
struct Axis {
  Place origin, u = {1, 0};

  Place local(const Place& p) const {
    const Place d = p - origin;
    return {dot(d, u), cross(u, d)};
  }
  Place drawn(const Place& local) const {
    return origin + local.x * u + local.y * Place{-u.y, u.x};
  }
};

/// The axis, by the first of the signs in read_dxf's comment that fits; what had to be
/// assumed is added.
/// @throws InputError if there is none.
Axis find_axis(const std::vector<Stroke>& strokes, double join_mm,
               std::vector<Remark>& assumed);

/// The strokes in coordinates of the axis, those left out that lie beyond both ends of the
/// centre line, where other views stand.  Centre lines and other roles go.
std::vector<Stroke> along(const Axis& axis, const std::vector<Stroke>& strokes);

/// The half on the left of the axis, cut along it; ends on the axis within `join_mm` are
/// put there.
std::vector<Stroke> half(const std::vector<Stroke>& local, double join_mm);

/// The other side in the place of this one.
std::vector<Stroke> mirrored(std::vector<Stroke> local);

}  // namespace turnwright::exchange::dxf
