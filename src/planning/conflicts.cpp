#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "outcome.hpp"

namespace turnwright::planning {
namespace {

constexpr double kBroken = 1e-9;   // a limit counts as over beyond this, in ln
constexpr double kOpening = 1.01;  // how exactly the least widening is found

constexpr double kStart = 1;  // of the scaled excess that is to be least

// Rows that are one limit to a reader: all places of a tolerance, all lines of a curve.
using Limit = std::pair<std::size_t, std::pair<Check, std::size_t>>;

Limit limit_of(const RecipeModel& m, const Row& r) {
  if (r.check == Check::tolerance)
    return {0, {r.check, m.chain().functionals[r.operation].tolerance}};
  return {r.operation, {r.check, 0}};
}

struct Restricted {
  optimise::Problem problem;
  std::vector<std::size_t> rows;
};

// The problem with only some of its rows, over the same box.
Restricted restricted(const RecipeModel& m, const std::vector<Limit>& limits) {
  Restricted r;
  const auto& full = m.problem();
  for (std::size_t i = 0; i < m.rows().size(); ++i)
    if (std::find(limits.begin(), limits.end(), limit_of(m, m.rows()[i])) != limits.end())
      r.rows.push_back(i);
  r.problem = full;
  r.problem.constraints = r.rows.size();
  r.problem.evaluate = [&full, rows = r.rows](std::span<const double> y,
                                              optimise::Values& out) {
    const auto n = y.size();
    optimise::Values v{0, std::vector<double>(n), std::vector<double>(full.constraints),
                       std::vector<double>(full.constraints * n)};
    full.evaluate(y, v);
    out.f = v.f;
    out.df = v.df;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      out.g[k] = v.g[rows[k]];
      for (std::size_t j = 0; j < n; ++j) out.dg[k * n + j] = v.dg[rows[k] * n + j];
    }
  };
  return r;
}

bool can_be_kept(const RecipeModel& m, const std::vector<Limit>& limits) {
  if (limits.empty()) return true;
  const auto r = restricted(m, limits);
  for (const auto& [feed, depth] : {std::pair{0.05, 0.05}, {0.4, 0.3}, {0.9, 0.8}})
    if (optimise::least_violation(r.problem, m.start(feed, depth), -kBroken).f <= kBroken)
      return true;
  return false;
}

std::vector<Limit> all_limits(const RecipeModel& m) {
  std::vector<Limit> all;
  for (const auto& row : m.rows()) {
    const auto l = limit_of(m, row);
    if (std::find(all.begin(), all.end(), l) == all.end()) all.push_back(l);
  }
  return all;
}

// Deletion filter: what can be left out without making the rest possible, is.
std::vector<Limit> irreducible(const RecipeModel& m, std::vector<Limit> kept) {
  for (std::size_t i = 0; i < kept.size();) {
    auto without = kept;
    without.erase(without.begin() + static_cast<long>(i));
    if (can_be_kept(m, without))
      ++i;
    else
      kept = std::move(without);
  }
  return kept;
}

std::vector<Limit> less(std::vector<Limit> limits, const std::vector<Limit>& those) {
  std::erase_if(limits, [&](const Limit& l) {
    return std::find(those.begin(), those.end(), l) != those.end();
  });
  return limits;
}

// Irreducible conflicts that share no limit, until the rest can be kept.
std::vector<std::vector<Limit>> conflicts(const RecipeModel& m) {
  std::vector<std::vector<Limit>> found;
  auto rest = all_limits(m);
  while (!can_be_kept(m, rest)) {
    found.push_back(irreducible(m, rest));
    rest = less(std::move(rest), found.back());
  }
  return found;
}

struct Worst {
  double g = -std::numeric_limits<double>::infinity();
  RowValue row;
};

Worst worst_row(const RecipeModel& m, const Choice<double>& c, const Limit& limit) {
  Worst w;
  for (const auto& r : m.values(c))
    if (limit_of(m, r.row) == limit && violation(r) > w.g) w = {violation(r), r};
  return w;
}

// Least value of one limit with some others kept; nothing if they cannot be.
std::optional<Choice<double>> relaxed(const RecipeModel& m, const Limit& limit,
                                      std::vector<Limit> all) {
  const auto others = restricted(m, all);
  all.push_back(limit);
  const auto both = restricted(m, all);
  // min over y of max own g: one variable more, as in least_violation, the others hard.
  double scale = 1;
  optimise::Problem p;
  p.lower = both.problem.lower;
  p.upper = both.problem.upper;
  p.lower.push_back(-2);
  p.upper.push_back(2);
  p.constraints = both.rows.size();
  p.evaluate = [&](std::span<const double> y, optimise::Values& out) {
    const auto n = y.size() - 1;
    optimise::Values v{0, std::vector<double>(n), std::vector<double>(both.rows.size()),
                       std::vector<double>(both.rows.size() * n)};
    both.problem.evaluate(y.first(n), v);
    out.f = y[n];
    std::fill(out.df.begin(), out.df.end(), 0.0);
    out.df[n] = 1;
    std::fill(out.dg.begin(), out.dg.end(), 0.0);
    for (std::size_t i = 0; i < both.rows.size(); ++i) {
      const bool mine = limit_of(m, m.rows()[both.rows[i]]) == limit;
      const double factor = mine ? 1 / scale : 1;
      out.g[i] = v.g[i] * factor - (mine ? y[n] : 0);
      for (std::size_t j = 0; j < n; ++j)
        out.dg[i * (n + 1) + j] = v.dg[i * n + j] * factor;
      if (mine) out.dg[i * (n + 1) + n] = -1;
    }
  };
  std::optional<Choice<double>> best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [feed, depth] : {std::pair{0.05, 0.05}, {0.4, 0.3}, {0.9, 0.8}}) {
    auto start =
        optimise::least_violation(others.problem, m.start(feed, depth), -kBroken).y;
    scale = std::max(1.0, worst_row(m, m.choice(start), limit).g);  // how far it starts
    start.push_back(kStart);
    auto s = optimise::local_minimum(p, start);
    // SLSQP may end where limits cross; started anew from there it goes on.
    for (double before = kStart; s.f < before * 0.999;) {
      before = s.f;
      s = optimise::local_minimum(p, s.y);
    }
    if (s.status == optimise::Status::no_feasible_point_met || !(s.f * scale < least))
      continue;
    least = s.f * scale;
    best = m.choice({s.y.begin(), s.y.end() - 1});
  }
  return best;
}

}  // namespace

