#include "turnwright/volumetric/linuxcnc_compensation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace turnwright::volumetric::linuxcnc_compensation_test {
namespace {

using Points = std::vector<CompensationPoint>;

/// LinuxCNC with a compensation file: rows as they are loaded, trims as they are interpolated.
/// Written here after its sources, apart from what comp_file() does.
class Joint {
 public:
  Joint(const std::string& file, int comp_file_type) {
    std::istringstream in(file);
    double nominal = 0, forward = 0, reverse = 0;
    while (in >> nominal >> forward >> reverse) {
      if (rows_.size() == 256 || (!rows_.empty() && nominal <= rows_.back()[0]))
        throw std::runtime_error("a row that LinuxCNC refuses");
      if (comp_file_type == 0) {
        forward = nominal - forward;
        reverse = nominal - reverse;
      }
      rows_.push_back({nominal, forward, reverse});
    }
  }
  std::size_t rows() const { return rows_.size(); }

  /// Where the motor is sent for a commanded position.
  double motor(double commanded, double velocity) const {
    return commanded + trim(commanded, velocity > 0 ? 1 : 2);
  }

 private:
  double trim(double p, std::size_t column) const {
    if (p <= rows_.front()[0]) return rows_.front()[column];
    for (std::size_t i = 1; i < rows_.size(); ++i)
      if (p < rows_[i][0]) {
        const double share = (p - rows_[i - 1][0]) / (rows_[i][0] - rows_[i - 1][0]);
        return rows_[i - 1][column] + share * (rows_[i][column] - rows_[i - 1][column]);
      }
    return rows_.back()[column];
  }
  std::vector<std::array<double, 3>> rows_;
};

/// An axis with a scale of 40 um/m, a bow and 8 um of lost motion; the deviation of the tool
/// where the motor is.
double deviation(double motor_mm, double velocity) {
  const double t = motor_mm / 300;
  return 0.012 * t - 0.006 * t * t + (velocity > 0 ? -0.004 : 0.004);
}

Points calibrated(double from, double to, int rows) {
  Points out;
  for (int i = 0; i < rows; ++i) {
    const double q = from + (to - from) * i / (rows - 1);
    out.push_back({q, deviation(q, 1), deviation(q, -1)});
  }
  return out;
}

// Ends of the same axis, in both units and types: what is left is the bow between two rows,
// 0.006 (5/300)^2/2 /4 um, and products of errors.
TEST(LinuxCncCompensation, CorrectsTheAxis) {
  for (const double unit : {1.0, 25.4})
    for (const auto type : {CompFileType::actual, CompFileType::trim}) {
      const std::string file = comp_file(calibrated(0, 300, 61), type, unit);
      const Joint joint(file, type == CompFileType::actual ? 0 : 1);
      EXPECT_EQ(joint.rows(), 61u);
      for (const double velocity : {1.0, -1.0}) {
        double most = 0;
        for (double p = 0; p <= 300; p += 0.37) {
          const double motor = unit * joint.motor(p / unit, velocity);
          most = std::max(most, std::abs(motor + deviation(motor, velocity) - p));
        }
        EXPECT_LT(most, 3e-6)
            << unit;  // 1 nm of rounding, 1 of the second order, 0.4 of bow
        EXPECT_GT(std::abs(deviation(150, velocity)), 5e-4);
      }
    }
}

// Where LinuxCNC 2.9 itself sent the motor (joint.0.motor-pos-cmd, seven digits) by each of
// these moves, one after the other, with the file of either type.
TEST(LinuxCncCompensation, LinuxCncItselfMovesThus) {
  const Points points{{0, 0.00012, 0.00406},   {57, 0.00244, 0.00626},
                      {121, 0.00456, 0.00846}, {178, 0.00638, 0.01032},
                      {243, 0.00858, 0.01228}, {300, 0.01044, 0.01408}};
  struct Moved {
    double to, motor;
  };
  for (const auto type : {CompFileType::actual, CompFileType::trim}) {
    const Joint joint(comp_file(points, type, 1), type == CompFileType::actual ? 0 : 1);
    double before = 0;
    for (const auto& [to, motor] :
         {Moved{28.5, 28.49872}, Moved{100, 99.99614}, Moved{57, 56.99374},
          Moved{200, 199.9929}, Moved{310, 309.9896}, Moved{250, 249.9875},
          Moved{121, 120.9915}, Moved{60, 59.99364}, Moved{10, 9.995554},
          Moved{-3, -3.00406}, Moved{0, -0.00012}, Moved{150, 149.9945}}) {
      const double half_digit = std::abs(to) < 10    ? 5.1e-7
                                : std::abs(to) < 100 ? 5.1e-6
                                                     : 5.1e-5;
      EXPECT_NEAR(joint.motor(to, to - before), motor, half_digit) << to;
      before = to;
    }
  }
}

TEST(LinuxCncCompensation, SignsAreThoseOfTheDocumentation) {
  const Points one{{-1, -0.005, 0.005}, {0, 0.002, -0.003}};
  EXPECT_EQ(comp_file(one, CompFileType::actual, 1),
            "-1.000000 -1.005000 -0.995000\n0.000000 0.002000 -0.003000\n");
  EXPECT_EQ(comp_file(one, CompFileType::trim, 1),
            "-1.000000 0.005000 -0.005000\n0.000000 -0.002000 0.003000\n");
  EXPECT_EQ(comp_file(Points{{25.4, 0.0254, 0}}, CompFileType::trim, 25.4),
            "1.0000000 -0.0010000 0.0000000\n");
  EXPECT_EQ(comp_file(Points{{-1e-9, 1e-9, -1e-9}}, CompFileType::actual, 1),
            "0.000000 0.000000 0.000000\n");
}

TEST(LinuxCncCompensation, WhatIsWrittenIsReadBack) {
  std::mt19937 random(7);
  std::uniform_real_distribution<> step(0.01, 30), error(-0.05, 0.05);
  for (const double unit : {1.0, 25.4})
    for (const auto type : {CompFileType::actual, CompFileType::trim}) {
      Points points;
      double at = -200;
      for (std::size_t i = 0; i < kCompFileRows; ++i)
        points.push_back({at += step(random), error(random), error(random)});
      const std::string file = comp_file(points, type, unit);
      std::istringstream in(file);
      std::size_t row = 0;
      for (std::string line; std::getline(in, line); ++row) {
        const auto read = comp_file_point(line, type, unit);
        ASSERT_TRUE(read) << line;
        EXPECT_NEAR(read->nominal_mm, points[row].nominal_mm, 1.3e-6);
        EXPECT_NEAR(read->plus_mm, points[row].plus_mm, 2.6e-6);
        EXPECT_NEAR(read->minus_mm, points[row].minus_mm, 2.6e-6);
      }
      EXPECT_EQ(row, kCompFileRows);
    }
}

TEST(LinuxCncCompensation, LinesAreReadAsLinuxCncReadsThem) {
  const auto point = [](const char* line) {
    return comp_file_point(line, CompFileType::actual, 1);
  };
  const auto read = point("\t1.5e1  +15.01 14.99 and more");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->nominal_mm, 15);
  EXPECT_NEAR(read->plus_mm, 0.01, 1e-14);
  EXPECT_NEAR(read->minus_mm, -0.01, 1e-14);
  for (const char* line : {"", "  ", "# nominal", "1 2", "1 2 x", "nan 1 1", "1 inf 1",
                           "+-1 1 1", "1,0 1,0 1,0"})
    EXPECT_FALSE(point(line)) << line;
}

TEST(LinuxCncCompensation, RefusesWhatLinuxCncWouldNotTake) {
  EXPECT_THROW(comp_file({}, CompFileType::actual, 1), std::domain_error);
  EXPECT_THROW(comp_file(Points(257), CompFileType::actual, 1), std::domain_error);
  EXPECT_THROW(comp_file(Points{{0, 0, 0}, {0, 0, 0}}, CompFileType::actual, 1),
               std::domain_error);
  EXPECT_THROW(comp_file(Points{{1, 0, 0}, {1 + 1e-8, 0, 0}}, CompFileType::actual, 1),
               std::domain_error);
  EXPECT_THROW(comp_file(Points{{1, 0, 0}, {0, 0, 0}}, CompFileType::actual, 1),
               std::domain_error);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(comp_file(Points{{nan, 0, 0}, {1, 0, 0}}, CompFileType::actual, 1),
               std::domain_error);
}

}  // namespace
}  // namespace turnwright::volumetric::linuxcnc_compensation_test
