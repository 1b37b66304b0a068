#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Points, lines and arcs of a drawing's plane [mm].
namespace turnwright::exchange::dxf {

struct Place {
  double x = 0, y = 0;
};

inline Place operator+(const Place& a, const Place& b) { return {a.x + b.x, a.y + b.y}; }
inline Place operator-(const Place& a, const Place& b) { return {a.x - b.x, a.y - b.y}; }
inline Place operator*(double k, const Place& a) { return {k * a.x, k * a.y}; }
inline double length(const Place& a) { return std::hypot(a.x, a.y); }
inline double cross(const Place& a, const Place& b) { return a.x * b.y - a.y * b.x; }
inline double dot(const Place& a, const Place& b) { return a.x * b.x + a.y * b.y; }

/// (x, y) -> (a x + c y + e, b x + d y + f), as blocks are placed.
struct Affine {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
  Place operator()(const Place& p) const {
    return {a * p.x + c * p.y + e, b * p.x + d * p.y + f};
  }
  /// First `inner`, then this.
  Affine after(const Affine& inner) const {
    const Place o = (*this)({inner.e, inner.f});
    return {a * inner.a + c * inner.b,
            b * inner.a + d * inner.b,
            a * inner.c + c * inner.d,
            b * inner.c + d * inner.d,
            o.x,
            o.y};
  }
  bool mirrors() const { return a * d - b * c < 0; }
  /// Whether circles stay circles.
  bool keeps_circles() const {
    const double u = std::hypot(a, b), v = std::hypot(c, d), most = std::max(u, v);
    return std::abs(u - v) <= 1e-9 * most &&
           std::abs(a * c + b * d) <= 1e-9 * most * most;
  }
};

/// What a line of the drawing is for.
enum class Role { contour, hidden, centre, other };

/// A line, or an arc of less than half a turn.
struct Stroke {
  Place from, to;
  std::optional<Place> centre = {};
  bool counterclockwise = false;
  Role role = Role::contour;
  std::uint32_t source = 0;  ///< index of its entity
};

/// Angle [rad] by which the direction from the centre turns from `from` to `to`, without
/// its sign.
inline double sweep_rad(const Stroke& s) {
  const Place u = s.from - *s.centre, v = s.to - *s.centre;
  const double turn = std::atan2(cross(u, v), dot(u, v));
  return std::abs(turn);
}

}  // namespace turnwright::exchange::dxf
