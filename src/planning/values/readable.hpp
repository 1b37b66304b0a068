#pragma once
#include <string>

namespace turnwright::planning {

/// A number as sentences show it: four digits, without decimals from ten thousand on.
std::string readable(double value);

}  // namespace turnwright::planning
