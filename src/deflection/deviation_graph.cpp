#include "turnwright/deflection/deviation_graph.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>

#include "base/say.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/distributions.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/least_squares.hpp"

namespace turnwright::deflection {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kPlaces = 3;         // on either side of a step
constexpr double kRounding = 1e-13;  // of the largest |e|
constexpr double kDependent = 1e-9;  // a step that the others already make

/// A step stands after point k of the sorted graph.
using Places = std::vector<Index>;

struct Graph {
  VectorXd z, e, t;       // sorted; t in [-1, 1]
  double middle, half;    // z = middle + half t
  std::vector<Index> at;  // the point belongs to the at-th different place
  double rounding;        // of e
};

Graph sorted(std::span<const double> z_mm, std::span<const double> e_mm) {
  std::vector<std::size_t> order(z_mm.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return z_mm[a] < z_mm[b]; });
  const auto n = static_cast<Index>(order.size());
  Graph g{VectorXd(n), VectorXd(n), VectorXd(n), 0, 0, {}, 0};
  for (Index i = 0; i < n; ++i) {
    g.z[i] = z_mm[order[static_cast<std::size_t>(i)]];
    g.e[i] = e_mm[order[static_cast<std::size_t>(i)]];
    g.at.push_back(i == 0 ? 0 : g.at.back() + (g.z[i] > g.z[i - 1]));
  }
  g.rounding =
      std::max(kRounding * g.e.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  g.middle = (g.z[0] + g.z[n - 1]) / 2;
  g.half = (g.z[n - 1] - g.z[0]) / 2;
  g.t = (g.z.array() - g.middle) / (g.half > 0 ? g.half : 1);
  return g;
}

VectorXd heaviside(Index n, Index k) {
  VectorXd h = VectorXd::Zero(n);
  h.tail(n - k - 1).setOnes();
  return h;
}

/// 1, t, t^2, .. and the steps, Eq. (1).
MatrixXd columns(const Graph& g, int degree, const Places& places) {
  const Index n = g.e.size(), powers = degree + 1;
  MatrixXd X(n, powers + static_cast<Index>(places.size()));
  X.col(0).setOnes();
  for (Index j = 1; j < powers; ++j) X.col(j) = X.col(j - 1).cwiseProduct(g.t);
  for (std::size_t k = 0; k < places.size(); ++k)
    X.col(powers + static_cast<Index>(k)) = heaviside(n, places[k]);
  return X;
}

/// Orthonormal basis of a model, and the residual of e.
struct Model {
  MatrixXd Q;
  VectorXd r;
  double rss() const { return r.squaredNorm(); }
};

Model model(const Graph& g, int degree, const Places& places) {
  leave_if_asked();
  const MatrixXd X = columns(g, degree, places);
  const MatrixXd Q = Eigen::HouseholderQR<MatrixXd>(X).householderQ() *
                     MatrixXd::Identity(X.rows(), X.cols());
  return {Q, g.e - Q * (Q.transpose() * g.e)};
}

bool may_stand(const Graph& g, Index k, const Places& others) {
  const auto place = [&g](Index i) { return g.at[static_cast<std::size_t>(i)]; };
  if (place(k) == place(k + 1)) return false;
  if (place(k) + 1 < kPlaces || g.at.back() - place(k) < kPlaces) return false;
  return std::ranges::all_of(
      others, [&](Index other) { return std::abs(place(k) - place(other)) >= kPlaces; });
}

struct Addition {
  Index place;
  double rss;
};

/// The best further step.  It reduces RSS by (r.h)^2/|h - Q Q^T h|^2, with sums from the
/// right that every position extends by one point.
std::optional<Addition> best_addition(const Graph& g, const Model& m,
                                      const Places& others) {
  std::optional<Addition> best;
  const double rss = m.rss();
  double rh = 0;
  VectorXd Qh = VectorXd::Zero(m.Q.cols());
  for (Index k = g.e.size() - 2; k >= 0; --k) {
    rh += m.r[k + 1];
    Qh += m.Q.row(k + 1).transpose();
    if (!may_stand(g, k, others)) continue;
    const auto length2 = static_cast<double>(g.e.size() - k - 1);
    const double new2 = length2 - Qh.squaredNorm();
    if (!(new2 > kDependent * length2)) continue;
    const double left = rss - rh * rh / new2;
    if (!best || left < best->rss) best = {k, left};
  }
  return best;
}

/// Moves one step at a time to its best position, until none moves.
void settle(const Graph& g, int degree, Places& places) {
  double rss = model(g, degree, places).rss();
  for (bool moved = true; moved;) {
    moved = false;
    for (std::size_t k = 0; k < places.size(); ++k) {
      Places others = places;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      const auto better = best_addition(g, model(g, degree, others), others);
      if (!better || better->place == places[k]) continue;
      others.push_back(better->place);
      // RSS of the whole model, because the reduction by one step is a difference, which
      // for an exact graph is nothing but rounding.  Each move lowers RSS, and there are
      // finitely many positions.
      if (const double now = model(g, degree, others).rss(); now < rss) {
        places[k] = better->place;
        rss = now;
        moved = true;
      }
    }
  }
}

std::optional<Places> best_pair(const Graph& g, int degree) {
  std::optional<Places> best;
  double least = std::numeric_limits<double>::infinity();
  for (Index k = 0; k + 1 < g.e.size(); ++k) {
    if (!may_stand(g, k, {})) continue;
    const Places first{k};
    const auto second = best_addition(g, model(g, degree, first), first);
    if (second && second->rss < least) {
      least = second->rss;
      best = Places{k, second->place};
    }
  }
  return best;
}

/// The best places of one more step than `fewer` has.
std::optional<Places> best_places(const Graph& g, int degree, Places fewer) {
  if (fewer.size() == 1) return best_pair(g, degree);
  const auto one = best_addition(g, model(g, degree, fewer), fewer);
  if (!one) return std::nullopt;
  fewer.push_back(one->place);
  settle(g, degree, fewer);
  return fewer;
}

/// The number of positions at which a step may stand.
double places_for_one(const Graph& g) {
  double n = 0;
  for (Index k = 0; k + 1 < g.e.size(); ++k) n += may_stand(g, k, {});
  return n;
}

/// RSS, but at least its rounding.
double squares(const Graph& g, int degree, const Places& places) {
  return std::max(model(g, degree, places).rss(),
                  static_cast<double>(g.e.size()) * g.rounding * g.rounding);
}

long free_points(const Graph& g, int degree, const Places& places) {
  return static_cast<long>(g.e.size()) - degree - 1 - static_cast<long>(places.size());
}

bool significant(const Graph& g, int degree, const Places& fewer, const Places& more) {
  const double q = static_cast<double>(more.size() - fewer.size());
  const auto f = static_cast<double>(free_points(g, degree, more));
  const double R0 = squares(g, degree, fewer), R1 = squares(g, degree, more);
  const double one = places_for_one(g), N = q == 1 ? one : one * (one - 1) / 2;
  const double F = std::max(0.0, (R0 - R1) / q / (R1 / f));
  return N * fisher_exceeds(F, q, f) < kStepLevel;  // Eq. (2)
}

Places steps(const Graph& g, int degree, std::size_t most) {
  Places places;
  while (places.size() < most) {
    const auto one = best_places(g, degree, places);
    if (!one || free_points(g, degree, *one) < 1) break;
    if (significant(g, degree, places, *one)) {
      places = *one;
      continue;
    }
    if (places.size() + 2 > most) break;
    const auto two = best_places(g, degree, *one);
    if (!two || free_points(g, degree, *two) < 1 || !significant(g, degree, places, *two))
      break;
    places = *two;
  }
  std::ranges::sort(places);
  return places;
}

int best_degree(const Graph& g, int largest, const Places& places) {
  const auto n = static_cast<double>(g.e.size());
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int degree = 0; degree <= largest; ++degree) {
    const double bic =
        n * std::log(squares(g, degree, places) / n) + (degree + 1) * std::log(n);
    if (bic < least) {
      least = bic;
      best = degree;
    }
  }
  return best;
}

