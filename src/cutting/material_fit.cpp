#include "turnwright/cutting/material_fit.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "base/say.hpp"
#include "pooled_labs.hpp"
#include "regression.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/least_squares.hpp"

namespace turnwright::cutting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLeastThickness = 0.04879;  // ln 1.05

void require(bool good) {
  if (!good) throw std::domain_error("material_fit: a measurement is not positive");
}
bool positive(double x) { return x > 0 && std::isfinite(x); }

// The line with one intercept for each lab, brought down to that of the pooled lab.
Line pooled_line(const Line& line, const LabColumns& labs, const MatrixXd& columns,
                 const std::vector<std::size_t>& lab_of_row, const FitOptions& options,
                 KienzleFit& fit) {
  const auto k = static_cast<Index>(labs.names.size());
  auto& e = fit.evidence;
  const PooledLabs p =
      pooled_labs(line, k, columns(e.used, Eigen::all), options.confidence);
  e.s_prediction = p.s_prediction;
  fit.labs = labs_of(labs, lab_of_row, e.used, p.s_between);
  for (Index j = 0; j < k; ++j)
    fit.labs->each[static_cast<std::size_t>(j)].factor =
        exponential(interval(p.deviations, j, 1, options.confidence));
  return p.line;
}

}  // namespace

KienzleFit fit_kienzle(std::span<const ForcePoint> cuts, const FitOptions& options) {
  KienzleFit fit;
  const auto n = static_cast<Index>(cuts.size());
  VectorXd x(n), y(n);
  std::vector<std::size_t> lab_of_row;
  for (Index i = 0; i < n; ++i) {
    const ForcePoint& p = cuts[static_cast<std::size_t>(i)];
    require(positive(p.h_mm) && positive(p.b_mm) && positive(p.F_N));
    x[i] = std::log(p.h_mm);
    y[i] = std::log(p.F_N / (p.b_mm * p.h_mm));  // (1)
    lab_of_row.push_back(p.lab);
  }
  const auto nothing = [&](const std::string& test) {
    for (const char* name : {"k1.1", "m"}) fit.missing.push_back({name, test});
    return fit;
  };
  const auto another = tr("a cut at another chip thickness (another feed)");
  if (n == 0 || x.maxCoeff() - x.minCoeff() < kLeastThickness) return nothing(another);
  const LabColumns labs = lab_columns(lab_of_row);
  const auto k = labs.X.cols();
  if (n < k + 2)
    return nothing(k == 1 ? tr("a third cut, to judge the errors by")
                          : tr("as many cuts as there are labs and two more"));
  if (labs.several() && spread(labs.X, x) < kLeastThickness / 2)
    return nothing(say("{} in the same lab", another));
  MatrixXd X(n, k + 1);
  X << labs.X, x;
  Line line = robust_line(X, y, options.outlier_p, fit.evidence);
  if (labs.several()) line = pooled_line(line, labs, x, lab_of_row, options, fit);
  fit.k11_MPa = exponential(interval(line, 0, 1, options.confidence));
  fit.m = interval(line, 1, -1, options.confidence);
  return fit;
}

namespace {

// Eq. (3) for F = A theta; none if the columns cannot be told apart or a force would not be
// positive.  A theta/F = 1 is the start.
std::optional<Line> thrust_line(const MatrixXd& A, const VectorXd& F,
                                const FitOptions& options, Evidence& evidence) {
  constexpr int kSteps = 50;
  constexpr double kNear = 1e-13;
  if (A.rows() <= A.cols() + 1 && A.cols() > 1) return std::nullopt;
  try {
    VectorXd theta =
        least_squares(F.cwiseInverse().asDiagonal() * A, VectorXd::Ones(F.size())).x;
    for (int step = 0;; ++step) {
      const VectorXd said = A * theta;
      if (!(said.minCoeff() > 0)) return std::nullopt;
      const MatrixXd J = said.cwiseInverse().asDiagonal() * A;
      const VectorXd y = F.cwiseQuotient(said).array().log() + 1;  // J theta = 1
      evidence = {};
      const Line r = robust_line(J, y, options.outlier_p, evidence);
      if ((r.c - theta).norm() <= kNear * theta.norm() || step == kSteps) return r;
      theta = r.c;
    }
  } catch (const ModelRangeError&) {
    return std::nullopt;
  }
}

}  // namespace

ThrustFit fit_thrust(std::span<const ThrustPoint> cuts, const catalogue::Thrust& given,
                     const FitOptions& options) {
  ThrustFit fit;
  const auto n = static_cast<Index>(cuts.size());
  MatrixXd A(n, 2);
  VectorXd F(n);
  for (Index i = 0; i < n; ++i) {
    const ThrustPoint& p = cuts[static_cast<std::size_t>(i)];
    require(positive(p.Fc_N) && positive(p.L_mm) && positive(p.share) && positive(p.F_N));
    A.row(i) << p.Fc_N * p.share, p.L_mm * p.share;
    F[i] = p.F_N;
  }
  if (n < 3) return fit;
  const auto both = thrust_line(A, F, options, fit.evidence);
  if (both && both->c.minCoeff() >= 0) {
    fit.ratio = interval(*both, 0, 1, options.confidence);
    fit.edge_N_mm = interval(*both, 1, 1, options.confidence);
    return fit;
  }
  fit.scaled = true;
  const MatrixXd whole = A * Eigen::Vector2d(given.ratio, given.edge_N_mm);
  const auto one = thrust_line(whole, F, options, fit.evidence);
  fit.ratio = interval(*one, 0, given.ratio, options.confidence);
  fit.edge_N_mm = interval(*one, 0, given.edge_N_mm, options.confidence);
  return fit;
}

}  // namespace turnwright::cutting
