#include "turnwright/deflection/rest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "agreement.hpp"
#include "finite_elements.hpp"
#include "random_shafts.hpp"

namespace turnwright::deflection {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kOfLargest = 1e-12;

/// Differences of a part's flexibilities in parts of the largest, of its reactions in
/// parts of the largest of tail and rest.
struct Table {
  std::vector<Flexibility> part;
  std::vector<double> per_N, per_Nmm;
};

Table table(const RestedBeam& beam, const std::vector<double>& a_mm) {
  Table t;
  for (const double a : a_mm) {
    const RestedFlexibility f = beam.at(a);
    t.part.push_back(f.part);
    t.per_N.push_back(f.rest_per_N);
    t.per_Nmm.push_back(f.rest_per_Nmm);
  }
  return t;
}

double apart(const std::vector<double>& x, const std::vector<double>& y) {
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i])) return kUnknown;
    worst = std::max(worst, std::abs(x[i] - y[i]));
  }
  return worst;
}

double largest(const std::vector<double>& x) {
  double all = 0;
  for (const double v : x) all = std::max(all, std::abs(v));
  return all;
}

std::vector<double> column(const std::vector<Flexibility>& f, Field field) {
  std::vector<double> out;
  for (const Flexibility& x : f) out.push_back(x.*field);
  return out;
}

TEST(Rest, FiniteElementsWithASpringAgreeOnEveryKindOfShaft) {
  std::size_t turn = 0;  // places and compliances take turns over shafts and supports
  for (const auto& [name, shaft] : random_shafts::all(29)) {
    const std::vector<double> a = positions(part::length_mm(shaft.segments));
    for (const Supports& s : random_shafts::supports()) {
      const std::size_t place = std::array<std::size_t, 5>{1, 4, 7, 4, 7}[turn++ % 5];
      const double c = turn % 4 < 2 ? 0.0 : 1 / 5e4;
      const SteadyRest rest{a[place], c};
      const Table mine = table(RestedBeam(shaft, s, rest), a);
      const auto theirs = finite_elements::solved(shaft, a, s, &rest);
      const std::string which = name + ", method " +
                                std::to_string(static_cast<int>(s.method)) +
                                (s.tail_mm_N > 0 ? " elastic" : " rigid") + ", rest " +
                                std::to_string(place) + (c > 0 ? " elastic" : " rigid");
      const auto compare = [&](Field f, double scale) {
        const auto x = column(mine.part, f), y = column(theirs.flexibility, f);
        EXPECT_LE(apart(x, y), kOfLargest * std::max(scale, largest(y))) << which;
      };
      compare(&Flexibility::f_ww_mm_N, 0);
      compare(&Flexibility::f_wp_rad_N, 0);
      compare(&Flexibility::f_pp_rad_Nmm, 0);
      const double per_N = largest(mine.per_N), per_Nmm = largest(mine.per_Nmm);
      compare(&Flexibility::tail_per_N, per_N);
      compare(&Flexibility::tail_per_Nmm, per_Nmm);
      if (c > 0) {
        const auto tail_N = column(theirs.flexibility, &Flexibility::tail_per_N),
                   tail_Nmm = column(theirs.flexibility, &Flexibility::tail_per_Nmm);
        EXPECT_LE(apart(mine.per_N, theirs.rest_per_N),
                  kOfLargest * std::max(largest(tail_N), per_N))
            << which;
        EXPECT_LE(apart(mine.per_Nmm, theirs.rest_per_Nmm),
                  kOfLargest * std::max(largest(tail_Nmm), per_Nmm))
            << which;
      }
    }
  }
}

TEST(Rest, AsSoftAsNothingItChangesNothingAndAStiffOneIsTheLimit) {
  for (const auto& [name, shaft] : random_shafts::all(31)) {
    const Beam beam(shaft);
    const double L = beam.length_mm(), z = 0.6 * L;
    for (const Supports& s : random_shafts::supports()) {
      const RestedBeam soft(shaft, s, {z, 1e20}), rigid(shaft, s, {z, 0}),
          stiff(shaft, s, {z, 1e-22});
      std::vector<Flexibility> free, with_soft, with_rigid, with_stiff;
      for (const double a : positions(L)) {
        free.push_back(beam.at(a, s));
        with_soft.push_back(soft.at(a).part);
        with_rigid.push_back(rigid.at(a).part);
        with_stiff.push_back(stiff.at(a).part);
        EXPECT_NEAR(soft.at(a).rest_per_N, 0, 1e-9) << name;
        EXPECT_NEAR(stiff.at(a).rest_per_N, rigid.at(a).rest_per_N, 1e-9) << name;
      }
      EXPECT_LE(difference(with_soft, free), kOfLargest) << name;
      EXPECT_LE(difference(with_stiff, with_rigid), 1e-9) << name;
    }
  }
}

TEST(Rest, ARigidRestUnderTheToolHoldsIt) {
  const part::Shaft bar{210000, 0.3, {{400, 30, 30, 0, 0}}};
  const Root root{1.8e-5, 8.6e-8, 1.1e-9};
  for (const Method m :
       {Method::chuck, Method::between_centres, Method::chuck_tailstock}) {
    const RestedFlexibility f = RestedBeam(bar, {m, root, 1e-5, 3e-5}, {150, 0}).at(150);
    EXPECT_NEAR(f.part.f_ww_mm_N, 0, 1e-22);
    EXPECT_NEAR(f.part.f_wp_rad_N, 0, 1e-22);
    EXPECT_NEAR(f.rest_per_N, 1, 1e-14);
    EXPECT_NEAR(f.part.tail_per_N, 0, 1e-14);
    EXPECT_GT(f.part.f_pp_rad_Nmm, 0);
  }
}

