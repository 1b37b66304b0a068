#include "turnwright/optimise/local.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <nlopt.hpp>
#include <stdexcept>
#include <string>

#include "turnwright/base/cancelled.hpp"
#include "turnwright/optimise/nnls.hpp"

namespace turnwright::optimise {
namespace {

using Vec = std::vector<double>;

void check_start(const Problem& p, std::span<const double> start) {
  const auto n = p.lower.size();
  if (n == 0 || p.upper.size() != n || start.size() != n)
    throw std::domain_error(
        "local_minimum: start, lower and upper must have the same size, at least 1");
  for (std::size_t i = 0; i < n; ++i)
    if (!(p.lower[i] <= p.upper[i] && std::isfinite(p.lower[i]) &&
          std::isfinite(p.upper[i]) && std::isfinite(start[i])))
      throw std::domain_error("local_minimum: bounds and start of variable " +
                              std::to_string(i) + " must be finite, lower <= upper");
}

void resize(Values& v, std::size_t n, std::size_t m) {
  v.df.assign(n, 0.0);
  v.g.assign(m, 0.0);
  v.dg.assign(m * n, 0.0);
}

// NLopt calls objective and constraints separately.  Both come from one evaluation, which
// is cached for the current point.  NLopt's C++ wrapper turns any exception of a callback
// into "nlopt failure"; the original is kept here and rethrown after the solve.
struct Evaluator {
  const Problem* problem;
  Vec y;
  Values values;
  double shift = 0;  // constraints must stay below -shift
  int evaluations = 0;
  std::exception_ptr error;

  const Values& at(const double* x, std::size_t n) {
    if (!std::equal(y.begin(), y.end(), x, x + n)) {
      y.assign(x, x + n);
      ++evaluations;
      leave_if_asked();
      problem->evaluate(y, values);
    }
    return values;
  }
};

double objective(unsigned n, const double* x, double* grad, void* data) {
  auto& e = *static_cast<Evaluator*>(data);
  try {
    const auto& v = e.at(x, n);
    if (grad) std::copy(v.df.begin(), v.df.end(), grad);
    return v.f;
  } catch (...) {
    if (!e.error) e.error = std::current_exception();
    throw nlopt::forced_stop();
  }
}

void constraints(unsigned m, double* result, unsigned n, const double* x, double* grad,
                 void* data) {
  auto& e = *static_cast<Evaluator*>(data);
  try {
    const auto& v = e.at(x, n);
    for (unsigned i = 0; i < m; ++i) result[i] = v.g[i] + e.shift;
    if (grad) std::copy(v.dg.begin(), v.dg.end(), grad);
  } catch (...) {
    if (!e.error) e.error = std::current_exception();
    throw nlopt::forced_stop();
  }
}

// One NLopt run; y is the start and becomes the end.  True if it spent its budget.
bool run(nlopt::algorithm algorithm, Evaluator& e, Vec& y, const Options& options) {
  const auto& p = *e.problem;
  nlopt::opt solver(algorithm, static_cast<unsigned>(y.size()));
  solver.set_lower_bounds(p.lower);
  solver.set_upper_bounds(p.upper);
  solver.set_min_objective(objective, &e);
  // Without a tolerance NLopt drops every point that rounding leaves outside, and with it
  // the optimum for the start.
  if (p.constraints > 0)
    solver.add_inequality_mconstraint(constraints, &e,
                                      Vec(p.constraints, options.feasibility));
  solver.set_ftol_abs(options.f_tolerance);
  solver.set_xtol_abs(1e-13);  // ln of a condition: far below what any machine can set
  solver.set_maxeval(options.max_evaluations);
  // CCSAQ solves a dual problem in every step.  Its evaluations and the inner iterations
  // are limited, because only a feasible start for SLSQP is needed.  SLSQP ignores both.
  solver.set_param("dual_maxeval", 300);
  solver.set_param("inner_maxeval", 10);
  double f = 0;
  bool spent = false;
  try {
    spent = solver.optimize(y, f) == nlopt::MAXEVAL_REACHED;
  } catch (const nlopt::roundoff_limited&) {  // y holds the best point so far
  } catch (const nlopt::forced_stop&) {       // e.error is set
  } catch (const std::runtime_error&) {       // "nlopt failure": a singular subproblem
  }
  if (e.error) std::rethrow_exception(e.error);
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] = std::clamp(std::isfinite(y[i]) ? y[i] : p.lower[i], p.lower[i], p.upper[i]);
  return spent;
}

double worst(const Vec& g) {
  double w = -std::numeric_limits<double>::infinity();
  for (const double v : g) w = !(v <= w) ? v : w;  // NaN counts as worst
  return w;
}

}  // namespace

