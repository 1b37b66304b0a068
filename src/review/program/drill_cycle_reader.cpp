#include "drill_cycle_reader.hpp"

#include <algorithm>
#include <cmath>

#include "cycles.hpp"
#include "parameters.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::review {
namespace {

using gcode::Control;

constexpr double kLinuxCncBack_mm = 0.254;  // fixed in its interpreter
constexpr double kBackIsSetting_mm = 0.5;   // a parameter or setting of the others
constexpr double kMostHoles = 9999;

bool like_haas(Control c) { return c == Control::haas || c == Control::linuxcnc; }

// How often a block drills: L of Haas and LinuxCNC, K of the others.
double repeats(Control control, const Block& block) {
  const double times = block.value(like_haas(control) ? "L" : "K").value_or(1);
  return std::clamp(std::floor(times), 0.0, kMostHoles);
}

}  // namespace

bool DrillCycleReader::has(Control control, int code) {
  if (control == Control::okuma || control == Control::siemens) return false;
  if (code == 83 || code == 85) return true;
  if (code == 73) return control == Control::linuxcnc;
  return like_haas(control) && (code == 81 || code == 82 || code == 89);
}

void DrillCycleReader::take(ModalState& s, Control control, int code, const Block& block,
                            std::optional<double> x_mm, std::optional<double> z_mm) {
  const bool linuxcnc = control == Control::linuxcnc;
  if (linuxcnc && (s.plane != 17 || s.incremental))
    throw NotFollowed(tr("Drilling cycles are followed in G17 with G90."));
  for (const auto& w : block.words) {
    std::erase_if(block_.words, [&](const Word& old) { return old.name == w.name; });
    if (std::string_view("QPIJK").find(w.name) != std::string_view::npos)
      block_.words.push_back(w);
  }
  if (z_mm) z_mm_ = z_mm;
  if (linuxcnc || (x_mm && x_mm != s.x_mm))
    s.straight(toolpath::Move::Kind::rapid, x_mm, s.z_mm);
  if (!z_mm_ || !s.z_mm) throw NotFollowed(tr("Z was not given before or in it."));
  const auto R = block.value("R");
  if (R) R_mm_ = s.mm(*R) + (like_haas(control) ? 0 : *s.z_mm);
  DrillCycle d{.from_z_mm = R_mm_.value_or(*s.z_mm), .away_z_mm = *s.z_mm};
  if (s.to_plane_R) d.away_z_mm = d.from_z_mm;
  const double depth = std::abs(d.from_z_mm - *z_mm_);
  const auto* Q = block_.find("Q");
  double first = depth, least = depth, less = 0;
  if (Q && (code == 83 || code == 73)) {
    first = least =
        like_haas(control) ? s.mm(*Q->value) : s.steps_mm(*Q->value, Q->point);
  } else if (code == 83 && control == Control::haas && block_.find("I")) {
    first = s.mm(value("I")), less = s.mm(value("J")), least = s.mm(value("K"));
  }
  d.strokes_z_mm = strokes(d.from_z_mm, *z_mm_, first,
                           [&](double before) { return std::max(before - less, least); });
  d.clears = code != 73;
  d.before_mm = linuxcnc ? kLinuxCncBack_mm : kBackIsSetting_mm;
  d.retract_mm = kLinuxCncBack_mm;
  if (!linuxcnc && d.strokes_z_mm.size() > 1)
    s.assume(tr(
        "G83 comes out of the hole after each stroke and feeds again 0.5 mm before the "
        "depth reached; parameters of the control say so."));
  const auto* P = block_.find("P");
  const bool ms = P && !linuxcnc && !P->point;
  d.wait_bottom_min = P && code != 81 ? *P->value / (ms ? 1000 : 1) / 60 : 0;
  if (code == 85 || code == 89) d.feed_out = s.F;
  d.feeds_away = linuxcnc && code == 89;
  for (double k = 0; k < repeats(control, block) && !s.full(); ++k) {
    if (linuxcnc && k > 0) s.straight(toolpath::Move::Kind::rapid, s.x_mm, s.z_mm);
    drill_cycle(s, d);
  }
}

}  // namespace turnwright::review
