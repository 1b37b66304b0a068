#include "turnwright/volumetric/kinematics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "machines.hpp"

namespace turnwright::volumetric {
namespace {

using testing::RandomMachines;
using testing::reference;

double distance(const Vec3& a, const Vec3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
Vec3 difference(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

TEST(Kinematics, ReproducesTheReferenceChains) {
  const auto file = reference();
  int points = 0;
  for (const auto& chain : file["chains"]) {
    const Kinematics k(testing::machine(chain));
    for (const auto& point : chain["points"]) {
      const Position at = testing::position(point);
      const ToolPose nominal = k.nominal(at), actual = k.actual(at);
      EXPECT_LE(distance(nominal.tip_mm, point["tip_nominal"]), 1e-10);
      EXPECT_LE(distance(k.tip_error_mm(at), point["tip_error"]), 1e-10);
      EXPECT_LE(distance(k.tip_error_first_order_mm(at), point["tip_error_first_order"]),
                1e-10);
      EXPECT_LE(distance(difference(actual.direction, nominal.direction),
                         point["tooldir_error"]),
                1e-12);
      ++points;
    }
  }
  EXPECT_EQ(points, 16);
}

// ---- The same chains as screws: unit dual quaternions, r + eps d.
struct DualQuaternion {
  Eigen::Quaterniond r = Eigen::Quaterniond::Identity();
  Eigen::Quaterniond d = Eigen::Quaterniond(0, 0, 0, 0);
};

DualQuaternion operator*(const DualQuaternion& a, const DualQuaternion& b) {
  const Eigen::Quaterniond u = a.r * b.d, v = a.d * b.r;
  return {a.r * b.r, Eigen::Quaterniond(u.coeffs() + v.coeffs())};
}
DualQuaternion inverse(const DualQuaternion& a) {
  return {a.r.conjugate(), a.d.conjugate()};
}
DualQuaternion shift(double x, double y, double z) {
  return {Eigen::Quaterniond::Identity(), Eigen::Quaterniond(0, x / 2, y / 2, z / 2)};
}
/// A turn about the line of direction `k` through `through`: exp of a screw.
DualQuaternion turn(int k, double angle, const Vec3& through = {}) {
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k),
                        moment = Eigen::Map<const Eigen::Vector3d>(through.data())
                                     .cross(axis) *
                                 std::sin(angle / 2);
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)),
          Eigen::Quaterniond(0, moment.x(), moment.y(), moment.z())};
}
Eigen::Vector3d moved(const DualQuaternion& a, const Vec3& p) {
  const Eigen::Quaterniond t = a.d * a.r.conjugate();
  return a.r * Eigen::Map<const Eigen::Vector3d>(p.data()) + 2 * t.vec();
}

double error(const ErrorFunction& e, double q, double Q, double sign) {
  const double t = q / Q;
  double sum = e.b * sign;
  for (std::size_t n = 0; n < 4; ++n) sum += e.c[n] * std::pow(t, static_cast<double>(n));
  for (std::size_t h = 0; h < e.f.size(); ++h) {
    const auto order = static_cast<double>(h + 1);
    sum += e.f[h].a * std::cos(order * q) + e.f[h].d * std::sin(order * q);
  }
  return sum;
}

DualQuaternion joint(const Axis& axis, double sigma, const Position& at) {
  const std::size_t k = letter_index(axis.name);
  const double q = at.q[k];
  std::array<double, 6> E;
  for (std::size_t i = 0; i < 6; ++i) E[i] = error(axis.errors[i], q, axis.Q, at.sign[k]);
  const auto& p = axis.p_mm;
  const auto& l = axis.location;
  // Turns about lines through p instead of shifts there and back.
  if (!is_rotary(axis.name)) {
    const auto at_p = turn(2, E[5], p) * turn(1, E[4], p) * turn(0, E[3], p);
    Vec3 u{};
    if (axis.name == 'X') u = {1, l[5], -l[4]};
    if (axis.name == 'Y') u = {-l[5], 1, l[3]};
    if (axis.name == 'Z') u = {l[4], -l[3], 1};
    const double way = sigma * q / std::hypot(u[0], u[1], u[2]);
    return shift(way * u[0], way * u[1], way * u[2]) * shift(E[0], E[1], E[2]) * at_p;
  }
  const auto placed =
      shift(l[0], l[1], l[2]) * turn(2, l[5], p) * turn(1, l[4], p) * turn(0, l[3], p);
  return placed * shift(E[0], E[1], E[2]) * turn(2, E[5], p) * turn(1, E[4], p) *
         turn(0, E[3], p) * turn(static_cast<int>(k) - 3, sigma * q, p);
}

