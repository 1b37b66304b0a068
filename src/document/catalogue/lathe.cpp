#include <cmath>
#include <numbers>

#include "base/say.hpp"
#include "catalogue_readers.hpp"
#include "document/json/fields.hpp"
#include "machine_fields.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::document {
namespace {

const Bounds kSpeed = above_up_to(0, 1e5, "1/min");
const Bounds kForce = above_up_to(0, 1e6, "N");
const Bounds kCompliance = within(0, 0.1, "mm/N");

// Power and torque of one point are one quantity; makers round to about 1 %.
constexpr double kPowerAgrees = 0.03;

catalogue::CurvePoint read_point(Reader r) {
  r = r.as_object();
  const catalogue::CurvePoint p{.n_rpm = r.number("n_rpm", kSpeed),
                                .P_kW = r.number("P_kW", above_up_to(0, 1e4, "kW")),
                                .M_Nm = r.number("M_Nm", above_up_to(0, 1e6, "Nm"))};
  r.finish();
  const double P_kW = units::shaft_power_kW(p.M_Nm, p.n_rpm);
  if (std::abs(P_kW - p.P_kW) > kPowerAgrees * p.P_kW)
    r.problem_at("P_kW",
                 say("the power of M_Nm at n_rpm, {} kW, within 3 %", number_text(P_kW)),
                 "conflict");
  return p;
}

template <class Drive>
void read_curve(Reader& group, Drive& d) {
  const auto points = group.items("curve", 2, 50);
  for (const auto& point : points) {
    d.curve.push_back(read_point(point));
    const auto n = d.curve.size();
    if (n > 1 && d.curve[n - 1].n_rpm <= d.curve[n - 2].n_rpm)
      point.problem(tr("a speed above the point's before"), "order");
  }
  if (d.curve.empty()) return;
  if (d.curve.front().n_rpm > d.n_min_rpm || d.curve.back().n_rpm < d.n_max_rpm)
    group.problem_at("curve", tr("points from n_min_rpm or below to n_max_rpm or above"),
                     "conflict");
}

// The main spindle, or the one of the driven tools.
template <class Drive>
void read_drive(Reader& group, Drive& d) {
  d.n_min_rpm = group.number("n_min_rpm", kSpeed);
  d.n_max_rpm = group.number("n_max_rpm", kSpeed);
  if (d.n_min_rpm >= d.n_max_rpm)
    group.problem_at("n_min_rpm", tr("a speed below n_max_rpm"), "order");
  d.efficiency = group.number("efficiency", above_up_to(0, 1));
  read_curve(group, d);
}

void read_spindle(Reader group, catalogue::Lathe& m) {
  read_drive(group, m);
  finish_group(group);
}

catalogue::DrivenTools read_driven_tools(Reader group) {
  catalogue::DrivenTools d;
  read_drive(group, d);
  d.feed_max_mm_min = group.number("feed_max_mm_min", above_up_to(0, 1e6, "mm/min"));
  d.c_axis = group.boolean_or("c_axis", d.c_axis);
  d.y_max_mm = group.number_or("y_max_mm", within(0, 1000, "mm"), d.y_max_mm);
  if (d.y_max_mm > 0 && !d.c_axis)
    group.problem_at("y_max_mm", tr("0: without c_axis nothing turns the part"),
                     "choice");
  for (Reader item : group.optional_items("measured", 0, 200)) {
    item = item.as_object();
    const auto cutter = read_id(item, "cutter");
    if (!cutter.empty() && d.modes.count(cutter))
      item.problem_at("cutter", tr("each cutter once"), "duplicate");
    d.modes[cutter] = read_tip_modes(item);
    item.finish();
  }
  finish_group(group);
  return d;
}

void read_times(Reader group, catalogue::Lathe& m) {
  const auto time = within(0, 1e4, "min");
  m.index_min = group.number("index_min", time);
  m.load_min = group.number("load_min", time);
  m.tailstock_min = group.number("tailstock_min", time);
  m.centres_min = group.number("centres_min", time);
  m.setup_min = group.number("setup_min", time);
  m.jaws_min = group.number_or("jaws_min", time, catalogue::kJaws_min);
  if (m.has("chuck-steady") || group.has("steady_min"))
    m.steady_min = group.number("steady_min", time);
  if (m.has("tailstock-follow") || group.has("follow_min"))
    m.follow_min = group.number("follow_min", time);
  finish_group(group);
}

void read_chuck(Reader group, catalogue::Chuck& c) {
  c.grip_force_N = group.number("grip_force_N", above_up_to(0, 1e7, "N"));
  c.jaw_mass_radius_kg_m = group.number("jaw_mass_radius_kg_m", within(0, 1000, "kg m"));
  c.friction = group.number("friction", above_up_to(0, 1));
  c.n_max_rpm = group.number("n_max_rpm", kSpeed);
  c.diameter_mm = read_range(group, "diameter_mm", above_up_to(0, 20000, "mm"));
  finish_group(group);
}

catalogue::CentreCompliance read_centre(Reader r) {
  const catalogue::CentreCompliance c{
      .radial_mm_N = r.number("radial_mm_N", kCompliance),
      .tangential_mm_N = r.number("tangential_mm_N", kCompliance)};
  r.finish();
  return c;
}

void read_stiffness(Reader group, catalogue::Lathe& m) {
  m.chuck.radial = read_compliance(group.object("chuck_radial"));
  m.chuck.tangential = read_compliance(group.object("chuck_tangential"));
  m.chuck.axial_mm_N = group.number("chuck_axial_mm_N", kCompliance);
  m.tail_centre = read_centre(group.object("tail_centre"));
  m.head_centre = read_centre(group.object("head_centre"));
  if (m.has("chuck-steady") || group.has("steady_rest"))
    m.steady_rest = read_centre(group.object("steady_rest"));
  if (m.has("tailstock-follow") || group.has("follow_rest"))
    m.follow_rest = read_centre(group.object("follow_rest"));
  m.tail_thrust_N =
      group.optional_number("tail_thrust_N", within(0, 1e6, "N")).value_or(0);
  m.tool_rr_mm_N = group.number("tool_rr_mm_N", kCompliance);
  m.tool_rt_mm_N = group.number("tool_rt_mm_N", within(-0.1, 0.1, "mm/N"));
  m.tool_zz_mm_N = group.optional_number("tool_zz_mm_N", kCompliance);
  m.damping_ratio = group.optional_number("damping_ratio", kDamping);
  m.stiffness_uncertainty_pct = finish_group(group);
}

void read_live_centre(Reader group, catalogue::LiveCentre& c) {
  const auto length = above_up_to(0, 1000, "mm");
  c.point_mm = group.number("point_mm", length);
  c.point_length_mm = group.number("point_length_mm", length);
  c.body_mm = group.number("body_mm", length);
  if (c.point_mm > 0 && c.point_length_mm < c.point_mm / 2 * std::numbers::sqrt3)
    group.problem_at("point_length_mm",
                     say("at least the length of the cone of 60 deg, {} mm",
                         number_text(c.point_mm / 2 * std::numbers::sqrt3)),
                     "conflict");
  if (c.body_mm < c.point_mm)
    group.problem_at("body_mm", tr("at least point_mm"), "conflict");
  finish_group(group);
}

void read_shop_budget(Reader group, catalogue::ShopBudget& b) {
  const auto error = within(0, 1000, "um");
  b.rechucking = read_rechucking_by_jaws(group.at("rechucking_um", tr("an object")));
  b.drift_um = group.number("drift_um", error);
  b.drift_axial_um = group.number("drift_axial_um", error);
  b.repeatability_um = group.number("repeatability_um", error);
  b.part_warm_K = group.number("part_warm_K", within(0, 200, "K"));
  b.life_between_offsets = group.number("life_between_offsets", within(0, 1));
  finish_group(group);
}

// The machine's own geometry, with the keys of `geometry`; a chain with problems is
// omitted.
void read_geometry(Reader group, catalogue::Lathe& m) {
  const auto problems = group.problems().list.size();
  std::vector<catalogue::Axis> fitted;
  catalogue::GeometricErrors g{.chain = read_chain(group, &fitted)};
  const Bounds place = within(-1e6, 1e6, "mm");
  if (group.has("tool_point_mm"))
    g.chain.tool_point_mm = read_vec3(group, "tool_point_mm", place);
  g.jaws_z_mm = group.number_or("jaws_z_mm", place, 0);
  g.u = read_uncertainties(group, g.chain, fitted);
  g.relative_u = group.number_or("uncertainty_pct", within(0, 100, "%"), 0) / 100;
  group.optional_text("source", 1000);
  group.optional_text("note", 2000);
  const auto has = [&](char axis) {
    return g.chain.chain.find(axis) != std::string::npos;
  };
  if (volumetric::chain_fault(g.chain.chain).empty() &&
      !(has('X') && has('Z') && has('C')))
    group.problem_at("chain", tr("a lathe's chain, with X, Z and C, such as wCfZXt"),
                     "conflict");
  group.finish();
  if (group.problems().list.size() == problems) m.errors = std::move(g);
}

}  // namespace

