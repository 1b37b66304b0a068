// Whole certified plans on one core and inner problems, beside NLopt's COBYLA and ISRES
// on the same problems.  The rivals are told the tools, passes and places of the
// tolerances, have no proof, and stop as soon as they meet an allowed point whose cost is
// within 1e-4 of ours, or at a budget: `reached` says in how many of `problems`, `excess`
// how far the worst of the others is above (no allowed point: 1e9).
// Wanted: plan/three-clampings 50 ms, plan/gearbox-input-shaft 100 ms,
// plan/infeasible-as-drawn 200 ms.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <nlopt.hpp>

#include "document/json/file.hpp"
#include "planning/setup/clamping_comparison.hpp"
#include "turnwright/document/catalogue.hpp"
#include "turnwright/document/prepared_part.hpp"
#include "turnwright/planning/plan.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace {

using namespace turnwright;
using namespace turnwright::planning;

const std::string kRoot = TURNWRIGHT_SOURCE_DIR;

PreparedPart prepared(const nlohmann::json& part, const std::string& name) {
  static const auto catalogue = document::load_catalogue(kRoot);
  return document::prepared_part(part, catalogue, name).part;
}

PreparedPart reference_part(const std::string& name) {
  return prepared(document::parse_file(kRoot + "/parts/" + name + ".json"), name);
}

// A shaft of 320 mm that rises to its middle in steps and falls again, every seat of the
// same fit, turned from both ends between chuck and tailstock.
PreparedPart stepped_shaft(int elements) {
  const double length = 320, least = 30, most = 54, stock = 60, allowance = 2;
  auto outer = nlohmann::json::array(), setups = outer;
  for (int i = 0; i < elements; ++i) {
    const double up = std::min(i, elements - 1 - i) / std::floor(elements / 2);
    outer.push_back({{"id", "d" + std::to_string(i + 1)},
                     {"kind", "cylinder"},
                     {"length_mm", length / elements},
                     {"diameter_mm", least + (most - least) * up},
                     {"fit", "h8"},
                     {"Ra_um", 1.6}});
  }
  for (const char* end : {"left", "right"})
    setups.push_back(
        {{"hold", end}, {"grip_mm", 50}, {"clampings", {"chuck-tailstock"}}});
  return prepared({{"format", "turnwright-part/1"},
                   {"name", "stepped shaft"},
                   {"material", "C45"},
                   {"stock",
                    {{"kind", "bar"},
                     {"diameter_mm", stock},
                     {"length_mm", length + 2 * allowance},
                     {"left_allowance_mm", allowance}}},
                   {"outer", outer},
                   {"general", "ISO 2768-mK"},
                   {"machine", "lathe-medium"},
                   {"setups", setups},
                   {"rates", {{"machine_per_min", 1.2}}}},
                  "stepped shaft");
}

using optimise::Problem;
using Vec = std::vector<double>;

void plan_of(benchmark::State& state, PreparedPart part) {
  std::size_t operations = 0;
  long nodes = 0;
  for (auto _ : state) {
    const auto r = plan(part);
    operations = 0;
    for (const auto& s : r.setups) operations += s.operations.size();
    nodes = r.certificate.nodes;
  }
  state.counters["operations"] = static_cast<double>(operations);
  state.counters["nodes"] = static_cast<double>(nodes);
}

// Eleven operations, every setup in the chuck, with a tailstock or between centres.
PreparedPart three_clampings() {
  auto part = reference_part("pump-shaft");
  for (auto& s : part.setups)
    s.clampings = {Clamping::chuck, Clamping::chuck_tailstock, Clamping::between_centres};
  return part;
}

