#pragma once
#include <cmath>
#include <cstdint>

#include "turnwright/base/units.hpp"

/// Random numbers that are the same with every standard library, which the distributions
/// of <random> are not.
namespace turnwright {

/// Number k = 0, 1, .. of SplitMix64 started at `state`, computed without the numbers
/// before it.
/// Source: [Rosetta], which lists the first five.
constexpr std::uint64_t splitmix64(std::uint64_t state, std::uint64_t k) {
  std::uint64_t z = state + (k + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// A number in (0, 1] from 64 random bits; it rounds to 1 once in 2^53.
constexpr double uniform_draw(std::uint64_t bits) {
  return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
}

/// A number of the standard normal distribution from two in (0, 1], by Box and Muller.
inline double normal_draw(double u, double w) {
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * units::kPi * w);
}

}  // namespace turnwright