TEST(Rest, BetweenCentresWithARigidMiddleRestIsTwoSpans) {
  // Three-moment equation, two equal spans l, a force in the middle of one: the middle
  // support's moment is 3 F l/32 and the deflection 23 F l^3/1536 EI; shear put out of
  // the way by slenderness.
  const double l = 1e6, d = 1e-3;
  const part::Shaft wire{210000, 0, {{2 * l, d, d, 0, 0}}};
  const double EI = 210000 * std::numbers::pi * std::pow(d, 4) / 64;
  const RestedBeam beam(wire, {Method::between_centres, {}, 0, 0}, {l, 0});
  const RestedFlexibility f = beam.at(l / 2), g = beam.at(1.5 * l);
  EXPECT_NEAR(f.part.f_ww_mm_N / (23 * l * l * l / (1536 * EI)), 1, 1e-12);
  EXPECT_NEAR(g.part.f_ww_mm_N / f.part.f_ww_mm_N, 1, 1e-12);
  EXPECT_NEAR(f.part.tail_per_N, -3.0 / 32, 1e-12);  // the far end is lifted
  EXPECT_NEAR(f.rest_per_N, 22.0 / 32, 1e-12);
  EXPECT_NEAR(g.part.tail_per_N, 13.0 / 32, 1e-12);
}

TEST(Rest, APartBeingCutIsTheTwoBodiesJoinedAtTheTool) {
  for (const auto& [name, shaft] : random_shafts::all(37)) {
    const double L = part::length_mm(shaft.segments);
    const part::Shaft uncut{shaft.E_MPa, shaft.nu, part::uncut(shaft.segments, 1.25)};
    for (const Supports& s : random_shafts::supports()) {
      const SteadyRest rest{0.4 * L, 2e-5};
      const RestedBeam towards_chuck(uncut, shaft, s, rest);
      std::vector<Flexibility> joined, built;
      for (const double a : positions(L)) {
        joined.push_back(towards_chuck.at(a).part);
        built.push_back(RestedBeam({shaft.E_MPa, shaft.nu,
                                    part::in_process(shaft.segments, a, 1.25,
                                                     part::FeedTowards::chuck)},
                                   s, rest)
                            .at(a)
                            .part);
      }
      EXPECT_LE(difference(joined, built), kOfLargest) << name;
    }
  }
}

TEST(FollowRest, IsASteadyRestUnderTheTool) {
  for (const auto& [name, shaft] : random_shafts::all(41)) {
    const Beam beam(shaft);
    const double a = 0.7 * beam.length_mm(), c = 3e-5;
    for (const Supports& s : random_shafts::supports()) {
      const Flexibility follow = follow_rest(beam.at(a, s), c);
      const Flexibility steady = RestedBeam(shaft, s, {a, c}).at(a).part;
      for (const Field f : kFields)
        EXPECT_NEAR(follow.*f, steady.*f, 1e-9 * std::abs(beam.at(a, s).*f)) << name;
    }
  }
}

TEST(FollowRest, AsStiffAsThePartItHalvesTheDeflection) {
  const Flexibility f{2e-5, 3e-7, 8e-9, 0.4, 0.01};
  const Flexibility held = follow_rest(f, 2e-5);
  EXPECT_NEAR(held.f_ww_mm_N, 1e-5, 1e-18);
  EXPECT_NEAR(held.f_wp_rad_N, 1.5e-7, 1e-20);
  EXPECT_NEAR(held.f_pp_rad_Nmm, 8e-9 - 9e-14 / 4e-5, 1e-22);
  EXPECT_EQ(follow_rest(f, 0).f_ww_mm_N, 0);
}

TEST(Rest, RefusesWhatIsNoRest) {
  const part::Shaft bar{210000, 0.3, {{400, 30, 30, 0, 0}}};
  for (const SteadyRest& rest :
       {SteadyRest{0, 0}, SteadyRest{400, 0}, SteadyRest{-1, 0}, SteadyRest{kUnknown, 0},
        SteadyRest{100, -1e-6}, SteadyRest{100, kUnknown}})
    EXPECT_THROW(RestedBeam(bar, {}, rest), std::domain_error);
  const part::Shaft shorter{210000, 0.3, {{390, 30, 30, 0, 0}}};
  EXPECT_THROW(RestedBeam(bar, shorter, {}, {100, 0}), std::domain_error);
  const RestedBeam good(bar, {}, {100, 0});
  for (const double a : {-1.0, 400.1, kUnknown})
    EXPECT_THROW(good.at(a), std::domain_error);
  EXPECT_THROW(RestedBeam(bar, {Method::chuck, {1, 1.1, 1}, 0, 0}, {100, 0}),
               std::domain_error);
  EXPECT_THROW(follow_rest({}, 0), std::domain_error);
  EXPECT_THROW(follow_rest({1e-5, 0, 0, 0, 0}, -1e-6), std::domain_error);
}

}  // namespace
}  // namespace turnwright::deflection
