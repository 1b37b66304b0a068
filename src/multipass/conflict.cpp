#include "conflict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "relaxation.hpp"

namespace turnwright::multipass {
namespace {

using optimise::Box;
using optimise::Posynomial;
using optimise::Relaxed;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFar = 100;  // ln of any condition worth looking at
constexpr double kMostRelief = 50;
constexpr int kMostPasses = 200;  // tried where n_max is left out

// min t over Y and t, the last variable.
Posynomial program(const std::vector<Row>& soft, const std::vector<Row>& hard,
                   const Depths& depths, const Interval& ln_dr) {
  std::vector<Affine> all = depth_limits(depths, ln_dr);
  for (const Row& row : hard) all.push_back(row.g);
  const auto firm = static_cast<Eigen::Index>(all.size());
  for (const Row& row : soft) all.push_back(row.g);
  const optimise::Monomials on_Y = monomials(all);

  constexpr Eigen::Index n = kVariables + 1;
  Posynomial p;
  p.terms = {Eigen::MatrixXd::Zero(1, n), Eigen::VectorXd::Zero(1)};
  p.terms.a(0, n - 1) = 1;
  p.limits = {Eigen::MatrixXd::Zero(on_Y.a.rows(), n), on_Y.c};
  p.limits.a.leftCols(n - 1) = on_Y.a;
  p.limits.a.col(n - 1).tail(on_Y.a.rows() - firm).setConstant(-1);
  p.lower = Eigen::VectorXd::Constant(n, -kFar);
  p.upper = Eigen::VectorXd::Constant(n, kFar);
  p.lower[kDr] = ln_dr.lo;
  p.upper[kDr] = ln_dr.hi;
  p.lower[kDs] = depths.finishing(ln_dr.hi);
  p.upper[kDs] = depths.finishing(ln_dr.lo);
  p.lower[n - 1] = 0;
  p.upper[n - 1] = kMostRelief;
  return p;
}

// The rows' own names but for n_max, which is no row.
class Limits {
 public:
  explicit Limits(const Problem& problem) : problem_(problem), rows_(rows(problem)) {}

  const std::vector<Row>& all() const { return rows_; }
  int passes(bool bounded) const {
    if (bounded) return problem_.n_max;
    const double most = std::ceil(problem_.dt_mm / problem_.d.lower);
    return std::max(problem_.n_max,
                    static_cast<int>(std::min<double>(kMostPasses, most)));
  }
  Depths depths(int n) const { return {problem_.dt_mm, n}; }
  bool possible(const std::vector<Row>& kept, bool bounded) const {
    for (int n = 1; n <= passes(bounded); ++n)
      if (feasible(kept, depths(n))) return true;
    return false;
  }

 private:
  const Problem& problem_;
  std::vector<Row> rows_;
};

std::vector<Row> without(const std::vector<Row>& rows, const std::string& name) {
  std::vector<Row> rest = rows;
  std::erase_if(rest, [&](const Row& row) { return row.name == name; });
  return rest;
}

Relief relief(const Limits& limits, const Row& row) {
  const auto hard = without(limits.all(), row.name);
  double least = kInfinity;
  for (int n = 1; n <= limits.passes(true); ++n)
    if (const auto t =
            least_violation({row}, hard, limits.depths(n), std::min(least, kMostRelief)))
      least = std::min(least, *t);
  Relief r{row.name, row.limit, std::nullopt};
  if (std::isfinite(least)) r.needed = row.limit * std::exp(row.upper ? least : -least);
  return r;
}

Relief more_passes(const Problem& problem, const Limits& limits) {
  Relief r{"n_max", static_cast<double>(problem.n_max), std::nullopt};
  for (int n = problem.n_max + 1; n <= limits.passes(false) && !r.needed; ++n)
    if (feasible(limits.all(), limits.depths(n))) r.needed = n;
  return r;
}

}  // namespace

std::optional<double> least_violation(const std::vector<Row>& soft,
                                      const std::vector<Row>& hard, const Depths& depths,
                                      double most) {
  const auto ln_dr = roughing_depths(hard, depths);
  if (!ln_dr) return std::nullopt;
  const auto relax = [&](const Box& box, double cut) {
    const auto bound =
        optimise::minimise(program(soft, hard, depths, box[kLnDr]), {.cutoff = cut});
    Relaxed r{bound.lower_bound, kInfinity, kLnDr, bound.y[kDr]};
    if (bound.lower_bound < cut) {
      const auto at =
          optimise::minimise(program(soft, hard, depths, Interval(bound.y[kDr])));
      if (at.violation <= kFeasibility) r.upper = at.f;
    }
    return r;
  };
  const Box box{*ln_dr, Interval(0), Interval(0)};
  const auto result = optimise::relaxation_search(
      box, most, relax, {.gap = kFeasibility, .max_nodes = 2000});
  if (!(result.upper_bound < most)) return std::nullopt;
  return result.upper_bound <= kFeasibility ? 0 : result.upper_bound;
}

bool feasible(const std::vector<Row>& rows, const Depths& depths) {
  std::vector<Row> soft, hard;  // depths alone bound the search
  for (const Row& row : rows) {
    Log rest = row.g.a;
    rest[kDr] = rest[kDs] = 0;
    (rest.isZero() && !row.g.a.isZero() ? hard : soft).push_back(row);
  }
  const auto t = least_violation(soft, hard, depths, 2 * kFeasibility);
  return t.has_value();
}

std::vector<Relief> conflict(const Problem& problem) {
  const Limits limits(problem);
  std::vector<Row> kept = limits.all();
  bool bounded = limits.possible(kept, false);
  for (const Row& row : limits.all()) {
    auto rest = without(kept, row.name);
    if (!limits.possible(rest, bounded)) kept = std::move(rest);
  }
  std::vector<Relief> members;
  for (const Row& row : kept) members.push_back(relief(limits, row));
  if (bounded) members.push_back(more_passes(problem, limits));
  return members;
}

}  // namespace turnwright::multipass
