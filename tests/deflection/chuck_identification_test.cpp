#include "turnwright/deflection/chuck_identification.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>

#include "random_shafts.hpp"

namespace turnwright::deflection {
namespace {

using random_shafts::between, random_shafts::normal;

const Root kChuck{1.8e-5, 8.6e-8, 1.1e-9}, kAcross{1.5e-5, 7e-8, 8.9e-10};

/// A standard normal deviate, spelled out: the library's differ between vendors.
double deflection_mm(const Root& s, double z, double F, double C) {
  return s.c0_mm_N * F + s.c1_rad_N * (2 * z * F + C) +
         s.c2_rad_Nmm * (z * z * F + z * C);
}

using Forces = std::array<double, 3>;
constexpr Forces kForces{150, 400, 700}, kLarge{150, 450, 900};

/// Three chuckings, three forces, four places each: 36 cuts at Fa/Fr = 0.6.
std::vector<PlaneTest> campaign(const Root& root, const Forces& forces = kForces) {
  std::vector<PlaneTest> tests;
  const std::array<std::string, 3> names{"A", "B", "C"};
  const std::array<double, 3> D{50, 40, 60}, offset{0.012, -0.031, 0.004};
  for (std::size_t s = 0; s < 3; ++s)
    for (const double Fr : forces)
      for (const double z : {20.0, 60.0, 110.0, 150.0}) {
        const double C = -0.6 * Fr * D[s] / 2;
        tests.push_back({names[s], z, Fr, C, deflection_mm(root, z, Fr, C) + offset[s]});
      }
  return tests;
}

/// The same with noise, and with `outliers` cuts off by 15 to 40 um either way.
std::vector<PlaneTest> measured(const Root& root, double sigma, int outliers,
                                std::mt19937_64& random, const Forces& forces = kForces) {
  auto tests = campaign(root, forces);
  for (auto& t : tests) t.y_mm += sigma * normal(random);
  for (int k = 0; k < outliers; ++k) {
    auto& y = tests[random() % tests.size()].y_mm;
    y += (random() % 2 ? 1 : -1) * between(random, 0.015, 0.040);
  }
  return tests;
}

void expect_root(const Root& a, const Root& b, double relative) {
  EXPECT_NEAR(a.c0_mm_N, b.c0_mm_N, relative * b.c0_mm_N);
  EXPECT_NEAR(a.c1_rad_N, b.c1_rad_N, relative * b.c1_rad_N);
  EXPECT_NEAR(a.c2_rad_Nmm, b.c2_rad_Nmm, relative * b.c2_rad_Nmm);
}

/// With the best offset of each setup.
double sum_of_squares(const std::vector<PlaneTest>& tests, const Root& root) {
  std::map<std::string, std::vector<double>> left;
  for (const auto& t : tests)
    left[t.setup].push_back(t.y_mm - deflection_mm(root, t.z_mm, t.F_N, t.C_Nmm));
  double sum = 0;
  for (const auto& [setup, r] : left) {
    const double mean =
        std::accumulate(r.begin(), r.end(), 0.0) / static_cast<double>(r.size());
    for (const double x : r) sum += (x - mean) * (x - mean);
  }
  return sum;
}

/// Plain least squares of all cuts with one column for each setup.
PlaneFit least_squares(const std::vector<PlaneTest>& tests) {
  std::vector<std::string> names;
  for (const auto& t : tests)
    if (!std::ranges::count(names, t.setup)) names.push_back(t.setup);
  const auto n = static_cast<Eigen::Index>(tests.size());
  Eigen::MatrixXd X =
      Eigen::MatrixXd::Zero(n, 3 + static_cast<Eigen::Index>(names.size()));
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& t = tests[static_cast<std::size_t>(i)];
    for (int j = 0; j < 3; ++j)
      X(i, j) = deflection_mm({j == 0 ? 1.0 : 0, j == 1 ? 1.0 : 0, j == 2 ? 1.0 : 0},
                              t.z_mm, t.F_N, t.C_Nmm);
    X(i, 3 + (std::ranges::find(names, t.setup) - names.begin())) = 1;
    y[i] = t.y_mm;
  }
  const Eigen::VectorXd c = X.colPivHouseholderQr().solve(y);
  PlaneFit fit;
  fit.root = {c[0], c[1], c[2]};
  return fit;
}

double quantile(std::vector<double> x, double p) {
  std::sort(x.begin(), x.end());
  return x[static_cast<std::size_t>(p * static_cast<double>(x.size() - 1) + 0.5)];
}

/// Largest relative error of the predicted deflection over the places of the campaign.
double worst_prediction(const PlaneFit& fit, const Root& truth) {
  double worst = 0;
  for (const double z : {20.0, 60.0, 110.0, 150.0}) {
    const double F = 250, C = -0.6 * F * 25;
    worst = std::max(worst, std::abs(predicted_deflection(fit, z, F, C).value /
                                         deflection_mm(truth, z, F, C) -
                                     1));
  }
  return worst;
}

TEST(ChuckIdentification, ExactCutsGiveTheChuckBack) {
  const auto fit = identify(campaign(kChuck), Plane::radial);
  expect_root(fit.root, kChuck, 1e-10);
  ASSERT_EQ(fit.offsets.size(), 3u);
  EXPECT_EQ(fit.offsets[1].setup, "B");
  EXPECT_NEAR(fit.offsets[0].mm, 0.012, 1e-12);
  EXPECT_NEAR(fit.offsets[1].mm, -0.031, 1e-12);
  EXPECT_TRUE(fit.outliers.empty());
  EXPECT_FALSE(fit.on_border);
  EXPECT_EQ(fit.degrees_of_freedom, 36 - 3 - 3);
  EXPECT_LT(fit.s_mm, 1e-12);
}

TEST(ChuckIdentification, OneWrongCutIsNamedAndLeftOut) {
  auto tests = campaign(kChuck);
  tests[17].y_mm += 0.025;
  const auto fit = identify(tests, Plane::radial);
  EXPECT_EQ(fit.outliers, std::vector<std::size_t>{17});
  EXPECT_NEAR(fit.residual_mm[17], 0.025, 1e-9);
  expect_root(fit.root, kChuck, 1e-7);
  EXPECT_EQ(fit.degrees_of_freedom, 35 - 3 - 3);
}

// Six wrong cuts of 36, all the same way and all where the leverage is: least squares
// would follow them.
TEST(ChuckIdentification, WrongCutsThatAgreeAreStillFound) {
  auto tests = campaign(kChuck);
  const std::vector<std::size_t> wrong{8, 10, 11, 22, 23, 35};
  for (const std::size_t i : wrong) tests[i].y_mm += 0.04;
  const auto fit = identify(tests, Plane::radial);
  EXPECT_EQ(fit.outliers, wrong);
  expect_root(fit.root, kChuck, 1e-7);
}

TEST(ChuckIdentification, PredictsWithinNinePercentAtOneMicrometreAndOutliers) {
  std::vector<double> all_robust, all_clean;
  int missed = 0, outliers = 0;
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::mt19937_64 random(seed);
    std::vector<double> robust;
    for (int trial = 0; trial < 200; ++trial) {
      auto tests = measured(kChuck, 0.001, 0, random, kLarge);
      all_clean.push_back(worst_prediction(least_squares(tests), kChuck));
      const std::size_t a = random() % 36, b = (a + 1 + random() % 35) % 36;
      tests[a].y_mm += between(random, 0.015, 0.040);
      tests[b].y_mm -= between(random, 0.015, 0.040);
      const auto fit = identify(tests, Plane::radial);
      EXPECT_TRUE(elastic(fit.root));
      for (const std::size_t i : {a, b}) missed += !std::ranges::count(fit.outliers, i);
      outliers += static_cast<int>(fit.outliers.size());
      robust.push_back(worst_prediction(fit, kChuck));
    }
    EXPECT_LT(quantile(robust, 0.95), 0.09) << "seed " << seed;
    all_robust.insert(all_robust.end(), robust.begin(), robust.end());
  }
  // as good as least squares told which cuts are right
  EXPECT_LT(quantile(all_robust, 0.95), 1.1 * quantile(all_clean, 0.95));
  EXPECT_EQ(missed, 0);
  EXPECT_LT(outliers - 1200, 60);  // good cuts of 20,400
}

