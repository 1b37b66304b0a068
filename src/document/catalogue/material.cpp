#include "catalogue_readers.hpp"
#include "document/json/fields.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::document {
namespace {

const Bounds kCuttingSpeed = above_up_to(0, 5000, "m/min");

void read_elastic(Reader group, catalogue::Material& m) {
  m.E_MPa = group.number("E_MPa", within(1000, 1e6, "MPa"));
  m.nu = group.number("nu", at_least_below(0, 0.5));
  m.rho_kg_m3 = group.number("rho_kg_m3", within(100, 25000, "kg/m3"));
  m.expansion_1_K = group.number("expansion_1_K", within(0, 1e-4, "1/K"));
  finish_group(group);
}

void read_kienzle(Reader group, catalogue::Material& m) {
  m.kc.k11_MPa = group.number("kc11_MPa", within(50, 10000, "MPa"));
  m.kc.m = group.number("mc", at_least_below(0, 1));
  m.gamma0_deg = group.number("rake_deg", within(-30, 45, "deg"));
  read_range(group, "h_mm", above_up_to(0, 10, "mm"));
  read_range(group, "vc_m_min", kCuttingSpeed);
  Bounds kapr = above_up_to(0, 180, "deg");
  kapr.upper_open = true;
  group.number("kapr_deg", kapr);
  m.kc_uncertainty_pct = finish_group(group);
}

void read_feed_passive(Reader group, catalogue::Material& m) {
  const auto force = within(5, 10000, "MPa");
  const auto exponent = at_least_below(0, 1);
  m.kf = {.k11_MPa = group.number("kf11_MPa", force), .m = group.number("mf", exponent)};
  m.kp = {.k11_MPa = group.number("kp11_MPa", force), .m = group.number("mp", exponent)};
  m.feed_passive_uncertainty_pct = finish_group(group);
}

void read_thrust(Reader group, catalogue::Material& m) {
  catalogue::Thrust t;
  t.ratio = group.number("ratio", within(0, 3));
  t.edge_N_mm = group.number("edge_N_mm", within(0, 1000, "N/mm"));
  t.land_MPa = group.number_or("land_MPa", above_up_to(0, 10000, "MPa"), 0);
  t.total_uncertainty_pct =
      group.optional_number("total_uncertainty_pct", within(0, 100, "%"));
  if (t.ratio == 0 && t.edge_N_mm == 0)
    group.problem_at("ratio", tr("ratio or edge_N_mm above 0"), "0");
  t.uncertainty_pct = finish_group(group);
  m.thrust = t;
}

void read_taylor(Reader group, catalogue::Material& m) {
  m.taylor.C = group.number("C", above_up_to(0, 1e5, "m/min"));
  m.taylor.n = group.number("n", above_up_to(0, 1));
  m.taylor.a = group.number("a", within(0, 2));
  m.taylor.b = group.number("b", within(0, 2));
  m.taylor.b_shallow = group.optional_number("b_shallow", within(0, 2));
  m.life_scatter_pct = group.number_or("scatter_pct", within(0, 300, "%"), 0);
  group.text("tool");
  read_range(group, "vc_m_min", kCuttingSpeed);
  read_range(group, "f_mm_rev", above_up_to(0, 5, "mm/rev"));
  read_range(group, "ap_mm", above_up_to(0, 50, "mm"));
  m.taylor_uncertainty_pct = finish_group(group);
}

}  // namespace

catalogue::Material read_material(Reader r) {
  catalogue::Material m;
  r = r.as_object();
  read_required_format(r, "turnwright-material/1");
  m.id = read_id(r);
  m.name = r.text("name");
  for (const auto& synonym : r.optional_items("synonyms", 0, 30))
    m.synonyms.push_back(synonym.as_text());
  m.standard = r.text("standard");
  m.condition = r.text("condition");
  m.group = r.choice("group", iso_groups());
  Reader hardness = r.object("hardness");
  m.hardness_HB = hardness.number("hardness_HB", above_up_to(0, 800, "HB"));
  finish_group(hardness);
  if (auto strength = r.optional_object("strength")) {
    m.yield_MPa = strength->number("yield_MPa", above_up_to(0, 5000, "MPa"));
    finish_group(*strength);
  }
  read_elastic(r.object("elastic"), m);
  read_kienzle(r.object("kienzle"), m);
  if (const auto group = r.optional_object("thrust")) read_thrust(*group, m);
  if (const auto group = r.optional_object("feed_passive")) read_feed_passive(*group, m);
  read_taylor(r.object("taylor"), m);
  if (auto chip = r.optional_object("chip")) {
    m.hmin_mm = chip->number("hmin_mm", within(0, 1, "mm"));
    m.hmin_edge_um = chip->number_or("edge_um", kEdgeRadius, 0);
    m.hmin_uncertainty_pct = finish_group(*chip);
  }
  if (auto worn = r.optional_object("worn_roughness")) {
    m.land_Ra_um_mm = worn->number("land_Ra_um_mm", above_up_to(0, 50, "um/mm"));
    m.land_Ra_uncertainty_pct = finish_group(*worn);
  }
  r.finish();
  return m;
}

}  // namespace turnwright::document
