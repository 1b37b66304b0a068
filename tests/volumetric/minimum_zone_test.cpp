#include "turnwright/volumetric/minimum_zone.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <stop_token>

#include "turnwright/base/cancelled.hpp"

namespace turnwright::volumetric {
namespace {

struct Points {
  std::vector<double> basis, values;
  std::size_t columns;
};

Points random_points(std::mt19937& random, std::size_t n, std::size_t columns) {
  std::normal_distribution<> gauss;
  Points p{{}, {}, columns};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < columns; ++j) p.basis.push_back(gauss(random));
    p.values.push_back(gauss(random));
  }
  return p;
}

// Best approximation on every m + 1 points; the widest of them is the zone
// (de la Vallee Poussin): no point set needs more than all, and all need no more.
double by_all_references(const Points& p) {
  const auto n = p.values.size(), m = p.columns + 1;
  std::vector<bool> chosen(n, false);
  std::fill_n(chosen.begin(), m + 1, true);
  double widest = 0;
  do {
    Eigen::MatrixXd A(m + 1, m);
    Eigen::VectorXd v(m + 1);
    for (std::size_t i = 0, row = 0; i < n; ++i) {
      if (!chosen[i]) continue;
      const auto r = static_cast<Eigen::Index>(row++);
      A(r, 0) = 1;
      for (std::size_t j = 0; j < p.columns; ++j)
        A(r, static_cast<Eigen::Index>(j + 1)) = p.basis[i * p.columns + j];
      v[r] = p.values[i];
    }
    const Eigen::VectorXd dependence =
        Eigen::FullPivLU<Eigen::MatrixXd>(A.transpose()).kernel().col(0);
    widest = std::max(widest, 2 * std::abs(dependence.dot(v)) / dependence.lpNorm<1>());
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return widest;
}

TEST(MinimumZone, IsTheWidestOfAllReferences) {
  std::mt19937 random(1);
  for (std::size_t columns = 1; columns <= 4; ++columns)
    for (int i = 0; i < 20; ++i) {
      const Points p = random_points(random, 9, columns);
      const Zone zone = minimum_zone(p.basis, columns, p.values);
      EXPECT_NEAR(zone.width, by_all_references(p), 1e-12);
    }
}

TEST(MinimumZone, KnownShapes) {
  // Straightness of a parabola z^2 on [-1, 1]: Chebyshev's 1, against 1 of least squares.
  std::vector<double> z, v;
  for (int i = -100; i <= 100; ++i) {
    z.push_back(i / 100.0);
    v.push_back(z.back() * z.back() + 3 * z.back() + 7);
  }
  const Zone line = minimum_zone(z, 1, v);
  EXPECT_NEAR(line.width, 1, 1e-12);
  EXPECT_NEAR(line.parameters[0], 7.5, 1e-12);
  EXPECT_NEAR(line.parameters[1], 3, 1e-12);
  // Three lobes of amplitude 1 and any eccentricity: 2.
  std::vector<double> circle, r;
  for (int i = 0; i < 360; ++i) {
    const double t = i * std::acos(-1.0) / 180;
    circle.insert(circle.end(), {std::cos(t), std::sin(t)});
    r.push_back(std::cos(3 * t) + 5 * std::cos(t) - 2 * std::sin(t));
  }
  EXPECT_NEAR(minimum_zone(circle, 2, r).width, 2, 1e-12);
}

TEST(MinimumZone, NeverExceedsLeastSquares) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const Points p = random_points(random, 5 + i, 1 + static_cast<std::size_t>(i) % 5);
    EXPECT_LE(minimum_zone(p.basis, p.columns, p.values).width,
              least_squares_zone(p.basis, p.columns, p.values).width);
  }
}

TEST(MinimumZone, DoesNotDependOnTheOrderOfPoints) {
  std::mt19937 random(9);
  for (int i = 0; i < 20; ++i) {
    Points p = random_points(random, 300, 3);
    const double width = minimum_zone(p.basis, 3, p.values).width;
    for (std::size_t n = 0; n < 150; ++n) {
      std::swap(p.values[n], p.values[299 - n]);
      for (std::size_t j = 0; j < 3; ++j)
        std::swap(p.basis[3 * n + j], p.basis[3 * (299 - n) + j]);
    }
    EXPECT_NEAR(minimum_zone(p.basis, 3, p.values).width, width, 1e-12);
  }
}

/// Points at places from `from` to `from` + 1, with the basis of a cylinder's form.
Points short_cylinder(double from) {
  Points p{{}, {}, 4};
  for (int i = 0; i < 24; ++i)
    for (int j = 0; j < 5; ++j) {
      const double t = std::numbers::pi * i / 12, z = from + 0.25 * j;
      for (const double x : {std::cos(t), std::sin(t), z * std::cos(t), z * std::sin(t)})
        p.basis.push_back(x);
      p.values.push_back(0.1 * std::cos(2 * t + j) + 0.01 * std::sin(t * j));
    }
  return p;
}

TEST(MinimumZone, ColumnsThatNearlyDependOnEachOtherChangeNothing) {
  const Points near = short_cylinder(0), far = short_cylinder(1e6);
  EXPECT_NEAR(minimum_zone(far.basis, 4, far.values).width,
              minimum_zone(near.basis, 4, near.values).width, 1e-8);
}

TEST(MinimumZone, HearsThatNobodyWaits) {
  std::stop_source source;
  source.request_stop();
  const std::stop_token token = source.get_token();
  const Listening listening(token);
  const Points p = short_cylinder(0);
  EXPECT_THROW(minimum_zone(p.basis, 4, p.values), Cancelled);
}

TEST(MinimumZone, DegenerateInput) {
  EXPECT_EQ(minimum_zone({}, 0, std::vector{1.0, 4.0, 2.0}).width, 3);
  EXPECT_EQ(minimum_zone(std::vector{5.0}, 1, std::vector{3.0}).width, 0);
  // A grid on one line is no plane: the second column depends on the first.
  const std::vector<double> twice = {0, 0, 1, 2, 2, 4, 3, 6};
  EXPECT_NEAR(minimum_zone(twice, 2, std::vector{0.0, 1.0, 1.0, 0.0}).width, 1, 1e-12);
  // Values of the model itself, at a lattice full of equal references.
  std::vector<double> grid, plane;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) {
      grid.insert(grid.end(), {static_cast<double>(i), static_cast<double>(j)});
      plane.push_back(1 + 2.0 * i - 0.5 * j + ((i + j) % 2 == 0 ? 1e-3 : -1e-3));
    }
  EXPECT_NEAR(minimum_zone(grid, 2, plane).width, 2e-3, 1e-12);
  EXPECT_THROW(minimum_zone({}, 0, {}), std::domain_error);
  EXPECT_THROW(minimum_zone(std::vector{1.0}, 1, std::vector{1.0, 2.0}),
               std::domain_error);
  EXPECT_THROW(minimum_zone(std::vector{std::nan("")}, 1, std::vector{1.0}),
               std::domain_error);
}

}  // namespace
}  // namespace turnwright::volumetric
