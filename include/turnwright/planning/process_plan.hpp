#pragma once
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "turnwright/planning/plan_request.hpp"

/// The answer of `plan`: the fields of schemas/plan.result.json, one to one.
namespace turnwright::planning {

enum class CertificateKind { global, local, none };

struct Certificate {
  CertificateKind kind = CertificateKind::none;
  double lower_bound = 0;  ///< no feasible choice has a smaller objective
  double gap = 0;          ///< (objective - lower_bound) / objective
  long nodes = 0;          ///< boxes bounded
  std::string engine;      ///< method of the proof
  std::string reason;      ///< why not global, else empty
};

struct Pass {
  double ap_mm = 0, f_mm_rev = 0, vc_m_min = 0, n_rpm = 0, time_min = 0;
  double Fc_N = 0, Ff_N = 0, Fp_N = 0, Pc_kW = 0, T_min = 0;
};

/// One constraint re-evaluated at the answer; kept when value <= limit (`at_most`) or
/// value >= limit.
struct ConstraintValue {
  std::string name, unit;
  double value = 0, limit = 0;
  bool at_most = true;
  double margin = 0;  ///< -ln(value/limit) for at_most, +ln for at_least
  bool binding = false;
  double shadow_price = 0;  ///< d ln(objective of the group) / d ln(limit), >= 0
};

/// A line in the plane of speed and feed, for a picture.
struct WindowCurve {
  std::string name;  ///< of the limit, or "+2.5 %"
  std::vector<double> vc_m_min, f_mm_rev;
};

/// Speeds and feeds of an operation that keep every limit and cost at most `percent` more
/// than its optimum, with depths, passes and all other operations as chosen: a polygon,
/// with edges straight in logarithms, all of whose conditions do so (operating_window.hpp).
struct OperatingWindow {
  double percent = 0;
  std::vector<double> vc_m_min, f_mm_rev;  ///< vertices, counter-clockwise
  std::vector<std::string> limits;         ///< of the edge from each vertex to the next
  std::vector<WindowCurve> limit_curves, cost_curves;  ///< if requested
};

/// The cut of a keyway, slot or flat in addition to its passes, and its limits of stability.
struct MilledCut {
  MilledKind kind = MilledKind::keyway;
  int lanes = 1;
  double ae_mm = 0;  ///< radial depth of the widest cut
  double fz_mm = 0, hm_mm = 0, vf_mm_min = 0;
  double Kt_MPa = 0, Kn_MPa = 0;
  double depth_margin = 0, speed_margin = 0;  ///< required
  /// The part's compliance across the feed, relative to the tool point's.
  double part_share = 0;
  double limit_mm = 0;  ///< least first loss of stability of all speeds within the margin
  /// First losses of stability over the speeds of cutter and spindle; none where they lie
  /// beyond the depth shown.
  std::vector<double> n_rpm;
  std::vector<std::optional<double>> limits_mm;
  double shown_mm = 0;
};

struct OperationPlan {
  std::string id;
  OperationKind kind = OperationKind::rough;
  std::vector<std::string> on;
  std::string tool;
  Direction direction = Direction::to_chuck;
  std::vector<Pass> passes;
  double time_min = 0;  ///< cutting
  double cost = 0;      ///< of the cut, approach and return, and edges
  double edges = 0;     ///< of its tool's edge that one part uses up, as `cost` counts it
  std::vector<ConstraintValue> constraints;
  Certificate certificate;
  std::optional<OperatingWindow> window;  ///< of conditions that were chosen
  std::optional<MilledCut> milled = {};
};

struct RejectedClamping {
  Clamping clamping = Clamping::chuck;
  std::string why;
  std::optional<double> cost;  ///< per part, absent when infeasible
};

/// A tool that could serve a use in a setup, or seems to, and is not chosen for it.
struct RejectedTool {
  std::string tool, use;  ///< "facing", "roughing", "finishing", "boring, finish", ..
  std::string why;
  std::optional<double> at_least;  ///< proved: the setup's objective with it
};

/// Minutes and money of a part.
struct Spending {
  double time_min = 0, cost = 0;
  Spending& operator+=(const Spending& other) {
    time_min += other.time_min;
    cost += other.cost;
    return *this;
  }
};

/// Time and cost of a part by what they are spent on.
struct Breakdown {
  Spending cutting;         ///< feed over the surfaces
  Spending air;             ///< feed beside them and rapids
  Spending tool_changes;    ///< bringing in tools
  Spending operator_stops;  ///< centres and rests brought up, jaws' force changed
  Spending edges;           ///< changing worn edges, and the edges themselves
  Spending loading;         ///< part in and out
  Spending setup_share;     ///< preparing the machine, over the batch
  Spending stock;           ///< the piece of stock, of the whole part alone

