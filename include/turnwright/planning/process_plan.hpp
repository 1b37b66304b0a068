#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "turnwright/planning/prepared_part.hpp"

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
/// straight in logarithms, that holds nothing else (window.hpp).
struct OperatingWindow {
  double percent = 0;
  std::vector<double> vc_m_min, f_mm_rev;  ///< vertices, counter-clockwise
  std::vector<std::string> limits;         ///< of the edge from each vertex to the next
  std::vector<WindowCurve> limit_curves, cost_curves;  ///< if asked for
};

/// How a milled place is cut, beside its passes, and how deep it might be.
struct MilledCut {
  MilledKind kind = MilledKind::keyway;
  int lanes = 1;
  double ae_mm = 0;  ///< radial depth of the widest cut
  double fz_mm = 0, hm_mm = 0, vf_mm_min = 0;
  double Kt_MPa = 0, Kn_MPa = 0;
  double depth_margin = 0, speed_margin = 0;  ///< asked for
  /// The part's compliance across the feed over the tool point's: both yield together.
  double part_share = 0;
  double limit_mm = 0;  ///< least first loss of stability of all speeds within the margin
  /// First losses over the speeds of cutter and spindle, none: beyond the depth shown.
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
  double cost = 0;      ///< in the cut, on approach and return, and of edges
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

/// A tool that could serve a setup, or looks as if, and is not chosen for that use.
struct RejectedTool {
  std::string tool, use;  ///< "facing", "roughing", "finishing", "boring, finish", ..
  std::string why;
  std::optional<double> at_least;  ///< proved: the setup's objective with it
};

/// Minutes and money of a part.
struct Spending {
  double time_min = 0, cost = 0;
};

/// Where the time and the cost of a part go.
struct Breakdown {
  Spending cutting;         ///< feed over the surfaces
  Spending air;             ///< feed beside them and rapids
  Spending tool_changes;    ///< bringing in tools
  Spending operator_stops;  ///< centres and rests brought up, jaws' force changed
  Spending edges;           ///< changing worn edges, and the edges themselves
  Spending loading;         ///< part in and out
  Spending setup_share;     ///< preparing the machine, over the batch

