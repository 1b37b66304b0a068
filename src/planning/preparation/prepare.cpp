#include "turnwright/planning/prepare.hpp"

#include <algorithm>

#include "edge_assignment.hpp"
#include "grips.hpp"
#include "planning/auxiliary/hole_operations.hpp"
#include "planning/auxiliary/milled_ways.hpp"
#include "planning/budget/jaw_squeeze.hpp"
#include "planning/budget/machine_share.hpp"
#include "stick_out.hpp"
#include "turnwright/planning/rules.hpp"

namespace turnwright::planning {
namespace {

// The hole before boring, for each bore (hole_operations.hpp).
std::vector<double> drilled(const PreparedPart& p) {
  const double left = drilled_mm(p, part::End::left);
  const double right = drilled_mm(p, part::End::right);
  std::vector<double> all;
  for (std::size_t i = 0; i < p.drawing.inner.size(); ++i)
    all.push_back(before_boring_mm(
        p.drawing, i, p.drawing.inner[i].from == part::End::left ? left : right));
  return all;
}

std::vector<MilledPlace> placed(const PreparedPart& p) {
  std::vector<MilledPlace> all;
  for (const auto& m : p.milled) {
    all.push_back({m, m.given_setup, {}});
    if (!m.given_setup) all.back().setup = milled_setup(p, m);
  }
  return all;
}

PreparedPart gripped(PlanRequest request) {
  PreparedPart p{ruled(std::move(request)), {}, {}, {}, {}, {}, {}};
  choose_grips(p);
  return p;
}

// Everything except the parts that take long to compute.
PreparedPart assigned(PlanRequest request) {
  auto p = gripped(std::move(request));
  leave_to_the_hand(p);
  p.jaws = jaw_forces(p);
  p.drilled_mm = drilled(p);
  set_stick_outs(p);
  p.milled_places = placed(p);
  return p;
}

bool has_edges_in_stock(const Assignment& work) {
  return work.unreachable.empty() && std::ranges::any_of(work.setups, [](const auto& s) {
           return !s.before_stock.empty();
         });
}

}  // namespace

PreparedPart prepare(PlanRequest request) {
  auto p = assigned(std::move(request));
  p.machine_takes = machine_takes(p);
  auto& places = p.milled_places;
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i].ways = i > 0 && places[i - 1].entry == places[i].entry
                         ? places[i - 1].ways
                         : milled_ways(p, places[i]);
  return p;
}

PreparedPart prepare(PlanRequest request, const PreparedPart& like) {
  auto p = assigned(std::move(request));
  p.machine_takes = like.machine_takes;
  for (std::size_t i = 0; i < p.milled_places.size(); ++i)
    p.milled_places[i].ways = like.milled_places.at(i).ways;
  return p;
}

bool has_edges_in_stock(PlanRequest request) {
  return has_edges_in_stock(gripped(std::move(request)).work);
}

std::optional<PreparedPart> faced_otherwise(const PreparedPart& part) {
  if (!has_edges_in_stock(part.work)) return {};
  PlanRequest request = part;
  request.face_edges_in_stock = !part.face_edges_in_stock;
  return prepare(std::move(request), part);
}

std::vector<std::string> not_made(PlanRequest request) {
  return gripped(std::move(request)).work.unreachable;
}

}  // namespace turnwright::planning
