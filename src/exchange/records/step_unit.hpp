#pragma once
#include <optional>
#include <string>

#include "turnwright/exchange/part21.hpp"

/// Units and measures of a STEP file (ISO 10303-41).  Every measure names its own unit, and
/// one file may mix them: nominal sizes in mm beside tolerances in inches.
namespace turnwright::exchange {

enum class Quantity { length, angle };

/// A unit by what it measures and its size in mm or in rad.
struct Unit {
  Quantity quantity = Quantity::length;
  double size = 1;
};

/// The unit of an instance: SI_UNIT(.MILLI., .METRE.) and its likes, or
/// CONVERSION_BASED_UNIT('inch', a measure), which may lead through further ones.  Nothing
/// if it measures neither length nor plane angle.
/// @throws InputError naming the instance if the conversions lead nowhere, or a factor is
///         not > 0.
std::optional<Unit> step_unit(const Instance& unit);

/// A value in mm or in rad.
struct Measure {
  Quantity quantity = Quantity::length;
  double value = 0;
};

/// The measure of an instance, whichever way it is written:
///
///     LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(0.1), #unit)
///     MEASURE_REPRESENTATION_ITEM('name', LENGTH_MEASURE(0.1), #unit)
///     (LENGTH_MEASURE_WITH_UNIT() MEASURE_REPRESENTATION_ITEM()
///      MEASURE_WITH_UNIT(LENGTH_MEASURE(0.1), #unit) REPRESENTATION_ITEM('name'))
///
/// Nothing if the instance is no measure, or one of neither length nor angle.
/// @throws InputError as step_unit, and for a value that is no number.
std::optional<Measure> step_measure(const Instance& measure);

/// The name of a measure's representation item, "nominal value"; "" if it has none.
std::string measure_name(const Instance& measure);

}  // namespace turnwright::exchange
