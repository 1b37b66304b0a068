#include "turnwright/volumetric/samba.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <stop_token>

#include "machines.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::volumetric {
namespace {

constexpr double kDeg = std::numbers::pi / 180;

SambaStrategy strategy() {
  const auto file = testing::reference()["samba_strategy"];
  SambaStrategy s;
  for (const auto& bc : file["indexations_deg"])
    s.indexations.push_back(
        {bc[0].get<double>() * kDeg, bc[1].get<double>() * kDeg, {}, {}});
  for (std::size_t i = 0; i < s.indexations.size(); ++i)
    for (const std::size_t ball : file["balls_seen"][i])
      s.indexations[i].balls.push_back(ball - 1);
  for (const auto& [at, moves] : file["pre_moves"].items())
    s.indexations[std::stoul(at) - 1].pre_moves =
        moves.get<std::vector<std::array<double, 2>>>();
  s.balls_mm = file["balls"].get<std::vector<Vec3>>();
  s.facet_mm = file["facet"];
  s.facet_normal = file["facet_normal"];
  s.scale_bar_mm = file["scale_bar_true"];
  return s;
}

// The first of samba_parameters(), whose groups are counted here.
std::vector<std::string> first(std::size_t count) {
  const auto& all = samba_parameters();
  return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)};
}

TEST(Samba, CountsProbingsAndEquations) {
  const auto found = identifiability(strategy(), samba_parameters());
  EXPECT_EQ(found.equations, 189u);  // 3 x 56 balls, 20 touches, 1 scale bar
  EXPECT_EQ(samba_parameters().size(), 102u);
  const std::set<std::string> once(samba_parameters().begin(), samba_parameters().end());
  EXPECT_EQ(once.size(), 102u);
}

TEST(Samba, RanksAndConditions) {
  struct Row {
    std::size_t parameters, unknowns, rank;
    double condition;
  };
  for (const Row& row : {Row{11, 32, 32, 24}, Row{29, 50, 50, 122}, Row{56, 77, 65, 0},
                         Row{102, 123, 102, 0}}) {
    const auto found = identifiability(strategy(), first(row.parameters));
    EXPECT_EQ(found.unknowns.size(), row.unknowns);
    EXPECT_EQ(found.rank, row.rank);
    EXPECT_EQ(found.null_vectors.size(), row.unknowns - row.rank);
    if (row.condition > 0) {
      EXPECT_NEAR(found.condition, row.condition, 0.5);
    }
  }
}

TEST(Samba, NamesWhatOneStylusCannotSee) {
  const auto found = identifiability(strategy(), first(56));
  std::set<std::string> hidden;
  for (const NullVector& v : found.null_vectors) {
    ASSERT_EQ(v.size(), 1u);
    EXPECT_NEAR(v.begin()->second, 1, 1e-9);
    hidden.insert(v.begin()->first);
  }
  std::set<std::string> expected;
  for (const char* e : {"EAY", "EBY", "ECY", "EBZ"})
    for (const char* power : {"1", "2", "3"}) expected.insert(std::string(e) + power);
  EXPECT_EQ(hidden, expected);
  for (std::size_t j = 0; j < found.unknowns.size(); ++j)
    EXPECT_EQ(found.identifiable[j], !expected.contains(found.unknowns[j]))
        << found.unknowns[j];
}

TEST(Samba, BacklashIsKnownUpToTheFacetsDistance) {
  auto names = first(29);
  for (const char* name : {"EXXb", "EYYb", "EZZb", "facet"}) names.emplace_back(name);
  const auto found = identifiability(strategy(), names);
  ASSERT_EQ(found.null_vectors.size(), 1u);
  ASSERT_EQ(found.null_vectors[0].size(), 4u);
  for (const auto& [name, component] : found.null_vectors[0])
    EXPECT_NEAR(std::abs(component), 0.5, 1e-9) << name;
  names.pop_back();
  EXPECT_TRUE(identifiability(strategy(), names).null_vectors.empty());
}

TEST(Samba, RemediesRaiseTheRank) {
  const auto s = strategy();
  const auto found = remedies(s, identifiability(s, samba_parameters()));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].rank, 110u);
  EXPECT_EQ(found[1].rank, 119u);
  EXPECT_EQ(found[2].rank, 122u);
  EXPECT_EQ(found[2].gains, (std::vector<std::string>{"ECY1", "ECY2", "ECY3"}));
  EXPECT_TRUE(remedies(s, identifiability(s, first(29))).empty());
}