/// R^2 about the mean; 1 if e is nothing but rounding.
double r2(double rss, const VectorXd& e, double rounding) {
  const double total = (e.array() - e.mean()).square().sum();
  return total > static_cast<double>(e.size()) * rounding * rounding ? 1 - rss / total
                                                                     : 1;
}

/// Row j: t^j in powers of z.
MatrixXd powers_of_z(const Graph& g, int degree) {
  const double half = g.half > 0 ? g.half : 1;
  MatrixXd T = MatrixXd::Zero(degree + 1, degree + 1);
  T(0, 0) = 1;
  for (Index j = 1; j <= degree; ++j) {
    T.row(j) = -g.middle / half * T.row(j - 1);
    T.row(j).tail(degree) += T.row(j - 1).head(degree) / half;
  }
  return T;
}

DeviationGraph described(const Graph& g, int degree, const Places& places) {
  const MatrixXd X = columns(g, degree, places);
  const auto [rank, a, root] = least_squares(X, g.e);
  if (rank < X.cols())
    throw ModelRangeError(
        say("chuck: the graph's places do not tell a polynomial of degree {}", degree));
  const VectorXd r = g.e - X * a;
  const Index powers = degree + 1;
  DeviationGraph out;
  out.degrees_of_freedom = static_cast<long>(X.rows() - X.cols());
  out.s_mm = std::sqrt(r.squaredNorm() / static_cast<double>(out.degrees_of_freedom));
  // Roots of the covariance never give a negative variance, also in the presence of
  // rounding.
  const MatrixXd L = out.s_mm * root;
  const MatrixXd T = powers_of_z(g, degree);
  const VectorXd c = T.transpose() * a.head(powers);
  const MatrixXd Lc = T.transpose() * L.topRows(powers);
  for (Index j = 0; j < powers; ++j) {
    out.coefficients.push_back(c[j]);
    out.u_coefficients.push_back(Lc.row(j).norm());
  }
  VectorXd straightened = g.e;
  const auto degrees = static_cast<double>(out.degrees_of_freedom);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Index place = places[k], j = powers + static_cast<Index>(k);
    straightened -= a[j] * X.col(j);
    const double u = L.row(j).norm();
    const double p = u > 0 ? 2 * student_exceeds(std::abs(a[j]) / u, degrees) : 0;
    out.steps.push_back({.after_mm = g.z[place],
                         .before_mm = g.z[place + 1],
                         .height_mm = a[j],
                         .u_mm = u,
                         .p = std::min(1.0, places_for_one(g) * p)});  // Eq. (3)
  }
  out.r2 = r2(r.squaredNorm(), straightened, g.rounding);
  out.r2_as_measured = r2(model(g, degree, {}).rss(), g.e, g.rounding);
  return out;
}

}  // namespace

DeviationGraph deviation_graph(std::span<const double> z_mm, std::span<const double> e_mm,
                               const GraphOptions& options) {
  if (z_mm.size() != e_mm.size() || z_mm.empty())
    throw std::domain_error("deviation_graph: as many errors as places");
  for (std::size_t i = 0; i < z_mm.size(); ++i)
    if (!std::isfinite(z_mm[i] + e_mm[i]))
      throw std::domain_error("deviation_graph: a value is not finite");
  if (!(options.max_degree >= 0 && options.max_degree <= 6 && options.max_steps >= 0 &&
        options.max_steps <= 10))
    throw std::domain_error("deviation_graph: degree 0 to 6, 0 to 10 steps");
  const Graph g = sorted(z_mm, e_mm);
  if (g.at.back() + 1 < options.max_degree + 3)
    throw std::domain_error("deviation_graph: at least max_degree + 3 places");

  const Places places =
      steps(g, options.max_degree, static_cast<std::size_t>(options.max_steps));
  return described(g, best_degree(g, options.max_degree, places), places);
}

}  // namespace turnwright::deflection
