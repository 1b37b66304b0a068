#include "turnwright/optimise/branch_and_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace turnwright::optimise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Two valleys and a ring that is kept out: not convex in any sense.
template <class T>
T height(const T& x, const T& y) {
  return sqr(sqr(x) - 1.0) + 0.3 * x + sqr(y - 0.2) * 0.7 + 2.0;
}
template <class T>
T ring(const T& x, const T& y) {  // >= 1 outside the ring around (-1, 0.2)
  return 1.0 - (sqr(x + 1.0) + sqr(y - 0.2)) * 4.0;
}

Piece valleys(bool keep_out) {
  Piece p;
  p.box = {Interval(-2, 2), Interval(-2, 2), Interval(0)};
  p.constraints = keep_out ? 1 : 0;
  p.bound = [keep_out](const Box& b, double, Bound& f, std::vector<Bound>& g) {
    const auto x = variable<Interval, 3>(b[0], 0), y = variable<Interval, 3>(b[1], 1);
    f = log(height(x, y));
    g.clear();
    if (keep_out) g.push_back(ring(x, y));
    return true;
  };
  p.value = [keep_out](const Point& y, double& f, std::vector<double>& g) {
    f = std::log(height(y[0], y[1]));
    g.clear();
    if (keep_out) g.push_back(ring(y[0], y[1]));
  };
  p.try_point = [keep_out](const Box& b) {
    const double x = mid(b[0]), y = mid(b[1]);
    return keep_out && ring(x, y) > 0 ? kInfinity : std::log(height(x, y));
  };
  return p;
}

double best_on_grid(bool keep_out) {
  double best = kInfinity;
  for (int i = 0; i <= 2000; ++i)
    for (int j = 0; j <= 2000; ++j) {
      const double x = -2 + 0.002 * i, y = -2 + 0.002 * j;
      if (!(keep_out && ring(x, y) > 0)) best = std::min(best, std::log(height(x, y)));
    }
  return best;
}

TEST(BranchAndBound, BracketsTheGlobalMinimumOfTwoValleys) {
  for (const bool keep_out : {false, true}) {
    std::vector<Piece> pieces{valleys(keep_out)};
    const auto r = branch_and_bound(pieces, kInfinity);
    const double grid = best_on_grid(keep_out);
    ASSERT_TRUE(r.complete);
    EXPECT_LE(r.lower_bound, grid);
    EXPECT_LE(grid - r.lower_bound, keep_out ? 2e-4 : 5e-5);  // ring cut by a 2e-3 grid
    EXPECT_LE(r.upper_bound - r.lower_bound, 2.001e-5);
    EXPECT_LT(r.nodes, 5000);
  }
}

TEST(BranchAndBound, TakesTheBetterPieceAndBoundsTheOther) {
  auto dearer = valleys(false);
  dearer.box[0] = Interval(0.2, 2);  // only the shallow valley
  std::vector<Piece> pieces{dearer, valleys(false)};
  const auto r = branch_and_bound(pieces, kInfinity);
  std::vector<Piece> alone{valleys(false)};
  EXPECT_NEAR(r.lower_bound, branch_and_bound(alone, kInfinity).lower_bound, 2e-5);
  EXPECT_GE(r.piece_bounds[0], r.lower_bound);
}

// A piece that drops a box by its first functions says nothing of the others.
TEST(BranchAndBound, ABoxThatIsExcludedNeedsNoFurtherFunctions) {
  auto whole = valleys(true), brief = whole;
  int left_out = 0;
  brief.bound = [&, bound = whole.bound](const Box& b, double cut, Bound& f,
                                         std::vector<Bound>& g) {
    bound(b, cut, f, g);
    if (!excludes(f, cut)) return true;
    ++left_out;
    g.clear();
    return false;
  };
  std::vector<Piece> one{whole}, other{brief};
  const auto a = branch_and_bound(one, kInfinity), b = branch_and_bound(other, kInfinity);
  EXPECT_EQ(a.lower_bound, b.lower_bound);
  EXPECT_EQ(a.upper_bound, b.upper_bound);
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_GT(left_out, 0);
}

TEST(BranchAndBound, ProvesThatNothingIsFeasible) {
  auto p = valleys(true);
  p.box = {Interval(-1.2, -0.8), Interval(0.1, 0.3), Interval(0)};  // inside the ring
  std::vector<Piece> pieces{p};
  const auto r = branch_and_bound(pieces, kInfinity);
  EXPECT_TRUE(r.complete);
  EXPECT_EQ(r.lower_bound, kInfinity);
  EXPECT_EQ(r.upper_bound, kInfinity);
}

