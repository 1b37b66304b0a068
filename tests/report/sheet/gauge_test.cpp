#include "report/sheet/gauge.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace turnwright::report::gauge_test {
namespace {

// The uncertainties of the header: calliper 30 um, micrometer 4 um, each at most a fifth
// of the width.
TEST(Gauge, IsTheSimplestWhoseUncertaintyIsAFifthOfTheWidth) {
  EXPECT_EQ(gauge(Measured::outside, 0.15), "calliper");
  EXPECT_EQ(gauge(Measured::outside, 0.149), "micrometer");
  EXPECT_EQ(gauge(Measured::outside, 0.02), "micrometer");
  EXPECT_EQ(gauge(Measured::outside, 0.019), "indicating snap gauge");
}

TEST(Gauge, BelowWhatTheShopFloorMeasuresItIsTheMeasuringRooms) {
  for (const auto m : {Measured::outside, Measured::inside, Measured::length,
                       Measured::runout, Measured::form}) {
    EXPECT_NE(gauge(m, 0.0005).find("measuring room"), std::string::npos);
    EXPECT_EQ(gauge(m, 0.3).find("measuring room"), std::string::npos);
  }
}

TEST(Gauge, AWidthThatIsNoneIsRefused) {
  EXPECT_THROW(gauge(Measured::outside, 0), std::domain_error);
}

TEST(Gauge, RoughnessBelowWhatPlatesTellNeedsATester) {
  EXPECT_EQ(roughness_gauge(3.2), "comparison plates");
  EXPECT_EQ(roughness_gauge(0.8), "roughness tester");
}

}  // namespace
}  // namespace turnwright::report::gauge_test
