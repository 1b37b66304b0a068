#include "turnwright/learning/trend.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "turnwright/base/distributions.hpp"
#include "turnwright/base/dual.hpp"
#include "within.hpp"

namespace turnwright::learning {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

// Degrees of freedom between edges from which on their scatter is estimated: fewer do where
// nothing else tells drift and wear apart.
constexpr double kBetween = 4, kBetweenAlike = 2;

// Of the largest value: what is left of values that do not scatter.
constexpr double kRounding = 1e-12;
// Where edges do not differ this floor makes intervals hold as often as they say.
constexpr double kLeastBetween = 0.6;

/// s^2 and s_b^2 of (1), with the covariance of their estimates.
struct Variances {
  double within = 0, between = 0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  double r = 0, p = 1;
};

MatrixXd chosen(const MatrixXd& x, const Columns& columns) {
  return x(Eigen::all, columns);
}

// (3) and (4); none where edges leave too few degrees of freedom to compare them.
std::optional<Variances> variances(const Table& t, const Within& w,
                                   const Columns& columns) {
  const double r = static_cast<double>(t.n.size()) +
                   static_cast<double>(w.columns.size()) -
                   static_cast<double>(columns.size());
  if (t.n.size() < 2 || r < (w.alike ? kBetweenAlike : kBetween)) return std::nullopt;
  const MatrixXd x = chosen(t.x, columns);
  const MatrixXd inverse = (x.transpose() * x).inverse();
  const VectorXd beta = inverse * (x.transpose() * t.y);
  const MatrixXd S = t.n.asDiagonal() * chosen(t.mean_x, columns);
  const MatrixXd A = inverse * (S.transpose() * S);
  const double tr_K = t.n.sum() - A.trace();
  const double tr_K2 = t.n.squaredNorm() -
                       2 * (inverse * (S.transpose() * t.n.asDiagonal() * S)).trace() +
                       (A * A).trace();
  Variances v;
  v.r = r;
  v.within = w.rss / w.degrees;
  const double Q = (t.y - x * beta).squaredNorm() - w.rss;
  v.between =
      std::max((Q - r * v.within) / tr_K, -kLeastBetween * v.within / t.n.maxCoeff());
  if (v.within > 0) v.p = fisher_exceeds(std::max(0.0, Q / r / v.within), r, w.degrees);
  const double of_within = 2 * sqr(v.within) / w.degrees;
  const double of_Q =
      2 * (r * sqr(v.within) + 2 * v.within * v.between * tr_K + sqr(v.between) * tr_K2);
  v.covariance << of_within, -r * of_within / tr_K, -r * of_within / tr_K,
      (of_Q + sqr(r) * of_within) / sqr(tr_K);
  return v;
}

// (5).
double degrees_of(double variance, const Vector2d& slopes, const Variances& v) {
  const double spread = slopes.dot(v.covariance * slopes);
  return spread > 0 ? std::max(v.r, 2 * sqr(variance) / spread) : 1e9;
}

struct Fitted {
  Columns columns;
  VectorXd beta;
  MatrixXd covariance;
  VectorXd degrees;  ///< of each coefficient
};

// Generalised least squares with the variances given, and (5) for each coefficient.  Edges
// that seem to differ less than not at all weigh as alike; the variance counts what they do.
Fitted generalised(const Table& t, const Columns& columns, const Variances& v) {
  const VectorXd ratio = std::max(0.0, v.between / v.within) * t.n;  // n_e lambda
  const VectorXd share = 1 - (1 + ratio.array()).rsqrt();
  const auto [x, y] = reduced(t, columns, share);
  const MatrixXd inverse = (x.transpose() * x).inverse();
  // The coefficients are h'y, h = V^-1 X (X'V^-1 X)^-1, with
  // V^-1 = (I - lambda/(1 + n lambda) 1 1')/s^2.
  const VectorXd weight = ratio.array() / (1 + ratio.array());
  const MatrixXd h = reduced(t, columns, weight).x * inverse;
  MatrixXd sums = MatrixXd::Zero(t.n.size(), h.cols());
  for (Eigen::Index i = 0; i < h.rows(); ++i)
    sums.row(t.edge[static_cast<std::size_t>(i)]) += h.row(i);
  const MatrixXd of_within = h.transpose() * h, of_between = sums.transpose() * sums;
  Fitted f{columns, inverse * (x.transpose() * y),
           v.within * of_within + v.between * of_between, VectorXd(x.cols())};
  for (Eigen::Index c = 0; c < x.cols(); ++c)
    f.degrees[c] = degrees_of(f.covariance(c, c), {of_within(c, c), of_between(c, c)}, v);
  return f;
}

Fitted within_edges(const Within& w) {
  const double s2 = w.rss / w.degrees;
  return {w.columns, w.beta, s2 * w.inverse,
          VectorXd::Constant(w.beta.size(), w.degrees)};
}

void put(const Fitted& f, double confidence, Trend& trend) {
  if (f.degrees.size() > 0) trend.coefficient_degrees = f.degrees.minCoeff();
  for (std::size_t i = 0; i < f.columns.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const auto column = static_cast<std::size_t>(f.columns[i]);
    trend.coefficient[column] = f.beta[k];
    for (std::size_t j = 0; j < f.columns.size(); ++j)
      trend.covariance[column][static_cast<std::size_t>(f.columns[j])] =
          f.covariance(k, static_cast<Eigen::Index>(j));
    const auto e = student_interval(f.beta[k], std::sqrt(f.covariance(k, k)),
                                    f.degrees[k], confidence);
    if (column == kAt) trend.drift = e;
    if (column == kAge) trend.wear = e;
  }
}

// The last part of an edge and the first of the next, in the order of making.
std::vector<Jump> jumps(const Series& series, const Table& t, const Within& w,
                        double confidence) {
  std::vector<Jump> all;
  const double s2 = w.rss / w.degrees;
  for (Eigen::Index i = 1; i < t.y.size(); ++i) {
    const auto here = static_cast<std::size_t>(i);
    const auto from = t.edge[here - 1], to = t.edge[here];
    if (from == to) continue;
    Eigen::Vector3d before = t.x.row(i - 1), after = t.x.row(i);
    before[kAge] += 1;
    const bool step = i > 1 && t.edge[here - 2] == from;
    if (step) before[kAt] += t.x(i - 1, kAt) - t.x(i - 2, kAt);
    const VectorXd g = (after - t.mean_x.row(to).transpose() - before +
                        t.mean_x.row(from).transpose())(w.columns);
    const double value = t.mean_y[to] - t.mean_y[from] + g.dot(w.beta);
    const double variance = s2 * (1 / t.n[to] + 1 / t.n[from] + g.dot(w.inverse * g));
    all.push_back({series[here].edge,
                   student_interval(value, std::sqrt(variance), w.degrees, confidence)});
  }
  return all;
}

}  // namespace

