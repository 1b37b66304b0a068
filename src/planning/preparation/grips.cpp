#include "grips.hpp"

#include <algorithm>
#include <cmath>

#include "assignment.hpp"
#include "planning/clamping/positions.hpp"

namespace turnwright::planning {
namespace {

constexpr double kUsual_mm = 15, kLeast_mm = 5, kWorth_mm = 1;
constexpr double kOverhang_diameters = 3;
constexpr double kRunOut_mm = 2;  // what the jaws end before, for the tool to run out
constexpr double kDigit_mm = 0.1;

// Width of the narrowest blade that parts off the stock; 0 without one.
double parting_blade_mm(const PlanRequest& r) {
  const double deep = (r.drawing.stock.outer_mm - r.drawing.stock.inner_mm) / 2;
  double least = 0;
  for (const auto& t : r.fixed_tools)
    if (t.use == catalogue::FixedUse::parting && t.conditions_in(r.material.group) &&
        deep <= t.reach && (least == 0 || t.sizes_mm.front() < least))
      least = t.sizes_mm.front();
  return least;
}

// What the jaws may hold of a stock from which a setup parts the part off, for the blade to
// come between; infinite without.
double before_blade_mm(const PlanRequest& r, std::size_t s) {
  const auto& stock = r.drawing.stock;
  if (s > 0 || !stock.parted_mm) return INFINITY;
  const double behind = r.setups[s].hold == part::End::left
                            ? stock.left_allowance_mm
                            : part::right_allowance_mm(r.drawing);
  return behind - *stock.parted_mm - parting_blade_mm(r) - kRunOut_mm;
}

// Length of the stock that is level from the held end on.
double level_stock_mm(const PlanRequest& r, std::size_t s) {
  const auto& stock = r.drawing.stock;
  if (stock.outline.empty()) return stock.length_mm;
  return r.setups[s].hold == part::End::left ? stock.outline.front().length_mm
                                             : stock.outline.back().length_mm;
}

double usual_mm(const PlanRequest& r, std::size_t s) {
  const double held = part::held_mm(r.drawing, s, r.setups[s].hold);
  const double length = s == 0 ? r.drawing.stock.length_mm : part::length_mm(r.drawing);
  const double level = s == 0 ? level_stock_mm(r, s) : length;
  const double usual = std::min({std::max(kUsual_mm, held / 2), length / 2, level});
  const double most = before_blade_mm(r, s);
  return most < kLeast_mm ? usual : std::min(usual, most);
}

// z of the end of what the jaws can hold without a step, a groove or a milled place.
double level_to_mm(const PreparedPart& p, std::size_t s) {
  const auto& e = p.drawing.outer;
  const bool left = holds_left(p, s);
  const double free = free_z_mm(p, s);
  if (s == 0) {
    const double level = level_stock_mm(p, s), L = part::length_mm(p.drawing);
    return left ? std::min(free, level - p.drawing.stock.left_allowance_mm)
                : std::max(free, L + part::right_allowance_mm(p.drawing) - level);
  }
  const auto element = [&](std::size_t k) { return left ? k : e.size() - 1 - k; };
  double to = part::length_mm(p.drawing) - free;
  for (std::size_t k = 0; k < e.size(); ++k) {
    const auto& x = e[element(k)];
    if (x.cut || x.left_mm != x.right_mm || x.left_mm != e[element(0)].left_mm) break;
    to += left ? x.length_mm : -x.length_mm;
  }
  for (const auto& m : p.milled)
    to = left ? std::min(to, m.z_mm) : std::max(to, m.z_mm + m.length_mm);
  return to;
}

// A grip that leaves an overhang of three diameters, where the setup cuts no more of it.
void lengthen(PreparedPart& p, const Ways& ways, std::size_t s) {
  const double overhang = std::abs(free_z_mm(p, s) - root_z_mm(p, s, Clamping::chuck));
  const double beyond =
      overhang - kOverhang_diameters * part::held_mm(p.drawing, s, p.setups[s].hold);
  const auto longest = longer_grip_mm(p, s);
  if (!longest || beyond < kWorth_mm) return;
  const double before = p.grips_mm[s];
  p.grips_mm[s] =
      std::min(*longest, std::ceil((before + beyond) / kDigit_mm - 1e-6) * kDigit_mm);
  if (assign(p, ways) != p.work) p.grips_mm[s] = before;
}

// One grip shorter, in the first setup that leaves it open and where that helps; false if
// it helps in none.
bool shortened(PreparedPart& p, const Ways& ways) {
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    if (p.setups[s].grip_mm) continue;
    const double before = p.grips_mm[s];
    for (const double grip : shorter_grips_mm(p, s)) {
      p.grips_mm[s] = grip;
      if (left_out(p, ways) < p.work.unreachable.size()) {
        p.work = assign(p, ways);
        return true;
      }
      p.grips_mm[s] = before;
    }
  }
  return false;
}

}  // namespace

