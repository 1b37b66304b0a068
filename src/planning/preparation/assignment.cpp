#include "assignment.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "base/say.hpp"
#include "edge_assignment.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/paths/edges.hpp"
#include "planning/paths/pass_lengths.hpp"
#include "planning/values/readable.hpp"
#include "planning/values/surface_request.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::planning {
namespace {

using part::End;

double largest(const part::OuterElement& e) { return std::max(e.left_mm, e.right_mm); }

// Whether a tool can reach outer element i from the free end.
bool reachable(const PreparedPart& p, std::size_t s, std::size_t i) {
  const auto& e = p.drawing.outer;
  const double z0 = part::left_z_mm(p.drawing, i), z1 = z0 + e[i].length_mm;
  const bool left = holds_left(p, s);
  if (left ? z0 < jaws_z_mm(p, s) - 1e-9 : z1 > jaws_z_mm(p, s) + 1e-9) return false;
  // A cone must widen towards the jaws, and nothing nearer the free end may be larger.
  const double outward = left ? e[i].right_mm : e[i].left_mm;
  const double inward = left ? e[i].left_mm : e[i].right_mm;
  if (outward > inward) return false;
  for (std::size_t k = left ? i + 1 : 0; k < (left ? e.size() : i); ++k)
    if (largest(e[k]) > outward + 1e-9) return false;
  return true;
}

// Length [mm] that the corner of a finishing tool needs beyond the end of an element, and
// the length that the jaws leave free.
struct BeforeJaws {
  double needed_mm = 0, left_mm = 0;
  bool enough() const { return left_mm >= needed_mm - 1e-5; }
};
BeforeJaws before_jaws(const PreparedPart& p, std::size_t s, std::size_t i) {
  const auto& e = p.drawing.outer[i];
  const auto& clampings = p.setups[s].clampings;
  const auto tools = tools_for(p, catalogue::ToolUse::finishing);
  const bool centres = std::find(clampings.begin(), clampings.end(),
                                 Clamping::between_centres) != clampings.end();
  if (e.cut || centres || tools.empty()) return {};
  const auto around = surroundings(p, s, Clamping::chuck, {}, {false, i});
  if (const auto level = around.level_behind) {
    bool made_before = false;
    for (std::size_t t = 0; t < s; ++t) made_before |= reachable(p, t, *level);
    if (!made_before) return {};
  }
  double corner = tools.front()->re_mm;
  for (const auto* t : tools) corner = std::min(corner, t->re_mm);
  return {needed_beyond_mm(around, corner), around.z1 - around.root_z};
}

// A bore opens to the free end and narrows inwards, itself and with all before it.
bool bore_reachable(const PreparedPart& p, std::size_t s, std::size_t i) {
  const auto& inner = p.drawing.inner;
  const auto& e = inner[i];
  const bool right = e.from == End::right;
  if (holds_left(p, s) != right) return false;
  const double opening = right ? e.right_mm : e.left_mm;
  const double deep = right ? e.left_mm : e.right_mm;
  if (deep > opening) return false;
  for (std::size_t k = 0; k < i; ++k)
    if (inner[k].from == e.from &&
        std::min(inner[k].left_mm, inner[k].right_mm) < opening - 1e-9)
      return false;
  return true;
}

bool face_named(const part::Drawing& d, const std::string& id) {
  return std::any_of(d.faces.begin(), d.faces.end(),
                     [&](const part::Face& f) { return f.id == id; }) ||
         part::has_tolerance(d, id);
}

// Whether an operation of a setup drills the end that a hole is reached from.
bool drilled_in(const PreparedPart& p, std::size_t s, const part::InnerElement& hole) {
  return std::ranges::any_of(*p.operations, [&](const OperationRequest& o) {
    return o.setup == s && o.kind == OperationKind::fixed &&
           std::ranges::any_of(p.drawing.inner, [&](const part::InnerElement& e) {
             return e.from == hole.from && std::ranges::find(o.on, e.id) != o.on.end();
           });
  });
}

// Whether a surface may be made in this setup: the request leaves that to the planner, or
// has an operation for it there.
bool wanted_in(const PreparedPart& p, std::size_t s, const std::string& surface) {
  if (!p.operations) return true;
  for (const auto& e : p.drawing.inner)
    if (e.id == surface && part::is_hole(e)) return drilled_in(p, s, e);
  return std::any_of(p.operations->begin(), p.operations->end(), [&](const auto& o) {
    return o.setup == s && o.kind != OperationKind::fixed &&
           std::find(o.on.begin(), o.on.end(), surface) != o.on.end();
  });
}

bool wanted(const PreparedPart& p, const std::string& surface) {
  for (std::size_t s = 0; s < p.setups.size(); ++s)
    if (wanted_in(p, s, surface)) return true;
  return false;
}

// The first setup that may and can make a surface; if there is none, adds the reason.
template <class Can>
std::optional<std::size_t> place(const PreparedPart& p, const std::string& surface,
                                 const std::string& why, const Can& can, Assignment& a) {
  bool asked = false;
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    if (!wanted_in(p, s, surface)) continue;
    asked = true;
    if (can(s)) return s;
  }
  a.unreachable.push_back(
      !asked ? say("{} has no operation: it would stay as the stock is", surface)
      : p.operations
          ? say("{} cannot be cut in the setup of its operations: {}", surface, why)
          : say("{} cannot be cut in any setup: {}", surface, why));
  return {};
}

