#include "reach.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "planning/clamping/made_surfaces.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/paths/edges.hpp"
#include "planning/paths/pass_lengths.hpp"
#include "planning/values/surface_request.hpp"

namespace turnwright::planning {
namespace {

using part::End;

std::size_t place_of(End end) { return end == End::left ? 0 : 1; }

// From the free end inwards, held at the other.
std::vector<bool> open_to(const part::Drawing& d, End free) {
  const auto& outer = d.outer;
  const std::size_t n = outer.size();
  std::vector<bool> open(n);
  double largest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = free == End::left ? k : n - 1 - k;
    const auto& e = outer[i];
    const double outward = free == End::left ? e.left_mm : e.right_mm;
    const double inward = free == End::left ? e.right_mm : e.left_mm;
    open[i] = outward <= inward && largest <= outward + 1e-9;
    largest = std::max({largest, e.left_mm, e.right_mm});
  }
  return open;
}

bool has_run_in(const part::Drawing& d, End free, std::size_t i) {
  constexpr double kPitches = 1.5;
  const auto& outer = d.outer;
  const auto& thread = outer[i].cut;
  if (!thread || thread->kind != part::CutKind::thread) return true;
  const double D = outer[i].left_mm, root = thread->core.left_mm;
  const std::size_t step = free == End::right ? 1 : SIZE_MAX;
  double room = 0;
  for (std::size_t k = i + step; k < outer.size(); k += step) {
    const auto& e = outer[k];
    const double floor = part::is_groove(e) ? e.cut->core.left_mm : INFINITY;
    const double low = std::min({floor, e.left_mm, e.right_mm});
    const double high = std::min(floor, std::max(e.left_mm, e.right_mm));
    if ((low >= root && high > root) || high > D)
      return room >= kPitches * thread->pitch_mm;
    room += e.length_mm;
  }
  return true;
}

std::vector<SeenOuter> seen_from(const PreparedPart& p, End free, double corner_mm) {
  std::vector<SeenOuter> all(p.drawing.outer.size());
  const auto open = open_to(p.drawing, free);
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].open = open[i];
    all[i].has_run_in = has_run_in(p.drawing, free, i);
  }
  // What stands behind an element is the same for all setups that hold one end.
  std::size_t setup = 0;
  while (setup < p.setups.size() && p.setups[setup].hold == free) ++setup;
  if (setup == p.setups.size()) return all;
  const auto around = outer_surroundings(p, setup, Clamping::chuck, {});
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].to_z_mm = around[i].z1;
    all[i].needed_mm = needed_beyond_mm(around[i], corner_mm);
    all[i].level_behind = around[i].level_behind;
  }
  return all;
}

std::vector<bool> bores_from(const part::Drawing& d, End free) {
  std::vector<bool> all;
  double narrowest = INFINITY;
  for (const auto& e : d.inner) {
    if (e.from != free) {
      all.push_back(false);
      continue;
    }
    const double opening = free == End::right ? e.right_mm : e.left_mm;
    const double deep = free == End::right ? e.left_mm : e.right_mm;
    all.push_back(deep <= opening && narrowest >= opening - 1e-9);
    narrowest = std::min({narrowest, e.left_mm, e.right_mm});
  }
  return all;
}

// The faces that the drawing names, and what its tolerances are on.
std::unordered_set<std::string> named_faces(const part::Drawing& d) {
  std::unordered_set<std::string> all;
  for (const auto& f : d.faces) all.insert(f.id);
  for (const auto& t : d.tolerances) all.insert({t.of, t.between[0], t.between[1]});
  return all;
}

// Whether turning cuts the edge of a shoulder, with which plans may face it
// (assign_edges_in_stock).
bool has_edge(const part::Drawing& d, std::size_t k) {
  const auto &left = d.outer[k - 1], &right = d.outer[k];
  return turned(right.left_mm > left.right_mm ? right.left_chamfer : left.right_chamfer)
      .has_value();
}

}  // namespace

