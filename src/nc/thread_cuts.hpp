#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "turnwright/toolpath/setup_program.hpp"

/// Threads among the moves of an operation, as the cycles of controls cut them.
namespace turnwright::nc {

using namespace toolpath;

/// Whether the moves from the k-th are one cut and its way back: in along X, the cut along
/// Z, out to where it began, and back.
bool returns(const std::vector<Move>& moves, std::size_t k);

/// Whether the k-th move and the next are a tap on the axis: in, and back to where it
/// began.
bool taps(const std::vector<Move>& moves, std::size_t k);

/// Cuts of a thread from one position, the k-th sqrt(k) times as deep as the first.
struct ThreadCuts {
  Point from, to;  ///< the position before the first and the end of the last
  double depth_mm = 0;
  int cuts = 0;

  double outside_mm() const;  ///< radius before the first cut
  double first_mm() const;    ///< depth of the first cut, the largest infeed
  double least_mm() const;    ///< infeed of the last cut
};

/// The cuts that begin at the k-th move; none unless they are all of the moves' cuts, at
/// least two, and each is as deep as the cycle makes it within 1e-6 mm.
std::optional<ThreadCuts> thread_cuts(const std::vector<Move>& moves, std::size_t k);

}  // namespace turnwright::nc
