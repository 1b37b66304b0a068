#include "turnwright/cutting/cut.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace turnwright::cutting {
namespace {

using Grad = Dual<double, 2>;

Cut steel(double kapr_deg = 95, double re_mm = 0.8) {
  Cut c;
  c.kc = {1600, 0.25};
  c.thrust = {0.4, 56, 20, 850};
  c.taylor = {450, 0.255, 0.35, 0.15};
  c.corner = corner_of(re_mm, kapr_deg * std::numbers::pi / 180);
  c.minor_kapr_rad = 0.087;
  c.hmin_mm = 0.005;
  return c;
}

TEST(Cut, KienzleAtOneMillimetreIsTheMaterialsConstant) {
  // Sharp edge at 90 deg with ap = 1: L = 1 + f/2 is 1 only without the minor edge, so
  // ask the law itself: b = L = 1, h = ap f/L = 1.
  EXPECT_DOUBLE_EQ(kienzle_N(Kienzle{1600, 0.25}, 1.0, 1.0, 1.0), 1600);
  EXPECT_DOUBLE_EQ(kienzle_N(Kienzle{1600, 0.25}, 2.0, 2.0, 1.0), 3200);  // b 2, h 1
  EXPECT_NEAR(kienzle_N(Kienzle{1600, 0.25}, 1.0, 1.0, 0.1), 1600 * std::pow(0.1, 0.75),
              1e-9);
}

TEST(Cut, EdgeIsArcThenStraightAndJoinsSmoothly) {
  for (const double kapr : {45.0, 75.0, 90.0, 95.0, 107.5}) {
    const auto c = steel(kapr);
    const double corner = c.corner.depth_mm, h = 1e-6;
    const double below = engaged_edge_mm(c, corner - h, 0.2);
    const double at = engaged_edge_mm(c, corner, 0.2);
    const double above = engaged_edge_mm(c, corner + h, 0.2);
    EXPECT_NEAR(at, c.corner.re_mm * c.corner.kapr_rad + 0.1,
                1e-12);  // the whole arc and f/2
    EXPECT_NEAR((at - below) / h, 1 / std::sin(c.corner.kapr_rad), 1e-5);
    EXPECT_NEAR((above - at) / h, 1 / std::sin(c.corner.kapr_rad), 1e-9);
  }
  const auto sharp = steel(60, 0);
  EXPECT_NEAR(engaged_edge_mm(sharp, 2.0, 0.2), 2 / std::sin(sharp.corner.kapr_rad) + 0.1,
              1e-13);
}

TEST(Cut, ForcesOfASharpEdgeFollowItsAngle) {
  // kappa_eff -> kappa for ap >> f: chord = edge; F_D normal to it.
  const auto c = steel(60, 0);
  const auto F = forces_N(c, 5.0, 1e-6);
  const double F_D = 0.4 * F.Fc_N + 56 * 5 / c.corner.sine;
  EXPECT_NEAR(F.Ff_N / F_D, std::sin(c.corner.kapr_rad), 1e-6);
  EXPECT_NEAR(F.Fp_N / F_D, std::cos(c.corner.kapr_rad), 1e-6);
  const auto shallow = forces_N(steel(95), 0.1, 0.2);  // on the corner: mostly passive
  EXPECT_GT(shallow.Fp_N, 1.5 * shallow.Ff_N);
  auto own = steel();
  own.kf = Kienzle{400, 0.7};
  own.kp = Kienzle{300, 0.5};
  EXPECT_DOUBLE_EQ(forces_N(own, 2.0, 0.3).Fp_N,
                   kienzle_N(*own.kp, engaged_edge_mm(own, 2.0, 0.3), 2.0, 0.3));
}

// The section between an edge moved in by w and along the feed by z and the surface it left
// a turn before, by quadrature: its slopes are the edge's axial extent ap u and its depth.
TEST(Cut, ChatterStiffnessesAreThePressureTimesTheSectionsSlopes) {
  const double f = 0.2, h = 1e-4;
  for (const double ap : {0.1, 0.5, 2.0}) {
    const auto c = steel(75, 0.8);
    const double r = c.corner.re_mm, join = r * c.corner.sine;
    const auto edge = [&](double z) {  // height of the edge over its lowest point
      if (z > join) return c.corner.depth_mm + (z - join) / c.corner.cotangent;
      return r - std::sqrt(r * r - z * z);
    };
    const auto section = [&](double w, double along) {
      constexpr int kSteps = 2000000;
      const double low = -0.5 * f, high = f + 2;
      double sum = 0;
      for (int k = 0; k < kSteps; ++k) {
        const double z = low + (high - low) * (k + 0.5) / kSteps;
        sum += std::max(0.0, std::min(ap, edge(z)) - edge(z - f - along) + w);
      }
      return sum * (high - low) / kSteps;
    };
    const double slope = (section(h, 0) - section(-h, 0)) / (2 * h);
    const double u = flow_cotangent(c, ap, f);
    EXPECT_NEAR(slope, ap * u, 1e-3 * slope) << ap;
    const double along = (section(0, h) - section(0, -h)) / (2 * h);
    EXPECT_NEAR(along, ap - f * f / (8 * r), 2e-3 * ap) << ap;  // without the feed mark
    const auto F = forces_N(c, ap, f);
    const double F_D = std::hypot(F.Ff_N, F.Fp_N);
    const double Fp = 0.4 * F.Fc_N * F.Fp_N / F_D;  // the parts that do not plough
    const double Ff = 0.4 * F.Fc_N * F.Ff_N / F_D;
    const auto K = chatter_stiffnesses_N_mm(c, ap, f);
    EXPECT_EQ(K.ww, chatter_stiffness_N_mm(c, ap, f));
    EXPECT_NEAR(K.ww, Fp / (ap * f) * slope, 1e-3 * K.ww);
    EXPECT_NEAR(K.zz, Ff / f, 1e-9 * K.zz);
    // A compliance in one direction of the plane, at any angle.
    for (const double angle : {0.3, 1.0, 2.0}) {
      const double w = std::cos(angle), z = std::sin(angle);
      const double gain = (Fp * w + Ff * z) * (ap * u * w + ap * z) / (ap * f);
      EXPECT_NEAR(K.ww * w * w + 2 * K.wz * w * z + K.zz * z * z, gain, 1e-9 * K.zz);
    }
  }
}

// Constants of its own by component: the forces do not follow the chord, the gain is that
// of one mode all the same.
TEST(Cut, ChatterStiffnessesOfOwnFeedAndPassiveForces) {
  auto c = steel(95, 0.8);
  c.kf = Kienzle{400, 0.7};
  c.kp = Kienzle{300, 0.5};
  const double ap = 1.3, f = 0.2, u = flow_cotangent(c, ap, f);
  const auto F = forces_N(c, ap, f);
  const auto K = chatter_stiffnesses_N_mm(c, ap, f);
  for (const double z : {-0.7, 0.2, 1.5})
    EXPECT_NEAR(K.ww + 2 * K.wz * z + K.zz * z * z, (F.Fp_N + F.Ff_N * z) * (u + z) / f,
                1e-9 * K.zz);
}

// What an edge of 95 deg loses by radial motion beyond its corner it gains along the feed.
TEST(Cut, AlongTheFeedTheChatterStiffnessGrowsWithTheDepth) {
  const auto c = steel(95, 0.4);
  auto before = chatter_stiffnesses_N_mm(c, 0.5, 0.1);
  for (const double ap : {0.7, 1.0, 2.0, 4.0}) {
    const auto K = chatter_stiffnesses_N_mm(c, ap, 0.1);
    EXPECT_LT(K.ww, before.ww);
    EXPECT_GT(K.zz, before.zz);
    before = K;
  }
}

// Whether a value and its changes from the one before lie in an enclosure.
void expect_enclosed(const Dual<Interval, 2>& box, double K, double before,
                     const std::array<double, 2>& step) {
  const double slack = 1e-9 * (1 + std::abs(K));
  EXPECT_LE(box.v.lo, K + slack);
  EXPECT_GE(box.v.hi, K - slack);
  const Interval change = box.d[0] * Interval(step[0]) + box.d[1] * Interval(step[1]);
  EXPECT_LE(change.lo, K - before + slack);
  EXPECT_GE(change.hi, K - before - slack);
}

// Enclosed over boxes, where an obtuse edge pulls too.
TEST(Cut, ChatterStiffnessesAreEnclosed) {
  using L = LogDual<2>;
  std::mt19937 seed(11);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 300; ++trial) {
    auto c = steel(60 + 50 * unit(seed), 0.2 + unit(seed));
    if (trial % 3 == 0) c.kf = c.kp = Kienzle{500, 0.4};
    if (trial % 5 == 0) c = worn(c, 0.2, 0.3);
    const double w = unit(seed);
    const Interval y(std::log(0.2) + 2 * unit(seed)), z(std::log(0.08) + unit(seed));
    const Interval ap(y.lo, y.lo + w), f(z.lo, z.lo + w);
    const L::Half half{w / 2, w / 2};
    const auto box =
        chatter_stiffnesses_N_mm(c, L::variable(ap, 0, half), L::variable(f, 1, half));
    std::array<double, 2> at{mid(ap), mid(f)};
    auto before = chatter_stiffnesses_N_mm(c, std::exp(at[0]), std::exp(at[1]));
    for (int k = 0; k < 5; ++k) {
      const std::array<double, 2> x{ap.lo + w * unit(seed), f.lo + w * unit(seed)};
      const std::array<double, 2> step{x[0] - at[0], x[1] - at[1]};
      const auto K = chatter_stiffnesses_N_mm(c, std::exp(x[0]), std::exp(x[1]));
      expect_enclosed(box.ww, K.ww, before.ww, step);
      expect_enclosed(box.wz, K.wz, before.wz, step);
      expect_enclosed(box.zz, K.zz, before.zz, step);
      before = K;
      at = x;
    }
  }
}

