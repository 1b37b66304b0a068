#pragma once
#include <string>
#include <string_view>

#include "turnwright/catalogue/geometric_errors.hpp"

/// A machine's geometric errors: values of the catalogue.
namespace turnwright::volumetric {

using catalogue::Axis;
using catalogue::default_Q;
using catalogue::ErrorFunction;
using catalogue::Harmonic;
using catalogue::is_rotary;
using catalogue::kDirections;
using catalogue::kLetters;
using catalogue::letter_index;
using catalogue::Vec3;
using Machine = catalogue::KinematicChain;

/// The fault of a chain of letters, "" if it is valid: it begins with w, ends with t,
/// has one f in between, and axes of kLetters, each at most once.
std::string chain_fault(std::string_view chain);

/// Sign sigma of an axis of a chain: 1 between bed and tool, -1 between bed and
/// workpiece.
double sense(std::string_view chain, char axis);

}  // namespace turnwright::volumetric
