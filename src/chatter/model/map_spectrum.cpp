#include "map_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "eigenvalues.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::chatter {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kDense = 150;  // up to here all eigenvalues are computed

Spectrum of_all(Index size, const LinearMap& map) {
  MatrixXd dense(size, size);
  for (Index i = 0; i < size; ++i) dense.col(i) = map(VectorXd::Unit(size, i));
  const Dominant all = dominant(dense);
  return {.radius = std::abs(all.multiplier), .outside = *all.unstable};
}

/// The spectrum of the Ritz values of `h`, and its error: the largest error of the values
/// outside the unit circle and of the largest one, relative to the largest modulus.  The
/// error of a value is |next| times the last entry of its unit eigenvector.
std::pair<Spectrum, double> of_ritz(const MatrixXd& h, double next) {
  const Eigenpairs ritz = eigenpairs(h);
  const Eigen::ArrayXd moduli = ritz.values.cwiseAbs();
  const Spectrum out{.radius = moduli.maxCoeff(),
                     .outside = static_cast<int>((moduli > 1).count())};
  double moves = 0;
  for (Index i = 0; i < moduli.size(); ++i)
    if (moduli(i) > 1 || moduli(i) == out.radius)
      moves = std::max(moves, next * std::abs(ritz.vectors(h.rows() - 1, i)));
  return {out, moves / out.radius};
}

/// The spectrum by Arnoldi's method, which starts from the same vector every time.
Spectrum by_arnoldi(Index size, const LinearMap& map) {
  constexpr double kSettled = 1e-11, kAccepted = 1e-6, kMemory = 2e7;
  const Index most = std::min<Index>(
      {size, 500, static_cast<Index>(kMemory / static_cast<double>(size))});
  MatrixXd basis(size, most + 1), h = MatrixXd::Zero(most + 1, most);
  for (Index i = 0; i < size; ++i)
    basis(i, 0) = 1 + 0.5 * std::cos(7 * std::pow(static_cast<double>(i), 2));
  basis.col(0).normalize();
  Index look = 30;  // size of the basis at which convergence is tested
  for (Index k = 0; k < most; ++k) {
    leave_if_asked();
    VectorXd next = map(basis.col(k));
    for (int twice = 0; twice < 2; ++twice) {
      const VectorXd part = basis.leftCols(k + 1).transpose() * next;
      next -= basis.leftCols(k + 1) * part;
      h.col(k).head(k + 1) += part;
    }
    h(k + 1, k) = next.norm();
    const bool last = k + 1 == most || !(h(k + 1, k) > 1e-14 * h.col(k).norm());
    if (!last) basis.col(k + 1) = next / h(k + 1, k);
    if (!last && k + 1 < look) continue;
    look += look / 2;
    const auto [found, moves] = of_ritz(h.topLeftCorner(k + 1, k + 1), h(k + 1, k));
    if (moves < kSettled || (last && moves < kAccepted)) return found;
    if (last) break;
  }
  throw ModelRangeError(
      tr("milling: the largest multiplier cannot be told from others as large; ask for a "
         "higher speed"));
}

}  // namespace

Spectrum spectrum_of(Index size, const LinearMap& map) {
  return size <= kDense ? of_all(size, map) : by_arnoldi(size, map);
}

}  // namespace turnwright::chatter