TEST(ChuckIdentification, StandardErrorsCoverTheTruth) {
  std::mt19937_64 random(7);
  const int trials = 400;
  std::array<int, 2> deflection{}, parameter{};
  double s2 = 0;
  const auto count = [](std::array<int, 2>& within, double off) {
    within[0] += std::abs(off) < 1;
    within[1] += std::abs(off) < 2;
  };
  for (int trial = 0; trial < trials; ++trial) {
    auto tests = measured(kChuck, 0.001, 1, random);
    const auto fit = identify(tests, Plane::radial);
    const Estimate p = predicted_deflection(fit, 100, 250, -3000);
    count(deflection, (p.value - deflection_mm(kChuck, 100, 250, -3000)) / p.u);
    count(parameter, (fit.unconstrained.c2_rad_Nmm - kChuck.c2_rad_Nmm) /
                         std::sqrt(fit.covariance[2][2]));
    s2 += fit.s_mm * fit.s_mm / trials;
  }
  // Student's t with 29 degrees of freedom: 0.674 within one, 0.945 within two
  for (const auto& within : {deflection, parameter}) {
    EXPECT_NEAR(within[0], 0.674 * trials, 28);
    EXPECT_NEAR(within[1], 0.945 * trials, 16);
  }
  EXPECT_NEAR(std::sqrt(s2), 0.001, 0.00004);
}

