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

/// A request with everything that follows from it before anything is planned.
namespace turnwright::planning {

/// What a setup cuts: elements in the order of the tool, from the free end inwards.
struct SetupWork {
  std::vector<std::size_t> elements;  ///< indices into drawing.outer
  bool end_face = false;              ///< the face of the free end
  std::vector<std::size_t>
      shoulders;  ///< element k: the face "k-1|k", where the drawing asks
  std::vector<std::size_t> bores;  ///< indices into drawing.inner
};

/// Which setup makes which surface (setup_geometry.hpp).
struct Assignment {
  std::vector<SetupWork> setups;
  std::vector<std::string>
      unreachable;  ///< one sentence per element or face nobody can cut
};

/// Forces of all jaws of a setup at rest [N].
struct JawForces {
  double roughing_N = 0;
  double finishing_N = 0;  ///< from the first finishing pass on
  bool eased = false;      ///< finishing_N is the planner's own choice, below roughing_N
};

/// Where the surface of a tolerance is cut.
struct MachinePlace {
  std::string tolerance;  ///< its id
  std::size_t setup = 0;
  bool centres = false;
  auto operator<=>(const MachinePlace&) const = default;
};

/// What the machine's geometric errors take of a tolerance's width.
struct MachineTake {
  double fixed_um = 0;  ///< as calibrated
  double u_um = 0;      ///< standard uncertainty of it
};

/// A way of milling a place: cutter, lanes side by side, and what they bear at feeds per
/// tooth of which none changes the ratio of the forces by much.
struct MilledWay {
  std::size_t cutter = 0;  ///< of Milled::cutters
  int lanes = 1;
  double fz_from_mm = 0, fz_to_mm = 0;
  double normal = 0;  ///< largest Kn/Kt of its cuts and feeds
  std::shared_ptr<const chatter::Lobes> lobes;
  std::shared_ptr<const chatter::Lobes> between;  ///< of cuts on the way, if any
};

/// A milled place with the setup that makes it.
struct MilledPlace : Milled {
  std::optional<std::size_t> setup;  ///< none: every setup's jaws or rest stand on it
  std::vector<MilledWay> ways;       ///< those that fit
};

/// Made by `prepare` alone and not changed afterwards: a changed request is a copy of the
/// PlanRequest in it, prepared anew.
struct PreparedPart : PlanRequest {
  Assignment work;                 ///< of every surface to a setup
  std::vector<double> drilled_mm;  ///< before each bore of drawing.inner is bored; 0: not
  std::vector<JawForces> jaws;     ///< one a setup
  std::map<MachinePlace, MachineTake> machine_takes;  ///< empty without machine.errors
  std::vector<MilledPlace> milled_places;             ///< of `milled`, in its order
};

PreparedPart prepare(PlanRequest request);

/// Of a request that differs from the one of `like` only in numbers that move no surface:
/// limits of tolerances, roughness, machine, tools and operations, prices, the objective.
/// What the machine takes and the ways of milling, the two that are slow to find, are
/// taken over from `like`.
PreparedPart prepare(PlanRequest request, const PreparedPart& like);

/// Hole [mm] that boring finds at an inner element: the stock's or a drill's.
double hole_mm(const PreparedPart& part, std::size_t inner);

}  // namespace turnwright::planning
