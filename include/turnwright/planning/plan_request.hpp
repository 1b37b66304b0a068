#pragma once
#include <optional>
#include <string>
#include <vector>

#include "turnwright/catalogue/fixed_tool.hpp"
#include "turnwright/catalogue/machine.hpp"
#include "turnwright/catalogue/material.hpp"
#include "turnwright/catalogue/milling_cutter.hpp"
#include "turnwright/catalogue/shop.hpp"
#include "turnwright/catalogue/tool.hpp"
#include "turnwright/part/drawing.hpp"

/// The request of `plan` and `predict` as plain values: what was asked, ids resolved and
/// defaults filled in (document/ reports which under `assumed`).  Nothing in it is computed
/// from the rest: what follows from it is in a PreparedPart (prepared_part.hpp).
namespace turnwright::planning {

enum class Clamping {
  chuck,
  chuck_tailstock,
  between_centres,
  chuck_steady,
  tailstock_follow  ///< chuck and tailstock, a follow rest at the tool
};
const char* name(Clamping clamping);

/// How sentences name the setup of an index: "setup 1" is the first.
std::string setup_label(std::size_t index);

/// The kind of the chuck's jaws, which decides how well they centre the part.
enum class Jaws {
  hard,   ///< hardened, ground
  soft,   ///< bored in place to the diameter they hold
  collet  ///< or a collet chuck
};
const char* name(Jaws jaws);

struct SetupRequest {
  part::End hold = part::End::left;    ///< the end in the jaws or at the headstock
  std::optional<double> grip_mm = {};  ///< of that end in the jaws; absent: chosen
  std::vector<Clamping> clampings;     ///< candidates, at least one
  double steady_z_mm = 0;              ///< where a steady rest stands, with chuck_steady
  std::optional<double> grip_force_N = {};  ///< all jaws at rest; absent: the chuck's
  std::optional<double> finishing_grip_force_N = {};  ///< once roughing is done
  Jaws jaws = Jaws::soft;
};

/// Errors of the shop in addition to those of the cut and of the machine's geometry.
/// Offsets are assumed to be set so that a drift in one direction runs from one side of
/// its middle to the other.
struct ShopErrors {
  double drift_um = 0;  ///< edge against spindle between two corrections, +-, radial
  double drift_axial_um = 0;    ///< and along the axis
  double repeatability_um = 0;  ///< position of the edge from part to part, one sigma
  double part_warm_K = 0;       ///< largest excess temperature of the part at finishing
  double life_between_offsets = 0;  ///< share of an edge's life used between corrections
  double wear_land_mm = 0.3;        ///< VB at the end of the life (ISO 3685's criterion)
  /// VB at which finishing edges are changed, at most wear_land_mm; then every limit and
  /// tolerance holds from the new edge to this one.  0: forces are those of new edges, and
  /// edges serve their whole life.
  double edge_wear_mm = 0;
  /// An edge whose land is this many times as large as the law says is noticed and
  /// changed, 1 or more.  2 is an estimate, 1.5 to 3: ISO 3685 ends a life at VB 0.3 mm,
  /// and where the land is uneven at its largest width, 0.6 mm.
  double wear_noticed_times = 2;
  catalogue::Rechucking rechucking = {0, 0, 0, 0};  ///< in a later setup
  double measurement_U_um = 0;  ///< expanded uncertainty of the measurement (ISO 14253-1)
  /// Offsets are set by gauging the first part: they take out the machine's mean error of
  /// a size, and that of the cut.
  bool first_part_gauged = true;
};

/// What a drill leaves on the radius for boring [mm].
inline constexpr double kLeftToBore_mm = 0.5;

enum class OperationKind {
  face,
  rough,
  finish,
  bore_rough,
  bore_finish,
  fixed,
  mill,
  cross_drill
};
const char* name(OperationKind kind);

/// Whether a driven tool cuts, while the main spindle holds the part at an angle.
constexpr bool is_driven(OperationKind kind) {
  return kind == OperationKind::mill || kind == OperationKind::cross_drill;
}

enum class Direction { to_chuck, from_chuck };
const char* name(Direction direction);

/// Conditions of an operation that the request fixes; absent ones are chosen by the
/// planner.
struct Conditions {
  std::optional<int> passes;
  std::optional<double> ap_mm, f_mm_rev, vc_m_min;
};

struct OperationRequest {
  std::string id;
  std::size_t setup = 0;
  OperationKind kind = OperationKind::rough;
  std::vector<std::string> on;      ///< elements, or one end face
  std::optional<std::string> tool;  ///< absent: chosen from the tools
  Direction direction = Direction::to_chuck;
  Conditions conditions;
};

enum class MilledKind {
  flat,    ///< across the cylinder, as wide as its chord
  keyway,  ///< closed at both ends
  slot,    ///< runs out at one end of its element at least
  cross_hole
};
const char* name(MilledKind kind);

/// How far a cross hole goes.
enum class Through {
  no,    ///< to a depth
  wall,  ///< into the bore
  part   ///< out of the cylinder on its other side
};
const char* name(Through through);

/// A keyway, slot or flat, milled into a turned outer cylinder by a driven tool whose
/// axis crosses that of the part at a right angle, and which is fed along the part; or a
/// cross hole, which a drill makes along that axis.
struct Milled {
  std::string id;
  std::size_t entry =
      0;  ///< of the list that asks for it, which may ask for several alike
  MilledKind kind = MilledKind::keyway;
  std::size_t element = 0;         ///< of drawing.outer
  double z_mm = 0, length_mm = 0;  ///< left end, along the part; rounded ends included
  double width_mm = 0;             ///< of a flat the chord at its floor
  /// Of the floor below the cylinder's rim; of a cross hole without the drill's point, of one
  /// that goes through as far as its corners have to go.
  double depth_mm = 0;
  double angle_deg = 0;                    ///< of its middle about the axis
  std::optional<double> corner_mm;         ///< largest corner radius at the floor
  std::optional<std::size_t> given_setup;  ///< absent: the first that leaves it free
  double depth_margin = 0.2;               ///< relative margin of stability in depth,
  double speed_margin = 0.02;              ///< at all speeds within this relative margin
  std::vector<catalogue::MillingCutter> cutters;  ///< a given one, or all
  std::optional<int> passes, lanes;               ///< absent: chosen by the planner
  std::optional<double> n_rpm, fz_mm;
  Through through = Through::no;    ///< of a cross hole, as are the next
  std::vector<std::string> drills;  ///< those that serve; empty: all of its diameter
  Conditions drilling;
};

enum class Objective { cost, time, profit };

struct PlanRequest {
  part::Drawing drawing;
  catalogue::Material material;
  catalogue::Lathe machine;
  std::vector<catalogue::Tool> tools;
  std::vector<catalogue::FixedTool> fixed_tools = {};
  std::vector<catalogue::Tool> spare_tools = {};  ///< others that remedies may propose
  std::vector<SetupRequest> setups;
  std::vector<Milled> milled = {};
  std::optional<std::vector<OperationRequest>> operations;  ///< absent: "auto"
  /// Whether outer shoulders are faced, asked for or not, where their edge is chamfered or
  /// rounded into stock that a later setup turns, and `operations` are absent.  Else the
  /// tool that finishes in front cuts that edge.  No document sets it: candidates of a
  /// choice have both.
  bool face_edges_in_stock = true;
  Objective objective = Objective::cost;
  std::optional<double> batch;  ///< absent: preparing the machine is left out of a part
  double machine_per_min = 0;   ///< cost of a machine minute
  std::string currency =
      {};  ///< of all money, as "EUR"; told, not converted; empty: not named
  double stock_price = 0;       ///< of the piece of stock for one part
  std::optional<double> price;  ///< of a part; needed for `profit`
  double machine_share_um = 0;  ///< of every tolerance, in addition to `machine.errors`
  double window_percent = 5;    ///< extra cost allowed within an operation's window
  bool window_curves = false;   ///< with limits and lines of equal cost, if asked for
  /// Of a part that bends, for chatter.  0.012 is chosen on the safe side from the
  /// measured shafts of docs/reality.md.
  double damping_ratio = 0.012;
  /// Of what holds it and cuts it, joints and all: chuck, centres, rests, toolpost, and
  /// boring bars without their own.  0.03 is an estimate, with which a steel bar cuts up to
  /// the four diameters of overhang that its makers allow.
  double machine_damping_ratio = 0.03;
  /// Standard deviation of the logarithm of the limits of chatter, which are proportional
  /// to zeta (1 + zeta).  0: both ratios are taken as they are.
  double damping_uncertainty_pct = 0;
  /// Factor on the limits of chatter.  No document sets it: it is 1, and larger in the
  /// requests with relaxed limits by which an infeasible part is explained.
  double chatter_times = 1;
  ShopErrors shop;
  catalogue::ShopRules rules = {};  ///< kept by every plan (rules.hpp)
  double conformance = 0.9973;
  /// Probability with which roughness is kept, where the material's hmin is uncertain.
  /// Absent: hmin itself decides.
  std::optional<double> roughness_conformance = {};
  bool robust = true;  ///< require `conformance` of every tolerance, not only nominally
  std::size_t pareto = 0;  ///< corners of cost against time to find, 0: none
};

}  // namespace turnwright::planning
