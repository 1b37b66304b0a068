// Programs cut in the half section with whole tools: what remains is the drawing.
#include "cut_simulation.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

#include "random_parts.hpp"

namespace turnwright::nc {
namespace {

using namespace test;

std::string all(const std::vector<Finding>& found) {
  std::string s;
  for (const auto& f : found)
    s += fmt::format("  {:30} {:30} {:.5f} at x {:.4f} z {:.4f}\n", test::name(f.fault),
                     f.where, f.mm, f.at.x, f.at.z);
  return s;
}

TEST(CutSimulation, PrintsRandom) {
  int from = atoi(getenv("FROM")), to = atoi(getenv("TO"));
  double plan = 0, sim = 0;
  int made = 0;
  const auto now = [] { return std::chrono::steady_clock::now(); };
  for (int seed = from; seed <= to; ++seed) {
    auto t0 = now();
    const auto p = planned(RandomPart(static_cast<std::uint32_t>(seed)).document());
    auto t1 = now();
    plan += std::chrono::duration<double>(t1 - t0).count();
    if (p.plan.status != planning::PlanStatus::ok) continue;
    ++made;
    if (getenv("WAYS")) {
      fmt::print("{}\n", RandomPart(static_cast<std::uint32_t>(seed)).document().dump());
      for (const auto& pr : programs(p.part, p.plan).setups)
        for (const auto& w : ways_of(pr, p.plan.setups[pr.setup]))
          fmt::print("{} {} {:.4f} {:.4f} -> {:.4f} {:.4f}\n", w.operation,
                     w.rapid ? "G0" : "G1", w.x0, w.z0, w.x1, w.z1);
    }
    const auto found = simulated(p, programs(p.part, p.plan));
    sim += std::chrono::duration<double>(now() - t1).count();
    std::string s;
    for (const auto& f : found)
      if (f.fault != Fault::left && f.fault != Fault::lean && f.fault != Fault::start)
        s += fmt::format("  {:30} {:30} {:.5f} at x {:.4f} z {:.4f}\n",
                         test::name(f.fault), f.where, f.mm, f.at.x, f.at.z);
    fmt::print("seed {}\n{}", seed, s);
  }
  fmt::print("made {} plan {:.1f} s sim {:.1f} s\n", made, plan, sim);
}
TEST(CutSimulation, PrintsAwkward) {
  for (const auto& one : document::parse_file(source("tests/data/awkward_parts.json"))) {
    const auto p = planned(one["part"]);
    if (p.plan.status != planning::PlanStatus::ok) continue;
    fmt::print("{}\n{}", one["part"]["name"].get<std::string>(),
               all(simulated(p, programs(p.part, p.plan))));
  }
}

TEST(CutSimulation, PrintsReferenceParts) {
  for (const auto& name : reference_parts()) {
    if (std::getenv("ONLY") && name != std::getenv("ONLY")) continue;
    const auto p = planned_reference(name);
    if (p.plan.status != planning::PlanStatus::ok) continue;
    if (std::getenv("WAYS"))
      for (const auto& pr : programs(p.part, p.plan).setups)
        for (const auto& w : ways_of(pr, p.plan.setups[pr.setup]))
          fmt::print("{} {} {:.4f} {:.4f} -> {:.4f} {:.4f}\n", w.operation,
                     w.rapid ? "G0" : "G1", w.x0, w.z0, w.x1, w.z1);
    fmt::print("{}\n{}", name, all(simulated(p, programs(p.part, p.plan))));
  }
}

}  // namespace
}  // namespace turnwright::nc
