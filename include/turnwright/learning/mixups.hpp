#pragma once
#include <optional>
#include <span>
#include <vector>

#include "turnwright/learning/series.hpp"

/// What may have happened to a value that does not belong to its series.
namespace turnwright::learning {

enum class MixUp {
  outlier,     ///< nothing below explains it
  swapped,     ///< it is the value of another characteristic of the part, and vice versa
  inch,        ///< inches: 25.4 times the value belongs
  inch_twice,  ///< converted twice: the value/25.4 belongs
  micrometre,  ///< the value/1000 belongs
  metre,       ///< 1000 times the value belongs
  radius,      ///< of a diameter: twice the value belongs
  diameter,    ///< of a radius: half the value belongs
  sign,        ///< the value with the other sign belongs
  deviation,   ///< a deviation: the value and the nominal size belong
  deviation_sign,  ///< the deviation with the other sign belongs
};

/// What is expected of a characteristic by the values that are kept.
struct Expected {
  double nominal_mm = 0;  ///< 0 of form and place
  double mean_mm = 0, s_mm = 0;
};

/// A value that was left out.
struct Suspect {
  std::size_t characteristic = 0;  ///< index of its Expected
  std::size_t part = 0;
  double y_mm = 0;
};

struct Named {
  MixUp kind = MixUp::outlier;
  std::optional<std::size_t> with;  ///< the other characteristic of a swap
};

/// The explanation of each value that brings it within 6 s of the mean, the nearest of
/// several; a swap, which explains two values at once, before all others.  Where 6 s are more
/// than a tenth of the nominal size nothing is told apart but swaps; of form and place
/// (nominal 0) only units are.
std::vector<Named> mix_ups(std::span<const Suspect> suspects,
                           std::span<const Expected> expected);

/// The explanation of a whole series by its median, where that lies more than two widths of
/// its limits off their middle: the one that brings it within one width.
/// @param nominal_mm  0 of form and place, which are not judged.
std::optional<MixUp> mix_up_of_all(const Series& series, const Limits& limits,
                                   double nominal_mm);

}  // namespace turnwright::learning