std::string obstacle(const PartPlan& plan, const SolvedFeature& f) {
  if (!f.answer.model)
    return f.task.feature.surface() +
           ": no tool and pass count give a depth its tool can cut";
  const auto& m = *f.answer.model;
  RowValue worst;
  double g = -std::numeric_limits<double>::infinity();
  for (const auto& r : m.values(f.answer.choice))
    if (violation(r) > g) {
      g = violation(r);
      worst = r;
    }
  const auto n = check_name(worst.row.check);
  const double over = worst.row.check == Check::tolerance ? 100 * g : 100 * std::expm1(g);
  const double value = n.at_most ? worst.value : worst.limit;
  const double limit = n.at_most ? worst.limit : worst.value;
  return fmt::format("{}: {} is {} {} where {} {} is allowed, {:.1f} % over at best",
                     f.task.feature.surface(), row_name(plan, m, worst.row),
                     readable(value), n.unit, readable(limit), n.unit, over);
}

namespace {

// The surface with one tolerance `times` as wide and only those of `others` beside it.
FeatureTask opened(const FeatureTask& task, std::size_t tolerance, double times,
                   const std::vector<Limit>& others) {
  FeatureTask t = task;
  t.explain = false;
  std::erase_if(t.demands, [&](const Demand& d) {
    const Limit l{0, {Check::tolerance, d.tolerance}};
    return d.tolerance != tolerance &&
           std::find(others.begin(), others.end(), l) == others.end();
  });
  for (auto& d : t.demands)
    if (d.tolerance == tolerance) {
      d.lower *= times;
      d.upper *= times;
    }
  return t;
}

// Least widening of a tolerance over every recipe, from one that suffices: in growing
// steps down to one that is refuted, which costs most, then by bisection.
double least_widening(const FeatureTask& task, std::size_t tolerance, double enough,
                      const std::vector<Limit>& others) {
  const auto suffices = [&](double times) {
    return can_be_made(opened(task, tolerance, times, others));
  };
  double low = 1, step = kOpening;
  while (low == 1 && enough > kOpening) {
    const double less = std::max(1.0, enough / step);
    if (less == 1 || !suffices(less))
      low = less;
    else
      enough = less;
    step *= step;
    if (low == 1 && less == 1) break;
  }
  while (enough > low * kOpening) {
    const double middle = std::sqrt(low * enough);
    (suffices(middle) ? enough : low) = middle;
  }
  return enough;
}

// What a limit would have to become for the others to be kept.
std::optional<Relaxation> opening(const PartPlan& plan, const SolvedFeature& f,
                                  const Limit& limit, const std::vector<Limit>& others) {
  const auto& m = *f.answer.model;
  const auto c = relaxed(m, limit, others);
  if (!c) return {};
  const auto at = worst_row(m, *c, limit);
  const auto n = check_name(at.row.row.check);
  const bool tolerance = at.row.row.check == Check::tolerance;
  const std::string called = row_name(plan, m, at.row.row);
  const double now = n.at_most ? at.row.limit : at.row.value;
  double needed = n.at_most ? at.row.value : at.row.limit;
  if (tolerance) {  // on the whole surface, not only where the optimiser looked
    const auto profile = f.task.feature.profile(m.recipe(), f.task.economy, *c);
    for (const auto& d : f.task.demands)
      if (d.tolerance == m.chain().functionals[at.row.row.operation].tolerance)
        needed = d.upper * least_widening(f.task, d.tolerance,
                                          1 + worst_excess({d}, profile), others);
  }
  Relaxation r{called + " of " + f.task.feature.surface(), now, needed, n.unit, {}};
  r.sentence = tolerance ? fmt::format(
                               "{} would have to open from {} to {} {} (what the cut may "
                               "use), or the part be held {:.2f} times as stiffly",
                               called, readable(now), readable(needed), n.unit,
                               n.at_most ? needed / now : now / needed)
                         : fmt::format("{} would have to go from {} to {} {}", called,
                                       readable(now), readable(needed), n.unit);
  return r;
}

}  // namespace

