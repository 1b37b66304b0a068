// Whole certified plans of the reference parts on one core, and one inner problem beside
// NLopt's evolutionary search (GN_ISRES) for the same recipe: the rival has no proof and
// stops at its budget; `excess` is how far its cost is above the certified one.
#include <benchmark/benchmark.h>

#include <cmath>
#include <nlopt.hpp>

#include "../src/planning/feature_optimiser.hpp"
#include "turnwright/document/catalogue.hpp"
#include "turnwright/document/file.hpp"
#include "turnwright/document/part_plan.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace {

using namespace turnwright;
using namespace turnwright::planning;

PartPlan reference_part(const std::string& name) {
  const std::string root = TURNWRIGHT_SOURCE_DIR;
  static const auto catalogue = document::load_catalogue(root);
  return document::load_part_plan(document::parse_file(root + "/parts/" + name + ".json"),
                                  catalogue, name)
      .plan;
}

void plan_of(benchmark::State& state, const char* name) {
  const auto part = reference_part(name);
  std::size_t operations = 0;
  long nodes = 0;
  for (auto _ : state) {
    const auto r = plan(part);
    benchmark::DoNotOptimize(r.cost_per_part);
    operations = 0;
    for (const auto& s : r.setups) operations += s.operations.size();
    nodes = r.certificate.nodes;
  }
  state.counters["operations"] = static_cast<double>(operations);
  state.counters["nodes"] = static_cast<double>(nodes);
}
BENCHMARK_CAPTURE(plan_of, gearbox_input_shaft, "gearbox-input-shaft")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan_of, piston_rod, "piston-rod")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan_of, spindle_nose, "spindle-nose")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan_of, infeasible_as_drawn, "infeasible-as-drawn")
    ->Unit(benchmark::kMillisecond);

// The seat d5 of the gearbox shaft, two roughing passes and one finishing pass, sizes
// asked at three places: 5 variables, 26 constraints.
RecipeModel seat(const PartPlan& part) {
  const auto work = assign(part);
  const auto feature = Feature::element(part, 0, Clamping::chuck, work.setups[0],
                                        nothing_finished(part.drawing), 4, {});
  const catalogue::Tool *rough = nullptr, *finish = nullptr;
  for (const auto& t : part.tools) {
    if (t.id == "PCLNL-CNMG120412-PR") rough = &t;
    if (t.id == "PDJNL-DNMG150604-PF") finish = &t;
  }
  const Recipe recipe{rough, finish, 2, 1, 0, 0};
  const double low = feature.low_mm(), high = feature.high_mm();
  auto chain = *feature.chain(recipe, {1.2, 1}, {low, (low + high) / 2, high});
  for (std::size_t k = 0; k < 3; ++k) chain.functionals.push_back({{{k, 2.0}}, 0.012, 0});
  return RecipeModel(recipe, std::move(chain));
}

void inner_problem(benchmark::State& state) {
  const auto part = reference_part("gearbox-input-shaft");
  const auto model = seat(part);
  const auto start = model.start(0.85, 0.15);
  for (auto _ : state)
    benchmark::DoNotOptimize(optimise::local_minimum(model.problem(), start).f);
  state.counters["constraints"] = static_cast<double>(model.problem().constraints);
}
BENCHMARK(inner_problem)->Unit(benchmark::kMillisecond);

void certified(benchmark::State& state) {
  const auto part = reference_part("gearbox-input-shaft");
  const auto model = seat(part);
  const auto start = model.start(0.85, 0.15);
  long nodes = 0;
  for (auto _ : state) {
    const auto s = optimise::local_minimum(model.problem(), start);
    std::vector<optimise::Piece> one{model.piece(1, s.multipliers)};
    nodes = optimise::branch_and_bound(one, s.f, {.gap = 9e-5}).nodes;
  }
  state.counters["nodes"] = static_cast<double>(nodes);
}
BENCHMARK(certified)->Unit(benchmark::kMillisecond);

struct Call {
  const optimise::Problem* problem;
  optimise::Values values;
};

double objective(const std::vector<double>& y, std::vector<double>&, void* data) {
  auto& c = *static_cast<Call*>(data);
  c.problem->evaluate(y, c.values);
  return c.values.f;
}
void constraints(unsigned m, double* g, unsigned n, const double* y, double*,
                 void* data) {
  auto& c = *static_cast<Call*>(data);
  c.problem->evaluate({y, n}, c.values);
  std::copy_n(c.values.g.begin(), m, g);
}

void isres(benchmark::State& state) {
  const auto part = reference_part("gearbox-input-shaft");
  const auto model = seat(part);
  const auto& p = model.problem();
  const auto n = p.lower.size();
  const double best = optimise::local_minimum(p, model.start(0.85, 0.15)).f;
  Call call{&p,
            {0, std::vector<double>(n), std::vector<double>(p.constraints),
             std::vector<double>(p.constraints * n)}};
  double found = 0;
  for (auto _ : state) {
    nlopt::srand(1);
    nlopt::opt solver(nlopt::GN_ISRES, static_cast<unsigned>(n));
    solver.set_lower_bounds(p.lower);
    solver.set_upper_bounds(p.upper);
    solver.set_min_objective(objective, &call);
    solver.add_inequality_mconstraint(constraints, &call,
                                      std::vector<double>(p.constraints, 1e-9));
    solver.set_maxeval(static_cast<int>(state.range(0)));
    auto y = model.start(0.5, 0.5);
    solver.optimize(y, found);
  }
  state.counters["excess"] = std::expm1(found - best);
}
BENCHMARK(isres)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
