#include "turnwright/catalogue/milling_cutter.hpp"

#include "catalogue_readers.hpp"
#include "document/json/fields.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::document {
namespace {

using catalogue::MillingCutter;

const Bounds kLength = above_up_to(0, 500, "mm");

void read_cutter_geometry(Reader group, MillingCutter& c) {
  c.dc_mm = group.number("dc_mm", kLength);
  c.teeth = static_cast<int>(group.integer("zefp", 1, 20));
  c.re_mm = group.number("re_mm", within(0, 250, "mm"));
  if (c.re_mm > c.dc_mm / 2)
    group.problem_at("re_mm", tr("a corner radius of at most half of dc_mm"), "conflict");
  c.lu_mm = group.number("lu_mm", kLength);
  c.gamma_deg = group.number("gamma_deg", within(-30, 45, "deg"));
  c.centre_cutting = group.boolean("centre_cutting");
  c.ap_mm = read_range(group, "ap_mm", kLength);
  if (c.ap_mm.upper > c.lu_mm)
    group.problem_at("ap_mm", tr("depths up to lu_mm at most"), "conflict");
  finish_group(group);
}

catalogue::MillingConditions read_conditions(Reader r) {
  r = r.as_object();
  catalogue::MillingConditions c;
  c.groups = read_set(r, "groups", iso_groups());
  c.vc_m_min = read_range(r, "vc_m_min", above_up_to(0, 5000, "m/min"));
  c.hex_mm = read_range(r, "hex_mm", above_up_to(0, 5, "mm"));
  Reader life = r.object("life");
  c.T0_min = life.number("T_min", above_up_to(0, 1e5, "min"));
  c.v0_m_min = life.number("at_vc_m_min", above_up_to(0, 5000, "m/min"));
  c.n = life.number("n", within(0.05, 0.9));
  life.finish();
  r.finish();
  return c;
}

}  // namespace

MillingCutter read_milling_cutter(Reader r) {
  MillingCutter c;
  r = r.as_object();
  read_required_format(r, "turnwright-milling-cutter/1");
  c.id = read_id(r);
  c.name = r.text("name");
  read_cutter_geometry(r.object("geometry"), c);
  for (const auto& item : r.items("conditions", 1, 6))
    c.conditions.push_back(read_conditions(item));
  Reader strength = r.object("strength");
  c.Fc_max_N = strength.number("Fc_max_N", above_up_to(0, 1e6, "N"));
  finish_group(strength);
  Reader tip = r.object("tool_point");
  c.modes = read_tip_modes(tip);
  finish_group(tip);
  Reader economics = r.object("economics");
  c.change_min = economics.number("change_min", within(0, 1000, "min"));
  c.edge_cost = economics.number("edge_cost", within(0, 1e5));
  finish_group(economics);
  finish_group(r);
  return c;
}

}  // namespace turnwright::document
