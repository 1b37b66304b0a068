// A live centre in the way of a tool: by the definition over a fine grid, and by hand.
#include "turnwright/catalogue/live_centre.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "turnwright/catalogue/tool_outline.hpp"

namespace turnwright::catalogue {
namespace {

const double kTan30 = std::tan(M_PI / 6);

Tool finisher() {
  Tool t;
  t.insert = "DNMG 150604";
  t.kapr_deg = 93;
  t.re_mm = 0.4;
  t.holder = Holder{"PDJNL 2525M 15", 25, 25, 150, 33, 32};
  return t;
}

double lowest_at(const ConvexOutline& all, double z) {
  double low = INFINITY;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto &a = all[k], &b = all[(k + 1) % all.size()];
    const double s = (z - a.z_mm) / (b.z_mm - a.z_mm);
    if (s >= 0 && s <= 1) low = std::min(low, a.h_mm + s * (b.h_mm - a.h_mm));
  }
  return low;
}

double by_definition(const Tool& t, const LiveCentre& c, double hole, double z_tip) {
  auto pieces = outline(t).holder;
  pieces.push_back(outline(t).insert);
  const double body_z = c.point_length_mm - hole / 2 / kTan30;
  double most = 0;
  for (int i = 0; i <= 80000; ++i) {
    const double z = i * 1e-3;
    const double r =
        z >= body_z ? c.body_mm / 2 : std::min(c.point_mm / 2, hole / 2 + z * kTan30);
    for (const auto& p : pieces) most = std::max(most, r - lowest_at(p, z - z_tip));
  }
  return most;
}

TEST(LiveCentre, IsClearedWhereNothingOfTheToolIsInIt) {
  auto alone = finisher();
  alone.holder.reset();
  for (const LiveCentre c :
       {LiveCentre{}, LiveCentre{10, 30, 60}, LiveCentre{16, 45, 50}})
    for (const double hole : {4.0, 6.7, 10.0})
      for (const double z : {-12.0, -3.0, 2.4}) {
        EXPECT_NEAR(clear_radius_mm(finisher(), c, hole, z),
                    by_definition(finisher(), c, hole, z), 4e-3);
        EXPECT_NEAR(clear_radius_mm(alone, c, hole, z), by_definition(alone, c, hole, z),
                    4e-3);
      }
}

// The holder's far side stands 32 mm from the tip.
TEST(LiveCentre, TheBodyIsMetFirstByTheFarSideOfTheHolder) {
  const LiveCentre c{10, 30, 60};
  const double hole = 6, body_z = 30 - hole / 2 / kTan30;
  EXPECT_LT(clear_radius_mm(finisher(), c, hole, body_z - 32 - 1e-6), 5);
  EXPECT_GT(clear_radius_mm(finisher(), c, hole, body_z - 32 + 1e-6), 9);
}

// A bull-nose centre as wide as the bore, behind which the body begins.
TEST(LiveCentre, ABoreWiderThanThePointHasACentreAsWide) {
  auto alone = finisher();
  alone.holder.reset();
  const LiveCentre c{16, 55, 60};
  EXPECT_NEAR(clear_radius_mm(alone, c, 50, 2.4), 25 + 0.35, 0.01);  // its sharp corner
  EXPECT_GT(clear_radius_mm(finisher(), c, 50, 2.4),
            clear_radius_mm(finisher(), c, 20, 2.4));
}

TEST(LiveCentre, MoreOfItIsNeverLessInTheWay) {
  double before = 0;
  for (const double z : {-40.0, -20.0, -10.0, 0.0, 2.0, 5.0, 20.0}) {
    const auto t = finisher();
    const double at = clear_radius_mm(t, {}, 6.7, z);
    EXPECT_GE(at, before) << z;
    before = at;
    EXPECT_GE(clear_radius_mm(t, {26, 32, 60}, 6.7, z), at);
    EXPECT_GE(clear_radius_mm(t, {25, 30, 60}, 6.7, z), at);
    EXPECT_GE(clear_radius_mm(t, {25, 32, 70}, 6.7, z), at);
    EXPECT_GE(clear_radius_mm(t, {25, 32, 60}, 8.5, z), at);
  }
}

}  // namespace
}  // namespace turnwright::catalogue
