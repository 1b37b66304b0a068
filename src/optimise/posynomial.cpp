#include "turnwright/optimise/posynomial.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "turnwright/optimise/local.hpp"

namespace turnwright::optimise {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostSteps = 80;
constexpr double kFixed = 1e-11;    // narrower variables do not move
constexpr double kAllowed = 1e-10;  // t that counts as none
constexpr double kPrice = 1e3, kDearestPrice = 1e7;

void check(const Posynomial& p) {
  const Index n = p.lower.size();
  bool good = n > 0 && p.upper.size() == n && p.terms.a.cols() == n &&
              p.terms.a.rows() == p.terms.c.size() && p.terms.c.size() > 0 &&
              p.limits.a.rows() == p.limits.c.size() &&
              (p.limits.c.size() == 0 || p.limits.a.cols() == n);
  for (Index j = 0; good && j < n; ++j)
    good = p.lower[j] <= p.upper[j] && std::isfinite(p.lower[j]) &&
           std::isfinite(p.upper[j]);
  if (!good)
    throw std::domain_error(
        "minimise: problem must have terms and limits of as many variables as lower and "
        "upper, and finite bounds with lower <= upper");
}

/// f and its derivatives at y.
struct Objective {
  double f = 0;
  VectorXd share, gradient;

  void evaluate(const Monomials& terms, const VectorXd& y) {
    share = terms.c + terms.a * y;
    const double most = share.maxCoeff();
    share = (share.array() - most).exp();
    const double sum = share.sum();
    f = most + std::log(sum);
    share /= sum;
    gradient = terms.a.transpose() * share;
  }
  void add_hessian(const Monomials& terms, MatrixXd& H) const {
    H.noalias() += terms.a.transpose() * share.asDiagonal() * terms.a;
    H.noalias() -= gradient * gradient.transpose();
  }
};

/// The bound of engine 1 for this problem.
class Bound {
 public:
  explicit Bound(const Posynomial& p) {
    const auto n = static_cast<std::size_t>(p.lower.size());
    const auto m = static_cast<std::size_t>(p.limits.c.size());
    problem_.lower.assign(p.lower.begin(), p.lower.end());
    problem_.upper.assign(p.upper.begin(), p.upper.end());
    problem_.constraints = m;
    at_.dg.resize(n * m);
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j < n; ++j)
        at_.dg[i * n + j] = p.limits.a(static_cast<Index>(i), static_cast<Index>(j));
  }
  double operator()(const VectorXd& y, const Objective& o, const VectorXd& g,
                    const VectorXd& multipliers) {
    at_.f = o.f;
    at_.df.assign(o.gradient.begin(), o.gradient.end());
    at_.g.assign(g.begin(), g.end());
    y_.assign(y.begin(), y.end());
    multipliers_.assign(multipliers.begin(), multipliers.end());
    return convex_lower_bound(problem_, y_, at_, multipliers_);
  }

 private:
  Problem problem_;
  Values at_;
  std::vector<double> y_, multipliers_;
};

class InteriorPoint {
 public:
  InteriorPoint(const Posynomial& p, double price) : p_(p), bound_(p), price_(price) {
    for (Index j = 0; j < p.lower.size(); ++j)
      if (p.upper[j] - p.lower[j] > kFixed) free_.push_back(j);
    const Index n = static_cast<Index>(free_.size()), m = p.limits.c.size();
    y_ = (p.lower + p.upper) / 2;
    terms_ = p.terms.a(Eigen::all, free_);
    // Rows B (free y, t) <= e: the limits of (1), the box, t >= 0.
    B_ = MatrixXd::Zero(m + 2 * n + 1, n + 1);
    if (m > 0) {
      B_.topLeftCorner(m, n) = p.limits.a(Eigen::all, free_);
      B_.topRightCorner(m, 1).setConstant(-1);
    }
    B_.block(m, 0, n, n).setIdentity();
    B_.block(m + n, 0, n, n) = -MatrixXd::Identity(n, n);
    B_(m + 2 * n, n) = -1;
    t_ = 1 + (m > 0 ? std::max(0.0, limits().maxCoeff()) : 0.0);
    s_ = slacks();
    lambda_ = price_ / static_cast<double>(B_.rows()) * s_.cwiseInverse();
  }

