#include "stations.hpp"

#include "base/say.hpp"
#include "feasibility.hpp"
#include "planning/setup/setup_planner.hpp"
#include "turnwright/planning/prepare.hpp"

namespace turnwright::planning {
namespace {

bool make(const PreparedPart& p, int stations) {
  PlanRequest request = p;
  request.machine.stations = stations;
  const auto changed = prepare(std::move(request), p);
  Feasibility oracle(changed);
  return oracle.with(RelaxationFactors(oracle.limits().size(), 1));
}

}  // namespace

std::optional<int> stations_needed(const PreparedPart& p) {
  if (!make(p, catalogue::kAnyStations)) return std::nullopt;
  int needed = p.machine.stations + 1;
  while (!make(p, needed)) ++needed;
  return needed;
}

void add_stations_needed(const PreparedPart& p, ProcessPlan& result) {
  const int has = p.machine.stations;
  if (const auto needed = stations_needed(p))
    result.relax.push_back(
        {kStations, static_cast<double>(has), static_cast<double>(*needed), "",
         say("{} would have to go from {} to {}", tr(kStations), has, *needed)});
}

void add_lack_of_stations(const PreparedPart& p, ProcessPlan& result) {
  const auto before = result.relax.size();
  add_stations_needed(p, result);
  if (result.relax.size() == before) return;
  const int has = p.machine.stations;
  const double needed = result.relax.back().needed;
  result.conflicts.push_back(
      {kStations, tr("all setups"), needed, static_cast<double>(has), "",
       has == 1
           ? say("the turret of {} has {} station, and no tools for which they suffice "
                 "make every surface; {:g} would do",
                 p.machine.name, has, needed)
           : say("the turret of {} has {} stations, and no tools for which they "
                 "suffice make every surface; {:g} would do",
                 p.machine.name, has, needed)});
}

}  // namespace turnwright::planning
