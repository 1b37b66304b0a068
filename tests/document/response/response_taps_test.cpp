// Tables of taps through the door; what the taps give is tested in chatter/tap_test_test.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "responses.hpp"

namespace turnwright::document::response_taps_test {
namespace {

using namespace responses;

constexpr double kStep = 1e-4;
const std::vector<True> kOne{{450, 0.04, 6000}};

/// The motion of one mode after an impulse of 1 N s: acceleration [m/s2].  The pulse is one
/// sample of the force, high enough for that.
double ringing(double t) {
  const double w = 2 * M_PI * kOne[0].f_Hz, z = kOne[0].zeta,
               wd = w * std::sqrt(1 - z * z);
  // q = w^2/k/wd e^(-z w t) sin wd t, derived twice
  const double e = w * w / kOne[0].k_N_mm / wd * std::exp(-z * w * t);
  return e *
         ((z * z * w * w - wd * wd) * std::sin(wd * t) -
          2 * z * w * wd * std::cos(wd * t)) /
         1000;
}

/// Lines of a table: pulses of three samples, the motion by superposition of impulses.
json table(const std::string& header, const std::vector<double>& taps, double length_s,
           double force = 1, double motion = 1, unsigned seed = 1) {
  std::mt19937_64 bits(seed);
  std::normal_distribution<double> noise(0, 0.2);
  json out{header};
  for (int i = 0; i * kStep < length_s; ++i) {
    double F = 0, a = noise(bits);
    for (const double tap : taps) {
      const int since = i - static_cast<int>(std::lround(tap / kStep));
      const double shape[] = {100, 200, 100};
      if (since >= 0 && since < 3) F += shape[since];
      for (int k = 0; k < 3; ++k) {
        const double t = (since - k) * kStep;
        // The acceleration at the impulse itself is F/m: half of the samples beside it.
        const double m = 6000 / std::pow(2 * M_PI * 450, 2);
        if (since == k) a += shape[k] * (1 / m / 1000 + ringing(0) * kStep / 2);
        if (since > k) a += shape[k] * kStep * ringing(t);
      }
    }
    char line[80];
    std::snprintf(line, sizeof line, "%.4f,%.6g,%.6g", i * kStep, F / force, a / motion);
    out.push_back(line);
  }
  return out;
}

const std::vector<double> kTaps{0.02, 0.33, 0.65};

TEST(ResponseTaps, TheModesOfTheTaps) {
  const json r = told({{"taps", {{"csv", table("t [s],F [N],a [m/s2]", kTaps, 1)}}}});
  expect_modes(r, kOne, 0.05);
  EXPECT_NEAR(r["modes"][0]["frequency_Hz"].get<double>(), 450, 0.45);
  EXPECT_EQ(r["quantity"], "accelerance");
  ASSERT_EQ(r["tap_test"]["taps"].size(), 3U);
  EXPECT_NEAR(r["tap_test"]["taps"][1]["at_s"], 0.33, 2 * kStep);
  EXPECT_NEAR(r["tap_test"]["taps"][1]["peak_N"], 200, 1e-9);
  EXPECT_GT(r["coherence"]["mean"], 0.9);
}

TEST(ResponseTaps, UnitsOfHeadersAndOfTheRequest) {
  const json si = told({{"taps", {{"csv", table("t [s],F [N],a [m/s2]", kTaps, 1)}}}});
  for (const json& taps :
       {json{{"csv", table("time (s),hammer (lbf),acc (g)", kTaps, 1, 4.4482216152605,
                           9.80665)}},
        json{{"csv", table("t,F,y", kTaps, 1, 1000, 1e-3)},
             {"columns", {{"motion", "y"}}},
             {"units", {{"time", "s"}, {"force", "kN"}, {"motion", "mm/s2"}}}}}) {
    const json r = told({{"taps", taps}});
    EXPECT_NEAR(r["modes"][0]["stiffness_N_mm"].get<double>() /
                    si["modes"][0]["stiffness_N_mm"].get<double>(),
                1, 1e-4);
  }
}

TEST(ResponseTaps, ATapWithAFaultIsToldByItsNumber) {
  const json r = answer(request(
      {{"taps",
        {{"csv", table("t [s],F [N],a [m/s2]", {0.02, 0.33, 0.345, 0.65}, 1)}}}}));
  expect_modes(r["frf"][0], kOne, 0.05);
  EXPECT_EQ(r["frf"][0]["tap_test"]["taps"][1]["left_out"],
            "double hit, again at 0.345 s");
  EXPECT_EQ(
      r["warnings"][0],
      "/frf/0/taps/csv: tap 2 at 0.33 s counts nowhere: double hit, again at 0.345 s");
}

TEST(ResponseTaps, WithoutATapWithoutFaultItIsRefused) {
  EXPECT_EQ(
      refused({{"taps", {{"csv", table("t [s],F [N],a [m/s2]", {0.1, 0.112}, 0.5)}}}}),
      "stability: /frf/0/taps/csv: got tap 1 at 0.1 s: double hit, again at 0.112 s, "
      "expected a tap without fault");
  EXPECT_EQ(refused({{"taps", {{"csv", table("t [s],F [N],a [m/s2]", {}, 0.5)}}}}),
            "stability: /frf/0/taps/csv: got no tap, expected a force that stands out of "
            "its noise");
}

TEST(ResponseTaps, OneTapAloneIsTold) {
  const json r =
      answer(request({{"taps", {{"csv", table("t [s],F [N],a [m/s2]", {0.02}, 0.4)}}}}));
  EXPECT_FALSE(r["frf"][0].contains("coherence"));
  EXPECT_EQ(r["warnings"][0].get<std::string>().substr(0, 49),
            "/frf/0/taps/csv: one tap alone has no coherence: ");
}

TEST(ResponseTaps, EveryMistakeIsToldWithItsLine) {
  json csv = table("t [s],F [N],a [m/s2]", kTaps, 0.02);
  csv[10] = "0.0009,x,1";
  csv[20] = "0.0019,0";
  csv.erase(30);
  EXPECT_EQ(
      refused({{"taps", {{"csv", csv}}}}),
      R"(stability: /frf/0/taps/csv#line 11/F [N]: got "x", expected a number from -1000000000000 to 1000000000000
stability: /frf/0/taps/csv#line 21: got 2 cells, expected 3 as in the header
stability: /frf/0/taps/csv#line 22/t [s]: got 0.002 s, 0.0002 after the line before, expected even steps of 0.0001 s, or a step back to a new record
stability: /frf/0/taps/csv#line 31/t [s]: got 0.003 s, 0.0002 after the line before, expected even steps of 0.0001 s, or a step back to a new record)");
}

TEST(ResponseTaps, ColumnsAndUnitsThatAreMissing) {
  EXPECT_EQ(
      refused({{"taps", {{"csv", table("t,F [V],b", kTaps, 0.02)}}}}),
      R"(stability: /frf/0/taps/csv#line 1/t: got no unit, expected a unit of time, there or under units
stability: /frf/0/taps/csv#line 1/F [V]: got "V", expected a unit of force, there or under units
stability: /frf/0/taps/csv#line 1: got no column of motion, expected columns of time, force and motion)");
  EXPECT_EQ(
      refused({{"taps", {{"csv", {"t [s],F [N],a [g]", "0,1,2", "1,2,3"}}}}}),
      "stability: /frf/0/taps/csv: got 2 samples, expected at least 64, in rising time");
}

}  // namespace
}  // namespace turnwright::document::response_taps_test
