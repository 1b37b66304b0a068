#include "turnwright/cutting/force_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace turnwright::cutting {
namespace {

Cut tool() {
  Cut c;
  c.kc = {1700, 0.25};
  c.thrust = {0.4, 60, 20};
  c.corner = corner_of(0.4, 93 * std::numbers::pi / 180);
  return c;
}

/// Cuts that a law makes, each force off by a relative error.
template <class Noise>
std::vector<MeasuredCut> cuts_of(const Cut& law, const std::vector<double>& depths,
                                 const Noise& noise) {
  std::vector<MeasuredCut> all;
  for (const double ap : depths)
    for (const double f : {0.07, 0.1, 0.13, 0.2}) {
      const auto F = forces_N(law, ap, f);
      all.push_back({ap, f, {F.Fc_N * noise(), F.Ff_N * noise(), F.Fp_N * noise()}});
    }
  return all;
}
double exactly() { return 1; }

TEST(ForceFit, ExactCutsGiveTheConstants) {
  Cut law = tool();
  law.kc = {1450, 0.21};
  law.thrust = {0.53, 42, 20};
  const auto fit = fit_forces(cuts_of(law, {0.25, 0.5, 0.8}, exactly), tool());
  EXPECT_EQ(fit.law, ThrustLaw::direction);
  EXPECT_NEAR(fit.cut.kc.k11_MPa, 1450, 1e-7);
  EXPECT_NEAR(fit.cut.thrust.ratio, 0.53, 1e-10);
  EXPECT_NEAR(fit.cut.thrust.edge_N_mm, 42, 1e-8);
  ASSERT_EQ(fit.left_out.size(), 3u);
  for (const auto& l : fit.left_out)
    for (const auto& rms : l.rms) EXPECT_NEAR(*rms, 0, 1e-9);
}

// Where the chip flows along the axis the feed force speaks, not the passive force.
TEST(ForceFit, DeepCutsAreJudgedByTheirFeedForce) {
  Cut law = tool();
  law.thrust = {0.6, 30, 20};
  auto cuts = cuts_of(law, {2, 3}, exactly);
  for (auto& m : cuts) *m.F_N[2] *= 3;
  const auto fit = fit_forces(cuts, tool());
  EXPECT_NEAR(fit.thrust->ratio->value, 0.6, 1e-9);
  EXPECT_NEAR(fit.thrust->edge_N_mm->value, 30, 1e-7);
}

// A force by component that the direction of flow cannot follow is kept; one that turns
// with the depth is not.
TEST(ForceFit, KeepsComponentsOnlyWhereTheyPredictOtherDepths) {
  Cut law = tool();
  law.kf = Kienzle{500, 0.5};
  law.kp = Kienzle{200, 0.3};
  auto fit = fit_forces(cuts_of(law, {0.3, 0.8, 2}, exactly), tool());
  EXPECT_EQ(fit.law, ThrustLaw::components);
  EXPECT_NEAR(fit.cut.kp->k11_MPa, 200, 1e-8);
  fit = fit_forces(cuts_of(tool(), {0.3, 0.8, 2}, exactly), law);
  EXPECT_EQ(fit.law, ThrustLaw::direction);
  EXPECT_FALSE(fit.cut.kf || fit.cut.kp);
}

// One depth cannot tell how the force turns.
TEST(ForceFit, ComponentsOfOneDepthAreNotTrusted) {
  Cut law = tool();
  law.kf = Kienzle{500, 0.5};
  law.kp = Kienzle{200, 0.3};
  const auto fit = fit_forces(cuts_of(law, {0.5}, exactly), tool());
  EXPECT_EQ(fit.law, ThrustLaw::direction);
  EXPECT_TRUE(fit.left_out.empty());
}

TEST(ForceFit, OneFeedScalesWhatIsGiven) {
  Cut law = tool();
  law.thrust = {0.5, 75, 20};  // the given ones times 1.25
  std::vector<MeasuredCut> cuts;
  for (int k = 0; k < 4; ++k) {
    const auto F = forces_N(law, 0.5, 0.1);
    cuts.push_back({0.5, 0.1, {F.Fc_N, {}, F.Fp_N}});
  }
  const auto fit = fit_forces(cuts, tool());
  EXPECT_TRUE(fit.thrust->scaled);
  EXPECT_NEAR(fit.cut.thrust.ratio, 0.5, 1e-9);
  EXPECT_NEAR(fit.cut.thrust.edge_N_mm, 75, 1e-7);
  EXPECT_EQ(fit.cut.kc.k11_MPa, 1700);  // one thickness tells no law of Fc
  cuts.resize(2);
  EXPECT_EQ(fit_forces(cuts, tool()).law, ThrustLaw::none);
}

TEST(ForceFit, NoConstantIsNegative) {
  Cut law = tool();
  law.thrust = {0.8, 0, 20};
  auto cuts = cuts_of(law, {0.25, 0.5, 0.8}, exactly);
  for (auto& m : cuts) *m.F_N[2] *= std::pow(m.f_mm_rev / 0.1, 0.4);  // rises with h
  const auto fit = fit_forces(cuts, tool());
  EXPECT_TRUE(fit.thrust->scaled);
  EXPECT_GT(fit.cut.thrust.edge_N_mm, 0);
}

// 95 % intervals of the two constants over 300 campaigns that scatter by 4 %: the share
// that holds the truth is within four standard deviations of 95 %.
TEST(ForceFit, IntervalsHoldTheTruth) {
  Cut law = tool();
  law.thrust = {0.5, 45, 20};
  std::mt19937 seed(3);
  std::normal_distribution<double> error(0, 0.04);
  int ratio = 0, edge = 0, whole = 0;
  constexpr int kTrials = 300;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto cuts =
        cuts_of(law, {0.25, 0.5, 0.8}, [&] { return std::exp(error(seed)); });
    std::vector<ThrustPoint> points;
    for (const auto& m : cuts) {
      const double u = flow_cotangent(law, m.ap_mm, m.f_mm_rev);
      points.push_back({forces_N(law, m.ap_mm, m.f_mm_rev).Fc_N,
                        engaged_edge_mm(law, m.ap_mm, m.f_mm_rev), u / std::hypot(1, u),
                        *m.F_N[2]});
    }
    const auto fit = fit_thrust(points, tool().thrust, {.outlier_p = 0});
    const auto holds = [](const Estimate& e, double truth) {
      return e.lower <= truth && truth <= e.upper;
    };
    if (fit.scaled) continue;
    ++whole;
    ratio += holds(*fit.ratio, 0.5);
    edge += holds(*fit.edge_N_mm, 45);
  }
  EXPECT_GT(whole, kTrials * 9 / 10);
  const double four = 4 * std::sqrt(0.95 * 0.05 * whole);
  EXPECT_NEAR(ratio, 0.95 * whole, four);
  EXPECT_NEAR(edge, 0.95 * whole, four);
}

