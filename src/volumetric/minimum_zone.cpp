#include "turnwright/volumetric/minimum_zone.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/least_squares.hpp"

namespace turnwright::volumetric {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The model with its constant, without columns that depend on others.
struct Model {
  MatrixXd A;
  std::vector<Index> kept;  // columns of the whole model
  Index whole = 0;
};

Model model_of(std::span<const double> basis, std::size_t columns,
               std::span<const double> values) {
  const auto finite = [](double x) { return std::isfinite(x); };
  if (values.empty() || basis.size() != values.size() * columns ||
      !std::ranges::all_of(basis, finite) || !std::ranges::all_of(values, finite))
    throw std::domain_error("minimum_zone: a finite row of the basis for each value");
  const auto n = static_cast<Index>(values.size()), k = static_cast<Index>(columns);
  MatrixXd whole(n, k + 1);
  whole.col(0).setOnes();
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  if (k > 0) whole.rightCols(k) = Eigen::Map<const Rows>(basis.data(), n, k);
  Model m{.A = {}, .kept = {}, .whole = k + 1};
  MatrixXd Q(n, 0);
  constexpr double kDependent = 1e-10;  // size of a dependent column by rounding
  for (Index j = 0; j <= k && Q.cols() < n; ++j) {
    VectorXd rest = whole.col(j);
    const double norm = rest.norm();
    for (int twice = 0; twice < 2; ++twice) rest -= Q * (Q.transpose() * rest);
    if (!(rest.norm() > kDependent * norm)) continue;
    Q.conservativeResize(n, Q.cols() + 1);
    Q.col(Q.cols() - 1) = rest.normalized();
    m.kept.push_back(j);
  }
  m.A.resize(n, Q.cols());
  for (Index j = 0; j < Q.cols(); ++j)
    m.A.col(j) = whole.col(m.kept[static_cast<std::size_t>(j)]);
  return m;
}

Zone zone(const Model& m, const VectorXd& x, const VectorXd& v) {
  Zone out{.parameters = std::vector<double>(static_cast<std::size_t>(m.whole), 0.0)};
  for (Index j = 0; j < x.size(); ++j)
    out.parameters[static_cast<std::size_t>(m.kept[static_cast<std::size_t>(j)])] = x[j];
  const VectorXd r = v - m.A * x;
  out.width = r.maxCoeff() - r.minCoeff();
  return out;
}

/// m + 1 points touching the zone, each on the side of `sign`.
struct Reference {
  std::vector<Index> point;
  std::vector<double> sign;
};

/// Columns (sign a; 1) of the dual programme.
MatrixXd dual_basis(const MatrixXd& A, const Reference& ref) {
  const Index m = A.cols();
  MatrixXd B(m + 1, m + 1);
  for (Index i = 0; i <= m; ++i) {
    const auto at = static_cast<std::size_t>(i);
    B.col(i).head(m) = ref.sign[at] * A.row(ref.point[at]).transpose();
    B(m, i) = 1;
  }
  return B;
}

/// Independent points by pivoting and one further point, with the signs of the linear
/// dependence between them.
Reference first_reference(const MatrixXd& A) {
  const Index m = A.cols();
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(A.transpose());
  const auto order = qr.colsPermutation().indices();
  MatrixXd square(m, m);
  for (Index i = 0; i < m; ++i) square.row(i) = A.row(order[i]);
  const VectorXd weight =
      square.transpose().partialPivLu().solve(A.row(order[m]).transpose());
  Reference ref;
  for (Index i = 0; i < m; ++i) {
    ref.point.push_back(order[i]);
    ref.sign.push_back(weight[i] > 0 ? -1 : 1);
  }
  ref.point.push_back(order[m]);
  ref.sign.push_back(1);
  return ref;
}

VectorXd best_uniform(const MatrixXd& A, const VectorXd& v) {
  const Index m = A.cols();
  Reference ref = first_reference(A);
  VectorXd x = VectorXd::Zero(m), target = VectorXd::Unit(m + 1, m);
  const double rounding = 1e-14 * v.cwiseAbs().maxCoeff();
  const VectorXd size = A.cwiseAbs().colwise().maxCoeff();
  // Exchanges with the worst point end after about ten.  Degenerate references, where an
  // exchange gains nothing, could cycle; Bland's rule prevents that.  Columns that nearly
  // depend on each other have large terms that cancel: then the rounding of these decides.
  const Index patience = 50 * (m + 1), most = 100 * A.rows() + patience;
  constexpr double kOfTerms = 16 * std::numeric_limits<double>::epsilon();
  for (Index step = 0; step < most; ++step) {
    leave_if_asked();
    const Eigen::PartialPivLU<MatrixXd> lu(dual_basis(A, ref));
    VectorXd cost(m + 1);
    for (Index i = 0; i <= m; ++i)
      cost[i] = ref.sign[static_cast<std::size_t>(i)] *
                v[ref.point[static_cast<std::size_t>(i)]];
    const VectorXd price = lu.transpose().solve(cost);
    x = price.head(m);
    const VectorXd r = v - A * x;
    const double of_terms = step < patience ? 0 : kOfTerms * size.dot(x.cwiseAbs());
    const double limit = price[m] + std::max(rounding, of_terms);
    Index entering = 0;
    if (step < patience)
      r.cwiseAbs().maxCoeff(&entering);
    else
      while (entering + 1 < r.size() && !(std::abs(r[entering]) > limit)) ++entering;
    if (!(std::abs(r[entering]) > limit)) return x;
    const double sign = r[entering] > 0 ? 1 : -1;
    VectorXd column(m + 1);
    column << sign * A.row(entering).transpose(), 1;
    const VectorXd y = lu.solve(target), d = lu.solve(column);
    std::size_t leaving = 0;
    double least = std::numeric_limits<double>::infinity();
    for (Index i = 0; i <= m; ++i) {
      if (!(d[i] > 1e-12)) continue;
      const double ratio = std::max(y[i], 0.0) / d[i];
      const auto at = static_cast<std::size_t>(i);
      if (ratio < least || (ratio == least && ref.point[at] < ref.point[leaving])) {
        least = ratio;
        leaving = at;
      }
    }
    ref.point[leaving] = entering;
    ref.sign[leaving] = sign;
  }
  return x;
}

}  // namespace

Zone least_squares_zone(std::span<const double> basis, std::size_t columns,
                        std::span<const double> values) {
  const Model m = model_of(basis, columns, values);
  const Eigen::Map<const VectorXd> v(values.data(), m.A.rows());
  return zone(m, least_squares(m.A, v).x, v);
}

Zone minimum_zone(std::span<const double> basis, std::size_t columns,
                  std::span<const double> values) {
  const Model m = model_of(basis, columns, values);
  const Eigen::Map<const VectorXd> v(values.data(), m.A.rows());
  const Zone squares = zone(m, least_squares(m.A, v).x, v);
  if (m.A.rows() <= m.A.cols()) return squares;
  const Zone narrow = zone(m, best_uniform(m.A, v), v);
  return narrow.width <= squares.width ? narrow : squares;
}

}  // namespace turnwright::volumetric