// The land presses along the engaged edge in the direction of flow, and leaves chatter as
// it was; half the land serves half the life.
TEST(Cut, AWornEdgePressesOnItsLand) {
  auto c = steel();
  for (const bool own : {false, true}) {
    if (own) c.kf = Kienzle{400, 0.7}, c.kp = Kienzle{300, 0.5};
    const auto w = worn(c, 0.15, 0.3);
    const auto F = forces_N(c, 0.5, 0.1), G = forces_N(w, 0.5, 0.1);
    const double L = engaged_edge_mm(c, 0.5, 0.1), land = 850 * 0.15 * L;
    EXPECT_NEAR(G.Fc_N - F.Fc_N, 0.4 * land, 1e-9);
    EXPECT_NEAR(std::hypot(G.Ff_N - F.Ff_N, G.Fp_N - F.Fp_N), land, 1e-9);
    EXPECT_NEAR((G.Fp_N - F.Fp_N) / (G.Ff_N - F.Ff_N), flow_cotangent(c, 0.5, 0.1), 1e-9);
    EXPECT_EQ(chatter_stiffness_N_mm(c, 0.5, 0.1), chatter_stiffness_N_mm(w, 0.5, 0.1));
    EXPECT_NEAR(tool_life_min(w, 200.0, 0.1, 0.5), tool_life_min(c, 200.0, 0.1, 0.5) / 2,
                1e-9);
  }
}

