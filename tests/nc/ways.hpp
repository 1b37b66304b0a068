#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "turnwright/nc/program.hpp"

/// Programs as ways of their tools' tips.
namespace turnwright::nc::test {

/// A straight way of the tip, in radius and place of the program.
struct Way {
  std::string operation;
  bool rapid = false, thread = false;
  bool centred = false;  ///< with the tailstock's centre, or between centres
  double x0 = 0, z0 = 0, x1 = 0, z1 = 0;
  double f_mm_rev = 0, S = 0;
  double n_max_rpm = 0;  ///< of constant surface speed; 0: S is 1/min
};
using Faults = std::vector<std::string>;

inline std::string listed(const Faults& faults) {
  std::string all;
  for (const auto& f : faults) all += f + '\n';
  return all;
}

/// Whether a program's comment tells to bring up the tailstock's centre.
inline bool brings_centre(const std::string& comment) {
  const auto has = [&](const char* word) { return comment.find(word) != comment.npos; };
  return has("stop:") && (has("tailstock") || has("between centres"));
}

// Arcs as chords within 2e-6 mm.
inline void add_arc(std::vector<Way>& ways, Way w, const Move& m) {
  const double R = std::hypot(w.x0 - m.centre.h_mm, w.z0 - m.centre.z_mm);
  const double a = std::atan2(w.x0 - m.centre.h_mm, w.z0 - m.centre.z_mm);
  double b = std::atan2(m.x_mm - m.centre.h_mm, m.z_mm - m.centre.z_mm);
  // With X up and Z to the right the angle from Z to X rises against the clock.
  if (m.clockwise && b > a) b -= 2 * M_PI;
  if (!m.clockwise && b < a) b += 2 * M_PI;
  const int n = 1 + static_cast<int>(std::abs(b - a) * R / std::sqrt(1.6e-5 * R));
  for (int i = 1; i <= n; ++i) {
    const double t = a + (b - a) * i / n;
    w.x1 = m.centre.h_mm + R * std::sin(t);
    w.z1 = m.centre.z_mm + R * std::cos(t);
    ways.push_back(w);
    w.x0 = w.x1;
    w.z0 = w.z1;
  }
}

inline std::vector<Way> ways_of(const SetupProgram& program,
                                const planning::SetupPlan& plan) {
  std::vector<Way> ways;
  std::size_t operation = 0;
  double x = 0, z = 0;
  bool known = false, centred = false;
  for (const auto& step : program.steps) {
    if (step.stop) {
      for (const auto& told : step.comments) centred = centred || brings_centre(told);
      continue;
    }
    Way w;
    w.centred = centred;
    w.operation = plan.operations[operation++].id;
    if (step.milling) continue;  // comes back to where tools are changed
    w.f_mm_rev = step.f_mm_rev;
    w.S = step.S;
    w.n_max_rpm = step.constant_surface_speed ? std::floor(step.n_max_rpm) : 0;
    for (const auto& m : step.moves) {
      w.rapid = m.kind == Move::Kind::rapid;
      w.thread = m.kind == Move::Kind::thread;
      w.x0 = known ? x : m.x_mm;
      w.z0 = known ? z : m.z_mm;
      w.x1 = x = m.x_mm;
      w.z1 = z = m.z_mm;
      known = true;
      if (m.kind == Move::Kind::arc)
        add_arc(ways, w, m);
      else
        ways.push_back(w);
    }
  }
  return ways;
}

}  // namespace turnwright::nc::test
