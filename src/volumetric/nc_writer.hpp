#pragma once
#include <string>
#include <vector>

#include "turnwright/volumetric/nc_program.hpp"

namespace turnwright::volumetric {

/// Straight moves as blocks of ISO 6983.
class NcWriter {
 public:
  /// @param decimals  of a mm, 0 to 9; inches get two more.
  NcWriter(const NcSetup& setup, int decimals);

  /// The block of a move to `tip_mm`, which becomes what is written: with the words
  /// before the coordinates if it is the `first` of its source's, those after if the
  /// `last`.
  /// @throws ModelRangeError if a coordinate is too far to be written.
  std::string block(const NcMove& move, Vec3& tip_mm, bool first, bool last);

  /// What a block would write of `tip_mm`.
  Vec3 written(const NcMove& move, const Vec3& tip_mm) const;

  /// One in the last decimal of a coordinate [mm].
  double step_mm(const NcMove& move, std::size_t axis) const;

 private:
  int decimals_of(const NcMove& move) const { return decimals_ + (move.inch ? 2 : 0); }
  double append(double value, int decimals);

  std::vector<std::size_t> axes_;
  int decimals_;
  bool absolute_ = false;
  std::string line_;
};

}  // namespace turnwright::volumetric
