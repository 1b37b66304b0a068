#include "turnwright/volumetric/agreement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace turnwright::volumetric {
namespace {

TEST(Agreement, SummaryIsOfASample) {
  const Summary s = summary({2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_DOUBLE_EQ(s.mean, 5);
  EXPECT_NEAR(s.sd, std::sqrt(32.0 / 7), 1e-15);
  EXPECT_THROW(summary({1}), std::domain_error);
}

TEST(Agreement, WelchOfEqualListsIsStudents) {
  // Means 3 and 5, both variances 2.5: t = -2/sqrt(1), 8 degrees of freedom; Student's
  // two-sided probability there by its closed form for even degrees.
  const Agreement a = agreement({"x", {1, 2, 3, 4, 5}}, {"x", {3, 4, 5, 6, 7}});
  EXPECT_NEAR(*a.t, -2, 1e-12);
  EXPECT_NEAR(*a.dof, 8, 1e-12);
  const double s = 2 / std::sqrt(12.0), c2 = 8.0 / 12;  // sin, cos^2 of atan(t/sqrt 8)
  const double inside = s * (1 + c2 / 2 + 3 * c2 * c2 / 8 + 15 * c2 * c2 * c2 / 48);
  EXPECT_NEAR(*a.p, 1 - inside, 1e-12);
  EXPECT_TRUE(a.overlap);
  EXPECT_NEAR(a.correlation->r, 1, 1e-12);
}

TEST(Agreement, WelchDoesNotDependOnTheUnit) {
  // The squares of these variances are below the least double.
  const Agreement a = agreement({"x", {1e-99, 2e-99, 3e-99, 4e-99, 5e-99}},
                                {"x", {3e-99, 4e-99, 5e-99, 6e-99, 7e-99}});
  EXPECT_NEAR(*a.t, -2, 1e-12);
  EXPECT_NEAR(*a.dof, 8, 1e-12);
}

TEST(Agreement, CorrelationOfFourRuns) {
  const Agreement a = agreement({"x", {1, 2, 3, 4}}, {"x", {2, 1, 4, 3}});
  EXPECT_NEAR(a.correlation->r, 0.6, 1e-12);
  // With 2 degrees of freedom a correlation is uniform: p = 1 - |r|.
  EXPECT_NEAR(a.correlation->p, 0.4, 1e-12);
  EXPECT_NEAR(*a.correlation->lower, std::tanh(std::atanh(0.6) - 1.959963984540054),
              1e-12);
  EXPECT_FALSE(agreement({"x", {1, 1, 1}}, {"x", {1, 2, 3}}).correlation);
  EXPECT_FALSE(agreement({"x", {1, 1}}, {"x", {1, 1}}).t);
  EXPECT_FALSE(agreement({"x", {1, 2, 3}}, {"x", {1, 2}}).correlation);
  // Equal values do not scatter, whatever rounding makes of their mean.
  EXPECT_FALSE(agreement({"x", {.1, .1, .1}}, {"x", {1, 2, 3}}).correlation);
  EXPECT_FALSE(agreement({"x", {.1, .1, .1}}, {"x", {.3, .3, .3}}).t);
}

TEST(Agreement, JumpsAreCommonOnlyIfAlike) {
  const std::vector<Runs> scale = {
      {"a", {1, 1.2, 0.9, 11}}, {"b", {5, 5.1, 5.2, 15}}, {"c", {-3, -3.1, -3.3, 7}}};
  const auto found = common_jumps(scale);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].run, 3u);
  EXPECT_EQ(found[0].parameters, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_NEAR(found[0].jump[1], 9.9, 1e-12);
  // One alone, or in opposite senses, or by unlike amounts: no common cause.
  EXPECT_TRUE(common_jumps({scale[0], {"b", {1, 2, 3, 4}}}).empty());
  EXPECT_TRUE(common_jumps({scale[0], {"b", {5, 5.1, 5.2, -5}}}).empty());
  EXPECT_TRUE(common_jumps({scale[0], {"b", {5, 5.1, 5.2, 50}}}).empty());
  EXPECT_TRUE(common_jumps({}).empty());
}

}  // namespace
}  // namespace turnwright::volumetric
