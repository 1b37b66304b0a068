#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "../parts.hpp"
#include "planning/preparation/assignment.hpp"
#include "planning/surface/surface_optimiser.hpp"

// The physics of a surface as a problem: gradients against differences, boxes against
// points, feedback against its own equation.
namespace turnwright::planning {
namespace {

// Every element of a part with every pair of its tools, one and two roughing passes, and
// tolerances asked at three places.
class Surfaces : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { prepare(1); }

  void prepare(double power) {
    models_.clear();
    plan_ = part(reference_part(GetParam()));
    for (auto& point : plan_.machine.curve) point.P_kW *= power, point.M_Nm *= power;
    const auto work = assign(plan_);
    auto done = nothing_finished(plan_.drawing);
    for (std::size_t s = 0; s < work.setups.size(); ++s) {
      for (const auto clamping : plan_.setups[s].clampings)
        for (const std::size_t i : work.setups[s].elements)
          add(MachinedSurface::element(plan_, s, clamping, work.setups[s], done, i, {}));
      if (work.setups[s].end_face) add(MachinedSurface::end_face(plan_, s, done, {}));
      finish(done, work.setups[s]);
    }
    ASSERT_GT(models_.size(), 5u);
  }

  void add(const MachinedSurface& f) {
    const catalogue::Tool *rough = &plan_.tools.front(), *finish = rough;
    for (const auto& t : plan_.tools)
      if (t.uses.front() == catalogue::ToolUse::finishing) finish = &t;
    const double low = f.low_mm(), high = f.high_mm();
    for (const Recipe& r :
         {Recipe{rough, finish, 1, 1, 0, 0}, Recipe{rough, finish, 2, 1, 0, 0}}) {
      auto chain = f.chain(r, {1.3, 1}, {low, (low + high) / 2, high});
      if (!chain) continue;
      chain->functionals = {{{{0, 2.0}}, 0.02, 0},
                            {{{0, 1.0}, {2, -1.0}}, 0.01, 0},
                            {{{1, 1.0}, {0, -0.5}, {2, -0.5}}, 0.004, 0}};
      f.limit_chatter(*chain);
      models_.push_back(std::make_unique<RecipeModel>(r, std::move(*chain)));
    }
  }

