#pragma once
#include <string_view>

#include "turnwright/part/drawing.hpp"

/// ISO 286-1: standard tolerances and limit deviations of shafts and bores, to 500 mm.
///
/// Source: the numbers were typed from general knowledge of the ISO 286
/// system (the 1988 and DIN form: cd, ef, fg to 10 mm only) and compared with public
/// transcriptions (a textbook's tables of fundamental deviations, a table after EN ISO
/// 286-1, corrigendum 1 to ISO 286-2:1988) and, value by value, against the system's
/// generating formulas.  They were not compared with the printed standard itself.
namespace turnwright::tolerance {

/// Tolerance grade; an enum, so that a size and a grade cannot be exchanged in a call.
enum class Grade {
  IT01,
  IT0,
  IT1,
  IT2,
  IT3,
  IT4,
  IT5,
  IT6,
  IT7,
  IT8,
  IT9,
  IT10,
  IT11,
  IT12,
  IT13,
  IT14,
  IT15,
  IT16,
  IT17,
  IT18
};

/// Standard tolerance [um] of a nominal size [mm]: ISO 286-1's table, not the formula
/// behind it (IT7 of 10..18 mm is 18, its formula gives 17).  A range excludes its lower
/// end and includes its upper one: 30 < D <= 50.
/// @throws std::domain_error unless 0 < D <= 500; IT14 and coarser need D > 1.
double it_um(double nominal_mm, Grade grade);

/// Deviations [mm] of a tolerance class such as "k6" (a shaft, lower case), "H7" (a bore,
/// upper case) or "js9" from the nominal size D [mm].
///
///     shafts  a..h, cd, ef, fg: es = -d(D), ei = es - IT     j, k..zc: ei, es = ei + IT
///     bores   A..H: EI = +d(D), ES = EI + IT                 J: ES, EI = ES - IT
///             K, M, N to IT8 and P..ZC to IT7: ES = -ei + Delta,
///               Delta = IT(n) - IT(n-1)
///             coarser grades: M, P..ZC  ES = -ei;
///               K (to 3 mm) and N (above 3 mm)  ES = 0
///     js, JS  +- IT/2, not rounded
///
/// ei is the shaft's of the same letter; k is the tabulated ei for IT4..IT7, 0 otherwise.
/// Exceptions of the tables: M6 of 250..315 mm has ES = -9 um (not -11), and to 3 mm
/// Delta = 0 and N keeps -4 um.
/// Valid for 0 < D <= 500 mm and only where the tables have a value: j for IT5..IT8, J
/// for IT6..IT8, t above 24 mm, v above 14, y above 18, cd, ef and fg to 10, a, b (A, B)
/// and N coarser than IT8 above 1, K coarser than IT8 to 3, K..ZC from IT3.
/// @throws std::domain_error naming the condition that is not met.
part::Limits fit_limits_mm(double nominal_mm, std::string_view tolerance_class);

}  // namespace turnwright::tolerance
