#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "oracle.hpp"

namespace turnwright::multipass {
namespace {

std::vector<std::string> names(const Answer& a) {
  std::vector<std::string> all;
  for (const Relief& r : a.conflict) all.push_back(r.limit);
  return all;
}

/// Opens the request's key that the limit stands under, which for limits of both passes
/// opens the other pass's too.
void open(Problem& m, const std::string& limit, double to) {
  const std::string key = limit.substr(limit.find(':') + 1);
  if (key == "VrU") m.VrU = to;
  if (key == "SRu_um") m.SRu_um = to;
  if (key == "k3") m.k3 = to;
  if (key == "k4") m.k4 = to;
  if (key == "k5") m.k5 = to;
  if (key == "n_max") m.n_max = static_cast<int>(to);
  if (key == "PU") m.PU = to;
  if (key == "FU") m.FU = to;
  if (key == "QU") m.QU = to;
  if (key == "SC") m.SC = to;
  const auto range = [&](const char* name, Range& r) {
    if (key == std::string(name) + "_min") r.lower = std::min(r.lower, to);
    if (key == std::string(name) + "_max") r.upper = std::max(r.upper, to);
  };
  range("V", m.V);
  range("f", m.f);
  range("d", m.d);
  range("T", m.T);
}

TEST(Conflict, TooDeepForThePasses) {
  Problem m;
  m.dt_mm = 30;  // seven passes of 3 mm are 21 mm
  const Answer a = optimum(m);
  EXPECT_FALSE(a.best);
  EXPECT_EQ(names(a), (std::vector<std::string>{"rough:d_max", "finish:d_max", "n_max"}));
  EXPECT_NEAR(*a.conflict[0].needed, 30.0 / 7, 1e-5);  // for all seven
  EXPECT_NEAR(*a.conflict[2].needed, 9, 0);
}

TEST(Conflict, TooShallowForOnePass) {
  Problem m;
  m.dt_mm = 1.5;
  EXPECT_EQ(names(optimum(m)), (std::vector<std::string>{"rough:d_min", "finish:d_min"}));
  m.dt_mm = 1;  // the least roughing depth is all there is: nothing is left to finish
  EXPECT_EQ(names(optimum(m)), std::vector<std::string>{"rough:d_min"});
}

TEST(Conflict, ALimitThatNothingMeets) {
  Problem m;
  m.FU = 10;  // 108 0.1^0.75 1^0.95 = 19.2
  const Answer a = optimum(m);
  EXPECT_EQ(names(a).size(), 3u);  // FU, least feed, least depth of one of the passes
  for (const auto& r : a.conflict) {
    if (r.limit.ends_with(":FU")) {
      ASSERT_TRUE(r.needed);
      m.FU = *r.needed * (1 + 1e-6);
    }
  }
  EXPECT_TRUE(optimum(m).best);
  Problem speeds;
  speeds.VrU = 40;
  EXPECT_EQ(names(optimum(speeds)),
            (std::vector<std::string>{"rough:V_min", "rough:VrU"}));
}

TEST(Conflict, IsIrreducibleAndItsReliefSuffices) {
  int tried = 0, relieved = 0;
  for (unsigned k = 0; tried < 50 && k < 400; ++k) {
    std::mt19937 seed(1000 + k);
    const Problem m = random_problem(seed);
    const Answer a = optimum(m);
    if (a.best) continue;
    SCOPED_TRACE(k);
    ++tried;
    ASSERT_FALSE(a.conflict.empty());
    for (const Relief& r : a.conflict) {
      if (!r.needed) continue;
      Problem wider = m;
      const bool lower =
          r.limit.ends_with("_min") || r.limit.ends_with("SC") || r.limit[0] == 'k';
      open(wider, r.limit, *r.needed * (lower ? 1 - 1e-8 : 1 + 1e-8));
      EXPECT_TRUE(optimum(wider).best) << r.limit;
      ++relieved;
    }
  }
  EXPECT_EQ(tried, 50);
  EXPECT_GT(relieved, 50);
}

}  // namespace
}  // namespace turnwright::multipass