  PreparedPart plan_;
  std::vector<std::unique_ptr<RecipeModel>> models_;
  std::mt19937 seed_{9};
  optimise::Point inside(const optimise::Box& box) {
    optimise::Point y;
    for (std::size_t j = 0; j < y.size(); ++j) y[j] = box[j].lo + unit() * width(box[j]);
    return y;
  }
  void expect_excluded(const optimise::Piece& piece, const optimise::Box& box,
                       double cut) {
    for (int k = 0; k < 5; ++k) {
      double f = 0;
      std::vector<double> g;
      piece.value(inside(box), f, g);
      g.resize(piece.constraints);
      EXPECT_TRUE(f > cut || *std::ranges::max_element(g) > 0);
    }
  }
  double unit() { return std::uniform_real_distribution<double>(0, 1)(seed_); }
};

TEST_P(Surfaces, GradientsAreTheSlopesOfTheValues) {
  for (const auto& m : models_) {
    const auto& p = m->problem();
    const auto values = [&](const std::vector<double>& y) {
      optimise::Values v{0, std::vector<double>(y.size()),
                         std::vector<double>(p.constraints),
                         std::vector<double>(p.constraints * y.size())};
      p.evaluate(y, v);
      return v;
    };
    std::vector<double> y(kConditions);
    for (std::size_t j = 0; j < y.size(); ++j)
      y[j] = p.lower[j] + (0.1 + 0.8 * unit()) * (p.upper[j] - p.lower[j]);
    const auto at = values(y);
    for (std::size_t j = 0; j < y.size(); ++j) {
      if (!(p.lower[j] < p.upper[j])) continue;
      const double h = 1e-5;
      auto up = y, down = y;
      up[j] += h;
      down[j] -= h;
      const auto u = values(up), d = values(down);
      EXPECT_NEAR(at.df[j], (u.f - d.f) / (2 * h), 1e-6 + 1e-4 * std::abs(at.df[j]));
      for (std::size_t i = 0; i < p.constraints; ++i)
        EXPECT_NEAR(
            at.dg[i * y.size() + j], (u.g[i] - d.g[i]) / (2 * h),
            1e-6 * (1 + std::abs(at.g[i])) + 1e-4 * std::abs(at.dg[i * y.size() + j]))
            << "row " << i;
    }
  }
}

// A box that is dropped holds no point below the cut that keeps every limit; what a box that
// is not says of f, of every g and of the smooth function holds at its points, and
// the mean value theorem holds between two of them.
TEST_P(Surfaces, BoxesHoldTheirPoints) {
  for (const auto& m : models_)
    for (int trial = 0; trial < 6; ++trial) {
      std::vector<double> weights(m->rows().size());
      for (auto& w : weights) w = unit() < 0.3 ? unit() : 0;
      const auto& p = m->problem();
      optimise::Solution at;
      at.multipliers = weights;
      for (std::size_t j = 0; j < p.lower.size(); ++j)
        at.y.push_back(p.lower[j] + unit() * (p.upper[j] - p.lower[j]));
      const auto piece = m->piece(1, at);
      const double size = std::pow(unit(), 2);
      optimise::Box box;
      for (std::size_t j = 0; j < box.size(); ++j) {
        const auto whole = piece.box[j];
        const double low = whole.lo + (1 - size) * unit() * width(whole);
        box[j] = {low, low + size * width(whole)};
      }
      optimise::Bound f;
      std::vector<optimise::Bound> g;
      const double cut = std::log(m->objective(m->choice(at.y)));
      if (!piece.bound(box, cut, f, g)) expect_excluded(piece, box, cut);
      if (!piece.bound(box, kInfinity, f, g)) continue;
      ASSERT_EQ(g.size(), piece.constraints + 1);
      optimise::Point before{};
      std::vector<double> v_before;
      for (int k = 0; k < 5; ++k) {
        const optimise::Point y = inside(box);
        double value = 0;
        std::vector<double> v;
        piece.value(y, value, v);
        EXPECT_LE(v.back(), value + 1e-12);  // smooth <= f
        v.push_back(value);
        auto all = g;
        all.push_back(f);
        for (std::size_t i = 0; i < all.size(); ++i) {
          const double slack = 1e-9 * (1 + std::abs(v[i]));
          EXPECT_LE(all[i].v.lo, v[i] + slack) << i;
          EXPECT_GE(all[i].v.hi, v[i] - slack) << i;
          if (k == 0) continue;
          Interval step(0);
          for (std::size_t j = 0; j < y.size(); ++j)
            step = step + all[i].d[j] * Interval(y[j] - before[j]);
          EXPECT_LE(step.lo, v[i] - v_before[i] + slack) << i;
          EXPECT_GE(step.hi, v[i] - v_before[i] - slack) << i;
        }
        before = y;
        v_before = v;
      }
    }
}

// Slope of the Lagrangian in the feeds and the depth between the ends of their ranges.
void expect_flat(const RecipeModel& m, const optimise::Solution& s) {
  const auto piece = m.piece(1, s);
  const auto lagrangian = [&](const optimise::Point& y) {
    double f = 0;
    std::vector<double> g;
    piece.value(y, f, g);
    double sum = g.back();
    for (std::size_t i = 0; i < piece.constraints; ++i)
      sum += piece.combinations[0].multipliers[i] * g[i];
    return sum;
  };
  const optimise::Point y{s.y[1], s.y[3], s.y[4]};
  for (std::size_t j = 0; j < y.size(); ++j) {
    constexpr double kStep = 1e-6;
    if (y[j] - piece.box[j].lo < kStep || piece.box[j].hi - y[j] < kStep) continue;
    auto up = y, down = y;
    up[j] += kStep;
    down[j] -= kStep;
    EXPECT_NEAR((lagrangian(up) - lagrangian(down)) / (2 * kStep), 0, 2e-3);
  }
}

// Whether more than one limit holds the speed of an operation.
bool held_twice(const RecipeModel& m, const optimise::Solution& s) {
  std::array<int, 2> held{};
  for (std::size_t i = 0; i < m.rows().size(); ++i)
    if (m.rows()[i].speed && s.multipliers[i] > 0.01) ++held[m.rows()[i].operation];
  return std::ranges::max(held) > 1;
}

// Where several limits hold a speed at once, such as the power of a weak spindle and the
// life of the edge, any one of them alone, or all in other proportions, would leave a slope.
TEST_P(Surfaces, TheLagrangianIsFlatAtItsOptimum) {
  int twice = 0;
  for (double power = 1; power > 0.03; power *= 0.7) {
    prepare(power);
    for (const auto& m : models_) {
      const auto s = optimise::local_minimum(m->problem(), m->start(0.6, 0.5));
      if (s.status == optimise::Status::no_feasible_point_met) continue;
      expect_flat(*m, s);
      twice += held_twice(*m, s);
    }
  }
  if (std::string(GetParam()) == "gearbox-input-shaft") {
    EXPECT_GT(twice, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(ReferenceParts, Surfaces,
                         testing::Values("gearbox-input-shaft", "piston-rod",
                                         "spindle-nose"));

cutting::Cut steel(double kapr_deg, double re_mm) {
  cutting::Cut c;
  c.kc = {1600, 0.25};
  c.corner = cutting::corner_of(re_mm, kapr_deg * units::kPi / 180);
  return c;
}

// From stiff parts to such that yield most of the cut, with and without a couple that
// pulls the part in; every second material with measured feed and passive forces, whose
// terms of both signs have exponents of their own.
TEST(Yielding, SolvesItsEquationAndIsEnclosed) {
  std::mt19937 seed(4);
  std::uniform_real_distribution<double> unit(0, 1);
  int narrow = 0, trials = 0;
  for (int trial = 0; trial < 800; ++trial) {
    auto cut = steel(60 + 40 * unit(seed), 0.2 + unit(seed));
    if (trial % 2) {
      cut.kf = {700 * unit(seed), 0.3 + 0.5 * unit(seed)};
      cut.kp = {500 * unit(seed), 0.3 + 0.5 * unit(seed)};
    }
    const double p = std::pow(10, -6 + 3.5 * unit(seed));
    const Coefficients<double> law{p, (unit(seed) - 0.7) * 0.2 * p,
                                   (unit(seed) - 0.5) * 0.02 * p, 1e-5 * p};
    const double w = 0.2 * std::pow(unit(seed), 2);
    const Interval full(0.3 + 2 * unit(seed)), f(0.08 + 0.3 * unit(seed));
    const Interval fulls(full.lo, full.lo * (1 + w)), feeds(f.lo, f.lo * (1 + w));
    const auto box = yielding_range(
        {Interval(law.p), Interval(law.q), Interval(law.s), Interval(law.r)}, cut, fulls,
        feeds);
    for (int k = 0; k < 4; ++k) {
      const double ap = fulls.lo + unit(seed) * width(fulls);
      const double feed = feeds.lo + unit(seed) * width(feeds);
      const double e = yielding_mm(law, cut, ap, feed, 0);
      if (e == -100 * ap) continue;  // pulled in without end
      const double again = law_mm<double>(law, cutting::forces_N(cut, ap - e, feed));
      EXPECT_NEAR(e, again, 1e-12 * ap * (1 + loop_gain(law, cut, ap - e, feed)));
      EXPECT_LE(box.e.lo, e + 1e-12);
      EXPECT_GE(box.e.hi, e - 1e-12);
      EXPECT_LE(box.depth.lo, ap - e + 1e-12);
      EXPECT_GE(box.depth.hi, ap - e - 1e-12);
    }
    ++trials;
    narrow += width(box.e) < full.lo;
  }
  EXPECT_GT(narrow, 0.95 * trials);  // the whole line encloses too, and says nothing
}

}  // namespace
}  // namespace turnwright::planning