// Two profiles that know nothing of each other add by squares; without a number of the
// material the surface is that of the new edge.
TEST(Cut, TheLandsGroovesAddToTheProfileOfTheFeed) {
  auto c = steel();
  EXPECT_EQ(Ra_um(worn(c, 0.2, 0.3), 0.1), Ra_um(c, 0.1));
  c.land_Ra_um_mm = 5;
  EXPECT_EQ(Ra_um(c, 0.1), feed_Rz_um(c, 0.1) * (8 / (18 * std::sqrt(3.0))));
  const auto w = worn(c, 0.2, 0.3);
  EXPECT_NEAR(Ra_um(w, 0.1), std::hypot(Ra_um(c, 0.1), 1.0), 1e-12);
  EXPECT_NEAR(Rz_um(w, 0.1), std::hypot(Rz_um(c, 0.1), 4.5), 1e-12);
}

TEST(Cut, LifeAndSpeedAreOneLaw) {
  const auto c = steel();
  const double v = speed_for_life_m_min(c, 17.0, 0.25, 1.7);
  EXPECT_NEAR(tool_life_min(c, v, 0.25, 1.7), 17, 1e-12);
  EXPECT_NEAR(tool_life_min(c, 2 * v, 0.25, 1.7), 17 * std::pow(0.5, 1 / 0.255), 1e-12);
}