  Breakdown& operator+=(const Breakdown& other);
  Spending total() const;
};

/// What a Breakdown consists of.
inline constexpr std::array kSpendings{
    &Breakdown::cutting,        &Breakdown::air,   &Breakdown::tool_changes,
    &Breakdown::operator_stops, &Breakdown::edges, &Breakdown::loading,
    &Breakdown::setup_share,    &Breakdown::stock};

/// The offset of a tool while its edge wears: from the part after `after_part` of an edge
/// on it is by `um` beyond what the program holds for a new edge, on the diameter, of a
/// face along the axis.
struct OffsetStep {
  long after_part = 0;
  double um = 0;
};

/// The steps of the offset at one surface, from the new edge to its change.
struct FollowedOffset {
  std::string on;
  std::vector<OffsetStep> steps;
};

/// When a tool's edge is changed, and what is corrected until then.
struct EdgeSchedule {
  std::string tool;           ///< as programs list it, drills and blades with their size
  double edges_per_part = 0;  ///< of an edge that one part uses up
  long parts_per_edge = 0;    ///< whole parts; 0: an edge does not last for one
  std::optional<long> edges_per_batch = {};  ///< begun in a batch, if there is one
  std::vector<FollowedOffset> offsets = {};  ///< at its sizes
};

struct SetupPlan {
  part::End hold = part::End::left;
  Clamping clamping = Clamping::chuck;
  double grip_force_N = 0;            ///< of all jaws at rest; 0 between centres
  double finishing_grip_force_N = 0;  ///< from the first finishing pass on
  std::vector<RejectedClamping> rejected;
  std::vector<RejectedTool> rejected_tools;  ///< in the clamping chosen
  std::vector<OperationPlan> operations;
  std::vector<EdgeSchedule> edges;  ///< in the order of use; none if the part has no plan
  Breakdown breakdown;              ///< zero if the part has no plan
};

enum class Verdict { met, met_with_offset, not_met };
const char* name(Verdict verdict);

struct Share {
  std::string source;
  double um = 0;
};

struct ToleranceResult {
  std::string id;
  part::ToleranceKind kind = part::ToleranceKind::diameter;
  std::string of;
  std::vector<double>
      predicted_mm;  ///< {min, max} of a size's deviation, {value} of a form
  std::vector<double> allowed_mm;  ///< same layout
  double margin_mm = 0;
  double width_mm = 0;  ///< of the tolerance; the shares are parts of it
  Verdict verdict = Verdict::met;
  bool published_verdict = true;
  std::vector<Share> shares;
  double P_conform = 1;
};

struct Compensation {
  /// (z, or rho of a face; what to add to the tool path's radius, or along the axis).
  using Table = std::vector<std::pair<double, double>>;

