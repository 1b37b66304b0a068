#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "turnwright/exchange/outline.hpp"

/// The reference parts of parts/, and those of kFeatures, as outlines, for tests that write and read them: elements
/// named as outlines name them.
namespace turnwright::exchange::reference {

using nlohmann::json;

inline std::string fields(const json& j, const char* key) {
  return j.value(key, std::string());
}

inline void read_demands(const json& j, Demands& d) {
  if (j.contains("fit")) d.fit = j["fit"];
  if (j.contains("limits_mm")) d.limits = {j["limits_mm"][0], j["limits_mm"][1]};
  if (j.contains("Ra_um")) d.Ra_um = j["Ra_um"];
  if (j.contains("Rz_um")) d.Rz_um = j["Rz_um"];
}

inline Element element(const json& j) {
  const std::map<std::string, Shape> shapes{{"cylinder", Shape::cylinder},
                                            {"cone", Shape::cone},
                                            {"arc", Shape::arc},
                                            {"groove", Shape::groove},
                                            {"thread", Shape::thread}};
  Element e;
  e.id = j["id"];
  e.shape = shapes.at(j["kind"]);
  e.length_mm = j["length_mm"];
  e.left_mm = j.value("left_mm", j.value("diameter_mm", 0.0));
  e.right_mm = j.value("right_mm", e.left_mm);
  e.radius_mm = j.value("radius_mm", 0.0);
  e.convex = fields(j, "bulge") != "concave";
  if (const auto m = fields(j, "designation"); !m.empty()) {
    e.left_mm = e.right_mm = std::stod(m.substr(1));
    if (m.find('x') != std::string::npos)
      e.pitch_mm = std::stod(m.substr(m.find('x') + 1));
  }
  if (fields(j, "from") == "left") e.from = part::End::left;
  read_demands(j, e.demands);
  return e;
}

/// Gives the elements of a list the names of outlines.
inline void rename(std::vector<Element>& list, char letter,
                   std::map<std::string, std::string>& names) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string id = letter + std::to_string(i + 1);
    names[list[i].id] = id;
    list[i].id = id;
  }
}

inline Outline outline(const json& part) {
  const auto all = [&](const char* key) { return part.value(key, json::array()); };
  Outline o;
  o.name = fields(part, "name");
  o.material = fields(part, "material");
  o.general = fields(part, "general");
  for (const auto& j : all("outer")) o.outer.push_back(element(j));
  for (const auto& j : all("inner")) o.inner.push_back(element(j));
  std::map<std::string, std::string> names{
      {"left", "left"}, {"right", "right"}, {"", ""}};
  rename(o.outer, 'd', names);
  rename(o.inner, 'b', names);
  const auto renamed = [&](const std::string& id) {
    const auto bar = id.find('|');
    return bar == std::string::npos
               ? names.at(id)
               : names.at(id.substr(0, bar)) + '|' + names.at(id.substr(bar + 1));
  };
  for (const auto& j : all("edges")) {
    Edge e{.at = renamed(j["at"])};
    if (j.contains("chamfer_mm")) e.chamfer_mm = j["chamfer_mm"];
    if (j.contains("radius_mm")) e.radius_mm = j["radius_mm"];
    if (j.contains("fillet_mm")) e.fillet_mm = j["fillet_mm"];
    if (j.contains("undercut")) e.undercut = j["undercut"];
    e.angle_deg = j.value("angle_deg", 45.0);
    o.edges.push_back(e);
  }
  for (const auto& j : all("faces")) {
    o.faces.push_back({.id = renamed(j["id"])});
    read_demands(j, o.faces.back().demands);
  }
  for (const auto& j : all("tolerances")) {
    part::Tolerance t;
    t.id = j["id"];
    for (const auto& row : part::tolerance_kinds())
      if (j["kind"] == row.name) t.kind = row.kind;
    t.of = renamed(fields(j, "of"));
    t.datum = renamed(fields(j, "datum"));
    if (j.contains("between"))
      t.between = {renamed(j["between"][0]), renamed(j["between"][1])};
    if (j.contains("limits_mm")) t.limits = {j["limits_mm"][0], j["limits_mm"][1]};
    t.value_mm =
        t.limits ? t.limits->upper_mm - t.limits->lower_mm : double(j["value_mm"]);
    o.tolerances.push_back(t);
  }
  for (const auto& j : all("milling")) {
    Milled m{.id = "m" + std::to_string(o.milled.size() + 1), .on = renamed(j["on"])};
    const auto kind = fields(j, "kind"), through = fields(j, "through");
    const bool hole = kind == "cross-hole";
    m.kind = hole             ? Milled::Kind::cross_hole
             : kind == "flat" ? Milled::Kind::flat
             : kind == "slot" ? Milled::Kind::slot
                              : Milled::Kind::keyway;
    m.z_mm = j[hole ? "at_mm" : "z_mm"];
    m.length_mm = j.value("length_mm", 0.0);
    m.width_mm = j.value(hole ? "diameter_mm" : "width_mm", 0.0);
    m.depth_mm = j.value("depth_mm", 0.0);
    m.through = through == "wall"   ? Milled::Through::wall
                : through == "part" ? Milled::Through::part
                                    : Milled::Through::no;
    m.angle_deg = j.value("angle_deg", 0.0);
    o.milled.push_back(m);
  }
  for (const auto& j : all("centre_holes"))
    o.centre_holes.push_back({j["at"] == "left" ? part::End::left : part::End::right,
                              "ISO 6411-" + fields(j, "designation")});
  return o;
}

/// All parts of a folder of the project by their files' names.
inline std::map<std::string, Outline> outlines(const std::string& folder = "parts") {
  std::map<std::string, Outline> out;
  for (const auto& file :
       std::filesystem::directory_iterator(TURNWRIGHT_SOURCE_DIR "/" + folder))
    if (file.path().extension() == ".json")
      out[file.path().stem().string()] = outline(json::parse(std::ifstream(file.path())));
  return out;
}
/// Parts with what standards describe: centre holes, undercuts behind threads.
inline constexpr const char* kFeatures = "tests/data/step/features";

}  // namespace turnwright::exchange::reference
