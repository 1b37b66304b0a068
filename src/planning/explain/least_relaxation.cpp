#include "least_relaxation.hpp"

#include <algorithm>
#include <cmath>

#include "turnwright/base/interval.hpp"

namespace turnwright::planning {
namespace {

bool is_tolerance(const LimitRow& row) { return row.check == Check::tolerance; }

// How far a limit is relaxed: those of machines and tools no further than kFar.
double farthest(const LimitRow& row) {
  const auto owner = row.numbers[0].owner;
  return owner == Owner::tolerance || owner == Owner::surface ? 1e9 : kFar;
}

constexpr double kSpare = 1.0002;  // more than a local search needs

// One limit of the relaxed request: a tolerance by its place there.
struct Asked {
  const LimitRow& limit;
  std::size_t tolerance = 0;

  bool has(const RecipeModel& m, std::size_t row) const {
    const auto& r = m.rows()[row];
    return sets(limit, r.check) &&
           (!is_tolerance(limit) ||
            m.chain().functionals[r.operation].tolerance == tolerance);
  }

  // Share of the limit that conditions use.
  double share(const SurfaceTask& task, const RecipeModel& m,
               const Choice<double>& choice) const {
    if (limit.check == Check::chatter)
      return task.feature.chatter_share(m.chain(), choice);
    if (is_tolerance(limit)) {
      const auto e = task.feature.profile(m.recipe(), task.economy, choice);
      for (const auto& d : task.cut_tolerances)
        if (d.tolerance == tolerance) return 1 + worst_excess({d}, e);
      return 1;
    }
    double most = 0;
    for (const auto& v : m.values(choice))
      if (sets(limit, v.row.check)) most = std::max(most, v.value / v.limit);
    return most;
  }
};

// Least share of a limit that conditions which keep every limit take: one variable more,
// t, with g <= t.
double least_share(const SurfaceTask& task, const SurfaceAnswer& a, const Asked& asked) {
  constexpr double kLeast = -20;  // of ln(share), and of share - 1
  const auto& m = *a.model;
  const auto& full = m.problem();
  const auto n = full.lower.size();
  optimise::Problem p{full.lower, full.upper, full.constraints, {}};
  p.lower.push_back(kLeast);
  p.upper.push_back(0.1);
  p.evaluate = [&](std::span<const double> y, optimise::Values& out) {
    optimise::Values v{0, std::vector<double>(n), std::vector<double>(full.constraints),
                       std::vector<double>(full.constraints * n)};
    full.evaluate(y.first(n), v);
    out.f = y[n];
    std::fill(out.df.begin(), out.df.end(), 0.0);
    out.df[n] = 1;
    for (std::size_t i = 0; i < full.constraints; ++i) {
      const bool mine = asked.has(m, i);
      out.g[i] = v.g[i] - (mine ? y[n] : 0);
      std::copy_n(v.dg.begin() + static_cast<long>(i * n), n,
                  out.dg.begin() + static_cast<long>(i * (n + 1)));
      out.dg[i * (n + 1) + n] = mine ? -1 : 0;
    }
  };
  auto y = m.point(a.choice);
  y.push_back(0.01);
  const auto s = optimise::local_minimum(p, y);
  auto choice = a.choice;
  if (s.status != optimise::Status::no_feasible_point_met)
    choice = m.choice({s.y.begin(), s.y.end() - 1});
  return std::min(1.0, asked.share(task, m, choice));
}

// Index of a tolerance once those before it are left out.
std::size_t place_of(const Feasibility& oracle, std::size_t limit,
                     const RelaxationFactors& factors) {
  std::size_t place = 0;
  for (std::size_t i = 0; i < limit; ++i)
    place += is_tolerance(*oracle.limits()[i].row) && factors[i] != kWithout;
  return place;
}

// Tries a factor; if it suffices, the least that might have sufficed by what was found.
double reached(Feasibility& oracle, std::size_t limit, RelaxationFactors factors,
               double factor) {
  const auto& l = oracle.limits()[limit];
  factors[limit] = factor;
  if (l.row->relaxing != Relaxing::rows) return oracle.with(factors) ? factor : kInfinity;
  const Asked asked{*l.row, place_of(oracle, limit, factors)};
  const double now = value_of(oracle.part(), l).now;
  double least = 0;  // of the surface that needs the most
  const auto ask = [&](double share) { least = std::max(least, share); };
  const bool kept =
      oracle.with(factors, [&](const SurfaceTask& t, const SurfaceAnswer& a) {
        if (is_tolerance(*l.row)) {
          for (const auto& d : t.cut_tolerances)
            if (d.tolerance == asked.tolerance && d.shape != CutTolerance::Shape::none)
              ask((d.taken_mm + (now * factor - d.taken_mm) * least_share(t, a, asked)) /
                  now);
        } else if (bears_on(oracle.part(), l, t.feature.surface())) {
          ask(factor * least_share(t, a, asked));
        }
      });
  if (!kept) return kInfinity;
  return least > 1 ? std::min(least, factor) : factor;
}

}  // namespace

std::optional<double> least_relaxation(Feasibility& oracle, std::size_t limit,
                                       RelaxationFactors factors) {
  const auto& l = oracle.limits()[limit];
  factors[limit] = kWithout;
  if (!oracle.with(factors)) return {};
  if (l.row->whole()) return kWithout;
  double low = 1, enough = farthest(*l.row),
         might = reached(oracle, limit, factors, enough);
  if (might == kInfinity) return {};
  // Each factor is tried before it counts: what a local search needs, then the least that
  // is worth it; by halving where nothing is known.
  while (enough / low > kRelaxationStep + 1e-9) {
    const bool known = low < might && might < enough;
    double next = known ? enough / kRelaxationStep : std::sqrt(enough * low);
    if (known && kSpare * might < enough / kSpare) next = kSpare * might;
    const double at = reached(oracle, limit, factors, next);
    if (at < kInfinity) {
      enough = next;
      might = at;
    } else {
      low = next;
    }
  }
  const auto value = value_of(oracle.part(), l);
  for (double more = 1; more < kRelaxationStep; more += 1e-3) {
    factors[limit] = reported_factor(value, enough * more);
    if (oracle.with(factors)) return factors[limit];
  }
  return enough;
}

}  // namespace turnwright::planning
