#include <Eigen/Dense>
#include <unsupported/Eigen/MatrixFunctions>

#include "chatter/model/eigenvalues.hpp"
#include "chatter/model/samples.hpp"
#include "turnwright/chatter/reference_methods.hpp"

namespace turnwright::chatter {
namespace {

using Eigen::MatrixXd;

std::size_t axis_index(Axis axis) { return axis == Axis::x ? 0 : 1; }

/// x = q_1, q_2 of the state u = (eta_i, eta_i'/wn_i), and force -> u'.
struct Matrices {
  MatrixXd A, out, in;
};

Matrices matrices(const System& system) {
  const auto m = static_cast<Eigen::Index>(2 * system.modes.size());
  Matrices x{MatrixXd::Zero(m, m), MatrixXd::Zero(2, m), MatrixXd::Zero(m, 2)};
  for (Eigen::Index k = 0; 2 * k < m; ++k) {
    const Mode& mode = system.modes[static_cast<std::size_t>(k)];
    const auto axis = static_cast<Eigen::Index>(axis_index(mode.axis));
    x.A(2 * k, 2 * k + 1) = mode.wn_rad_s;
    x.A(2 * k + 1, 2 * k) = -mode.wn_rad_s;
    x.A(2 * k + 1, 2 * k + 1) = -2 * mode.zeta * mode.wn_rad_s;
    x.out(axis, 2 * k) = 1;
    x.in(2 * k + 1, axis) = mode.wn_rad_s / mode.k_N_mm;
  }
  return x;
}

}  // namespace

Dominant semi_discretisation(const System& system, double n_rpm, double ap_mm,
                             int intervals) {
  const Matrices x = matrices(system);
  const Eigen::Index m = x.A.rows(), k = intervals, size = m + 2 * k;
  const double step = period_s(system, n_rpm) / intervals;
  const auto all_arcs = arcs(system);

  // Rows of `q` are the displacements at the nodes -k .. k by the state of the period
  // before: (u_0, q_-k .. q_-1).
  MatrixXd u = MatrixXd::Zero(m, size), q = MatrixXd::Zero(2 * (2 * k + 1), size);
  u.leftCols(m).setIdentity();
  q.topRightCorner(2 * k, 2 * k).setIdentity();
  q.middleRows(2 * k, 2) = x.out * u;
  for (Eigen::Index i = 0; i < k; ++i) {
    Eigen::Matrix2d h = Eigen::Matrix2d::Zero();  // mean over the interval
    const double from = static_cast<double>(i) * step;
    for (const Sample& s : samples(system, n_rpm, all_arcs, from, from + step))
      h += s.weight_s / step * Eigen::Matrix2d{{s.h.xx, s.h.xy}, {s.h.yx, s.h.yy}};
    // u' = M u + F (q_old + s dq/step): the exponential of the augmented matrix gives
    // both integrals.
    MatrixXd chain = MatrixXd::Zero(m + 4, m + 4);
    chain.topLeftCorner(m, m) = (x.A - ap_mm * x.in * h * x.out) * step;
    chain.block(0, m, m, 2) = ap_mm * x.in * h * step;
    chain.block(m, m + 2, 2, 2).setIdentity();
    const MatrixXd moved = chain.exp();
    const auto old = q.middleRows(2 * i, 4);
    u = (moved.topLeftCorner(m, m) * u + moved.block(0, m, m, 2) * old.topRows(2) +
         moved.block(0, m + 2, m, 2) * (old.bottomRows(2) - old.topRows(2)))
            .eval();
    q.middleRows(2 * (k + i + 1), 2) = x.out * u;
  }
  MatrixXd monodromy(size, size);
  monodromy.topRows(m) = u;
  monodromy.bottomRows(2 * k) = q.middleRows(2 * k, 2 * k);
  return dominant(monodromy);
}

}  // namespace turnwright::chatter
