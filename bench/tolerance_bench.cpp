// The budget of a whole part: ten tolerances, ten sources each, 1e5 draws, with one
// thread or two (elapsed time).
// Wanted: ten_tolerances 2 s.
#include <benchmark/benchmark.h>

#include <limits>
#include <vector>

#include "turnwright/tolerance/budget.hpp"

namespace turnwright::tolerance {
namespace {

std::vector<Source> sources() {
  using enum Distribution;
  return {{.name = "machine geometry", .distribution = uniform, .value_um = 4},
          {.name = "force", .value_um = 0.12, .sensitivity = 15},
          {.name = "stiffness", .value_um = 0.1, .sensitivity = 15},
          {.name = "thermal drift", .distribution = arcsine, .value_um = 3},
          {.name = "wear between offsets", .distribution = uniform, .value_um = 2},
          {.name = "last offset", .distribution = fixed, .value_um = 1},
          {.name = "repeatability", .value_um = 0.8},
          {.name = "chucking", .distribution = rayleigh, .value_um = 1.5},
          {.name = "setting", .distribution = triangular, .value_um = 2},
          {.name = "measurement", .value_um = 0.7}};
}

void ten_tolerances(benchmark::State& state) {
  BudgetDemand demand{.sources = sources(), .measurement_U_um = 1.4};
  demand.draws.threads = static_cast<unsigned>(state.range(0));
  for (auto _ : state)
    for (int i = 0; i < 10; ++i) {
      demand.draws.seed = static_cast<std::uint64_t>(i);
      const double down = i % 2 ? -20.0 : -std::numeric_limits<double>::infinity();
      benchmark::DoNotOptimize(budget(demand, {down, 20}));
    }
}
BENCHMARK(ten_tolerances)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace turnwright::tolerance

BENCHMARK_MAIN();