std::vector<double> shorter_grips_mm(const PreparedPart& p, std::size_t s) {
  const bool left = p.setups[s].hold == part::End::left;
  const double end = root_z_mm(p, s, Clamping::chuck);
  const auto left_ends = part::left_ends_mm(p.drawing);
  std::vector<double> all;
  for (std::size_t i = 0; i < p.drawing.outer.size(); ++i) {
    const double z0 = left_ends[i];
    const double z = left ? z0 : z0 + p.drawing.outer[i].length_mm;  // nearer the jaws
    const double shorter = (left ? end - z : z - end) + kRunOut_mm;
    const double grip =
        std::floor((p.grips_mm[s] - shorter) / kDigit_mm + 1e-6) * kDigit_mm;
    if (shorter > kRunOut_mm && grip >= kLeast_mm) all.push_back(grip);
  }
  std::ranges::sort(all, std::greater<>());
  return all;
}

std::optional<double> longer_grip_mm(const PreparedPart& p, std::size_t s) {
  const auto& work = p.work.setups[s];
  if (work.elements.empty()) return {};
  const double root = root_z_mm(p, s, Clamping::chuck), free = free_z_mm(p, s);
  double room = (level_to_mm(p, s) - root) * (free > root ? 1 : -1);
  double corner = 0;
  for (const auto& t : p.tools) corner = std::max(corner, t.re_mm);
  const auto left_ends = part::left_ends_mm(p.drawing);
  for (const std::size_t i : work.elements) {
    const double z0 = left_ends[i];
    const double z1 = z0 + p.drawing.outer[i].length_mm;
    room = std::min(room, (free > root ? z0 - root : root - z1) - corner);
  }
  if (const auto& parted = p.drawing.stock.parted_mm; parted && s == 0)
    room = std::min(room, (free > root ? -root : root - part::length_mm(p.drawing)) -
                              *parted - parting_blade_mm(p) - kRunOut_mm);
  const auto& clampings = p.setups[s].clampings;
  if (std::ranges::find(clampings, Clamping::chuck_steady) != clampings.end())
    room = std::min(room, std::abs(p.setups[s].steady_z_mm - root) - kSteadyWidth_mm / 2);
  const double grip = std::floor((p.grips_mm[s] + room) / kDigit_mm) * kDigit_mm;
  if (grip < p.grips_mm[s] + kWorth_mm) return {};
  return grip;
}

void choose_grips(PreparedPart& p) {
  for (std::size_t s = 0; s < p.setups.size(); ++s)
    p.grips_mm.push_back(p.setups[s].grip_mm.value_or(usual_mm(p, s)));
  const Ways ways(p);
  p.work = assign(p, ways);
  while (!p.work.unreachable.empty() && shortened(p, ways)) {
  }
  for (std::size_t s = 0; s < p.setups.size(); ++s)
    if (!p.setups[s].grip_mm) lengthen(p, ways, s);
}

}  // namespace turnwright::planning