// Why no setup can cut an outer element.
std::string why_not(const PreparedPart& p, std::size_t i) {
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    if (!wanted_in(p, s, p.drawing.outer[i].id) || !reachable(p, s, i)) continue;
    if (!cleared(p, s, i))
      return say(
          "towards the chuck it falls by more than the {:.4g} deg that profiling tools "
          "are taken to clear",
          units::deg_from_rad(part::kProfilingClears_rad));
    const auto room = before_jaws(p, s, i);
    const auto [left, needed] = readable_apart(room.left_mm, room.needed_mm);
    return say(
        "in {} it ends {} mm before the jaws, its tool's corner needs {} mm: grip less",
        setup_label(s), left, needed);
  }
  return tr("it lies in the jaws, or behind a larger diameter");
}

void assign_faces(const PreparedPart& p, Assignment& a) {
  const auto& d = p.drawing;
  for (const End end : {End::left, End::right}) {
    if (!(face_stock_mm(p, end) > 1e-9)) continue;
    const std::string id = end == End::left ? "left" : "right";
    const auto free = [&](std::size_t s) { return p.setups[s].hold != end; };
    bool open = face_named(d, id);  // else it may stay as it is
    for (std::size_t s = 0; s < p.setups.size(); ++s)
      open = open || (free(s) && wanted_in(p, s, id));
    if (!open) continue;
    if (const auto s = place(p, id, tr("its end is held"), free, a))
      a.setups[*s].end_face = true;
  }
  for (std::size_t k = 1; k < d.outer.size(); ++k) {
    const auto id = shoulder_id(d, k);
    const auto &before = d.outer[k - 1], &after = d.outer[k];
    if (!face_named(d, id) || before.right_mm == after.left_mm) continue;
    if (made_with_undercut(d, k) && !(p.operations && wanted(p, id))) continue;
    const std::size_t smaller = before.right_mm > after.left_mm ? k : k - 1;
    const auto s = place(
        p, id,
        tr("it is faced in the setup that turns the smaller element beside it, and none "
           "does"),
        [&](std::size_t i) {
          const auto& e = a.setups[i].elements;
          return std::find(e.begin(), e.end(), smaller) != e.end();
        },
        a);
    if (s) a.setups[*s].shoulders.push_back(k);
  }
  for (const auto& shoulder : part::inner_shoulders(d)) {
    if (!part::has_tolerance(d, shoulder.id)) continue;
    const auto s = place(
        p, shoulder.id,
        tr("it is faced in the setup that bores the wider bore, and none does"),
        [&](std::size_t i) {
          return makes(a.setups[i], {true, shoulder.wider});
        },
        a);
    if (s) a.setups[*s].inner_shoulders.push_back(shoulder.wider);
  }
}

