#include "chatter/model/engagement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>

#include "cutters.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::chatter {
namespace {

Cutter helical(int teeth) {
  Cutter c{.system = benchmark(Directions::two, {.entry_rad = 0.4, .exit_rad = 1.9}),
           .helix_rad = 0.6,
           .diameter_mm = 8};
  c.system.teeth = teeth;
  return c;
}

/// (1) of cutter.hpp by the midpoint rule over the height.
Directional sliced(const Cutter& c, double angle_rad, double ap_mm) {
  const auto& k = std::get<LinearForce>(c.system.force);
  constexpr int kSlices = 200000;
  Directional out;
  for (int j = 0; j < c.system.teeth; ++j)
    for (int i = 0; i < kSlices; ++i) {
      const double z = (i + 0.5) * ap_mm / kSlices;
      const double phi = std::remainder(
          angle_rad - j * 2 * units::kPi / c.system.teeth - lag_rad_mm(c) * z,
          2 * units::kPi);
      if (phi < c.system.entry_rad || phi > c.system.exit_rad) continue;
      const double s = std::sin(phi), co = std::cos(phi), dz = ap_mm / kSlices;
      out.xx += (k.Kt_MPa * s * co + k.Kn_MPa * s * s) * dz;
      out.yx += (-k.Kt_MPa * s * s + k.Kn_MPa * s * co) * dz;
    }
  return out;
}

TEST(CutterEngagement, EdgesThatWindRoundManyTimesMeetWhatTheirSlicesMeet) {
  const Cutter c = helical(3);
  const double turn_mm = 2 * units::kPi / lag_rad_mm(c);
  for (const double turns : {0.3, 1.2, 2.7, 9.4})
    for (const double angle : {0.1, 1.0, 1.9}) {
      const double ap = turns * turn_mm;
      const Load load = CutterEngagement(c, 6000, ap).load(angle);
      const Directional right = sliced(c, angle, ap);
      EXPECT_NEAR(load.regenerative[0].xx, right.xx, 1e-4 * 600 * ap) << turns;
      EXPECT_NEAR(load.regenerative[0].yx, right.yx, 1e-4 * 600 * ap) << turns;
    }
}

// Every whole turn adds the same at every angle.
TEST(CutterEngagement, DepthsOfTurnsBeyondCountingAddWhatOneAdds) {
  const Cutter c = helical(2);
  const double turn_mm = 2 * units::kPi / lag_rad_mm(c);
  const double one = CutterEngagement(c, 6000, turn_mm).load(0.7).regenerative[0].xx;
  for (const double angle : {0.2, 1.5}) {
    const double much =
        CutterEngagement(c, 6000, 1e12 * turn_mm).load(angle).regenerative[0].xx;
    EXPECT_NEAR(much / (1e12 * one), 1, 1e-9);
  }
}

TEST(CutterEngagement, KinksAreTheDistancesOfItsEnds) {
  const Cutter c = helical(2);
  const double lag = lag_rad_mm(c), cut = 1.9 - 0.4, pitch = units::kPi;
  const auto kinks = kinks_mm(c, 6000, 0.9 * pitch / lag);
  ASSERT_EQ(kinks.size(), 2U);
  EXPECT_NEAR(kinks[0], cut / lag, 1e-12);
  EXPECT_NEAR(kinks[1], (pitch - cut) / lag, 1e-12);
  EXPECT_TRUE(kinks_mm(c, 6000, 1e9 * pitch / lag).empty());
}

TEST(CutterEngagement, OfManyTeethThatRunOutCanBeLeft) {
  Cutter c = helical(100);
  c.feed_mm = 0.1;
  for (int j = 0; j < c.system.teeth; ++j) c.offset_mm.push_back(j % 7 * 0.01);
  std::stop_source work;
  const auto stop = work.get_token();
  const Listening listening(stop);
  EXPECT_FALSE(CutterEngagement(c, 6000, 1).ends().empty());
  work.request_stop();
  EXPECT_THROW(CutterEngagement(c, 6000, 1), Cancelled);
  EXPECT_THROW(kinks_mm(c, 6000, 1), Cancelled);
}

}  // namespace
}  // namespace turnwright::chatter
