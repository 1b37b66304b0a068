#pragma once
#include <vector>

namespace turnwright::chatter {

/// The upper one of two in the middle; 0 of nothing.
double median(std::vector<double> all);

}  // namespace turnwright::chatter
