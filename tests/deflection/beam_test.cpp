#include "turnwright/deflection/beam.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "agreement.hpp"
#include "finite_elements.hpp"
#include "random_shafts.hpp"
#include "reference.hpp"

namespace turnwright::deflection {
namespace {

using part::Segment;
using part::Shaft;

using std::numbers::pi;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
// Both sides are closed forms, so only rounding is left.
constexpr double kRounding = 1e-13;
// What is promised of every case: parts of its own largest value.
constexpr double kPromised = 1e-12;

std::vector<Flexibility> at(const Beam& beam, const std::vector<double>& a_mm,
                            const Supports& supports) {
  std::vector<Flexibility> out(a_mm.size());
  beam.at(a_mm, supports, out);
  return out;
}

double EI(const Shaft& s) {
  return s.E_MPa * std::numbers::pi * std::pow(s.segments[0].outer_left_mm, 4) / 64;
}
double chi_GA(const Shaft& s) {  // Cowper, solid
  const double d = s.segments[0].outer_left_mm, G = s.E_MPa / (2 * (1 + s.nu));
  return (7 + 6 * s.nu) / (6 * (1 + s.nu)) / (G * std::numbers::pi * d * d / 4);
}

TEST(Beam, UniformShaftMatchesTheBeamTables) {
  const Shaft bar{210000, 0.3, {{240, 20, 20, 0, 0}}};
  const Beam beam(bar);
  const double L = 240, ei = EI(bar), shear = chi_GA(bar);
  for (const double a : {1e-3, 12.0, 100.0, 239.0, 240.0}) {
    const double b = L - a;
    const Flexibility c = beam.at(a, {Method::chuck, {}, 0, 0});
    EXPECT_NEAR(c.f_ww_mm_N / (a * a * a / (3 * ei) + a * shear), 1, kRounding);
    EXPECT_NEAR(c.f_wp_rad_N / (a * a / (2 * ei)), 1, kRounding);
    EXPECT_NEAR(c.f_pp_rad_Nmm / (a / ei), 1, kRounding);
    EXPECT_EQ(c.tail_per_N, 0);

    const Flexibility m = beam.at(a, {Method::between_centres, {}, 0, 0});
    const double simple = (a * a * b * b / (3 * ei) + a * b * shear) / L;
    EXPECT_NEAR(m.f_ww_mm_N, simple, kRounding * simple);
    EXPECT_NEAR(m.tail_per_N, a / L, kRounding);
    EXPECT_NEAR(m.tail_per_Nmm, 1 / L, kRounding / L);

    // propped: the tail's reaction of the cantilever's table, shear included
    const Flexibility t = beam.at(a, {Method::chuck_tailstock, {}, 0, 0});
    const double f_aL = a * a * (3 * L - a) / (6 * ei) + a * shear;
    const double f_LL = L * L * L / (3 * ei) + L * shear;
    EXPECT_NEAR(t.tail_per_N, f_aL / f_LL, kRounding);
    EXPECT_NEAR(t.tail_per_Nmm, a * (L - a / 2) / ei / f_LL, kRounding / L);
  }
}

TEST(Beam, ClosedFormsWithoutShear) {
  // F L^3/3EI, F L^3/48EI and a^3 b^2 (3 L + b)/12 E I L^3 know no shear: the bar is so
  // slender that shear is 1e-18 of them.
  const double L = 1e6, d = 1e-3;
  const Shaft wire{210000, 0, {{L, d, d, 0, 0}}};
  const Beam beam(wire);
  const double ei = EI(wire);
  EXPECT_NEAR(beam.at(L, {Method::chuck, {}, 0, 0}).f_ww_mm_N / (L * L * L / (3 * ei)), 1,
              kRounding);
  EXPECT_NEAR(beam.at(L / 2, {Method::between_centres, {}, 0, 0}).f_ww_mm_N /
                  (L * L * L / (48 * ei)),
              1, kRounding);
  for (const double u : {0.05, 0.3, 0.5, 0.8, 0.97}) {
    const double a = u * L, b = L - a;
    EXPECT_NEAR(beam.at(a, {Method::chuck_tailstock, {}, 0, 0}).f_ww_mm_N /
                    (a * a * a * b * b * (3 * L + b) / (12 * ei * L * L * L)),
                1, kRounding);
  }
}

TEST(Beam, ConesMatchTheirClosedForms) {
  // free end of a solid cone, r0 at the jaws, r1 at the end: elementary integrals,
  // derived here by substituting r for z
  const double E = 210000;
  for (const double r1 : {1.5, 10.0, 29.0, 30.0, 31.0, 600.0}) {
    const double r0 = 30, h = 100;
    const Beam beam({E, 0.25, {{h, 2 * r0, 2 * r1, 0, 0}}});
    const Flexibility f = beam.at(h, {Method::chuck, {}, 0, 0});
    const double shear = (7 + 6 * 0.25) / (3 * pi * E) * h / (r0 * r1);
    const double bend = 4 / (pi * E) * h * h * h / (3 * r0 * r0 * r0 * r1);
    EXPECT_NEAR(f.f_ww_mm_N / (bend + shear), 1, kRounding);
    const double turn = (r1 * r1 + r0 * r1 + r0 * r0) / (3 * std::pow(r0 * r1, 3));
    EXPECT_NEAR(f.f_pp_rad_Nmm / (4 / (pi * E) * h * turn), 1, kRounding);
  }
}

TEST(Beam, ReferenceFile) {
  const auto cases = reference::cases();
  EXPECT_EQ(cases.size(), 24u);
  const std::string names[] = {"f_ww_", "f_wp_", "f_pp_", "RF_", "RC_"};
  for (const auto& c : cases)
    for (const bool radial : {true, false}) {
      std::vector<Flexibility> expected(c.a_mm.size());
      for (std::size_t f = 0; f < 5; ++f)
        for (std::size_t i = 0; i < c.a_mm.size(); ++i)
          expected[i].*kFields[f] = c.values.at(names[f] + (radial ? 'r' : 't')).at(i);
      const auto mine =
          at(Beam(c.shaft), c.a_mm, radial ? c.clamping.radial : c.clamping.tangential);
      EXPECT_LE(difference(mine, expected), kPromised) << c.name;
    }
}

TEST(Beam, FiniteElementsAgreeOnEveryKindOfShaft) {
  for (const auto& [name, shaft] : random_shafts::all(1)) {
    const Beam beam(shaft);
    const std::vector<double> a = positions(beam.length_mm());
    for (const Supports& s : random_shafts::supports()) {
      const auto mine = at(beam, a, s);
      const auto theirs = finite_elements::solved(shaft, a, s);
      const std::string which = name + ", method " +
                                std::to_string(static_cast<int>(s.method)) +
                                (s.tail_mm_N > 0 ? " elastic" : " rigid");
      EXPECT_LE(difference(mine, theirs.flexibility), kPromised) << which;
      // Maxwell: f_wp as rotation per force is also the deflection per couple
      double largest = 0, apart = 0;
      for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max(largest, std::abs(theirs.deflection_per_couple[i]));
        apart = std::max(apart,
                         std::abs(theirs.deflection_per_couple[i] - mine[i].f_wp_rad_N));
      }
      EXPECT_LE(apart, kPromised * largest) << which;
    }
  }
}

/// The free end of a single segment is its integrals: f_ww, f_wp, f_pp.
double against_quadrature(const Segment& s) {
  const Shaft shaft{210000, 0.3, {s}};
  const std::vector<double> end{s.length_mm};
  const Supports rigid{Method::chuck, {}, 0, 0};
  return difference(at(Beam(shaft), end, rigid),
                    finite_elements::flexibilities(shaft, end, rigid));
}

TEST(Beam, ConeIntegralsAreGoodTo1em13UpToEveryPlace) {
  // each place in parts of its own value, so that no large one hides a small one
  std::mt19937_64 random(3);
  const Supports rigid{Method::chuck, {}, 0, 0};
  for (int i = 0; i < 40; ++i) {
    const auto r = [&](double low, double high) {
      return random_shafts::between(random, low, high);
    };
    const double left = r(3, 60), right = r(3, 60);
    const Segment s{r(5, 300), left, right, left * r(0, 0.95), right * r(0, 0.95)};
    const Shaft shaft{210000, 0.3, {s}};
    std::vector<double> places;
    for (const double u : {0.003, 0.1, 0.31, 0.49, 0.51, 0.83, 1.0})
      places.push_back(u * s.length_mm);
    const auto mine = at(Beam(shaft), places, rigid),
               theirs = finite_elements::flexibilities(shaft, places, rigid);
    for (std::size_t k = 0; k < places.size(); ++k)
      for (const Field f : {kFields[0], kFields[1], kFields[2]})
        EXPECT_NEAR(mine[k].*f / (theirs[k].*f), 1, kRounding)
            << s.length_mm << ' ' << left << ' ' << right << ' ' << s.inner_left_mm << ' '
            << s.inner_right_mm << " at " << places[k];
  }
}

TEST(Beam, ShaftsOfAnyProportionsAgree) {
  // from discs to wires, tapers up to 20:1 either way, bores up to 95 %
  std::mt19937_64 random(29);
  const auto r = [&](double low, double high) {
    return random_shafts::between(random, low, high);
  };
  const auto any = [&](double low, double high) {
    return low * std::pow(high / low, r(0, 1));
  };
  const std::vector<Supports> supports = random_shafts::supports();
  for (int k = 0; k < 30; ++k) {
    const double D = any(1, 500), L_D = any(0.05, 300);
    const auto segments = static_cast<std::size_t>(r(1, 9));
    Shaft shaft{any(4e4, 6e5), r(0, 0.49), {}};
    for (std::size_t i = 0; i < segments; ++i) {
      const double left = D * any(0.05, 1), right = i % 3 == 0 ? left : D * any(0.05, 1);
      const double bore = i % 2 == 0 ? r(0, 0.95) : 0;
      shaft.segments.push_back({D * L_D / static_cast<double>(segments) * any(0.2, 1),
                                left, right, bore * left,
                                i % 4 == 0 ? bore * right : r(0, 0.95) * right});
    }
    const Beam beam(shaft);
    const std::vector<double> a = positions(beam.length_mm());
    const std::size_t way = static_cast<std::size_t>(k) % supports.size();
    EXPECT_LE(difference(at(beam, a, supports[way]),
                         finite_elements::flexibilities(shaft, a, supports[way])),
              kPromised)
        << "shaft " << k << ", D " << D << ", L/D " << L_D << ", supports " << way;
  }
}

TEST(Beam, AThousandSegmentsAgree) {
  std::mt19937_64 random(31);
  const auto r = [&](double low, double high) {
    return random_shafts::between(random, low, high);
  };
  Shaft shaft{210000, 0.3, {}};
  for (int i = 0; i < 1000; ++i) {
    const double left = r(30, 60), right = i % 2 == 0 ? left : r(30, 60);
    const double bore = i % 10 == 1 ? r(0.1, 0.95) : 0;
    shaft.segments.push_back({r(0.5, 3), left, right, bore * left, bore * right});
  }
  const Beam beam(shaft);
  const std::vector<double> a = positions(beam.length_mm());
  for (const std::size_t way : {3, 5}) {  // centres and tailstock, elastic
    const Supports s = random_shafts::supports()[way];
    EXPECT_LE(difference(at(beam, a, s), finite_elements::flexibilities(shaft, a, s)),
              kPromised)
        << way;
  }
}

TEST(Beam, ConeIntegralsFromNoTaperTo20To1AndNoBoreTo95Percent) {
  for (const double ratio :
       {1.0, 1 + 1e-12, 1 + 1e-8, 1 + 1e-4, 1.01, 1.3, 2.0, 5.0, 20.0})
    for (const double bore_left : {0.0, 1e-6, 0.5, 0.95})
      for (const double bore_right : {0.0, 0.3, 0.95})
        for (const bool grows : {false, true}) {
          const double left = grows ? 60 / ratio : 60, right = grows ? 60 : 60 / ratio;
          EXPECT_LE(
              against_quadrature({70, left, right, bore_left * left, bore_right * right}),
              kRounding)
              << left << ' ' << right << ' ' << bore_left << ' ' << bore_right;
        }
}

TEST(Beam, AWallThatClosesToRoundingIsABody) {
  // softer and softer with the logarithm of the wall, from either end, and no end of
  // panels
  const auto turns = [](const Segment& s) {
    return Beam({210000, 0.3, {s}}).at(100, {}).f_pp_rad_Nmm;
  };
  std::vector<double> f;
  for (const double wall : {1e-6, 1e-9, 1e-12, 1e-15}) {
    const double bore = 40 * (1 - wall);
    f.push_back(turns({100, 60, 40, 20, bore}));
    EXPECT_NEAR(turns({100, 40, 60, bore, 20}) / f.back(), 1, 1e-6) << wall;
  }
  EXPECT_NEAR((f[2] - f[1]) / (f[1] - f[0]), 1, 1e-4);
  EXPECT_NEAR((f[3] - f[2]) / (f[1] - f[0]), 1, 0.05);  // the wall has one digit left
}

TEST(Beam, SlopesUnderForceAndCoupleAgree) {
  // theta = f_wp Fr + f_pp C and the reaction of the same load, in parts of the case's
  // largest; Fr, Fa of a rough cut at the local diameter
  const double Fr = 800, Fa = 1400;
  for (const auto& [name, shaft] : random_shafts::all(5)) {
    const Beam beam(shaft);
    const std::vector<double> a = positions(beam.length_mm());
    const Supports s = random_shafts::supports()[a.size() % 2 == 0 ? 5 : 4];
    const auto mine = at(beam, a, s),
               theirs = finite_elements::flexibilities(shaft, a, s);
    double largest[2] = {}, apart[2] = {};
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double C = -Fa * (30 - 20 * a[i] / beam.length_mm()) / 2;
      const auto theta = [&](const Flexibility& f) {
        return f.f_wp_rad_N * Fr + f.f_pp_rad_Nmm * C;
      };
      const auto reaction = [&](const Flexibility& f) {
        return f.tail_per_N * Fr + f.tail_per_Nmm * C;
      };
      const double x[2] = {theta(mine[i]), reaction(mine[i])},
                   y[2] = {theta(theirs[i]), reaction(theirs[i])};
      for (std::size_t k = 0; k < 2; ++k) {
        largest[k] = std::max(largest[k], std::abs(y[k]));
        apart[k] = std::max(apart[k], std::abs(x[k] - y[k]));
      }
    }
    EXPECT_LE(apart[0], kPromised * largest[0]) << name;
    EXPECT_LE(apart[1], kPromised * largest[1]) << name;
  }
}

