#pragma once
#include <array>
#include <memory>
#include <vector>

#include "chatter/model/engagement.hpp"
#include "chatter/model/free_vibration.hpp"
#include "turnwright/chatter/system.hpp"

namespace turnwright::chatter {

/// An arc with a bound of the forces in it.
struct ArcLoad {
  Arc arc;
  double length_s = 0;
  double largest_MPa = 0;  ///< largest row sum of moduli of the directional factors
  std::shared_ptr<const CutterEngagement> helical = {};  ///< null for straight edges
  /// The directional factors at an angle of the arc.
  Directional h_MPa(const System& system, double n_rpm, double angle_rad) const;
};

/// The arcs of a system at one spindle speed.
std::vector<ArcLoad> arc_loads(const System& system, double n_rpm);

/// The same of helical edges with one delay at one depth of cut.  Their directional factors
/// are integrals over the height [N/mm], so that kappa = 1 - z for this depth has no unit.
std::vector<ArcLoad> helical_arc_loads(const Cutter& cutter, double n_rpm, double ap_mm);

/// Resolution of a propagator.  The phase of the integrands changes by 2 `phase_rad` at
/// most in a collocation interval, and the number of nodes p is chosen so that
///
///     (phase_rad/2)^2p / (2p)! <= error                                            (1)
///
/// which is the error of Gauss' rule for a wave of that phase at the end of an interval.
struct Resolution {
  double phase_rad = 6;
  double error = 1e-17;
};
inline constexpr Resolution kCoarse{6, 1e-14};
inline constexpr Resolution kFine{5, 1e-19};

/// The part of collocation on an interval that depends only on its length and grading.
/// With node i at t_i and a force f along an axis,
///
///     int_0^t_i sum_k wn_k/k_k [e^(A_k (t_i - s))]_xv f(s) ds = sum_j K_ij f(t_j)    (2)
///
/// over the modes k of the axis, and all states at the end of the interval are
/// sum_j E_x,j f_x(t_j) + E_y,j f_y(t_j).
struct Kernel {
  double length_s = 0;
  std::vector<double> t_s;                  ///< nodes
  std::vector<Transition> from_begin;       ///< [mode p + node]
  std::array<std::vector<double>, 2> axis;  ///< K of x and y, column by column: [j p + i]
  std::vector<double> end;                  ///< E, [(axis p + j) states + row]
};

/// A collocation interval of the cut, and the free vibration after it if no tooth cuts.
struct Stretch {
  std::size_t kernel = 0;
  std::vector<Directional> h;  ///< at the nodes
  double flight_s = 0;
};

/// The collocation intervals of one period.
struct Stretches {
  std::vector<Kernel> kernels;
  std::vector<Stretch> all;
  std::vector<std::size_t> axis_of;  ///< of the modes, x 0 and y 1
  std::array<bool, 2> used{};        ///< whether an axis has a mode
};

/// Divides a period so that the Neumann series for |kappa| <= kappa_max_mm has no
/// cancellation on any interval.  The nodes are Gauss-Legendre nodes; where h behaves
/// like a fractional power of the distance from an end they are graded as s^q, which
/// makes the integrand smooth.
/// @throws ModelRangeError if a period needs more than 20,000 intervals.
Stretches stretches(const System& system, const std::vector<ArcLoad>& arcs, double n_rpm,
                    double kappa_max_mm, const Resolution& resolution);

/// Estimate of ln |Phi| over one period for |kappa| <= kappa_mm.  It serves to choose the
/// size of the first series in kappa; no result rests on it.
double growth(const System& system, const std::vector<ArcLoad>& arcs, double kappa_mm);

}  // namespace turnwright::chatter
