#include "turnwright/thermal/lag_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>

#include "base/say.hpp"
#include "response.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/least_squares.hpp"
#include "turnwright/optimise/local.hpp"

namespace turnwright::thermal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSeparation = 2;      // least tau_2/tau_1
constexpr double kBlur = 1e-12;        // of the spread: keeps ln of a perfect fit finite
constexpr double kAtBound = 1e-6;      // of ln tau or p: far below the accuracy of a fit
constexpr double kIntegrates = 100;    // lengths of the log
constexpr double kDependent = 1e-9;    // of a column: anything less is rounding
constexpr double kMostAlike = 0.9999;  // largest rho: a memory of 10,000 rows

// theta: ln tau_1 [, ln tau_2], ln tau_amb, p.  Linear k: K_1 [, K_2], b, a, c.  Together
// they are the parameters, theta first.
struct Shape {
  Index lags = 1;
  bool ambient = true;  // the ambient varies, so b can be fitted
  bool start = true;    // a is fitted
  Index tau_amb() const { return lags; }
  Index p() const { return lags + 1; }
  Index nonlinear() const { return lags + 2; }
  Index b() const { return lags; }
  Index a() const { return lags + 1; }
  Index c() const { return lags + 2; }
  Index linear() const { return lags + 3; }
  Index parameters() const { return nonlinear() + linear(); }
};

struct Columns {
  MatrixXd A;               // rows x linear
  std::vector<MatrixXd> D;  // dA/d theta_k
};

Columns columns(const Inputs& in, const Shape& s, double n_max_rpm, double T0_degC,
                std::span<const double> theta) {
  const auto n = static_cast<Index>(in.time_s.size());
  const auto at = [&](Index k) { return theta[static_cast<std::size_t>(k)]; };
  Columns out{MatrixXd::Zero(n, s.linear()),
              std::vector<MatrixXd>(theta.size(), MatrixXd::Zero(n, s.linear()))};
  const auto D = [&](Index k) -> MatrixXd& { return out.D[static_cast<std::size_t>(k)]; };
  const Heat h = heat(in.rpm, n_max_rpm, at(s.p()));
  for (Index j = 0; j < s.lags; ++j) {
    const Response x = spindle(in.time_s, h, std::exp(at(j)));
    out.A.col(j) = x.x;
    D(j).col(j) = x.by_ln_tau;
    D(s.p()).col(j) = x.by_p;
  }
  const double tau_amb_s = std::exp(at(s.tau_amb()));
  if (s.ambient) {
    const Response w = ambient(in, T0_degC, tau_amb_s);
    out.A.col(s.b()) = w.x;
    D(s.tau_amb()).col(s.b()) = w.by_ln_tau;
  }
  if (s.start) {
    const Response past = decay(in.time_s, tau_amb_s);
    out.A.col(s.a()) = past.x;
    D(s.tau_amb()).col(s.a()) = past.by_ln_tau;
  }
  out.A.col(s.c()).setOnes();
  return out;
}

// de/d parameter, by tau itself rather than its logarithm.
MatrixXd jacobian(const Columns& at, const Shape& s, std::span<const double> theta,
                  const VectorXd& k) {
  MatrixXd J(at.A.rows(), s.parameters());
  for (Index i = 0; i < s.nonlinear(); ++i) {
    const auto u = static_cast<std::size_t>(i);
    J.col(i) = at.D[u] * k / (i == s.p() ? 1 : std::exp(theta[u]));
  }
  J.rightCols(s.linear()) = at.A;
  return J;
}

struct Task {
  const Inputs* inputs;  // from the first row to the last that is fitted
  VectorXd error_um;
  Shape shape;
  double n_max_rpm, T0_degC;
  std::vector<Index> rows;  // whose error is fitted
};

struct Solved {
  Columns columns;  // of the rows fitted
  VectorXd k, r;
};

Solved solve(const Task& task, std::span<const double> theta) {
  Columns at = columns(*task.inputs, task.shape, task.n_max_rpm, task.T0_degC, theta);
  if (static_cast<Index>(task.rows.size()) != at.A.rows()) {
    at.A = MatrixXd(at.A(task.rows, Eigen::all));
    for (MatrixXd& d : at.D) d = MatrixXd(d(task.rows, Eigen::all));
  }
  const VectorXd e = task.error_um(task.rows);
  VectorXd k = least_squares(at.A, e).x;
  VectorXd r = e - at.A * k;
  return {std::move(at), std::move(k), std::move(r)};
}

struct Bounds {
  std::vector<double> lower, upper;
};