void explain(const PartPlan& plan, const SolvedSetup& setup, const SolvedFeature& f,
             ProcessPlan& result) {
  const std::string where = fmt::format("setup {}, {}, {}", setup.setup,
                                        name(setup.clamping), f.task.feature.surface());
  if (!f.answer.model) {
    result.conflicts.push_back({"depth of cut", where, 0, 0, "mm", obstacle(plan, f)});
    return;
  }
  const auto& m = *f.answer.model;
  const auto all = all_limits(m);
  const auto sets = conflicts(m);
  std::vector<Limit> members;
  for (const auto& set : sets) members.insert(members.end(), set.begin(), set.end());
  for (const auto& set : sets)
    for (const auto& limit : set) {
      const auto w = worst_row(m, f.answer.choice, limit);
      const auto n = check_name(w.row.row.check);
      const std::string called = row_name(plan, m, w.row.row);
      const double value = n.at_most ? w.row.value : w.row.limit;
      const double allowed = n.at_most ? w.row.limit : w.row.value;
      result.conflicts.push_back(
          {called, where, value, allowed, n.unit,
           fmt::format("{}: {} {} {} against {} {} at the least violation of all limits",
                       where, called, readable(value), n.unit, readable(allowed),
                       n.unit)});
      // The rest of its own conflict and all that is in none stay as they are.
      auto others = less(all, members);
      for (const auto& other : set)
        if (other != limit) others.push_back(other);
      if (auto r = opening(plan, f, limit, others)) result.relax.push_back(std::move(*r));
    }
}

}  // namespace turnwright::planning
