#pragma once
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "turnwright/volumetric/kinematics.hpp"

/// Machines of tests/data/volumetric_reference.json and random ones.
namespace turnwright::volumetric::testing {

inline nlohmann::json reference() {
  return nlohmann::json::parse(
      std::ifstream(TURNWRIGHT_SOURCE_DIR "/tests/data/volumetric_reference.json"));
}

/// Of an error or location key such as "EYX", "EX0C": its direction.
inline std::size_t direction(const std::string& key) { return letter_index(key[1]); }

inline void add_errors(Axis& axis, const nlohmann::json& err) {
  for (const auto& [key, e] : err.items()) {
    ErrorFunction& f = axis.errors[direction(key)];
    f.c = e.at("c").get<std::array<double, 4>>();
    f.b = e.at("b");
    if (e.contains("f"))
      for (const auto& h : e["f"]) f.f.push_back({h[0], h[1]});
  }
}

inline Machine machine(const nlohmann::json& j) {
  Machine m{j.at("chain"), j.at("tool_point"), {}};
  for (const auto& a : j.at("axes")) {
    Axis axis{a.at("name").get<std::string>()[0], a.at("p"), a.at("Q")};
    add_errors(axis, a.at("err"));
    for (const auto& group : {a.at("loc"), a.at("sq")})
      for (const auto& [key, value] : group.items())
        axis.location[direction(key)] = value;
    m.axes.push_back(axis);
  }
  return m;
}

inline Position position(const nlohmann::json& j) {
  Position p;
  for (const auto& [key, q] : j.at("q").items()) p.q[letter_index(key[0])] = q;
  for (const auto& [key, s] : j.at("sign").items()) p.sign[letter_index(key[0])] = s;
  return p;
}

/// Errors of the order of `size` [mm, rad/100 mm] on a chain of up to six axes.
class RandomMachines {
 public:
  explicit RandomMachines(unsigned seed) : random_(seed) {}
  double number(double most) {
    return std::uniform_real_distribution<>(-most, most)(random_);
  }
  Machine machine(double size) {
    std::string letters(kLetters);
    std::shuffle(letters.begin(), letters.end(), random_);
    letters.resize(1 + random_() % 6);
    letters.insert(random_() % (letters.size() + 1), "f");
    Machine m{"w" + letters + "t", {number(200), number(200), number(200)}, {}};
    for (const char name : letters) {
      if (name == 'f') continue;
      Axis axis{name,
                {number(200), number(200), number(200)},
                default_Q(name) * (1 + number(0.5))};
      for (std::size_t k = 0; k < kDirections; ++k) {
        const double scale = k < 3 ? size : size / 100;
        ErrorFunction& e = axis.errors[k];
        for (double& c : e.c) c = number(scale / 3);
        e.b = number(scale / 3);
        if (is_rotary(name))
          for (unsigned h = random_() % 4; h > 0; --h)
            e.f.push_back({number(scale), number(scale)});
        if (is_rotary(name) || (k > 2 && k != letter_index(name) + 3))
          axis.location[k] = number(scale);
      }
      m.axes.push_back(axis);
    }
    return m;
  }
  Position position() {
    Position p;
    for (std::size_t k = 0; k < kDirections; ++k) {
      p.q[k] = number(k < 3 ? 300 : 3);
      p.sign[k] = static_cast<double>(random_() % 3) - 1;
    }
    return p;
  }

 private:
  std::mt19937 random_;
};

}  // namespace turnwright::volumetric::testing