// A column of the matrix is what the exact kinematics say of a small error.
TEST(Samba, ReadingsAreTheExactErrorsOfSmallErrors) {
  const auto s = strategy();
  std::mt19937 random(1);
  std::uniform_real_distribution<> number(-5e-5, 5e-5);
  Machine m{"wCBXfZYt", {}, {}};
  for (const char c : {'X', 'Y', 'Z', 'B', 'C'}) m.axes.push_back({c, {}, default_Q(c)});
  std::map<std::string, double> errors;
  for (const std::string& name : samba_parameters()) {
    if (name == "facet") continue;
    const std::size_t d = letter_index(name[1]);
    const double x = errors[name] = number(random) * (d < 3 ? 1 : 1e-2);
    Axis& axis =
        *std::ranges::find(m.axes, name[2] == '0' ? name[3] : name[2], &Axis::name);
    if (name[2] == '0')
      axis.location[d] = x;
    else if (name[3] == 'b')
      axis.errors[d].b = x;
    else
      axis.errors[d].c[static_cast<std::size_t>(name[3] - '0')] = x;
  }
  const auto readings = samba_readings(s, errors);
  const Kinematics k(m);
  std::size_t at = 0;
  for (const Indexation& i : s.indexations) {
    const auto R = table_rotation(i);
    const auto position = [&](const Vec3& p) {
      Position q{.q = {0, 0, 0, 0, i.B_rad, i.C_rad}};
      for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t c = 0; c < 3; ++c) q.q[row] += R[3 * c + row] * p[c];
      return q;
    };
    for (const std::size_t ball : i.balls) {
      const Position q = position(s.balls_mm[ball]);
      const Vec3 e = k.tip_error_mm(q), tip = k.nominal(q).tip_mm;
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(tip[c], s.balls_mm[ball][c], 1e-10);
        EXPECT_NEAR(readings[at++], e[c], 1e-8);
      }
    }
    for (const auto& move : i.pre_moves) {
      Position q = position(s.facet_mm);
      const Vec3 n{R[0], R[1], R[2]};  // the facet looks along x
      std::size_t next = 0;
      for (std::size_t c = 0; c < 3; ++c)
        q.sign[c] = std::abs(n[c]) > 0.5 ? -std::copysign(1, n[c]) : move[next++];
      EXPECT_NEAR(readings[at++], k.tip_error_mm(q)[0], 1e-8);
    }
  }
  EXPECT_EQ(at, readings.size());
}

/// 53 parameters and 21 of the set-up, all identifiable.
std::vector<std::string> seventy_four() {
  std::vector<std::string> out;
  for (const std::string& name : first(65))
    if (!name.starts_with("EAY") && !name.starts_with("EBY") &&
        !name.starts_with("ECY") && !name.starts_with("EBZ"))
      out.push_back(name);
  return out;
}

struct Truth {
  SambaStrategy s = strategy();
  std::vector<std::string> names = seventy_four();
  std::map<std::string, double> errors;
  std::vector<double> readings;
  Truth() {
    std::mt19937 random(3);
    std::uniform_real_distribution<> number(-0.02, 0.02);
    const auto of = identifiability(s, names);
    for (std::size_t j = 0; j < of.unknowns.size(); ++j) {
      const std::string& name = of.unknowns[j];
      const bool angle = name[0] == 'E' && letter_index(name[1]) > 2;
      errors[name] = number(random) * (angle ? 1e-3 : 1);
    }
    // The scale bar holds balls 1 and 2 at its true length.
    double nominal = 0, along = 0;
    for (std::size_t c = 0; c < 3; ++c)
      nominal += std::pow(s.balls_mm[1][c] - s.balls_mm[0][c], 2);
    nominal = std::sqrt(nominal);
    for (std::size_t c = 0; c < 3; ++c)
      along += (s.balls_mm[1][c] - s.balls_mm[0][c]) / nominal *
               (errors[std::string("ball2_") + "xyz"[c]] -
                errors[std::string("ball1_") + "xyz"[c]]);
    s.scale_bar_mm = nominal + along;
    readings = samba_readings(s, errors);
  }
};

TEST(Samba, RecoversSeventyFourUnknowns) {
  const Truth t;
  const SambaFit fit = samba_fit(t.s, t.names, t.readings);
  EXPECT_EQ(fit.of.unknowns.size(), 74u);
  EXPECT_EQ(fit.of.rank, 74u);
  EXPECT_EQ(fit.dof, 115u);
  EXPECT_LT(fit.s0_mm, 1e-12);
  for (std::size_t j = 0; j < 74; ++j)
    EXPECT_NEAR(fit.value[j], t.errors.at(fit.of.unknowns[j]), 1e-10)
        << fit.of.unknowns[j];
}

