// Equations 1 to 8 of [Valino 2008] as printed, against what this program uses instead;
// docs/deflection.md explains each difference.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "finite_elements.hpp"
#include "random_shafts.hpp"
#include "turnwright/deflection/response.hpp"

namespace turnwright::deflection {
namespace {

using std::numbers::pi;

struct Section {
  double EI, GA_chi;
};

/// int_0^a of a function of z and the section there, over the zones.
double integral(const part::Shaft& shaft, double a,
                const std::function<double(double, const Section&)>& f) {
  const auto z = part::ends_mm(shaft.segments);
  const double nu = shaft.nu, chi = (7 + 6 * nu) / (6 * (1 + nu));
  double sum = 0;
  for (std::size_t i = 0; i < shaft.segments.size() && z[i] < a; ++i) {
    const double d = shaft.segments[i].outer_left_mm;  // solid cylinders only
    const Section s{shaft.E_MPa * pi * d * d * d * d / 64,
                    shaft.E_MPa / (2 * (1 + nu)) * pi * d * d / 4 / chi};
    sum += boost::math::quadrature::gauss<double, 10>::integrate(
        [&](double x) { return f(x, s); }, z[i], std::min(z[i + 1], a));
  }
  return sum;
}

double printed_6(const part::Shaft& s, double a) {
  return integral(s, a, [&](double z, const Section& c) {
    return (a - z) * (a - z) / c.EI + 1 / c.GA_chi;
  });
}

double printed_7(const part::Shaft& s, double a) {
  const double L = part::length_mm(s.segments), b = L - a;
  return b * b / (L * L) * integral(s, a, [&](double z, const Section& c) {
           return z * z / c.EI + 1 / c.GA_chi;
         });
}

double printed_8(const part::Shaft& s, double a) {
  const double L = part::length_mm(s.segments), b = L - a;
  const double L6 = 4 * std::pow(L, 6);
  return integral(s, a, [&](double z, const Section& c) {
    const double shear = b * b * std::pow(3 * L * L - b * b, 2) / L6;
    const double moment = (2 * L * L - a * (a - 2 * L)) * z + L * a * (a - 2 * L);
    return shear / c.GA_chi + b * b * moment * moment / L6 / c.EI;
  });
}

Supports rigid(Method method) { return {method, {}, 0, 0}; }

part::Shaft bar(double L, double d) { return {210000, 0.3, {{L, d, d, 0, 0}}}; }

/// Solid stepped shafts, two to five cylinders of 20 to 60 mm.
std::vector<part::Shaft> stepped_shafts() {
  std::mt19937_64 random(31);
  const auto r = [&](double low, double high) {
    return random_shafts::between(random, low, high);
  };
  std::vector<part::Shaft> all;
  for (int k = 0; k < 40; ++k) {
    part::Shaft s{210000, 0.3, {}};
    for (int i = 0; i < 2 + k % 4; ++i) {
      const double d = r(20, 60);
      s.segments.push_back({r(30, 90), d, d, 0, 0});
    }
    all.push_back(s);
  }
  return all;
}

TEST(Valino2008, Equation1SlopeOfTheEnvelopeIsTwiceTheRotationOfTheSection) {
  // Without couple and shear: d(F a^3/3EI)/da = F a^2/EI, the section turns by half of it
  const Beam wire(bar(1000, 1));
  const double a = 600, h = 0.01;
  const auto w = [&](double x) { return wire.at(x, {}).f_ww_mm_N; };
  const double slope = (w(a + h) - w(a - h)) / (2 * h);
  EXPECT_NEAR(slope / wire.at(a, {}).f_wp_rad_N, 2, 1e-5);
  // With couple and shear it is no fixed multiple: 250 N, 180 N, stepped shaft
  const Workpiece part({210000, 0.3, {{80, 60, 60, 0, 0}, {120, 40, 40, 0, 0}}});
  double smallest = 1e9, largest = 0;
  for (double z = 12; z < 200; z += 8) {
    const std::vector<double> at{z - h, z, z + h};
    const auto r = responses(part, {}, at, {250, 0, 180});
    const double ratio =
        std::abs((r[2].delta_r_mm - r[0].delta_r_mm) / (2 * h) / r[1].theta_r_rad);
    smallest = std::min(smallest, ratio);
    largest = std::max(largest, ratio);
  }
  EXPECT_LT(smallest, 2.4);
  EXPECT_GT(largest, 6);
}

struct Springs {
  double k1, k2, k3, Lc;
};

/// Eq. 3 of [Valino 2008] as printed, deflection at z on the springs.
double printed_3(const Springs& k, double D, double Fr, double Fa, double z) {
  return (Fr / k.k2 + Fr / k.k3) * z * z + Fa / 2 * (D / k.k3 - (D - 2 * Fr) / k.k2) * z +
         (Fr / k.k1 - Fa * D * k.Lc / (2 * k.k2) + Fr * k.Lc * k.Lc / k.k2);
}

TEST(Valino2008, Equation3IsTheThreeSpringsOneByOne) {
  // A rigid part: k1 slides, k2 turns about z = -Lc, k3 about z = 0; each spring sees its
  // own force or moment of Fr and C at z, and what it gives moves z by its arm.
  const Springs k{1.2e5, 1.28e9, 3e9, 110};
  const double D = 60, Fr = 250, Fa = 180, C = -Fa * D / 2;
  const Root root{1 / k.k1 + k.Lc * k.Lc / k.k2, k.Lc / k.k2, 1 / k.k2 + 1 / k.k3};
  for (const double z : {0.0, 20.0, 150.0}) {
    const double turn_2 = (Fr * (z + k.Lc) + C) / k.k2, turn_3 = (Fr * z + C) / k.k3;
    const double w = Fr / k.k1 + turn_2 * (z + k.Lc) + turn_3 * z;
    const Flexibility f = Beam({1e30, 0.3, {{200, D, D, 0, 0}}}).at(z, {.root = root});
    EXPECT_NEAR((f.f_ww_mm_N * Fr + f.f_wp_rad_N * C) / w, 1, 1e-13);
  }
}

TEST(Valino2008, Equation3AsPrintedHasTheThirdCoupleBackwardsAndMixesUnits) {
  const double z = 150, D = 60, Fr = 250, Fa = 180;
  // k3 alone gives: the couple -Fa D/2 turns the part towards the tool
  const Springs third{1e30, 1e30, 3e9, 0};
  EXPECT_NEAR(printed_3(third, D, Fr, Fa, z), z * (Fr * z + Fa * D / 2) / 3e9, 1e-15);
  EXPECT_LT(z * (Fr * z - Fa * D / 2) / 3e9, 0.8 * printed_3(third, D, Fr, Fa, z));
  // k2 alone, in N and mm and again in N and m: the same length comes out differently
  const Springs second{1e30, 1.28e9, 1e30, 110}, in_metres{1e30, 1.28e6, 1e30, 0.11};
  const double mm = printed_3(second, D, Fr, Fa, z);
  const double m = printed_3(in_metres, D / 1000, Fr, Fa, z / 1000);
  EXPECT_GT(std::abs(1000 * m / mm - 1), 0.1);
}

TEST(Valino2008, Equation5ShorteningIsLostBesideTheShanksBending) {
  // 20 x 20 shank, 32 mm out (SCLCR 2020 K09): a tenth of a micrometre against several
  const double l = 32, A = 400, I = 20.0 * 20 * 20 * 20 / 12, E = 210000;
  const double shortening = 250 * l / (A * E), bending = 600 * l * l * l / (3 * E * I);
  EXPECT_NEAR(shortening, 1e-4, 1e-5);
  EXPECT_GT(bending / shortening, 20);
}

TEST(Valino2008, Equation6HoldsForTheForceAndLacksTheCouple) {
  for (const auto& shaft : stepped_shafts()) {
    const Beam beam(shaft);
    for (const double u : {0.2, 0.7, 1.0}) {
      const double a = u * beam.length_mm();
      EXPECT_NEAR(beam.at(a, {}).f_ww_mm_N / printed_6(shaft, a), 1, 1e-12);
    }
  }
  // the couple of Fa/Fr = 0.72, in parts of the bending term: 0.54 D/a
  const double D = 40, L = 200;
  const Beam beam(bar(L, D));
  for (const double a : {D, 4 * D}) {
    const double EI = 210000 * pi * D * D * D * D / 64;
    const double couple = 0.72 * D / 2 * beam.at(a, {}).f_wp_rad_N;
    EXPECT_NEAR(couple / (a * a * a / (3 * EI)), 0.54 * D / a, 1e-12);
  }
}

/// Mean of |printed/right - 1| and the largest of printed/right and its inverse.
struct Errors {
  double mean, factor;
};

Errors errors(double (*printed)(const part::Shaft&, double), Method method) {
  double sum = 0, factor = 1;
  int count = 0;
  for (const auto& shaft : stepped_shafts()) {
    std::vector<double> a;
    for (const double u : {0.1, 0.3, 0.5, 0.7, 0.9})
      a.push_back(u * part::length_mm(shaft.segments));
    const auto right = finite_elements::flexibilities(shaft, a, rigid(method));
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double ratio = printed(shaft, a[i]) / right[i].f_ww_mm_N;
      sum += std::abs(ratio - 1);
      factor = std::max({factor, ratio, 1 / ratio});
      ++count;
    }
  }
  return {sum / count, factor};
}

TEST(Valino2008, Equation7CountsOneHalfOfTheBeam) {
  // on a bar the printed sum is a/L of a^2 b^2/(3 L EI)
  const part::Shaft wire = bar(1000, 1);
  for (const double a : {100.0, 500.0, 900.0})
    EXPECT_NEAR(
        printed_7(wire, a) / Beam(wire).at(a, rigid(Method::between_centres)).f_ww_mm_N,
        a / 1000, 1e-5);
  const Errors e = errors(printed_7, Method::between_centres);
  EXPECT_GT(e.mean, 0.4);
  EXPECT_GT(e.factor, 8);
  // with the other half it is exact
  for (const auto& shaft : stepped_shafts()) {
    const double L = part::length_mm(shaft.segments), a = 0.4 * L;
    part::Shaft image = shaft;
    std::reverse(image.segments.begin(), image.segments.end());
    EXPECT_NEAR((printed_7(shaft, a) + printed_7(image, L - a)) /
                    Beam(shaft).at(a, rigid(Method::between_centres)).f_ww_mm_N,
                1, 1e-12);
  }
}

TEST(Valino2008, Equation8StopsAtTheToolAndTakesAUniformReaction) {
  // on a bar its integrand is right, but the stretch from the tool to the tail is
  // missing: there the moment is R (L - z), R = a^2 (3 L - a)/2 L^3
  const part::Shaft wire = bar(1000, 1);
  const double L = 1000, EI = 210000 * pi / 64;
  for (const double a : {100.0, 500.0, 900.0}) {
    const double R = a * a * (3 * L - a) / (2 * L * L * L);
    const double missing = R * R * std::pow(L - a, 3) / (3 * EI);
    const double right = Beam(wire).at(a, rigid(Method::chuck_tailstock)).f_ww_mm_N;
    EXPECT_NEAR((right - missing) / right, printed_8(wire, a) / right, 1e-4);
  }
  const Errors e = errors(printed_8, Method::chuck_tailstock);
  EXPECT_GT(e.mean, 0.25);
  EXPECT_GT(e.factor, 4.5);
}

TEST(Valino2008, TheProfileIsOfThirdOrderOnlyForAUniformCantilever) {
  // forward differences of order n + 1 vanish for a polynomial of degree n
  const Beam wire(bar(1000, 1));
  const auto difference = [&](Method m, int order) {
    std::vector<double> w;
    double largest = 0;
    for (int k = 0; k <= order; ++k) {
      w.push_back(wire.at(100.0 * (k + 1), rigid(m)).f_ww_mm_N);
      largest = std::max(largest, w.back());
    }
    for (int n = 0; n < order; ++n)
      for (std::size_t k = 0; k + 1 < w.size() - static_cast<std::size_t>(n); ++k)
        w[k] = w[k + 1] - w[k];
    return std::abs(w[0]) / largest;
  };
  for (const auto& [method, degree] : {std::pair{Method::chuck, 3},
                                       {Method::between_centres, 4},
                                       {Method::chuck_tailstock, 6}}) {
    EXPECT_GT(difference(method, degree), 1e-3) << degree;
    EXPECT_LT(difference(method, degree + 1), 1e-5) << degree;
  }
}

}  // namespace
}  // namespace turnwright::deflection