// A stiff chuck in coarse noise: the best symmetric S is indefinite every other time.
TEST(ChuckIdentification, NoiseNeverMakesAChuckThatIsNoElasticBody) {
  std::mt19937_64 random(3);
  const Root stiff{4e-6, 3e-8, 2.4e-10};
  int border = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const auto tests = measured(stiff, 0.002, 0, random);
    const auto fit = identify(tests, Plane::radial);
    EXPECT_TRUE(elastic(fit.root));
    EXPECT_NO_THROW(
        Beam({210000, 0.3, {{100, 50, 50, 0, 0}}}).at(50, {.root = fit.root}));
    if (!fit.on_border) continue;
    ++border;
    EXPECT_FALSE(elastic(fit.unconstrained));
    EXPECT_GT(fit.contradiction, 0);
    // No elastic root nearby fits better: neither along the border nor inwards.
    std::vector<PlaneTest> kept;
    for (std::size_t i = 0; i < tests.size(); ++i)
      if (!std::ranges::count(fit.outliers, i)) kept.push_back(tests[i]);
    const double best = sum_of_squares(kept, fit.root);
    EXPECT_NEAR((best - sum_of_squares(kept, fit.unconstrained)) / (fit.s_mm * fit.s_mm),
                fit.contradiction, 1e-6 * best / (fit.s_mm * fit.s_mm));
    const double a = std::sqrt(fit.root.c0_mm_N),
                 b = std::copysign(std::sqrt(fit.root.c2_rad_Nmm), fit.root.c1_rad_N);
    for (const double da : {-1e-3, 0.0, 1e-3})
      for (const double db : {-1e-3, 0.0, 1e-3})
        for (const double in : {0.0, 1e-3}) {
          const double p = a + da * 2e-3, q = b + db * 2e-5, r = in * 2e-5;
          EXPECT_GE(sum_of_squares(kept, {p * p, p * q, q * q + r * r}),
                    best * (1 - 1e-9));
        }
  }
  EXPECT_GT(border, 20);
}

