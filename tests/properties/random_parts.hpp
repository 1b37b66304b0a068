#pragma once
#include <rapidcheck.h>

#include <cmath>
#include <string>
#include <vector>

#include "../planning/parts.hpp"

/// Stepped shafts as a planner might draw them.
namespace turnwright::properties {

using nlohmann::json;

struct RandomShaft {
  std::vector<int> lengths_mm, diameters_mm;
  std::vector<int> fits;   ///< of each cylinder: index into kFits, 0 for none
  std::vector<int> Ra_um;  ///< 0 for none
  int allowance_mm = 2;    ///< of the stock, on the largest diameter
  int left_mm = 1, right_mm = 1;
  int cylindricity_um = 0;   ///< of the last cylinder, 0 for none
  bool tailstock = false;    ///< is a candidate
  std::size_t material = 0;  ///< index into kMaterials
};

inline const std::vector<std::string> kFits{"", "h11", "h9", "h8", "h7", "k6"};
inline const std::vector<std::string> kMaterials{"C45", "42CrMo4-A", "C15", "42CrMo4-QT"};

inline int total(const RandomShaft& s) {
  int sum = 0;
  for (const int length : s.lengths_mm) sum += length;
  return sum;
}

inline json json_of(const RandomShaft& s) {
  json outer = json::array(), tolerances = json::array();
  int largest = 0;
  for (std::size_t i = 0; i < s.lengths_mm.size(); ++i) {
    json e{{"id", "d" + std::to_string(i + 1)},
           {"kind", "cylinder"},
           {"length_mm", s.lengths_mm[i]},
           {"diameter_mm", s.diameters_mm[i]}};
    if (s.fits[i] > 0) e["fit"] = kFits[static_cast<std::size_t>(s.fits[i])];
    if (s.Ra_um[i] > 0) e["Ra_um"] = s.Ra_um[i];
    outer.push_back(e);
    largest = std::max(largest, s.diameters_mm[i]);
  }
  if (s.cylindricity_um > 0)
    tolerances.push_back({{"id", "t1"},
                          {"kind", "cylindricity"},
                          {"of", outer.back()["id"]},
                          {"value_mm", s.cylindricity_um * 1e-3}});
  const auto clampings = s.tailstock ? json{"chuck", "chuck-tailstock"} : json{"chuck"};
  const auto grip = [](int length) { return std::min(length, 30) * 0.8; };
  return {{"format", "turnwright-part/1"},
          {"name", "Random shaft"},
          {"material", kMaterials[s.material]},
          {"stock",
           {{"kind", "bar"},
            {"diameter_mm", largest + s.allowance_mm},
            {"length_mm", total(s) + s.left_mm + s.right_mm},
            {"left_allowance_mm", s.left_mm}}},
          {"outer", outer},
          {"tolerances", tolerances},
          {"machine", "lathe-medium"},
          {"tools", {"PCLNL-CNMG120408-PM", "PDJNL-DNMG150604-PF"}},
          {"setups",
           {{{"hold", "left"},
             {"grip_mm", grip(s.lengths_mm.front())},
             {"clampings", clampings}},
            {{"hold", "right"},
             {"grip_mm", grip(s.lengths_mm.back())},
             {"clampings", clampings}}}},
          {"batch", 20},
          {"damping_ratio", 0.1}};
}

/// The same part seen from its other end.
inline RandomShaft mirrored(RandomShaft s) {
  for (auto* list : {&s.lengths_mm, &s.diameters_mm, &s.fits, &s.Ra_um})
    std::reverse(list->begin(), list->end());
  std::swap(s.left_mm, s.right_mm);
  return s;
}

inline void showValue(const RandomShaft& s, std::ostream& out) {
  out << json_of(s).dump();
}

}  // namespace turnwright::properties

namespace rc {

template <>
struct Arbitrary<turnwright::properties::RandomShaft> {
  static Gen<turnwright::properties::RandomShaft> arbitrary() {
    using turnwright::properties::RandomShaft;
    return gen::mapcat(gen::inRange(1, 5), [](int cylinders) {
      const auto n = static_cast<std::size_t>(cylinders);
      const auto list = [n](auto low, auto high) {
        return gen::container<std::vector<int>>(n, gen::inRange(low, high));
      };
      return gen::build<RandomShaft>(
          gen::set(&RandomShaft::lengths_mm, list(20, 90)),
          gen::set(&RandomShaft::diameters_mm, list(18, 70)),
          gen::set(&RandomShaft::fits, list(0, 6)),
          gen::set(&RandomShaft::Ra_um, list(0, 7)),
          gen::set(&RandomShaft::allowance_mm, gen::inRange(1, 8)),
          gen::set(&RandomShaft::left_mm, gen::inRange(0, 3)),
          gen::set(&RandomShaft::right_mm, gen::inRange(0, 3)),
          gen::set(&RandomShaft::cylindricity_um, gen::element(0, 5, 10, 30)),
          gen::set(&RandomShaft::tailstock, gen::arbitrary<bool>()),
          gen::set(&RandomShaft::material, gen::inRange<std::size_t>(0, 4)));
    });
  }
};

}  // namespace rc
