#pragma once
#include <string>
#include <vector>

#include "turnwright/gcode/read_nc.hpp"

namespace turnwright::gcode {

/// Straight moves as blocks of ISO 6983.
class NcWriter {
 public:
  /// @param decimals  for mm, 0 to 9; inches get two more.
  NcWriter(const NcSetup& setup, int decimals);

  /// Appends the block of a move to `tip_mm`, which is set to the position as written.
  /// The block has the words before the coordinates if it is the `first` one of the
  /// source's move, and the words after them if it is the `last` one.
  /// @throws ModelRangeError if a coordinate is too large to be written.
  std::string block(const NcMove& move, Vec3& tip_mm, bool first, bool last);

  /// `tip_mm` as a block would write it.
  Vec3 written(const NcMove& move, const Vec3& tip_mm) const;

  /// One unit of the last decimal of a coordinate [mm].
  double step_mm(const NcMove& move, std::size_t axis) const;

 private:
  int decimals_of(const NcMove& move) const { return decimals_ + (move.inch ? 2 : 0); }
  double append(double value, int decimals);

  std::vector<std::size_t> axes_;
  int decimals_;
  bool absolute_ = false;
  std::string line_;
};

}  // namespace turnwright::gcode
