// Tip errors of a point, the ball-bar fit of 2 x 3600 points, the rank of 189 x 123, 1e5
// draws, and 1e6 NC blocks compensated, for which at most twice the time of copying them is
// wanted too.
// Wanted: first_order/three_axes 50 ns, exact/three_axes 200 ns, exact/five_axes 500 ns,
// ball_bar_fit 1 ms, rank 20 ms, monte_carlo 2 s, nc_blocks 1 s.
#include <benchmark/benchmark.h>

#include <Eigen/Dense>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "turnwright/volumetric/ball_bar.hpp"
#include "turnwright/volumetric/compensation.hpp"
#include "turnwright/volumetric/kinematics.hpp"
#include "turnwright/volumetric/lathe_part.hpp"
#include "turnwright/volumetric/samba.hpp"

namespace turnwright::volumetric {
namespace {

Machine machine(const std::string& chain) {
  std::mt19937 random(1);
  std::uniform_real_distribution<> number(-1e-3, 1e-3);
  Machine m{chain, {5, -3, -120}, {}};
  for (const char c : chain) {
    if (letter_index(c) == std::string_view::npos) continue;
    Axis axis{c, {10, 20, 30}, default_Q(c)};
    for (std::size_t k = 0; k < kDirections; ++k) {
      for (double& x : axis.errors[k].c) x = number(random) * (k < 3 ? 1 : 1e-2);
      axis.errors[k].b = number(random) * (k < 3 ? 1 : 1e-2);
    }
    m.axes.push_back(axis);
  }
  return m;
}

const Position kAt{.q = {100, -50, 80, 0.1, 0.2, 0.3}, .sign = {1, -1, 1, 1, 1, -1}};

void first_order(benchmark::State& state, const char* chain) {
  const Kinematics k(machine(chain));
  for (auto _ : state) benchmark::DoNotOptimize(k.tip_error_first_order_mm(kAt));
}
void exact(benchmark::State& state, const char* chain) {
  const Kinematics k(machine(chain));
  for (auto _ : state) benchmark::DoNotOptimize(k.actual(kAt));
}
// Rival: the chain as a product of homogeneous matrices, as it stands in most papers,
// with the errors already evaluated.
void matrices(benchmark::State& state, int axes) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  const Vector3d tool(5, -3, -120), p(10, 20, 30);
  double E = 1e-5;
  for (auto _ : state) {
    benchmark::DoNotOptimize(E);
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    for (int i = 0; i < axes; ++i)
      T = T * Eigen::Translation3d(p + Vector3d(100, E, E)) *
          AngleAxisd(E, Vector3d::UnitZ()) * AngleAxisd(E, Vector3d::UnitY()) *
          AngleAxisd(E, Vector3d::UnitX()) * Eigen::Translation3d(-p);
    const Vector3d tip = T * tool;
    benchmark::DoNotOptimize(tip.data());
  }
}
BENCHMARK_CAPTURE(matrices, three_axes, 3);
BENCHMARK_CAPTURE(matrices, five_axes, 5);
BENCHMARK_CAPTURE(first_order, three_axes, "wfXYZt");
BENCHMARK_CAPTURE(first_order, five_axes, "wCBXfZYt");
BENCHMARK_CAPTURE(exact, three_axes, "wfXYZt");
BENCHMARK_CAPTURE(exact, five_axes, "wCBXfZYt");

void ball_bar_fit(benchmark::State& state) {
  const Trace t = simulate(machine("wfXYZt"), {.n = 3600});
  for (auto _ : state) benchmark::DoNotOptimize(decompose(t));
}
BENCHMARK(ball_bar_fit)->Unit(benchmark::kMillisecond);

// Rival: the same twelve terms in one matrix, by Eigen's QR.
void ball_bar_whole_qr(benchmark::State& state) {
  const Trace t = simulate(machine("wfXYZt"), {.n = 3600});
  const auto n = static_cast<Eigen::Index>(t.theta_rad.size());
  for (auto _ : state) {
    Eigen::MatrixXd A(2 * n, 12);
    Eigen::VectorXd v(2 * n);
    for (Eigen::Index i = 0; i < 2 * n; ++i) {
      const auto k = static_cast<std::size_t>(i % n);
      const double c = std::cos(t.theta_rad[k]), s = std::sin(t.theta_rad[k]);
      const double dir = i < n ? 1 : -1, R = t.R_mm, bow = R * R * 1e-4;
      A.row(i) << c, s, R * c * c, R * s * s, R * s * c, -dir * std::copysign(c, s * c),
          dir * std::copysign(s, s * c), -dir * std::abs(s), dir * std::abs(c),
          bow * c * c * s, bow * s * s * c, 2 * dir * s * c;
      v[i] = i < n ? t.ccw_mm[k] : t.cw_mm[k];
    }
    const Eigen::VectorXd x = A.colPivHouseholderQr().solve(v);
    benchmark::DoNotOptimize(x.data());
  }
}
BENCHMARK(ball_bar_whole_qr)->Unit(benchmark::kMillisecond);

void iso(benchmark::State& state) {
  const Trace t = simulate(machine("wfXYZt"), {.n = 3600});
  for (auto _ : state) benchmark::DoNotOptimize(iso230_4(t));
}
BENCHMARK(iso)->Unit(benchmark::kMillisecond);

void rank(benchmark::State& state) {
  SambaStrategy s;
  s.balls_mm = {{-152, 0, 41},    {152, 0, 40},     {160, 160, 178},
                {-160, 160, 178}, {-160, -160, 76}, {160, -160, 76}};
  s.scale_bar_mm = 304;
  for (int i = 0; i < 21; ++i)
    s.indexations.push_back({0.1 * i - 1, 0.3 * i, {2, 3, 4}, {}});
  for (auto _ : state) benchmark::DoNotOptimize(identifiability(s, samba_parameters()));
}
BENCHMARK(rank)->Unit(benchmark::kMillisecond);

void monte_carlo(benchmark::State& state) {
  const Machine lathe = machine("wCfZXt");
  const Surface s =
      turned(Kinematics(lathe), lathe.tool_point_mm, {30, 0, 30, 100}, 24, 9);
  const std::vector<FormSource> sources(8, {cylinder_residual_mm(s), 0.5, 2});
  for (auto _ : state) benchmark::DoNotOptimize(form_distribution(sources, 100000, 1));
}
BENCHMARK(monte_carlo)->Unit(benchmark::kMillisecond);

std::vector<std::string> blocks() {
  std::vector<std::string> text;
  for (int i = 0; i < 1000000; ++i)
    text.push_back("G1 X" + std::to_string(i % 200) + ".5 Y" + std::to_string(i % 90) +
                   " Z-" + std::to_string(i % 7));
  return text;
}

void nc_blocks(benchmark::State& state) {
  const auto text = blocks();
  const std::vector<std::string_view> lines(text.begin(), text.end());
  const Machine m = machine("wfXYZt");
  for (auto _ : state)
    benchmark::DoNotOptimize(compensate(gcode::read_nc(lines, {}), m, {}));
}
BENCHMARK(nc_blocks)->Unit(benchmark::kMillisecond)->Iterations(1);

// Rival: the blocks' numbers read by strtod and written by snprintf, nothing corrected.
void nc_blocks_copied(benchmark::State& state) {
  const auto text = blocks();
  for (auto _ : state) {
    std::vector<std::string> out;
    for (const std::string& line : text) {
      double q[3] = {};
      for (const char* at = line.c_str(); *at;) {
        const char letter = *at++;
        char* end = nullptr;
        const double value = std::strtod(at, &end);
        if (letter >= 'X' && letter <= 'Z') q[letter - 'X'] = value;
        at = end + (*end == ' ');
      }
      char written[80];
      std::snprintf(written, sizeof written, "G1 X%.6f Y%.6f Z%.6f", q[0], q[1], q[2]);
      out.emplace_back(written);
    }
    benchmark::DoNotOptimize(out.data());
  }
}
BENCHMARK(nc_blocks_copied)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace turnwright::volumetric

BENCHMARK_MAIN();
