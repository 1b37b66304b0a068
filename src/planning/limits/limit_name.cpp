#include "limit_name.hpp"

namespace turnwright::planning {
namespace {

std::string of(const std::string& what, const std::string& whom) {
  return what + " of " + whom;
}

}  // namespace

std::string limit_name(const PlanRequest& p, const LimitRow& row,
                       const LimitNumber& number, std::size_t owner) {
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
      return name + " in setup " + std::to_string(owner + 1);
    case Owner::tool:
      return of(name, p.tools[owner].id);
  }
  return name;
}

}  // namespace turnwright::planning
