#pragma once
#include "notation_words.hpp"
#include "turnwright/exchange/outline.hpp"

namespace turnwright::exchange::notated {

/// The units that the statements of a text ask for, "unit: in" or "unit: mm"; mm if none does.
/// Adds what is neither to the mistakes.
Units units_of(const std::vector<Word>& statements, Mistakes& mistakes);

/// Makes millimetres and micrometres of an outline that was read in other units.  Threads keep
/// their diameters and pitches, which their designations say in their own units, and
/// undercuts and centre holes the sizes of their standards.
void to_millimetres(const Units& from, Outline& outline);

}  // namespace turnwright::exchange::notated
