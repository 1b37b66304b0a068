#pragma once
#include <Eigen/Dense>
#include <array>
#include <complex>
#include <vector>

#include "chatter/model/engagement.hpp"
#include "chatter/model/quadrature.hpp"

namespace turnwright::chatter {

/// Fineness of the collocation of a motion, (4).
struct Fineness {
  double phase_rad = 0;
  double error = 0;
};
inline constexpr Fineness kPlain{14, 1e-10};
/// Each finer than the last, for errors by kinks that do not lie at nodes.
inline constexpr std::array kFiner{Fineness{12, 1e-13}, Fineness{9, 1e-14},
                                   Fineness{6.5, 1e-15}, Fineness{4.5, 1e-16},
                                   Fineness{3.2, 1e-16}};

/// Collocation of the motion of one period, with several delays and damping.  The
/// unknowns are the state u_0 at the beginning of the period and the forces f at Gauss
/// nodes of the pieces between the breaks of the engagement.  Displacements and
/// velocities at any time follow from them by
///
///     q(t) = C e^(A (t - t_p)) u(t_p) + int_t_p^t C e^(A (t - s)) B f(s) ds          (1)
///
/// from the beginning t_p of the piece, with f the polynomial through the nodes.  For a
/// multiplier mu = 1/z, q before the period is z times q one period later, and
///
///     f(t) = -sum_l H_l (q(t) - q(t - tau_l)) - D q'(t),   u_0 = z u(end)            (2)
///
/// becomes (M_0 + z M_1)(u_0, f) = 0.  M_1 has rows only for u_0 and for the nodes at
/// which a delay reaches before the period, so that the map reduces to few rows W:
///
///     mu are the eigenvalues of -M_1,W (M_0^-1)_W                                    (3)
///
/// Over a piece the phase of the motion changes by 2 `phase_rad` at most, and the number
/// of nodes p is chosen so that the error of interpolation is
///
///     2 (phase/2)^p / p! <= error                                                   (4)
///
/// M_0 is never formed: a motion is followed from piece to piece, with few numbers for each
/// delay.
/// Source: derived here; checked in cutter_test against a direct simulation with the edge
/// cut into slices.
class DelayMap {
 public:
  /// Depths over which the number of pieces and their nodes stay the same, so that the
  /// multipliers of the map, and not only of the motion, are smooth functions of the
  /// depth.
  struct Range {
    double from_mm = 0, to_mm = 0;
  };

  /// @throws ModelRangeError if a period needs more than kMostUnknowns.
  DelayMap(const Cutter& cutter, double n_rpm, double ap_mm, const Range& range,
           const Fineness& fineness);
  DelayMap(const Cutter& cutter, double n_rpm, double ap_mm, const Fineness& fineness)
      : DelayMap(cutter, n_rpm, ap_mm, {ap_mm, ap_mm}, fineness) {}

  const CutterEngagement& contact() const { return contact_; }

  /// Approximate number of operations needed for the multipliers.
  double work() const;
  /// The same for multiplier_near.
  double work_near() const;

  /// The multipliers by falling modulus, without those below 1e-12.
  std::vector<std::complex<double>> multipliers() const;

  /// The multiplier nearest to a number, by inverse iteration on (3).
  std::complex<double> multiplier_near(std::complex<double> mu) const;

  Eigen::Index unknowns() const { return size_; }

  /// Displacement in the stable periodic motion forced by the feed.
  class Forced;
  Forced forced() const;

 private:
  using Matrix = Eigen::MatrixXd;
  /// What of the forces at a piece's nodes follows from the motion in a piece by (1): by
  /// the state at its beginning and the forces at its nodes.
  struct Link {
    std::size_t piece = 0;
    Matrix by_state, by_force;
  };
  /// The parts of (1) at a time of a piece, one row for each axis used.
  struct Rows {
    Matrix by_state, by_force, rate_by_state, rate_by_force;
  };
  struct Piece {
    double begin_s = 0, length_s = 0;
    const Quadrature* rule = nullptr;  // none: free flight
    Eigen::Index first = 0, size = 0;  // unknowns: axis by axis, node by node
    Matrix to_end, push;               // u(end) by u(begin) and by the forces
    Eigen::PartialPivLU<Matrix> own;  // of the equations (2) at the nodes by their forces
    Matrix by_state;                  // of the same by u(begin)
    std::vector<Link> earlier, before;  // delayed motion, in this period and before it
  };
  /// A solution of M_0 x = r, one column for each right side.
  struct Motion {
    std::vector<Matrix> states;  // at the beginning of each piece
    Matrix end, forces;
  };

  double turns(const CutterEngagement& contact) const;
  /// Largest lengths of the pieces between breaks over the range [rad]; the first is
  /// void.
  std::vector<double> longest(double n_rpm, const Range& range) const;
  void lay_out(double turns, const std::vector<double>& longest,
               const Fineness& fineness);
  void connect(Piece& piece) const;
  void assemble(std::size_t at);
  Rows rows_at(const Piece& piece, double offset_s, bool with_rate) const;
  /// The same at the nodes; alike for pieces as long as others.
  const std::vector<Rows>& rows_at_nodes(const Piece& piece);
  /// The piece of a time of the period.
  std::size_t piece_at(double time_s) const;
  /// M_0 is block lower triangular by pieces, for no force depends on a later one.
  /// @param columns  those of the first that are not 0 up to an unknown.
  template <class Columns>
  Motion follow(const Matrix& right, Columns columns) const;
  /// -M_1,W x: what the motion hands to the next period.
  Matrix handed_on(const Motion& motion) const;
  /// Ones in the rows W.
  Matrix units() const;
  Matrix map() const;  // of (3)
  double work_of_map() const;
  /// A block of `load` between the axes used.
  Matrix between_axes(const Directional& h) const;

  const Cutter& cutter_;
  CutterEngagement contact_;
  double rad_s_, period_s_, unit_N_;  // forces are in this unit
  std::vector<std::size_t> axis_of_;  // of the modes, among those used
  std::array<Eigen::Index, 2> row_of_axis_{-1, -1};
  Eigen::Index states_ = 0, axes_ = 0, size_ = 0;
  std::vector<Piece> pieces_;
  std::vector<Eigen::Index> delayed_;  // rows W
  struct NodeRows {
    double length_s = 0;
    const Quadrature* rule = nullptr;
    std::vector<Rows> rows;
  };
  std::vector<NodeRows> node_rows_;  // while the equations are made
  Eigen::VectorXd fed_;
};

class DelayMap::Forced {
 public:
  std::array<double, 2> displacement_mm(double angle_rad) const;

 private:
  friend class DelayMap;
  const DelayMap* map_ = nullptr;
  Motion motion_;
};

inline constexpr Eigen::Index kMostUnknowns = 1800;  // 100 MB

}  // namespace turnwright::chatter
