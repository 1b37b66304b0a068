#include "dxf_strokes.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::exchange::dxf {
namespace {

constexpr double kFarthest_mm = 1e7;  // 1e-16 of it is below any tolerance here

Place checked(const Place& p, const Entity& entity) {
  if (!(std::abs(p.x) <= kFarthest_mm && std::abs(p.y) <= kFarthest_mm))
    refuse(entity.name(), tr("a point more than 10 km from the origin"),
           tr("the part near the drawing's origin"));
  return p;
}

// Adds strokes of one entity in its own coordinates.
class Pen {
 public:
  Pen(const Entity& entity, const Affine& to_mm, const Stroke& form,
      std::vector<Stroke>& out)
      : entity_(entity), to_mm_(to_mm), form_(form), out_(out) {}

  void line(const Place& from, const Place& to) {
    Stroke s = form_;
    s.from = at(from);
    s.to = at(to);
    if (length(s.to - s.from) > 0) out_.push_back(s);
  }

  // About a centre by a signed angle; in two parts unless it is less than half a turn.
  void arc(const Place& from, const Place& to, const Place& centre, double turn_rad) {
    if (!to_mm_.keeps_circles())
      refuse(entity_.name(), tr("an arc in a block of unequal scales"),
             tr("arcs of circles"));
    if (std::abs(turn_rad) > 0.99 * units::kPi) {
      const Place u = from - centre;
      const double half = turn_rad / 2, c = std::cos(half), s = std::sin(half);
      const Place middle = centre + Place{c * u.x - s * u.y, s * u.x + c * u.y};
      arc(from, middle, centre, half);
      arc(middle, to, centre, half);
      return;
    }
    Stroke s = form_;
    s.from = at(from);
    s.to = at(to);
    s.centre = at(centre);
    s.counterclockwise = (turn_rad > 0) != to_mm_.mirrors();
    if (length(s.to - s.from) > 0) out_.push_back(s);
  }

  // tan of a quarter of the angle, positive to the left.
  void bulge(const Place& from, const Place& to, double bulge) {
    if (std::abs(bulge) < 1e-12) return line(from, to);
    const Place chord = to - from;
    const double off = (1 - bulge * bulge) / (4 * bulge);
    const Place centre = 0.5 * (from + to) + off * Place{-chord.y, chord.x};
    arc(from, to, centre, 4 * std::atan(bulge));
  }

 private:
  Place at(const Place& p) const { return checked(to_mm_(p), entity_); }

  const Entity& entity_;
  const Affine& to_mm_;
  const Stroke& form_;
  std::vector<Stroke>& out_;
};

void draw_arc(const Entity& e, Pen& pen) {
  const Place c{e.number_or(10, 0), e.number_or(20, 0)};
  const double R = e.number_or(40, 0);
  const double from = units::rad_from_deg(e.number_or(50, 0)),
               to = units::rad_from_deg(e.number_or(51, 0));
  if (!(R > 0)) refuse(e.name(), tr("an arc without a radius"), tr("a radius > 0"));
  double turn = std::fmod(to - from, 2 * units::kPi);
  if (turn <= 0) turn += 2 * units::kPi;
  const auto on_circle = [&](double a) {
    return c + R * Place{std::cos(a), std::sin(a)};
  };
  pen.arc(on_circle(from), on_circle(to), c, turn);
}

struct Vertex {
  Place at;
  double bulge = 0;
};

std::vector<Vertex> vertices_of_lwpolyline(const Entity& e) {
  std::vector<Vertex> out;
  Groups groups = e.groups();
  while (const auto g = groups.next()) {
    if (g->code == 10) out.push_back({{number(*g), 0}});
    if (out.empty()) continue;
    if (g->code == 20) out.back().at.y = number(*g);
    if (g->code == 42) out.back().bulge = number(*g);
  }
  return out;
}

std::vector<Vertex> vertices_of_polyline(const Entity& e) {
  constexpr long kFrame = 16;  // a control point of a spline, not on the curve
  std::vector<Vertex> out;
  bool vertex = false;
  Groups groups = e.groups();
  while (const auto g = groups.next()) {
    if (g->code == 0) {
      vertex = g->value == "VERTEX";
      if (vertex) out.emplace_back();
    }
    if (!vertex || out.empty()) continue;
    if (g->code == 10) out.back().at.x = number(*g);
    if (g->code == 20) out.back().at.y = number(*g);
    if (g->code == 42) out.back().bulge = number(*g);
    if (g->code == 70 && (integer(*g) & kFrame) != 0) {
      out.pop_back();
      vertex = false;
    }
  }
  return out;
}

void draw_polyline(const Entity& e, const std::vector<Vertex>& vertices, Pen& pen) {
  constexpr long kClosed = 1, kMesh = 16 | 64;
  const long flags = e.integer_or(70, 0);
  if ((flags & kMesh) != 0 && e.type == "POLYLINE")
    refuse(e.name(), tr("a mesh"), tr("lines and arcs"));
  for (std::size_t i = 1; i < vertices.size(); ++i)
    pen.bulge(vertices[i - 1].at, vertices[i].at, vertices[i - 1].bulge);
  if ((flags & kClosed) != 0 && vertices.size() > 1)
    pen.bulge(vertices.back().at, vertices.front().at, vertices.back().bulge);
}

}  // namespace

void add_strokes(const Entity& e, const Affine& to_mm, const Stroke& form,
                 std::vector<Stroke>& out) {
  Pen pen(e, to_mm, form, out);
  if (e.type == "LINE")
    pen.line({e.number_or(10, 0), e.number_or(20, 0)},
             {e.number_or(11, 0), e.number_or(21, 0)});
  else if (e.type == "ARC")
    draw_arc(e, pen);
  else if (e.type == "LWPOLYLINE")
    draw_polyline(e, vertices_of_lwpolyline(e), pen);
  else
    draw_polyline(e, vertices_of_polyline(e), pen);
}

}  // namespace turnwright::exchange::dxf
