#pragma once
#include <string>
#include <utility>

namespace turnwright::planning {

struct ConstraintValue;

/// A number as sentences show it: four digits, without decimals from ten thousand on.
std::string readable(double value);

/// Two numbers as sentences compare them: with the digits that tell them apart, if they
/// differ by more than rounding.
std::pair<std::string, std::string> readable_apart(double a, double b);

/// "d2: power is 6.2 kW where 5.5 kW is allowed" of a constraint at a place that does not
/// keep its limit; "d2: nothing is left for t1" where value and limit are the same, as
/// where both are 0.
std::string exceeded(const std::string& where, const ConstraintValue& c);

}  // namespace turnwright::planning
