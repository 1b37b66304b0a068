#pragma once
#include <optional>

#include "modal_state.hpp"
#include "words.hpp"

/// Drilling cycles on the axis that are in force until G80.
namespace turnwright::review {

/// Each block with X or Z drills a hole:
///
///     Fanuc A and B, ISO mode   G83 Z R Q P F   strokes of Q (steps), waits P (ms), R from
///                               where the tool stands; G85 Z R P F back at feed
///     Haas                      G81 Z R F; G82 with P (s); G83 with Q, or I, J, K: strokes
///                               of I, each less by J, K at least; G85, G89 back at feed; R is
///                               a place
///     LinuxCNC                  G81 Z R F; G82 with P (s); G83 with Q, G73 with Q, which
///                               comes back by 0.254 mm alone; G85, G89 back at feed; in G17
///
/// Back to where the tool stood before, or with G99 of LinuxCNC and of system B to R.
/// Source: [LinuxCNC 2.9], which linuxcnc_test runs, [Drilling cycles] in
/// docs/bibliography.md.
class DrillCycleReader {
 public:
  static bool has(gcode::Control control, int code);
  void begin() { z_mm_.reset(), R_mm_.reset(), block_ = {}; }
  /// Drills to a place along Z, that of the block before if it names none.
  /// @throws NotFollowed if it cannot be followed.
  void take(ModalState& s, gcode::Control control, int code, const Block& block,
            std::optional<double> x_mm, std::optional<double> z_mm);

 private:
  double value(const char* name) const { return block_.value(name).value_or(0); }

  std::optional<double> z_mm_, R_mm_;
  Block block_;  // words in force
};

}  // namespace turnwright::review
