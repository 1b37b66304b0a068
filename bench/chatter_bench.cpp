// Charts of the benchmark tool beside our own first-order semi-discretisation.
// Wanted: boundary/0 3 ms, boundary/1 8 ms, boundary/2 10 ms, boundary/3 12 ms,
// chart/0 15 ms, chart/1 15 ms, chart/2 50 ms, chart/3 50 ms, twenty_speeds/3 5 ms,
// twenty_speeds/4 15 ms.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "turnwright/base/units.hpp"
#include "turnwright/chatter/cutter_limits.hpp"
#include "turnwright/chatter/limits.hpp"
#include "turnwright/chatter/reference_methods.hpp"

namespace turnwright::chatter {
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
double speed(int i, int of = kSpeeds) { return 5000 + 20000.0 * i / (of - 1); }

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

/// The same with certified counts at 100 depths of each speed.
void chart(benchmark::State& state) {
  const Chart& chart = kCharts[state.range(0)];
  const System s = tool(chart.axes, chart.immersion);
  std::vector<double> depths;
  for (int i = 1; i <= 100; ++i) depths.push_back(chart.deepest_mm * i / 100);
  for (auto _ : state)
    for (int i = 0; i < kSpeeds; ++i)
      benchmark::DoNotOptimize(speed_limits(s, speed(i), chart.deepest_mm, depths));
}
BENCHMARK(chart)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);

/// A tool with modes 15 % apart on x and y in turn, a/D 0.1.
System many_modes(std::int64_t modes, int teeth) {
  System s = tool(1, 0.1);
  const Mode first = s.modes[0];
  for (std::int64_t i = 1; i < modes; ++i) {
    s.modes.push_back(first);
    s.modes.back().axis = i % 2 == 0 ? Axis::x : Axis::y;
    s.modes.back().wn_rad_s *= std::pow(1.15, static_cast<double>(i));
  }
  s.teeth = teeth;
  return s;
}

/// 20 speeds of it.
void limits_of_twenty(benchmark::State& state, int teeth) {
  const System s = many_modes(state.range(0), teeth);
  constexpr int kFew = 20;
  for (auto _ : state)
    for (int i = 0; i < kFew; ++i)
      benchmark::DoNotOptimize(speed_limits(s, 5000 + 1000.0 * i, 2));
}
void twenty_speeds(benchmark::State& state) {
  limits_of_twenty(state, static_cast<int>(state.range(1)));
}
BENCHMARK(twenty_speeds)
    ->ArgsProduct({{1, 2, 3, 4}, {1, 2, 4, 8}})
    ->Unit(benchmark::kMillisecond);

void modes_growth(benchmark::State& state) { limits_of_twenty(state, 2); }
BENCHMARK(modes_growth)
    ->Name("modes/growth")
    ->DenseRange(1, 6)
    ->Unit(benchmark::kMillisecond);

/// N speeds of the first chart.
void speeds_growth(benchmark::State& state) {
  const Chart& chart = kCharts[0];
  const System s = tool(chart.axes, chart.immersion);
  const int all = static_cast<int>(state.range(0));
  for (auto _ : state)
    for (int i = 0; i < all; ++i)
      benchmark::DoNotOptimize(speed_limits(s, speed(i, all), chart.deepest_mm));
}
BENCHMARK(speeds_growth)
    ->Name("speeds/growth")
    ->RangeMultiplier(2)
    ->Range(50, 800)
    ->Unit(benchmark::kMillisecond);

/// Ten speeds of a tool of 10 mm with four teeth, a/D 0.1, up to 4 mm, with one or two
/// modes: 0 a helix of 30 degrees, 1 pitches 5 degrees longer and shorter in turn, 2 runout
/// of 0.01 mm.
void ten_speeds_of_cutters(benchmark::State& state) {
  Cutter c{.system = tool(state.range(1), 0.1)};
  constexpr double kDegree = units::kPi / 180;
  c.system.teeth = 4;
  c.diameter_mm = 10;
  c.feed_mm = 0.1;
  if (state.range(0) == 0) c.helix_rad = 30 * kDegree;
  if (state.range(0) == 1)
    c.pitch_rad = {95 * kDegree, 85 * kDegree, 95 * kDegree, 85 * kDegree};
  if (state.range(0) == 2)
    for (const double deg : {17, 107, 197, 287})
      c.offset_mm.push_back(0.01 * std::cos(deg * kDegree));
  constexpr int kFew = 10;
  for (auto _ : state)
    for (int i = 0; i < kFew; ++i)
      benchmark::DoNotOptimize(speed_limits(c, 5000 + 2000.0 * i, 4));
}
BENCHMARK(ten_speeds_of_cutters)
    ->ArgsProduct({{0, 1, 2}, {1, 2}})
    ->Unit(benchmark::kMillisecond);

/// One cut by 40 intervals; a chart of 200 x 100 cuts takes 20000 times as long.
void semi_discretised_cut(benchmark::State& state) {
  const Chart& chart = kCharts[state.range(0)];
  const System s = tool(chart.axes, chart.immersion);
  for (auto _ : state)
    benchmark::DoNotOptimize(semi_discretisation(s, 12000, chart.deepest_mm / 2, 40));
}
BENCHMARK(semi_discretised_cut)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace turnwright::chatter

BENCHMARK_MAIN();
