#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "turnwright/multipass/problem.hpp"

namespace turnwright::multipass {
namespace {
TEST(X, Y) {
  for (const auto cost : {Cost::literal, Cost::physical})
    for (const double dt : {4., 5., 6., 7., 8., 9., 9.5, 10., 12., 14.}) {
      Problem m;
      m.dt_mm = dt;
      m.cost = cost;
      const auto t0 = std::chrono::steady_clock::now();
      const auto a = optimum(m);
      const auto t1 = std::chrono::steady_clock::now();
      std::printf("%d %g %ld nodes %.3f ms ", cost == Cost::literal, dt, a.nodes,
                  std::chrono::duration<double, std::milli>(t1 - t0).count());
      if (a.best)
        std::printf("n %d UC %.9f gap %.2e | %g %g %g | %g %g %g", a.best->n, *a.best->UC,
                    a.gap, a.best->rough.V, a.best->rough.f, a.best->rough.d,
                    a.best->finish.V, a.best->finish.f, a.best->finish.d);
      std::printf("\n");
      for (auto& l : a.limits)
        if (l.binding) std::printf("%s (%g) ", l.name.c_str(), l.price);
      for (auto& l : a.conflict)
        std::printf("%s (%g->%g) ", l.limit.c_str(), l.now, l.needed.value_or(-1));
      std::printf("\n");
      for (auto& c : a.per_count)
        std::printf("   %d:%d %.7f %ld;", c.n, (int)c.status, c.UC.value_or(0), c.nodes);
      std::printf("\n");
    }
}
}  // namespace
}  // namespace turnwright::multipass
