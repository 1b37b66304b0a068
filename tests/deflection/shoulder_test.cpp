#include "turnwright/deflection/shoulder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "random_shafts.hpp"
#include "turnwright/deflection/workpiece.hpp"

namespace turnwright::deflection {
namespace {

using part::Segment;

void expect_shape(const std::vector<Segment>& got, const std::vector<Segment>& expected) {
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_NEAR(got[i].length_mm, expected[i].length_mm, 1e-12) << i;
    EXPECT_NEAR(got[i].outer_left_mm, expected[i].outer_left_mm, 1e-12) << i;
    EXPECT_NEAR(got[i].outer_right_mm, expected[i].outer_right_mm, 1e-12) << i;
    EXPECT_NEAR(got[i].inner_left_mm, expected[i].inner_left_mm, 1e-12) << i;
    EXPECT_NEAR(got[i].inner_right_mm, expected[i].inner_right_mm, 1e-12) << i;
  }
}

TEST(Shoulder, TableLinearBetweenAndHeldAtTheEnds) {
  EXPECT_EQ(shoulder_lambda(0.85), 0.035);
  EXPECT_EQ(shoulder_lambda(0.7), 0.105);
  EXPECT_EQ(shoulder_lambda(0.6), 0.145);
  EXPECT_EQ(shoulder_lambda(0.5), 0.17);
  EXPECT_EQ(shoulder_lambda(0.4), 0.19);
  EXPECT_EQ(shoulder_lambda(0.3), 0.205);
  EXPECT_NEAR(shoulder_lambda(0.65), 0.125, 1e-15);
  EXPECT_NEAR(shoulder_lambda(0.35), 0.1975, 1e-15);
  EXPECT_EQ(shoulder_lambda(0.1), 0.205);
  EXPECT_EQ(shoulder_lambda(0.99), 0.035);
  EXPECT_EQ(shoulder_lambda(1), 0);
  for (const double bad : {0.0, 1.01, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(shoulder_lambda(bad), std::domain_error);
}

TEST(Shoulder, TheThinSectionReachesIntoTheThickOneOnEitherSide) {
  // d/D = 0.5: lambda d = 0.17 20 = 3.4
  expect_shape(
      shoulder_corrected(std::vector<Segment>{{80, 40, 40, 0, 0}, {100, 20, 20, 0, 0}}),
      {{76.6, 40, 40, 0, 0}, {3.4, 20, 20, 0, 0}, {100, 20, 20, 0, 0}});
  expect_shape(
      shoulder_corrected(std::vector<Segment>{{50, 20, 20, 6, 6}, {80, 40, 30, 10, 10}}),
      {{50, 20, 20, 6, 6}, {3.4, 20, 20, 6, 6}, {76.6, 40 - 10 * 3.4 / 80, 30, 10, 10}});
}

TEST(Shoulder, NoStepNoChange) {
  const std::vector<Segment> smooth{{80, 40, 30, 0, 5}, {60, 30, 30, 20, 20}};
  expect_shape(shoulder_corrected(smooth), smooth);
}

TEST(Shoulder, AtMostTheThickLength) {
  // a collar of 2 mm: 3.4 from the right is cut to 2, 0.035 36 = 1.26 from the left lies
  // within it; the thinner section stands
  expect_shape(shoulder_corrected(std::vector<Segment>{
                   {50, 36, 36, 0, 0}, {2, 40, 40, 0, 0}, {50, 20, 20, 0, 0}}),
               {{50, 36, 36, 0, 0},
                {1.26, 20, 20, 0, 0},
                {0.74, 20, 20, 0, 0},
                {50, 20, 20, 0, 0}});
  // a cone, and one that is thinner than d after 2.5 mm
  expect_shape(
      shoulder_corrected(std::vector<Segment>{{50, 20, 20, 0, 0}, {4, 40, 60, 0, 0}}),
      {{50, 20, 20, 0, 0}, {3.4, 20, 20, 0, 0}, {0.6, 57, 60, 0, 0}});
  expect_shape(
      shoulder_corrected(std::vector<Segment>{{50, 20, 20, 0, 0}, {4, 40, 8, 0, 0}}),
      {{50, 20, 20, 0, 0}, {2.5, 20, 20, 0, 0}, {1.5, 20, 8, 0, 0}});
}

TEST(Shoulder, CuttingSegmentsInTwoChangesNothing) {
  for (const auto& [name, shaft] : random_shafts::all(23)) {
    part::Shaft halves = shaft, one = shaft;
    halves.segments.clear();
    for (const Segment& s : shaft.segments) {
      const auto [left, right] = part::split(s, 0.02 * s.length_mm);
      halves.segments.insert(halves.segments.end(), {left, right});
    }
    one.segments = shoulder_corrected(shaft.segments);
    halves.segments = shoulder_corrected(halves.segments);
    const Beam x(one), y(halves);
    for (const double u : {0.2, 0.6, 1.0}) {
      const double a = u * x.length_mm();
      EXPECT_NEAR(y.at(a, {}).f_ww_mm_N / x.at(a, {}).f_ww_mm_N, 1, 1e-9) << name;
    }
  }
}

/// Stepped cantilevers by scripts/calculix_study.py: deflection at the load per newton.
struct Cantilever {
  std::string name;
  part::Shaft shaft;
  std::vector<double> f_mm_N;  ///< coarse to fine meshes
};

std::vector<Cantilever> three_dimensional() {
  const auto file = nlohmann::json::parse(
      std::ifstream(TURNWRIGHT_SOURCE_DIR "/tests/data/stepped_cantilevers.json"));
  std::vector<Cantilever> all;
  for (const auto& c : file.at("cases")) {
    Cantilever one{c.at("name"), {file.at("E_MPa"), file.at("nu"), {}}, {}};
    for (const auto& s : c.at("segments")) {
      const double d = s.at("diameter_mm");
      one.shaft.segments.push_back({s.at("length_mm"), d, d, 0, 0});
    }
    for (const auto& mesh : c.at("meshes")) one.f_mm_N.push_back(mesh.at("f_mm_N"));
    all.push_back(std::move(one));
  }
  return all;
}

/// How far the beam is off, in parts of the three-dimensional deflection.
double off(const Cantilever& c, bool shoulder_correction) {
  const Workpiece part(c.shaft, {.shoulder_correction = shoulder_correction});
  const double end = part.length_mm();
  Flexibility f;
  part.at({&end, 1}, {Method::chuck, {}, 0, 0}, {&f, 1});
  return f.f_ww_mm_N / c.f_mm_N.back() - 1;
}

TEST(Shoulder, ThreeDimensionalElasticityWithinThreePercent) {
  double plain = 0;
  std::size_t stepped = 0;
  for (const Cantilever& c : three_dimensional()) {
    EXPECT_LE(std::abs(off(c, true)), 0.03) << c.name;
    EXPECT_LE(off(c, false), off(c, true)) << c.name;
    plain = std::min(plain, off(c, false));
    stepped += c.shaft.segments.size() > 1;
  }
  EXPECT_GE(stepped, 6u);
  // what the correction is for: without it up to a fifth is missing
  EXPECT_LT(plain, -0.15);
  EXPECT_GT(plain, -0.21);
}

TEST(Shoulder, ACylinderIsTheSameInThreeDimensions) {
  // what supports and load alone differ from a beam's
  const auto all = three_dimensional();
  ASSERT_EQ(all.front().shaft.segments.size(), 1u);
  EXPECT_LE(std::abs(off(all.front(), false)), 0.002);
}

TEST(Shoulder, TheMeshesHaveConverged) {
  std::size_t refined = 0;
  for (const Cantilever& c : three_dimensional())
    if (const std::size_t n = c.f_mm_N.size(); n > 1) {
      ++refined;
      EXPECT_NEAR(c.f_mm_N[n - 2] / c.f_mm_N[n - 1], 1, 1e-3) << c.name;
    }
  EXPECT_GE(refined, 1u);
}

}  // namespace
}  // namespace turnwright::deflection
