#pragma once
#include <string>
#include <utility>
#include <vector>

/// The shares of a tolerance's width, stacked end to end.
namespace turnwright::report {

using Shares = std::vector<std::pair<std::string, double>>;  ///< source, um on its own

struct Stack {
  Shares slices;       ///< deflection first
  double left_um = 0;  ///< rest of the width; negative if the shares exceed it

  /// Whether the shares exceed the width by more than rounding.
  bool over() const { return left_um < -1e-3; }
};

/// Shares of one tolerance such that they and the rest add up to its width.  Independent
/// sources add by squares, so together they take less than the sum of their single
/// shares; all shares but the deflection are therefore reduced in proportion,
///
///     left = ends margin,   slice = share (width - deflection - left)/(sum of those) (1)
///
/// If there is no "deflection" among the shares they are not changed.
/// @param ends  2 for a size, whose margin is that at its nearer limit; 1 for a zone.
Stack stack(double width_um, double margin_um, int ends, const Shares& shares);

/// All sources in the order of their first appearance.
std::vector<std::string> sources(const std::vector<Stack>& stacks);

}  // namespace turnwright::report