// Half the depth, 2^(b/n) times the life; at 1 mm both laws agree.
TEST(Cut, ShallowCutsMayHaveTheirOwnExponentOfTheDepth) {
  auto c = steel();
  const auto life = [&](double ap) { return tool_life_min(c, 200.0, 0.2, ap); };
  const double one = life(1), two = life(2), half = life(0.5);
  EXPECT_NEAR(half / one, std::pow(2, 0.15 / 0.255), 1e-12);
  c.taylor.b_shallow = 0.04;
  EXPECT_EQ(life(1), one);
  EXPECT_EQ(life(2), two);
  EXPECT_NEAR(life(0.5) / one, std::pow(2, 0.04 / 0.255), 1e-12);
  EXPECT_NEAR(tool_life_min(c, speed_for_life_m_min(c, 17.0, 0.25, 0.3), 0.25, 0.3), 17,
              1e-12);
}

TEST(Cut, EconomicLifeMakesTheCostStationary) {
  const auto c = steel();
  const double change = 1.5, ratio = 4.0, f = 0.3, ap = 2;
  const auto cost = [&](double v) {
    return 1 / v * (1 + (change + ratio) / tool_life_min(c, v, f, ap));
  };
  const double v = speed_for_life_m_min(c, economic_life_min(c, change, ratio), f, ap);
  for (const double step : {0.99, 1.01}) EXPECT_GT(cost(v * step), cost(v));
  EXPECT_NEAR((cost(v * 1.0001) - cost(v / 1.0001)) / cost(v) / 2e-4, 0, 1e-6);
}

TEST(Cut, RoughnessHasBrammertzFloor) {
  auto c = steel();
  const double f = std::sqrt(2 * c.corner.re_mm * c.hmin_mm);
  EXPECT_NEAR(Rz_um(c, f), 1000 * c.hmin_mm, 1e-12);
  EXPECT_GT(Rz_um(c, 0.9 * f), Rz_um(c, f));
  EXPECT_GT(Rz_um(c, 1.1 * f), Rz_um(c, f));
  c.hmin_mm = 0;
  EXPECT_NEAR(Ra_um(c, 0.2), 1000 * 0.04 / (18 * std::sqrt(3.0) * 0.8), 1e-12);
  EXPECT_NEAR(Rz_um(c, 0.2), 1000 * 0.04 / (8 * 0.8), 1e-12);
}

// Twice the rounding, twice the thickness that still makes a chip; what is not known
// changes nothing.
TEST(Cut, TheLeastChipIsInProportionToTheRoundedEdge) {
  catalogue::Material m;
  m.hmin_mm = 0.002;
  catalogue::Tool t;
  t.edge_um = 25;
  EXPECT_EQ(cut_of(m, t).hmin_mm, 0.002);
  m.hmin_edge_um = 50;
  EXPECT_NEAR(cut_of(m, t).hmin_mm, 0.001, 1e-18);
  t.edge_um = 100;
  EXPECT_NEAR(cut_of(m, t).hmin_mm, 0.004, 1e-18);
  t.edge_um = 0;
  EXPECT_EQ(cut_of(m, t).hmin_mm, 0.002);
}

TEST(Cut, RakeCorrectsOnePercentADegreeWithinLimits) {
  catalogue::Material m;
  m.kc = {1600, 0.25};
  m.gamma0_deg = 6;
  catalogue::Tool t;
  t.gamma_deg = -6;
  EXPECT_NEAR(cut_of(m, t).kc.k11_MPa, 1600 * 1.12, 1e-9);
  t.gamma_deg = 60;
  EXPECT_NEAR(cut_of(m, t).kc.k11_MPa, 1600 * 0.7, 1e-9);
}