optimise::Problem problem(const Task& task, const Bounds& bounds) {
  const VectorXd e = task.error_um(task.rows);
  const double total = (e.array() - e.mean()).matrix().squaredNorm();
  // A log without any drift is fitted perfectly by c.
  const double blur = kBlur * total + std::numeric_limits<double>::min();
  const bool two = task.shape.lags == 2;
  return {.lower = bounds.lower,
          .upper = bounds.upper,
          .constraints = two ? 1u : 0u,
          .evaluate = [&task, two, total, blur](std::span<const double> theta,
                                                optimise::Values& out) {
            const Solved at = solve(task, theta);
            const double rss = at.r.squaredNorm() + blur;
            out.f = 0.5 * std::log(rss / (total + blur));
            for (std::size_t k = 0; k < theta.size(); ++k)  // Eq. (4)
              out.df[k] = -at.r.dot(at.columns.D[k] * at.k) / rss;
            if (two) {
              out.g[0] = std::log(kSeparation) + theta[0] - theta[1];
              out.dg[0] = 1;
              out.dg[1] = -1;
            }
          }};
}

std::vector<std::vector<double>> starts(const Shape& s, const Bounds& bounds) {
  const auto between = [&](Index k, double part) {
    const auto i = static_cast<std::size_t>(k);
    return bounds.lower[i] + part * (bounds.upper[i] - bounds.lower[i]);
  };
  constexpr double kP = 0.4;  // of the way: p = 1.5
  std::vector<std::vector<double>> out;
  for (const double amb : {0.2, 0.5, 0.9})
    for (const double first : {0.2, 0.4, 0.6, 0.8}) {
      if (s.lags == 1) {
        out.push_back({between(0, first), between(1, amb), between(2, kP)});
        continue;
      }
      for (const double second : {0.4, 0.6, 0.8, 0.95})
        if (second > first)
          out.push_back(
              {between(0, first), between(1, second), between(2, amb), between(3, kP)});
    }
  return out;
}

std::vector<double> best(const Task& task, const Bounds& bounds,
                         const std::vector<std::vector<double>>& from) {
  const auto p = problem(task, bounds);
  std::vector<double> theta = from.front();
  double f = std::numeric_limits<double>::infinity();
  for (const auto& start : from) {
    const auto s = optimise::local_minimum(p, start, {.max_evaluations = 200});
    if (s.status != optimise::Status::no_feasible_point_met && s.f < f) {
      theta = s.y;
      f = s.f;
    }
  }
  return theta;
}

double median_step_s(const std::vector<double>& t) {
  std::vector<double> steps(t.size());
  std::adjacent_difference(t.begin(), t.end(), steps.begin());
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(t.size() / 2);
  std::nth_element(steps.begin() + 1, middle, steps.end());
  return *middle;
}

Bounds bounds(const Task& task, const FitOptions& o) {
  const auto& t = task.inputs->time_s;
  const double length = t.back() - t.front();
  const double tau_min = std::log(o.tau_min_s.value_or(median_step_s(t))),
               tau_max = std::log(o.tau_max_s.value_or(length)),
               amb_max = std::log(o.tau_amb_max_s.value_or(kIntegrates * length));
  const Shape& s = task.shape;
  Bounds out;
  for (Index j = 0; j < s.lags; ++j) {
    out.lower.push_back(tau_min);
    out.upper.push_back(tau_max);
  }
  out.lower.push_back(tau_min);
  out.upper.push_back(s.ambient || s.start ? amb_max : tau_min);
  std::set<double> speeds(task.inputs->rpm.begin(), task.inputs->rpm.end());
  speeds.erase(0);
  const bool p_told = speeds.size() > 1;
  out.lower.push_back(o.p ? *o.p : p_told ? o.p_min : 1);
  out.upper.push_back(o.p ? *o.p : p_told ? o.p_max : 1);
  if (!(tau_min < tau_max && tau_min < amb_max && o.p_min < o.p_max) ||
      (s.lags == 2 && !(tau_max - tau_min > std::log(kSeparation))))
    throw ModelRangeError(tr("thermal: the bounds of the lags or of p leave no room"));
  return out;
}

