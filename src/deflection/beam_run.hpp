#pragma once
#include <array>
#include <cstddef>

namespace turnwright::deflection {

// Positions within one piece are computed together, one array per quantity, so that the
// compiler vectorises the loop; the arithmetic of a position does not depend on the
// others.
inline constexpr std::size_t kRun = 64;
using Column = std::array<double, kRun>;

/// Eq. (1) of beam.hpp at several positions.
struct BeamBodies {
  Column M, d, X;
};

/// Positions t[i] behind the left end of a piece, and the bodies between them and either
/// end of the piece.
struct BeamRun {
  std::size_t n;
  Column t;
  BeamBodies left, right;
};

}  // namespace turnwright::deflection
