#include "turnwright/nc/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "centre_clearance.hpp"
#include "contour.hpp"
#include "fixed.hpp"
#include "milled.hpp"
#include "planning/clamping/centre_clearance.hpp"
#include "planning/clamping/supports.hpp"
#include "planning/values/tool_label.hpp"
#include "turning.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/cutting/spindle.hpp"

namespace turnwright::nc {
namespace {

using catalogue::FixedUse;
using planning::Clamping;
using planning::OperationKind;
using planning::OperationPlan;
using planning::Stage;

bool is_shoulder(const OperationPlan& o) {
  return o.kind == OperationKind::face && o.on[0].find('|') != std::string::npos;
}

bool on_axis(const Site& site, const OperationPlan& o) {
  return o.kind == OperationKind::fixed && catalogue::on_axis(use_of(site, o));
}

bool drills(const Site& site, const OperationPlan& o) {
  if (!on_axis(site, o)) return false;
  const auto use = use_of(site, o);
  return use == FixedUse::centring || use == FixedUse::drilling;
}

// End faces, centre holes and drilling are made in the chuck alone, before a centre or a
// rest comes in.
bool in_chuck_alone(const Site& site, const OperationPlan& o) {
  return (o.kind == OperationKind::face && !is_shoulder(o)) || drills(site, o);
}

// The stage whose jaw force an operation has.
Stage stage_of(const Site& site, const OperationPlan& o) {
  const bool rough =
      o.kind == OperationKind::rough || o.kind == OperationKind::bore_rough;
  return rough || in_chuck_alone(site, o) ? Stage::roughing : Stage::finishing;
}

struct Diameters {
  double small_mm = 0, large_mm = 0;
};

// Diameters that an operation's last pass sweeps.
Diameters swept(const Site& site, const OperationPlan& o) {
  const auto& d = site.part.drawing;
  if (const auto e = part::extent(d, o.on[0]))
    return {std::min(e->left_mm, e->right_mm), std::max(e->left_mm, e->right_mm)};
  if (const auto ring = planning::shoulder_ring(d, o.on[0]))
    return {ring->small_mm, ring->large_mm};
  return {d.stock.inner_mm, planning::end_stock_mm(site.part, site.setup)};
}

// The range in which an operation's tool is in the cut; call it before the operation
// cuts.
InCut in_cut(const Site& site, const OperationPlan& o) {
  const auto D = swept(site, o);
  if (o.kind == OperationKind::face) return {true, D.small_mm / 2, D.large_mm / 2};
  if (drills(site, o)) return {false, -INFINITY, site.front};
  if (o.kind == OperationKind::fixed && use_of(site, o) == FixedUse::parting)
    return {true, D.small_mm / 2, D.large_mm / 2};
  const auto& s = surface_of(site, o.on[0]);
  if (o.kind == OperationKind::fixed && use_of(site, o) == FixedUse::countersinking) {
    // From where the cone is as wide as the drilled hole.
    const double slope = s.front->axial_mm / s.front->radial_mm;
    const double drilled = part::opened_mm(*cut_of(site, s)) / 2;
    return {false, s.z0 - slope * (s.front->radial_mm - s.h0), s.z0 - slope * drilled};
  }
  if (o.kind == OperationKind::fixed && use_of(site, o) == FixedUse::profiling &&
      !cut_of(site, s))
    return {false, s.z0 - s.front->axial_mm, s.z0};
  if (o.kind != OperationKind::fixed || use_of(site, o) != FixedUse::grooving)
    return {false, s.z1, s.z0};
  const auto [small, large] =
      std::minmax({std::abs(s.h0), cut_of(site, s)->core.left_mm / 2});
  return {true, small, large};
}

// The clamping in which an operation is cut: ends are faced in the chuck, before a centre
// comes in.
planning::Clamping clamping_of(const Site& site, const OperationPlan& o) {
  const bool end =
      o.kind == OperationKind::face && (o.on[0] == "left" || o.on[0] == "right");
  return end ? planning::Clamping::chuck : site.clamping;
}

// The spindle limit [1/min] that applies to the plan's conditions.
double spindle_limit_rpm(const Site& site, std::size_t operation) {
  const auto& o = site.answer().operations[operation];
  const auto& m = site.part.machine;
  const double n = o.passes[0].n_rpm;
  double cap = m.n_max_rpm;
  for (const auto& r : cutting::speed_ranges(m))
    if (n <= r.n_max_rpm * (1 + 1e-12)) {
      cap = r.n_max_rpm;
      break;
    }
  const auto clamping = clamping_of(site, o);
  const double force =
      planning::jaw_force_N(site.part, site.setup, clamping, stage_of(site, o));
  if (!(force > 0)) return std::min(cap, m.n_max_rpm);
  const cutting::Grip grip{force, m.chuck.jaw_mass_radius_kg_m, m.chuck.friction,
                           planning::grip_diameter_mm(site.part, site.setup, clamping)};
  const double keeps_a_third = cutting::grip_rpm(grip, (1 - cutting::kGripLoss) * force);
  cap = std::min({cap, m.n_max_rpm, m.chuck.n_max_rpm, keeps_a_third});
  const auto D = swept(site, o);
  if (o.kind == OperationKind::fixed || !(D.small_mm < D.large_mm)) return cap;
  double sum = later_mm(site, operation, o.on[0]);
  for (const auto& pass : o.passes) sum += pass.ap_mm;
  const bool outside = o.kind == OperationKind::rough || o.kind == OperationKind::finish;
  const double needed = cutting::grip_needed_N(grip, o.passes[0].Fc_N, o.passes[0].Ff_N,
                                               D.large_mm + (outside ? 2 * sum : 0));
  return std::min(cap, cutting::grip_rpm(grip, needed));
}

// Grooving and parting run at constant surface speed; drilling, threading and profiling
// at the plan's spindle speed.
bool constant_surface_speed(const Site& site, const OperationPlan& o) {
  if (o.kind != OperationKind::fixed) return true;
  const auto use = use_of(site, o);
  return use == FixedUse::grooving || use == FixedUse::parting;
}

std::vector<std::string> comments(const OperationPlan& o) {
  const auto& p = o.passes[0];
  std::string on;
  for (const auto& id : o.on) on += " " + id;
  std::string depths;
  for (const auto& pass : o.passes) {
    const auto text = fmt::format("{:.4g}", pass.ap_mm);
    if (&pass == &o.passes[0] || text != fmt::format("{:.4g}", (&pass)[-1].ap_mm))
      depths += (depths.empty() ? "" : " ") + text;
  }
  const auto loads =  // those of knurling are not known
      p.Fc_N > 0 ? fmt::format(" Fc {:.0f} N, {:.2f} kW,", p.Fc_N, p.Pc_kW) : "";
  return {fmt::format("operation {}:{} {}, {} x {} mm, {:.4g} mm/rev, {:.4g} m/min", o.id,
                      on, name(o.kind), o.passes.size(), depths, p.f_mm_rev, p.vc_m_min),
          fmt::format("plan: {:.0f} 1/min,{} edge {:.3g} min, cut {:.3f} min", p.n_rpm,
                      loads, p.T_min, o.time_min)};
}

// What a call of a tool says of its edge.
std::string edge_words(const Site& site, const std::string& tool) {
  const auto& all = site.answer().edges;
  const auto e = std::ranges::find(all, tool, &planning::EdgeSchedule::tool);
  if (e == all.end()) return "";
  if (e->parts_per_edge == 1) return "change edge every part";
  if (e->parts_per_edge > 1)
    return fmt::format("change edge every {} parts", e->parts_per_edge);
  return fmt::format("a part wears {:.3g} edges", e->edges_per_part);
}

std::string clamping_change(const Site& site) {
  switch (site.clamping) {
    case Clamping::chuck:
      break;
    case Clamping::chuck_tailstock:
      return "stop: bring up the tailstock";
    case Clamping::between_centres:
      return "stop: from the chuck to between centres";
    case Clamping::chuck_steady:
      return fmt::format("stop: set the steady rest at Z{:.1f}",
                         site.z(site.part.setups[site.setup].steady_z_mm));
    case Clamping::tailstock_follow:
      return "stop: bring up the tailstock, set the follow rest";
  }
  return "";
}

Step stop(std::string told, double minutes) {
  Step s;
  s.comments = {std::move(told)};
  s.stop = true;
  s.stop_min = minutes;
  return s;
}

// What a program says where somebody mills a place that it does not.
std::string milled_by_hand(const Site& site, const OperationPlan& o) {
  const auto& p = o.passes[0];
  const auto passes = o.kind == OperationKind::mill
                          ? fmt::format(", {} x {:.4g} mm", o.passes.size(), p.ap_mm)
                          : "";
  return fmt::format(
      "stop: not in this program: {} with {}{}, {:.0f} 1/min, {:.4g} mm/min", o.id,
      planning::tool_label(site.part, o), passes, p.n_rpm, p.f_mm_rev * p.n_rpm);
}

// The stops before each operation at which the clamping is changed.
std::vector<std::vector<Step>> stops(const Site& site) {
  const auto& s = site.answer();
  std::vector<std::vector<Step>> all;
  bool clamped = false;
  double force_N = s.grip_force_N;
  for (const auto& o : s.operations) {
    auto& before = all.emplace_back();
    if (!clamped && !in_chuck_alone(site, o)) {
      clamped = true;
      if (auto told = clamping_change(site); !told.empty())
        before.push_back(
            stop(told, planning::clamping_min(site.part.machine, site.clamping)));
    }
    const double wanted_N =
        stage_of(site, o) == Stage::roughing ? s.grip_force_N : s.finishing_grip_force_N;
    if (wanted_N != force_N)
      before.push_back(stop(fmt::format("stop: jaws to {:.1f} kN", wanted_N / 1000),
                            site.part.machine.jaws_min));
    force_N = wanted_N;
  }
  return all;
}

// Numbers of the plan's tools, drills and blades of each size, in their order of use.
class Numbers {
 public:
  explicit Numbers(const planning::PreparedPart& part) : part_(part) {}
  TableTool tool(const Site& site, const OperationPlan& o) {
    TableTool t{.id = planning::tool_label(part_, o),
                .re_mm = corner_mm(site, o),
                .orientation = is_driven(o.kind)  ? kCutterOrientation
                               : on_axis(site, o) ? kDrillOrientation
                                                  : 3};
    if (!o.on.empty() && is_inside(o.on[0]) && t.orientation == 3) t.orientation = 2;
    auto it = std::find(ids_.begin(), ids_.end(), t.id);
    if (it == ids_.end()) it = ids_.insert(it, t.id);
    t.number = t.offset = static_cast<int>(it - ids_.begin()) + 1;
    return t;
  }

