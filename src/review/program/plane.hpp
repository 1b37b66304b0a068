#pragma once
#include <cmath>

#include "turnwright/toolpath/path.hpp"

/// Vectors of the half plane in which programs move, X up and Z to the right.
namespace turnwright::review {

inline toolpath::Point plus(const toolpath::Point& a, const toolpath::Point& b,
                            double factor = 1) {
  return {a.h_mm + factor * b.h_mm, a.z_mm + factor * b.z_mm};
}
inline toolpath::Point between(const toolpath::Point& from, const toolpath::Point& to) {
  return plus(to, from, -1);
}
inline double length(const toolpath::Point& a) { return std::hypot(a.h_mm, a.z_mm); }
inline double dot(const toolpath::Point& a, const toolpath::Point& b) {
  return a.h_mm * b.h_mm + a.z_mm * b.z_mm;
}
/// Positive if b points to the left of a.
inline double cross(const toolpath::Point& a, const toolpath::Point& b) {
  return a.z_mm * b.h_mm - a.h_mm * b.z_mm;
}
inline toolpath::Point unit(const toolpath::Point& a) {
  const double l = length(a);
  return l > 0 ? toolpath::Point{a.h_mm / l, a.z_mm / l} : toolpath::Point{};
}
/// A quarter turn to the right.
inline toolpath::Point to_the_right(const toolpath::Point& a) {
  return {-a.z_mm, a.h_mm};
}

}  // namespace turnwright::review
