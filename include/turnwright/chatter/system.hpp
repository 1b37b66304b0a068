#pragma once
#include <variant>
#include <vector>

#include "turnwright/base/errors.hpp"

/// Regenerative vibration: a tool cuts the waves that its own vibration has left on the
/// workpiece.
///
///     eta_i'' + 2 zeta_i wn_i eta_i' + wn_i^2 eta_i = (wn_i^2 / k_i) F_axis(i)      (1)
///     F = -w sum_j g_j h(phi_j) (q(t) - q(t - tau)),   q_a = sum of eta_i on axis a (2)
///     tau = 60 / (N n),   phi_j = 2 pi n t / 60 + 2 pi j / N                        (3)
///
/// eta_i displacement of mode i [mm], wn_i its natural frequency [rad/s], zeta_i its
/// damping ratio, k_i its stiffness [N/mm]; q displacement at the cut along x (feed) and
/// y [mm]; w axial depth [mm]; h directional factors [MPa]; g_j = 1 while tooth j is in
/// the cut, else 0; N teeth, n spindle speed [1/min]; tau tooth period [s]; phi angle of
/// a tooth from y. An axis without a mode is rigid.
///
/// Linear in the displacements: no tooth leaves the cut by vibrating; forces are
/// proportional to the depth (no helix) and the teeth are alike.
namespace turnwright::chatter {

enum class Axis { x, y };

struct Mode {
  Axis axis = Axis::x;
  double wn_rad_s = 0;  ///< > 0
  double zeta = 0;      ///< > 0
  double k_N_mm = 0;    ///< > 0
};

/// Forces proportional to the chip thickness, with s = sin phi, c = cos phi:
///
///     h_xx = (Kt c + Kn s) s     h_xy = (Kt c + Kn s) c                             (4)
///     h_yx = (-Kt s + Kn c) s    h_yy = (-Kt s + Kn c) c
struct LinearForce {
  double Kt_MPa = 0;  ///< tangential, > 0
  double Kn_MPa = 0;  ///< normal, towards the tooth's centre, >= 0
};

/// A power law of the chip thickness, linearised about the feed per tooth v tau, along x:
///
///     h = C gamma (v tau)^(gamma - 1) sin^gamma(phi) (normal_ratio sin(phi) + cos(phi))
///                                                                                   (5)
///
/// Source: [Ozoegwu 2013], Eq. (3), whose third tooth has lost "[0.3 sin +" in print.
struct PowerLawForce {
  double C = 0;               ///< [N m^-(1 + gamma)], > 0
  double gamma = 0;           ///< in (0, 1]
  double feed_speed_m_s = 0;  ///< v, > 0
  double normal_ratio = 0;    ///< normal over tangential force, >= 0
};

/// A constant factor along x, for turning and boring.
struct ConstantForce {
  double K_MPa = 0;  ///< > 0
};

using Force = std::variant<LinearForce, PowerLawForce, ConstantForce>;

struct System {
  std::vector<Mode> modes;
  int teeth = 1;
  double entry_rad = 0, exit_rad = 0;  ///< a tooth cuts from entry to exit, in [0, pi]
  Force force;
};

/// Angles between which a tooth cuts; immersion = radial depth over diameter, in (0, 1].
struct Engagement {
  double entry_rad = 0, exit_rad = 0;
};
Engagement up_milling(double immersion);    ///< 0 to acos(1 - 2 immersion)
Engagement down_milling(double immersion);  ///< acos(2 immersion - 1) to pi

/// Thrown if a period has so many vibrations that a search would take more than a few
/// seconds; at slower speeds and greater depths it has more.
class TooManyVibrations : public ModelRangeError {
 public:
  using ModelRangeError::ModelRangeError;
};

/// The tooth period tau of (3) [s].
double period_s(const System& system, double n_rpm);

/// A part of a period in which the same teeth cut, so that h is smooth inside it.
struct Arc {
  double begin_rad = 0, end_rad = 0;  ///< of the angle 2 pi n t / 60
  std::vector<double> offsets_rad;    ///< of the teeth in the cut; none: no tooth cuts
  bool root_at_begin =
      false;  ///< h behaves like a fractional power of the distance there
  bool root_at_end = false;
};

/// The arcs of one period in their order.  The first begins where a tooth enters.
std::vector<Arc> arcs(const System& system);

/// Directional factors: sum_j g_j h(phi_j) [MPa] at an angle of an arc.
struct Directional {
  double xx = 0, xy = 0, yx = 0, yy = 0;
};
Directional directional_MPa(const System& system, double n_rpm, const Arc& arc,
                            double angle_rad);

}  // namespace turnwright::chatter