// A median of campaigns that scatter widely is the truth: large forces pull no less than
// small ones.
TEST(ForceFit, ScatterDoesNotMakeTheForceSmaller) {
  std::mt19937 seed(5);
  std::normal_distribution<double> error(0, 0.3);
  std::vector<double> found;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<ThrustPoint> points;
    for (int k = 0; k < 12; ++k)
      points.push_back(
          {100 + 10.0 * k, 0.8, 0.7,
           0.7 * (0.4 * (100 + 10.0 * k) + 60 * 0.8) * std::exp(error(seed))});
    const auto fit = fit_thrust(points, {0.4, 60, 20, 0}, {.outlier_p = 0});
    found.push_back(fit.ratio->value * 155 + fit.edge_N_mm->value * 0.8);
  }
  std::ranges::sort(found);
  EXPECT_NEAR(found[100] / (0.4 * 155 + 60 * 0.8), 1, 0.02);
}

// Without a material nothing says what Fc is where it was not measured; and a depth whose
// rest tells no law of Fc is not left out.
TEST(ForceFit, WithoutFcThereIsNoThrustLaw) {
  Cut bare = tool();
  bare.kc = {};
  auto cuts = cuts_of(tool(), {0.25, 0.5}, exactly);
  for (auto& m : cuts) m.F_N[0].reset();
  auto fit = fit_forces(cuts, bare);
  EXPECT_NE(fit.law, ThrustLaw::direction);
  EXPECT_FALSE(fit.thrust);
  for (auto& m : cuts) m.F_N[1].reset();
  EXPECT_EQ(fit_forces(cuts, bare).law, ThrustLaw::none);
  cuts = cuts_of(tool(), {0.5}, exactly);
  const auto F = forces_N(tool(), 0.25, 0.1);
  cuts.push_back({0.25, 0.1, {F.Fc_N, F.Ff_N, F.Fp_N}});
  fit = fit_forces(cuts, tool());
  EXPECT_EQ(fit.law, ThrustLaw::direction);
  EXPECT_TRUE(fit.left_out.empty());
}