  std::string on;
  std::size_t setup = 0;
  Table table_mm;
};

/// The tool's offset at a size: every pass over the surface is moved by it, on the radius
/// or along the axis, so that the size lies in the middle of its limits.  The first part
/// confirms it.
struct ToolOffset {
  std::string on;
  std::size_t setup = 0;
  double offset_mm = 0;
  /// Where the edge is changed, if its wear is followed: the offset moves from one to the
  /// other in proportion to the wear land.
  std::optional<double> at_change_mm = {};
};

/// The correction at a position, linear between the entries of its table and constant
/// beyond them.
double interpolated(const Compensation::Table& table, double at);

/// Error of a surface as it is made, corrected path included.
struct Deviation {
  std::string on;
  std::size_t setup = 0;
  std::vector<std::pair<double, double>>
      table_mm;  ///< (z, or rho of a face; error of the radius, or along the axis)
  /// The same where the edge is changed, with the offset of that state; empty if the
  /// forces are those of new edges.
  std::vector<std::pair<double, double>> at_change_mm = {};
};

/// Saving, to first order, by relaxing a number of the request wherever it binds.
struct Price {
  std::string limit;  ///< "d1:diameter", "roughness Ra of d2", "power of lathe-medium"
  double now = 0;
  std::string unit;
  double saves_per_part_for_10_percent = 0;
  std::optional<double> saves_per_batch_for_10_percent;  ///< of a request with a batch
  std::vector<std::string> binds_in;                     ///< operations
  std::string sentence;
};

/// A member of an irreducible set of limits that no recipe keeps together: without any
/// one of them the rest of its set is kept, over every clamping, tool and pass count.
struct Conflict {
  std::string limit;  ///< constraint or tolerance in the irreducible conflicting set
  std::string where;  ///< setup, clampings and surface
  double value = 0;   ///< the best value reached while the rest of the set is kept
  double allowed = 0;
  std::string unit;
  std::string sentence;
  std::size_t set = 0;  ///< number of the set, from 1; 0: no limit can resolve it
};

/// The value that one member needs for everything else to be kept; for a tolerance its
/// whole width.  Relaxing one member of every set makes the part feasible.
struct Relaxation {
  std::string limit;
  double now = 0, needed = 0;
  std::string unit;
  std::string sentence;  ///< "t2 would have to open from 0.004 to 0.0061 mm"
  std::size_t set = 0;   ///< that of the conflict
};

/// A change of the request other than of its limits.
struct RequestChange {
  enum class Kind {
    clamping,  ///< `clamping` allowed in `setup`, a rest at `steady_mm`
    grip,      ///< `setup` grips `grip_mm`
    tool,      ///< the catalogue's tool `name` allowed
    operation  ///< the condition `key` of operation `name` left to the planner
  };
  Kind kind = Kind::clamping;
  std::size_t setup = 0;
  Clamping clamping = Clamping::chuck;
  double steady_mm = 0, grip_mm = 0;
  std::string name = {}, key = {};
};

/// One change of the request, or two together where no single one was found, that makes
/// an infeasible part feasible: it was planned with it.
struct Remedy {
  std::vector<RequestChange> changes;  ///< one or two
  std::string sentence = {};
  double cost_per_part = 0, time_per_part_min = 0;  ///< of the plan with it
};

/// A change of the request that was tried alone and leaves the part infeasible.
struct TriedChange {
  RequestChange change;
  std::string sentence;  ///< "allowing between-centres in setup 1"
};

/// A certified plan on the convex hull of cost against time: no plan has a smaller
/// cost + minute time, where minute is the worth of a minute.
struct ParetoPoint {
  double cost_per_part = 0, time_per_part_min = 0;
  std::optional<double> minute_worth;  ///< above the machine's rate; none: time alone
};

/// A changed request, planned anew, compared with the original one.
struct WhatIfAnswer {
  std::string name;
  bool feasible = false;
  double cost_per_part = 0, time_per_part_min = 0;  ///< 0 without a plan
  std::optional<double> saves_per_part, saves_per_batch,
      saves_min_per_part;  ///< if both have a plan, per batch if there is one
  std::optional<double>
      first_order_saves_per_part;  ///< sensitivity.hpp, of the objective
  std::string sentence;
};

/// One of the requests among which the plan was chosen.
struct Alternative {
  std::string name;  ///< "lathe-small; held left, then right"
  bool feasible = false, chosen = false;
  std::optional<double> cost_per_part = {}, time_per_part_min = {};  ///< if feasible
  std::optional<double> lower_bound = {};  ///< of its certificate, of the objective
  std::string why = {};                    ///< it has no plan
  std::string sentence = {};
};

/// The tolerance that fewest parts keep.
struct WorstConformance {
  std::string tolerance;
  double P_conform = 1;
  double wanted = 0;  ///< probability required of every tolerance
};

/// Preparing the machine, once for the whole batch.
struct SettingUp {
  double minutes = 0, cost = 0;
  /// The share of each part, contained in time and cost per part; none without a batch.
  std::optional<double> minutes_per_part, cost_per_part;
};

enum class PlanStatus { ok, infeasible };

struct ProcessPlan {
  PlanStatus status = PlanStatus::ok;
  double cost_per_part = 0, time_per_part_min = 0;  ///< 0 without a plan
  Breakdown breakdown;                              ///< of these, over all setups
  std::optional<double> profit_per_min;
  SettingUp setting_up;
  std::optional<WorstConformance> worst_conformance;  ///< if there is a tolerance
  Certificate certificate;
  std::vector<SetupPlan> setups;
  std::vector<ToleranceResult> tolerances;
  std::vector<Deviation> deviations;
  std::vector<ToolOffset> offsets;
  std::vector<Compensation> compensation;
  std::vector<Price> prices;              ///< largest saving first
  std::vector<WhatIfAnswer> what_if;      ///< in the order of the request
  std::vector<WhatIfAnswer> rules;        ///< the part without each rule of the shop
  std::vector<Alternative> alternatives;  ///< if the request left a choice
  std::vector<ParetoPoint> pareto;        ///< cheapest first, if requested
  std::vector<Conflict> conflicts;
  std::vector<Relaxation> relax;
  std::vector<Remedy> remedies;    ///< cheapest first
  std::vector<TriedChange> tried;  ///< changes that are no remedy alone
};

}  // namespace turnwright::planning
