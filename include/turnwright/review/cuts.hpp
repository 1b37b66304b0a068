#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "turnwright/planning/prepared_part.hpp"
#include "turnwright/planning/process_plan.hpp"
#include "turnwright/review/program.hpp"

/// The cuts of a program: the values that `review` (review.hpp) fills.
namespace turnwright::review {

/// A tool in the turret, of one of the two kinds.
struct MountedTool {
  int number = 0;
  std::optional<catalogue::Tool> turning = {};
  std::optional<catalogue::FixedTool> fixed = {};
  double size_mm = 0;  ///< of a drill or reamer its diameter, of a blade its width
};

/// The id of a tool in the catalogue.
const std::string& id(const MountedTool& tool);
/// What it is called in results: its id, of drills and blades with their size.
std::string label(const std::string& id, double size_mm);

/// The program of one setup.
struct ReviewedProgram {
  std::size_t setup = 0;
  TurningProgram program;
  /// Place of the program's zero, from the finished face of the free end away from the
  /// chuck [mm].
  double zero_mm = 0;
};

/// One pass over one surface.
struct PassCut {
  std::size_t line = 0;               ///< of its first block
  double ap_mm = 0;                   ///< that prevails
  double most_mm = 0;                 ///< the largest,
  std::size_t most_line = 0;          ///< in this block
  double x_from_mm = 0, x_to_mm = 0;  ///< radii of the tip, x_from <= x_to
  double x_mm = 0;                    ///< the radius that prevails
  bool beside = false;                ///< it belongs to a pass over another surface
  double length_mm = 0;               ///< of the way in the cut
  double time_min = 0;                ///< in the cut
  double before_mm = 0;               ///< depth of a thread before this infeed
};

/// Loads and speeds of a cut.
struct Loads {
  double vc_m_min = 0, n_rpm = 0;  ///< the largest, and the spindle speed there
  double Fc_N = 0, Ff_N = 0, Fp_N = 0, Pc_kW = 0;
  double T_min = 0;  ///< tool life
};

/// The passes over one surface at the same conditions.
struct Cut {
  std::string on;  ///< an element, a shoulder "d1|d2", an end
  int tool = 0;
  std::string tool_id;
  double size_mm = 0;  ///< of a drill or blade
  planning::OperationKind kind = planning::OperationKind::rough;
  toolpath::Step at;  ///< conditions alone
  std::vector<PassCut> passes;
  Loads loads;           ///< of the heaviest pass at the depth that prevails
  double most_Fc_N = 0;  ///< at the largest depth of all passes
  double edges = 0;      ///< of its tool's edge that it uses up
  std::vector<planning::ConstraintValue> limits;  ///< at the depth that prevails
};

/// A rapid through material.
struct RapidCut {
  std::size_t line = 0;
  double mm = 0;  ///< how deep
};

/// The diameter that the programs leave of an element.
struct MadeSize {
  std::string on;
  std::size_t setup = 0;   ///< the last that cuts it
  double diameter_mm = 0;  ///< that prevails, of a cone at its middle
  double nominal_mm = 0;   ///< of the drawing, there
  std::optional<part::Limits> limits = {};
};

struct ReviewedSetup {
  std::size_t setup = 0;
  std::vector<Cut> cuts;
  toolpath::Minutes minutes;  ///< without stops, whose duration no program says
  int stops = 0;              ///< M0 and M1
  std::vector<RapidCut> rapids;
  std::vector<Unknown> unknown;
  std::vector<std::string> assumed;
  double edge_cost = 0, edge_min = 0;  ///< edges used up: money, and minutes of changing
};

struct Review {
  std::vector<ReviewedSetup> setups;
  std::vector<MadeSize> sizes;  ///< of the elements that the programs cut
};

}  // namespace turnwright::review
