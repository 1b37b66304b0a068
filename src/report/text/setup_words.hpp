#pragma once
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// A setup and its operations in words and rounded numbers.
namespace turnwright::report {

/// "left end in the chuck, 25 mm gripped, jaws with 60 kN"
std::string holding(const nlohmann::ordered_json& setup);

/// The setup that a member belongs to, counted from 1; documents count from 0.
std::string setup_number(const nlohmann::ordered_json& member);

/// Successive passes with the same depth, feed and speed.
struct Passes {
  const nlohmann::ordered_json* first = nullptr;
  std::size_t count = 0;
  double n_least = INFINITY, n_most = -INFINITY;
};
std::vector<Passes> runs(const nlohmann::ordered_json& passes);

/// Spindle speed of the run, or its range.
std::string speeds(const Passes& run);

/// The surface that the operation cuts, the limits that bind it, and any gap of its
/// proof.
std::string note(const nlohmann::ordered_json& operation);

}  // namespace turnwright::report