struct ScrewPose {
  Eigen::Vector3d tip, direction;
};

ScrewPose by_screws(const Machine& m, const Position& at) {
  const auto axis = [&m](char name) {
    return *std::ranges::find_if(m.axes,
                                 [name](const Axis& a) { return a.name == name; });
  };
  DualQuaternion work, tool;
  const std::size_t bed = m.chain.find('f');
  for (std::size_t i = bed - 1; i > 0; --i) work = work * joint(axis(m.chain[i]), -1, at);
  for (std::size_t i = bed + 1; i + 1 < m.chain.size(); ++i)
    tool = tool * joint(axis(m.chain[i]), 1, at);
  const auto both = inverse(work) * tool;
  return {moved(both, m.tool_point_mm), both.r * Eigen::Vector3d::UnitZ()};
}

TEST(Kinematics, AgreesWithDualQuaternionsOnRandomChains) {
  RandomMachines random(7);
  for (int i = 0; i < 500; ++i) {
    const Machine m = random.machine(i % 2 == 0 ? 0.02 : 2);
    const Kinematics k(m);
    for (int n = 0; n < 4; ++n) {
      const Position at = random.position();
      const ScrewPose expected = by_screws(m, at);
      const ToolPose pose = k.actual(at);
      for (std::size_t j = 0; j < 3; ++j) {
        EXPECT_NEAR(pose.tip_mm[j], expected.tip[static_cast<int>(j)], 1e-10) << m.chain;
        EXPECT_NEAR(pose.direction[j], expected.direction[static_cast<int>(j)], 1e-12);
      }
    }
  }
}

Machine scaled(Machine m, double factor) {
  for (Axis& axis : m.axes) {
    for (double& l : axis.location) l *= factor;
    for (ErrorFunction& e : axis.errors) {
      for (double& c : e.c) c *= factor;
      e.b *= factor;
      for (Harmonic& h : e.f) h = {h.a * factor, h.d * factor};
    }
  }
  return m;
}

TEST(Kinematics, GapToFirstOrderShrinksFourfoldWhenErrorsHalve) {
  RandomMachines random(11);
  for (int i = 0; i < 100; ++i) {
    const Machine m = random.machine(0.1);
    const Position at = random.position();
    const auto gap = [&](double factor) {
      const Kinematics k(scaled(m, factor));
      return distance(k.tip_error_mm(at), k.tip_error_first_order_mm(at));
    };
    if (gap(1) < 1e-9) continue;  // one linear axis without lever
    EXPECT_NEAR(gap(1) / gap(0.5), 4, 0.1) << m.chain;
  }
}

TEST(Kinematics, WithoutErrorsTheTipIsTheNominalOne) {
  RandomMachines random(3);
  for (int i = 0; i < 50; ++i) {
    const Kinematics k(scaled(random.machine(1), 0));
    const Position at = random.position();
    EXPECT_LE(distance(k.actual(at).tip_mm, k.nominal(at).tip_mm), 1e-12);
    EXPECT_EQ(k.tip_error_first_order_mm(at), (Vec3{0, 0, 0}));
  }
}

TEST(Kinematics, EffectsAreTheFirstOrderErrorOfUnitErrors) {
  RandomMachines random(5);
  for (int i = 0; i < 60; ++i) {
    const Machine m = random.machine(0.01);
    const Position at = random.position();
    for (const AxisEffect& effect : Kinematics(m).effects(at)) {
      for (std::size_t k = 0; k < kDirections; ++k) {
        Machine one = scaled(m, 0);
        Axis& axis = *std::ranges::find_if(
            one.axes, [&](const Axis& a) { return a.name == effect.axis; });
        axis.errors[k].c[0] = 1e-3;
        const Vec3 e = Kinematics(one).tip_error_first_order_mm(at);
        for (std::size_t j = 0; j < 3; ++j)
          EXPECT_NEAR(e[j], 1e-3 * effect.error[k][j], 1e-12) << m.chain;
        axis.errors[k].c[0] = 0;
        if (is_rotary(axis.name) || k < 3 || k == letter_index(axis.name) + 3) continue;
        axis.location[k] = 1e-6;
        const Vec3 s = Kinematics(one).tip_error_first_order_mm(at);
        for (std::size_t j = 0; j < 3; ++j)
          EXPECT_NEAR(s[j], 1e-6 * effect.squareness[k - 3][j], 1e-9) << m.chain;
      }
    }
  }
}