TEST(BranchAndBound, SaysWhatItKnowsWhenTheBudgetEnds) {
  std::vector<Piece> pieces{valleys(true)};
  const auto r = branch_and_bound(pieces, kInfinity, {.gap = 1e-9, .max_nodes = 60});
  EXPECT_FALSE(r.complete);
  EXPECT_LE(r.lower_bound, best_on_grid(true));
}

TEST(BranchAndBound, ALagrangianSavesBoxesAndChangesNoAnswer) {
  // min x + y, x y >= 1 (as 1/(x y) <= 1) over [0.1, 10]^2: optimum 2 at (1, 1).
  Piece p;
  p.box = {Interval(std::log(0.1), std::log(10)), Interval(std::log(0.1), std::log(10)),
           Interval(0)};
  p.constraints = 1;
  p.bound = [](const Box& b, double, Bound& f, std::vector<Bound>& g) {
    const auto u = variable<Interval, 3>(b[0], 0), v = variable<Interval, 3>(b[1], 1);
    f = log(exp(u) + exp(v));
    g.assign(1, -u - v);
    return true;
  };
  p.value = [](const Point& y, double& f, std::vector<double>& g) {
    f = std::log(std::exp(y[0]) + std::exp(y[1]));
    g.assign(1, -y[0] - y[1]);
  };
  std::vector<Piece> plain{p}, helped{p};
  helped[0].combinations = {{1.0, {0.5}}};
  const auto a = branch_and_bound(plain, std::log(2.0));
  const auto b = branch_and_bound(helped, std::log(2.0));
  EXPECT_NEAR(a.lower_bound, std::log(2.0), 2.1e-5);
  EXPECT_NEAR(b.lower_bound, std::log(2.0), 2.1e-5);
  EXPECT_LE(b.lower_bound, std::log(2.0));
  EXPECT_LT(4 * b.nodes, a.nodes);
}

TEST(BranchAndBound, ASmoothFunctionBelowACornerEndsTheSearchSooner) {
  // f = max(u, v) with u = y0 + y1^2, v = -y0 + y1^2: a corner along y0 = 0, least 0.
  // (u + v)/2 lies below both and is flat where f is least.
  const auto piece = [](bool smooth) {
    Piece p;
    p.box = {Interval(-1, 1.1), Interval(-1, 1.2), Interval(0)};
    p.bound = [smooth](const Box& b, double, Bound& f, std::vector<Bound>& g) {
      const auto x = variable<Interval, 3>(b[0], 0), y = variable<Interval, 3>(b[1], 1);
      f = max(x + sqr(y), sqr(y) - x);
      g.clear();
      if (smooth) g.push_back(sqr(y));
      return true;
    };
    p.value = [smooth](const Point& y, double& f, std::vector<double>& g) {
      f = std::abs(y[0]) + sqr(y[1]);
      g.clear();
      if (smooth) g.push_back(sqr(y[1]));
    };
    if (smooth) p.combinations = {{1.0, {}}};
    return p;
  };
  std::vector<Piece> plain{piece(false)}, helped{piece(true)};
  const auto a = branch_and_bound(plain, 0.0), b = branch_and_bound(helped, 0.0);
  EXPECT_NEAR(a.lower_bound, 0, 2.1e-5);
  EXPECT_NEAR(b.lower_bound, 0, 2.1e-5);
  EXPECT_LE(b.lower_bound, 0);
  EXPECT_LT(2 * b.nodes, a.nodes);
}

TEST(Interval, EnclosesRandomExpressions) {
  std::mt19937 seed(11);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 4000; ++trial) {
    const double a = 0.1 + 2 * unit(seed), b = a + unit(seed);
    const double c = -1 + unit(seed), d = c + unit(seed);
    const double x = a + unit(seed) * (b - a), y = c + unit(seed) * (d - c);
    const Interval X(a, b), Y(c, d);
    const auto holds = [&](const Interval& box, double value) {
      EXPECT_LE(box.lo, value + 1e-13);
      EXPECT_GE(box.hi, value - 1e-13);
    };
    holds(X * Y - Y / X, x * y - y / x);
    holds(pow(X, -1.7) + sqr(Y), std::pow(x, -1.7) + y * y);
    holds(exp(Y) * log(X) - sqrt(X), std::exp(y) * std::log(x) - std::sqrt(x));
    holds(acos(Y), std::acos(y));
    holds(min(X, Y + Interval(1)) * max(X, Y), std::min(x, y + 1) * std::max(x, y));
  }
}

}  // namespace
}  // namespace turnwright::optimise