TEST(Samba, NoiseStaysWithinThePredictedUncertainty) {
  const Truth t;
  std::mt19937 random(5);
  std::normal_distribution<> noise(0, 1e-3);
  int inside = 0, all = 0;
  double s0 = 0;
  for (int trial = 0; trial < 200; ++trial) {
    auto readings = t.readings;
    for (double& r : readings) r += noise(random);
    auto s = t.s;
    s.scale_bar_mm += noise(random);
    const SambaFit fit = samba_fit(s, t.names, readings, 1e-3);
    s0 += fit.s0_mm / 200;
    for (std::size_t j = 0; j < 74; ++j, ++all)
      if (std::abs(fit.value[j] - t.errors.at(fit.of.unknowns[j])) <= 2 * fit.u[j])
        ++inside;
  }
  EXPECT_NEAR(static_cast<double>(inside) / all, 0.9545, 0.01);
  EXPECT_NEAR(s0, 1e-3, 2e-5);
}

// The fit is linear, so the bar's part of a value's scatter is its slope by the length.
TEST(Samba, TheBarCountsAsOneReading) {
  constexpr double kNoise = 1e-3;
  constexpr int kTrials = 200;
  const Truth t;
  auto longer = t.s;
  longer.scale_bar_mm += 1;
  const SambaFit once = samba_fit(t.s, t.names, t.readings, kNoise),
                 more = samba_fit(longer, t.names, t.readings, kNoise);
  double least = 1;
  for (const bool exact : {false, true}) {
    std::mt19937 random(11);
    std::normal_distribution<> noise(0, kNoise);
    std::vector<double> squares(once.value.size());
    for (int trial = 0; trial < kTrials; ++trial) {
      auto readings = t.readings;
      for (double& r : readings) r += noise(random);
      auto s = t.s;
      if (!exact) s.scale_bar_mm += noise(random);
      const SambaFit fit = samba_fit(s, t.names, readings, kNoise);
      for (std::size_t j = 0; j < squares.size(); ++j)
        squares[j] += std::pow((fit.value[j] - once.value[j]) / fit.u[j], 2) / kTrials;
    }
    for (std::size_t j = 0; j < squares.size(); ++j) {
      const double by_bar = kNoise * (more.value[j] - once.value[j]) / once.u[j];
      const double share = exact ? std::sqrt(1 - by_bar * by_bar) : 1;
      EXPECT_NEAR(std::sqrt(squares[j]), share, 0.2 * share) << once.of.unknowns[j];
      least = std::min(least, share);
    }
  }
  EXPECT_LT(least, 0.9);
}

// Between two axes equally near to the normal rounding does not choose.
TEST(Samba, TheAxisOfATouchDoesNotDependOnRounding) {
  const auto readings = [](const Vec3& normal) {
    auto s = strategy();
    s.facet_normal = normal;
    return samba_readings(s, {{"EXXb", 1e-3}, {"EYYb", 2e-3}, {"EZZb", 4e-3}});
  };
  const auto right = readings({1, 1, 0});
  for (const Vec3& beside : {Vec3{1 + 1e-12, 1, 0}, Vec3{1, 1 + 1e-12, 0}}) {
    const auto found = readings(beside);
    for (std::size_t i = 0; i < right.size(); ++i)
      EXPECT_NEAR(found[i], right[i], 1e-12) << i;
  }
}

TEST(Samba, RefusesValuesOfWhatItCannotKnow) {
  const Truth t;
  auto names = t.names;
  names.emplace_back("EAY1");
  names.emplace_back("facet");
  const SambaFit fit = samba_fit(t.s, names, t.readings);
  for (std::size_t j = 0; j < fit.value.size(); ++j) {
    const std::string& name = fit.of.unknowns[j];
    const bool hidden = name == "EAY1" || name == "facet" || name == "EXXb" ||
                        name == "EYYb" || name == "EZZb";
    EXPECT_EQ(fit.of.identifiable[j], !hidden) << name;
    if (hidden) {
      EXPECT_EQ(fit.value[j], 0);
    } else {
      EXPECT_NEAR(fit.value[j], t.errors.at(name), 1e-10) << name;
    }
  }
}

