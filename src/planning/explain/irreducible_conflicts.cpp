#include "irreducible_conflicts.hpp"

#include <algorithm>

namespace turnwright::planning {
namespace {

LimitSet joined(LimitSet a, const LimitSet& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// QuickXplain: an irreducible part of `searched` that conflicts with all of `kept`; nothing
// if these conflict without it.  Of two halves the second is searched with the first in
// place, then the first with what the second gave.  `more`: `kept` has grown since it was
// last tried.
LimitSet quick_xplain(Feasibility& oracle, const LimitSet& kept, bool more,
                      const LimitSet& searched) {
  if (more && !oracle.with(only(oracle, kept))) return {};
  if (searched.size() == 1) return searched;
  const auto half = searched.begin() + static_cast<long>(searched.size() / 2);
  const LimitSet first(searched.begin(), half), second(half, searched.end());
  const auto of_second = quick_xplain(oracle, joined(kept, first), true, second);
  return joined(quick_xplain(oracle, joined(kept, of_second), !of_second.empty(), first),
                of_second);
}

// The limits that an infeasible surface has to keep, or all if no surface is infeasible by
// itself.
LimitSet suspects(const Feasibility& oracle, const LimitSet& among) {
  LimitSet s;
  for (const std::size_t i : among)
    if (std::any_of(oracle.failed().begin(), oracle.failed().end(),
                    [&](const auto& surface) {
                      return bears_on(oracle.part(), oracle.limits()[i], surface);
                    }))
      s.push_back(i);
  return s.empty() ? among : s;
}

void leave_out_what_nothing_makes(Feasibility& oracle) {
  while (!oracle.with(only(oracle, {})) && !oracle.failed().empty())
    for (const auto& surface : std::set(oracle.failed())) oracle.leave_out(surface);
}

}  // namespace

RelaxationFactors only(const Feasibility& oracle, const LimitSet& kept, double others) {
  RelaxationFactors factors(oracle.limits().size(), others);
  for (const std::size_t i : kept) factors[i] = 1;
  return factors;
}

RelaxationFactors without(const Feasibility& oracle, const LimitSet& some,
                          double factor) {
  RelaxationFactors factors(oracle.limits().size(), 1);
  for (const std::size_t i : some) factors[i] = factor;
  return factors;
}

std::vector<LimitSet> irreducible_conflicts(Feasibility& oracle) {
  std::vector<LimitSet> sets;
  leave_out_what_nothing_makes(oracle);
  if (!oracle.with(only(oracle, {}))) return sets;
  LimitSet rest(oracle.limits().size());
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = i;
  LimitSet kept_alone;
  while (!oracle.with(only(oracle, rest))) {
    const auto suspected = suspects(oracle, rest);
    const auto alone =
        std::find_if(suspected.begin(), suspected.end(), [&](std::size_t i) {
          if (std::find(kept_alone.begin(), kept_alone.end(), i) != kept_alone.end())
            return false;
          const bool kept = oracle.with(only(oracle, {i}));
          if (kept) kept_alone.push_back(i);
          return !kept;
        });
    LimitSet found;
    if (alone != suspected.end())
      found = {*alone};
    else
      found = quick_xplain(oracle, {}, false,
                           oracle.with(only(oracle, suspected)) ? rest : suspected);
    std::sort(found.begin(), found.end());
    std::erase_if(rest, [&](std::size_t i) {
      return std::find(found.begin(), found.end(), i) != found.end();
    });
    sets.push_back(std::move(found));
  }
  return sets;
}

}  // namespace turnwright::planning