// Whether a thread's tool comes in before an outer element in a setup: 1.5 pitches to what
// stands higher than the root towards the free end, cones that rise to the thread apart.
bool has_run_in(const PreparedPart& p, std::size_t s, std::size_t i) {
  constexpr double kPitches = 1.5;
  const auto& outer = p.drawing.outer;
  const auto& thread = outer[i].cut;
  if (!thread || thread->kind != part::CutKind::thread) return true;
  const double D = outer[i].left_mm, root = D - 2 * thread->depth_mm;
  const std::size_t step = holds_left(p, s) ? 1 : SIZE_MAX;
  double room = 0;
  for (std::size_t k = i + step; k < outer.size(); k += step) {
    const auto& e = outer[k];
    const double floor = part::is_groove(e) ? e.cut->drawn.left_mm : INFINITY;
    const double low = std::min({floor, e.left_mm, e.right_mm});
    const double high = std::min(floor, std::max(e.left_mm, e.right_mm));
    if ((low >= root && high > root) || high > D)
      return room >= kPitches * thread->pitch_mm;
    room += e.length_mm;
  }
  return true;
}

// Drawn centre holes at ends that no setup frees.
void assign_centres(const PreparedPart& p, Assignment& a) {
  for (const End end : {End::left, End::right}) {
    const auto frees = [&](const SetupRequest& s) { return s.hold != end; };
    if (part::centre_at(p.drawing, end) && std::ranges::none_of(p.setups, frees))
      a.unreachable.push_back(
          say("the centre hole at {} cannot be drilled in any setup: its end is held",
              end == End::left ? "left" : "right"));
  }
}

// Grooves go to the setup that makes the elements at their rims where the blade cuts the
// chamfers there.
void follow_rims(const PreparedPart& p, Assignment& a) {
  const auto& outer = p.drawing.outer;
  const auto made_in = [&](std::size_t i) {
    std::size_t s = 0;
    while (s < a.setups.size() &&
           std::ranges::find(a.setups[s].elements, i) == a.setups[s].elements.end())
      ++s;
    return s;
  };
  const auto by_blade = [](const auto& chamfer) { return chamfer && chamfer->by_blade; };
  for (std::size_t i = 0; i < outer.size(); ++i) {
    if (!part::is_groove(outer[i])) continue;
    const std::size_t own = made_in(i);
    std::size_t last = own;
    if (i > 0 && by_blade(outer[i - 1].right_chamfer))
      last = std::max(last, made_in(i - 1));
    if (i + 1 < outer.size() && by_blade(outer[i + 1].left_chamfer))
      last = std::max(last, made_in(i + 1));
    if (last == own || last == a.setups.size() || !reachable(p, last, i)) continue;
    std::erase(a.setups[own].elements, i);
    auto& later = a.setups[last].elements;
    later.insert(std::ranges::lower_bound(later, i), i);
  }
}

}  // namespace

Assignment assign(const PreparedPart& p) {
  Assignment a;
  a.setups.resize(p.setups.size());
  const auto& outer = p.drawing.outer;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    if (outer[i].as_stock) continue;
    const auto can = [&](std::size_t s) {
      return reachable(p, s, i) && cleared(p, s, i) && before_jaws(p, s, i).enough();
    };
    const auto threads_too = [&](std::size_t s) { return can(s) && has_run_in(p, s, i); };
    bool somewhere = false;
    for (std::size_t s = 0; s < p.setups.size(); ++s)
      somewhere = somewhere || (wanted_in(p, s, outer[i].id) && threads_too(s));
    const auto asked = [&](std::size_t s) { return somewhere ? threads_too(s) : can(s); };
    if (const auto s = place(p, outer[i].id, why_not(p, i), asked, a))
      a.setups[*s].elements.push_back(i);
  }
  if (!p.operations) follow_rims(p, a);
  const auto& inner = p.drawing.inner;
  for (std::size_t i = 0; i < inner.size(); ++i)
    if (const auto s = place(
            p, inner[i].id, tr("its end is held, or it lies behind a narrower bore"),
            [&](std::size_t k) { return bore_reachable(p, k, i); }, a))
      a.setups[*s].bores.push_back(i);
  for (std::size_t s = 0; s < p.setups.size(); ++s)
    if (holds_left(p, s))
      std::reverse(a.setups[s].elements.begin(), a.setups[s].elements.end());
  assign_faces(p, a);
  assign_centres(p, a);
  for (const auto& not_cut :
       {assign_chamfers(p, a.setups), undercuts_not_cut(p, a.setups)})
    a.unreachable.insert(a.unreachable.end(), not_cut.begin(), not_cut.end());
  return a;
}

}  // namespace turnwright::planning
