#include "contour.hpp"

#include <algorithm>

namespace turnwright::report {
namespace {

using part::End;
using planning::Assignment;
using planning::PartPlan;

constexpr double kNothing_mm = 1e-9;  // shorter runs are rounding of sums of lengths

bool faced(const PartPlan& p, const Assignment& work, std::size_t setup, End end) {
  for (std::size_t s = 0; s <= setup; ++s)
    if (work.setups[s].end_face && p.setups[s].hold != end) return true;
  return false;
}

// A stub beyond the last element is cut with it.
void add_stubs(Runs& outer, double left_z, double right_z, double L) {
  const Run first = outer.front(), last = outer.back();
  if (left_z < -kNothing_mm) outer.insert(outer.begin(), {left_z, 0, first.r0, first.r0});
  if (right_z > L + kNothing_mm) outer.push_back({L, right_z, last.r1, last.r1});
}

Runs bores(const part::Drawing& d, const std::vector<bool>& finished, double left_z,
           double right_z) {
  const double hole = d.stock.inner_mm / 2;
  Runs cut;
  for (std::size_t i = 0; i < d.inner.size(); ++i)
    if (finished[i]) cut.push_back(inner_run(d, i));
  std::sort(cut.begin(), cut.end(),
            [](const Run& a, const Run& b) { return a.z0 < b.z0; });
  Runs all;
  double z = left_z;
  for (auto run : cut) {
    if (run.z0 > z + kNothing_mm) all.push_back({z, run.z0, hole, hole});
    all.push_back(run);
    z = run.z1;
  }
  if (right_z > z + kNothing_mm) all.push_back({z, right_z, hole, hole});
  return all;
}

}  // namespace

Run outer_run(const part::Drawing& d, std::size_t i) {
  const double z0 = part::left_z_mm(d, i);
  const auto& e = d.outer[i];
  return {z0, z0 + e.length_mm, e.left_mm / 2, e.right_mm / 2};
}

Run inner_run(const part::Drawing& d, std::size_t i) {
  const double z0 = part::inner_left_z_mm(d, i);
  const auto& e = d.inner[i];
  return {z0, z0 + e.length_mm, e.left_mm / 2, e.right_mm / 2};
}

Contour contour_after(const PartPlan& p, const Assignment& work, std::size_t setup) {
  const auto& d = p.drawing;
  auto finished = planning::nothing_finished(d);
  for (std::size_t s = 0; s <= setup; ++s) planning::finish(finished, work.setups[s]);
  const double L = part::length_mm(d), stock = d.stock.outer_mm / 2;
  const double left_z = faced(p, work, setup, End::left) ? 0 : -d.stock.left_allowance_mm;
  const double right_z =
      L + (faced(p, work, setup, End::right) ? 0 : part::right_allowance_mm(d));
  Contour c;
  for (std::size_t i = 0; i < d.outer.size(); ++i) {
    auto run = outer_run(d, i);
    if (!finished.outer[i]) run.r0 = run.r1 = stock;
    c.outer.push_back(run);
  }
  add_stubs(c.outer, left_z, right_z, L);
  c.inner = bores(d, finished.inner, left_z, right_z);
  return c;
}

double radius_mm(const Run& run, double z) {
  return run.r0 + (run.r1 - run.r0) * (z - run.z0) / (run.z1 - run.z0);
}

Runs between(const Runs& runs, double from_z, double to_z) {
  Runs part;
  for (const auto& run : runs) {
    const double z0 = std::max(run.z0, from_z), z1 = std::min(run.z1, to_z);
    if (z1 - z0 > kNothing_mm)
      part.push_back({z0, z1, radius_mm(run, z0), radius_mm(run, z1)});
  }
  return part;
}

}  // namespace turnwright::report
