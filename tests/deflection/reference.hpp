#pragma once
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "turnwright/deflection/response.hpp"

/// tests/data/deflection_reference.json: four shafts, 34-digit values rounded once.
namespace turnwright::deflection::reference {

struct Case {
  std::string name;
  part::Shaft shaft;
  Clamping clamping;
  std::vector<double> a_mm;
  nlohmann::json values;  ///< "f_ww_r", "delta_r", ... by position
};

inline Supports supports(const nlohmann::json& k, const std::string& clamp,
                         const std::string& plane) {
  Supports s;
  s.method = clamp == "chuck"     ? Method::chuck
             : clamp == "centres" ? Method::between_centres
                                  : Method::chuck_tailstock;
  if (k.at("rigid").get<bool>()) return s;
  const double k1 = k.at("k1" + plane), k2 = k.at("k2" + plane), k3 = k.at("k3" + plane),
               Lc = k.at("Lc");
  s.root = {1 / k1 + Lc * Lc / k2, Lc / k2, 1 / k2 + 1 / k3};
  s.head_mm_N = 1 / k.at("kh" + plane).get<double>();
  s.tail_mm_N = 1 / k.at("kt" + plane).get<double>();
  return s;
}

inline std::vector<Case> cases() {
  const auto file = nlohmann::json::parse(
      std::ifstream(TURNWRIGHT_SOURCE_DIR "/tests/data/deflection_reference.json"));
  std::vector<Case> all;
  for (const auto& c : file.at("cases")) {
    const auto& shafts = file.at("shafts");
    const auto s = std::find_if(shafts.begin(), shafts.end(), [&](const auto& x) {
      return x.at("id") == c.at("shaft");
    });
    part::Shaft shaft{s->at("E"), s->at("nu"), {}};
    for (const auto& g : s->at("segments"))
      shaft.segments.push_back(
          {g.at("len"), g.at("de0"), g.at("de1"), g.at("di0"), g.at("di1")});
    const std::string clamp = c.at("clamp"), support = c.at("support");
    const auto& k = file.at("supports").at(support);
    all.push_back({c.at("shaft").get<std::string>() + ' ' + clamp + ' ' + support,
                   shaft,
                   {supports(k, clamp, "r"), supports(k, clamp, "t")},
                   c.at("positions"),
                   c});
  }
  return all;
}

/// Load of all its cases.
inline constexpr Load kLoad{250, 600, 180};

}  // namespace turnwright::deflection::reference
