// A seat 30 k6: its limits, and whether the shop's scatter keeps them.
#include <cstdio>

#include "turnwright/tolerance/budget.hpp"
#include "turnwright/tolerance/iso286.hpp"

int main() {
  using namespace turnwright;
  const auto limits = tolerance::fit_limits_mm(30, "k6");
  std::printf("30 k6: %+.3f mm, %+.3f mm\n", limits.upper_mm, limits.lower_mm);

  const double half_um = 500 * (limits.upper_mm - limits.lower_mm);
  using enum tolerance::Distribution;
  const auto budget = tolerance::budget(
      {.sources = {{"offset of the tool", uniform, 1, 2}, {"drift", normal, 1.2, 2}}},
      {-half_um, half_um});
  std::printf("room +-%.1f um, sigma %.2f um, %.2f %% of the parts conform\n", half_um,
              budget.sigma_um, 100 * budget.P_conform);
  for (const auto& share : budget.shares)
    std::printf("%s: %.0f %% of the variance\n", share.name.c_str(),
                100 * share.variance_share);
}
