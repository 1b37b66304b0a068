#pragma once
#include <string>
#include <vector>

#include "svg.hpp"

/// Frames with scales for curves.
namespace turnwright::report {

/// A linear scale between two positions on paper.
struct Scale {
  double low = 0, high = 1;  ///< values
  double from = 0, to = 1;   ///< their places
  double place(double value) const {
    return from + (to - from) * (value - low) / (high - low);
  }
};

/// The largest of 1, 2, 5, 10, .. times any power of ten that is at most x > 0, but
/// for rounding.
double round_below(double x);

/// Multiples of a round step inside the scale, some `count` of them.
std::vector<double> ticks(const Scale& scale, int count);

/// A frame with ticks, their numbers and the axes' names; a line at zero where it shows.
void frame(Svg& svg, const Scale& x, const Scale& y, const std::string& x_name,
           const std::string& y_name, int x_ticks = 5, int y_ticks = 5);

}  // namespace turnwright::report
