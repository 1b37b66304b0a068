#pragma once
#include <vector>

#include "chatter/fundamental_matrix/stability_crossings.hpp"
#include "turnwright/chatter/cutter.hpp"

namespace turnwright::chatter {

/// Every depth in (0, ap_max] at which turning swings without end, rising.  Its cut is
/// the same at every angle, so that with s = i omega, q along x and v the cutting speed
///
///     1 + w D(s) = 0,   D(s) = G(s) (K (1 - e^(-s tau)) + s C/v)                    (1)
///     G(s) = sum_i (wn_i^2/k_i) / (s^2 + 2 zeta_i wn_i s + wn_i^2)                  (2)
///
/// that is Im D(i omega) = 0 and w = -1/Re D(i omega).  As Re ds/dw has the sign of
/// d Im D/d omega, a pair of multipliers leaves the unit circle where Im D rises through
/// 0 and comes back where it falls.  Frequencies beyond which w |D| < 1 are not looked
/// at; the others are halved until an enclosure of D shows that one holds no zero or, by
/// the sign of the slope, one at most.  Zeros that touch 0 within rounding leave and come
/// back at one depth, and are not told.
///
/// Source: [Tobias 1958] and [Tlusty 1963] for (1), with the indentation force of
/// cutter.hpp; the search derived here.
/// @param cutter  its force constant.
/// @throws TooManyVibrations after kMostPieces.
std::vector<OnCircle> turning_on_circle(const Cutter& cutter, double n_rpm,
                                        double ap_max_mm);
inline constexpr long kMostPieces = 2'000'000;  // seconds

}  // namespace turnwright::chatter
