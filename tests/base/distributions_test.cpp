#include "turnwright/base/distributions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace turnwright {
namespace {

// Closed forms: Phi by erfc, t with one degree (Cauchy) and two, F(2, n), chi squared with
// two degrees (exponential).
TEST(Distributions, AreTheirClosedForms) {
  EXPECT_NEAR(normal_probability(1.5), std::erfc(-1.5 / std::numbers::sqrt2) / 2, 1e-15);
  EXPECT_NEAR(normal_probability(normal_quantile(0.975)), 0.975, 1e-14);
  EXPECT_NEAR(student_exceeds(2, 1), 0.5 - std::atan(2.0) / std::numbers::pi, 1e-14);
  EXPECT_NEAR(student_quantile(0.9, 2), 0.8 * std::sqrt(2 / (1 - 0.64)), 1e-13);
  EXPECT_NEAR(fisher_exceeds(3, 2, 7), std::pow(1 + 2 * 3.0 / 7, -3.5), 1e-14);
  EXPECT_NEAR(chi_squared_quantile(0.3, 2), -2 * std::log(0.7), 1e-13);
}

TEST(Distributions, UpperQuantilesReachFarOut) {
  EXPECT_NEAR(chi_squared_upper_quantile(1e-30, 2), 60 * std::log(10), 1e-10);
  const double p = 1e-30, t = student_upper_quantile(p, 1);  // t = cot(pi p)
  EXPECT_NEAR(t * std::numbers::pi * p, 1, 1e-12);
  EXPECT_NEAR(student_upper_quantile(0.1, 2), student_quantile(0.9, 2), 1e-13);
}

TEST(Distributions, RefuseWhatIsOutside) {
  EXPECT_THROW(normal_quantile(1.5), std::domain_error);
  EXPECT_THROW(student_quantile(0.5, 0), std::domain_error);
}

}  // namespace
}  // namespace turnwright
