#include "binding_limits.hpp"

#include <algorithm>

#include "planning/limits/limit_name.hpp"
#include "planning/limits/limit_table.hpp"

namespace turnwright::planning {
namespace {

// An operation of a solved surface, with what owns its limits.
struct Held {
  const PreparedPart& p;
  const SolvedSurface& f;
  const OperationModel& o;

  bool holds(const LimitNumber& number, std::size_t owner) const {
    const auto setup = f.task.making.setup;
    const bool eased = o.finishing &&
                       f.task.feature.kind() != MachinedSurface::Kind::end_face &&
                       finishes_with_another_force(p, setup);
    switch (number.owner) {
      case Owner::machine:
      case Owner::chuck:
        return true;
      case Owner::jaws:
        return owner == setup && !eased;
      case Owner::finishing_jaws:
        return owner == setup && eased;
      case Owner::tool:
        return p.tools[owner].id == o.tool->id;
      case Owner::surface:
        return surface_id(p, owner) == f.task.feature.surface();
      case Owner::operation:
      case Owner::tolerance:
        return false;
    }
    return false;
  }

  std::vector<std::string> names(Check check) const {
    std::vector<std::string> all;
    const auto& row = limit_row(check);
    for (const auto& number : row.numbers)
      for (std::size_t i = 0; i < owners(p, number.owner); ++i)
        if (holds(number, i)) all.push_back(limit_name(p, row, number, i));
    if (!row.with) return all;
    const auto more = names(*row.with);
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
};

const OperationModel& operation(const SolvedSurface& f, std::size_t i) {
  return f.answer.model->chain().operations[i];
}

}  // namespace

std::vector<std::string> spindle_limit_names(const PreparedPart& p,
                                             const SolvedSurface& f, std::size_t i) {
  return Held{p, f, operation(f, i)}.names(Check::spindle_max);
}

std::vector<std::string> limit_names(const PreparedPart& p, const SolvedSurface& f,
                                     const Row& row) {
  if (row.check == Check::tolerance) {
    const auto& functional = f.answer.model->chain().functionals[row.operation];
    return {p.drawing.tolerances[functional.tolerance].id};
  }
  return Held{p, f, operation(f, row.operation)}.names(row.check);
}

}  // namespace turnwright::planning