TEST(Beam, CuttingSegmentsInTwoChangesNothing) {
  std::mt19937_64 random(7);
  for (const auto& [name, shaft] : random_shafts::all(7)) {
    Shaft halves{shaft.E_MPa, shaft.nu, {}};
    for (const Segment& s : shaft.segments) {
      const auto [left, right] =
          part::split(s, s.length_mm * random_shafts::between(random, 0.05, 0.95));
      halves.segments.insert(halves.segments.end(), {left, right});
    }
    const Beam one(shaft), two(halves);
    const std::vector<double> a = positions(one.length_mm());
    for (const Supports& s : random_shafts::supports())
      EXPECT_LE(difference(at(two, a, s), at(one, a, s)), kPromised) << name;
  }
}

TEST(Beam, BetweenCentresTheMirroredShaftIsTheSame) {
  for (const auto& [name, shaft] : random_shafts::all(11)) {
    Shaft mirrored = shaft;
    std::reverse(mirrored.segments.begin(), mirrored.segments.end());
    for (Segment& s : mirrored.segments) {
      std::swap(s.outer_left_mm, s.outer_right_mm);
      std::swap(s.inner_left_mm, s.inner_right_mm);
    }
    const Beam beam(shaft), image(mirrored);
    const double L = beam.length_mm();
    const std::vector<double> a = positions(L);
    std::vector<double> b;
    for (const double x : a) b.push_back(L - x);
    const auto x = at(beam, a, {Method::between_centres, {}, 1e-5, 3e-5});
    auto y = at(image, b, {Method::between_centres, {}, 3e-5, 1e-5});
    for (Flexibility& f : y) {
      f.f_wp_rad_N = -f.f_wp_rad_N;
      f.tail_per_N = 1 - f.tail_per_N;  // the other centre's share
    }
    EXPECT_LE(difference(x, y), kPromised) << name;
  }
}

