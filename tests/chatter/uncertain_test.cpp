#include "turnwright/chatter/uncertain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cutters.hpp"
#include "turnwright/chatter/limits.hpp"

namespace turnwright::chatter {
namespace {

const System& tool() {
  static const System kTool = benchmark(Directions::one, down_milling(0.1));
  return kTool;
}

double limit(const System& s, double n_rpm) {
  return speed_limits(s, n_rpm, 20).limit_mm().value();
}

double force_of(const System& s) {
  return std::get<LinearForce>(s.force).Kt_MPa /
         std::get<LinearForce>(tool().force).Kt_MPa;
}

TEST(Uncertain, SystemsLieInsideTheBandsAndFillThem) {
  const Bands bands{.frequency = 0.02,
                    .damping = 0.3,
                    .stiffness = 0.1,
                    .force = 0.2,
                    .samples = 400,
                    .seed = 9};
  const Mode& nominal = tool().modes[0];
  const auto all = drawn(tool(), bands);
  ASSERT_EQ(all.size(), 400u);
  const auto fills = [&](auto ratio, double band) {
    double least = 9, most = 0, sum = 0;
    for (const System& s : all) {
      least = std::min(least, ratio(s));
      most = std::max(most, ratio(s));
      sum += ratio(s);
    }
    EXPECT_GE(least, 1 - band);
    EXPECT_LE(most, 1 + band);
    EXPECT_GT(most - least, 1.9 * band);
    EXPECT_NEAR(sum / 400, 1, 0.1 * band);  // 3.5 standard deviations
  };
  fills([&](const System& s) { return s.modes[0].wn_rad_s / nominal.wn_rad_s; }, 0.02);
  fills([&](const System& s) { return s.modes[0].zeta / nominal.zeta; }, 0.3);
  fills([&](const System& s) { return s.modes[0].k_N_mm / nominal.k_N_mm; }, 0.1);
  fills(force_of, 0.2);
  for (const System& s : all) {
    const auto& [Kt, Kn] = std::get<LinearForce>(s.force);
    EXPECT_NEAR(Kt / Kn, 3, 1e-12);
  }
}

TEST(Uncertain, SeedsRepeatAndMoreSamplesBeginAlike) {
  const Bands few{.frequency = 0.1, .samples = 3, .seed = 5};
  Bands more = few, other = few;
  more.samples = 7;
  other.seed = 6;
  const auto a = drawn(tool(), few), b = drawn(tool(), more), c = drawn(tool(), other);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].modes[0].wn_rad_s, b[i].modes[0].wn_rad_s);
    EXPECT_NE(a[i].modes[0].wn_rad_s, c[i].modes[0].wn_rad_s);
  }
}

// Depth and force come as a product only.
TEST(Uncertain, ForceAloneDividesTheLimit) {
  const Bands bands{.force = 0.25, .samples = 41, .seed = 1};
  const auto all = drawn(tool(), bands);
  const double nominal = limit(tool(), 9500);
  const UncertainLimit at = uncertain_limit(tool(), all, bands, 9500, 20);
  EXPECT_NEAR(at.robust_mm.value() / (nominal / 1.25), 1, 1e-8);
  std::vector<double> losses;
  for (const System& s : all) losses.push_back(nominal / force_of(s));
  std::ranges::sort(losses);
  EXPECT_NEAR(at.p05_mm.value() / losses[2], 1, 1e-8);  // ranks 3, 21 and 39 of 41
  EXPECT_NEAR(at.p50_mm.value() / losses[20], 1, 1e-8);
  EXPECT_NEAR(at.p95_mm.value() / losses[38], 1, 1e-8);
}

// A mode faster by a factor has the chart of speeds slower by it.
TEST(Uncertain, FrequencyMovesTheChartAlongTheSpeeds) {
  const Bands bands{.frequency = 0.05, .samples = 1, .seed = 2};
  const auto one = drawn(tool(), bands);
  const double by = one[0].modes[0].wn_rad_s / tool().modes[0].wn_rad_s;
  const UncertainLimit at = uncertain_limit(tool(), one, bands, 12500, 20);
  const double moved = limit(tool(), 12500 / by);
  EXPECT_NEAR(at.p50_mm.value() / moved, 1, 1e-8);
  EXPECT_NEAR(at.robust_mm.value() / std::min(moved, limit(tool(), 12500)), 1, 1e-8);
}

TEST(Uncertain, RobustIsTheWorstModeUnderTheLargestForce) {
  const Bands bands{.frequency = 0.05, .force = 0.2, .samples = 1, .seed = 2};
  const auto one = drawn(tool(), bands);
  const double by = one[0].modes[0].wn_rad_s / tool().modes[0].wn_rad_s;
  int moved_is_worse = 0;
  for (const double n_rpm : {6100.0, 9000.0, 12500.0, 15000.0, 18500.0}) {
    const double moved = limit(tool(), n_rpm / by), nominal = limit(tool(), n_rpm);
    moved_is_worse += moved < nominal;
    const UncertainLimit at = uncertain_limit(tool(), one, bands, n_rpm, 20);
    EXPECT_NEAR(at.robust_mm.value() / (std::min(moved, nominal) / 1.2), 1, 1e-8);
  }
  EXPECT_GT(moved_is_worse, 0);
}

TEST(Uncertain, BeyondTheDepthAskedThereIsNoLoss) {
  const Bands bands{.force = 0.5, .samples = 20, .seed = 3};
  const auto all = drawn(tool(), bands);
  const double nominal = limit(tool(), 9500);
  const UncertainLimit none = uncertain_limit(tool(), all, bands, 9500, nominal / 1.6);
  EXPECT_FALSE(none.robust_mm || none.p05_mm || none.p50_mm || none.p95_mm);
  const UncertainLimit some = uncertain_limit(tool(), all, bands, 9500, nominal / 1.4);
  EXPECT_NEAR(some.robust_mm.value() / (nominal / 1.5), 1, 1e-8);
  EXPECT_FALSE(some.p95_mm.has_value());
}

}  // namespace
}  // namespace turnwright::chatter