 private:
  bool is_inside(const std::string& surface) const {
    const auto& d = part_.drawing;
    const auto extent = part::extent(d, surface);
    return (extent && extent->inner) || part::inner_shoulder(d, surface);
  }

  const planning::PreparedPart& part_;
  std::vector<std::string> ids_;
};

const char* section_words(part::StockKind kind) {
  switch (kind) {
    case part::StockKind::hexagon:
      return "hexagon across flats";
    case part::StockKind::square:
      return "square across flats";
    case part::StockKind::casting:
      return "casting, largest diameter";
    case part::StockKind::forging:
      return "forging, largest diameter";
    case part::StockKind::bar:
    case part::StockKind::tube:
      break;
  }
  return "diameter";
}

std::vector<std::string> heading(const Site& site) {
  const auto& d = site.part.drawing;
  const auto& s = site.answer();
  auto held = fmt::format("setup {} of {}: {} end held, {}", site.setup + 1,
                          site.plan.setups.size(),
                          s.hold == part::End::left ? "left" : "right", name(s.clamping));
  if (s.grip_force_N > 0)
    held += fmt::format(", jaws {:.1f} kN, their front at Z{:.4g}", s.grip_force_N / 1000,
                        site.root_z);
  return {"part " + d.name,
          "material " + site.part.material.name + ", machine " + site.part.machine.name,
          fmt::format("stock {} {:g} x {:g} mm long, its face at Z{:g}",
                      section_words(d.stock.kind), part::across_mm(d.stock),
                      d.stock.length_mm, site.front),
          held,
          "zero: spindle axis and finished face of the free end",
          "tools at their imaginary tip, corner radius in the path"};
}

void way(Site& site, std::size_t i) {
  const auto& o = site.answer().operations[i];
  if (o.direction == planning::Direction::from_chuck && o.kind != OperationKind::fixed &&
      o.kind != OperationKind::face)
    site.refuse(o.id, tr("no program is made for turning from the chuck outwards"));
  else if (o.kind == OperationKind::fixed)
    fixed(site, i);
  else if (is_shoulder(o))
    face_shoulder(site, i);
  else if (o.kind == OperationKind::face)
    face(site, i);
  else
    turn(site, i);
}

void list(SetupProgram& p, const TableTool& tool) {
  if (std::ranges::find(p.tools, tool.number, &TableTool::number) == p.tools.end())
    p.tools.push_back(tool);
}

// The operation's step at an angle of the main spindle, or a stop where somebody mills.
Step milled(Site& site, std::size_t operation, Numbers& numbers, SetupProgram& p) {
  const auto& o = site.answer().operations[operation];
  const auto from = site.at;
  site.moves.clear();
  mill(site, operation);
  if (const auto why = not_milled(site, o); !why.empty()) {
    site.at = from;
    auto by_hand = stop(milled_by_hand(site, o), 0);
    by_hand.comments.push_back(why);
    return by_hand;
  }
  auto milling = milling_of(site, o);
  site.home(false);
  const auto tool = numbers.tool(site, o);
  list(p, tool);
  milling.stop = milled_by_hand(site, o);
  Step step;
  step.comments = comments(o);
  step.comments.push_back(fmt::format("driven tool: {:.0f} 1/min, {:.4g} mm/min",
                                      milling.n_rpm, milling.f_mm_min));
  if (auto words = edge_words(site, tool.id); !words.empty())
    step.comments.push_back(std::move(words));
  step.tool = tool.number;
  step.in_cut = {false, -INFINITY, INFINITY};
  step.moves = site.moves;
  step.milling = std::move(milling);
  return step;
}

SetupProgram program(Site& site, Numbers& numbers) {
  SetupProgram p;
  p.setup = site.setup;
  p.comments = heading(site);
  p.change_x_mm = site.at.h_mm;
  p.change_z_mm = site.at.z_mm;
  const auto& operations = site.answer().operations;
  const auto changes = stops(site);
  int called = 0;
  for (std::size_t i = 0; i < operations.size(); ++i) {
    const auto& o = operations[i];
    p.steps.insert(p.steps.end(), changes[i].begin(), changes[i].end());
    if (is_driven(o.kind)) {
      p.steps.push_back(milled(site, i, numbers, p));
      continue;
    }
    const auto tool = numbers.tool(site, o);
    list(p, tool);
    Step step;
    step.comments = comments(o);
    if (const auto why = entered_again(site, i))
      step.comments.push_back("enters the contour again: " + *why);
    step.tool = tool.number;
    if (auto words = edge_words(site, tool.id); called != tool.number && !words.empty())
      step.comments.push_back(std::move(words));
    called = tool.number;
    step.constant_surface_speed = constant_surface_speed(site, o);
    step.S = step.constant_surface_speed ? o.passes[0].vc_m_min : o.passes[0].n_rpm;
    step.n_max_rpm = spindle_limit_rpm(site, i);
    step.f_mm_rev = o.passes[0].f_mm_rev;
    step.in_cut = in_cut(site, o);
    site.moves.clear();
    site.pecks.reset();
    const auto from = site.at;
    way(site, i);
    if (planning::has_live_centre(site.clamping) && !in_chuck_alone(site, o))
      keep_clear_of_centre(site, o, from);
    const bool tool_stays = i + 1 < operations.size() && changes[i + 1].empty() &&
                            !is_driven(operations[i + 1].kind) &&
                            numbers.tool(site, operations[i + 1]).number == tool.number;
    if (!tool_stays) site.home(tool.orientation != 3);
    step.moves = site.moves;
    step.pecks = site.pecks;
    p.steps.push_back(std::move(step));
  }
  p.minutes = minutes(p, site.part.machine);
  return p;
}

}  // namespace

void refuse_unprogrammed(const planning::PreparedPart& part,
                         planning::ProcessPlan& plan) {
  const auto outwards = [](const planning::SetupPlan& s) {
    return std::any_of(s.operations.begin(), s.operations.end(), [](const auto& o) {
      return o.direction == planning::Direction::from_chuck;
    });
  };
  if (std::any_of(plan.setups.begin(), plan.setups.end(), outwards)) return;
  const auto cannot = programs(part, plan).cannot;
  if (cannot.empty()) return;
  plan.status = planning::PlanStatus::infeasible;
  plan.cost_per_part = plan.time_per_part_min = 0;
  plan.profit_per_min.reset();
  plan.breakdown = {};
  for (auto& s : plan.setups) {
    s.breakdown = {};
    s.edges.clear();
  }
  plan.certificate = {};
  plan.certificate.reason = tr("the plan found cannot be programmed");
  for (const auto& why : cannot)
    plan.conflicts.push_back({to_translate("program"), "", 0, 0, "", why});
}

Programs programs(const planning::PreparedPart& part, const planning::ProcessPlan& plan) {
  Programs all;
  if (plan.status != planning::PlanStatus::ok) return all;
  Numbers numbers(part);
  for (std::size_t s = 0; s < plan.setups.size(); ++s) {
    Site site(part, plan, s);
    if (site.answer().operations.empty()) continue;
    try {
      all.setups.push_back(program(site, numbers));
    } catch (const TooManyMoves&) {
      site.cannot.push_back(say("{}: its program would have more than {} moves",
                                planning::setup_label(s), kMostMoves));
    }
    all.cannot.insert(all.cannot.end(), site.cannot.begin(), site.cannot.end());
  }
  if (!all.cannot.empty()) all.setups.clear();
  return all;
}

}  // namespace turnwright::nc