TEST(ChuckIdentification, SaysWhenTheCutsContradictEveryElasticChuck) {
  auto tests = campaign(kChuck);
  EXPECT_EQ(identify(tests, Plane::radial).contradiction, 0);
  std::mt19937_64 random(5);
  for (auto& t : tests)
    t.y_mm = deflection_mm({-6e-6, 8e-8, 7e-10}, t.z_mm, t.F_N, t.C_Nmm) +
             0.0005 * normal(random);
  const auto fit = identify(tests, Plane::radial);
  EXPECT_TRUE(fit.on_border);
  EXPECT_GT(fit.contradiction, 9);
  EXPECT_TRUE(elastic(fit.root));
}

// The chuck is the same in other lengths of z and other forces.
TEST(ChuckIdentification, ScalesLikeItsUnits) {
  std::mt19937_64 random(11);
  const auto tests = measured(kChuck, 0.001, 2, random);
  auto scaled = tests;
  for (auto& t : scaled) {
    t.z_mm *= 10;
    t.F_N *= 100;
    t.C_Nmm *= 1000;
  }
  const auto fit = identify(tests, Plane::radial),
             other = identify(scaled, Plane::radial);
  expect_root(
      other.root,
      {fit.root.c0_mm_N / 100, fit.root.c1_rad_N / 1000, fit.root.c2_rad_Nmm / 10000},
      1e-9);
  EXPECT_NEAR(other.covariance[0][2] / fit.covariance[0][2], 1e-6, 1e-12);
  EXPECT_EQ(other.outliers, fit.outliers);
}

std::vector<PlaneTest> cuts(const std::vector<double>& forces,
                            const std::vector<double>& places, double ratio = 0) {
  std::vector<PlaneTest> tests;
  for (const double F : forces)
    for (const double z : places) tests.push_back({"A", z, F, ratio * F, 0});
  return tests;
}

std::vector<std::string> missing(const std::vector<PlaneTest>& tests,
                                 Plane plane = Plane::radial) {
  std::vector<std::string> all;
  for (const auto& m : identifiability(tests, plane).missing) all.push_back(words(m));
  return all;
}

using Words = std::vector<std::string>;

TEST(Identifiability, OneForceLeavesC0WithTheOffset) {
  const auto tests = cuts({300}, {10, 50, 90, 130}, -12);
  const auto can = identifiability(tests, Plane::radial);
  EXPECT_EQ(can.rank, 2);
  ASSERT_EQ(can.null_directions.size(), 1u);
  EXPECT_EQ(words(can.null_directions[0]), "c0 with the setups' offsets");
  EXPECT_EQ(missing(tests), Words{"a cut at another force in setup A"});
  EXPECT_EQ(can.one_force, Words{"A"});
  EXPECT_THROW(identify(tests, Plane::radial), std::domain_error);
}

// More setups of one force each: every one brings its own offset and c0 stays hidden.
TEST(Identifiability, ASecondSetupIsNoSecondForce) {
  auto tests = cuts({300}, {10, 50, 90, 130});
  for (auto t : cuts({600}, {10, 50, 90})) {
    t.setup = "B";
    tests.push_back(t);
  }
  EXPECT_EQ(identifiability(tests, Plane::radial).rank, 2);
  EXPECT_EQ(missing(tests), Words{"a cut at another force in setup A"});
  tests.push_back({"B", 10, 300, 0, 0});
  const auto can = identifiability(tests, Plane::radial);
  EXPECT_EQ(can.rank, 3);
  EXPECT_EQ(can.one_force, Words{"A"});
}

