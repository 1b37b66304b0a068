#pragma once
#include <string>
#include <vector>

#include "turnwright/multipass/problem.hpp"

/// Problems around the literature's in which each limit binds.
namespace turnwright::multipass {

inline Problem literature(double dt_mm, Cost cost) {
  Problem m;
  m.dt_mm = dt_mm;
  m.cost = cost;
  return m;
}

struct Variant {
  std::string binds;
  Problem m;
};

inline std::vector<Variant> variants() {
  std::vector<Variant> all;
  const auto add = [&](const std::string& binds, double dt, Cost cost, auto change) {
    Problem m = literature(dt, cost);
    change(m);
    all.push_back({binds, m});
  };
  const auto L = Cost::literal, P = Cost::physical;
  add("rough:PU", 6, L, [](Problem& m) { m.PU = 3; });
  add("finish:PU", 6, P, [](Problem& m) {
    m.PU = 2.6;
    m.k4 = 0.5;
    m.SRu_um = 100;
  });
  add("rough:FU", 8, L, [](Problem& m) { m.FU = 150; });
  add("finish:FU", 6, L, [](Problem& m) {
    m.k4 = 0;
    m.SRu_um = 200;
    m.FU = 120;
  });
  add("rough:QU", 8, L, [](Problem& m) { m.QU = 860; });
  add("finish:QU", 6, L, [](Problem& m) {
    m.QU = 900;
    m.theta = 0.3;
    m.T = {10, 200};
  });
  add("rough:SC", 7, P, [](Problem& m) { m.SC = 6000; });
  add("finish:SC", 8, L, [](Problem& m) {
    m.lambda = -1;
    m.nu2 = 0.5;
    m.SC = 0.003;
  });
  add("finish:SC", 6, L, [](Problem& m) {
    m.lambda = -0.5;
    m.nu2 = 1;
    m.SC = 0.054;
  });
  add("finish:SC", 6, P, [](Problem& m) {
    m.lambda = 2;
    m.nu2 = 1;
    m.SC = 19500;
  });
  add("finish:SRu_um", 6, L, [](Problem& m) { m.SRu_um = 2; });
  add("rough:T_max", 6, L, [](Problem& m) { m.T = {25, 32}; });
  add("finish:T_min", 6, L, [](Problem& m) { m.T = {30, 60}; });
  add("rough:T_min", 6, P, [](Problem& m) { m.T = {40, 60}; });
  add("finish:T_max", 6, P, [](Problem& m) { m.T = {10, 20}; });
  add("rough:T_min", 8, L, [](Problem& m) { m.T = {30, 30}; });
  add("rough:VrU", 6, P, [](Problem& m) { m.VrU = 100; });
  add("finish:V_max", 6, P, [](Problem& m) { m.V.upper = 150; });
  add("rough:V_min", 6, P, [](Problem& m) { m.V.lower = 130; });
  add("rough:f_max", 8, L, [](Problem& m) { m.f.upper = 0.5; });
  add("finish:f_min", 6, L, [](Problem& m) {
    m.k4 = 0;
    m.SRu_um = 1000 * 0.1 * 0.1 / (8 * m.R_mm);
  });
  add("rough:d_max", 4, P, [](Problem& m) {
    m.k5 = 0;
    m.d = {0.5, 2.2};
    m.FU = 250;
    m.PU = 50;
    m.SRu_um = 3;
  });
  add("finish:d_min", 4, P, [](Problem& m) {
    m.k5 = 0;
    m.d = {1.7, 3.5};
    m.FU = 250;
    m.PU = 50;
    m.SRu_um = 3;
  });
  add("k3", 6, P, [](Problem& m) { m.k3 = 1.6; });
  add("k4", 8, L, [](Problem& m) { m.k4 = 3.5; });
  add("k5", 7, P, [](Problem& m) { m.k5 = 1.3; });
  add("rough:FU", 9, L, [](Problem& m) {
    m.theta = 0;
    m.T = {10, 90};
  });
  add("rough:FU", 9, L, [](Problem& m) {
    m.theta = 1;
    m.T = {10, 90};
  });
  add("rough:FU", 6, L, [](Problem& m) {
    m.theta = 0.3;
    m.T = {10, 200};
  });
  return all;
}

}  // namespace turnwright::multipass
