#pragma once
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "document/json/file.hpp"
#include "turnwright/document/catalogue.hpp"
#include "turnwright/document/prepared_part.hpp"
#include "turnwright/planning/prepare.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::planning {

inline const document::Catalogue& shop() {
  static const auto all = document::load_catalogue(TURNWRIGHT_SOURCE_DIR);
  return all;
}
inline PreparedPart part(const nlohmann::json& document) {
  return document::prepared_part(document, shop(), "part").part;
}
/// A request whose fixed tools have nothing to choose.
inline PlanRequest without_windows(PlanRequest request) {
  for (auto& t : request.fixed_tools)
    for (auto& c : t.conditions) c.window.reset();
  return request;
}
/// One drill of one size, which no other replaces.
inline PlanRequest with_one_drill(PlanRequest request) {
  std::erase_if(request.fixed_tools, [](const catalogue::FixedTool& t) {
    return t.use == catalogue::FixedUse::drilling && t.id != "DRILL-HM-5D";
  });
  for (auto& t : request.fixed_tools)
    if (t.id == "DRILL-HM-5D") t.sizes_mm = {19};
  return request;
}
inline nlohmann::json file(const std::string& name) {
  return document::parse_file(TURNWRIGHT_SOURCE_DIR "/" + name);
}

inline nlohmann::json reference_part(const std::string& name) {
  return file("parts/" + name + ".json");
}

/// The bush whose through bore no drill leaves as it is drawn: it is drilled and bored.
inline nlohmann::json bored_bush() {
  auto d = reference_part("drilled-bush");
  d["inner"][2]["diameter_mm"] = 20.2;
  return d;
}

/// No errors of the shop, sizes programmed at the middle of their limits.
inline nlohmann::json no_shop_errors() {
  return {{"drift_um", 0},
          {"drift_axial_um", 0},
          {"repeatability_um", 0},
          {"part_warm_K", 0},
          {"rechucking_um", 0},
          {"life_between_offsets", 0},
          {"first_part_gauged", false}};
}

/// A part of parts/, likewise.
inline nlohmann::json nominal(nlohmann::json document) {
  document["budget"] = no_shop_errors();
  document["robust"] = false;
  return document;
}

/// A short pin of two cylinders, turned round once in the chuck, planned nominally.
inline nlohmann::json pin() {
  return {{"format", "turnwright-part/1"},
          {"name", "Pin"},
          {"material", "C45"},
          {"stock", {{"kind", "bar"}, {"diameter_mm", 42}, {"length_mm", 92}}},
          {"outer",
           {{{"id", "d1"}, {"kind", "cylinder"}, {"length_mm", 40}, {"diameter_mm", 40}},
            {{"id", "d2"},
             {"kind", "cylinder"},
             {"length_mm", 50},
             {"diameter_mm", 32},
             {"Ra_um", 3.2}}}},
          {"machine", "lathe-medium"},
          {"tools", {"PCLNL-CNMG120408-PM", "PDJNL-DNMG150604-PF"}},
          {"setups",
           {{{"hold", "left"}, {"grip_mm", 30}, {"clampings", {"chuck"}}},
            {{"hold", "right"}, {"grip_mm", 40}, {"clampings", {"chuck"}}}}},
          {"operations", "auto"},
          {"objective", "cost"},
          {"batch", 10},
          {"rates", {{"machine_per_min", 1.0}, {"price", 30}}},
          {"machine_share_um", 1},
          {"budget", no_shop_errors()},
          {"robust", false}};
}

/// A plan's own conditions, given back whole.
inline nlohmann::json as_planned(nlohmann::json d, const ProcessPlan& r) {
  d["operations"] = nlohmann::json::array();
  for (std::size_t s = 0; s < r.setups.size(); ++s) {
    d["setups"][s]["clampings"] = {name(r.setups[s].clamping)};
    for (const auto& o : r.setups[s].operations)
      d["operations"].push_back({{"id", o.id},
                                 {"setup", s},
                                 {"kind", name(o.kind)},
                                 {"on", o.on},
                                 {"tool", o.tool},
                                 {"direction", name(o.direction)},
                                 {"conditions",
                                  {{"passes", o.passes.size()},
                                   {"ap_mm", o.passes[0].ap_mm},
                                   {"f_mm_rev", o.passes[0].f_mm_rev},
                                   {"vc_m_min", o.passes[0].vc_m_min}}}});
  }
  return d;
}

inline PreparedPart part_to_predict(const nlohmann::json& document) {
  return document::prepared_part(document, shop(), "part", document::Purpose::predict)
      .part;
}

/// An operation of a plan by its id.
inline const OperationPlan& operation(const ProcessPlan& p, const std::string& id) {
  for (const auto& s : p.setups)
    for (const auto& o : s.operations)
      if (o.id == id) return o;
  throw std::out_of_range(id);
}

/// A tolerance of a plan by its id.
inline const ToleranceResult& tolerance(const ProcessPlan& p, const std::string& id) {
  for (const auto& t : p.tolerances)
    if (t.id == id) return t;
  throw std::out_of_range(id);
}

}  // namespace turnwright::planning
