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
  class Forced {
   public:
    std::array<double, 2> displacement_mm(double angle_rad) const;

   private:
    friend class DelayMap;
    const DelayMap* map_ = nullptr;
    Eigen::VectorXd x_;
  };
  Forced forced() const;

 private:
  using Matrix = Eigen::MatrixXd;
  struct Piece {
    double begin_s = 0, length_s = 0;
    const Quadrature* rule = nullptr;  // none: free flight
    Eigen::Index first = 0;            // unknown: axis by axis, node by node
    Matrix state;                      // u(begin) by the unknowns before `first`
  };
  /// Rows of (1) by the unknowns, one for each axis used.
  struct Rows {
    Matrix q, rate;
  };

  double turns(const CutterEngagement& contact) const;
  /// Largest lengths of the pieces between breaks over the range [rad]; the first is
  /// void.
  std::vector<double> longest(double n_rpm, const Range& range) const;
  void lay_out(double turns, const std::vector<double>& longest,
               const Fineness& fineness);
  void connect();
  void assemble();
  Rows rows_at(const Piece& piece, double offset_s) const;
  Rows rows_at(double time_s) const;
  /// (M_0^-1)_W.  M_0 is block lower triangular by pieces, for no force depends on a
  /// later one.
  Matrix inverse_columns() const;
  Matrix map() const;  // of (3)
  /// A block of `load` between the axes used.
  Matrix between_axes(const Directional& h) const;

  const Cutter& cutter_;
  CutterEngagement contact_;
  double rad_s_, period_s_, unit_N_;  // forces are in this unit
  std::vector<std::size_t> axis_of_;  // of the modes, among those used
  std::array<Eigen::Index, 2> row_of_axis_{-1, -1};
  Eigen::Index states_ = 0, axes_ = 0, size_ = 0;
  std::vector<Piece> pieces_;
  Matrix last_;  // u(end)
  Matrix m0_, m1_;
  std::vector<Eigen::Index> delayed_;  // rows of m1_
  Eigen::VectorXd fed_;
};

inline constexpr Eigen::Index kMostUnknowns = 1800;  // 100 MB

}  // namespace turnwright::chatter