TEST(Cut, GradientsAndEnclosuresAgreeWithTheNumbers) {
  std::mt19937 seed(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 500; ++trial) {
    const auto c = steel(45 + 60 * unit(seed), 0.2 + unit(seed));
    const double ap = 0.05 + 3 * unit(seed), f = 0.05 + 0.5 * unit(seed);
    const auto all = [&](auto a, auto g) {
      const auto F = forces_N(c, a, g);
      return std::array{F.Fc_N, F.Ff_N, F.Fp_N, Rz_um(c, g),
                        tool_life_min(c, decltype(a)(200.0), g, a)};
    };
    const auto value = all(ap, f);
    const auto grad = all(variable<double, 2>(ap, 0), variable<double, 2>(f, 1));
    const double h = 1e-6;
    const auto up = all(ap * (1 + h), f), down = all(ap * (1 - h), f);
    for (std::size_t k = 0; k < value.size(); ++k) {
      const double size = std::abs(value[k]);  // Fp of an obtuse edge may pull
      EXPECT_NEAR(grad[k].v, value[k], 1e-12 * size);
      EXPECT_NEAR(grad[k].d[0], (up[k] - down[k]) / (2 * h * ap), 1e-5 * size / ap) << k;
    }
  }
}

// Value and elasticities of every function at random points of random boxes, whole ranges
// of depth and feed and small ones, must lie in what LogDual says of the box.
TEST(Cut, BoxesHoldValuesAndElasticities) {
  std::mt19937 seed(6);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto linear_of = [](const auto& x) { return linear(x); };
  for (int trial = 0; trial < 3000; ++trial) {
    auto c = steel(45 + 70 * unit(seed), trial % 9 == 0 ? 0 : 0.2 + unit(seed));
    if (trial % 7 == 0) c.kf = Kienzle{400, 0.7}, c.kp = Kienzle{300, 0.5};
    if (trial % 5 == 0) c = worn(c, 0.3 * unit(seed) + 0.01, 0.3);
    if (trial % 4 == 0) c.taylor.b_shallow = 0.3 * unit(seed);
    const double size = std::pow(unit(seed), 3);  // of the box
    const Interval ap = log(Interval(0.05, 6)), f = log(Interval(0.03, 0.8));
    const auto part = [&](const Interval& x) {
      const double low = x.lo + (1 - size) * unit(seed) * width(x);
      return Interval(low, low + size * width(x));
    };
    const std::array<Interval, 2> box{part(ap), part(f)};
    const LogDual<2>::Half half{width(box[0]) / 2, width(box[1]) / 2};
    const auto all = [&](auto a, auto g) {
      const auto F = forces_N(c, a, g);
      const auto scaled = forces_N(c, a, g, a);
      auto life = tool_life_min(c, decltype(a)(200.0), g, a);
      return std::array{linear_of(F.Fc_N), linear_of(F.Ff_N),      F.Fp_N,
                        scaled.Fp_N,       linear_of(Rz_um(c, g)), linear_of(life)};
    };
    const auto over =
        all(LogDual<2>::variable(box[0], 0, half), LogDual<2>::variable(box[1], 1, half));
    for (int k = 0; k < 5; ++k) {
      using D = Dual<double, 2>;
      const double y0 = box[0].lo + unit(seed) * width(box[0]);
      const double y1 = box[1].lo + unit(seed) * width(box[1]);
      const auto at =
          all(exp(variable<double, 2>(y0, 0)), exp(variable<double, 2>(y1, 1)));
      for (std::size_t i = 0; i < at.size(); ++i) {
        if (i == 4 && !(c.corner.re_mm > 0)) continue;
        const D& x = at[i];
        const double slack = 1e-11 * (std::abs(x.v) + std::abs(at[0].v));
        EXPECT_LE(over[i].v.lo, x.v + slack) << i;
        EXPECT_GE(over[i].v.hi, x.v - slack) << i;
        for (std::size_t j = 0; j < 2; ++j) {
          EXPECT_LE(over[i].d[j].lo, x.d[j] + slack) << i << j;
          EXPECT_GE(over[i].d[j].hi, x.d[j] - slack) << i << j;
        }
      }
    }
  }
}

}  // namespace
}  // namespace turnwright::cutting