// A seat of the gearbox shaft's first setup, two roughing passes and a finishing pass,
// sizes asked at three places.
RecipeModel seat(const PreparedPart& part, std::size_t element,
                 std::optional<double> ap) {
  const auto& work = part.work;
  GivenConditions fixed;
  fixed.finish.ap_mm = ap;
  const auto feature =
      MachinedSurface::element(part, 0, Clamping::chuck, work.setups[0],
                               nothing_finished(part.drawing), element, fixed);
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

// Two seats cut in the same setup with given finishing depths, as one problem: speed and
// feed of roughing and finishing of both, 8 variables, the sum of both costs.
class TwoSeats {
 public:
  explicit TwoSeats(const PreparedPart& part)
      : seats_{seat(part, 4, 0.5), seat(part, 3, 0.5)} {
    std::size_t rows = 0;
    for (const auto& m : seats_) {
      const auto& p = m.problem();
      problem_.lower.insert(problem_.lower.end(), p.lower.begin(), p.lower.begin() + 4);
      problem_.upper.insert(problem_.upper.end(), p.upper.begin(), p.upper.begin() + 4);
      parts_.push_back({0, Vec(5), Vec(p.constraints), Vec(5 * p.constraints)});
      rows += p.constraints;
    }
    problem_.constraints = rows;
    problem_.evaluate = [this](std::span<const double> y, optimise::Values& out) {
      evaluate(y, out);
    };
  }
  TwoSeats(const TwoSeats&) = delete;
  const Problem& problem() const { return problem_; }
  Vec start(double feed_share) const {
    Vec y;
    for (const auto& m : seats_) {
      const auto part = m.start(feed_share, 0.5);
      y.insert(y.end(), part.begin(), part.begin() + 4);
    }
    return y;
  }

 private:
  void evaluate(std::span<const double> y, optimise::Values& out) {
    std::fill(out.dg.begin(), out.dg.end(), 0.0);
    double sum = 0;
    for (std::size_t k = 0, row = 0; k < 2; ++k) {
      Vec own(y.begin() + static_cast<long>(4 * k),
              y.begin() + static_cast<long>(4 * k + 4));
      own.push_back(seats_[k].problem().lower[4]);
      auto& v = parts_[k];
      seats_[k].problem().evaluate(own, v);
      sum += std::exp(v.f);
      for (std::size_t i = 0; i < v.g.size(); ++i, ++row) {
        out.g[row] = v.g[i];
        std::copy_n(v.dg.begin() + static_cast<long>(5 * i), 4,
                    out.dg.begin() + static_cast<long>(8 * row + 4 * k));
      }
    }
    out.f = std::log(sum);
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t j = 0; j < 4; ++j)
        out.df[4 * k + j] = parts_[k].df[j] * std::exp(parts_[k].f) / sum;
  }

  std::array<RecipeModel, 2> seats_;
  std::vector<optimise::Values> parts_;
  Problem problem_;
};

// One problem, where it is started and the ln(cost) that we reach.
struct Case {
  const Problem* problem;
  Vec start;
  double ours;
};

struct Call {
  const Case* c;
  nlopt::opt* solver;
  optimise::Values values;
  double best = std::numeric_limits<double>::infinity();

  void at(std::span<const double> y) {
    c->problem->evaluate(y, values);
    constexpr double kKept = 1e-6;
    const bool kept = std::all_of(values.g.begin(), values.g.end(),
                                  [](double g) { return g <= kKept; });
    if (kept) best = std::min(best, values.f);
    if (reached()) solver->force_stop();
  }
  bool reached() const { return best <= c->ours + std::log1p(1e-4); }
};
double objective(const Vec& y, Vec&, void* data) {
  auto& call = *static_cast<Call*>(data);
  call.at(y);
  return call.values.f;
}
void constraints(unsigned m, double* g, unsigned n, const double* y, double*,
                 void* data) {
  auto& call = *static_cast<Call*>(data);
  call.at({y, n});
  std::copy_n(call.values.g.begin(), m, g);
}

// ln(best cost met) - ln(ours).
double rival(nlopt::algorithm algorithm, int budget, const Case& c, bool& reached) {
  const auto& p = *c.problem;
  const auto n = p.lower.size();
  nlopt::srand(1);
  nlopt::opt solver(algorithm, static_cast<unsigned>(n));
  Call call{&c, &solver, {0, Vec(n), Vec(p.constraints), Vec(p.constraints * n)}};
  solver.set_lower_bounds(p.lower);
  solver.set_upper_bounds(p.upper);
  solver.set_min_objective(objective, &call);
  solver.add_inequality_mconstraint(constraints, &call, Vec(p.constraints, 1e-9));
  solver.set_maxeval(budget);
  auto y = c.start;
  double f = 0;
  try {
    solver.optimize(y, f);
  } catch (const std::exception&) {  // stopped, or given up
  }
  reached = call.reached();
  return call.best - c.ours;
}