TEST(Beam, ScalesLikeALengthOverStiffness) {
  const double k = 10;
  for (const auto& [name, shaft] : random_shafts::all(13)) {
    Shaft large = shaft;
    for (Segment& s : large.segments)
      s = {k * s.length_mm, k * s.outer_left_mm, k * s.outer_right_mm,
           k * s.inner_left_mm, k * s.inner_right_mm};
    const Beam beam(shaft), big(large);
    for (Supports s : random_shafts::supports()) {
      const auto a = positions(beam.length_mm());
      auto ka = a;
      for (double& x : ka) x *= k;
      const auto small = at(beam, a, s);
      s.root.c0_mm_N /= k;
      s.root.c1_rad_N /= k * k;
      s.root.c2_rad_Nmm /= k * k * k;
      s.head_mm_N /= k;
      s.tail_mm_N /= k;
      auto back = at(big, ka, s);
      for (Flexibility& f : back) {
        f.f_ww_mm_N *= k;
        f.f_wp_rad_N *= k * k;
        f.f_pp_rad_Nmm *= k * k * k;
        f.tail_per_Nmm *= k;
      }
      EXPECT_LE(difference(back, small), kPromised) << name;
    }
  }
}

TEST(Beam, AnyOrderOfPositionsGivesTheSame) {
  // to the last bit, ends of segments included
  for (const auto& [name, shaft] : random_shafts::all(17)) {
    const Beam beam(shaft);
    std::vector<double> rising = positions(beam.length_mm());
    for (const double z : part::ends_mm(shaft.segments)) rising.push_back(z);
    std::vector<double> mixed = rising;
    std::sort(rising.begin(), rising.end());
    const std::vector<double> falling(rising.rbegin(), rising.rend());
    for (const Supports& s : random_shafts::supports())
      for (const auto& a : {rising, falling, mixed}) {
        const auto together = at(beam, a, s);
        for (std::size_t i = 0; i < a.size(); ++i)
          for (const Field f : kFields)
            EXPECT_EQ(together[i].*f, beam.at(a[i], s).*f) << name << " at " << a[i];
      }
  }
}

