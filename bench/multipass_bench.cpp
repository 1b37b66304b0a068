// The problems of `multipass` on one core: the literature's, and hard variants. Beside
// them NLopt's evolutionary search (GN_ISRES) on the same problem with one n given: it
// has no proof and stops at its budget; `excess` is how far its cost is above.
#include <benchmark/benchmark.h>

#include <limits>
#include <nlopt.hpp>

#include "../tests/multipass/oracle.hpp"

namespace {

using namespace turnwright::multipass;

Problem literature(double dt_mm, Cost cost) {
  Problem m;
  m.dt_mm = dt_mm;
  m.cost = cost;
  return m;
}

Problem wide_lives() {
  Problem m = literature(6, Cost::literal);
  m.theta = 0.3;
  m.T = {10, 200};
  return m;
}

Problem impossible() {
  Problem m = literature(6, Cost::literal);
  m.PU = 1;
  return m;
}

void certified(benchmark::State& state, const Problem& m) {
  Answer a;
  for (auto _ : state) {
    a = optimum(m);
    benchmark::DoNotOptimize(a.lower_bound);
  }
  state.counters["nodes"] = static_cast<double>(a.nodes);
  if (a.best) state.counters["UC"] = *a.best->UC;
}
BENCHMARK_CAPTURE(certified, literal_6, literature(6, Cost::literal))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(certified, literal_14, literature(14, Cost::literal))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(certified, physical_8, literature(8, Cost::physical))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(certified, wide_lives, wide_lives())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(certified, impossible, impossible())->Unit(benchmark::kMillisecond);

Five five(const std::vector<double>& x) {
  Five y;
  std::copy(x.begin(), x.end(), y.begin());
  return y;
}

// A hundred random problems, about a third of them impossible.
void random_problems(benchmark::State& state) {
  std::vector<Problem> all;
  for (unsigned k = 0; k < 100; ++k) {
    std::mt19937 seed(k);
    all.push_back(random_problem(seed));
  }
  for (auto _ : state)
    for (const Problem& m : all) benchmark::DoNotOptimize(optimum(m).lower_bound);
}
BENCHMARK(random_problems)->Unit(benchmark::kMillisecond);

void isres(benchmark::State& state, const Problem& m) {
  const Answer a = optimum(m);
  Oracle o{m, static_cast<double>(a.best->n)};
  const Span s = span(o);
  double found = std::numeric_limits<double>::infinity();
  for (auto _ : state) {
    nlopt::srand(1);
    nlopt::opt search(nlopt::GN_ISRES, 5);
    search.set_lower_bounds({s.lower.begin(), s.lower.end()});
    search.set_upper_bounds({s.upper.begin(), s.upper.end()});
    search.set_min_objective(
        [](const std::vector<double>& x, std::vector<double>&, void* data) {
          return static_cast<Oracle*>(data)->cost(five(x));
        },
        &o);
    search.add_inequality_constraint(
        [](const std::vector<double>& x, std::vector<double>&, void* data) {
          return static_cast<Oracle*>(data)->worst(five(x));
        },
        &o);
    search.set_maxeval(static_cast<int>(state.range(0)));
    std::vector<double> x(5);
    for (std::size_t j = 0; j < 5; ++j) x[j] = (s.lower[j] + s.upper[j]) / 2;
    search.optimize(x, found);
    if (o.worst(five(x)) > kFeasibility) found = std::numeric_limits<double>::infinity();
  }
  state.counters["excess"] = found / *a.best->UC - 1;
}
BENCHMARK_CAPTURE(isres, literal_8, literature(8, Cost::literal))
    ->Arg(10000)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
