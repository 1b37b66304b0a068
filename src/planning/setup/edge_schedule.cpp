#include "edge_schedule.hpp"

#include <algorithm>
#include <cmath>

#include "planning/values/tool_label.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::planning {
namespace {

constexpr double kNearlyWhole = 1e-12;
constexpr double kIncrement_um = 1;  // of controls, on the diameter
constexpr double kMostSteps = 1000;
constexpr double kMostParts = 1e15;  // a whole number

long whole_parts(double parts) {
  return static_cast<long>(std::floor(std::min(parts * (1 + kNearlyWhole), kMostParts)));
}

long begun(double edges) {
  return static_cast<long>(std::ceil(edges * (1 - kNearlyWhole)));
}

// A surface of a size whose offset moves by so much over the life of an edge: Eq. (2).
struct Moving {
  std::string on;
  double by_um = 0;
};

double against_deflection_mm(const std::vector<ToolOffset>& offsets, std::size_t setup,
                             const std::string& on) {
  for (const auto& o : offsets)
    if (o.setup == setup && o.on == on && o.at_change_mm)
      return *o.at_change_mm - o.offset_mm;
  return 0;
}

bool has_size(const PreparedPart& p, const SolvedSurface& f) {
  return std::ranges::any_of(f.task.cut_tolerances, [&](const CutTolerance& d) {
    return part::has_two_ends(p.drawing.tolerances[d.tolerance].kind);
  });
}

std::vector<Moving> moving(const PreparedPart& p, const SolvedSetup& s,
                           const std::string& tool,
                           const std::vector<ToolOffset>& offsets) {
  std::vector<Moving> all;
  for (const auto& f : s.features) {
    const auto* last = f.task.making.last;
    if (!last || last->id != tool || !has_size(p, f)) continue;
    const auto& feature = f.task.feature;
    const double radial_mm = against_deflection_mm(offsets, s.setup, feature.surface()) -
                             feature.sign() * recession_mm(p, *last, 1);
    const double by_um = units::um_from_mm(radial_mm) * (feature.is_face() ? 1 : 2);
    if (by_um != 0) all.push_back({feature.surface(), by_um});
  }
  return all;
}

// Parts from one correction to the next: Eq. (3).
long parts_between(const PreparedPart& p, const EdgeSchedule& e,
                   const std::vector<Moving>& all) {
  double most_um = 0;
  for (const auto& m : all) most_um = std::max(most_um, std::abs(m.by_um));
  const double share =
      std::max({p.shop.life_between_offsets, kIncrement_um / most_um, 1 / kMostSteps});
  return std::max(1L, whole_parts(share / e.edges_per_part));
}

FollowedOffset followed(const Moving& surface, const EdgeSchedule& e, long between,
                        long last_part) {
  FollowedOffset o{surface.on, {}};
  for (long i = 0; i < last_part; i += between) {
    const long next = i + std::min(between, e.parts_per_edge - i);
    const double middle = static_cast<double>(i + next) / 2;
    o.steps.push_back({i, surface.by_um * e.edges_per_part * middle});  // Eq. (4)
  }
  return o;
}

void schedule(const PreparedPart& p, std::vector<Moving> sizes, EdgeSchedule& e) {
  e.parts_per_edge = *parts_until(1, e.edges_per_part);
  if (p.batch)
    e.edges_per_batch =
        begun(e.parts_per_edge > 0 ? *p.batch / static_cast<double>(e.parts_per_edge)
                                   : *p.batch * e.edges_per_part);
  if (sizes.empty()) return;
  const long between = parts_between(p, e, sizes);
  const long last =
      p.batch ? std::min(e.parts_per_edge, whole_parts(*p.batch)) : e.parts_per_edge;
  for (const auto& surface : sizes)
    if (last > 0) e.offsets.push_back(followed(surface, e, between, last));
}

}  // namespace

std::optional<long> parts_until(double share, double per_part) {
  if (!(per_part > 0) || !(share > 0)) return std::nullopt;
  return whole_parts(share / per_part);
}

std::vector<EdgeSchedule> edge_schedules(const PreparedPart& p, const SolvedSetup& s,
                                         const std::vector<OperationPlan>& operations,
                                         const std::vector<ToolOffset>& offsets) {
  std::vector<EdgeSchedule> all;
  for (const auto& o : operations) {
    if (!(o.edges > 0)) continue;
    const auto label = tool_label(p, o);
    auto e = std::ranges::find(all, label, &EdgeSchedule::tool);
    if (e == all.end()) e = all.insert(e, EdgeSchedule{label});
    e->edges_per_part += o.edges;
  }
  for (auto& e : all) schedule(p, moving(p, s, e.tool, offsets), e);
  return all;
}

}  // namespace turnwright::planning