// Fp of a cut that flows along the axis judges no law.
TEST(ForceFit, ErrorsAreThoseOfGoodPartsOfTheThrustForce) {
  auto cuts = cuts_of(tool(), {0.25, 0.5, 0.8, 4}, exactly);
  for (auto& m : cuts)
    if (m.ap_mm == 4) *m.F_N[2] *= 2;
  const auto fit = fit_forces(cuts, tool());
  EXPECT_EQ(fit.law, ThrustLaw::direction);
  EXPECT_FALSE(fit.left_out[3].rms[2]);
  EXPECT_NEAR(*fit.left_out[3].rms[1], 0, 1e-9);
}

TEST(ForceFit, NamesOutliersByTheirCut) {
  auto cuts = cuts_of(tool(), {0.25, 0.5, 0.8}, exactly);
  int k = 0;
  for (auto& m : cuts) {
    *m.F_N[2] *= 1 + 0.01 * std::sin(5.0 * ++k);
    *m.F_N[0] *= 1 + 0.01 * std::sin(7.0 * k);
  }
  cuts.insert(cuts.begin(), {0.5, 0.1, {100, {}, {}}});  // without Fp
  *cuts[7].F_N[2] *= 1.6;
  EXPECT_EQ(fit_forces(cuts, tool()).thrust->evidence.outliers,
            std::vector<std::size_t>{7});
}

// Of three replicas one is a tenth larger: the others predict it that much too small, and
// cuts without a replica stay among those that predict.
TEST(ForceFit, EachReplicaIsPredictedFromTheOthers) {
  std::vector<MeasuredCut> all;
  for (std::size_t run = 0; run < 3; ++run)
    for (auto& m : cuts_of(tool(), {0.25, 0.5}, [&] { return run == 2 ? 1.1 : 1.0; })) {
      m.replica = 4 - run;
      all.push_back(m);
    }
  for (const auto& m : cuts_of(tool(), {0.8}, exactly)) all.push_back(m);
  const auto fit = fit_forces(all, tool(), {.outlier_p = 0});
  ASSERT_EQ(fit.left_out_replicas.size(), 3u);
  EXPECT_EQ(fit.left_out_replicas[0].replica, 2u);
  for (const auto& rms : fit.left_out_replicas[0].rms)
    EXPECT_NEAR(*rms, 1 - 1 / 1.1, 1e-9);
  EXPECT_LT(*fit.left_out_replicas[1].rms[0], 0.08);
  EXPECT_GT(*fit.left_out_replicas[1].rms[0], 0.01);
  for (auto& m : all) m.replica.reset();
  EXPECT_TRUE(fit_forces(all, tool()).left_out_replicas.empty());
}

// Bars of another hardness: Fc differs by the lab, lambda of it and ke do not.
TEST(ForceFit, ThrustIsOfTheCuttingForceOfItsLab) {
  std::vector<MeasuredCut> all;
  for (std::size_t lab = 0; lab < 2; ++lab) {
    Cut law = tool();
    law.kc.k11_MPa *= lab == 0 ? 1.2 : 1 / 1.2;
    for (auto& m : cuts_of(law, {0.25, 0.5, 0.8}, exactly)) {
      m.lab = lab;
      all.push_back(m);
    }
  }
  const auto fit = fit_forces(all, tool());
  EXPECT_EQ(fit.law, ThrustLaw::direction);
  EXPECT_NEAR(fit.cut.kc.k11_MPa, 1700, 1e-7);
  EXPECT_NEAR(fit.kienzle[0]->labs->each[0].factor.value, 1.2, 1e-10);
  EXPECT_NEAR(fit.thrust->ratio->value, 0.4, 1e-9);
  EXPECT_NEAR(fit.thrust->edge_N_mm->value, 60, 1e-7);
}

}  // namespace
}  // namespace turnwright::cutting
