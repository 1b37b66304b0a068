#include "turnwright/document/drawing.hpp"

#include "document/json/finite.hpp"
#include "document/part/datum_json.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "planning/clamping/positions.hpp"
#include "title_block.hpp"
#include "turnwright/document/process_plan.hpp"

namespace turnwright::document {
namespace {

using nlohmann::ordered_json;
using planning::Clamping;
using planning::PreparedPart;

void add_setup(ordered_json& surface, const PreparedPart& part, const std::string& id) {
  if (const auto setup = planning::setup_of(part, id)) surface["setup"] = *setup;
}

ordered_json pair(const part::Limits& limits) {
  return {limits.lower_mm, limits.upper_mm};
}

template <class Surface>
void add_roughness(ordered_json& out, const Surface& surface) {
  if (surface.Ra_um) out["Ra_um"] = *surface.Ra_um;
  if (surface.Rz_um) out["Rz_um"] = *surface.Rz_um;
}

const char* kind(part::CutKind cut) {
  switch (cut) {
    case part::CutKind::groove:
      return "groove";
    case part::CutKind::thread:
      return "thread";
    case part::CutKind::hole:
      return "hole";
    case part::CutKind::knurl:
      return "cylinder";
    case part::CutKind::arc:
      break;
  }
  return "arc";
}

template <class Element>
void add_edges(ordered_json& out, const Element& e) {
  double raised = 0;  // above the chamfer that is turned
  if constexpr (requires { part::raised_mm(e); }) raised = part::raised_mm(e);
  const auto chamfer = [&](const char* key, const std::optional<part::Chamfer>& c) {
    if (c && !c->round)
      out[key] = {c->axial_mm + raised * c->axial_mm / c->radial_mm,
                  c->radial_mm + raised};
  };
  chamfer("left_chamfer_mm", e.left_chamfer);
  chamfer("right_chamfer_mm", e.right_chamfer);
  const auto radius = [&](const char* key, const std::optional<part::Chamfer>& c) {
    if (c && c->round) out[key] = c->axial_mm;
  };
  radius("left_radius_mm", e.left_chamfer);
  radius("right_radius_mm", e.right_chamfer);
  if (e.left_fillet_mm) out["left_fillet_mm"] = *e.left_fillet_mm;
  if (e.right_fillet_mm) out["right_fillet_mm"] = *e.right_fillet_mm;
  if constexpr (requires { e.left_undercut; }) {
    const auto undercut = [&](const char* key, const std::optional<part::Undercut>& u) {
      if (u) out[key] = part::designation(*u);
    };
    undercut("left_undercut", e.left_undercut);
    undercut("right_undercut", e.right_undercut);
  }
}

template <class Element>
ordered_json json_of(const Element& e, const char* side, double z_mm,
                     const PreparedPart& part) {
  const bool cylinder = e.kind == part::ElementKind::cylinder;
  const part::Ends ends = e.cut ? e.cut->drawn : part::Ends{e.left_mm, e.right_mm};
  ordered_json out{{"id", e.id},
                   {"side", side},
                   {"kind", part::stays(e) ? "as-stock"
                            : e.cut        ? kind(e.cut->kind)
                            : cylinder     ? "cylinder"
                                           : "cone"},
                   {"z_mm", {z_mm, z_mm + e.length_mm}},
                   {"diameters_mm", {ends.left_mm, ends.right_mm}}};
  if (e.cut && e.cut->kind == part::CutKind::thread) out["pitch_mm"] = e.cut->pitch_mm;
  if (e.cut && e.cut->kind == part::CutKind::knurl) {
    out["knurl"] = part::designation(part::Knurl{e.cut->knurl, e.cut->pitch_mm});
    out["blank_mm"] = e.left_mm;
  }
  if (e.cut && e.cut->kind == part::CutKind::arc) {
    out["radius_mm"] = e.cut->radius_mm;
    out["convex"] = e.cut->convex;
  }
  if (e.fit) out["fit"] = *e.fit;
  if (e.limits && !e.cut) out["limits_mm"] = pair(*e.limits);
  add_roughness(out, e);
  add_edges(out, e);
  add_setup(out, part, e.id);
  return out;
}

ordered_json elements(const PreparedPart& part) {
  const auto& d = part.drawing;
  auto all = ordered_json::array();
  for (std::size_t i = 0; i < d.outer.size(); ++i)
    all.push_back(json_of(d.outer[i], "outer", part::left_z_mm(d, i), part));
  for (std::size_t i = 0; i < d.inner.size(); ++i)
    all.push_back(json_of(d.inner[i], "inner", part::inner_left_z_mm(d, i), part));
  return all;
}

ordered_json faces(const PreparedPart& part) {
  const auto& d = part.drawing;
  std::vector<std::string> ids{"left"};
  for (std::size_t k = 1; k < d.outer.size(); ++k)
    ids.push_back(planning::shoulder_id(d, k));
  ids.push_back("right");
  for (const auto& s : part::inner_shoulders(d)) ids.push_back(s.id);
  auto all = ordered_json::array();
  for (const auto& id : ids) {
    ordered_json face{{"id", id}, {"z_mm", planning::face_z_mm(d, id)}};
    for (const auto& drawn : d.faces)
      if (drawn.id == id) add_roughness(face, drawn);
    if (id == "left" || id == "right")
      if (const auto& c =
              part::centre_at(d, id == "left" ? part::End::left : part::End::right))
        face["centre_hole"] = part::designation(*c);
    add_setup(face, part, id);
    all.push_back(std::move(face));
  }
  return all;
}

ordered_json json_of(const part::Tolerance& t) {
  ordered_json out{{"id", t.id}, {"kind", part::name(t.kind)}};
  if (!t.of.empty()) out["of"] = t.of;
  if (!t.datum.empty()) out["datum"] = datum_json(t);
  if (t.of.empty()) out["between"] = t.between;
  out["value_mm"] = t.value_mm;
  if (t.limits) out["limits_mm"] = pair(*t.limits);
  return out;
}

ordered_json json_of(const PreparedPart& plan, std::size_t s) {
  const auto& setup = plan.setups[s];
  auto clampings = ordered_json::array();
  for (const auto clamping : setup.clampings) clampings.push_back(name(clamping));
  ordered_json out{{"hold", setup.hold == part::End::left ? "left" : "right"},
                   {"grip_mm", plan.grips_mm[s]},
                   {"jaws_z_mm", planning::root_z_mm(plan, s, Clamping::chuck)}};
  if (std::ranges::find(setup.clampings, Clamping::chuck_steady) != setup.clampings.end())
    out["steady_z_mm"] = setup.steady_z_mm;
  out["clampings"] = std::move(clampings);
  return out;
}

}  // namespace

ordered_json drawing(const PreparedDocument& prepared) {
  const auto& part = prepared.part;
  const auto& d = part.drawing;
  auto out = title_block(d);
  out["length_mm"] = part::length_mm(d);
  out["stock"] = {
      {"z_mm",
       {-d.stock.left_allowance_mm, d.stock.length_mm - d.stock.left_allowance_mm}},
      {"outer_mm", d.stock.outer_mm},
      {"inner_mm", d.stock.inner_mm}};
  if (const int n = part::flats(d.stock.kind); n > 0) {
    out["stock"]["flats"] = n;
    out["stock"]["across_flats_mm"] = part::across_mm(d.stock);
  }
  for (const auto& piece : d.stock.outline)
    out["stock"]["outline"].push_back({{"length_mm", piece.length_mm},
                                       {"left_mm", piece.left_mm},
                                       {"right_mm", piece.right_mm}});
  out["elements"] = elements(part);
  out["faces"] = faces(part);
  out["tolerances"] = ordered_json::array();
  for (const auto& tolerance : d.tolerances)
    out["tolerances"].push_back(json_of(tolerance));
  out["setups"] = ordered_json::array();
  for (std::size_t s = 0; s < part.setups.size(); ++s)
    out["setups"].push_back(json_of(part, s));
  out["unreachable"] = part.work.unreachable;
  out["assumed"] = to_json(prepared.assumed);
  require_finite(out, "drawing");
  return out;
}

}  // namespace turnwright::document
