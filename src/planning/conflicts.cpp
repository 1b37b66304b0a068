#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "outcome.hpp"

namespace turnwright::planning {
namespace {

constexpr double kBroken = 1e-9;   // a limit counts as over beyond this, in ln
constexpr long kBoxes = 2000;      // of one refutation: what it leaves open counts as not
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

template <class Counts>
Worst worst_row(const RecipeModel& m, const Choice<double>& c, const Counts& counts) {
  Worst w;
  for (const auto& r : m.values(c))
    if (counts(r.row) && violation(r) > w.g) w = {violation(r), r};
  return w;
}
Worst worst_row(const RecipeModel& m, const Choice<double>& c, const Limit& limit) {
  return worst_row(m, c, [&](const Row& r) { return limit_of(m, r) == limit; });
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

namespace {
std::string why_none(const Feature& f) {
  const auto& fixed = f.fixed();
  if (fixed.rough.ap_mm || fixed.finish.ap_mm)
    return fmt::format(": the given passes do not add up to the {} mm to take off",
                       readable(f.stock_mm()));
  if (f.kind() == Feature::Kind::bore)
    return ": no boring bar is thin and long enough, or none can cut the depth that is "
           "left";
  return ": no tool and pass count give a depth its tool can cut";
}
}  // namespace

namespace {
// A tolerance of which all but the cut leaves nothing.
Conflict used_up_conflict(const PartPlan& plan, const SolvedFeature& f, const Demand& d) {
  const auto& t = plan.drawing.tolerances[d.tolerance];
  std::string sources;
  for (const auto& s : shares(allowance(plan, d.tolerance, f.task.making)))
    sources += fmt::format("{}{} {:.3g} um", sources.empty() ? "" : ", ", s.source, s.um);
  const auto called = t.id + " " + part::name(t.kind);
  return {called,
          f.task.feature.surface(),
          d.taken_mm,
          width_mm(t),
          "mm",
          fmt::format("{} of {}: without the cut {} of its {} mm are used up ({})",
                      called, f.task.feature.surface(), readable(d.taken_mm),
                      readable(width_mm(t)), sources)};
}
}  // namespace

std::string obstacle(const PartPlan& plan, const SolvedFeature& f) {
  const auto& feature = f.task.feature;
  if (const auto* d = used_up(f.task.demands); d && !f.answer.model)
    return used_up_conflict(plan, f, *d).sentence;
  if (!f.answer.model) return feature.surface() + why_none(feature);
  const auto& m = *f.answer.model;
  const auto w = worst_row(m, f.answer.choice, [](const Row&) { return true; });
  const auto c = constraint(plan, m.chain(), f.answer.choice, w.row);
  return fmt::format(
      "{}: {} is {} {} where {} {} is allowed, {:.1f} % over at the nearest conditions "
      "found",
      feature.surface(), c.name, readable(c.value), c.unit, readable(c.limit), c.unit,
      100 * (either_sign(w.row.row.check) ? w.g : std::expm1(w.g)));
}

namespace {

// The surface with one tolerance `times` as wide and only those of `others` beside it.
FeatureTask opened(const FeatureTask& task, std::size_t tolerance, double times,
                   const std::vector<Limit>& others) {
  FeatureTask t = task;
  t.explain = false;
  t.boxes = kBoxes;
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

// Least widening of a tolerance over every recipe, from one that suffices: down in
// growing steps to one that is refuted, which costs most, then by bisection between.
double least_widening(const FeatureTask& task, std::size_t tolerance, double enough,
                      const std::vector<Limit>& others) {
  const auto suffices = [&](double times) {
    return can_be_made(opened(task, tolerance, times, others));
  };
  double step = kOpening, low = enough / step;
  while (low > 1 && suffices(low)) {
    enough = low;
    step *= step;
    low = enough / step;
  }
  low = std::max(low, 1.0);
  while (enough > low * kOpening * (1 + 1e-9)) {
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
  const auto w = worst_row(m, *c, limit);
  const auto at = constraint(plan, m.chain(), *c, w.row);
  const bool tolerance = w.row.row.check == Check::tolerance;
  double needed = at.value;
  if (tolerance) {  // on the whole surface, not only where the optimiser looked
    const auto profile = f.task.feature.profile(m.recipe(), f.task.economy, *c);
    for (const auto& d : f.task.demands)
      if (d.tolerance == m.chain().functionals[w.row.row.operation].tolerance)
        needed = d.upper * least_widening(f.task, d.tolerance,
                                          1 + worst_excess({d}, profile), others);
  }
  Relaxation r{
      at.name + " of " + f.task.feature.surface(), at.limit, needed, at.unit, {}};
  r.sentence =
      tolerance
          ? fmt::format(
                "{} would have to open from {} to {} {} (what the cut may use), or "
                "the part be held {:.2f} times as stiffly",
                at.name, readable(at.limit), readable(needed), at.unit, needed / at.limit)
          : fmt::format("{} would have to go from {} to {} {}", at.name,
                        readable(at.limit), readable(needed), at.unit);
  if (w.row.row.check == Check::chatter)
    r.sentence += fmt::format(", the part be held or damped {:.2f} times as stiffly",
                              needed / at.limit);
  return r;
}

}  // namespace

void explain(const PartPlan& plan, const SolvedSetup& setup, const SolvedFeature& f,
             ProcessPlan& result) {
  const std::string where = fmt::format("setup {}, {}, {}", setup.setup,
                                        name(setup.clamping), f.task.feature.surface());
  if (used_up(f.task.demands) && !f.answer.model) {
    for (const auto& d : f.task.demands) {
      if (d.upper > 0) continue;
      auto conflict = used_up_conflict(plan, f, d);
      conflict.where = where;
      result.relax.push_back(
          {conflict.limit, conflict.allowed, conflict.value, "mm",
           fmt::format("{} would have to open beyond {} mm, or the shares be less",
                       conflict.limit, readable(conflict.value))});
      result.conflicts.push_back(std::move(conflict));
    }
    return;
  }
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
      const auto c = constraint(plan, m.chain(), f.answer.choice,
                                worst_row(m, f.answer.choice, limit).row);
      result.conflicts.push_back(
          {c.name, where, c.value, c.limit, c.unit,
           fmt::format("{}: {} {} {} against {} {} at the least violation of all limits",
                       where, c.name, readable(c.value), c.unit, readable(c.limit),
                       c.unit)});
      // The rest of its own conflict and all that is in none stay as they are.
      auto others = less(all, members);
      for (const auto& other : set)
        if (other != limit) others.push_back(other);
      if (auto r = opening(plan, f, limit, others)) result.relax.push_back(std::move(*r));
    }
}

}  // namespace turnwright::planning