TEST(Beam, TheChuckAloneIsItsCompliance) {
  const Beam beam({210000, 0.3, {{160, 40, 40, 0, 0}}});
  const Root root{1.8e-5, 8.6e-8, 1.1e-9};
  const Flexibility f = beam.at(0, {Method::chuck, root, 0, 0});
  EXPECT_EQ(f.f_ww_mm_N, root.c0_mm_N);
  EXPECT_EQ(f.f_wp_rad_N, root.c1_rad_N);
  EXPECT_EQ(f.f_pp_rad_Nmm, root.c2_rad_Nmm);
  const Flexibility rigid = beam.at(0, {Method::chuck_tailstock, {}, 0, 0});
  for (const Field x : kFields) EXPECT_EQ(rigid.*x, 0);
  const Flexibility tail = beam.at(160, {Method::chuck_tailstock, root, 0, 0});
  EXPECT_NEAR(tail.f_ww_mm_N, 0, 1e-25);
  EXPECT_EQ(tail.tail_per_N, 1);
}

TEST(Beam, AStiffTailIsTheLimitOfAnElasticOneAndASoftOneOfNone) {
  const Beam beam({210000, 0.3, {{80, 60, 60, 0, 0}, {120, 40, 40, 0, 0}}});
  const Root root{1.8e-5, 8.6e-8, 1.1e-9};
  for (const double a : {10.0, 90.0, 180.0}) {
    const Flexibility rigid = beam.at(a, {Method::chuck_tailstock, root, 0, 0}),
                      stiff = beam.at(a, {Method::chuck_tailstock, root, 0, 1e-20}),
                      soft = beam.at(a, {Method::chuck_tailstock, root, 0, 1e15}),
                      none = beam.at(a, {Method::chuck, root, 0, 0});
    for (const Field f : {kFields[0], kFields[1], kFields[2]}) {
      EXPECT_NEAR(stiff.*f / (rigid.*f), 1, 1e-11);
      EXPECT_NEAR(soft.*f / (none.*f), 1, 1e-11);
    }
  }
}