Solution local_minimum(const Problem& problem, std::span<const double> start,
                       const Options& options) {
  check_start(problem, start);
  const auto n = start.size();
  Evaluator e{&problem, {}, {}, 0, 0, nullptr};
  resize(e.values, n, problem.constraints);
  Vec first(start.begin(), start.end());
  for (std::size_t i = 0; i < n; ++i)
    first[i] = std::clamp(first[i], problem.lower[i], problem.upper[i]);

  Solution s;
  const auto keep = [&](const Vec& y, bool spent) {
    const auto& v = e.at(y.data(), n);
    const double w = problem.constraints ? worst(v.g) : -1;
    const bool kept = w <= options.feasibility && std::isfinite(v.f);
    const bool had = s.status != Status::no_feasible_point_met;
    if (s.y.empty() || (kept && (!had || v.f < s.f)) || (!kept && !had && w < s.worst)) {
      s.y = y;
      s.f = v.f;
      s.g = v.g;
      s.worst = w;
      if (kept) s.status = spent ? Status::budget_spent : Status::converged;
    }
    return kept;
  };
  Vec y = first;
  bool kept = keep(y, run(nlopt::LD_SLSQP, e, y, options));
  // SLSQP sometimes ends outside by a rounding error; the constraints are tightened by
  // it.
  for (int tries = 0; !kept && tries < 2 && s.worst < 1e-6; ++tries) {
    e.shift += std::max(0.0, s.worst) + options.feasibility;
    kept = keep(y, run(nlopt::LD_SLSQP, e, y, options));
  }
  if (!kept && options.insist) {
    e.shift = 0;
    y = first;
    auto brief =
        options;  // its steps are far slower, and only a feasible start is needed
    brief.max_evaluations = std::min(40, options.max_evaluations);
    if (keep(y, run(nlopt::LD_CCSAQ, e, y, brief)))
      keep(y, run(nlopt::LD_SLSQP, e, y, options));
  }
  s.evaluations = e.evaluations;
  s.multipliers = multipliers_at(problem, s.y, e.at(s.y.data(), n));
  return s;
}

Solution least_violation(const Problem& problem, std::span<const double> start,
                         double floor, const Options& options) {
  check_start(problem, start);
  const auto n = start.size(), m = problem.constraints;
  Values inner;
  resize(inner, n, m);
  Vec y0(start.begin(), start.end());
  problem.evaluate(y0, inner);
  const double s0 = std::max(worst(inner.g), floor) + 1.0;
  if (!std::isfinite(s0))
    throw std::domain_error("least_violation: a constraint is not finite at the start");

  Problem wider;
  wider.lower = problem.lower;
  wider.upper = problem.upper;
  wider.lower.push_back(floor);
  wider.upper.push_back(s0);
  wider.constraints = m;
  wider.evaluate = [&](std::span<const double> y, Values& out) {
    problem.evaluate(y.first(n), inner);
    out.f = y[n];
    std::fill(out.df.begin(), out.df.end(), 0.0);
    out.df[n] = 1;
    for (std::size_t i = 0; i < m; ++i) {
      out.g[i] = inner.g[i] - y[n];
      for (std::size_t j = 0; j < n; ++j) out.dg[i * (n + 1) + j] = inner.dg[i * n + j];
      out.dg[i * (n + 1) + n] = -1;
    }
  };
  y0.push_back(s0);
  auto s = local_minimum(wider, y0, options);
  s.y.pop_back();
  problem.evaluate(s.y, inner);
  s.g = inner.g;
  s.worst = worst(inner.g);
  s.f = std::max(s.worst, floor);
  return s;
}

namespace {

struct Fit {
  Vec multipliers;
  double residual = std::numeric_limits<double>::infinity();  // of stationarity
};

Fit fit(const Problem& problem, std::span<const double> y, const Values& at,
        double near) {
  const auto n = y.size(), m = problem.constraints;
  std::vector<std::size_t> active;
  for (std::size_t i = 0; i < m; ++i)
    if (at.g[i] > -near) active.push_back(i);
  // Active bounds take part as constraints with multipliers of their own.
  struct Bound {
    std::size_t variable;
    double sign;
  };
  std::vector<Bound> bounds;
  for (std::size_t j = 0; j < n; ++j) {
    if (y[j] - problem.lower[j] < near) bounds.push_back({j, -1.0});
    if (problem.upper[j] - y[j] < near) bounds.push_back({j, 1.0});
  }
  const auto columns = static_cast<Eigen::Index>(active.size() + bounds.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), columns);
  Eigen::VectorXd b(static_cast<Eigen::Index>(n));
  for (std::size_t j = 0; j < n; ++j) {
    const auto row = static_cast<Eigen::Index>(j);
    b[row] = -at.df[j];
    for (std::size_t i = 0; i < active.size(); ++i)
      A(row, static_cast<Eigen::Index>(i)) = at.dg[active[i] * n + j];
  }
  for (std::size_t k = 0; k < bounds.size(); ++k)
    A(static_cast<Eigen::Index>(bounds[k].variable),
      static_cast<Eigen::Index>(active.size() + k)) = bounds[k].sign;
  const Eigen::VectorXd x = non_negative_least_squares(A, b);
  std::vector<double> lambda(m, 0.0);
  for (std::size_t i = 0; i < active.size(); ++i)
    lambda[active[i]] = x[static_cast<Eigen::Index>(i)];
  const double residual = columns > 0 ? (A * x - b).norm() : b.norm();
  return {std::move(lambda), residual};
}

}  // namespace

std::vector<double> multipliers_at(const Problem& problem, std::span<const double> y,
                                   const Values& at, double near) {
  constexpr int kWider = 3;
  constexpr double kStationary = 1e-6;
  Fit best;
  for (int k = 0; k <= kWider; ++k, near *= 10) {
    auto f = fit(problem, y, at, near);
    if (f.residual < best.residual) best = std::move(f);
    if (best.residual <= kStationary) break;
  }
  return best.multipliers;
}

double convex_lower_bound(const Problem& problem, std::span<const double> y,
                          const Values& at, std::span<const double> multipliers) {
  const auto n = y.size();
  double bound = at.f;
  for (std::size_t i = 0; i < multipliers.size(); ++i) bound += multipliers[i] * at.g[i];
  for (std::size_t j = 0; j < n; ++j) {
    double r = at.df[j];
    for (std::size_t i = 0; i < multipliers.size(); ++i)
      r += multipliers[i] * at.dg[i * n + j];
    bound +=
        std::min(r * (problem.lower[j] - y[j]), r * (problem.upper[j] - y[j]));  // (1)
  }
  return bound;
}

}  // namespace turnwright::optimise
