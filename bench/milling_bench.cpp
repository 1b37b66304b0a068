// Charts of the benchmark tool beside our own first-order semi-discretisation.
#include <benchmark/benchmark.h>

#include "turnwright/base/units.hpp"
#include "turnwright/milling/checks.hpp"

namespace turnwright::milling {
namespace {

/// 922 Hz, zeta 0.011, 0.03993 kg, two teeth; `axes` 1 or 2.
System tool(std::int64_t axes, double immersion) {
  const double wn = 922 * 2 * units::kPi;
  const Engagement cut = down_milling(immersion);
  System s{.modes = {},
           .teeth = 2,
           .entry_rad = cut.entry_rad,
           .exit_rad = cut.exit_rad,
           .force = LinearForce{.Kt_MPa = 600, .Kn_MPa = 200}};
  for (std::int64_t i = 0; i < axes; ++i)
    s.modes.push_back({.axis = i == 0 ? Axis::x : Axis::y,
                       .wn_rad_s = wn,
                       .zeta = 0.011,
                       .k_N_mm = 0.03993 * wn * wn / 1000});
  return s;
}

constexpr int kSpeeds = 200;
double speed(int i) { return 5000 + 20000.0 * i / (kSpeeds - 1); }

struct Chart {
  std::int64_t axes;
  double immersion, deepest_mm;
};
constexpr Chart kCharts[] = {{1, 0.1, 6}, {1, 1, 2}, {2, 0.1, 4}, {2, 1, 0.3}};

/// 200 speeds, all crossings.
void boundary(benchmark::State& state) {
  const Chart& chart = kCharts[state.range(0)];
  const System s = tool(chart.axes, chart.immersion);
  for (auto _ : state)
    for (int i = 0; i < kSpeeds; ++i)
      benchmark::DoNotOptimize(speed_limits(s, speed(i), chart.deepest_mm));
}
BENCHMARK(boundary)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);

/// One cut by 40 intervals; a chart of 200 x 100 cuts takes 20000 times as long.
void semi_discretised_cut(benchmark::State& state) {
  const Chart& chart = kCharts[state.range(0)];
  const System s = tool(chart.axes, chart.immersion);
  for (auto _ : state)
    benchmark::DoNotOptimize(semi_discretisation(s, 12000, chart.deepest_mm / 2, 40));
}
BENCHMARK(semi_discretised_cut)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace turnwright::milling

BENCHMARK_MAIN();
