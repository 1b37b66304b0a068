#include "turnwright/deflection/copying.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace turnwright::deflection {
namespace {

constexpr Flexibility kSpring{1e-3, 0, 0, 0, 0};

TEST(Copying, EveryPassLeavesMuOverOnePlusMu) {
  for (const double mu : {0.01, 0.4, 1.0, 3.7}) {
    const ForceLaw law{mu * 1e3, 1, 0, 0, 0};
    const std::vector<double> ap{2, 1, 0.5, 0};
    const auto left = copied_runout_of_passes(40, kSpring, {}, law, 0.2, ap);
    ASSERT_EQ(left.size(), ap.size());
    for (std::size_t n = 0; n < ap.size(); ++n)
      EXPECT_NEAR(left[n], 0.2 * std::pow(mu / (1 + mu), static_cast<double>(n + 1)),
                  1e-13);
  }
}

TEST(Copying, ASmallRunoutIsCopiedByTheSlopeOfTheEquilibrium) {
  // d/dap of h + A c h^x = ap gives dh/dap = 1/(1 + mu(h)), de/dap = mu/(1 + mu)
  const double A = 1e-3, c = 600, x = 0.75, ap = 1.5, eps = 1e-4;
  const ForceLaw law{c, x, 0, 0, 0};
  const auto left =
      copied_runout_of_passes(40, kSpring, {}, law, eps, std::vector<double>{ap});
  ForceLaw set = law;
  set.ap_mm = ap;
  const double h = ap - equilibrium(40, kSpring, {}, set).radius_error_mm;
  const double mu = A * c * x * std::pow(h, x - 1);
  EXPECT_NEAR(left[0] / eps, mu / (1 + mu), 1e-8);
}

TEST(Copying, ARigidPartIsTurnedRound) {
  const auto left = copied_runout_of_passes(40, {}, {}, {500, 0.8, 0.6, 2.2, 0}, 0.3,
                                            std::vector<double>{1, 0.2});
  EXPECT_EQ(left, (std::vector<double>{0, 0}));
}

TEST(Copying, RefusesABlankThatLeavesTheTool) {
  const ForceLaw law{500, 1, 0, 0, 0};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double runout : {1.0, 2.0, -0.1, nan})
    EXPECT_THROW(
        copied_runout_of_passes(40, kSpring, {}, law, runout, std::vector<double>{1.0}),
        std::domain_error);
  EXPECT_THROW(copied_runout_of_passes(40, kSpring, {}, law, 0, {}), std::domain_error);
}

}  // namespace
}  // namespace turnwright::deflection