TEST(Beam, TwoBodiesJoinedAtTheToolAreThePartInProcess) {
  // the O(1) route against the part built anew for every position
  for (const auto& [name, shaft] : random_shafts::all(19)) {
    const Beam finished(shaft);
    const Beam uncut({shaft.E_MPa, shaft.nu, part::uncut(shaft.segments, 1.25)});
    const std::vector<double> a = positions(finished.length_mm());
    for (const Supports& s : random_shafts::supports())
      for (const auto towards : {part::FeedTowards::chuck, part::FeedTowards::tail}) {
        std::vector<Flexibility> joined(a.size()), built;
        if (towards == part::FeedTowards::chuck)
          flexibilities(uncut, finished, a, s, joined);
        else
          flexibilities(finished, uncut, a, s, joined);
        for (const double x : a)
          built.push_back(Beam({shaft.E_MPa, shaft.nu,
                                part::in_process(shaft.segments, x, 1.25, towards)})
                              .at(x, s));
        EXPECT_LE(difference(joined, built), kPromised) << name;
      }
  }
}

TEST(Beam, TwistOfATubeIsTheTextbooks) {
  const double L = 300, D = 40, d = 16, E = 210000, nu = 0.3;
  const double G = E / (2 * (1 + nu)),
               J = std::numbers::pi * (std::pow(D, 4) - std::pow(d, 4)) / 32;
  EXPECT_NEAR(Beam({E, nu, {{L, D, D, d, d}}}).twist_rad_Nmm() / (L / (G * J)), 1,
              kRounding);
}

