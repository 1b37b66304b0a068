#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "document/json/file.hpp"
#include "planning/setup/clamping_comparison.hpp"
#include "surface_search.hpp"
#include "turnwright/document/catalogue.hpp"
#include "turnwright/document/prepared_part.hpp"
#include "turnwright/optimise/local.hpp"

// Nothing that keeps the limits of a surface is below its certificate, judged by the
// reference search's own checks.
namespace turnwright::reference {
namespace {

using planning::Choice;
using planning::SolvedSurface;

constexpr int kPoints = 100000, kSolves = 200;
constexpr double kRounding = 1e-12;
constexpr int kPlaces =
    9;  // fewer let more points through: the bound has to hold for them

planning::PreparedPart loaded(const std::string& name) {
  const std::string root = TURNWRIGHT_SOURCE_DIR;
  return document::prepared_part(document::parse_file(root + "/parts/" + name + ".json"),
                                 document::load_catalogue(root), name)
      .part;
}

// Conditions on lines through where it stands, closing in until they are allowed.
struct Walk {
  const SolvedSurface& feature;
  const SurfaceSearch& checks;
  std::vector<double> at;
  std::mt19937 seed{9};
  double over = excess(choice(at));
  int allowed = 0;
  double least = kInfinity;

  Choice<double> choice(const std::vector<double>& y) const {
    return feature.answer.model->choice(y);
  }
  double excess(const Choice<double>& c) const {
    const auto p = checks.at(c);
    return p.excess > std::max(over, kRounding)
               ? p.excess
               : std::max(p.excess, checks.tolerance_excess(c, kPlaces));
  }
  double draw(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(seed);
  }
  void step() {
    const auto& box = feature.answer.model->problem();
    std::vector<double> d(at.size());
    const double share = draw(0, 1);
    for (auto& x : d)
      if (draw(0, 1) < share) x = draw(-1, 1);
    const double reach = std::pow(10, draw(-5, 0.5));
    double lower = -reach, upper = reach;
    for (int k = 0; k < 12; ++k) {
      const double t = draw(lower, upper);
      auto y = at;
      for (std::size_t j = 0; j < y.size(); ++j)
        y[j] = std::clamp(y[j] + t * d[j], box.lower[j], box.upper[j]);
      const auto c = choice(y);
      const double w = excess(c);
      if (!(w <= std::max(over, kRounding))) {
        (t < 0 ? lower : upper) = t;
        continue;
      }
      at = y;
      over = w;
      if (w > kRounding) return;
      ++allowed;
      least = std::min(least, checks.at(c).cost);
      return;
    }
  }
};

void expect_none_below(const SolvedSurface& f) {
  const auto& a = f.answer;
  SCOPED_TRACE(f.task.feature.surface());
  ASSERT_TRUE(a.feasible);
  Effort none{2, 2, 2, 1, 1};
  const SurfaceSearch checks(f.task.feature, f.task.cut_tolerances, a.model->recipe(),
                             f.task.economy, none);
  ASSERT_TRUE(checks.possible());
  const auto& problem = a.model->problem();
  Walk walk{f, checks, a.model->point(a.choice)};
  for (int k = 0; walk.allowed < kPoints && k < 5 * kPoints; ++k) walk.step();
  EXPECT_EQ(walk.allowed, kPoints);
  EXPECT_GE(walk.least, a.certificate.lower_bound * (1 - kRounding));
  std::mt19937 seed(3);
  std::uniform_real_distribution<double> unit(0, 1);
  int found = 0;
  for (int k = 0; k < kSolves; ++k) {
    std::vector<double> y(problem.lower);
    for (std::size_t j = 0; j < y.size(); ++j)
      y[j] += unit(seed) * (problem.upper[j] - problem.lower[j]);
    const auto s = optimise::local_minimum(problem, y);
    if (s.status == optimise::Status::no_feasible_point_met) continue;
    ++found;
    EXPECT_GE(std::exp(s.f), a.certificate.lower_bound * (1 - 1e-9));
  }
  EXPECT_GE(found, kSolves / 10);
}

// One surface of each kind, and of each setup, with the most tolerances.
std::vector<const SolvedSurface*> chosen(const planning::Attempt& all) {
  std::map<std::pair<std::size_t, planning::MachinedSurface::Kind>, const SolvedSurface*>
      best;
  for (const auto& s : all.setups)
    for (const auto& f : s.chosen.features) {
      auto& b = best[{s.chosen.setup, f.task.feature.kind()}];
      if (!b || f.task.cut_tolerances.size() > b->task.cut_tolerances.size()) b = &f;
    }
  std::vector<const SolvedSurface*> list;
  for (const auto& [key, f] : best) list.push_back(f);
  return list;
}

class SurfaceCertificate : public testing::TestWithParam<const char*> {};

TEST_P(SurfaceCertificate, HoldsForEveryAllowedPointAndLocalSolve) {
  const auto p = loaded(GetParam());
  const auto all = planning::best_attempt(p);
  ASSERT_TRUE(all.feasible);
  for (const auto* f : chosen(all)) expect_none_below(*f);
}

INSTANTIATE_TEST_SUITE_P(Parts, SurfaceCertificate,
                         testing::Values("titanium-pin", "aluminium-tube", "iron-hub"));

}  // namespace
}  // namespace turnwright::reference