void rivals(benchmark::State& state, nlopt::algorithm algorithm, int budget,
            const std::vector<Case>& cases) {
  double excess = 0, count = 0;
  for (auto _ : state) {
    excess = count = 0;
    for (const auto& c : cases) {
      bool reached = false;
      const double over = rival(algorithm, budget, c, reached);
      if (reached)
        ++count;
      else
        excess = std::max(excess, std::min(std::expm1(over), 1e9));
    }
  }
  state.counters["problems"] = static_cast<double>(cases.size());
  state.counters["reached"] = count;
  state.counters["excess"] = excess;
}

// The problem of every surface of a certified plan, with its tools and passes given.
std::vector<Case> surfaces(const Attempt& a) {
  std::vector<Case> all;
  for (const auto& s : a.setups)
    for (const auto& f : s.chosen.features)
      all.push_back({&f.answer.model->problem(), f.answer.model->start(0.5, 0.5),
                     std::log(f.answer.objective)});
  return all;
}

constexpr int kCobyla = 20000, kIsres = 200000;  // evaluations of one problem

void with_rivals(const std::string& name, std::vector<Case> cases) {
  const auto add = [&](const char* solver, nlopt::algorithm algorithm, int budget) {
    benchmark::RegisterBenchmark(
        (solver + ("/" + name)).c_str(),
        [=](benchmark::State& s) { rivals(s, algorithm, budget, cases); })
        ->Unit(benchmark::kMillisecond);
  };
  add("COBYLA", nlopt::LN_COBYLA, kCobyla);
  add("ISRES", nlopt::GN_ISRES, kIsres);
}

void inner(const std::string& name, const Problem& problem, const Vec& start,
           const Vec& rivals_start) {
  benchmark::RegisterBenchmark(("inner/" + name).c_str(), [&problem, start](
                                                              benchmark::State& state) {
    for (auto _ : state)
      benchmark::DoNotOptimize(optimise::local_minimum(problem, start).f);
    state.counters["variables"] = static_cast<double>(problem.lower.size());
    state.counters["constraints"] = static_cast<double>(problem.constraints);
  })->Unit(benchmark::kMillisecond);
  with_rivals(name,
              {{&problem, rivals_start, optimise::local_minimum(problem, start).f}});
}

void certified(benchmark::State& state, const RecipeModel& model) {
  const auto start = model.start(0.85, 0.15);
  long nodes = 0;
  for (auto _ : state) {
    const auto s = optimise::local_minimum(model.problem(), start);
    std::vector<optimise::Piece> one{model.piece(1, s)};
    nodes = optimise::branch_and_bound(one, s.f, {.gap = 9e-5}).nodes;
  }
  state.counters["nodes"] = static_cast<double>(nodes);
}

}  // namespace

int main(int argc, char** argv) {
  const auto add_plan = [](const std::string& name, const PreparedPart& part) {
    benchmark::RegisterBenchmark(("plan/" + name).c_str(), [part](benchmark::State& s) {
      plan_of(s, part);
    })->Unit(benchmark::kMillisecond);
  };
  const auto part = three_clampings();
  add_plan("three-clampings", part);
  const auto chosen = best_attempt(part);
  with_rivals("three-clampings", surfaces(chosen));
  for (const char* name :
       {"gearbox-input-shaft", "piston-rod", "spindle-nose", "infeasible-as-drawn"})
    add_plan(name, reference_part(name));
  for (const int elements : {5, 10, 20, 40})
    add_plan("growth/" + std::to_string(elements), stepped_shaft(elements));

  const auto gearbox = reference_part("gearbox-input-shaft");
  const auto one = seat(gearbox, 4, {});
  const TwoSeats two(gearbox);
  inner("one-seat", one.problem(), one.start(0.85, 0.15), one.start(0.5, 0.5));
  inner("two-seats", two.problem(), two.start(0.85), two.start(0.5));
  benchmark::RegisterBenchmark("certified/one-seat", [&one](benchmark::State& s) {
    certified(s, one);
  })->Unit(benchmark::kMillisecond);

  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
