#include "turnwright/volumetric/ball_bar.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "machines.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::volumetric {
namespace {

using nlohmann::json;

struct Reference {
  json file = testing::reference()["ballbar"][0];
  Machine machine{file["chain"], {}, {}};
  BallBarTest test{.R_mm = file["R"], .n = file["n"], .centre_offset_mm = file["ecc"]};
  Reference() {
    for (const auto& [name, err] : file["err"].items()) {
      Axis axis{name[0], {}, default_Q(name[0])};
      testing::add_errors(axis, err);
      if (file["squareness"].contains(name))
        for (const auto& [key, value] : file["squareness"][name].items())
          axis.location[testing::direction(key)] = value;
      machine.axes.push_back(axis);
    }
  }
  Trace trace(const char* noise_ccw, const char* noise_cw) const {
    Trace t = simulate(machine, test);
    for (std::size_t i = 0; i < test.n; ++i) {
      t.ccw_mm[i] = file["ccw"][i];
      t.cw_mm[i] = file["cw"][i];
      if (!noise_ccw) continue;
      t.ccw_mm[i] += file[noise_ccw][i].get<double>();
      t.cw_mm[i] += file[noise_cw][i].get<double>();
    }
    return t;
  }
};

TEST(BallBar, ReproducesTheReferenceTrace) {
  const Reference r;
  const Trace t = simulate(r.machine, r.test);
  EXPECT_NEAR(t.theta_rad[0], r.file["theta0"], 1e-15);
  for (std::size_t i = 0; i < r.test.n; ++i) {
    EXPECT_NEAR(t.ccw_mm[i], r.file["ccw"][i], 1e-10);
    EXPECT_NEAR(t.cw_mm[i], r.file["cw"][i], 1e-10);
  }
}

void agrees(const Trace& t, const json& iso, const json& fit) {
  const Iso230_4 v = iso230_4(t);
  const std::map<std::string, double> found = {
      {"G_ccw", v.G_ccw_mm},     {"G_cw", v.G_cw_mm},  {"G_ccw_mz", v.G_ccw_mz_mm},
      {"G_cw_mz", v.G_cw_mz_mm}, {"G_bi", v.G_bi_mm},  {"H", v.H_mm},
      {"Fmax", v.F_max_mm},      {"Fmin", v.F_min_mm}, {"D", v.D_mm}};
  for (const auto& [key, value] : found) EXPECT_NEAR(value, iso[key], 1e-9) << key;
  const BallBarFit f = decompose(t);
  for (std::size_t k = 0; k < kBallBarTerms.size(); ++k) {
    std::string key(kBallBarTerms[k]);
    if (key.starts_with("centre")) key.replace(0, 6, "ecc");
    EXPECT_NEAR(f.value[k], fit[key], 1e-9) << key;
    if (fit["u"].contains(key)) {
      EXPECT_NEAR(f.u[k], fit["u"][key], 1e-9) << key;
    }
  }
  EXPECT_NEAR(f.rms_mm, fit["rms_res"], 1e-9);
}

TEST(BallBar, ReproducesTheReferenceAnalyses) {
  const Reference r;
  agrees(r.trace(nullptr, nullptr), r.file["iso230_4"], r.file["fit"]);
  agrees(r.trace("noise_ccw", "noise_cw"), r.file["iso230_4_noisy"], r.file["fit_noisy"]);
}

// In every plane and with tables too, errors put into the machine come out again.
TEST(BallBar, FindsTheErrorsOfAnyPlane) {
  for (const char* chain : {"wfXYZt", "wXfYZt", "wXYZft", "wCBXfZYt", "wYZfXAt"})
    for (const Plane plane : {Plane::XY, Plane::YZ, Plane::ZX}) {
      const auto [U, V] = axes_of(plane);
      const auto u = letter_index(U), v = letter_index(V), w = 3 - u - v;
      Machine m{chain, {9, 9, 9}, {}};
      for (const char c : std::string(chain))
        if (letter_index(c) != std::string::npos) m.axes.push_back({c, {}, default_Q(c)});
      const auto axis = [&](char name) -> Axis& {
        return *std::ranges::find(m.axes, name, &Axis::name);
      };
      const auto side = [&](char name) {  // relative = physical times this
        return m.chain.find(name) < m.chain.find('f') ? -1.0 : 1.0;
      };
      Axis &a = axis(U), &b = axis(V);
      a.errors[u].c[1] = side(U) * 3e-5;  // 0.3 ppm
      b.errors[v].c[1] = side(V) * -2e-5;
      a.errors[u].b = side(U) * -1.2e-5;
      b.errors[v].b = side(V) * 2e-5;
      a.errors[v].b = side(U) * 3e-6;
      b.errors[u].b = side(V) * -4e-6;
      a.errors[v].c[2] = side(U) * 9e-6;
      b.errors[u].c[2] = side(V) * 7e-6;
      b.location[w + 3] = 4e-7;  // turns V against U: towards -U
      const Vec3 o{1e-5, -2e-5, 3e-5};
      const BallBarFit f = decompose(
          simulate(m, {.plane = plane, .R_mm = 100, .n = 37, .centre_offset_mm = o}));
      const std::array<double, 12> expected = {-o[u], -o[v], 3e-7,  -2e-7, -4e-7, -1.2e-5,
                                               2e-5,  3e-6,  -4e-6, 9e-6,  7e-6,  0};
      for (std::size_t k = 0; k < 12; ++k) {
        const bool relative = k >= 2 && k <= 4;
        EXPECT_NEAR(f.value[k], expected[k], relative ? 1e-12 : 1e-10)
            << chain << U << V << ' ' << kBallBarTerms[k];
      }
    }
}

TEST(BallBar, UncertaintyIsTheScatterOfRepeatedFits) {
  const Reference r;
  const Trace clean = r.trace(nullptr, nullptr);
  std::mt19937 random(4);
  std::normal_distribution<> noise(0, 1e-3);
  constexpr int kRuns = 400;
  std::array<double, 12> sum{}, square{}, u{};
  for (int run = 0; run < kRuns; ++run) {
    Trace t = clean;
    for (double& x : t.ccw_mm) x += noise(random);
    for (double& x : t.cw_mm) x += noise(random);
    const BallBarFit f = decompose(t);
    for (std::size_t k = 0; k < 12; ++k) {
      sum[k] += f.value[k];
      square[k] += f.value[k] * f.value[k];
      u[k] += f.u[k] / kRuns;
    }
  }
  for (std::size_t k = 0; k < 12; ++k) {
    const double variance = (square[k] - sum[k] * sum[k] / kRuns) / (kRuns - 1);
    EXPECT_NEAR(std::sqrt(variance) / u[k], 1, 0.15) << kBallBarTerms[k];  // 4 sigma
  }
}

// What one error of the machine reads as when the trace cannot see it.
double read_as(char axis, std::size_t direction, int power, const char* term) {
  Machine m{"wfXYZt", {}, {{'X', {}, 100}, {'Y', {}, 100}, {'Z', {}, 100}}};
  m.axes[letter_index(axis)].errors[direction].c[static_cast<std::size_t>(power)] = 1e-4;
  const BallBarFit f = decompose(simulate(m, {.R_mm = 100, .n = 40}));
  const auto k = std::ranges::find(kBallBarTerms, term) - kBallBarTerms.begin();
  EXPECT_LT(f.rms_mm, power == 2 ? 1e-9 : 1e-4);
  return f.value[static_cast<std::size_t>(k)] / 1e-4;
}

TEST(BallBar, ConfoundsWhatItSaysItConfounds) {
  // c^3 = c - s^2 c: EUU2 is a centre offset and -EUV2; likewise EVV2.
  EXPECT_NEAR(read_as('X', 0, 2, "EUV2"), -1, 1e-4);
  EXPECT_NEAR(read_as('X', 0, 2, "centre_u"), 1, 1e-4);
  EXPECT_NEAR(read_as('Y', 1, 2, "EVU2"), -1, 1e-4);
  EXPECT_GT(std::abs(read_as('X', 0, 3, "scale_u")), 1e-4);
  EXPECT_GT(std::abs(read_as('X', 1, 3, "square")), 1e-4);
  EXPECT_EQ(confounded(Plane::YZ)[0],
            "cos 3 theta carries EYY2 - EYZ2: EYZ2 is read as if EYY2 were 0");
}

TEST(BallBar, RanksByRange) {
  Machine m{"wfXYt", {}, {{'X', {}, 100}, {'Y', {}, 100}}};
  m.axes[0].errors[0].b = -5e-3;
  m.axes[1].errors[1].c[1] = 1e-3;
  const auto ranking = decompose(simulate(m, {.n = 360})).ranking;
  ASSERT_EQ(ranking.size(), 11u);
  EXPECT_EQ(ranking[0].name, "backlash_u");
  EXPECT_NEAR(ranking[0].range_mm, 1e-2, 1e-6);  // +-b |cos theta|
  // Y alone too long by 10 ppm: mean 5, mismatch 5 ppm of R, the latter +-.
  EXPECT_EQ(ranking[1].name, "scale_mismatch");
  EXPECT_NEAR(ranking[1].range_mm, 1.5e-3, 1e-6);
  EXPECT_EQ(ranking[2].name, "mean_scale");
  EXPECT_NEAR(ranking[2].range_mm, 0.75e-3, 1e-6);
}

TEST(BallBar, TooFewOrUnfitAnglesAreSaid) {
  const Reference r;
  for (const std::size_t n : {1u, 2u, 3u, 6u}) {
    BallBarTest test = r.test;
    test.n = n;
    const Trace t = simulate(r.machine, test);
    EXPECT_EQ(t.theta_rad.size(), n);
    EXPECT_NO_THROW(iso230_4(t));
    EXPECT_THROW(decompose(t), ModelRangeError) << n;
  }
  BallBarTest test = r.test;
  test.n = 8;  // cos 4 theta is a constant there
  EXPECT_THROW(decompose(simulate(r.machine, test)), ModelRangeError);
  test.n = 0;
  EXPECT_THROW(simulate(r.machine, test), std::domain_error);
  Trace t = simulate(r.machine, r.test);
  t.cw_mm.pop_back();
  EXPECT_THROW(iso230_4(t), std::domain_error);
}

TEST(BallBar, PointsWhereAnAxisReversesHaveNoSign) {
  Machine m{"wfXYt", {}, {{'X', {}, 100}, {'Y', {}, 100}}};
  m.axes[0].errors[0].b = 1e-3;
  const Trace t = simulate(m, {.n = 4, .theta0_rad = 0});
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(t.ccw_mm[k], 0, 1e-8) << k;
}

}  // namespace
}  // namespace turnwright::volumetric