std::vector<Parameter> named(const Shape& s, const FitOptions& o, const Bounds& limits,
                             std::span<const double> theta, const VectorXd& k) {
  std::vector<Parameter> out;
  const auto tau_name = [&](Index j) { return "tau_" + std::to_string(j + 1) + "_s"; };
  for (Index i = 0; i < s.nonlinear(); ++i) {
    const auto u = static_cast<std::size_t>(i);
    const bool is_p = i == s.p();
    Parameter q{.name = is_p               ? "p"
                        : i == s.tau_amb() ? "tau_amb_s"
                                           : tau_name(i),
                .value = is_p ? theta[u] : std::exp(theta[u])};
    if (limits.lower[u] == limits.upper[u])
      q.found = is_p && o.p ? Found::given : Found::unknown;
    else if (!(theta[u] > limits.lower[u] + kAtBound))
      q.found = Found::at_lower;
    else if (!(theta[u] < limits.upper[u] - kAtBound))
      q.found = Found::at_upper;
    out.push_back(q);
  }
  for (Index j = 0; j < s.lags; ++j)
    out.push_back({.name = "K_" + std::to_string(j + 1) + "_um", .value = k[j]});
  out.push_back({.name = "b_um_K",
                 .value = k[s.b()],
                 .found = s.ambient ? Found::inside : Found::unknown});
  out.push_back({.name = "a_um",
                 .value = k[s.a()],
                 .found = s.start          ? Found::inside
                          : o.soaked_start ? Found::given
                                           : Found::unknown});
  out.push_back({.name = "c_um", .value = k[s.c()]});
  return out;
}

// Eq. (5) for the parameters inside their bounds; the entries of the others stay 0.
void add_uncertainty(const MatrixXd& J, double factor, LagFit& fit) {
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
    if (fit.parameters[i].found == Found::inside) free.push_back(i);
  MatrixXd F = J(Eigen::all, free);
  const VectorXd norm = F.colwise().norm();
  for (Index j = 0; j < F.cols(); ++j)
    if (norm[j] > 0) F.col(j) /= norm[j];
  const MatrixXd root = least_squares(F, VectorXd::Zero(F.rows()), kDependent).root;
  const MatrixXd C = factor * root * root.transpose();
  const auto m = fit.parameters.size();
  fit.covariance.assign(m * m, 0.0);
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto row = static_cast<Index>(i);
    if (!(root.row(row).squaredNorm() > 0)) {
      fit.parameters[free[i]].found = Found::unknown;
      continue;
    }
    for (std::size_t j = 0; j < free.size(); ++j) {
      const auto column = static_cast<Index>(j);
      if (C(column, column) > 0)
        fit.covariance[free[i] * m + free[j]] =
            C(row, column) / (norm[row] * norm[column]);
    }
  }
  for (std::size_t i = 0; i < m; ++i) {
    Parameter& q = fit.parameters[i];
    q.u = std::sqrt(fit.covariance[i * m + i]);
    q.ill_determined = q.found != Found::given &&
                       (q.found != Found::inside || !(q.u <= 0.5 * std::abs(q.value)));
  }
}

double neighbours(const VectorXd& r) {
  const Index n = r.size();
  const double square = r.squaredNorm();
  if (!(square > 0)) return 0;
  return std::clamp(r.head(n - 1).dot(r.tail(n - 1)) / square, 0.0, kMostAlike);
}

LagFit described(const Task& task, const FitOptions& o, const Bounds& limits,
                 std::span<const double> theta) {
  const Shape& s = task.shape;
  const Solved at = solve(task, theta);
  LagFit fit;
  fit.parameters = named(s, o, limits, theta, at.k);
  const auto value = [&](Index i) {
    return fit.parameters[static_cast<std::size_t>(i)].value;
  };
  for (Index j = 0; j < s.lags; ++j) fit.model.lags.push_back({value(j), at.k[j]});
  fit.model.tau_amb_s = value(s.tau_amb());
  fit.model.p = value(s.p());
  fit.model.n_max_rpm = task.n_max_rpm;
  fit.model.T0_degC = task.T0_degC;
  fit.model.b_um_K = at.k[s.b()];
  fit.model.a_um = at.k[s.a()];
  fit.model.c_um = at.k[s.c()];

  fit.rms_um = std::sqrt(at.r.squaredNorm() / static_cast<double>(at.r.size()));
  fit.autocorrelation = neighbours(at.r);
  const double rho = fit.autocorrelation;
  const double s2 =
      at.r.squaredNorm() / static_cast<double>(at.r.size() - s.parameters());
  add_uncertainty(jacobian(at.columns, s, theta, at.k), s2 * (1 + rho) / (1 - rho), fit);
  return fit;
}

// The index of a row's block, one of kBlocks equal spans of time.
std::size_t block_of(const std::vector<double>& time_s, Index row) {
  const double part = (time_s[static_cast<std::size_t>(row)] - time_s.front()) /
                      (time_s.back() - time_s.front());
  return std::min(kBlocks - 1, static_cast<std::size_t>(part * double{kBlocks}));
}

