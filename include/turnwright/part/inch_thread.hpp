#pragma once
#include <optional>
#include <string>
#include <string_view>

/// Unified inch threads (UNC, UNF, UNEF, UNS, UN), which have the basic profile of ISO 68-1
/// as metric ones do, so that part::thread (thread.hpp) has their diameters.
namespace turnwright::part {

inline constexpr double kInch_mm = 25.4;  ///< by definition

/// Nominal diameter and pitch of n threads per inch,
///
///     d = 25.4 D,   P = 25.4/n                                                      (1)
///
/// with D in inches, or by the number N of a small screw,
///
///     D = 0.060 + 0.013 N                                                           (2)
///
/// Source: (1) the inch; (2) from general knowledge of the series #0 to #12.
struct InchThread {
  double d_mm = 0, pitch_mm = 0;
  std::string tolerance_class = {};  ///< "2A" of an external, "2B" of an internal one
};

/// "1/2-13 UNC", "1-1/4-7", ".500-20UNF-2A", "#10-24 UNC 2B".  Series and class may be left
/// out: n says which series it is.
/// Nothing if the text is not that, or D or n lies outside 0 < D <= 24, 1 <= n <= 120.
std::optional<InchThread> inch_thread(std::string_view designation);

/// Diameter and pitch as (1) makes them of a fraction of an inch down to 1/64, or (2) of a
/// number: "1/2-13 UN".  Nothing for other sizes, metric ones above all.
std::optional<std::string> inch_designation(double d_mm, double pitch_mm);

}  // namespace turnwright::part
