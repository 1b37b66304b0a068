#include "turnwright/cutting/life_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <string>

#include "base/say.hpp"
#include "censored_line.hpp"
#include "life_design.hpp"

namespace turnwright::cutting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLeastSpread = 0.02;

// Rows of labs in which some life ended.
std::vector<std::size_t> telling(const LifeRows& all) {
  std::set<std::size_t> labs;
  for (const std::size_t i : all.ended()) labs.insert(all.lab[i]);
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < all.lab.size(); ++i)
    if (labs.contains(all.lab[i])) which.push_back(i);
  return which;
}

// Which exponents the lives that ended determine, and what is missing.
struct Determined {
  bool n = false, a = false, b = false;
};
Determined determined(const LifeRows& ended, double given_a,
                      std::vector<Missing>& missing) {
  Determined d;
  MatrixXd X = lab_columns(ended.lab).X;
  d.n = ended.size() > 0 && spread(X, ended.v) >= kLeastSpread;
  if (!d.n) return d;
  const auto append = [&](const VectorXd& column) {
    X.conservativeResize(Eigen::NoChange, X.cols() + 1);
    X.col(X.cols() - 1) = column;
  };
  append(ended.v);
  d.a = spread(X, ended.f) >= kLeastSpread;
  if (d.a) {
    append(ended.f);
  } else {
    X.col(X.cols() - 1) += given_a * ended.f;
    missing.push_back({"a", tr("a tool life at another feed, speed unchanged")});
  }
  d.b = spread(X, ended.d) >= kLeastSpread;
  if (!d.b)
    missing.push_back(
        {"b", tr("a tool life at another depth, speed and feed unchanged")});
  return d;
}

Line life_line(const MatrixXd& X, const LifeRows& rows, double outlier_p, Evidence& e) {
  if (!rows.censored()) return robust_line(X, rows.y, outlier_p, e);
  const Line line = censored_line(X, rows.y, rows.longer, LifeErrors::normal).line;
  e.used.resize(static_cast<std::size_t>(rows.size()));
  std::iota(e.used.begin(), e.used.end(), std::size_t{0});
  e.degrees_of_freedom = static_cast<int>(line.degrees);
  e.s = line.s;
  e.s_prediction = prediction_s(e.s, rows.ended().size());
  return line;
}

// C, n, a, b and the labs' factors on C from the coefficients of (1).
void constants_of(const Line& line, const Determined& d, double t, TaylorFit& fit) {
  const double half = t * std::sqrt(line.covariance(1, 1));
  fit.n = ends(-1 / line.c[1], -1 / (line.c[1] - half), -1 / (line.c[1] + half));
  fit.C = exponential(ratio(line, 0, 1, t));
  const auto exponent = [&](Index j) {  // a = c_j/c_1
    const Estimate e = ratio(line, j, 1, t);
    return Estimate{-e.value, -e.upper, -e.lower};
  };
  if (d.a) fit.a = exponent(2);
  if (d.b) fit.b = exponent(d.a ? 3 : 2);
}

// One intercept for each lab brought down to that of the pooled lab.
Line with_labs(const Line& line, const LabColumns& labs, const MatrixXd& columns,
               const LifeRows& rows, const FitOptions& options, TaylorFit& fit) {
  const auto k = static_cast<Index>(labs.names.size());
  auto& e = fit.evidence;
  const PooledLabs p =
      pooled_labs(line, k, columns(e.used, Eigen::all), options.confidence);
  e.s_prediction = p.s_prediction;
  fit.labs = labs_of(labs, rows.lab, e.used, p.s_between);
  const double t = student(options.confidence, line.degrees);
  for (Index j = 0; j < k; ++j)
    fit.labs->each[static_cast<std::size_t>(j)].factor =
        exponential(ratio(p.deviations, j, k, t));
  return p.line;
}

}  // namespace

TaylorFit fit_taylor(std::span<const LifePoint> lives, double given_a, double given_b,
                     const FitOptions& options) {
  TaylorFit fit;
  const LifeRows all(lives);
  const auto names = telling(all);
  const LifeRows rows = all.rows(names);
  const LifeRows ended = rows.rows(rows.ended());
  const auto nothing = [&](const std::string& test) {
    fit.missing.insert(fit.missing.begin(), {{"n", test}, {"C", test}});
    return fit;
  };
  if (ended.size() == 0 && all.size() > 0)
    return nothing(tr("tool lives that ended, at two cutting speeds"));
  const Determined d = determined(ended, given_a, fit.missing);
  if (!d.n) return nothing(tr("a tool life at another cutting speed"));
  const LabColumns labs = lab_columns(rows.lab);
  const MatrixXd columns = life_columns(rows, d.a, d.b, given_a, given_b);
  MatrixXd X(rows.size(), labs.X.cols() + columns.cols());
  X << labs.X, columns;
  if (ended.size() < X.cols() + 1)
    return nothing(
        rows.censored()
            ? say("as many tool lives that ended as there are constants and one more: {}",
                  X.cols() + 1)
            : say("as many tool lives as there are constants and one more: {}",
                  X.cols() + 1));

  Line line = life_line(X, rows, options.outlier_p, fit.evidence);
  const Index slope = labs.X.cols();
  const double t = student(options.confidence, line.degrees);
  if (!(line.c[slope] + t * std::sqrt(line.covariance(slope, slope)) < 0)) {
    fit.evidence.rename(names);
    return nothing(
        tr("tool lives at speeds further apart, for the life does not fall with "
           "the speed beyond doubt"));
  }
  if (labs.several()) line = with_labs(line, labs, columns, rows, options, fit);
  constants_of(line, d, t, fit);
  fit.evidence.rename(names);
  return fit;
}

}  // namespace turnwright::cutting