// Second differences of the first-order error, along random ways on random chains.
TEST(Kinematics, BendsNoMoreThanItsBound) {
  RandomMachines random(11);
  for (int i = 0; i < 200; ++i) {
    const Kinematics k(random.machine(1e-2));
    Vec3 reach, way;
    Position at;
    for (std::size_t n = 0; n < 3; ++n) {
      reach[n] = std::abs(random.number(300)) + 2;
      way[n] = random.number(1);
      at.q[n] = random.number(reach[n] - 1);
      at.sign[n] = 1;
    }
    const double length = std::hypot(way[0], way[1], way[2]);
    const auto error = [&](double s) {
      Position there = at;
      for (std::size_t n = 0; n < 3; ++n) there.q[n] += s * way[n] / length;
      return k.tip_error_first_order_mm(there);
    };
    const Vec3 a = error(-1), b = error(0), c = error(1);
    const double bend = std::hypot(a[0] - 2 * b[0] + c[0], a[1] - 2 * b[1] + c[1],
                                   a[2] - 2 * b[2] + c[2]);
    EXPECT_LE(bend, k.bend_at_most(reach) + 1e-12) << i;
  }
  // Reached by one bow, and by pitch that grows under a tool 50 mm off.
  Machine m{"wfXt", {}, {{'X', {}, 100}}};
  m.axes[0].errors[1].c[2] = 0.01;
  EXPECT_NEAR(Kinematics(m).bend_at_most({7, 0, 0}), 2e-6, 1e-18);
  m = {"wfXt", {0, 0, 50}, {{'X', {}, 100}}};
  m.axes[0].errors[4].c[2] = 1e-4;
  EXPECT_NEAR(Kinematics(m).bend_at_most({0, 0, 0}), 2e-8 * 50, 1e-18);
  m.tool_point_mm = {};
  m.axes[0].p_mm = {0, 0, -70};
  EXPECT_NEAR(Kinematics(m).bend_at_most({0, 0, 0}), 2e-8 * 70, 1e-18);
  m.axes[0].errors[4].c = {0, 1e-3, 0, 0};  // 10 urad/mm, the lever growing by 1
  EXPECT_NEAR(Kinematics(m).bend_at_most({5, 0, 0}), 2e-5, 1e-18);
}

TEST(Kinematics, SquarenessTurnsTheDirectionOnly) {
  Machine m{"wXft", {}, {{'X', {}, 100}}};
  m.axes[0].location[5] = 1e-2;  // EC0X, the table: X programmed +100 moves it by -100 u
  const Vec3 tip = Kinematics(m).actual({.q = {100}}).tip_mm;
  EXPECT_NEAR(std::hypot(tip[0], tip[1]), 100, 1e-12);
  EXPECT_NEAR(tip[1] / tip[0], 1e-2, 1e-15);
}

TEST(Kinematics, PapersExampleOfThreeMoves) {
  // Scales and squareness that give the sums of [Jha]: 0.018 + 0.006, 0.007 + 0.023,
  // 0.045.
  Machine m{"wfXYZt", {}, {{'X', {}, 100}, {'Y', {}, 100}, {'Z', {}, 100}}};
  m.axes[0].errors[0].c[1] = 0.018 / 2;  // EXX over 200 mm
  m.axes[1].errors[1].c[1] = 0.045 / 4;  // EYY over 400 mm
  m.axes[2].errors[2].c[1] = 0.023 / 3;  // EZZ over 300 mm
  m.axes[0].location[4] = -0.007 / 200;  // EB0X: X runs towards +Z, k1 = 35 urad
  m.axes[2].location[4] = 0.006 / 300;   // EB0Z: Z runs towards +X, i2 = 20 urad
  const Position at{.q = {200, 400, 300}};
  const Vec3 first = Kinematics(m).tip_error_first_order_mm(at);
  // The unit vectors cost q theta^2/2, 0.12 and 0.06 um/1000.
  EXPECT_LE(distance(first, {0.024, 0.045, 0.030}), 3e-7);
  EXPECT_LE(distance(Kinematics(m).tip_error_mm(at), first), 1e-6);
  // Only the sum k1 + i2 is a shape; the rest turns the whole field about Y.
  const double k1 = 35e-6, i2 = 20e-6;
  Machine turned = m;
  turned.axes[0].location[4] = 0;
  turned.axes[2].location[4] = k1 + i2;
  Vec3 other = Kinematics(turned).tip_error_first_order_mm(at);
  // A turn by -k1 about Y: x' = x - k1 z, z' = z + k1 x.
  other = {other[0] - k1 * 300, other[1], other[2] + k1 * 200};
  EXPECT_LE(distance(other, first), 1e-6);
}

