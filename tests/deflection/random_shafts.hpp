#pragma once
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "turnwright/deflection/beam.hpp"

/// Seeded shafts of every awkward kind, for properties that must hold on all of them.
namespace turnwright::deflection::random_shafts {

struct Named {
  std::string name;
  part::Shaft shaft;
};

inline double between(std::mt19937_64& random, double low, double high) {
  // spelled out: the standard library's distributions differ between vendors
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

/// Normally distributed about 0 with deviation 1 (Box and Muller).
inline double normal(std::mt19937_64& random) {
  const double u = between(random, 0x1p-53, 1), v = between(random, 0, 1);
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

inline std::vector<Named> all(unsigned seed) {
  std::mt19937_64 random(seed);
  const auto r = [&](double low, double high) { return between(random, low, high); };
  const auto shaft = [](std::vector<part::Segment> segments) {
    return part::Shaft{210000, 0.3, std::move(segments)};
  };
  const auto solid = [&](double length, double left, double right) {
    return part::Segment{length, left, right, 0, 0};
  };
  std::vector<Named> shafts;

  shafts.push_back({"cone 20:1", shaft({solid(r(50, 200), 60, 3)})});
  shafts.push_back({"cone 1:20", shaft({solid(r(50, 200), 3, 60)})});
  shafts.push_back(
      {"nearly a cylinder", shaft({solid(r(50, 200), 40, 40 * (1 + 1e-9))})});
  shafts.push_back(
      {"tube of 95 %", shaft({{r(80, 200), 40, 40, 38, 38}, {50, 60, 60, 38, 38}})});
  const double outer = r(60, 80);
  shafts.push_back(
      {"hollow cone 20:1, bore 95 %",
       shaft({{r(80, 200), outer, outer / 20, .95 * outer, .95 * outer / 20}})});
  shafts.push_back({"walls that close and open",
                    shaft({{r(30, 90), 30, 60, 29, 2}, {r(30, 90), 60, 25, 2, 24}})});
  shafts.push_back(
      {"pointed bore", shaft({{r(30, 90), 50, 40, 40, 0}, solid(60, 40, 20)})});
  shafts.push_back({"tiny taper of a tube",
                    shaft({{r(80, 120), 40, 40 * (1 - 1e-10), 20, 20 * (1 + 1e-10)}})});
  shafts.push_back({"bored from the tail", shaft({solid(r(50, 90), 60, 60),
                                                  solid(r(30, 50), 45, 40),
                                                  {r(20, 40), 40, 40, 20, 20},
                                                  {r(20, 40), 40, 36, 22, 26}})});
  shafts.push_back({"bored from the chuck", shaft({{r(20, 40), 50, 50, 30, 30},
                                                   {r(10, 20), 50, 50, 30, 0},
                                                   solid(r(80, 120), 40, 30)})});
  shafts.push_back({"thin neck at the jaws", shaft({solid(20, 60, 60), solid(4, 6, 6),
                                                    solid(r(100, 200), 60, 60)})});
  shafts.push_back({"neck of 1:20 at the jaws", shaft({solid(5, 60, 60), solid(2, 3, 3),
                                                       solid(r(100, 200), 60, 60)})});
  shafts.push_back({"two thin necks", shaft({solid(r(20, 60), 50, 50), solid(3, 5, 5),
                                             solid(r(40, 60), 50, 50), solid(3, 4, 4),
                                             solid(r(20, 90), 50, 40)})});
  shafts.push_back({"neck of 1:12 in a tube", shaft({{r(40, 60), 48, 48, 10, 10},
                                                     solid(2, 4, 4),
                                                     {r(40, 60), 48, 48, 40, 40}})});
  shafts.push_back({"stubby", shaft({solid(r(5, 10), 60, 60), solid(r(5, 10), 55, 40)})});
  shafts.push_back({"stubby ring", shaft({{r(10, 20), 80, 80, 50, 50}})});
  shafts.push_back({"slender", shaft({solid(r(500, 900), 12, 12), solid(300, 10, 9)})});
  for (int k = 0; k < 4; ++k) {
    std::vector<part::Segment> ten;
    for (int i = 0; i < 10; ++i) {
      const double left = r(20, 60), right = i % 3 ? left : r(20, 60);
      const double bore = k % 2 ? 0 : r(0.1, 0.95);
      ten.push_back({r(5, 40), left, right, bore * left, bore * right});
    }
    shafts.push_back({k % 2 ? "ten solid segments" : "ten bored segments", shaft(ten)});
  }
  part::Shaft titanium = shafts.back().shaft;
  titanium.E_MPa = 113800;
  titanium.nu = 0.342;
  shafts.push_back({"titanium", titanium});
  return shafts;
}

/// The three clampings, rigid and on elastic supports (k1, k2, k3 in N/mm and N mm/rad).
inline std::vector<Supports> supports() {
  std::vector<Supports> all;
  const double k1 = 1.2e5, k2 = 1.28e9, k3 = 3e9, Lc = 110;
  const Root root{1 / k1 + Lc * Lc / k2, Lc / k2, 1 / k2 + 1 / k3};
  for (const Method m :
       {Method::chuck, Method::between_centres, Method::chuck_tailstock}) {
    all.push_back({m, {}, 0, 0});
    all.push_back({m, root, 1 / 8e4, 1 / 3e4});
  }
  return all;
}

}  // namespace turnwright::deflection::random_shafts
