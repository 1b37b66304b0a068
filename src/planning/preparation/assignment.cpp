#include "assignment.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/say.hpp"
#include "edge_assignment.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/paths/edges.hpp"
#include "planning/values/readable.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::planning {
namespace {

using part::End;

// What each setup makes, and why it is not made, for each surface that none can cut.
struct Placed {
  std::vector<SetupWork> setups;
  std::vector<Reason> unreachable;
};

// The first setup that may and can make a surface; if there is none, adds the reason.
template <class Can>
std::optional<std::size_t> place(const PreparedPart& p, const Reach& reach,
                                 const std::string& surface, const Reason& why,
                                 const Can& can, Placed& a) {
  bool asked = false;
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    if (!reach.ways().wanted(s, surface)) continue;
    asked = true;
    if (can(s)) return s;
  }
  a.unreachable.emplace_back([&p, &surface, why, asked] {
    return !asked ? say("{} has no operation: it would stay as the stock is", surface)
           : p.operations ? say("{} cannot be cut in the setup of its operations: {}",
                                surface, why())
                          : say("{} cannot be cut in any setup: {}", surface, why());
  });
  return {};
}

// Why no setup can cut an outer element.
std::string why_not(const PreparedPart& p, const Reach& reach, std::size_t i) {
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    if (!reach.ways().wanted(s, p.drawing.outer[i].id) || !reach.outer(s, i)) continue;
    if (!cleared(p, s, i))
      return say(
          "towards the chuck it falls by more than the {:.4g} deg that profiling tools "
          "are taken to clear",
          units::deg_from_rad(part::kProfilingClears_rad));
    const auto room = reach.before_jaws(s, i);
    const auto [left, needed] = readable_apart(room.left_mm, room.needed_mm);
    return say(
        "in {} it ends {} mm before the jaws, its tool's corner needs {} mm: grip less",
        setup_label(s), left, needed);
  }
  return tr("it lies in the jaws, or behind a larger diameter");
}

const std::string& face_id(End end) {
  static const std::string left = "left", right = "right";
  return end == End::left ? left : right;
}

void assign_end_faces(const PreparedPart& p, const Reach& reach, Placed& a) {
  for (const End end : {End::left, End::right}) {
    if (!(face_stock_mm(p, end) > 1e-9)) continue;
    const auto& id = face_id(end);
    const auto free = [&](std::size_t s) { return p.setups[s].hold != end; };
    bool open = reach.ways().named.contains(id);  // else it may stay as it is
    for (std::size_t s = 0; s < p.setups.size(); ++s)
      open = open || (free(s) && reach.ways().wanted(s, id));
    if (!open) continue;
    const auto why = [] { return tr("its end is held"); };
    if (const auto s = place(p, reach, id, why, free, a)) a.setups[*s].end_face = true;
  }
}

void assign_shoulders(const PreparedPart& p, const Reach& reach, Placed& a) {
  const auto& outer = p.drawing.outer;
  for (const auto& [k, id] : reach.ways().shoulders) {
    const std::size_t smaller = outer[k - 1].right_mm > outer[k].left_mm ? k : k - 1;
    const auto s = place(
        p, reach, id,
        [] {
          return tr(
              "it is faced in the setup that turns the smaller element beside it, and "
              "none does");
        },
        [&](std::size_t i) {
          return makes(a.setups[i], {false, smaller});
        },
        a);
    if (s) a.setups[*s].shoulders.push_back(k);
  }
  for (const auto& [wider, id] : reach.ways().inner_shoulders) {
    const auto s = place(
        p, reach, id,
        [] {
          return tr("it is faced in the setup that bores the wider bore, and none does");
        },
        [&](std::size_t i) {
          return makes(a.setups[i], {true, wider});
        },
        a);
    if (s) a.setups[*s].inner_shoulders.push_back(wider);
  }
}

// Drawn centre holes at ends that no setup frees.
void assign_centres(const PreparedPart& p, Placed& a) {
  for (const End end : {End::left, End::right}) {
    const auto frees = [&](const SetupRequest& s) { return s.hold != end; };
    if (part::centre_at(p.drawing, end) && std::ranges::none_of(p.setups, frees))
      a.unreachable.emplace_back([end] {
        return say(
            "the centre hole at {} cannot be drilled in any setup: its end is held",
            face_id(end));
      });
  }
}

// Grooves go to the setup that makes the elements at their rims where the blade cuts the
// chamfers there.
void follow_rims(const PreparedPart& p, const Reach& reach, Placed& a) {
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
    if (last == own || last == a.setups.size() || !reach.outer(last, i)) continue;
    std::erase(a.setups[own].elements, i);
    auto& later = a.setups[last].elements;
    later.insert(std::ranges::lower_bound(later, i), i);
  }
}

void assign_outer(const PreparedPart& p, const Reach& reach, Placed& a) {
  const auto& outer = p.drawing.outer;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    if (outer[i].as_stock) continue;
    const auto can = [&](std::size_t s) {
      return reach.outer(s, i) && cleared(p, s, i) && reach.before_jaws(s, i).enough();
    };
    const auto threads_too = [&](std::size_t s) {
      return can(s) && reach.has_run_in(s, i);
    };
    bool somewhere = false;
    for (std::size_t s = 0; s < p.setups.size(); ++s)
      somewhere = somewhere || (reach.ways().wanted(s, outer[i].id) && threads_too(s));
    const auto asked = [&](std::size_t s) { return somewhere ? threads_too(s) : can(s); };
    const auto why = [&p, &reach, i] { return why_not(p, reach, i); };
    if (const auto s = place(p, reach, outer[i].id, why, asked, a))
      a.setups[*s].elements.push_back(i);
  }
}

void assign_bores(const PreparedPart& p, const Reach& reach, Placed& a) {
  const auto& inner = p.drawing.inner;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    const auto why = [] {
      return tr("its end is held, or it lies behind a narrower bore");
    };
    const auto can = [&](std::size_t s) { return reach.bore(s, i); };
    if (const auto s = place(p, reach, inner[i].id, why, can, a))
      a.setups[*s].bores.push_back(i);
  }
}

Placed placed(const PreparedPart& p, const Reach& reach) {
  leave_if_asked();
  Placed a;
  a.setups.resize(p.setups.size());
  assign_outer(p, reach, a);
  if (!p.operations) follow_rims(p, reach, a);
  assign_bores(p, reach, a);
  for (std::size_t s = 0; s < p.setups.size(); ++s)
    if (holds_left(p, s))
      std::reverse(a.setups[s].elements.begin(), a.setups[s].elements.end());
  assign_end_faces(p, reach, a);
  assign_shoulders(p, reach, a);
  if (!p.operations) assign_edges_in_stock(p, a.setups);
  assign_centres(p, a);
  for (const auto& not_cut :
       {assign_chamfers(p, a.setups), undercuts_not_cut(p, a.setups)})
    a.unreachable.insert(a.unreachable.end(), not_cut.begin(), not_cut.end());
  return a;
}

}  // namespace

Assignment assign(const PreparedPart& p, const Ways& ways) {
  const Reach reach(p, ways);
  auto all = placed(p, reach);
  Assignment a{std::move(all.setups), {}};
  for (const auto& reason : all.unreachable) a.unreachable.push_back(reason());
  return a;
}

Assignment assign(const PreparedPart& p) { return assign(p, Ways(p)); }

std::size_t left_out(const PreparedPart& p, const Ways& ways) {
  return placed(p, Reach(p, ways)).unreachable.size();
}

}  // namespace turnwright::planning
