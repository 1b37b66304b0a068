#pragma once
#include <numbers>

/// The one place where units are converted.  Mechanics computes in mm, N, MPa, s, rad;
/// cutting and the documents keep their usual units (m/min, mm/rev, min, um, degC).
namespace turnwright::units {

inline constexpr double kPi = std::numbers::pi;

constexpr double rad_from_deg(double deg) { return deg * kPi / 180.0; }
constexpr double deg_from_rad(double rad) { return rad * 180.0 / kPi; }
constexpr double mm_from_um(double um) { return um / 1000.0; }
constexpr double um_from_mm(double mm) { return mm * 1000.0; }

/// Spindle speed [1/min] of cutting speed vc [m/min] at diameter d [mm]; any scalar type.
template <class T>
T spindle_rpm(const T& vc_m_min, double d_mm) {
  return vc_m_min * (1000.0 / (kPi * d_mm));
}

/// Cutting speed [m/min] of a spindle speed [1/min] at diameter d [mm].
template <class T>
T cutting_speed_m_min(const T& n_rpm, double d_mm) {
  return n_rpm * (kPi * d_mm / 1000.0);
}

/// Cutting power [kW] of the cutting force [N] at a speed [m/min].
template <class T>
T power_kW(const T& Fc_N, const T& vc_m_min) {
  return Fc_N * vc_m_min * (1.0 / 60000.0);
}

/// Torque [Nm] of the cutting force [N] at diameter d [mm].
template <class T>
T torque_Nm(const T& Fc_N, double d_mm) {
  return Fc_N * (d_mm / 2000.0);
}

/// Power [kW] of a torque [Nm] at a spindle speed [1/min].
constexpr double shaft_power_kW(double M_Nm, double n_rpm) {
  return M_Nm * n_rpm * kPi / 30000.0;
}

}  // namespace turnwright::units