TEST(Beam, RoundingInTheLastPositionIsForgiven) {
  const Beam beam({210000, 0.3, std::vector<Segment>(3, Segment{0.1, 1, 1, 0, 0})});
  EXPECT_NO_THROW(beam.at(0.1 + 0.1 + 0.1, {}));
  const double L = beam.length_mm();
  for (const Supports& s : random_shafts::supports())
    for (const Field f : kFields)
      EXPECT_EQ(beam.at(L * (1 + 5e-13), s).*f, beam.at(L, s).*f);
  EXPECT_THROW(beam.at(0.3001, {}), std::domain_error);
}

TEST(Beam, RefusesWhatIsNoBody) {
  const Segment good{100, 40, 40, 0, 0};
  const Segment bad[] = {{0, 40, 40, 0, 0},
                         {-1, 40, 40, 0, 0},
                         {kNaN, 40, 40, 0, 0},
                         {100, 0, 40, 0, 0},
                         {100, 40, -1, 0, 0},
                         {100, 40, 40, 40, 0},
                         {100, 40, 40, 0, 41},
                         {100, 40, 40, -1, 0},
                         {100, kNaN, 40, 0, 0},
                         {100, 40, 40, 0, kNaN},
                         {std::numeric_limits<double>::infinity(), 40, 40, 0, 0}};
  for (const Segment& s : bad)
    EXPECT_THROW(Beam({210000, 0.3, {good, s}}), std::domain_error);
  EXPECT_THROW(Beam({210000, 0.3, {}}), std::domain_error);
  for (const double E : {0.0, -1.0, kNaN})
    EXPECT_THROW(Beam({E, 0.3, {good}}), std::domain_error);
  for (const double nu : {-0.1, 0.5, kNaN})
    EXPECT_THROW(Beam({210000, nu, {good}}), std::domain_error);
  const Beam beam({210000, 0.3, {good}});
  for (const double a : {-1e-3, 100.001, kNaN})
    EXPECT_THROW(beam.at(a, {}), std::domain_error);
  // the springs of [Valino 2008]: S is indefinite, no elastic body
  for (const Root& root : {Root{-1, 0, 1}, Root{1, 0, -1}, Root{1, 1.1, 1},
                           Root{0, 1e-9, 0}, Root{kNaN, 0, 1}, Root{1, kNaN, 1}})
    EXPECT_THROW(beam.at(50, {Method::chuck, root, 0, 0}), std::domain_error);
  EXPECT_THROW(beam.at(50, {Method::between_centres, {}, -1, 0}), std::domain_error);
  EXPECT_THROW(beam.at(50, {Method::between_centres, {}, 0, kNaN}), std::domain_error);
}

}  // namespace
}  // namespace turnwright::deflection
