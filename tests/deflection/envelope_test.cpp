#include "turnwright/deflection/envelope.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "random_shafts.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/random.hpp"
#include "turnwright/deflection/response.hpp"

namespace turnwright::deflection {
namespace {

using std::numbers::sqrt2;

Envelope of(const std::vector<double>& ends, double (*e)(std::size_t, double)) {
  return envelope(ends,
                  [&](std::size_t s, std::span<const double> a, std::span<double> out) {
                    for (std::size_t i = 0; i < a.size(); ++i) out[i] = e(s, a[i]);
                  });
}

ErrorOnSegment radius_error(const Workpiece& part, const Clamping& clamping,
                            const Load& load) {
  return [&part, clamping, load](std::size_t segment, std::span<const double> a,
                                 std::span<double> e) {
    std::vector<Flexibility> r(a.size()), t(a.size());
    part.at(a, clamping.radial, r);
    part.at(a, clamping.tangential, t);
    for (std::size_t i = 0; i < a.size(); ++i)
      e[i] = response(a[i], part.diameter_mm(segment, a[i]), r[i], t[i], load)
                 .radius_error_mm;
  };
}

TEST(Envelope, PeaksOfKnownFunctions) {
  const auto cubic =
      of({0, 2}, [](std::size_t, double a) { return a * (a - 2) * (a + 5); });
  // 3 a^2 + 6 a - 10 = 0
  const double at = (-6 + std::sqrt(36.0 + 120)) / 6;
  EXPECT_NEAR(cubic.at_mm, at, 1e-7);
  EXPECT_NEAR(cubic.max_mm, -at * (at - 2) * (at + 5), 1e-14);
  const auto flat = of({0, 1, 5}, [](std::size_t, double) { return -2.0; });
  EXPECT_EQ(flat.max_mm, 2);
  EXPECT_EQ(flat.at_mm, 0);
  const auto zero = of({3, 5}, [](std::size_t, double) { return 0.0; });
  EXPECT_EQ(zero.max_mm, 0);
  EXPECT_EQ(zero.at_mm, 3);
}

TEST(Envelope, EndsCountExactly) {
  const auto right = of({0, 2}, [](std::size_t, double a) { return a * a * a; });
  EXPECT_EQ(right.max_mm, 8);
  EXPECT_EQ(right.at_mm, 2);
  const auto left = of({0, 2}, [](std::size_t, double a) { return std::exp(-a); });
  EXPECT_EQ(left.max_mm, 1);
  EXPECT_EQ(left.at_mm, 0);
}

TEST(Envelope, ANarrowPeakBesideABroadOneIsFound) {
  // a needle 1e-3 of the length wide, higher by 1e-6 than the broad hill
  const auto e = of({0, 1}, [](std::size_t, double a) {
    const double x = (a - 0.7314) / 1e-3;
    return std::exp(-30 * (a - 0.2) * (a - 0.2)) + (1 + 1e-6) / (1 + x * x);
  });
  const double at = 0.7314;
  EXPECT_NEAR(e.at_mm, at, 1e-6);
  EXPECT_NEAR(e.max_mm, 1 + 1e-6 + std::exp(-30 * (at - 0.2) * (at - 0.2)), 1e-8);
}

TEST(Envelope, BothSidesOfAStepCount) {
  for (const double left : {1.0, 3.0}) {
    const std::vector<double> ends{0, 1, 2};
    const auto e = envelope(
        ends, [&](std::size_t s, std::span<const double> a, std::span<double> out) {
          for (std::size_t i = 0; i < a.size(); ++i)
            out[i] = s == 0 ? left * a[i] : -2 * (2 - a[i]);
        });
    EXPECT_EQ(e.max_mm, std::max(left, 2.0));
    EXPECT_EQ(e.at_mm, 1);
  }
}

TEST(Envelope, ProppedBarHasItsPeakAtTwoMinusRootTwo) {
  // u^3 (1 - u)^2 (4 - u)/12 of F L^3/EI is largest where u^2 - 4 u + 2 = 0
  const double L = 1e4, d = 1, E = 210000;
  const Workpiece wire({E, 0.3, {{L, d, d, 0, 0}}});
  const Supports propped{Method::chuck_tailstock, {}, 0, 0};
  const double EI = E * std::numbers::pi / 64, u = 2 - sqrt2;
  const double peak =
      u * u * u * (1 - u) * (1 - u) * (4 - u) / 12 * 1e-6 * L * L * L / EI;
  const auto e =
      envelope(wire.ends_mm(), radius_error(wire, {propped, propped}, {1e-6, 0, 0}));
  EXPECT_NEAR(e.at_mm / L, u, 1e-6);
  EXPECT_NEAR(e.max_mm / peak, 1, 1e-7);  // shear: (d/L)^2
  const Supports centres{Method::between_centres, {}, 0, 0};
  const auto c =
      envelope(wire.ends_mm(), radius_error(wire, {centres, centres}, {1e-6, 0, 0}));
  EXPECT_NEAR(c.at_mm / L, 0.5, 1e-6);
  EXPECT_NEAR(c.max_mm / (1e-6 * L * L * L / (48 * EI)), 1, 1e-7);
}

TEST(Envelope, NoiseIsRefused) {
  const auto noise = [](std::size_t, double a) {
    return static_cast<double>(splitmix64(std::bit_cast<std::uint64_t>(a), 0));
  };
  EXPECT_THROW(of({0, 1}, noise), ModelRangeError);
}

TEST(Envelope, NoDenseSamplingFindsMore) {
  for (const auto& [name, shaft] : random_shafts::all(29)) {
    const Workpiece part(shaft);
    for (const Supports& s : random_shafts::supports()) {
      const auto error = radius_error(part, {s, s}, {250, 600, 180});
      const Envelope best = envelope(part.ends_mm(), error);
      double sampled = 0;
      for (std::size_t i = 0; i < part.segments(); ++i) {
        std::vector<double> a(2001), e(2001);
        for (std::size_t k = 0; k < a.size(); ++k)
          a[k] = std::lerp(part.ends_mm()[i], part.ends_mm()[i + 1],
                           static_cast<double>(k) / 2000);
        error(i, a, e);
        for (const double x : e) sampled = std::max(sampled, std::abs(x));
      }
      EXPECT_GE(best.max_mm, sampled * (1 - 1e-12)) << name;
      EXPECT_LE(best.max_mm, sampled * (1 + 1e-4)) << name;
      const std::size_t segment = part.segment_at(best.at_mm);
      double here = 0, after = 0;
      error(segment, {&best.at_mm, 1}, {&here, 1});
      error(std::min(segment + 1, part.segments() - 1), {&best.at_mm, 1}, {&after, 1});
      EXPECT_NEAR(best.max_mm,
                  best.at_mm == part.ends_mm()[segment + 1]
                      ? std::max(std::abs(here), std::abs(after))
                      : std::abs(here),
                  1e-14 * best.max_mm);
    }
  }
}

}  // namespace
}  // namespace turnwright::deflection
