#pragma once
#include <complex>
#include <optional>
#include <vector>

#include "turnwright/chatter/frf.hpp"

/// Stabilisation diagram of a measured frequency response: the poles of models of rising
/// order.  What vibrates has the same pole in all of them that are high enough; noise has
/// another one in each.
namespace turnwright::chatter {

/// A pole, as a mode of (1) in frf.hpp.
struct DiagramPole {
  double wn_rad_s = 0, zeta = 0;
  std::complex<double> compliance_mm_N;  ///< 1/k; that of a mode is real
  /// What the nearest pole of the order below shares with it, each only with those before:
  /// the frequency to 1 %, the damping ratio to 5 %, the compliance to 10 %.
  enum class Stable { no, frequency, damping, all } stable = Stable::no;
  int in_a_row = 0;  ///< orders up to this one in which it is stable in all
};

struct DiagramOrder {
  int order = 0;                   ///< n of (1), (2)
  std::vector<DiagramPole> poles;  ///< of the band and damped, rising in frequency
};

/// What the diagram says of a fitted mode.
struct SettledMode {
  /// The first of three orders in a row in which the mode's pole is stable in all; none:
  /// there are no such three.
  std::optional<int> from_order;
  int orders = 0;  ///< in which it is
  /// (4) without this mode over (4) with it; none: there is no other.
  std::optional<double> depth_without;
};

/// A pole that is stable in five orders in a row or more and that no fitted mode explains.
struct UnfittedMode {
  double wn_rad_s = 0, zeta = 0, k_N_mm = 0;  ///< in the last of them
  int from_order = 0, to_order = 0;
  double depth_with = 1;  ///< (4) with this mode over (4) of the fitted ones
};

struct Stabilisation {
  std::vector<DiagramOrder> orders;    ///< n = 1, 2, ..
  std::vector<SettledMode> modes;      ///< those of the fit, in its order
  std::vector<UnfittedMode> unfitted;  ///< rising in frequency
};

/// Least squares of a common-denominator model in z = e^((s - i w_1) T), T such that the
/// lines from w_1 on fill nine tenths of the unit circle:
///
///     sum |A(z) Y - B(z)|^2 / s^2 = min,   A = 1 + sum_1^n a_j z^j,  B = sum_0^n b_j z^j (1)
///
/// s is the size of the errors of a line where the response comes with them, else 1.  With P
/// of the rows z^j / s and Q of -Y z^j / s, b is taken out of the normal equations,
///
///     M a = 0 but in its first row,   M = Q*Q - (P*Q)* (P*P)^-1 P*Q                     (2)
///
/// and the blocks of the highest order contain those of the lower ones.  The coefficients are
/// complex, because the band does not begin at 0.  As the lowest one is fixed, the poles that
/// only serve noise fall outside the unit circle, where they would grow, and are not told
/// [Cauberghe 2005].  Poles are the roots z_r of A,
///
///     s_r = i w_1 + ln(z_r)/T,   1/k = 2 i Im(s_r) B(z_r) / (A'(z_r) T z_r s_r^d wn^2)  (3)
///
/// by the residue, wn = |s_r|; the damping A of a window is taken out of them.  n goes up to
/// 40, at most to a third of the lines.
///
/// Along one axis the least depth that chatters at the worst speed goes like
///
///     -1 / min over w of Re H(w)                                                        (4)
///
/// [Tlusty 1963] with H of the modes; so a mode that is none, or one that is missing, makes
/// the told depth wrong by the factor given.
///
/// Of a single response the shape of a mode is one number, its compliance.  The poles are
/// those of least squares of (1), not of (1) in frf.hpp: in noise their damping is too small,
/// and weak modes settle late or never although the fit finds them.
/// Source: [Peeters 2004] for (1) and (2), here with one response; [Heylen 2007] for the
/// diagram, its bounds 1 % and 5 %; the bound of the compliance, the three and the five in a
/// row are chosen here, checked in stabilisation_test on responses of known modes.
Stabilisation stabilisation(const FrequencyResponse& response, const ModalFit& fit);

}  // namespace turnwright::chatter