// The D-H chain of [Jha], table 1: each link Rz(x) Tz(d) Tx(a) Rx(t); its frame (x, z, y)
// is mirrored against ISO 841's (x, y, z).
Eigen::Matrix4d link(double d, double a, double x, double t) {
  Eigen::Matrix4d T;
  T << std::cos(x), -std::cos(t) * std::sin(x), std::sin(t) * std::sin(x),
      a * std::cos(x),  //
      std::sin(x), std::cos(t) * std::cos(x), -std::sin(t) * std::cos(x),
      a * std::sin(x),                 //
      0, std::sin(t), std::cos(t), d,  //
      0, 0, 0, 1;
  return T;
}

TEST(Kinematics, PapersDenavitHartenbergChainIsASpecialCase) {
  const double h = units::kPi / 2, am = 31, a1 = 17, a2 = -12, a3 = 23, dm = 8, L = 140,
               tx = 3, tz = -5, ty = 7, theta = 0.7;
  const auto chain = [&](double X, double Z, double Y, double turned) {
    Eigen::Matrix4d Tp = Eigen::Matrix4d::Identity();
    Tp.col(3) << tx, tz, ty, 1;
    return Eigen::Vector4d(Tp * link(dm, am, -h, -h) * link(X, a1, -h, h) *
                           link(Z, a2, -h, -h) * link(Y, a3, -h, h) *
                           link(0, 0, turned, h) * Eigen::Vector4d(0, 0, L, 1));
  };
  // Three linear axes and the head as A axis: the product's last joint turns the tool
  // from -y to +z about the X direction (table 2 of [Jha] says Z).  Its axis passes
  // through p, where the product puts frame 4 at zero.
  const Eigen::Vector4d zero = chain(0, 0, 0, 0);
  const Vec3 tool{zero[0], zero[2], zero[1]};   // ISO order x, y, z
  const Vec3 p{tool[0], tool[1] + L, tool[2]};  // (14) at theta = 0: y = -L + ..
  Machine m{"wfXZYAt",
            tool,
            {{'X', {}, 100}, {'Z', {}, 100}, {'Y', {}, 100}, {'A', p, units::kPi}}};
  const Kinematics k(m);
  for (const double q : {0.0, 1.0, -2.5}) {
    const Eigen::Vector4d paper = chain(200 * q, 300 * q, 400 * q, theta * q);
    // From -y to +z is a negative turn about x in ISO's right-handed frame.
    const Vec3 tip = k.nominal({.q = {200 * q, 400 * q, 300 * q, -theta * q}}).tip_mm;
    EXPECT_LE(distance(tip, {paper[0], paper[2], paper[1]}), 1e-12);
    // Eq. (14) of [Jha], with the homogeneous row it lacks.
    EXPECT_NEAR(paper[0], -a2 + 200 * q + tx, 1e-12);
    EXPECT_NEAR(paper[1], L * std::sin(theta * q) - am + a3 + 300 * q + tz, 1e-12);
    EXPECT_NEAR(paper[2], -L * std::cos(theta * q) + a1 + dm + 400 * q + ty, 1e-12);
  }
  // Eq. (13), atan(-k/j), loses the quadrant that atan2(k, -j) keeps.
  for (const double angle : {0.3, 2.0, -2.6}) {
    const double kk = std::sin(angle), j = -std::cos(angle);
    EXPECT_NEAR(std::atan2(kk, -j), angle, 1e-15);
  }
}

TEST(Kinematics, RefusesWhatIsNoMachine) {
  for (const char* chain : {"", "w", "ft", "wt", "wXt", "wffXt", "wXfXt", "wQft", "wXft ",
                            "tXfw", "wfxt", "wwft"})
    EXPECT_NE(chain_fault(chain), "") << chain;
  for (const char* chain : {"wft", "wfXYZt", "wCBXfZYt", "wABCfXYZt"})
    EXPECT_EQ(chain_fault(chain), "") << chain;
  const Machine good{"wXft", {}, {{'X', {}, 100}}};
  const auto refuses = [&](auto spoil) {
    Machine m = good;
    spoil(m);
    EXPECT_THROW(Kinematics{m}, std::domain_error);
  };
  refuses([](Machine& m) { m.chain = "wXXft"; });
  refuses([](Machine& m) { m.axes.clear(); });
  refuses([](Machine& m) { m.axes[0].name = 'Y'; });
  refuses([](Machine& m) { m.axes[0].Q = std::nan(""); });
  refuses([](Machine& m) { m.axes[0].errors[1].f.push_back({1, 1}); });
  refuses([](Machine& m) { m.axes[0].location[0] = 1; });
  refuses([](Machine& m) { m.axes[0].location[3] = 1; });
}

}  // namespace
}  // namespace turnwright::volumetric
