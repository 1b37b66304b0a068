#include "within.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace turnwright::learning {

Table table_of(const Series& series, bool one_edge) {
  Table t;
  const auto rows = std::ssize(series);
  t.x.resize(rows, 3);
  t.y.resize(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto& o = series[static_cast<std::size_t>(i)];
    t.x.row(i) << 1, o.at, o.age;
    t.y[i] = o.y_mm - o.offset_mm;
    if (!one_edge) t.edges.push_back(o.edge);
  }
  t.origin << 1, t.x.col(kAt).mean(), t.x.col(kAge).mean();
  t.x.col(kAt).array() -= t.origin[kAt];
  t.x.col(kAge).array() -= t.origin[kAge];
  if (one_edge) t.edges = {0};
  std::ranges::sort(t.edges);
  t.edges.erase(std::unique(t.edges.begin(), t.edges.end()), t.edges.end());
  const auto edges = std::ssize(t.edges);
  t.n = t.mean_y = Eigen::VectorXd::Zero(edges);
  t.mean_x = Eigen::MatrixXd::Zero(edges, 3);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto edge = one_edge ? 0 : series[static_cast<std::size_t>(i)].edge;
    const auto e = std::ranges::lower_bound(t.edges, edge) - t.edges.begin();
    t.edge.push_back(e);
    t.n[e] += 1;
    t.mean_x.row(e) += t.x.row(i);
    t.mean_y[e] += t.y[i];
  }
  t.mean_x.array().colwise() /= t.n.array();
  t.mean_y.array() /= t.n.array();
  return t;
}

Reduced reduced(const Table& t, const Columns& columns, const Eigen::VectorXd& share) {
  Reduced r{Eigen::MatrixXd(t.y.size(), std::ssize(columns)), t.y};
  for (Eigen::Index i = 0; i < t.y.size(); ++i) {
    const auto e = t.edge[static_cast<std::size_t>(i)];
    r.y[i] -= share[e] * t.mean_y[e];
    for (std::size_t j = 0; j < columns.size(); ++j)
      r.x(i, static_cast<Eigen::Index>(j)) =
          t.x(i, columns[j]) - share[e] * t.mean_x(e, columns[j]);
  }
  return r;
}

Independent independent(const Eigen::MatrixXd& x) {
  constexpr double kRounding = 1e-9;  // of squares: times are given to a second or so
  constexpr double kNothing = 1e-20;  // what is left of equal values less their mean
  const double at = x.col(0).squaredNorm(), age = x.col(1).squaredNorm();
  const double both = x.col(0).dot(x.col(1));
  Independent out;
  out.alike =
      at > kNothing && age > kNothing && at * age - both * both <= kRounding * at * age;
  if (at > kNothing && !out.alike) out.columns.push_back(kAt);
  if (age > kNothing) out.columns.push_back(kAge);
  return out;
}

Within within_fit(const Table& t) {
  const Eigen::VectorXd whole = Eigen::VectorXd::Ones(t.n.size());
  const auto [columns, alike] = independent(reduced(t, {kAt, kAge}, whole).x);
  const auto [x, y] = reduced(t, columns, whole);
  Within w{.columns = columns,
           .alike = alike,
           .beta = {},
           .inverse = {},
           .residual = {},
           .leverage = {}};
  w.leverage = Eigen::VectorXd::Zero(y.size());
  if (x.cols() > 0) {
    w.inverse = (x.transpose() * x).inverse();
    w.leverage = (x * w.inverse).cwiseProduct(x).rowwise().sum();
  }
  w.beta = w.inverse * (x.transpose() * y);
  w.residual = y - x * w.beta;
  w.rss = w.residual.squaredNorm();
  w.degrees = static_cast<double>(y.size() - t.n.size() - x.cols());
  for (Eigen::Index i = 0; i < y.size(); ++i)
    w.leverage[i] += 1 / t.n[t.edge[static_cast<std::size_t>(i)]];
  return w;
}

}  // namespace turnwright::learning