double left_out_rms_um(const Task& task, const Bounds& limits,
                       const std::vector<double>& theta) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t block = 1; block < kBlocks; ++block) {
    Task others = task;
    others.rows.clear();
    std::vector<Index> out;
    for (const Index row : task.rows)
      (block_of(task.inputs->time_s, row) == block ? out : others.rows).push_back(row);
    const auto without = best(others, limits, {theta});
    const VectorXd k = solve(others, without).k;
    const Columns all =
        columns(*task.inputs, task.shape, task.n_max_rpm, task.T0_degC, without);
    sum += (task.error_um(out) - all.A(out, Eigen::all) * k).squaredNorm();
    count += out.size();
  }
  return std::sqrt(sum / static_cast<double>(count));
}

Task first_rows(const DriftLog& log, const Inputs& inputs, const FitOptions& o) {
  Task task{.inputs = &inputs,
            .error_um = Eigen::Map<const VectorXd>(
                log.error_um.data(), static_cast<Index>(inputs.time_s.size())),
            .shape = {},
            .n_max_rpm = o.n_max_rpm.value_or(std::ranges::max(inputs.rpm)),
            .T0_degC = o.T0_degC,
            .rows = std::vector<Index>(inputs.time_s.size())};
  std::iota(task.rows.begin(), task.rows.end(), Index{0});
  const auto [low, high] = std::ranges::minmax(inputs.ambient_degC);
  task.shape.ambient = high > low;
  task.shape.start = !o.soaked_start;
  if (!(task.n_max_rpm > 0 && std::ranges::max(inputs.rpm) > 0))
    throw ModelRangeError(tr("thermal: the spindle never turns in the rows to fit"));
  return task;
}

}  // namespace

Choice fit_lags(const DriftLog& log, std::size_t rows, const FitOptions& options) {
  check(log.inputs, "fit_lags: log.inputs");
  if (log.error_um.size() != log.inputs.time_s.size() || rows > log.error_um.size())
    throw std::domain_error(
        "fit_lags: log must have one error_um for each time_s, rows at most as many");
  if (rows < kLeastRows)
    throw ModelRangeError(
        say("thermal: {} rows to fit, {} at least are needed", rows, kLeastRows));
  const auto first = [rows](const std::vector<double>& v) {
    return std::vector<double>(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(rows));
  };
  const Inputs inputs{first(log.inputs.time_s), first(log.inputs.rpm),
                      first(log.inputs.ambient_degC)};
  Task task = first_rows(log, inputs, options);

  const auto theta_of = [&](int lags) {
    task.shape.lags = lags;
    const Bounds limits = bounds(task, options);
    return best(task, limits, starts(task.shape, limits));
  };
  const auto fitted = [&](int lags) {
    const auto theta = theta_of(lags);
    return described(task, options, bounds(task, options), theta);
  };
  const auto validated = [&](int lags) -> std::pair<LagFit, double> {
    const auto theta = theta_of(lags);
    const Bounds limits = bounds(task, options);
    return {described(task, options, limits, theta),
            left_out_rms_um(task, limits, theta)};
  };
  if (options.lags != 0 || rows < kBlocks * kLeastRows)
    return {
        .fit = fitted(std::max(1, options.lags)), .one_lag_um = {}, .two_lags_um = {}};
  const auto [one, one_um] = validated(1);
  const auto [two, two_um] = validated(2);
  const bool earned = two_um * two_um < (1 - kEarned) * one_um * one_um;
  return {.fit = earned ? two : one, .one_lag_um = one_um, .two_lags_um = two_um};
}

std::vector<double> drift_uncertainty_um(const LagFit& fit, const Inputs& inputs) {
  check(inputs, "drift_uncertainty_um: inputs");
  const LagModel& m = fit.model;
  const Shape s{.lags = static_cast<Index>(m.lags.size())};
  std::vector<double> theta;
  VectorXd k(s.linear());
  for (Index j = 0; j < s.lags; ++j) {
    theta.push_back(std::log(m.lags[static_cast<std::size_t>(j)].tau_s));
    k[j] = m.lags[static_cast<std::size_t>(j)].K_um;
  }
  theta.push_back(std::log(m.tau_amb_s));
  theta.push_back(m.p);
  k.tail(3) << m.b_um_K, m.a_um, m.c_um;
  const MatrixXd J =
      jacobian(columns(inputs, s, m.n_max_rpm, m.T0_degC, theta), s, theta, k);
  const Eigen::Map<
      const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>
      C(fit.covariance.data(), s.parameters(), s.parameters());
  std::vector<double> u(inputs.time_s.size());
  // Rounding may leave a variance of zero slightly below it.
  Eigen::Map<VectorXd>(u.data(), J.rows()) =
      (J * C).cwiseProduct(J).rowwise().sum().cwiseMax(0).cwiseSqrt();
  return u;
}

}  // namespace turnwright::thermal
