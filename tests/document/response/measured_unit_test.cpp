#include "document/response/measured_unit.hpp"

#include <gtest/gtest.h>

#include "document/response/heading.hpp"

namespace turnwright::document::measured_unit_test {
namespace {

/// The value of one unit in mm/(s^d N), -1 for no such unit.
double mm_of(std::string_view text, int derivative) {
  const auto unit = response_unit(text);
  return unit && unit->derivative == derivative ? unit->mm : -1;
}

// From the definitions of the units, multiplied out by hand.
TEST(MeasuredUnit, ResponsesInMillimetresAndNewtons) {
  EXPECT_DOUBLE_EQ(mm_of("mm/N", 0), 1);
  EXPECT_DOUBLE_EQ(mm_of("m/N", 0), 1e3);
  EXPECT_DOUBLE_EQ(mm_of("um/N", 0), 1e-3);
  EXPECT_DOUBLE_EQ(mm_of("\u00b5m/N", 0), 1e-3);
  EXPECT_DOUBLE_EQ(mm_of("\u03bcm/N", 0), 1e-3);
  EXPECT_DOUBLE_EQ(mm_of("in/lbf", 0), 25.4 / (0.45359237 * 9.80665));
  EXPECT_DOUBLE_EQ(mm_of("in/lb", 0), 25.4 / (0.45359237 * 9.80665));
  EXPECT_DOUBLE_EQ(mm_of("ips/lbf", 1), 25.4 / (0.45359237 * 9.80665));
  EXPECT_DOUBLE_EQ(mm_of("m/s/N", 1), 1e3);
  EXPECT_DOUBLE_EQ(mm_of("g/N", 2), 9806.65);
  EXPECT_DOUBLE_EQ(mm_of("g/lbf", 2), 1000 / 0.45359237);
  EXPECT_DOUBLE_EQ(mm_of("1/kg", 2), 1e3);
}

TEST(MeasuredUnit, WaysOfWritingOneUnit) {
  for (const char* text :
       {"m/s2/N", "m/s^2/N", "m/s\u00b2/N", "(m/s\u00b2)/N", "(m/s^2)/N", "[m/s2]/N",
        "m/(s2 N)", "m/(s^2*N)", "m s^-2 N^-1", "m s-2 N-1", "m\u00b7s\u207b\u00b2/N",
        "(1/N)*(m/s\u00b2)", "m / s2 / N", "m/s/s/N", "m/s2\u00b7N-1"})
    EXPECT_DOUBLE_EQ(mm_of(text, 2), 1e3) << text;
}

TEST(MeasuredUnit, NoUnitsOfAResponse) {
  for (const char* text :
       {"",       "N/m",     "N/mm",  "m",       "s2",
        "mm/N/",  "/N",      "mm//N", "(mm/N",   "mm/N)",
        "mm/Nm",  "Mm/N",    "mm/n",  "mm/N 2",  "mm^/N",
        "mm^-/N", "m/s22/N", "mm-N",  "10 mm/N", "((((((((((m))))))))))/N",
        "dB",     "V/N"})
    EXPECT_FALSE(response_unit(text)) << text;
  EXPECT_FALSE(measured_unit(std::string(61, 'm')));
}

TEST(MeasuredUnit, MotionsAndForces) {
  EXPECT_EQ(motion_derivative(*measured_unit("g")), 2);
  EXPECT_EQ(motion_derivative(*measured_unit("in/s")), 1);
  EXPECT_EQ(motion_derivative(*measured_unit("um")), 0);
  EXPECT_FALSE(motion_derivative(*measured_unit("N")));
  EXPECT_EQ(*measured_unit("kgf"), *measured_unit("kp"));
  EXPECT_DOUBLE_EQ(measured_unit("kg m/s2")->scale, 1);  // a newton
  EXPECT_TRUE(measured_unit("kg m/s2")->of_dimensions(0, 0, 1));
}

bool is_response(std::string_view text) { return response_unit(text).has_value(); }

TEST(Heading, QuantityAndUnitApart) {
  const auto parts = [](std::string_view name) {
    const Heading h = heading(name, is_response);
    return h.quantity + "|" + h.unit;
  };
  EXPECT_EQ(parts("Real [mm/N]"), "Real|mm/N");
  EXPECT_EQ(parts("Real (m/s^2/N)"), "Real|m/s^2/N");
  EXPECT_EQ(parts("Real (m/s^2)/N"), "Real|(m/s^2)/N");
  EXPECT_EQ(parts("real, um/N"), "real|um/N");
  EXPECT_EQ(parts("H1 real: g/N"), "H1 real|g/N");
  EXPECT_EQ(parts("Real in mm/N"), "Real in|mm/N");
  EXPECT_EQ(parts("real_mm/N"), "real|mm/N");
  EXPECT_EQ(parts("mm/N"), "mm/N|");
  EXPECT_EQ(parts("Real [V/N]"), "Real [V/N]|");
  EXPECT_EQ(parts(""), "|");
}

TEST(Heading, TheFirstQuantityNamedHasTheColumn) {
  const std::vector<Quantity> known{{"phase", {"phas*"}}, {"frequency", {"freq*", "f"}}};
  const auto key = [&](std::string_view name) {
    const Quantity* const found = quantity_named(name, known);
    return found ? found->key : "";
  };
  EXPECT_EQ(key("Phase of the frequency response"), "phase");
  EXPECT_EQ(key("FREQUENCY"), "frequency");
  EXPECT_EQ(key("f"), "frequency");
  EXPECT_EQ(key("Fx"), "");
  EXPECT_EQ(key("Phas\u00e9"), "phase");
  EXPECT_EQ(key(""), "");
}

}  // namespace
}  // namespace turnwright::document::measured_unit_test
