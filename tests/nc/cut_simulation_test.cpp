// Programs cut in the half section with whole tools: what remains is the drawing.
#include "cut_simulation.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

namespace turnwright::nc {
namespace {

using namespace test;

TEST(CutSimulation, PrintsReferenceParts) {
  for (const auto& name : reference_parts()) {
    const auto p = planned_reference(name);
    if (p.plan.status != planning::PlanStatus::ok) continue;
    if (std::getenv("ONLY") && name != std::getenv("ONLY")) continue;
    if (std::getenv("ONLY"))
      for (const auto& pr : programs(p.part, p.plan).setups)
        for (const auto& w : ways_of(pr, p.plan.setups[pr.setup]))
          fmt::print("{} {} {:.4f} {:.4f} -> {:.4f} {:.4f}\n", w.operation,
                     w.rapid ? "G0" : "G1", w.x0, w.z0, w.x1, w.z1);
    const auto start = std::chrono::steady_clock::now();
    const auto found = simulated(p, programs(p.part, p.plan));
    const double s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    fmt::print("{} ({:.2f} s)\n", name, s);
    for (const auto& f : found)
      fmt::print("  {:30} {:30} {:.5f} at x {:.4f} z {:.4f}\n", test::name(f.fault),
                 f.where, f.mm, f.at.x, f.at.z);
  }
}

}  // namespace
}  // namespace turnwright::nc
