#include "turnwright/part/metric_thread.hpp"

#include <charconv>

#include "turnwright/base/pattern.hpp"

namespace turnwright::part {
namespace {

struct Coarse {
  double d_mm, P_mm;
};
constexpr Coarse kCoarse[] = {{3, 0.5},  {4, 0.7},   {5, 0.8},  {6, 1},    {8, 1.25},
                              {10, 1.5}, {12, 1.75}, {14, 2},   {16, 2},   {18, 2.5},
                              {20, 2.5}, {22, 2.5},  {24, 3},   {27, 3},   {30, 3.5},
                              {33, 3.5}, {36, 4},    {39, 4},   {42, 4.5}, {45, 4.5},
                              {48, 5},   {52, 5},    {56, 5.5}, {60, 5.5}, {64, 6}};

// A number found by the pattern below, with a point in any locale.
double number(const std::string& digits) {
  double x = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), x);
  return x;
}

}  // namespace

std::optional<double> coarse_pitch_mm(double d_mm) {
  for (const auto& c : kCoarse)
    if (c.d_mm == d_mm) return c.P_mm;
  return std::nullopt;
}

std::optional<MetricThread> metric_thread(std::string_view designation) {
  static const Pattern kForm("M([0-9]+(?:\\.[0-9]+)?)(?:x([0-9]+(?:\\.[0-9]+)?))?");
  const auto m = kForm.match(designation);
  if (!m) return std::nullopt;
  const std::string &diameter = (*m)[1], &pitch = (*m)[2];
  const double d = number(diameter);
  return MetricThread{d, pitch.empty() ? coarse_pitch_mm(d) : number(pitch)};
}

}  // namespace turnwright::part
