#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "turnwright/exchange/profile.hpp"

/// Draws an outline: the half profile with its chamfers, fillets, undercuts and centre holes,
/// for tests that read it back.  Written from the drawing's rules alone: every corner is drawn where
/// its two elements meet, point by point.
namespace turnwright::exchange::drawn {

/// One element in the direction of drawing, the material below.
struct Step {
  const Element* element;
  Point from, to;
};

/// The chamfer or rounded edge there, or what the inner corner has.
inline const Edge* edge_at(const Outline& o, const std::string& at, bool outside) {
  for (const Edge& e : o.edges)
    if (e.at == at && (e.chamfer_mm || e.radius_mm) == outside) return &e;
  return nullptr;
}

inline double radial_mm(const Edge& chamfer) {
  if (chamfer.radius_mm) return *chamfer.radius_mm;
  return *chamfer.chamfer_mm * std::tan(chamfer.angle_deg * std::acos(-1) / 180);
}

inline void line(std::vector<Side>& sides, Point to) {
  sides.push_back({.from = sides.back().to, .to = to});
}

inline void arc(std::vector<Side>& sides, Point to, Point centre, bool left_turn) {
  sides.push_back({.from = sides.back().to,
                   .to = to,
                   .centre = centre,
                   .counterclockwise = left_turn});
}

inline part::Undercut undercut_of(const Edge& foot) {
  const std::string& form = *foot.undercut;
  if (foot.pitch_mm > 0) return *part::thread_undercut(form.back(), foot.pitch_mm);
  return *part::undercut('E', std::stod(form.substr(1)),
                         std::stod(form.substr(form.find('x') + 1)));
}

/// The corner between what comes before at (x, y0) and what follows at (x, y1).
inline void corner(std::vector<Side>& sides, double x, double y0, double y1,
                   const Edge* chamfer, const Edge* foot) {
  const double up = y1 > y0 ? 1 : -1;  // the standing one follows, or came before
  const double low = std::min(y0, y1), high = std::max(y0, y1);
  const bool round = chamfer && chamfer->radius_mm;
  const double c = !chamfer ? 0 : round ? *chamfer->radius_mm : *chamfer->chamfer_mm;
  const double c_y = chamfer ? radial_mm(*chamfer) : 0;
  std::vector<Side> rising;  // from the lower element up to the standing one
  double bottom = low;
  if (foot && foot->fillet_mm) {
    const double R = *foot->fillet_mm;
    rising.push_back({.from = {x - up * R, low},
                      .to = {x, low + R},
                      .centre = Point{x - up * R, low + R},
                      .counterclockwise = true});
    bottom = low + R;
  } else if (foot && foot->undercut) {
    const auto u = undercut_of(*foot);
    const double r = u.radius_mm, t = u.depth_mm, f = u.width_mm;
    const double run = t / std::tan(std::acos(-1) / (u.pitch_mm > 0 ? 6 : 12));
    rising.push_back({.from = {x - up * f, low}, .to = {x - up * (f - run), low - t}});
    rising.push_back({.from = rising.back().to, .to = {x - up * r, low - t}});
    rising.push_back({.from = rising.back().to,
                      .to = {x, low - t + r},
                      .centre = Point{x - up * r, low - t + r},
                      .counterclockwise = true});
    bottom = low - t + r;
  }
  rising.push_back({.from = {x, bottom}, .to = {x, high - c_y}});
  if (chamfer) rising.push_back({.from = {x, high - c_y}, .to = {x + up * c, high}});
  if (round) rising.back().centre = Point{x + up * c, high - c};
  // Drawn from left to right the material is below: mirrored, an inner corner's arc turns
  // left again when it is gone through from the other end.
  if (up < 0) {
    std::reverse(rising.begin(), rising.end());
    for (Side& s : rising) std::swap(s.from, s.to);
  }
  line(sides, rising.front().from);
  sides.insert(sides.end(), rising.begin(), rising.end());
}

/// The sides from the face at the first element to that at the last.
template <class Name>
std::vector<Side> chain(const Outline& o, const std::vector<Step>& steps, double begin_y,
                        double end_y, Name name) {
  std::vector<Side> sides{{.from = {}, .to = {steps.front().from.z_mm, begin_y}}};
  for (std::size_t k = 0; k <= steps.size(); ++k) {
    const double x = k < steps.size() ? steps[k].from.z_mm : steps[k - 1].to.z_mm;
    const double y0 = k > 0 ? steps[k - 1].to.r_mm : begin_y;
    const double y1 = k < steps.size() ? steps[k].from.r_mm : end_y;
    corner(sides, x, y0, y1, edge_at(o, name(k), true), edge_at(o, name(k), false));
    if (k == steps.size()) break;
    const Element& e = *steps[k].element;
    if (e.shape != Shape::arc) continue;
    const Point a = steps[k].from, b = steps[k].to;
    const double dx = b.z_mm - a.z_mm, dy = b.r_mm - a.r_mm,
                 half = std::hypot(dx, dy) / 2;
    const double off = std::sqrt(std::max(0.0, e.radius_mm * e.radius_mm - half * half));
    const double side = e.convex ? 1 : -1;  // the centre lies on the right of the way
    arc(sides, b,
        {(a.z_mm + b.z_mm) / 2 + side * off * dy / (2 * half),
         (a.r_mm + b.r_mm) / 2 - side * off * dx / (2 * half)},
        !e.convex);
  }
  sides.erase(sides.begin());
  std::erase_if(sides, [](const Side& s) {
    return std::hypot(s.to.z_mm - s.from.z_mm, s.to.r_mm - s.from.r_mm) < 1e-12;
  });
  return sides;
}

/// The table of ISO 6411: d, and D1 and D2 of the forms R and A, D3 of form B.
inline constexpr double kCentreHoles_mm[][3]{
    {1, 2.12, 3.15}, {1.25, 2.65, 4}, {1.6, 3.35, 5}, {2, 4.25, 6.3},  {2.5, 5.3, 8},
    {3.15, 6.7, 10}, {4, 8.5, 12.5},  {5, 10.6, 16},  {6.3, 13.2, 18}, {10, 21.2, 28}};

/// A centre hole of ISO 6411 in the end at z = 0, drilled towards negative z: an arc of form R
/// has the radius 2.5 d, and in the middle of its height the slope of 30 deg.
inline std::vector<Side> centre_hole(const std::string& designation) {
  const char form = designation.at(designation.find_first_of("ABR"));
  const auto digits = designation.find_first_of("ABR") + 1;
  const double d = std::stod(designation.substr(digits)),
               D = std::stod(designation.substr(designation.find('/') + 1));
  const double tan30 = std::tan(std::acos(-1) / 6), r = d / 2;
  double cone = D / 2;
  for (const auto& row : kCentreHoles_mm)
    if (form == 'B' && row[0] == d) cone = row[1] / 2;
  std::vector<Side> sides{{.from = {}, .to = {0, D / 2}}};
  if (form == 'B') line(sides, {-(D / 2 - cone) * tan30, cone});
  if (form == 'R') {
    const double R = 2.5 * d, y = (D / 2 + r) / 2 + R * std::cos(std::acos(-1) / 6);
    const auto z = [&](double at) { return std::sqrt(R * R - (y - at) * (y - at)); };
    arc(sides, {z(r) - z(cone), r}, {-z(cone), y}, false);
  } else {
    line(sides, {sides.back().to.z_mm - (cone - r) / tan30, r});
  }
  line(sides, {sides.back().to.z_mm - 1.2 * d, r});
  line(sides, {sides.back().to.z_mm - r * tan30, 0});
  sides.erase(sides.begin());
  return sides;
}

/// That in the right end at z, or in the left one: mirrored and gone through the other way.
inline std::vector<Side> placed(std::vector<Side> hole, part::End at, double z_mm) {
  const bool left = at == part::End::left;
  const auto place = [&](Point p) {
    return Point{left ? -p.z_mm : p.z_mm + z_mm, p.r_mm};
  };
  for (Side& s : hole) {
    s.from = place(s.from), s.to = place(s.to);
    if (s.centre) s.centre = place(*s.centre);
    if (left) std::swap(s.from, s.to);
  }
  if (left) std::reverse(hole.begin(), hole.end());
  return hole;
}

inline Profile profile_of(const Outline& o) {
  std::vector<Step> outer, inner;
  double z = 0;
  for (const Element& e : o.outer) {
    outer.push_back({&e, {z, e.left_mm / 2}, {z + e.length_mm, e.right_mm / 2}});
    z += e.length_mm;
  }
  // Half a turn of the plane: the bores from right to left.
  double right = z, left = 0;
  std::vector<Step> from_left;
  for (const Element& e : o.inner) {
    const double from = e.from == part::End::right ? right : left + e.length_mm;
    const Step step{&e, {-from, -e.right_mm / 2}, {-from + e.length_mm, -e.left_mm / 2}};
    if (e.from == part::End::right) {
      inner.push_back(step);
      right -= e.length_mm;
    } else {
      from_left.push_back(step);
      left += e.length_mm;
    }
  }
  const bool through = !o.inner.empty() && std::abs(right - left) < 1e-12;
  std::reverse(from_left.begin(), from_left.end());
  const auto name_in = [&](const std::vector<Step>& steps, std::size_t k, bool to_left) {
    if (k == 0) return std::string("right|") + steps.front().element->id;
    if (k == steps.size())
      return (to_left ? "left|" : "bottom|") + steps.back().element->id;
    return steps[k - 1].element->id + "|" + steps[k].element->id;
  };
  // Where the face at a mouth ends: at the bore, or at its chamfer.
  const auto mouth = [&](const std::vector<Step>& first, const std::vector<Step>& second,
                         const char* end) {
    const auto& steps = first.empty() && through ? second : first;
    if (steps.empty()) return 0.0;
    const bool at_right = std::string(end) == "right";
    const Step& s = at_right ? steps.front() : steps.back();
    const Edge* c = edge_at(o, std::string(end) + "|" + s.element->id, true);
    return -(at_right ? s.from.r_mm : s.to.r_mm) + (c ? radial_mm(*c) : 0);
  };
  std::vector<Side> centre_left, centre_right;
  for (const CentreHole& c : o.centre_holes)
    (c.at == part::End::left ? centre_left : centre_right) =
        placed(centre_hole(c.designation), c.at, z);
  const double hole_right = centre_right.empty() ? mouth(inner, from_left, "right")
                                                 : centre_right.front().from.r_mm;
  const double hole_left =
      centre_left.empty() ? mouth(from_left, inner, "left") : centre_left.back().to.r_mm;

  Profile p;
  p.sides = chain(o, outer, hole_left, hole_right, [&](std::size_t k) {
    if (k == 0) return std::string("left");
    if (k == outer.size()) return std::string("right");
    return outer[k - 1].element->id + "|" + outer[k].element->id;
  });
  const auto add = [&](const std::vector<Step>& steps, double begin, double end,
                       bool to_left) {
    if (steps.empty()) return;
    for (Side s : chain(o, steps, begin, end,
                        [&](std::size_t k) { return name_in(steps, k, to_left); })) {
      const auto back = [](Point q) { return Point{-q.z_mm, -q.r_mm}; };
      s.from = back(s.from);
      s.to = back(s.to);
      if (s.centre) s.centre = back(*s.centre);
      p.sides.push_back(s);
    }
  };
  if (through) {
    inner.insert(inner.end(), from_left.begin(), from_left.end());
    add(inner, -hole_right, -hole_left, true);
  } else {
    add(inner, -hole_right, 0, false);
    p.sides.insert(p.sides.end(), centre_right.begin(), centre_right.end());
    p.sides.insert(p.sides.end(), centre_left.begin(), centre_left.end());
    add(from_left, 0, -hole_left, true);
  }
  return p;
}

}  // namespace turnwright::exchange::drawn
