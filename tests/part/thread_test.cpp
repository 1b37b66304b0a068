#include "turnwright/part/thread.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace turnwright::part {
namespace {

// ISO 724 and the handbook's tables of metric threads, three decimals printed.
TEST(Thread, HasTheTabulatedDiameters) {
  struct Printed {
    double d, P, d3, D1;
  };
  for (const auto& t :
       {Printed{10, 1.5, 8.160, 8.376}, Printed{20, 2.5, 16.933, 17.294},
        Printed{30, 3.5, 25.706, 26.211}, Printed{30, 1.5, 28.160, 28.376}}) {
    const auto outside = thread(t.d, t.P, Where::outside);
    EXPECT_NEAR(outside.cut.core.left_mm, t.d3, 5e-4) << t.d;
    EXPECT_EQ(outside.blank.left_mm, t.d);
    EXPECT_NEAR(outside.cut.depth_mm, 0.61343 * t.P, 1e-5 * t.P);
    const auto inside = thread(t.d, t.P, Where::inside);
    EXPECT_NEAR(inside.blank.left_mm, t.D1, 5e-4) << t.d;
    EXPECT_EQ(inside.cut.core.left_mm, t.d);
    EXPECT_NEAR(inside.cut.depth_mm, 0.54127 * t.P, 1e-5 * t.P);
  }
}

// ISO 965-1's limits of D1, whose widths are rounded to the series R 40, of steps of 6 %.
TEST(MinorDiameter, IsThatOfThePrintedTableBeforeItsRounding) {
  struct Printed {
    double d, P, least, most;
  };
  for (const auto& t : {Printed{3, 0.5, 2.459, 2.599}, Printed{5, 0.8, 4.134, 4.334},
                        Printed{6, 1, 4.917, 5.153}, Printed{8, 1.25, 6.647, 6.912},
                        Printed{10, 1.5, 8.376, 8.676}, Printed{12, 1.75, 10.106, 10.441},
                        Printed{16, 2, 13.835, 14.210}, Printed{20, 2.5, 17.294, 17.744},
                        Printed{24, 3, 20.752, 21.252}}) {
    const auto D1 = minor_diameter_6H(t.d, t.P);
    EXPECT_NEAR(D1.least_mm, t.least, 5e-4) << t.d;
    EXPECT_NEAR(D1.most_mm - D1.least_mm, t.most - t.least, 0.04 * (t.most - t.least))
        << t.d;
  }
}

TEST(TappedThread, IsCutIntoItsDrilledHole) {
  const auto t = tapped(10, 1.5, 8.5, 3.75);
  EXPECT_EQ(t.blank.left_mm, 8.5);
  EXPECT_EQ(t.cut.drawn.left_mm, 10);
  EXPECT_EQ(t.cut.core.left_mm, 10) << "as weak as its full diameter";
  EXPECT_NEAR(t.cut.depth_mm, 0.75, 1e-12);
  EXPECT_EQ(t.cut.pitch_mm, 1.5);
}

// From printed tables of limits; `rounded` is what the widths are rounded by there.
struct PrintedLimits {
  double d, P;
  const char* tolerance_class;
  double crest_most, crest_least, pitch_most, pitch_least;
};

void expect_limits(const std::vector<PrintedLimits>& all, Where where, double rounded,
                   double last_digit) {
  for (const auto& t : all) {
    SCOPED_TRACE(std::string(t.tolerance_class) + " of " + std::to_string(t.d));
    const auto limits = thread_limits(t.tolerance_class, t.d, t.P, where);
    ASSERT_TRUE(limits);
    const auto near = [&](double size, const Limits& found, double least, double most) {
      const double apart = rounded * (most - least) + last_digit;
      EXPECT_NEAR(size + found.lower_mm, least, apart);
      EXPECT_NEAR(size + found.upper_mm, most, apart);
    };
    const auto basic = thread(t.d, t.P, where), cut = thread(t.d, t.P, where, *limits);
    near(t.d - 0.64952 * t.P, limits->pitch, t.pitch_least, t.pitch_most);
    near(basic.blank.left_mm, limits->crest, t.crest_least, t.crest_most);
    EXPECT_EQ(cut.blank.left_mm, basic.blank.left_mm);
    EXPECT_EQ(cut.cut.drawn.left_mm, t.d);
    const double root =
        basic.cut.core.left_mm + (limits->pitch.lower_mm + limits->pitch.upper_mm) / 2;
    EXPECT_NEAR(cut.cut.core.left_mm, root, 1e-12);
    const double crest =
        basic.blank.left_mm + (limits->crest.lower_mm + limits->crest.upper_mm) / 2;
    EXPECT_NEAR(2 * cut.cut.depth_mm, std::abs(crest - root), 1e-12);
  }
}

// ISO 965-1 and -2, whose widths are rounded to the series R 40, some twice: by up to 6 %.
TEST(ThreadClasses, OfMetricThreadsHaveThePrintedLimits) {
  expect_limits({{6, 1, "6g", 5.974, 5.794, 5.324, 5.212},
                 {8, 1.25, "6g", 7.972, 7.760, 7.160, 7.042},
                 {10, 1.5, "6g", 9.968, 9.732, 8.994, 8.862},
                 {10, 1.5, "4h", 10, 9.850, 9.026, 8.941},
                 {10, 1.5, "4h6h", 10, 9.764, 9.026, 8.941},
                 {10, 1.5, "8g", 9.968, 9.593, 8.994, 8.782},
                 {12, 1.75, "6g", 11.966, 11.701, 10.829, 10.679},
                 {16, 2, "6g", 15.962, 15.682, 14.663, 14.503},
                 {20, 2.5, "6g", 19.958, 19.623, 18.334, 18.164},
                 {24, 3, "6g", 23.952, 23.577, 22.003, 21.803}},
                Where::outside, 0.06, 1e-3);
  expect_limits({{6, 1, "6H", 5.153, 4.917, 5.500, 5.350},
                 {8, 1.25, "6H", 6.912, 6.647, 7.348, 7.188},
                 {10, 1.5, "6H", 8.676, 8.376, 9.206, 9.026},
                 {10, 1.5, "5H", 8.612, 8.376, 9.166, 9.026},
                 {10, 1.5, "7H", 8.751, 8.376, 9.250, 9.026},
                 {10, 1.5, "6G", 8.708, 8.408, 9.238, 9.058},
                 {16, 2, "6H", 14.210, 13.835, 14.913, 14.701},
                 {24, 3, "6H", 21.252, 20.752, 22.316, 22.051}},
                Where::inside, 0.06, 1e-3);
}

// ASME B1.1, of four decimals of an inch, inside of three.
TEST(ThreadClasses, OfUnifiedThreadsHaveThePrintedLimits) {
  const auto mm = [](std::vector<PrintedLimits> all) {
    for (auto& t : all)
      for (double* x :
           {&t.d, &t.crest_most, &t.crest_least, &t.pitch_most, &t.pitch_least})
        *x *= 25.4;
    for (auto& t : all) t.P = 25.4 / t.P;
    return all;
  };
  expect_limits(mm({{0.25, 20, "2A", 0.2489, 0.2408, 0.2164, 0.2127},
                    {0.375, 16, "2A", 0.3737, 0.3643, 0.3331, 0.3287},
                    {0.5, 13, "2A", 0.4985, 0.4876, 0.4485, 0.4435},
                    {0.5, 13, "3A", 0.5, 0.4891, 0.4500, 0.4463},
                    {0.5, 13, "1A", 0.4985, 0.4822, 0.4485, 0.4411}}),
                Where::outside, 0, 25.4e-4);
  expect_limits(mm({{0.25, 20, "2B", 0.207, 0.196, 0.2224, 0.2175},
                    {0.375, 16, "2B", 0.321, 0.307, 0.3401, 0.3344},
                    {0.5, 13, "2B", 0.434, 0.417, 0.4565, 0.4500},
                    {0.5, 13, "3B", 0.4284, 0.4170, 0.4548, 0.4500}}),
                Where::inside, 0, 0.0006 * 25.4);
}

TEST(ThreadClasses, OfTheOtherSideOrNoneAreNone) {
  for (const char* text :
       {"6H", "2B", "6d", "6", "g6", "2g", "10g", "6g6", "4A", "", "6gg6"})
    EXPECT_FALSE(thread_limits(text, 20, 2.5, Where::outside)) << text;
  for (const char* text : {"6g", "2A", "6F", "6Hh6", "0B"})
    EXPECT_FALSE(thread_limits(text, 20, 2.5, Where::inside)) << text;
}

}  // namespace
}  // namespace turnwright::part
