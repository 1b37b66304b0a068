#pragma once
#include <Eigen/Core>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "turnwright/base/interval.hpp"
#include "turnwright/multipass/problem.hpp"

/// The problem in Y = (ln Vr, ln fr, ln dr, ln Vs, ln fs, ln ds), where every limit is a
/// half space.
namespace turnwright::multipass {

inline constexpr double kFar = 100;       ///< bound of ln of every condition
inline constexpr double kBinding = 1e-7;  ///< margins below it bind

enum Variable { kVr, kFr, kDr, kVs, kFs, kDs, kVariables };
using Log = Eigen::Matrix<double, kVariables, 1>;

/// An affine function of Y: the logarithm of a product of powers.
struct Affine {
  Log a = Log::Zero();
  double c = 0;
  double at(const Log& y) const { return c + a.dot(y); }
};
Affine operator+(Affine x, const Affine& y);
Affine operator-(const Affine& x, const Affine& y);
Affine operator*(double s, Affine x);
Affine operator+(Affine x, double ln_factor);

/// ln T, F, .. of roughing (first = kVr) or finishing (first = kVs).
Affine life(const Problem& problem, Variable first);
/// ln of the time of all n roughing passes, or of the finishing pass.
Affine roughing_time(const Problem& problem, int n);
Affine finishing_time(const Problem& problem);

/// A limit g(Y) <= 0, with its value in the literature's units: limit exp(g), or
/// limit exp(-g) of a lower limit.
struct Row {
  std::string name;
  Affine g;
  double limit = 0;
  bool upper = true;
};

/// Every limit of (4) to (8) and the ranges; (8)'s sum of depths apart.
std::vector<Row> rows(const Problem& problem);

/// The depths n dr + ds = dt: ds as a function of dr, in logarithms.
struct Depths {
  double dt_mm = 0;
  int n = 1;
  double finishing(double ln_dr) const;  ///< concave and falling
  double slope(double ln_dr) const;
};

/// Range of ln dr that the rows on depths alone allow; none if they allow nothing.
std::optional<Interval> roughing_depths(const std::vector<Row>& rows,
                                        const Depths& depths);

}  // namespace turnwright::multipass
