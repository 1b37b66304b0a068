#include "edge_assignment.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/say.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/paths/approach.hpp"
#include "planning/paths/edges.hpp"
#include "planning/paths/pass_lengths.hpp"
#include "planning/paths/programmed_faces.hpp"
#include "planning/values/surface_request.hpp"

namespace turnwright::planning {
namespace {

using part::End;

// As programs make it.
double end_radius_mm(const part::Drawing& d, const Element& e, End end) {
  const auto of = [&](const auto& x) {
    return (end == End::left ? x.left_mm : x.right_mm) / 2 + to_middle_mm(d, x.id);
  };
  return e.inner ? of(d.inner[e.index]) : of(d.outer[e.index]);
}

// Whether the wall before a chamfer is as high as the corner of any tool needs that may face
// it.
bool wall_takes_corners(const PreparedPart& p, const Element& e, const Element& front,
                        End end) {
  const auto& d = p.drawing;
  const auto& chamfer = chamfer_at(d, e, end);
  const double wall_mm =
      std::abs(end_radius_mm(d, e, end) - end_radius_mm(d, front, part::opposite(end))) -
      chamfer->radial_mm;
  return std::ranges::all_of(shoulder_tools(p, front, e), [&](const catalogue::Tool* t) {
    return t->re_mm + kNoWall_mm <= wall_mm;
  });
}

// Whether that is so, if a facing tool makes the wall.
bool leaves_wall(const PreparedPart& p, const SetupWork& work, const Element& e,
                 const Element& front, End end) {
  return !faces_between(work, front, e) || wall_takes_corners(p, e, front, end);
}

// Whether a setup plunges the groove beside an element that is made by then, so that the
// blade cuts the chamfer at its rim.
bool cut_by_blade(const PreparedPart& p, const std::vector<SetupWork>& setups,
                  std::size_t s, const Element& e, End end) {
  const auto groove = neighbour(p.drawing, e, end);
  bool made = false;
  for (std::size_t k = 0; k <= s; ++k) made = made || makes(setups[k], e);
  return made && groove && makes(setups[s], *groove);
}

// Whether the jaws leave room for a corner that comes over the chamfer of an element which
// they hold.
bool before_jaws(const PreparedPart& p, std::size_t s, const Element& e, End end,
                 const part::Chamfer& chamfer) {
  const auto& clampings = p.setups[s].clampings;
  if (e.inner || std::ranges::all_of(clampings, [](Clamping c) {
        return c == Clamping::between_centres;
      }))
    return true;
  double corner = 0;
  for (const auto* t : tools_for(p, catalogue::ToolUse::finishing))
    corner = std::max(corner, t->re_mm);
  const double room = std::abs(end_z_mm(p.drawing, e, end) - jaws_z_mm(p, s));
  return room >= chamfer.axial_mm + corner +
                     std::max(kBehind_mm, beyond_edge_mm(chamfer, true, corner));
}

bool cut_in(const PreparedPart& p, const std::vector<SetupWork>& setups, std::size_t s,
            const Element& e, End end, const part::Chamfer& chamfer) {
  if (chamfer.by_blade) return cut_by_blade(p, setups, s, e, end);
  if (free_end(p, s) != end) return false;
  if (makes(setups[s], e)) return true;
  const auto front = neighbour(p.drawing, e, end);
  return front && makes(setups[s], *front) && leaves_wall(p, setups[s], e, *front, end) &&
         before_jaws(p, s, e, end, chamfer);
}

// Whether some setup cuts the chamfer at an end.
bool cut_on_the_way(const PreparedPart& p, const std::vector<SetupWork>& setups,
                    const Element& e, End end) {
  for (std::size_t s = 0; s < setups.size(); ++s)
    if (cut_in(p, setups, s, e, end, *chamfer_at(p.drawing, e, end))) return true;
  return false;
}

// Whether a setup cuts an edge of an element while that is stock.
bool cuts_edge_in_stock(const PreparedPart& p, const std::vector<SetupWork>& setups,
                        std::size_t s, const Element& e) {
  const End end = free_end(p, s);
  const auto chamfer = turned(chamfer_at(p.drawing, e, end));
  if (!chamfer || p.drawing.outer[e.index].as_stock) return false;
  for (std::size_t k = 0; k <= s; ++k)
    if (makes(setups[k], e)) return false;
  return cut_in(p, setups, s, e, end, *chamfer);
}

// Whether one of the tools that may face a shoulder takes the ring above its edge.
bool can_face_ring(const PreparedPart& p, const Element& front, const Element& e,
                   End end) {
  const auto tools = shoulder_tools(p, front, e);
  return std::ranges::any_of(tools, [&](const catalogue::Tool* t) {
    return takes_ring(*t, *chamfer_at(p.drawing, e, end));
  });
}

// The setup, if any, in which a pass of its own cuts a chamfer at a face of the part.
std::optional<std::size_t> alone_in(const PreparedPart& p,
                                    const std::vector<SetupWork>& setups,
                                    const Element& e, End end) {
  if (neighbour(p.drawing, e, end)) return std::nullopt;
  bool made = !e.inner && p.drawing.outer[e.index].as_stock;
  for (std::size_t s = 0; s < setups.size(); ++s) {
    if (made && free_end(p, s) == end && !(front_mm(p, s, setups[s]) > 0)) return s;
    made = made || makes(setups[s], e);
  }
  return std::nullopt;
}

template <class List>
void assign(const PreparedPart& p, const List& elements, bool inner,
            std::vector<SetupWork>& setups, std::vector<Reason>& not_cut) {
  for (std::size_t i = 0; i < elements.size(); ++i)
    for (const End end : {End::left, End::right}) {
      const auto& e = elements[i];
      const auto& chamfer = chamfer_at(p.drawing, {inner, i}, end);
      if (!chamfer || chamfer->general || cut_on_the_way(p, setups, {inner, i}, end))
        continue;
      if (const auto s = alone_in(p, setups, {inner, i}, end))
        (inner ? setups[*s].inner_chamfers : setups[*s].outer_chamfers).push_back(i);
      else
        not_cut.emplace_back([&e, &chamfer, end] {
          return say(
              "{} at {} cannot be cut in any setup: none makes {} or the surface before "
              "that end, with the end free, enough wall for the tool and room before the "
              "jaws",
              chamfer->round ? tr("the rounded edge") : tr("the chamfer"),
              end == End::left ? say("the left end of {}", e.id)
                               : say("the right end of {}", e.id),
              e.id);
        });
    }
}

}  // namespace

void leave_to_the_hand(PreparedPart& p) {
  const auto of = [&](auto& elements, bool inner) {
    for (std::size_t i = 0; i < elements.size(); ++i)
      for (const End end : {End::left, End::right}) {
        auto& chamfer =
            end == End::left ? elements[i].left_chamfer : elements[i].right_chamfer;
        if (!chamfer || !chamfer->general) continue;
        if (!cut_on_the_way(p, p.work.setups, {inner, i}, end)) chamfer.reset();
      }
  };
  of(p.drawing.outer, false);
  of(p.drawing.inner, true);
}

void assign_edges_in_stock(const PreparedPart& p, std::vector<SetupWork>& setups) {
  for (std::size_t s = 0; s < setups.size(); ++s) {
    const End end = free_end(p, s);
    for (std::size_t k = 1; k < p.drawing.outer.size(); ++k) {
      const Element left{false, k - 1}, right{false, k};
      const auto &e = end == End::left ? right : left,
                 &front = end == End::left ? left : right;
      auto& work = setups[s];
      if (!cuts_edge_in_stock(p, setups, s, e) || faces_between(work, front, e) ||
          made_with_undercut(p.drawing, k) || !can_face_ring(p, front, e, end) ||
          !wall_takes_corners(p, e, front, end))
        continue;
      work.before_stock.push_back(k);
      if (p.face_edges_in_stock) work.shoulders.push_back(k);
    }
  }
}

std::vector<Reason> assign_chamfers(const PreparedPart& p,
                                    std::vector<SetupWork>& setups) {
  std::vector<Reason> not_cut;
  assign(p, p.drawing.outer, false, setups, not_cut);
  assign(p, p.drawing.inner, true, setups, not_cut);
  return not_cut;
}

std::vector<Reason> undercuts_not_cut(const PreparedPart& p,
                                      const std::vector<SetupWork>& setups) {
  std::vector<Reason> all;
  for (std::size_t i = 0; i < p.drawing.outer.size(); ++i)
    for (const End end : {End::left, End::right}) {
      const auto& e = p.drawing.outer[i];
      if (!(end == End::left ? e.left_undercut : e.right_undercut)) continue;
      bool cut = false;
      for (std::size_t s = 0; s < setups.size(); ++s)
        cut = cut || (makes(setups[s], {false, i}) && free_end(p, s) != end);
      if (!cut)
        all.emplace_back([&p, &e, end, i] {
          return say(
              "the undercut of {} before {} cannot be cut: no setup turns {} towards "
              "that shoulder",
              e.id, shoulder_id(p.drawing, end == End::left ? i : i + 1), e.id);
        });
    }
  return all;
}

}  // namespace turnwright::planning