TEST(Identifiability, PlacesAndCouplesAreNamedWhenMissing) {
  EXPECT_EQ(missing(cuts({200, 600}, {80})),
            (Words{"a cut at a second z in setup A", "a cut at a third z in setup A"}));
  EXPECT_EQ(missing(cuts({200, 600}, {30, 80})), Words{"a cut at a third z in setup A"});
  EXPECT_EQ(missing(cuts({200, 600}, {30, 80, 90})), Words{});
  // a second couple does what a third place does
  auto tests = cuts({200, 600}, {30, 80});
  tests.push_back({"A", 80, 600, -9000, 0});
  EXPECT_EQ(missing(tests), Words{});
  EXPECT_EQ(missing(cuts({300}, {70})),
            (Words{"a cut at another force in setup A", "a cut at a second z in setup A",
                   "a cut at a third z in setup A"}));
}

TEST(Identifiability, EveryMissingTestInTurnMakesTheDesignWhole) {
  for (auto tests : {cuts({300}, {70}), cuts({0}, {30}), cuts({200, 600}, {0}),
                     cuts({200}, {10, 20, 30}, -20)}) {
    const auto can = identifiability(tests, Plane::radial);
    EXPECT_EQ(static_cast<int>(can.missing.size()), 3 - can.rank);
    EXPECT_EQ(static_cast<int>(can.null_directions.size()), 3 - can.rank);
  }
}

// Nothing moves when the parameters move along a null direction.
TEST(Identifiability, NullDirectionsAreNotSeen) {
  for (const auto& tests : {cuts({200, 600}, {80}, -15), cuts({300}, {10, 50, 90}),
                            cuts({200, 600}, {30, 80}, -7), cuts({200, 600}, {0})}) {
    double Z = 0;
    for (const auto& t : tests) Z = std::max(Z, t.z_mm);
    if (Z == 0) Z = 100;
    const auto can = identifiability(tests, Plane::radial);
    EXPECT_FALSE(can.null_directions.empty());
    for (const auto& n : can.null_directions) {
      const Root root{n.weight[0], n.weight[1] / Z, n.weight[2] / (Z * Z)};
      double low = 1e300, high = -1e300;
      for (const auto& t : tests) {
        const double y = deflection_mm(root, t.z_mm, t.F_N, t.C_Nmm);
        low = std::min(low, y);
        high = std::max(high, y);
      }
      EXPECT_LT(high - low, 1e-9 * 600) << words(n);
      EXPECT_EQ(n.moves_offsets, std::abs(high) > 1e-6) << words(n);
    }
  }
}

TEST(Identifiability, ForcesThatDifferInTheLastDigitAreOne) {
  auto tests = cuts({300}, {10, 50, 90, 130});
  tests[0].F_N = 300.0001;
  EXPECT_EQ(identifiability(tests, Plane::radial).rank, 2);
  EXPECT_EQ(identifiability(tests, Plane::radial).one_force, Words{"A"});
}

TEST(Identifiability, TheErrorOfThePredictionIsThatOfTheFit) {
  std::mt19937_64 random(2);
  const auto tests = measured(kChuck, 0.001, 0, random);
  const auto can = identifiability(tests, Plane::radial);
  const auto fit = identify(tests, Plane::radial);
  ASSERT_TRUE(fit.outliers.empty());
  double largest = 0;
  for (const auto& t : tests)
    largest = std::max(largest, predicted_deflection(fit, t.z_mm, t.F_N, t.C_Nmm).u);
  EXPECT_NEAR(can.largest_u * fit.s_mm, largest, 1e-12 * largest);
  EXPECT_GE(can.condition, 1);
  // of nearly one force, a cut at another force helps most
  EXPECT_EQ(words(identifiability(cuts({300, 310}, {10, 50, 90, 130}), Plane::radial)
                      .most_useful),
            "a cut at another force in setup A");
}

