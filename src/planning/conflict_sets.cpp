#include "conflict_sets.hpp"

#include <algorithm>

namespace turnwright::planning {
namespace {

LimitSet joined(LimitSet a, const LimitSet& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// An irreducible part of `searched` that conflicts with all of `kept`; nothing if these
// conflict without it.  `more`: `kept` has grown since it was last tried.
LimitSet needed_with(Feasibility& part, const LimitSet& kept, bool more,
                     const LimitSet& searched) {
  if (more && !part.with(only(part, kept))) return {};
  if (searched.size() == 1) return searched;
  const auto half = searched.begin() + static_cast<long>(searched.size() / 2);
  const LimitSet first(searched.begin(), half), second(half, searched.end());
  const auto of_second = needed_with(part, joined(kept, first), true, second);
  return joined(needed_with(part, joined(kept, of_second), !of_second.empty(), first),
                of_second);
}

// Those that a surface in trouble has to keep, or all if none is in trouble alone.
LimitSet suspects(const Feasibility& part, const LimitSet& among) {
  LimitSet s;
  for (const std::size_t i : among)
    if (std::any_of(part.failed().begin(), part.failed().end(), [&](const auto& surface) {
          return bears_on(part.plan(), part.limits()[i], surface);
        }))
      s.push_back(i);
  return s.empty() ? among : s;
}

void leave_out_what_nothing_makes(Feasibility& part) {
  while (!part.with(only(part, {})) && !part.failed().empty())
    for (const auto& surface : std::set(part.failed())) part.leave_out(surface);
}

}  // namespace

Openings only(const Feasibility& part, const LimitSet& kept, double others) {
  Openings times(part.limits().size(), others);
  for (const std::size_t i : kept) times[i] = 1;
  return times;
}

Openings without(const Feasibility& part, const LimitSet& some, double opening) {
  Openings times(part.limits().size(), 1);
  for (const std::size_t i : some) times[i] = opening;
  return times;
}

std::vector<LimitSet> conflicting_sets(Feasibility& part) {
  std::vector<LimitSet> sets;
  leave_out_what_nothing_makes(part);
  if (!part.with(only(part, {}))) return sets;
  LimitSet rest(part.limits().size());
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = i;
  LimitSet kept_alone;
  while (!part.with(only(part, rest))) {
    const auto suspected = suspects(part, rest);
    const auto alone =
        std::find_if(suspected.begin(), suspected.end(), [&](std::size_t i) {
          if (std::find(kept_alone.begin(), kept_alone.end(), i) != kept_alone.end())
            return false;
          const bool kept = part.with(only(part, {i}));
          if (kept) kept_alone.push_back(i);
          return !kept;
        });
    LimitSet found;
    if (alone != suspected.end())
      found = {*alone};
    else
      found = needed_with(part, {}, false,
                          part.with(only(part, suspected)) ? rest : suspected);
    std::sort(found.begin(), found.end());
    std::erase_if(rest, [&](std::size_t i) {
      return std::find(found.begin(), found.end(), i) != found.end();
    });
    sets.push_back(std::move(found));
  }
  return sets;
}

}  // namespace turnwright::planning
