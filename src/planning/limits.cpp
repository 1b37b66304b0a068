#include "limits.hpp"

#include <algorithm>

#include "limit_table.hpp"

namespace turnwright::planning {
namespace {

std::string of(const std::string& what, const std::string& whom) {
  return what + " of " + whom;
}

// As prices and changed requests name it.
std::string name_of(const PlanRequest& p, const LimitRow& row, const LimitNumber& number,
                    std::size_t owner) {
  const std::string name = number.name ? number.name : row.name;
  switch (number.owner) {
    case Owner::operation:
      return of(name, (*p.operations)[owner].id);
    case Owner::tolerance:
      return p.drawing.tolerances[owner].id;
    case Owner::surface:
      return of(name, surface_id(p, owner));
    case Owner::machine:
      return of(name, p.machine.id);
    case Owner::chuck:
      return name;
    case Owner::jaws:
    case Owner::finishing_jaws:
      return name + " in setup " + std::to_string(owner);
    case Owner::tool:
      return of(name, p.tools[owner].id);
  }
  return name;
}

// "t1, the cylindricity of d1," and for what the drawing gives no id "the diameter k6 of
// d1".
std::string called(const PlanRequest& p, const part::Tolerance& t) {
  const auto surface = t.of.empty() ? t.between[0] + " .. " + t.between[1] : t.of;
  const auto kind = std::string("the ") + part::name(t.kind);
  if (t.id.find(':') == std::string::npos) return t.id + ", " + of(kind, surface) + ",";
  const auto fit = [&](const auto& elements) {
    for (const auto& e : elements)
      if (e.id == t.of && e.fit) return " " + *e.fit;
    return std::string();
  };
  return of(kind + fit(p.drawing.outer) + fit(p.drawing.inner), surface);
}

void add(const PreparedPart& p, const LimitRow& row, const LimitNumber& number,
         std::size_t owner, std::vector<Limit>& all) {
  const auto now = number.now(p, owner);
  if (!now) return;
  const auto name = name_of(p, row, number, owner);
  const auto sentence = row.is_width ? "opening " + called(p, p.drawing.tolerances[owner])
                                     : (row.at_most() ? "raising " : "lowering ") + name;
  all.push_back({name, sentence, number.unit ? number.unit : row.unit, row.at_most(),
                 *now,
                 [scale = number.scale, owner, now = *now](PlanRequest& plan, double k) {
                   scale(plan, owner, {now, k});
                 }});
}

// An operation of a solved surface, with what owns its limits.
struct Held {
  const PreparedPart& p;
  const SolvedFeature& f;
  const OperationModel& o;

  bool holds(const LimitNumber& number, std::size_t owner) const {
    const auto setup = f.task.making.setup;
    const bool eased = o.finishing && f.task.feature.kind() != Feature::Kind::end_face &&
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
        if (holds(number, i)) all.push_back(name_of(p, row, number, i));
    if (!row.with) return all;
    const auto more = names(*row.with);
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
};

const OperationModel& operation(const SolvedFeature& f, std::size_t i) {
  return f.answer.model->chain().operations[i];
}

}  // namespace

std::vector<Limit> limits(const PreparedPart& p) {
  using Owners = std::vector<Owner>;
  std::vector<Limit> all;
  for (const auto& group :
       {Owners{Owner::tolerance}, Owners{Owner::surface}, Owners{Owner::machine},
        Owners{Owner::chuck}, Owners{Owner::jaws, Owner::finishing_jaws},
        Owners{Owner::tool}})
    for (std::size_t i = 0; i < owners(p, group[0]); ++i)
      for (const auto& row : limit_table())
        for (const auto& number : row.numbers)
          if (std::ranges::find(group, number.owner) != group.end())
            add(p, row, number, i, all);
  return all;
}

std::vector<std::string> spindle_limit_names(const PreparedPart& p,
                                             const SolvedFeature& f, std::size_t i) {
  return Held{p, f, operation(f, i)}.names(Check::spindle_max);
}

std::vector<std::string> limit_names(const PreparedPart& p, const SolvedFeature& f,
                                     const Row& row) {
  if (row.check == Check::tolerance) {
    const auto& functional = f.answer.model->chain().functionals[row.operation];
    return {p.drawing.tolerances[functional.tolerance].id};
  }
  return Held{p, f, operation(f, row.operation)}.names(row.check);
}

}  // namespace turnwright::planning