catalogue::Lathe read_lathe(Reader r) {
  catalogue::Lathe m;
  r = r.as_object();
  read_required_format(r, "turnwright-lathe/1");
  m.id = read_id(r);
  m.name = r.text("name");
  m.clampings = read_set<std::string>(r, "clampings",
                                      {{"chuck", "chuck"},
                                       {"chuck-tailstock", "chuck-tailstock"},
                                       {"between-centres", "between-centres"},
                                       {"chuck-steady", "chuck-steady"},
                                       {"tailstock-follow", "tailstock-follow"}});
  read_spindle(r.object("spindle"), m);
  Reader feed = r.object("feed");
  m.feed_force_max_N = feed.number("feed_force_max_N", kForce);
  m.rapid_mm_min = feed.number("rapid_mm_min", above_up_to(0, 1e6, "mm/min"));
  finish_group(feed);
  read_times(r.object("times"), m);
  Reader rate = r.object("rate");
  m.cost_per_min = rate.number("cost_per_min", within(1e-6, 1e4));
  m.currency = read_currency(rate);
  finish_group(rate);
  Reader room = r.object("room");
  m.swing_mm = room.number("swing_mm", above_up_to(0, 20000, "mm"));
  m.between_centres_mm = room.number("between_centres_mm", above_up_to(0, 20000, "mm"));
  if (const auto n = room.optional_integer("stations", 1, 1000))
    m.stations = static_cast<int>(*n);
  finish_group(room);
  read_chuck(r.object("chuck"), m.chuck);
  read_stiffness(r.object("stiffness"), m);
  if (auto driven = r.optional_object("driven_tools"))
    m.driven_tools = read_driven_tools(*driven);
  if (auto centre = r.optional_object("live_centre"))
    read_live_centre(*centre, m.live_centre);
  if (auto budget = r.optional_object("budget")) read_shop_budget(*budget, m.budget);
  if (auto errors = r.optional_object("errors")) read_geometry(*errors, m);
  r.finish();
  return m;
}

}  // namespace turnwright::document
