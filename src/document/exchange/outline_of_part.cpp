#include <algorithm>
#include <optional>
#include <string>

#include "outline.hpp"
#include "turnwright/exchange/notation.hpp"
#include "turnwright/part/inch_thread.hpp"

namespace turnwright::document {
namespace {

using exchange::Demands;
using exchange::Element;
using exchange::Outline;
using exchange::Shape;
using nlohmann::json;

std::optional<double> number_of(const json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? std::nullopt : std::optional(found->get<double>());
}

std::string text_of(const json& object, const char* key) {
  return object.value(key, std::string());
}

const json& list_of(const json& object, const char* key) {
  static const json kNone = json::array();
  const auto found = object.find(key);
  return found == object.end() ? kNone : *found;
}

std::optional<part::Limits> limits_of(const json& object) {
  const auto& limits = list_of(object, "limits_mm");
  if (limits.empty()) return std::nullopt;
  return part::Limits{limits[0].get<double>(), limits[1].get<double>()};
}

Demands demands_of(const json& object) {
  Demands d{.limits = limits_of(object),
            .Ra_um = number_of(object, "Ra_um"),
            .Rz_um = number_of(object, "Rz_um"),
            .grinding_mm = number_of(object, "grinding_allowance_mm")};
  if (object.contains("fit")) d.fit = text_of(object, "fit");
  return d;
}

Shape shape_of(const std::string& kind) {
  for (const Shape s : {Shape::cylinder, Shape::cone, Shape::arc, Shape::groove,
                        Shape::hole, Shape::as_stock})
    if (kind == shape_name(s)) return s;
  return Shape::thread;
}

// "M24x1.5", or "M24" of the coarse series; "1/2-13 UNC".
void read_designation(const std::string& text, Element& e) {
  if (const auto inch = part::inch_thread(text)) {
    e.left_mm = e.right_mm = inch->d_mm;
    e.pitch_mm = inch->pitch_mm;
    if (!inch->tolerance_class.empty()) e.demands.fit = inch->tolerance_class;
    return;
  }
  const auto x = std::min(text.find('x'), text.size());
  e.left_mm = e.right_mm = std::stod(text.substr(1, x - 1));
  if (x < text.size()) e.pitch_mm = std::stod(text.substr(x + 1));
}

// What stays as the stock is has the size that the stock says.
void read_as_stock(const json& stock, Element& e) {
  const auto kind = text_of(stock, "kind");
  e.flats = kind == "hexagon" ? 6 : kind == "square" ? 4 : 0;
  const char* key = e.flats > 0      ? "across_flats_mm"
                    : kind == "tube" ? "outer_mm"
                                     : "diameter_mm";
  e.left_mm = e.right_mm = *number_of(stock, key);
}

Element element_of(const json& object, const json& stock) {
  Element e{.id = text_of(object, "id"),
            .shape = shape_of(text_of(object, "kind")),
            .length_mm = *number_of(object, "length_mm"),
            .radius_mm = number_of(object, "radius_mm").value_or(0),
            .convex = object.value("bulge", std::string("convex")) == "convex",
            .demands = demands_of(object)};
  if (e.shape == Shape::as_stock) {
    read_as_stock(stock, e);
  } else if (object.contains("designation")) {
    read_designation(text_of(object, "designation"), e);
  } else {
    const auto diameter = number_of(object, "diameter_mm");
    e.left_mm = diameter ? *diameter : *number_of(object, "left_mm");
    e.right_mm = diameter ? *diameter : *number_of(object, "right_mm");
    e.pitch_mm = number_of(object, "pitch_mm").value_or(0);
  }
  if (text_of(object, "from") == "left") e.from = part::End::left;
  if (const auto knurl = part::knurl(text_of(object, "knurl")))
    e.knurl = part::designation(*knurl);
  return e;
}

exchange::Edge edge_of(const json& object) {
  exchange::Edge e{.at = text_of(object, "at"),
                   .chamfer_mm = number_of(object, "chamfer_mm"),
                   .angle_deg = number_of(object, "angle_deg").value_or(45),
                   .radius_mm = number_of(object, "radius_mm"),
                   .fillet_mm = number_of(object, "fillet_mm")};
  if (object.contains("undercut")) e.undercut = text_of(object, "undercut");
  return e;
}

part::Tolerance tolerance_of(const json& object) {
  part::Tolerance t{.id = text_of(object, "id"),
                    .of = text_of(object, "of"),
                    .datum = {},
                    .between = {},
                    .value_mm = number_of(object, "value_mm").value_or(0),
                    .limits = limits_of(object)};
  for (const auto& row : part::tolerance_kinds())
    if (text_of(object, "kind") == row.name) t.kind = row.kind;
  if (const auto datum = object.find("datum"); datum != object.end()) {
    const bool common = datum->is_array();
    (common ? datum->at(0) : *datum).get_to(t.datum);
    if (common) datum->at(1).get_to(t.common_datum);
  }
  if (const auto& between = list_of(object, "between"); !between.empty())
    t.between = {between[0].get<std::string>(), between[1].get<std::string>()};
  return t;
}

// Of flats by their width across, below the rim of the element they are on.
double depth_mm(const json& object, const Outline& o) {
  if (const auto depth = number_of(object, "depth_mm")) return *depth;
  const double across = *number_of(object, "across_flats_mm");
  const auto on = std::ranges::find(o.outer, text_of(object, "on"), &Element::id);
  return on == o.outer.end() ? 0 : (on->left_mm - across) / 2;
}

exchange::Milled cross_hole_of(const json& object) {
  using enum exchange::Milled::Through;
  const auto through = text_of(object, "through");
  return {.id = text_of(object, "id"),
          .kind = exchange::Milled::Kind::cross_hole,
          .on = text_of(object, "on"),
          .z_mm = *number_of(object, "at_mm"),
          .width_mm = *number_of(object, "diameter_mm"),
          .depth_mm = number_of(object, "depth_mm").value_or(0),
          .count = object.value("count", 1),
          .angle_deg = number_of(object, "angle_deg").value_or(0),
          .through = through == "wall"   ? wall
                     : through == "part" ? part
                                         : no,
          .demands = demands_of(object)};
}

exchange::Milled milled_of(const json& object, const Outline& o) {
  using enum exchange::Milled::Kind;
  const auto k = text_of(object, "kind");
  if (k == "cross-hole") return cross_hole_of(object);
  return {.id = text_of(object, "id"),
          .kind = k == "flat"     ? flat
                  : k == "keyway" ? keyway
                                  : slot,
          .on = text_of(object, "on"),
          .z_mm = *number_of(object, "z_mm"),
          .length_mm = *number_of(object, "length_mm"),
          .width_mm = number_of(object, "width_mm").value_or(0),
          .depth_mm = depth_mm(object, o),
          .count = object.value("count", 1),
          .angle_deg = number_of(object, "angle_deg").value_or(0)};
}

}  // namespace

Outline outline_of_part(const json& d) {
  Outline o{.name = text_of(d, "name"),
            .title = {text_of(d, "drawing_number"), text_of(d, "revision"),
                      text_of(d, "customer")},
            .material = "",
            .general = text_of(d, "general"),
            .outer = {},
            .inner = {}};
  if (const auto m = d.find("material"); m != d.end() && m->is_string())
    o.material = m->get<std::string>();
  const json stock = d.value("stock", json::object());
  for (const auto& e : list_of(d, "outer")) o.outer.push_back(element_of(e, stock));
  for (const auto& e : list_of(d, "inner")) o.inner.push_back(element_of(e, stock));
  for (const auto& e : list_of(d, "edges")) o.edges.push_back(edge_of(e));
  for (const auto& f : list_of(d, "faces"))
    o.faces.push_back({.id = text_of(f, "id"), .demands = demands_of(f)});
  for (const auto& t : list_of(d, "tolerances")) o.tolerances.push_back(tolerance_of(t));
  for (const auto& m : list_of(d, "milling")) o.milled.push_back(milled_of(m, o));
  for (const auto& c : list_of(d, "centre_holes"))
    o.centre_holes.push_back(
        {text_of(c, "at") == "left" ? part::End::left : part::End::right,
         text_of(c, "designation")});
  return o;
}

std::string part_notation(const json& document) {
  return exchange::notation(outline_of_part(document));
}

}  // namespace turnwright::document
