#pragma once
#include <array>
#include <cstddef>

namespace turnwright::deflection {

// Positions within one piece are taken together, one array per quantity, so that the
// compiler computes several at a time; the arithmetic per position is the same in any
// company.
inline constexpr std::size_t kRun = 64;
using Column = std::array<double, kRun>;

/// Eq. (1) of beam.hpp at several positions.
struct BeamBodies {
  Column M, d, X;
};

/// Positions t[i] behind the left end of a piece, and what lies between there and either
/// end of the piece as the section at t[i] feels it.
struct BeamRun {
  std::size_t n;
  Column t;
  BeamBodies left, right;
};

}  // namespace turnwright::deflection
