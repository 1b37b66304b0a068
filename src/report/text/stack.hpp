#pragma once
#include <string>
#include <utility>
#include <vector>

/// What takes a tolerance's width, end to end.
namespace turnwright::report {

using Shares = std::vector<std::pair<std::string, double>>;  ///< source, um on its own

struct Stack {
  Shares slices;       ///< deflection first
  double left_um = 0;  ///< of the width; below 0: so much more than there is

  /// More is taken than there is; a margin used up to its end is none by rounding.
  bool over() const { return left_um < -1e-3; }
};

/// Shares of one tolerance so that they and what is left add up to its width. Independent
/// sources add by squares, so together they take less than the sum of what each would on
/// its own: all but the deflection are reduced in proportion,
///
///     left = ends margin,   slice = share (width - deflection - left)/(sum of those) (1)
///
/// A tolerance that the cut has no part in yet (no "deflection" among the shares) keeps
/// its shares as they are.
/// @param ends  2 of a size, whose margin is that at its nearer limit; 1 of a zone.
Stack stack(double width_um, double margin_um, int ends, const Shares& shares);

/// Sources in the order they first come in.
std::vector<std::string> sources(const std::vector<Stack>& stacks);

}  // namespace turnwright::report