TEST(ChuckIdentification, RefusesWhatItCannotTell) {
  auto tests = cuts({200, 600}, {30, 80});  // one parameter short
  EXPECT_THROW(identify(tests, Plane::radial), std::domain_error);
  tests.push_back({"A", 120, 200, 0, 0});
  EXPECT_EQ(identifiability(tests, Plane::radial).degrees_of_freedom, 1);
  EXPECT_NO_THROW(identify(tests, Plane::radial));
  tests.erase(tests.begin());  // rank 3 but every cut is needed
  EXPECT_EQ(identifiability(tests, Plane::radial).rank, 3);
  EXPECT_THROW(identify(tests, Plane::radial), std::domain_error);
  tests = campaign(kChuck);
  tests[3].y_mm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(identify(tests, Plane::radial), std::domain_error);
  EXPECT_THROW(identify({}, Plane::radial), std::domain_error);
}

// Cuts computed by the deflection model itself: part, tool and both planes.
TEST(ChuckIdentification, UndoesTheDeflectionModel) {
  const part::Shaft shaft{210000, 0.3, {{100, 60, 60, 0, 0}, {60, 45, 45, 20, 20}}};
  const Workpiece part(shaft);
  const Clamping clamping{{.root = kChuck}, {.root = kAcross}};
  const Beam beam(shaft);
  std::vector<PlaneTest> radial, tangential;
  const std::vector<double> places{20, 60, 110, 150};
  for (const double F : {150.0, 500.0}) {
    const Load load{F, 2.2 * F, 0.6 * F};
    for (const Response& r : responses(part, clamping, places, load)) {
      const TestCut cut{"A",
                        r.a_mm,
                        r.D_mm,
                        load,
                        r.radius_error_mm + 2e-6 * F + 0.01,
                        2e-6 * F,
                        beam.at(r.a_mm, {}),
                        r.delta_t_mm - 0.02};
      radial.push_back(radial_test(cut, kAcross));
      tangential.push_back(tangential_test(cut));
    }
  }
  const auto fit = identify(radial, Plane::radial);
  const auto across = identify(tangential, Plane::tangential);
  expect_root(fit.root, kChuck, 1e-8);
  expect_root(across.root, kAcross, 1e-8);
  EXPECT_NEAR(fit.offsets[0].mm, 0.01, 1e-11);
  EXPECT_NEAR(across.offsets[0].mm, -0.02, 1e-11);

  const Load load{250, 2000, 180};
  const Beam rigid({1e30, 0.3, {{200, 50, 50, 0, 0}}});
  const Response whole = response(90, 50, rigid.at(90, clamping.radial),
                                  rigid.at(90, clamping.tangential), load);
  EXPECT_NEAR(predicted_radius_error(fit, &across, 90, 50, load).value,
              whole.radius_error_mm, 1e-9);
  EXPECT_NEAR(predicted_radius_error(fit, nullptr, 90, 50, load).value, whole.delta_r_mm,
              1e-9);
  TestCut blind;
  EXPECT_THROW(tangential_test(blind), std::domain_error);
  EXPECT_THROW(predicted_radius_error(fit, nullptr, 90, 0, load), std::domain_error);
}

