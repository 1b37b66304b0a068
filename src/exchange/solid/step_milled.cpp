#include "step_milled.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <unordered_map>

#include "base/say.hpp"
#include "exchange/contour/elements.hpp"
#include "step_cross_hole.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::exchange {
namespace {

using Kind = Surface::Kind;

constexpr std::size_t kMostRemarks = 200;

/// Faces that are connected by edges, each list in the order of the faces.
std::vector<std::vector<const Face*>> groups(const std::vector<Face>& faces,
                                             const std::vector<bool>& used) {
  std::vector<std::size_t> root(faces.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&root](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::unordered_map<std::size_t, std::size_t> by_edge;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (const auto& b : faces[i].boundary) {
      if (used[i]) continue;
      const auto a = find(i), c = find(by_edge.try_emplace(b.edge, i).first->second);
      root[std::max(a, c)] = std::min(a, c);
    }
  std::vector<std::vector<const Face*>> all(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (!used[i]) all[find(i)].push_back(&faces[i]);
  std::erase_if(all, [](const auto& group) { return group.empty(); });
  return all;
}

/// The outer cylinder that holds the place from end to end.
const Element* holder(const Outline& outline, const Milled& m) {
  const bool hole = m.kind == Milled::Kind::cross_hole;
  const double from = hole ? m.z_mm - m.width_mm / 2 : m.z_mm;
  const double to = hole ? m.z_mm + m.width_mm / 2 : m.z_mm + m.length_mm;
  double left = 0;
  for (const auto& e : outline.outer) {
    const double right = left + e.length_mm;
    if (e.shape == Shape::cylinder && from > left - kSame_mm && to < right + kSame_mm)
      return &e;
    left = right;
  }
  return nullptr;
}

bool put(Pocket f, double left_mm, Outline& outline) {
  f.milled.z_mm -= left_mm;
  const auto* on = holder(outline, f.milled);
  auto& m = f.milled;
  const bool hole = m.kind == Milled::Kind::cross_hole;
  if (!on || !(hole || f.floor_mm > 0)) return false;
  m.on = on->id;
  const bool open = m.through != Milled::Through::no;
  if (!open) m.depth_mm = tidy_mm(on->left_mm / 2 - f.floor_mm);
  m.width_mm = tidy_mm(m.width_mm);
  m.length_mm = tidy_mm(m.length_mm);
  if (!(open || m.depth_mm > 0) || !(hole || m.length_mm > 0)) return false;
  m.z_mm = std::max(tidy_mm(m.z_mm), 0.0);
  m.id = fmt::format("m{}", outline.milled.size() + 1);
  if (f.square_ends)
    outline.assumed.push_back(
        {m.sources.front(),
         hole ? say("{} has a flat bottom; a drill leaves a point.", m.id)
              : say("{} has a square end; a milling cutter leaves a round one.", m.id)});
  outline.milled.push_back(std::move(m));
  return true;
}

std::string lies(const Face& face, const Axis& axis) {
  const auto& s = face.surface;
  const bool plane = s.kind == Kind::plane;
  if (axis.parallel(s.axis)) {
    if (plane) return tr("across the axis");
    const double off = axis.r_mm(s.origin);
    return off < kSame_mm ? tr("about the axis")
                          : say("along the axis, {:.6g} mm from it", off);
  }
  if (axis.across(s.axis)) return plane ? tr("along the axis") : tr("across the axis");
  const double deg = std::acos(std::min(1.0, std::abs(axis.direction.dot(s.axis)))) *
                     180 / std::numbers::pi;
  return say("at {:.4g} deg to the axis", plane ? 90 - deg : deg);
}

void ignore(const std::vector<const Face*>& group, const Axis& axis, Outline& outline,
            std::size_t& more) {
  for (const auto* f : group) {
    if (outline.ignored.size() >= kMostRemarks)
      ++more;
    else
      outline.ignored.push_back({name_of(f->id), say("{} is not part of what is turned.",
                                                     described(*f, axis))});
  }
}

}  // namespace

std::string described(const Face& face, const Axis& axis) {
  const auto& s = face.surface;
  switch (s.kind) {
    case Kind::plane:
      return say("A plane {}", lies(face, axis));
    case Kind::cylinder:
      return face.outward < 0 ? say("A hole or hollow of {:.6g} mm diameter {}",
                                    2 * s.radius_mm, lies(face, axis))
                              : say("A cylinder of {:.6g} mm diameter {}",
                                    2 * s.radius_mm, lies(face, axis));
    case Kind::cone:
      return say("A cone {}", lies(face, axis));
    case Kind::torus:
      return say("A rounding of {:.6g} mm radius {}", s.tube_mm, lies(face, axis));
    case Kind::sphere:
      return say("A sphere of {:.6g} mm radius", s.radius_mm);
    case Kind::other:
      break;
  }
  return say("A surface of the kind {}", s.name);
}

void add_milled(const std::vector<Face>& faces, const Contour& contour, const Axis& axis,
                Outline& outline) {
  std::size_t more = 0;
  for (const auto& group : groups(faces, contour.used)) {
    leave_if_asked();
    const auto hole = cross_hole(group, axis);
    const auto places = hole ? std::vector{*hole} : pockets(group, axis);
    bool understood = !places.empty();
    const auto milled = outline.milled.size(), assumed = outline.assumed.size();
    for (const auto& place : places)
      understood = understood && put(place, contour.left_mm, outline);
    if (understood) continue;
    outline.milled.resize(milled), outline.assumed.resize(assumed);
    ignore(group, axis, outline, more);
  }
  if (more) outline.ignored.push_back({"", say("{} more faces are not turned.", more)});
}

}  // namespace turnwright::exchange