Ways::Ways(const PreparedPart& p) : left_mm(part::left_ends_mm(p.drawing)) {
  const auto& d = p.drawing;
  double corner_mm = INFINITY;
  for (const auto* t : tools_for(p, catalogue::ToolUse::finishing))
    corner_mm = std::min(corner_mm, t->re_mm);
  finishes = std::isfinite(corner_mm);
  for (const End held : {End::left, End::right}) {
    outer[place_of(held)] = seen_from(p, part::opposite(held), finishes ? corner_mm : 0);
    bores[place_of(held)] = bores_from(d, part::opposite(held));
  }
  named = named_faces(d);
  if (p.operations) look_up_operations(p);
  look_up_shoulders(p);
}

void Ways::look_up_operations(const PreparedPart& p) {
  std::map<std::string, std::size_t> inner;
  for (const auto& e : p.drawing.inner) {
    inner.emplace(e.id, place_of(e.from));
    if (part::is_hole(e)) holes_.emplace(e.id, place_of(e.from));
  }
  asked_.emplace(p.setups.size());
  for (const auto& o : *p.operations)
    for (const auto& id : o.on) {
      auto& asked = asked_->at(o.setup);
      if (o.kind != OperationKind::fixed)
        asked.cut.insert(id);
      else if (const auto from = inner.find(id); from != inner.end())
        asked.drilled[from->second] = true;
    }
}

void Ways::look_up_shoulders(const PreparedPart& p) {
  const auto& d = p.drawing;
  const auto asked_for = [&](const std::string& id) {
    for (std::size_t s = 0; s < p.setups.size(); ++s)
      if (wanted(s, id)) return true;
    return false;
  };
  for (std::size_t k = 1; k < d.outer.size(); ++k) {
    const auto id = shoulder_id(d, k);
    if (d.outer[k - 1].right_mm == d.outer[k].left_mm) continue;
    const bool asked = p.operations && asked_for(id);
    if (!named.contains(id) && !(asked && has_edge(d, k))) continue;
    if (made_with_undercut(d, k) && !asked) continue;
    shoulders.push_back({k, id});
  }
  for (const auto& s : part::inner_shoulders(d))
    if (part::has_tolerance(d, s.id)) inner_shoulders.push_back({s.wider, s.id});
}

bool Ways::wanted(std::size_t setup, const std::string& surface) const {
  if (!asked_) return true;
  const auto& asked = (*asked_)[setup];
  if (const auto hole = holes_.find(surface); hole != holes_.end())
    return asked.drilled[hole->second];
  return asked.cut.contains(surface);
}

Reach::Reach(const PreparedPart& p, const Ways& ways) : p_(p), ways_(ways) {
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    jaws_z_mm_.push_back(planning::jaws_z_mm(p, s));
    free_z_mm_.push_back(planning::free_z_mm(p, s));
  }
}

const SeenOuter& Reach::seen(std::size_t s, std::size_t i) const {
  return ways_.outer[place_of(p_.setups[s].hold)][i];
}

bool Reach::outer(std::size_t s, std::size_t i) const {
  const double z0 = ways_.left_mm[i], z1 = z0 + p_.drawing.outer[i].length_mm;
  const double jaws = jaws_z_mm_[s];
  return !(holds_left(p_, s) ? z0 < jaws - 1e-9 : z1 > jaws + 1e-9) && seen(s, i).open;
}

bool Reach::bore(std::size_t s, std::size_t i) const {
  return ways_.bores[place_of(p_.setups[s].hold)][i];
}

bool Reach::has_run_in(std::size_t s, std::size_t i) const {
  return seen(s, i).has_run_in;
}

BeforeJaws Reach::before_jaws(std::size_t s, std::size_t i) const {
  const auto& clampings = p_.setups[s].clampings;
  if (p_.drawing.outer[i].cut || !ways_.finishes ||
      std::ranges::find(clampings, Clamping::between_centres) != clampings.end())
    return {};
  const auto& e = seen(s, i);
  if (e.level_behind) {
    bool made_before = false;
    for (std::size_t t = 0; t < s; ++t) made_before |= outer(t, *e.level_behind);
    if (!made_before) return {};
  }
  const double jaws = jaws_z_mm_[s] - free_z_mm_[s];
  return {e.needed_mm, e.to_z_mm - (holds_left(p_, s) ? jaws : -jaws)};
}

}  // namespace turnwright::planning
