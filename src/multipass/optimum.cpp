#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "conflict.hpp"
#include "local_problem.hpp"
#include "relaxation.hpp"
#include "turnwright/base/interval.hpp"

namespace turnwright::multipass {
namespace {

using optimise::Box;
using optimise::Relaxed;

constexpr double kSearchGap = 2e-7;  // in ln UC, well inside kGap
constexpr double kFineGap = 1e-12;
constexpr long kMostNodes = 20000;
constexpr int kTangents = 4;  // programs above UC, each from the last one's optimum

/// Search for one number of passes.
class Search {
 public:
  Search(const Problem& m, const std::vector<Row>& rows, const Depths& depths)
      : m_(m), depths_(depths), mean_(m.theta), programs_(m, rows, depths) {
    const double most = std::log(m.T.upper / m.T.lower);
    life_ratios_ = Interval(-most, most);
    literal_ = m.cost == Cost::literal && m.theta > 0 && m.theta < 1;
  }

  optimise::SearchResult run(const Interval& ln_dr) {
    const Box box{ln_dr, literal_ ? life_ratios_ : Interval(0), Interval(0)};
    return optimise::relaxation_search(
        box, kInfinity, [this](const Box& b, double cut) { return relax(b, cut); },
        {.gap = kSearchGap, .max_nodes = kMostNodes});
  }
  /// The best point found, after its cost has been minimised over the other conditions
  /// with its own depth and with the depths at both ends of the range.
  Best best(const Interval& ln_dr) {
    Log y = best_.y;
    if (!std::isfinite(best_.ln_UC)) return best_;
    for (const double end : {y[kDr], ln_dr.lo, ln_dr.hi}) {
      y[kDr] = end;
      try_from(y, kFineGap);
    }
    return best_;
  }

 private:
  Relaxed relax(const Box& box, double cut) {
    const Interval s = literal_ ? box[kLifeRatio] : life_ratios_;
    const Line chord = mean_.chord(s);
    const auto q = programs_.program(box[kLnDr], s, chord);
    const auto bound = optimise::minimise(q, {.gap = kSearchGap / 20, .cutoff = cut});
    const Log y = bound.y;
    Relaxed r{bound.lower_bound, kInfinity, kLnDr, y[kDr]};
    if (!(bound.lower_bound < cut)) return r;
    try_from(y, kSearchGap / 20);
    r.upper = best_.ln_UC;
    // The error of each chord, weighted by its effect on ln UC.
    const double depth = width(box[kLnDr]) > 0
                             ? bound.multipliers[0] * (depths_.finishing(y[kDr]) - y[kDs])
                             : 0;
    const double ratio = programs_.life_ratio(y);
    const double life = programs_.tool_share(y) * (chord.at(ratio) - mean_.at(ratio));
    if (literal_ && life > depth) {
      r.split = kLifeRatio;
      r.at = ratio;
    }
    return r;
  }

  // Feasible points with the depths of y.  The tangent of the mean life at the last point
  // gives a cost that is nowhere too low, so each point costs at most as much as the one
  // before.
  void try_from(const Log& y, double gap) {
    Best here;
    double s = programs_.life_ratio(y);
    for (int k = 0; k < kTangents; ++k) {
      const auto q = programs_.program(Interval(y[kDr]), life_ratios_, mean_.tangent(s));
      const auto above = optimise::minimise(q, {.gap = gap});
      if (above.violation > kFeasibility) return;
      const double f = ln_cost(m_, depths_, above.y);
      const double gained = here.ln_UC - f;
      if (gained > 0) here = {f, above.y};
      if (!literal_ || !(gained > gap)) break;
      s = programs_.life_ratio(above.y);
    }
    if (here.ln_UC < best_.ln_UC) best_ = here;
  }

  const Problem& m_;
  Depths depths_;
  MeanLife mean_;
  Relaxation programs_;
  Interval life_ratios_;
  bool literal_ = true;
  Best best_;
};

void check(const Problem& m) {
  const auto ordered = [](const Range& r) {
    return r.lower > 0 && r.lower <= r.upper && std::isfinite(r.upper);
  };
  const bool good = ordered(m.V) && ordered(m.f) && ordered(m.d) && ordered(m.T) &&
                    m.dt_mm > 0 && std::isfinite(m.dt_mm) && m.n_max >= 1 &&
                    m.theta >= 0 && m.theta <= 1 && m.C0 > 0 && m.FU > 0 && m.PU > 0 &&
                    m.QU > 0 && m.SRu_um > 0 && m.k0 >= 0 && m.kt >= 0 && m.te >= 0 &&
                    m.tc >= 0 && m.h1 >= 0 && m.h2 >= 0 && m.k0 + m.kt > 0;
  if (!good) throw std::domain_error("multipass::optimum: values out of range");
}

PassCount optimum_of(const Problem& m, const std::vector<Row>& all, int n) {
  const Depths depths{m.dt_mm, n};
  PassCount count;
  count.n = n;
  const auto ln_dr = roughing_depths(all, depths);
  if (!ln_dr || !feasible(all, depths)) return count;
  Search search(m, all, depths);
  const auto result = search.run(*ln_dr);
  count.nodes = result.nodes;
  count.status = PassCount::Status::unsettled;
  count.lower_bound = std::exp(result.lower_bound);
  Best best = search.best(*ln_dr);
  if (!std::isfinite(best.ln_UC)) return count;

  const auto local = LocalProblem(m, all, depths).from(best.y);
  if (local.ln_UC < best.ln_UC) best = local;
  count.rough = roughing(best.y);
  count.finish = finishing(best.y, depths);
  count.UC = unit_cost(m, n, count.rough, count.finish);
  count.lower_bound = std::min(count.lower_bound, *count.UC);
  if (*count.UC - count.lower_bound <= kGap * *count.UC)
    count.status = PassCount::Status::optimal;
  return count;
}

std::vector<Limit> limits_at(const Problem& m, const std::vector<Row>& all,
                             const PassCount& at) {
  const Log y = logarithms(at.rough, at.finish);
  const auto multipliers = LocalProblem(m, all, {m.dt_mm, at.n}).multipliers(y);
  std::vector<Limit> limits;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double g = all[i].g.at(y), sign = all[i].upper ? 1 : -1;
    limits.push_back({.name = all[i].name,
                      .value = all[i].limit * std::exp(sign * g),
                      .limit = all[i].limit,
                      .margin = -g,
                      .binding = (-g < kBinding),
                      .price = multipliers[i] > 0 ? -sign * multipliers[i] : 0});
  }
  return limits;
}

}  // namespace

Answer optimum(const Problem& m) {
  check(m);
  const std::vector<Row> all = rows(m);
  Answer answer;
  double bound = kInfinity;
  for (int n = 1; n <= m.n_max; ++n) {
    const PassCount count = optimum_of(m, all, n);
    answer.nodes += count.nodes;
    if (count.status != PassCount::Status::infeasible)
      bound = std::min(bound, count.lower_bound);
    if (count.UC && (!answer.best || *count.UC < *answer.best->UC)) answer.best = count;
    answer.per_count.push_back(count);
  }
  if (answer.best) {
    answer.lower_bound = bound;
    answer.gap = (*answer.best->UC - bound) / *answer.best->UC;
    answer.limits = limits_at(m, all, *answer.best);
  } else if (!std::isfinite(bound)) {
    answer.conflict = conflict(m);
  }
  return answer;
}

}  // namespace turnwright::multipass
