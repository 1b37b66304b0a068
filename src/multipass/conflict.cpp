#include "conflict.hpp"

#include <algorithm>
#include <cmath>

#include "relaxation.hpp"
#include "turnwright/base/interval.hpp"

namespace turnwright::multipass {
namespace {

using optimise::Box;
using optimise::Posynomial;
using optimise::Relaxed;

constexpr double kMostRelief = 50, kReliefGap = 1e-6;
constexpr int kMostPasses = 200;  // tried where n_max is left out
constexpr double kBlame = 1e-6;   // multipliers that carry a proof

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

bool on_depth_alone(const Row& row) {
  Log rest = row.g.a;
  rest[kDr] = rest[kDs] = 0;
  return rest.isZero() && !row.g.a.isZero();
}

// One number of the request gives both the limit of roughing and that of finishing.
std::string number_of(const Row& row) { return row.name.substr(row.name.find(':') + 1); }

std::vector<Row> without(const std::vector<Row>& rows, const std::string& name) {
  std::vector<Row> rest = rows;
  std::erase_if(rest, [&](const Row& row) { return row.name == name; });
  return rest;
}

Depths depths(const Problem& m, int n) { return {m.dt_mm, n}; }

/// The first pass count from `first` to `last` for which the rows can be kept; 0: none.
int possible(const Problem& m, const std::vector<Row>& rows, int first, int last) {
  for (int n = first; n <= last; ++n)
    if (feasible(rows, depths(m, n))) return n;
  return 0;
}

/// The rows that remain when, from first to last, every row is dropped without which the
/// others are still in conflict.
std::vector<Row> irreducible(const Problem& m, std::vector<Row> kept) {
  for (const Row& row : std::vector<Row>(kept)) {
    auto rest = without(kept, row.name);
    if (!possible(m, rest, 1, m.n_max)) kept = std::move(rest);
  }
  return kept;
}

Relief relief(const Problem& m, const std::vector<Row>& all, const Row& row) {
  std::vector<Row> soft, hard;
  for (const Row& other : all)
    (number_of(other) == number_of(row) ? soft : hard).push_back(other);
  double least = kMostRelief;
  for (int n = 1; n <= m.n_max; ++n)
    if (const auto t = least_violation(soft, hard, depths(m, n), least, kReliefGap))
      least = *t;
  Relief r{row.name, row.limit, std::nullopt};
  if (least < kMostRelief) r.needed = row.limit * std::exp(row.upper ? least : -least);
  return r;
}

}  // namespace

std::optional<double> least_violation(const std::vector<Row>& soft,
                                      const std::vector<Row>& hard, const Depths& depths,
                                      double most, double gap) {
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
  const auto result =
      optimise::relaxation_search(box, most, relax, {.gap = gap, .max_nodes = 500});
  if (!(result.upper_bound < most)) return std::nullopt;
  return result.upper_bound <= kFeasibility ? 0 : result.upper_bound;
}

bool feasible(const std::vector<Row>& rows, const Depths& depths) {
  std::vector<Row> soft, hard;  // depths alone bound the search
  for (const Row& row : rows) (on_depth_alone(row) ? hard : soft).push_back(row);
  return least_violation(soft, hard, depths, 2 * kFeasibility, kFeasibility).has_value();
}

std::vector<Relief> conflict(const Problem& m) {
  const std::vector<Row> all = rows(m);
  // Each order of dropping ends in an irreducible set; the shorter one is reported.
  std::vector<Row> kept = irreducible(m, {all.rbegin(), all.rend()});
  std::reverse(kept.begin(), kept.end());
  if (auto other = irreducible(m, all); other.size() < kept.size())
    kept = std::move(other);
  std::vector<Relief> members;
  for (const Row& row : kept) members.push_back(relief(m, all, row));
  const int most =
      static_cast<int>(std::min<double>(kMostPasses, std::ceil(m.dt_mm / m.d.lower)));
  if (possible(m, kept, m.n_max + 1, most)) {
    members.push_back({"n_max", static_cast<double>(m.n_max), std::nullopt});
    if (const int n = possible(m, all, m.n_max + 1, most)) members.back().needed = n;
  }
  return members;
}

}  // namespace turnwright::multipass