// 100 balls, seen in so many poses.
SambaStrategy large(std::size_t poses) {
  auto s = strategy();
  std::vector<std::size_t> seen(100);
  std::iota(seen.begin(), seen.end(), 0);
  for (std::size_t i = s.balls_mm.size(); i < seen.size(); ++i)
    s.balls_mm.push_back({static_cast<double>(i), 10, 20});
  s.indexations.assign(poses, {0, 0, seen, {}});
  return s;
}

TEST(Samba, RefusesWhatWouldTakeMinutes) {
  const auto s = large(129);  // 38,701 equations
  const auto message = [&s](std::size_t parameters) -> std::string {
    try {
      samba_fit(s, first(parameters), {}, {});
    } catch (const ModelRangeError& error) {
      return error.what();
    } catch (const std::domain_error&) {  // the readings are not there
    }
    return "";
  };
  EXPECT_EQ(message(19),
            "samba: 38701 equations of 322 unknowns, at most 4e+09 equations times the "
            "square of the unknowns are solved");
  EXPECT_EQ(message(18), "");
}

// Equations are taken up block by block.  Of a strategy that stands 16 times, every other
// time with the opposite noise, the fit is without noise and the residuals are all of it.
TEST(Samba, BlocksOfEquationsAreOneSystem) {
  constexpr std::size_t kTimes = 16;
  const Truth t;
  std::mt19937 random(7);
  std::normal_distribution<> number(0, 1e-3);
  std::vector<double> noise(t.readings.size()), readings;
  std::ranges::generate(noise, [&] { return number(random); });
  auto s = t.s;
  s.indexations.clear();
  for (std::size_t i = 0; i < kTimes; ++i) {
    s.indexations.insert(s.indexations.end(), t.s.indexations.begin(),
                         t.s.indexations.end());
    for (std::size_t k = 0; k < noise.size(); ++k)
      readings.push_back(t.readings[k] + (i % 2 == 0 ? noise[k] : -noise[k]));
  }
  const SambaFit fit = samba_fit(s, t.names, readings);
  EXPECT_EQ(fit.of.equations, 3009u);
  EXPECT_EQ(fit.of.rank, 74u);
  for (std::size_t j = 0; j < 74; ++j)
    EXPECT_NEAR(fit.value[j], t.errors.at(fit.of.unknowns[j]), 1e-10)
        << fit.of.unknowns[j];
  const double squares =
      kTimes * std::inner_product(noise.begin(), noise.end(), noise.begin(), 0.0);
  EXPECT_NEAR(fit.s0_mm, std::sqrt(squares / (3009 - 74)), 1e-12);
}

// Rounding does not decide between pivots that are equal.
TEST(Samba, NullVectorsDoNotDependOnTheOrderOfReadings) {
  const auto s = strategy();
  auto turned = s;
  std::ranges::reverse(turned.indexations);
  const auto found = identifiability(s, samba_parameters()).null_vectors,
             again = identifiability(turned, samba_parameters()).null_vectors;
  ASSERT_EQ(found.size(), again.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const auto& [name, component] : found[i]) {
      ASSERT_TRUE(again[i].contains(name)) << i << ' ' << name;
      EXPECT_NEAR(again[i].at(name), component, 1e-6) << i << ' ' << name;
    }
}

TEST(Samba, HearsThatNobodyWaits) {
  const auto s = large(10);
  const auto of = identifiability(strategy(), first(3));
  std::stop_source source;
  source.request_stop();
  const std::stop_token token = source.get_token();
  const Listening listening(token);
  EXPECT_THROW(identifiability(s, first(3)), Cancelled);
  EXPECT_THROW(remedies(strategy(), of), Cancelled);
  EXPECT_THROW(samba_readings(s, std::map<std::string, double>{{"EXX1", 1e-3}}),
               Cancelled);
}

TEST(Samba, RefusesWhatIsNoStrategy) {
  const auto s = strategy();
  for (const char* name : {"EXX4", "EXX0", "EX0X", "EC0Z", "EXA1", "EAXb", "EXBb", "X",
                           "EXX", "EXX11", "ball1_x"})
    EXPECT_FALSE(is_samba_parameter(name)) << name;
  EXPECT_THROW(identifiability(s, {"EXX1", "EXX1"}), std::domain_error);
  EXPECT_THROW(identifiability(s, {"EXX4"}), std::domain_error);
  EXPECT_THROW(samba_fit(s, {"EXX1"}, {1.0}), std::domain_error);
  auto wrong = s;
  wrong.indexations[0].balls[0] = 6;
  EXPECT_THROW(identifiability(wrong, {"EXX1"}), std::domain_error);
}

}  // namespace
}  // namespace turnwright::volumetric