  Breakdown& operator+=(const Breakdown& other);
  Spending total() const;
};

struct SetupPlan {
  part::End hold = part::End::left;
  Clamping clamping = Clamping::chuck;
  double grip_force_N = 0;            ///< of all jaws at rest; 0 between centres
  double finishing_grip_force_N = 0;  ///< from the first finishing pass on
  std::vector<RejectedClamping> rejected;
  std::vector<RejectedTool> rejected_tools;  ///< in the clamping chosen
  std::vector<OperationPlan> operations;
  Breakdown breakdown;  ///< nothing where the part has no plan
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
  double width_mm = 0;  ///< of the tolerance, which the shares are of
  Verdict verdict = Verdict::met;
  bool seed_verdict = true;
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
/// Of a correction at a place; beyond its ends as at the nearest.
double interpolated(const Compensation::Table& table, double at);

/// Error of a surface as it is made, corrected path included.
struct Deviation {
  std::string on;
  std::size_t setup = 0;
  std::vector<std::pair<double, double>>
      table_mm;  ///< (z, or rho of a face; error of the radius, or along the axis)
};

/// What opening a number of the request saves, to first order, wherever it binds.
struct Price {
  std::string limit;  ///< "d1:diameter", "roughness Ra of d2", "power of lathe-medium"
  double now = 0;
  std::string unit;
  double saves_per_part_for_10_percent = 0, saves_per_batch_for_10_percent = 0;
  std::vector<std::string> binds_in;  ///< operations
  std::string sentence;
};

/// A member of an irreducible set of limits that no recipe keeps together: without any
/// one of them the rest of its set is kept, over every clamping, tool and pass count.
struct Conflict {
  std::string limit;  ///< constraint or tolerance in the irreducible conflicting set
  std::string where;  ///< setup, clampings and surface
  double value = 0;   ///< the best that can be had with the rest of the set kept
  double allowed = 0;
  std::string unit;
  std::string sentence;
  std::size_t set = 0;  ///< which set, from 1; 0: an obstacle that no limit decides
};

/// What one member would have to become for everything else to be kept: the whole width
/// of a tolerance.  Opening one of every set makes the part feasible.
struct Relaxation {
  std::string limit;
  double now = 0, needed = 0;
  std::string unit;
  std::string sentence;  ///< "t2 would have to open from 0.004 to 0.0061 mm"
  std::size_t set = 0;   ///< as of the conflict; 0: of an obstacle
};

/// One change of the request, beside its limits, that makes an infeasible part feasible:
/// it was planned with it.
struct Remedy {
  enum class Change {
    clamping,  ///< `clamping` allowed in `setup`, a rest at `steady_mm`
    grip,      ///< `setup` grips `grip_mm`
    tool,      ///< the catalogue's tool `name` allowed
    operation  ///< the condition `key` of operation `name` left to the planner
  };
  Change change = Change::clamping;
  std::size_t setup = 0;
  Clamping clamping = Clamping::chuck;
  double steady_mm = 0, grip_mm = 0;
  std::string name = {}, key = {};
  std::string sentence = {};
  double cost_per_part = 0, time_per_part_min = 0;  ///< of the plan with it
};

/// A certified plan on the convex hull of cost against time: no plan has less of
/// cost + minute time.
struct ParetoPoint {
  double cost_per_part = 0, time_per_part_min = 0;
  std::optional<double> minute_worth;  ///< above the machine's rate; none: time alone
};

/// The request with something changed, and what that is called.
struct WhatIf {
  std::string name;
  PreparedPart part;
};

/// A changed request, planned anew, against the one that was asked.
struct WhatIfAnswer {
  std::string name;
  bool feasible = false;
  double cost_per_part = 0, time_per_part_min = 0;  ///< 0: no plan to cost
  std::optional<double> saves_per_part, saves_per_batch,
      saves_min_per_part;  ///< if both have a plan
  std::optional<double>
      first_order_saves_per_part;  ///< first_order.hpp, of the objective
  std::string sentence;
};

/// What a plan would take that keeps its tolerances only nominally.
struct Robustness {
  double conformance = 0;
  double nominal_cost_per_part = 0, nominal_time_per_part_min = 0;
};

enum class PlanStatus { ok, infeasible };

struct ProcessPlan {
  PlanStatus status = PlanStatus::ok;
  double cost_per_part = 0, time_per_part_min = 0;  ///< 0: no plan to cost
  Breakdown breakdown;                              ///< of these, over all setups
  std::optional<double> profit_per_min;
  Certificate certificate;
  std::vector<SetupPlan> setups;
  std::vector<ToleranceResult> tolerances;
  std::vector<Deviation> deviations;
  std::vector<Compensation> compensation;
  std::vector<Price> prices;             ///< largest saving first
  std::vector<WhatIfAnswer> what_if;     ///< as asked
  std::optional<Robustness> robustness;  ///< of a robust plan
  std::vector<ParetoPoint> pareto;       ///< cheapest first, if asked for
  std::vector<Conflict> conflicts;
  std::vector<Relaxation> relax;
  std::vector<Remedy> remedies;  ///< cheapest first
};

/// Certified cheapest process plan of a part, and of changed requests what they save.
/// @throws std::domain_error if profit is the objective and no price is given.
ProcessPlan plan(const PreparedPart& part, const std::vector<WhatIf>& what_if = {});
ProcessPlan plan(const PlanRequest& request);

/// Deviations, margins, time and cost of a part whose operations are given whole, in the
/// first clamping of each setup.  Nothing is optimised; limits that are not kept are
/// `conflicts`, and the tolerances are judged all the same.
/// @throws std::domain_error if a setup has no clamping, or a turning operation no speed
///   or feed.
ProcessPlan predict(const PreparedPart& part);
ProcessPlan predict(const PlanRequest& request);

}  // namespace turnwright::planning
