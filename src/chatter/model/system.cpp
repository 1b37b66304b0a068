#include "turnwright/chatter/system.hpp"

#include <algorithm>
#include <cmath>

#include "chatter/model/periodic.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::chatter {
namespace {

constexpr double kNoArc = 1e-12;  // of a period: shorter arcs are rounding of angles

double power_law_MPa(const PowerLawForce& f, double tau, double phi) {
  const double s = std::max(std::sin(phi), 0.0);
  return 1e-6 * f.C * f.gamma * std::pow(f.feed_speed_m_s * tau, f.gamma - 1) *
         std::pow(s, f.gamma) * (f.normal_ratio * s + std::cos(phi));  // Eq. (5), N/m2
}

}  // namespace

Engagement up_milling(double immersion) { return {0, std::acos(1 - 2 * immersion)}; }

Engagement down_milling(double immersion) {
  return {std::acos(2 * immersion - 1), units::kPi};
}

double period_s(const System& system, double n_rpm) {
  return 60 / (system.teeth * n_rpm);  // Eq. (3)
}

std::vector<Arc> arcs(const System& system) {
  const double pitch = 2 * units::kPi / system.teeth;
  if (std::holds_alternative<ConstantForce>(system.force))
    return {{.begin_rad = 0, .end_rad = pitch, .offsets_rad = {0}}};
  const double begin = remainder_of(system.entry_rad, pitch);
  const double width = system.exit_rad - system.entry_rad;
  const double more = remainder_of(width, pitch);  // from the last tooth to its exit
  const bool roots = std::holds_alternative<PowerLawForce>(system.force);

  std::vector<Arc> out;
  const auto add = [&](double from, double to) {
    if (!(to - from > kNoArc * pitch)) return;
    Arc arc{.begin_rad = begin + from, .end_rad = begin + to, .offsets_rad = {}};
    const double middle = begin + (from + to) / 2;
    for (int j = 0; j < system.teeth; ++j) {
      const double offset = system.entry_rad - begin + j * pitch;
      const double phi = middle + offset;
      if (phi > system.entry_rad && phi < system.exit_rad) {
        arc.offsets_rad.push_back(offset);
        arc.root_at_begin |= roots && from == 0 && j == 0;
        arc.root_at_end |=
            roots && std::abs(begin + to + offset - system.exit_rad) < kNoArc * pitch;
      }
    }
    out.push_back(std::move(arc));
  };
  const bool whole = more < kNoArc * pitch || pitch - more < kNoArc * pitch;
  if (whole) {
    add(0, pitch);
  } else {
    add(0, more);
    add(more, pitch);
  }
  return out;
}

Directional directional_MPa(const System& system, double n_rpm, const Arc& arc,
                            double angle_rad) {
  if (const auto* constant = std::get_if<ConstantForce>(&system.force))
    return {.xx = constant->K_MPa};
  Directional h;
  for (const double offset : arc.offsets_rad) {
    const double phi = angle_rad + offset;
    if (const auto* law = std::get_if<PowerLawForce>(&system.force)) {
      h.xx += power_law_MPa(*law, period_s(system, n_rpm), phi);
      continue;
    }
    const auto& [Kt, Kn] = std::get<LinearForce>(system.force);
    const double s = std::sin(phi), c = std::cos(phi);
    h.xx += (Kt * c + Kn * s) * s;  // Eq. (4)
    h.xy += (Kt * c + Kn * s) * c;
    h.yx += (-Kt * s + Kn * c) * s;
    h.yy += (-Kt * s + Kn * c) * c;
  }
  return h;
}

}  // namespace turnwright::chatter