// The delta method against differences, with errors put in by hand.
TEST(ChuckIdentification, ErrorsOfThePredictionFollowTheCovariance) {
  PlaneFit r, t;
  r.root = kChuck;
  t.root = {1.5e-3, 7e-6, 8.9e-8};  // soft, so that delta_t^2/D counts
  r.covariance = {
      {{4e-14, 1e-16, 2e-18}, {1e-16, 9e-18, -1e-20}, {2e-18, -1e-20, 1e-20}}};
  t.covariance = {{{1e-8, 0, 0}, {0, 4e-14, 0}, {0, 0, 9e-18}}};
  const Load load{250, 600, 180};
  const double z = 90, D = 50, C = -180 * 25;
  const auto error = [&](const PlaneFit& a, const PlaneFit& b) {
    return predicted_radius_error(a, &b, z, D, load).value;
  };
  const std::array fields{&Root::c0_mm_N, &Root::c1_rad_N, &Root::c2_rad_Nmm};
  std::array<double, 3> gr{}, gt{};
  for (std::size_t j = 0; j < 3; ++j) {
    PlaneFit up = r, down = r;
    const double h = 1e-3 * r.root.*fields[j], k = 1e-3 * t.root.*fields[j];
    up.root.*fields[j] += h;
    down.root.*fields[j] -= h;
    gr[j] = (error(up, t) - error(down, t)) / (2 * h);
    up = down = t;
    up.root.*fields[j] += k;
    down.root.*fields[j] -= k;
    gt[j] = (error(r, up) - error(r, down)) / (2 * k);
  }
  double variance = 0, radial = 0;
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t k = 0; k < 3; ++k) {
      radial += gr[j] * r.covariance[j][k] * gr[k];
      variance += gt[j] * t.covariance[j][k] * gt[k];
    }
  EXPECT_NEAR(predicted_deflection(r, z, 250, C).u / std::sqrt(radial), 1, 1e-8);
  EXPECT_NEAR(predicted_radius_error(r, &t, z, D, load).u / std::sqrt(variance + radial),
              1, 1e-8);
}

TEST(Springs, AreAViewOfTheRootAndBack) {
  const auto range = arms(kChuck);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->least_mm, 8.6e-8 / 1.1e-9, 1e-10);
  EXPECT_NEAR(range->largest_mm, 1.8e-5 / 8.6e-8, 1e-10);
  for (const double Lc : {range->least_mm, 110.0, range->largest_mm}) {
    const auto k = springs(kChuck, Lc);
    ASSERT_TRUE(k);
    EXPECT_GE(k->per_k1_mm_N, 0);
    EXPECT_GE(k->per_k3_rad_Nmm, 0);
    expect_root({k->per_k1_mm_N + Lc * Lc * k->per_k2_rad_Nmm, Lc * k->per_k2_rad_Nmm,
                 k->per_k2_rad_Nmm + k->per_k3_rad_Nmm},
                kChuck, 1e-9);
  }
  EXPECT_EQ(springs(kChuck, range->least_mm)->per_k3_rad_Nmm, 0);
  EXPECT_EQ(springs(kChuck, range->largest_mm)->per_k1_mm_N, 0);
  EXPECT_FALSE(springs(kChuck, 0.99 * range->least_mm));
  EXPECT_FALSE(springs(kChuck, 1.01 * range->largest_mm));
  EXPECT_FALSE(arms({1.8e-5, 0, 1.1e-9}));
  EXPECT_FALSE(arms({1.8e-5, -8.6e-8, 1.1e-9}));
  EXPECT_FALSE(arms({1.8e-6, 8.6e-8, 1.1e-9}));
}

// The delta method against differences, the arm held.
TEST(Springs, HaveTheErrorsOfTheCompliance) {
  PlaneFit fit;
  fit.root = kChuck;
  fit.covariance = {
      {{4e-14, 1e-16, 2e-18}, {1e-16, 9e-18, -1e-20}, {2e-18, -1e-20, 1e-20}}};
  const double Lc = 110;
  const Springs u = spring_errors(fit, Lc);
  const std::array fields{&Root::c0_mm_N, &Root::c1_rad_N, &Root::c2_rad_Nmm};
  for (const auto spring :
       {&Springs::per_k1_mm_N, &Springs::per_k2_rad_Nmm, &Springs::per_k3_rad_Nmm}) {
    std::array<double, 3> g{};
    for (std::size_t j = 0; j < 3; ++j) {
      Root up = fit.root, down = fit.root;
      const double h = 1e-3 * fit.root.*fields[j];
      up.*fields[j] += h;
      down.*fields[j] -= h;
      g[j] =
          (springs(up, Lc).value().*spring - springs(down, Lc).value().*spring) / (2 * h);
    }
    double variance = 0;
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) variance += g[j] * fit.covariance[j][k] * g[k];
    EXPECT_NEAR(u.*spring / std::sqrt(variance), 1, 1e-8);
  }
}

