#include "mode_reader.hpp"

#include "turnwright/base/language.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::document {

using chatter::Axis;
using chatter::Mode;

double stiffness_N_mm(double mass_kg, double wn_rad_s) {
  return mass_kg * wn_rad_s * wn_rad_s / 1000;  // N/m to N/mm
}

namespace {

/// Stiffness, given directly or by a mass.
double read_stiffness(Reader& r, double wn_rad_s) {
  const auto mass = r.optional_number("mass_kg", kModeMass);
  const auto stiffness = r.optional_number("stiffness_N_mm", within(1e-6, 1e12, "N/mm"));
  if (mass && stiffness)
    r.problem_at("mass_kg", tr("either mass_kg or stiffness_N_mm"), "exclusive");
  else if (!mass && !stiffness)
    r.problem_at("stiffness_N_mm", tr("stiffness_N_mm or mass_kg"), "missing");
  return mass ? stiffness_N_mm(*mass, wn_rad_s) : stiffness.value_or(1);
}

}  // namespace

Mode read_mode(Reader r, Axis axis, std::optional<double> damping) {
  Mode mode{.axis = axis};
  mode.wn_rad_s = 2 * units::kPi * r.number("frequency_Hz", within(0.1, 1e6, "Hz"));
  mode.zeta = damping ? r.number_or("damping_ratio", kModeDamping, *damping)
                      : r.number("damping_ratio", kModeDamping);
  mode.k_N_mm = read_stiffness(r, mode.wn_rad_s);
  r.finish();
  return mode;
}

}  // namespace turnwright::document
