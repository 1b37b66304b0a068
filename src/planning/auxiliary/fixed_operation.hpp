#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "auxiliary_work.hpp"
#include "planning/paths/pass_lengths.hpp"
#include "planning/values/economy.hpp"
#include "turnwright/cutting/fixed.hpp"

/// What the operations of catalogue_operations.hpp have in common: the tool that fits, its
/// load and limits, the conditions of its window.
namespace turnwright::planning::fixed {

using catalogue::FixedTool;
using catalogue::FixedUse;

inline constexpr double kBeyondRounding = 1e-9;  ///< a limit counts as over

/// A setup while its operations are listed.
struct Site {
  const PreparedPart& p;
  std::size_t setup;
  Clamping clamping;
  const SetupWork& work;
  const Economy& economy;
  Stage stage;  ///< of the jaws' force
  AuxiliaryWork& out;
  std::vector<cutting::SpeedRange> ranges = cutting::speed_ranges(p.machine);
  bool driven = false;  ///< the tool turns, by `ranges`, and the part is held at an angle
};

/// Requirements on a tool.
struct Asked {
  FixedUse use;
  const char* does;  ///< "groove": of ids and sentences
  std::string surface;
  bool inner = false;
  const OperationRequest* given = nullptr;
  std::function<bool(const FixedTool&, double size)> fits;
};

/// A tool in one of its sizes, the conditions in the plan's material.
struct Fitted {
  const FixedTool* tool = nullptr;
  double size_mm = 0;
  catalogue::FixedConditions at = {};
  /// Of the request, which `at` then has, and the window of the tool, which they must keep.
  Conditions given = {};
  std::optional<catalogue::ConditionsWindow> window = {};
};

/// The largest size that fits (for parting off and countersinking the smallest), of the
/// first tool that has it; of drills the shortest.
Fitted fitted(const PlanRequest& request, const Asked& asked);
/// The same among those that can be borne at the catalogue's conditions, else at the
/// gentlest; if none can, or the operation is given, the one of all, whose limits then tell
/// why it cannot be.
Fitted fitted_if(const PlanRequest& request, const Asked& asked,
                 const std::function<bool(const Fitted&)>& borne);
/// Adds the conflict that an operation cannot be made.
void refuse(const Site& site, const Asked& asked, const std::string& why);

/// Whether the operation names a tool, and one for this.
bool names_tool(const PlanRequest& request, const OperationRequest& operation,
                FixedUse use);
/// Whether a given operation is one at fixed conditions on a surface in this setup.
bool is_given_on(const Site& site, const OperationRequest& operation,
                 const std::string& surface);
/// The first of them; with a tool for a use, if that is asked.
const OperationRequest* given_on(const Site& site, const std::string& surface,
                                 std::optional<FixedUse> use = {});

/// The highest spindle speed of a setup.
double n_cap_rpm(const Site& site);

/// Load of a pass on the spindle at one end of its diameters.
struct Duty {
  cutting::Load load;
  double n_rpm = 0, D_mm = 0;
  bool radial = false;  ///< the feed's force does not pull at the jaws
};

/// Force that the jaws need at rest for a load, and have.
struct GripForces {
  double needed_N = 0, closed_N = 0;
};
GripForces grip_forces(const PreparedPart& part, std::size_t setup, Clamping clamping,
                       Stage stage, const Duty& duty);
/// The limits of an operation; of each name the tightest.
std::vector<ConstraintValue> limits(const Site& site, const FixedTool& tool,
                                    const std::vector<Duty>& duties);

/// Lengths of the passes outside the cut, and where they begin and end (pass_lengths.hpp).
struct Way {
  double fed_min = 0, rapid_mm = 0;
  bool inner = false;
  double from_mm = 0, to_mm = 0;
};

/// Lengths [mm] that a drill goes in the cut, pecks among them, and in rapid, where it comes
/// in from `before_mm` in front of the material and its tip goes so deep.
struct DrillWay {
  double fed_mm = 0, rapid_mm = 0;
};
DrillWay drill_way(const FixedTool& drill, double D_mm, double tip_mm, double before_mm);

/// An operation with its passes, their forces and paths: Eq. (6).
AuxiliaryOperation operation(const Site& site, const Asked& asked, const Fitted& fitted,
                             std::vector<Pass> passes, const Way& way,
                             const std::vector<Duty>& duties);
Pass pass_of(const Duty& duty, double ap_mm, double time_min);
/// The operation at the best conditions that the tool's window and the request leave open;
/// the largest of its diameters comes first.  Given ones are limited by the window and the
/// spindle as chosen ones are.
AuxiliaryOperation at_best(const Site& site, Fitted fitted,
                           const std::vector<double>& D_mm, double n_cap_rpm,
                           const std::function<AuxiliaryOperation(const Fitted&)>& make);

/// An element with a groove, thread, arc or hole: its place and its requirements.
struct CutElement {
  const std::string& id;
  const part::Cut& cut;
  bool inner;
  std::size_t index;
  double length_mm, small_mm, large_mm;  ///< blank and drawn diameters together
  double bored_mm;                       ///< of the blank, what an inner tool enters
  Surroundings around;
  double root_h() const { return (inner ? -1 : 1) * cut.core.left_mm / 2; }
};

/// Whether material before the free end is in the way of an operation that begins at a
/// position; refuses it then.
bool unfaced(const Site& site, const Asked& asked, const CutElement& element,
             double z_mm);

}  // namespace turnwright::planning::fixed