// Section III of [Valino 2008] as printed (N/mm and N mm/rad).
struct PaperSprings {
  double k1, k2, k3;
};
constexpr PaperSprings kPaperRadial{-1.6e5, 1.28e9, -1.52e10},
    kPaperTangential{-1.026e5, 1.564e9, 1.317e10};
constexpr double kPaperA = 5.733e-7, kPaperB = 1.226e-4, kPaperC = 92.834;

Root paper_root(const PaperSprings& k, double Lc) {
  return {1 / k.k1 + Lc * Lc / k.k2, Lc / k.k2, 1 / k.k2 + 1 / k.k3};
}

TEST(Valino2008Chuck, ItsFiguresAreOneSet) {
  // A = F (1/k2 + 1/k3): the same force in both planes, to the digits printed
  const auto force = [](const PaperSprings& k) {
    return kPaperA / (1 / k.k2 + 1 / k.k3);
  };
  EXPECT_NEAR(force(kPaperRadial), 801.3, 0.05);
  EXPECT_NEAR(force(kPaperTangential), 801.5, 0.05);
  // without a feed force, B = 2 F Lc/k2: two arms for one chuck
  const auto arm = [](const PaperSprings& k, double F) {
    return kPaperB * k.k2 / (2 * F);
  };
  EXPECT_NEAR(arm(kPaperRadial, 801.3), 97.9, 0.05);
  EXPECT_NEAR(arm(kPaperTangential, 801.5), 119.6, 0.05);
  // half of it is a plausible whole cutting force on 0.8 mm x 0.2 mm of carbon steel
  EXPECT_NEAR(force(kPaperRadial) / 2 / (0.8 * 0.2), 2500, 10);
  // C in mm cannot be a deflection; it lies under the 100 mm bar's diameter
  EXPECT_LT(kPaperC, 100);
  EXPECT_GT(kPaperC, 90);
  // the springs k1 stand for a datum error of a few micrometres
  EXPECT_NEAR(801.3 / kPaperRadial.k1, -0.0050, 0.00005);
  EXPECT_NEAR(801.5 / kPaperTangential.k1, -0.0078, 0.00005);
}

TEST(Valino2008Chuck, IsNoElasticBody) {
  // radially for no arm at all; tangentially not below 379 mm
  for (const double Lc : {0.0, 50.0, 98.0, 200.0, 400.0, 1000.0, 1e5})
    EXPECT_FALSE(elastic(paper_root(kPaperRadial, Lc))) << Lc;
  EXPECT_FALSE(elastic(paper_root(kPaperTangential, 378)));
  EXPECT_TRUE(elastic(paper_root(kPaperTangential, 380)));
  // A and B alone would allow one, with 8.2e-6 mm/N and more at the jaws
  const double c2 = kPaperA / 801.3, c1 = kPaperB / (2 * 801.3);
  EXPECT_NEAR(c1 * c1 / c2, 8.18e-6, 0.02e-6);
  EXPECT_TRUE(elastic({8.3e-6, c1, c2}));
}

TEST(Valino2008Chuck, ItsTestCannotTellK1) {
  // one cut along the bar: one force, one setup
  std::vector<PlaneTest> tests;
  for (int i = 1; i <= 14; ++i) {
    const double z = 10.0 * i;
    tests.push_back({"1", z, 801.3, 0, (kPaperA * z + kPaperB) * z + (kPaperC - 92.834)});
  }
  const auto can = identifiability(tests, Plane::radial);
  EXPECT_EQ(can.rank, 2);
  EXPECT_EQ(words(can.null_directions.at(0)), "c0 with the setups' offsets");
  EXPECT_EQ(missing(tests), Words{"a cut at another force in setup 1"});
}

}  // namespace
}  // namespace turnwright::deflection
