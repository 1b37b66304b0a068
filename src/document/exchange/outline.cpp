#include "outline.hpp"

#include <string>
#include <vector>

#include "document/part/datum_json.hpp"

namespace turnwright::document {
namespace {

using exchange::Demands;
using exchange::Element;
using exchange::Outline;
using exchange::Shape;
using nlohmann::ordered_json;

const char* kind(exchange::Milled::Kind k) {
  using enum exchange::Milled::Kind;
  if (k == cross_hole) return "cross-hole";
  return k == flat ? "flat" : k == keyway ? "keyway" : "slot";
}

const char* end_name(part::End end) { return end == part::End::left ? "left" : "right"; }

void add_demands(ordered_json& out, const Demands& d) {
  if (d.fit)
    out["fit"] = *d.fit;
  else if (d.limits)
    out["limits_mm"] = {d.limits->lower_mm, d.limits->upper_mm};
  if (d.Ra_um) out["Ra_um"] = *d.Ra_um;
  if (d.Rz_um) out["Rz_um"] = *d.Rz_um;
  if (d.grinding_mm) out["grinding_allowance_mm"] = *d.grinding_mm;
}

ordered_json element(const Element& e, bool inner) {
  ordered_json out{{"id", e.id}, {"kind", shape_name(e.shape)}};
  if (inner) out["from"] = end_name(e.from);
  out["length_mm"] = e.length_mm;
  if (e.shape == Shape::cone || e.shape == Shape::arc) {
    out["left_mm"] = e.left_mm;
    out["right_mm"] = e.right_mm;
  } else if (e.shape != Shape::as_stock) {
    out["diameter_mm"] = e.left_mm;
  }
  if (e.shape == Shape::arc) {
    out["radius_mm"] = e.radius_mm;
    out["bulge"] = e.convex ? "convex" : "concave";
  }
  if (e.shape == Shape::thread && e.pitch_mm > 0) out["pitch_mm"] = e.pitch_mm;
  if (e.knurl) out["knurl"] = *e.knurl;
  add_demands(out, e.demands);
  return out;
}

ordered_json edge(const exchange::Edge& e) {
  ordered_json out{{"at", e.at}};
  if (e.chamfer_mm) {
    out["chamfer_mm"] = *e.chamfer_mm;
    if (e.angle_deg != 45) out["angle_deg"] = e.angle_deg;
  } else if (e.radius_mm) {
    out["radius_mm"] = *e.radius_mm;
  } else if (e.fillet_mm) {
    out["fillet_mm"] = *e.fillet_mm;
  } else if (e.undercut) {
    out["undercut"] = *e.undercut;
  }
  return out;
}

ordered_json tolerance(const part::Tolerance& t) {
  ordered_json out{{"id", t.id}, {"kind", part::name(t.kind)}};
  if (t.kind == part::ToleranceKind::length)
    out["between"] = {t.between[0], t.between[1]};
  else
    out["of"] = t.of;
  if (!t.datum.empty()) out["datum"] = datum_json(t);
  if (t.limits)
    out["limits_mm"] = {t.limits->lower_mm, t.limits->upper_mm};
  else
    out["value_mm"] = t.value_mm;
  return out;
}

ordered_json milled(const exchange::Milled& m) {
  using Through = exchange::Milled::Through;
  ordered_json out{{"id", m.id}, {"kind", kind(m.kind)}, {"on", m.on}};
  if (m.kind == exchange::Milled::Kind::cross_hole) {
    out["at_mm"] = m.z_mm;
    out["diameter_mm"] = m.width_mm;
    add_demands(out, m.demands);
  } else {
    out["z_mm"] = m.z_mm;
    out["length_mm"] = m.length_mm;
    if (m.kind != exchange::Milled::Kind::flat) out["width_mm"] = m.width_mm;
  }
  if (m.through == Through::no)
    out["depth_mm"] = m.depth_mm;
  else
    out["through"] = m.through == Through::wall ? "wall" : "part";
  if (m.count > 1) out["count"] = m.count;
  if (m.angle_deg != 0) out["angle_deg"] = m.angle_deg;
  return out;
}

template <class List, class Member>
void add_list(ordered_json& out, const char* key, const List& list, Member member) {
  if (list.empty()) return;
  out[key] = ordered_json::array();
  for (const auto& entry : list) out[key].push_back(member(entry));
}

}  // namespace

const char* shape_name(Shape shape) {
  switch (shape) {
    case Shape::cylinder:
      return "cylinder";
    case Shape::cone:
      return "cone";
    case Shape::arc:
      return "arc";
    case Shape::groove:
      return "groove";
    case Shape::hole:
      return "hole";
    case Shape::as_stock:
      return "as-stock";
    case Shape::thread:
      break;
  }
  return "thread";
}

ordered_json part_members(const Outline& o) {
  ordered_json out = ordered_json::object();
  const auto title = [&](const char* key, const std::string& text) {
    if (!text.empty()) out[key] = text;
  };
  title("drawing_number", o.title.drawing_number);
  title("revision", o.title.revision);
  title("customer", o.title.customer);
  add_list(out, "outer", o.outer, [](const Element& e) { return element(e, false); });
  add_list(out, "inner", o.inner, [](const Element& e) { return element(e, true); });
  add_list(out, "edges", o.edges, edge);
  std::vector<ordered_json> faces;
  for (const auto& f : o.faces) {
    ordered_json face{{"id", f.id}};
    add_demands(face, f.demands);
    if (face.size() > 1) faces.push_back(std::move(face));
  }
  add_list(out, "faces", faces, [](const ordered_json& f) { return f; });
  add_list(out, "tolerances", o.tolerances, tolerance);
  add_list(out, "milling", o.milled, milled);
  add_list(out, "centre_holes", o.centre_holes, [](const exchange::CentreHole& c) {
    return ordered_json{{"at", c.at == part::End::left ? "left" : "right"},
                        {"designation", c.designation}};
  });
  return out;
}

}  // namespace turnwright::document
