#include "turnwright/thermal/batch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace turnwright::thermal {
namespace {

const LagModel kModel{.lags = {{.tau_s = 1000, .K_um = 20}},
                      .n_max_rpm = 3000,
                      .tau_amb_s = 500,
                      .T0_degC = 20};
const Inputs kWarmUp{{0, 10000}, {3000, 3000}, {20, 20}};

double e(double t_s) { return 20 * (1 - std::exp(-t_s / 1000)); }

TEST(Batch, AWarmUpSpreadsOverTheParts) {
  const auto d =
      batch_drift(kModel, kWarmUp, {.first_s = 250, .cycle_s = 100, .parts = 9});
  ASSERT_EQ(d.drift_um.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i) {
    const double t = 250 + 100 * static_cast<double>(i);
    EXPECT_NEAR(d.drift_um[i], e(t), 1e-12);
    EXPECT_NEAR(d.since_offset_um[i], e(t) - e(250), 1e-12);
  }
  EXPECT_NEAR(d.range_um, e(1050) - e(250), 1e-12);
  EXPECT_NEAR(d.between_offsets_um, d.range_um, 1e-12);
  EXPECT_NEAR(d.largest_step_um, e(350) - e(250), 1e-12);
}

TEST(Batch, OffsetsCutTheDriftIntoPieces) {
  const Batch batch{.first_s = 0, .cycle_s = 100, .parts = 8, .offset_every = 3};
  const auto d = batch_drift(kModel, kWarmUp, batch);
  EXPECT_NEAR(d.between_offsets_um, e(200), 1e-12);  // the first three
  EXPECT_NEAR(d.range_um, e(700), 1e-12);
  EXPECT_NEAR(d.since_offset_um[4], e(400) - e(300), 1e-12);
  EXPECT_NEAR(d.since_offset_um[6], 0, 1e-12);
}

TEST(Batch, OnePartDoesNotDriftAndOneForEachOffsetNeither) {
  EXPECT_EQ(
      batch_drift(kModel, kWarmUp, {.first_s = 250, .cycle_s = 1, .parts = 1}).range_um,
      0);
  const Batch each{.first_s = 0, .cycle_s = 100, .parts = 8, .offset_every = 1};
  EXPECT_EQ(batch_drift(kModel, kWarmUp, each).between_offsets_um, 0);
}

TEST(Batch, RefusesPartsBeyondTheInputs) {
  EXPECT_THROW(batch_drift(kModel, kWarmUp, {.first_s = 0, .cycle_s = 100, .parts = 102}),
               std::domain_error);
  EXPECT_THROW(batch_drift(kModel, kWarmUp, {.first_s = -1, .cycle_s = 100, .parts = 2}),
               std::domain_error);
  EXPECT_THROW(batch_drift(kModel, kWarmUp, {.first_s = 0, .cycle_s = 100, .parts = 0}),
               std::domain_error);
  EXPECT_THROW(batch_drift(kModel, kWarmUp, {.first_s = 0, .cycle_s = 0, .parts = 2}),
               std::domain_error);
}

}  // namespace
}  // namespace turnwright::thermal
