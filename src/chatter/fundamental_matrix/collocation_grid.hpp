#pragma once
#include <array>
#include <vector>

#include "chatter/model/free_vibration.hpp"
#include "turnwright/chatter/system.hpp"

namespace turnwright::chatter {

/// An arc with what bounds the response in it.
struct ArcLoad {
  Arc arc;
  double length_s = 0;
  double largest_MPa = 0;  ///< of the directional factors, row sums of moduli (sampled)
};

/// The arcs of a system at one spindle speed.
std::vector<ArcLoad> arc_loads(const System& system, double n_rpm);

/// How finely a propagator is made.  What is integrated turns by 2 `phase_rad` at most
/// in a stretch, and there are so many nodes p that
///
///     (phase_rad/2)^2p / (2p)! <= error                                            (1)
///
/// which is what Gauss's rule leaves of a wave of that phase at the end of a stretch.
struct Resolution {
  double phase_rad = 6;
  double error = 1e-17;
};
inline constexpr Resolution kCoarse{6, 1e-14};
inline constexpr Resolution kFine{5, 1e-19};

/// Collocation on a stretch, as far as it depends on length and grading alone.  With node
/// i at t_i, f a force along an axis,
///
///     int_0^t_i sum_k wn_k/k_k [e^(A_k (t_i - s))]_xv f(s) ds = sum_j K_ij f(t_j)    (2)
///
/// over the modes k of the axis.
///
/// and all states at the end of the stretch are sum_j E_x,j f_x(t_j) + E_y,j f_y(t_j).
struct Kernel {
  double length_s = 0;
  std::vector<double> t_s;                  ///< nodes
  std::vector<Transition> from_begin;       ///< [mode p + node]
  std::array<std::vector<double>, 2> axis;  ///< K of x and y, column by column: [j p + i]
  std::vector<double> end;                  ///< E, [(axis p + j) states + row]
};

/// A stretch of the cut and the free flight after it.
struct Stretch {
  std::size_t kernel = 0;
  std::vector<Directional> h;  ///< at the nodes
  double flight_s = 0;
};

/// One period.
struct Stretches {
  std::vector<Kernel> kernels;
  std::vector<Stretch> all;
  std::vector<std::size_t> axis_of;  ///< of the modes, x 0 and y 1
  std::array<bool, 2> used{};        ///< whether an axis has a mode
};

/// Cut so that on each stretch the Neumann series of |kappa| <= kappa_max_mm does not
/// cancel.  Gauss-Legendre nodes; where h goes like a broken power of the distance from
/// an end the nodes are s^q apart from it, which makes the integrand smooth.
/// @throws ModelRangeError if a period needs more than 20,000.
Stretches stretches(const System& system, const std::vector<ArcLoad>& arcs, double n_rpm,
                    double kappa_max_mm, const Resolution& resolution);

/// About ln |Phi| over one period for |kappa| <= kappa_mm: by this the size of a first
/// series in kappa is chosen; nothing rests on it.
double growth(const System& system, const std::vector<ArcLoad>& arcs, double kappa_mm);

}  // namespace turnwright::chatter
