#pragma once
#include <compare>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "turnwright/planning/plan_request.hpp"

namespace turnwright::chatter {
class Lobes;
}

/// A request with everything that follows from it before planning starts.
namespace turnwright::planning {

/// The surfaces that a setup cuts; elements in the tool's order, from the free end
/// inwards.
struct SetupWork {
  std::vector<std::size_t> elements;   ///< indices into drawing.outer
  bool end_face = false;               ///< the face of the free end
  std::vector<std::size_t> shoulders;  ///< element k: the face "k-1|k", where it is faced
  /// Element k of shoulders that may be faced because an edge behind them stands in stock
  /// (PlanRequest::face_edges_in_stock).
  std::vector<std::size_t> before_stock;
  std::vector<std::size_t> bores;  ///< indices into drawing.inner
  /// Of these, where a tolerance is on the shoulder at the inner end: it is faced.
  std::vector<std::size_t> inner_shoulders;
  /// Chamfers at the free end of elements that earlier setups have made, which no tool cuts
  /// on its way: indices into drawing.outer and drawing.inner.
  std::vector<std::size_t> outer_chamfers, inner_chamfers;
  bool operator==(const SetupWork&) const = default;
};

/// Which setup makes which surface.
struct Assignment {
  std::vector<SetupWork> setups;
  std::vector<std::string>
      unreachable;  ///< one sentence per element or face that no setup can cut
  bool operator==(const Assignment&) const = default;
};

/// Forces of all jaws of a setup at rest [N].
struct JawForces {
  double roughing_N = 0;
  double finishing_N = 0;    ///< from the first finishing pass on
  bool spares_tube = false;  ///< roughing_N is below the chuck's for a hollow part's sake
  bool eased = false;  ///< finishing_N is the planner's own choice, below roughing_N
};

/// The setup and support in which the surface of a tolerance is cut.
struct MachinePlace {
  std::string tolerance;  ///< its id
  std::size_t setup = 0;
  bool centres = false;
  auto operator<=>(const MachinePlace&) const = default;
};

/// Share of a tolerance's width that the machine's geometric errors take.
struct MachineTake {
  double fixed_um = 0;  ///< by the calibrated errors
  double u_um = 0;      ///< its standard uncertainty
};

/// A way of milling a place: cutter, number of lanes, and limits of stability for a range
/// of feeds per tooth over which the ratio of the forces hardly changes.
struct MilledWay {
  std::size_t cutter = 0;  ///< of Milled::cutters
  int lanes = 1;
  double fz_from_mm = 0, fz_to_mm = 0;
  double normal = 0;  ///< largest Kn/Kt of its cuts and feeds
  std::shared_ptr<const chatter::Lobes> lobes;
  std::shared_ptr<const chatter::Lobes> between;  ///< of intermediate cuts, if any
};

/// A milled place with the setup that makes it.
struct MilledPlace : Milled {
  std::optional<std::size_t> setup;  ///< none: in all setups jaws or a rest stand on it
  std::vector<MilledWay> ways;       ///< those that fit
};

/// A prepared request.  It is made only by `prepare` (prepare.hpp) and not changed afterwards: to
/// change a request, copy its PlanRequest and prepare the copy.
struct PreparedPart : PlanRequest {
  std::vector<double> grips_mm;    ///< length of the held end in the jaws, one per setup
  Assignment work;                 ///< the setup of every surface
  std::vector<double> drilled_mm;  ///< hole drilled before boring drawing.inner; 0: none
  std::vector<JawForces> jaws;     ///< one per setup
  std::map<MachinePlace, MachineTake> machine_takes;  ///< empty without machine.errors
  std::vector<MilledPlace> milled_places;             ///< in the order of `milled`
};

}  // namespace turnwright::planning
