// 200 positions on ten segments between chuck and tailstock, beside a banded
// finite-element model that does the same work: the same flexibilities from the same
// machine in the same run.  Report: items per second are positions; the counter
// `per_beam` is how many times longer the finite elements take.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

#include "turnwright/deflection/beam.hpp"

namespace {

using namespace turnwright;
using namespace turnwright::deflection;

constexpr std::size_t kPositions = 200;
const Supports kSupports{Method::chuck_tailstock, {1.8e-5, 8.6e-8, 1.1e-9}, 0, 3.3e-5};

enum class Shape { solid, solid_cones, bored, bored_cones };

part::Shaft shaft(Shape shape, std::size_t segments) {
  part::Shaft s{210000, 0.3, {}};
  for (std::size_t i = 0; i < segments; ++i) {
    const double left = 60 - 30 * static_cast<double>(i % 10) / 10;
    const bool cones = shape == Shape::solid_cones || shape == Shape::bored_cones;
    const double right = cones ? left - 2 : left;
    const bool bored = shape == Shape::bored || shape == Shape::bored_cones;
    s.segments.push_back(
        {20, left, right, bored ? 0.4 * left : 0, bored ? 0.4 * left : 0});
  }
  return s;
}

std::vector<double> places(const part::Shaft& s) {
  std::vector<double> a;
  const double L = part::length_mm(s.segments);
  for (std::size_t i = 0; i < kPositions; ++i)
    a.push_back(L * (static_cast<double>(i) + 0.5) / kPositions);
  return a;
}

std::vector<Flexibility> by_beam(const part::Shaft& s, const std::vector<double>& a) {
  std::vector<Flexibility> out(a.size());
  Beam(s).at(a, kSupports, out);
  return out;
}

/// Timoshenko elements, exact for cylinders, between all segment ends and positions; one
/// factorisation of the banded matrix and two solutions per position.
std::vector<Flexibility> by_finite_elements(const part::Shaft& s,
                                            const std::vector<double>& a) {
  std::vector<std::array<double, 4>> K(2, {0, 0, 0, 0});  // K[i][j]: row i, column i + j
  std::vector<std::size_t> node_of;
  const auto element = [&](const part::Segment& g, double h) {
    const double de = g.outer_left_mm, di = g.inner_left_mm, m2 = (di / de) * (di / de);
    const double n = (1 + m2) * (1 + m2), nu = s.nu, pi = std::numbers::pi;
    const double chi = ((7 + 6 * nu) * n + (20 + 12 * nu) * m2) / (6 * (1 + nu) * n);
    const double EI = s.E_MPa * pi * (std::pow(de, 4) - std::pow(di, 4)) / 64;
    const double GA = s.E_MPa / (2 * (1 + nu)) * pi * (de * de - di * di) / 4 / chi;
    const double phi = 12 * EI / (GA * h * h), c = EI / (h * h * h * (1 + phi));
    const std::size_t e = K.size() - 2;
    K.resize(e + 4, {0, 0, 0, 0});
    const double k[4][4] = {{12 * c, 6 * h * c, -12 * c, 6 * h * c},
                            {0, (4 + phi) * h * h * c, -6 * h * c, (2 - phi) * h * h * c},
                            {0, 0, 12 * c, -6 * h * c},
                            {0, 0, 0, (4 + phi) * h * h * c}};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i; j < 4; ++j) K[e + i][j - i] += k[i][j];
  };
  double z = 0;
  std::size_t next = 0;
  for (const part::Segment& g : s.segments) {
    double x = z;
    const double end = z + g.length_mm;
    for (; next < a.size() && a[next] < end; ++next) {
      if (a[next] > x) element(g, a[next] - x);
      x = a[next];
      node_of.push_back(K.size() / 2 - 1);
    }
    element(g, end - x);
    z = end;
  }
  const auto [c0, c1, c2] = kSupports.root;
  const double det = c0 * c2 - c1 * c1;
  K[0][0] += c2 / det;
  K[0][1] -= c1 / det;
  K[1][0] += c0 / det;
  const std::size_t n = K.size();
  K[n - 2][0] += 1 / kSupports.tail_mm_N;
  for (std::size_t i = 0; i < n; ++i) {
    const double inverse = 1 / K[i][0];
    for (std::size_t j = 1; j < 4 && i + j < n; ++j)
      for (std::size_t m = j; m < 4 && i + m < n; ++m)
        K[i + j][m - j] -= K[i][j] * inverse * K[i][m];
    for (std::size_t j = 1; j < 4; ++j) K[i][j] *= inverse;
    K[i][0] = inverse;
  }
  std::vector<double> u(n);
  const auto solve = [&](std::size_t dof) {
    std::fill(u.begin(), u.end(), 0.0);
    u[dof] = 1;
    for (std::size_t i = dof; i < n; ++i)
      for (std::size_t j = 1; j < 4 && i + j < n; ++j) u[i + j] -= K[i][j] * u[i];
    for (std::size_t i = n; i-- > 0;) {
      u[i] *= K[i][0];
      for (std::size_t j = 1; j < 4 && i + j < n; ++j) u[i] -= K[i][j] * u[i + j];
    }
  };
  std::vector<Flexibility> out;
  for (const std::size_t node : node_of) {
    Flexibility f;
    solve(2 * node);
    f.f_ww_mm_N = u[2 * node];
    f.f_wp_rad_N = u[2 * node + 1];
    f.tail_per_N = u[n - 2] / kSupports.tail_mm_N;
    solve(2 * node + 1);
    f.f_pp_rad_Nmm = u[2 * node + 1];
    f.tail_per_Nmm = u[n - 2] / kSupports.tail_mm_N;
    out.push_back(f);
  }
  return out;
}

