#include <gtest/gtest.h>

#include <cmath>

#include "oracle.hpp"
#include "turnwright/optimise/local.hpp"
#include "variants.hpp"

/// Nothing that keeps the limits of a problem is below its certificate.
namespace turnwright::multipass {
namespace {

struct Feasible {
  const Oracle& o;
  optimise::Problem problem;
  explicit Feasible(const Oracle& oracle) : o(oracle) {
    const Span s = span(o);
    problem.lower.assign(s.lower.begin(), s.lower.end());
    problem.upper.assign(s.upper.begin(), s.upper.end());
    std::vector<double> g;
    o.limits(s.lower, g);
    problem.constraints = g.size();
    problem.evaluate = [this](std::span<const double> x, optimise::Values& out) {
      Five y;
      std::copy(x.begin(), x.end(), y.begin());
      out.f = std::log(o.cost(y));
      o.limits(y, out.g);
      std::vector<double> up, down;
      for (std::size_t j = 0; j < 5; ++j) {  // central differences
        Five a = y, b = y;
        a[j] -= 1e-6, b[j] += 1e-6;
        out.df[j] = (std::log(o.cost(b)) - std::log(o.cost(a))) / 2e-6;
        o.limits(a, down);
        o.limits(b, up);
        for (std::size_t i = 0; i < up.size(); ++i)
          out.dg[i * 5 + j] = (up[i] - down[i]) / 2e-6;
      }
    };
  }
};

constexpr double kRounding = 1e-13;  // ln(6 - 3) and ln 3 differ by that
constexpr int kPoints = 100000, kSolves = 200;

/// A walk through the allowed points: a draw from a line through where it stands, as long
/// as the box or a millionth of it, that closes in on that place until it is allowed.
/// The lines leave some coordinates as they are, or the life of a pass: so they reach
/// what a box hardly ever hits, depths that just add up and lives that are prescribed.
struct Walk {
  const Oracle& o;
  Span box;
  Five at;
  std::mt19937 seed{9};
  double over = o.worst(at);  // the optimum it starts from may be 1e-9 outside
  int allowed = 0;
  double least = std::numeric_limits<double>::infinity();

  double draw(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(seed);
  }
  Five direction() {
    const double share = draw(0, 1);
    Five d{};
    for (auto& x : d)
      if (draw(0, 1) < share) x = draw(-1, 1);
    if (draw(0, 1) < 0.3) {  // of equal life while the depth is as it is
      d[2] = 0;
      d[0] = -d[1] * o.m.q / o.m.p;
      d[3] = -d[4] * o.m.q / o.m.p;
    }
    return d;
  }
  void step() {
    const Five d = direction();
    const double reach = std::pow(10, draw(-6, 0));
    double lower = -reach, upper = reach;
    for (int k = 0; k < 12; ++k) {
      const double t = draw(lower, upper);
      Five y = at;
      for (std::size_t j = 0; j < 5; ++j)
        y[j] = std::clamp(y[j] + t * d[j], box.lower[j], box.upper[j]);
      const double w = o.worst(y);
      if (w > std::max(over, kRounding)) {
        (t < 0 ? lower : upper) = t;
        continue;
      }
      at = y;
      over = w;
      if (w > kRounding) return;
      ++allowed;
      least = std::min(least, o.cost(y));
      return;
    }
  }
};

struct Solves {
  int found = 0;
  double least = std::numeric_limits<double>::infinity();
};

Solves local_solves(const Oracle& o) {
  const Feasible local(o);
  const Span s = span(o);
  std::mt19937 seed(11);
  std::uniform_real_distribution<double> unit(0, 1);
  Solves all;
  for (int k = 0; k < kSolves; ++k) {
    std::vector<double> start(5);
    for (std::size_t j = 0; j < 5; ++j)
      start[j] = s.lower[j] + unit(seed) * (s.upper[j] - s.lower[j]);
    const auto r = optimise::local_minimum(local.problem, start);
    if (r.status == optimise::Status::no_feasible_point_met) continue;
    ++all.found;
    all.least = std::min(all.least, std::exp(r.f));
  }
  return all;
}

/// The variants, plain problems, and some drawn at random.
std::vector<Problem> problems() {
  std::vector<Problem> all;
  for (const auto& v : variants()) all.push_back(v.m);
  for (const double dt : {6., 8.})
    for (const Cost cost : {Cost::literal, Cost::physical})
      all.push_back(literature(dt, cost));
  all.push_back(literature(10, Cost::literal));
  all.back().PU = 3.5;
  all.back().k5 = 0.5;
  for (unsigned k = 0; k < 12; ++k) {
    std::mt19937 seed(k);
    all.push_back(random_problem(seed));
  }
  return all;
}

class Certificate : public testing::TestWithParam<std::size_t> {};

TEST_P(Certificate, HoldsForEveryAllowedPointAndLocalSolve) {
  const Problem m = problems()[GetParam()];
  const Answer a = optimum(m);
  if (!a.best) return;  // drawn impossible
  EXPECT_LE(a.gap, kGap);
  const Oracle o{m, static_cast<double>(a.best->n)};
  Walk walk{o, span(o), point(*a.best)};
  for (int k = 0; walk.allowed < kPoints && k < 5 * kPoints; ++k) walk.step();
  EXPECT_EQ(walk.allowed, kPoints);
  EXPECT_GE(walk.least, a.lower_bound * (1 - 100 * kRounding));
  const auto solves = local_solves(o);
  EXPECT_GE(solves.found, kSolves / 10);
  EXPECT_GE(solves.least, a.lower_bound * (1 - kFeasibility));
}

INSTANTIATE_TEST_SUITE_P(Problems, Certificate,
                         testing::Range<std::size_t>(0, problems().size()));

}  // namespace
}  // namespace turnwright::multipass
