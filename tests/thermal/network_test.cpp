#include "turnwright/thermal/network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <stop_token>

#include "turnwright/base/cancelled.hpp"

namespace turnwright::thermal {
namespace {

struct Data {
  std::vector<Row> rows;
  std::vector<double> error_um;
};

// Speeds by ambients; the operation time goes with both, the feed does not vary.
Data grid() {
  Data d;
  for (int i = 0; i <= 12; ++i)
    for (int j = 0; j <= 12; ++j) {
      const double n = 250.0 * i, T = 18 + 0.5 * j, t = 100.0 * (i + j);
      d.rows.push_back({n, 200, t, T});
      d.error_um.push_back(10 * std::tanh(n / 1500 - 1) - 0.8 * (T - 20) + 0.001 * t);
    }
  return d;
}

TEST(Network, LearnsASmoothFunction) {
  const auto d = grid();
  const Network net = train(d.rows, d.error_um, {.decay = 1e-6});
  EXPECT_LT(net.rms_um, 0.05);
  // Between the rows it was trained on.
  const double e = 10 * std::tanh(1375.0 / 1500 - 1) - 0.8 * 0.75 + 0.001 * 1100;
  EXPECT_NEAR(drift_um(net, {1375, 200, 1100, 20.75}), e, 0.1);
}

// (10) at the weights found and next to them, by (9) alone: no neighbour is lower.
TEST(Network, EndsWhereTheLossIsLeast) {
  const auto d = grid();
  Network net = train(d.rows, d.error_um, {.hidden = 3, .decay = 0.01});
  const auto loss = [&] {
    double sum = 0, squares = 0;
    for (std::size_t k = 0; k < d.rows.size(); ++k)
      sum += std::pow((drift_um(net, d.rows[k]) - d.error_um[k]) / net.error_scale_um, 2);
    for (const double w : net.weights) squares += w * w;
    return 0.5 * sum / static_cast<double>(d.rows.size()) +
           0.005 * squares / static_cast<double>(net.weights.size());
  };
  const double least = loss();
  ASSERT_EQ(net.weights.size(), 3u * 6 + 1);
  for (double& w : net.weights)
    for (const double step : {-0.05, 0.05}) {
      const double kept = w;
      w += step;
      EXPECT_GT(loss(), least);
      w = kept;
    }
}

TEST(Network, TheSeedDecidesEverything) {
  const auto d = grid();
  const auto weights = [&](std::uint64_t seed) {
    return train(d.rows, d.error_um, {.seed = seed, .starts = 1, .max_evaluations = 20})
        .weights;
  };
  EXPECT_EQ(weights(7), weights(7));
  EXPECT_NE(weights(7), weights(8));
}

TEST(Network, AnInputThatNeverVariedHasNoSay) {
  const auto d = grid();
  const Network net = train(d.rows, d.error_um, {.max_evaluations = 20});
  EXPECT_EQ(drift_um(net, {1000, 200, 900, 20}), drift_um(net, {1000, 900, 900, 20}));
  EXPECT_EQ(reach(net, {1000, 900, 900, 20}), Reach::outside);
}

TEST(Network, SaysWhereItKnowsNothing) {
  const auto d = grid();
  const Network net = train(d.rows, d.error_um, {.max_evaluations = 20});
  EXPECT_EQ(reach(net, {1500, 200, 1200, 21}), Reach::inside);
  EXPECT_EQ(reach(net, {0, 200, 0, 18}), Reach::inside);  // a corner
  EXPECT_EQ(reach(net, {3100, 200, 1200, 21}), Reach::outside);
  EXPECT_EQ(reach(net, {1500, 200, 1200, 17.9}), Reach::outside);
  // Each in its range, but a full speed was never seen at time 0.
  EXPECT_EQ(reach(net, {3000, 200, 0, 21}), Reach::between_rows);
  EXPECT_EQ(reach(net, {NAN, 200, 1200, 21}), Reach::outside);
}

TEST(Network, HearsThatNobodyWaits) {
  const auto d = grid();
  const Network net = train(d.rows, d.error_um, {.max_evaluations = 20});
  std::stop_source source;
  source.request_stop();
  const std::stop_token token = source.get_token();
  const Listening listening(token);
  EXPECT_THROW(reach(net, {1500, 200, 1200, 21}), Cancelled);
}

TEST(Network, RefusesRowsWithoutErrors) {
  const auto d = grid();
  EXPECT_THROW(train(d.rows, {}), std::domain_error);
  EXPECT_THROW(train({}, {}), std::domain_error);
}

}  // namespace
}  // namespace turnwright::thermal