template <class Compute>
double seconds(const Compute& compute) {
  const auto start = std::chrono::steady_clock::now();
  compute();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void beam(benchmark::State& state, Shape shape) {
  const part::Shaft s = shaft(shape, static_cast<std::size_t>(state.range(0)));
  const auto a = places(s);
  for (auto _ : state) benchmark::DoNotOptimize(by_beam(s, a));
  state.SetItemsProcessed(state.iterations() * static_cast<long>(kPositions));
}

void positions_only(benchmark::State& state, Shape shape) {
  const part::Shaft s = shaft(shape, 10);
  const auto a = places(s);
  const Beam built(s);
  std::vector<Flexibility> out(a.size());
  for (auto _ : state) {
    built.at(a, kSupports, out);
    benchmark::DoNotOptimize(out.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<long>(kPositions));
}

void finite_elements(benchmark::State& state, Shape shape) {
  const part::Shaft s = shaft(shape, 10);
  const auto a = places(s);
  const auto exact = by_beam(s, a), approximate = by_finite_elements(s, a);
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(std::abs(approximate[i].f_ww_mm_N / exact[i].f_ww_mm_N - 1) < 1e-5)) {
      state.SkipWithError("the two models disagree");
      return;
    }
  double elements = 0, beams = 0;
  for (auto _ : state) {
    elements += seconds([&] { benchmark::DoNotOptimize(by_finite_elements(s, a)); });
    beams += seconds([&] {
      for (int k = 0; k < 100; ++k) benchmark::DoNotOptimize(by_beam(s, a));
    });
  }
  state.counters["per_beam"] = 100 * elements / beams;
  state.counters["beam_us"] = 1e4 * beams / static_cast<double>(state.iterations());
  state.counters["elements_us"] =
      1e6 * elements / static_cast<double>(state.iterations());
}

BENCHMARK_CAPTURE(beam, solid, Shape::solid)->Arg(10);
BENCHMARK_CAPTURE(beam, solid_cones, Shape::solid_cones)->Arg(10);
BENCHMARK_CAPTURE(beam, bored, Shape::bored)->Arg(10);
BENCHMARK_CAPTURE(beam, bored_cones, Shape::bored_cones)->Arg(10);
BENCHMARK_CAPTURE(positions_only, solid, Shape::solid);
BENCHMARK_CAPTURE(positions_only, bored_cones, Shape::bored_cones);
BENCHMARK_CAPTURE(beam, growth, Shape::bored_cones)->RangeMultiplier(10)->Range(10, 1000);
BENCHMARK_CAPTURE(finite_elements, solid, Shape::solid);
BENCHMARK_CAPTURE(finite_elements, bored, Shape::bored);

}  // namespace

BENCHMARK_MAIN();
