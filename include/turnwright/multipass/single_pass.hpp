#pragma once
#include <optional>
#include <string>
#include <vector>

#include "turnwright/multipass/problem.hpp"

namespace turnwright::multipass {

/// c V^a f^b.
struct PowerLaw {
  double c = 0, V = 0, f = 0;
};

struct PowerLimit {
  std::string name;
  PowerLaw law;
  double limit = 0;
  bool upper = true;  ///< law <= limit, else law >= limit
};

/// One pass whose cost is a sum of powers of speed and feed [Ermer 1971]:
///
///     min sum_k c_k V^a_k f^b_k,  limits, V and f in their ranges
///
/// in the units of the constants.
struct SinglePass {
  std::vector<PowerLaw> cost;
  std::vector<PowerLimit> limits;
  Range V, f;
};

struct SinglePassAnswer {
  std::optional<double> UC;  ///< none: infeasible
  double V = 0, f = 0, lower_bound = 0, gap = 0;
  std::vector<Limit> limits;          ///< the ranges first
  std::vector<std::string> conflict;  ///< irreducible
};

/// The global optimum, by one convex program in logarithms (optimise::minimise).
/// @throws std::domain_error if a constant is not positive and finite, or a range is not
///   in order.
SinglePassAnswer optimum(const SinglePass& problem);

}  // namespace turnwright::multipass