  PosynomialOptimum run(const PosynomialOptions& options) {
    PosynomialOptimum best;
    for (int k = 0;; ++k) {
      objective_.evaluate(p_.terms, y_);
      const VectorXd g = limits(), multipliers = lambda_.head(g.size());
      const double lower = bound_(y_, objective_, g, multipliers);
      if (lower >= best.lower_bound || best.y.size() == 0) {
        best.lower_bound = std::max(lower, best.lower_bound);
        best.multipliers = multipliers;
      }
      best.y = y_;
      best.f = objective_.f;
      best.violation = g.size() > 0 ? std::max(0.0, g.maxCoeff()) : 0.0;
      const double open = best.f + price_ * t_ - best.lower_bound;
      if (open <= options.gap || best.lower_bound > options.cutoff || k == kMostSteps)
        return best;
      if (!step()) return best;
    }
  }

 private:
  VectorXd limits() const { return p_.limits.c + p_.limits.a * y_; }
  VectorXd slacks() const {
    const Index n = static_cast<Index>(free_.size()), m = p_.limits.c.size();
    VectorXd s(B_.rows());
    s.head(m) = t_ - limits().array();
    s.segment(m, n) = (p_.upper - y_)(free_);
    s.segment(m + n, n) = (y_ - p_.lower)(free_);
    s[m + 2 * n] = t_;
    return s;
  }

  // Longest step that keeps x positive.
  static double reach(const VectorXd& x, const VectorXd& dx) {
    double a = 1;
    for (Index i = 0; i < x.size(); ++i)
      if (dx[i] < 0) a = std::min(a, -x[i] / dx[i]);
    return a;
  }

  bool step() {
    const Index n = static_cast<Index>(free_.size());
    const double rows = static_cast<double>(s_.size());
    VectorXd gradient(n + 1);
    gradient.head(n) = objective_.gradient(free_);
    gradient[n] = price_;
    const VectorXd weight = lambda_.cwiseQuotient(s_);
    MatrixXd K = B_.transpose() * weight.asDiagonal() * B_;
    Monomials moving{terms_, {}};
    Objective o{0, objective_.share, gradient.head(n)};
    MatrixXd H = MatrixXd::Zero(n, n);
    o.add_hessian(moving, H);
    K.topLeftCorner(n, n) += H;
    const Eigen::LDLT<MatrixXd> factors(K);
    // lambda s = target, stationarity linearised: dz, then ds = -B dz, dlambda.
    VectorXd dz, ds, dl;
    const auto solve = [&](const VectorXd& target) {
      const VectorXd per = target.cwiseQuotient(s_);
      dz = factors.solve(-gradient - B_.transpose() * per);
      ds = -B_ * dz;
      dl = per - lambda_ - weight.cwiseProduct(ds);
    };
    const double mu = lambda_.dot(s_) / rows;
    solve(VectorXd::Zero(s_.size()));
    const double a = std::min(reach(s_, ds), reach(lambda_, dl));
    const double after = (s_ + a * ds).dot(lambda_ + a * dl) / rows;
    const double sigma = std::pow(after / mu, 3);
    solve(VectorXd::Constant(s_.size(), sigma * mu) - ds.cwiseProduct(dl));
    if (!dz.allFinite() || !dl.allFinite()) return false;
    const double length =
        std::min(1.0, 0.995 * std::min(reach(s_, ds), reach(lambda_, dl)));
    for (Index j = 0; j < n; ++j)
      y_[free_[static_cast<std::size_t>(j)]] += length * dz[j];
    t_ += length * dz[n];
    lambda_ += length * dl;
    s_ = slacks();
    return s_.minCoeff() > 0 && length > 1e-12;
  }

  const Posynomial& p_;
  Bound bound_;
  double price_;
  std::vector<Index> free_;
  MatrixXd B_, terms_;
  VectorXd y_, s_, lambda_;
  double t_ = 0;
  Objective objective_;
};

}  // namespace

PosynomialOptimum minimise(const Posynomial& problem, const PosynomialOptions& options) {
  check(problem);
  PosynomialOptimum best;
  for (double price = kPrice;; price *= 100) {
    auto next = InteriorPoint(problem, price).run(options);
    next.lower_bound = std::max(next.lower_bound, best.lower_bound);
    best = std::move(next);
    if (best.violation <= kAllowed || best.lower_bound > options.cutoff ||
        price >= kDearestPrice)
      return best;
  }
}

}  // namespace turnwright::optimise
