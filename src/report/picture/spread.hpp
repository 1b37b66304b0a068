#pragma once
#include <vector>

namespace turnwright::report {

/// Ascending places on paper, moved as little as keeps them `gap` apart and between two
/// ends; they must have room.
std::vector<double> spread(std::vector<double> places, double gap, double least,
                           double most);

}  // namespace turnwright::report
