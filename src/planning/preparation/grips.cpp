#include "grips.hpp"

#include <algorithm>
#include <cmath>

#include "assignment.hpp"
#include "planning/clamping/positions.hpp"

namespace turnwright::planning {
namespace {

constexpr double kUsual_mm = 15, kLeast_mm = 5;
constexpr double kRunOut_mm = 2;  // what the jaws end before, for the tool to run out
constexpr double kDigit_mm = 0.1;

// What the jaws hold: the stock first, finished ends afterwards.
double held_mm(const part::Drawing& d, std::size_t setup, part::End hold) {
  if (setup == 0) return d.stock.outer_mm;
  return hold == part::End::left ? d.outer.front().left_mm : d.outer.back().right_mm;
}

double usual_mm(const PlanRequest& r, std::size_t s) {
  const double held = held_mm(r.drawing, s, r.setups[s].hold);
  const double length = s == 0 ? r.drawing.stock.length_mm : part::length_mm(r.drawing);
  return std::min(std::max(kUsual_mm, held / 2), length / 2);
}

// One grip shorter, in the first setup that leaves it open and where that helps; false if
// it helps in none.
bool shortened(PreparedPart& p) {
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    if (p.setups[s].grip_mm) continue;
    const double before = p.grips_mm[s];
    for (const double grip : shorter_grips_mm(p, s)) {
      p.grips_mm[s] = grip;
      auto work = assign(p);
      if (work.unreachable.size() < p.work.unreachable.size()) {
        p.work = std::move(work);
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
  std::vector<double> all;
  for (std::size_t i = 0; i < p.drawing.outer.size(); ++i) {
    const double z0 = part::left_z_mm(p.drawing, i);
    const double z = left ? z0 : z0 + p.drawing.outer[i].length_mm;  // nearer the jaws
    const double shorter = (left ? end - z : z - end) + kRunOut_mm;
    const double grip =
        std::floor((p.grips_mm[s] - shorter) / kDigit_mm + 1e-6) * kDigit_mm;
    if (shorter > kRunOut_mm && grip >= kLeast_mm) all.push_back(grip);
  }
  std::ranges::sort(all, std::greater<>());
  return all;
}

void choose_grips(PreparedPart& p) {
  for (std::size_t s = 0; s < p.setups.size(); ++s)
    p.grips_mm.push_back(p.setups[s].grip_mm.value_or(usual_mm(p, s)));
  p.work = assign(p);
  while (!p.work.unreachable.empty() && shortened(p)) {
  }
}

}  // namespace turnwright::planning