Estimate student_interval(double value, double u, double degrees, double confidence) {
  const double half =
      u * student_quantile((1 + confidence) / 2, std::clamp(degrees, 1.0, 1e9));
  return {value, u, value - half, value + half};
}

double Trend::lambda() const {
  return edges && s_mm > 0 ? std::max(0.0, edges->variance_mm2) / sqr(s_mm) : 0;
}

std::optional<Trend> fit_trend(const Series& series, double confidence) {
  if (series.empty()) return std::nullopt;
  Trend trend;
  Table t = table_of(series, false);
  Within w = within_fit(t);
  if (t.n.size() > 1 && w.degrees < kLeastDegrees) {
    trend.edges_ignored = true;
    t = table_of(series, true);
    w = within_fit(t);
  }
  if (w.degrees < kLeastDegrees) return std::nullopt;
  trend.n = series.size();
  trend.degrees = trend.coefficient_degrees = w.degrees;
  trend.s_mm = std::sqrt(w.rss / w.degrees);
  if (trend.s_mm <= kRounding * t.y.cwiseAbs().maxCoeff()) trend.s_mm = 0;
  const auto [free, alike] = independent(chosen(t.x, {kAt, kAge}));
  Columns all{kConstant};
  all.insert(all.end(), free.begin(), free.end());
  const auto v = variances(t, w, all);
  trend.fixed_edges = !v;
  trend.drift_in_wear = v ? alike : w.alike;
  if (v && trend.s_mm > 0) {
    trend.edges = EdgeScatter{v->between, v->p};
    put(generalised(t, all, *v), confidence, trend);
  } else {
    put(within_edges(w), confidence, trend);
    trend.coefficient[kConstant] = t.y.mean();
    trend.covariance[kConstant][kConstant] = sqr(trend.s_mm) / t.n.sum();
  }
  double sum = 0;
  for (const auto& o : series) sum += o.y_mm;
  const double n = t.n.sum();
  trend.mean_mm =
      student_interval(sum / n, trend.s_mm / std::sqrt(n), w.degrees, confidence);
  trend.fitted_mm.resize(series.size());
  for (std::size_t i = 0; i < series.size(); ++i)
    trend.fitted_mm[i] = series[i].y_mm - w.residual[static_cast<Eigen::Index>(i)];
  for (std::size_t k = 0; k < 3; ++k)
    trend.origin[k] = t.origin[static_cast<Eigen::Index>(k)];
  for (Eigen::Index e = 0; e < t.n.size(); ++e)
    trend.means.push_back({t.edges[static_cast<std::size_t>(e)],
                           t.n[e],
                           t.mean_y[e],
                           {1, t.mean_x(e, kAt), t.mean_x(e, kAge)}});
  if (t.n.size() > 1) trend.jumps = jumps(series, t, w, confidence);
  for (Eigen::Index i = 0; i < t.y.size() && trend.s_mm > 0; ++i)
    if (w.leverage[i] < 1 - 1e-9)
      trend.standardised.push_back(w.residual[i] /
                                   (trend.s_mm * std::sqrt(1 - w.leverage[i])));
  return trend;
}

Estimate expected_mm(const Trend& t, const Observation& next, double confidence) {
  const std::array<double, 3> x{1, next.at - t.origin[1], next.age - t.origin[2]};
  const auto mean = std::ranges::find(t.means, next.edge, &EdgeMean::edge);
  const bool seen = mean != t.means.end();
  const EdgeMean of = seen ? *mean : EdgeMean{};
  const double ratio = of.n * t.lambda();
  const double g = !seen ? 0 : t.fixed_edges ? 1 : ratio / (1 + ratio);
  std::array<double, 3> lever{};
  double value = next.offset_mm + g * of.y_mm, of_fit = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    lever[i] = x[i] - g * of.x[i];
    value += t.coefficient[i] * lever[i];
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      of_fit += lever[i] * t.covariance[i][j] * lever[j];
  const double s2 = sqr(t.s_mm);
  const double of_edge = t.fixed_edges && seen ? s2 / of.n : t.lambda() * s2 * (1 - g);
  const double variance = of_fit + of_edge;
  const double spread = sqr(of_fit) / t.coefficient_degrees + sqr(of_edge) / t.degrees;
  return student_interval(value, std::sqrt(variance),
                          spread > 0 ? sqr(variance) / spread : t.degrees, confidence);
}

}  // namespace turnwright::learning
