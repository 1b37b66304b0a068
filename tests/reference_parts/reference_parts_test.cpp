#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "document/json/file.hpp"
#include "global_search.hpp"
#include "turnwright/document/catalogue.hpp"
#include "turnwright/document/prepared_part.hpp"
#include "turnwright/document/process_plan.hpp"
#include "turnwright/planning/plan.hpp"

// The plans of parts/ against an independent search, against costs.json (that search with
// full effort) and against themselves.
namespace turnwright::reference {
namespace {

using planning::CertificateKind;
using planning::PlanStatus;
using planning::ProcessPlan;
using planning::Verdict;

constexpr double kGap = 1e-4;        // what a certificate may leave open
constexpr double kBeyond = 1e-9;     // of a limit: what an optimum may be over it
constexpr double kRounding = 1e-12;  // of sums of some ten costs

document::PreparedDocument loaded(const std::string& name) {
  const std::string root = TURNWRIGHT_SOURCE_DIR;
  return document::prepared_part(document::parse_file(root + "/parts/" + name + ".json"),
                                 document::load_catalogue(root), name);
}

nlohmann::json stored(const std::string& name) {
  std::ifstream in(TURNWRIGHT_SOURCE_DIR "/tests/reference_parts/costs.json");
  return nlohmann::json::parse(in).at(name);
}

void expect_global(const planning::Certificate& c, const std::string& of) {
  EXPECT_EQ(c.kind, CertificateKind::global) << of << ": " << c.reason;
  EXPECT_GE(c.gap, 0) << of;
  EXPECT_LE(c.gap, kGap) << of;
}

double operations_cost(const ProcessPlan& plan, const std::string& surface) {
  double sum = 0;
  for (const auto& s : plan.setups)
    for (const auto& o : s.operations)
      if (o.on == std::vector{surface} && o.kind != planning::OperationKind::fixed)
        sum += o.cost;
  return sum;
}

class ReferencePart : public testing::TestWithParam<const char*> {
 protected:
  const std::string name = GetParam();
  const document::PreparedDocument part = loaded(name);
  const ProcessPlan plan = planning::plan(part.part);
};

TEST_P(ReferencePart, HasAPlanThatMeetsEveryTolerance) {
  ASSERT_EQ(plan.status, PlanStatus::ok);
  EXPECT_TRUE(plan.conflicts.empty());
  ASSERT_EQ(plan.tolerances.size(), part.part.drawing.tolerances.size());
  for (const auto& t : plan.tolerances) {
    EXPECT_NE(t.verdict, Verdict::not_met) << t.id << ' ' << t.of;
    EXPECT_GE(t.P_conform, part.part.conformance - 1e-6) << t.id << ' ' << t.of;
    EXPECT_GE(t.margin_mm, -kBeyond * std::abs(t.allowed_mm.back()))
        << t.id << ' ' << t.of;
  }
}

TEST_P(ReferencePart, KeepsEveryLimitItLists) {
  ASSERT_EQ(plan.status, PlanStatus::ok);
  for (const auto& s : plan.setups)
    for (const auto& o : s.operations) {
      EXPECT_FALSE(o.constraints.empty()) << o.id;
      for (const auto& c : o.constraints) {
        const double margin = (c.at_most ? -1 : 1) * std::log(c.value / c.limit);
        EXPECT_GE(margin, -kBeyond) << o.id << ' ' << c.name;
        EXPECT_NEAR(c.margin, margin, kBeyond) << o.id << ' ' << c.name;
      }
    }
}

TEST_P(ReferencePart, KeepsEveryLimitAndCostsWhatItSaysWhenComputedAnew) {
  ASSERT_EQ(plan.status, PlanStatus::ok);
  const auto anew = as_planned(part.part, plan);
  for (const auto& setup : anew.setups)
    for (const auto& x : setup.surfaces) {
      EXPECT_LE(x.excess, kBeyond) << x.surface;
      EXPECT_NEAR(operations_cost(plan, x.surface), x.objective, kRounding) << x.surface;
    }
  EXPECT_NEAR(plan.cost_per_part, anew.objective, kRounding * anew.objective);
}

TEST_P(ReferencePart, IsCertifiedAsAWholeAndInEveryOperation) {
  ASSERT_EQ(plan.status, PlanStatus::ok);
  expect_global(plan.certificate, "plan");
  EXPECT_NEAR(plan.certificate.lower_bound,
              plan.cost_per_part * (1 - plan.certificate.gap),
              kRounding * plan.cost_per_part);
  for (const auto& s : plan.setups)
    for (const auto& o : s.operations) expect_global(o.certificate, o.id);
}

TEST_P(ReferencePart, CostsWhatTheSearchWithFullEffortFound) {
  const double cost = stored(name).at("cost_per_part");
  EXPECT_NEAR(plan.cost_per_part, cost, kGap * cost);
  EXPECT_GE(cost, plan.certificate.lower_bound);
}

TEST_P(ReferencePart, IsNotBeatenByAShortSearch) {
  const auto found = search(part.part, kShort);
  EXPECT_GE(found.objective, plan.certificate.lower_bound);
  EXPECT_GE(found.objective, plan.cost_per_part * (1 - kGap));
  EXPECT_NEAR(found.objective, plan.cost_per_part, kGap * plan.cost_per_part);
}

TEST_P(ReferencePart, HasTheSameBytesWhenPlannedAgain) {
  EXPECT_EQ(document::to_json(plan, part.assumed).dump(),
            document::to_json(planning::plan(part.part), part.assumed).dump());
}

// One plan for all of it, as milled places take their time; they are planned by the same
// code in the search, which chooses the turning beside them.
TEST(ReferencePartWithMilledPlaces, IsCertifiedAndCostsWhatTheSearchFound) {
  const auto plan = planning::plan(loaded("keyed-shaft").part);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  int milled = 0;
  for (const auto& s : plan.setups)
    for (const auto& o : s.operations) {
      expect_global(o.certificate, o.id);
      milled += o.kind == planning::OperationKind::mill;
      for (const auto& c : o.constraints) EXPECT_GE(c.margin, -kBeyond) << o.id << c.name;
    }
  EXPECT_EQ(milled, 2);
  expect_global(plan.certificate, "plan");
  const double cost = stored("keyed-shaft").at("cost_per_part");
  EXPECT_NEAR(plan.cost_per_part, cost, kGap * cost);
  EXPECT_GE(cost, plan.certificate.lower_bound * (1 - kRounding));
}

INSTANTIATE_TEST_SUITE_P(Parts, ReferencePart,
                         testing::Values("gearbox-input-shaft", "piston-rod",
                                         "spindle-nose", "flanged-bush", "motor-shaft",
                                         "pump-shaft", "iron-hub", "titanium-pin",
                                         "aluminium-tube", "bearing-seat", "roller-tube",
                                         "coupling-shaft", "threaded-spindle",
                                         "drilled-bush"),
                         [](const auto& at) {
                           std::string name = at.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

class PartInfeasibleAsDrawn : public testing::Test {
 protected:
  // Its tolerances alone: it chatters too.
  static document::PreparedDocument damped() {
    auto all = loaded("infeasible-as-drawn");
    all.part.chatter_times = 1e4;
    return all;
  }
  const document::PreparedDocument part = damped();
  const ProcessPlan plan = planning::plan(part.part);

  // The part with a named tolerance opened to a width about its middle.
  static planning::PreparedPart opened(planning::PreparedPart p, const std::string& limit,
                                       double width) {
    for (auto& t : p.drawing.tolerances) {
      if (t.id + ' ' + part::name(t.kind) + " of " + t.of != limit) continue;
      t.value_mm = width;
      if (!t.limits) continue;
      const double middle = (t.limits->upper_mm + t.limits->lower_mm) / 2;
      t.limits = part::Limits{middle - width / 2, middle + width / 2};
    }
    return p;
  }

  // All limits that have to give, each opened as told times a factor.
  planning::PreparedPart opened(const std::vector<double>& factors) const {
    auto p = part.part;
    for (std::size_t i = 0; i < plan.relax.size(); ++i)
      p = opened(p, plan.relax[i].limit, factors[i] * plan.relax[i].needed);
    return p;
  }
};

TEST_F(PartInfeasibleAsDrawn, IsInfeasibleToTheSearchToo) {
  EXPECT_EQ(plan.status, PlanStatus::infeasible);
  EXPECT_TRUE(stored("infeasible-as-drawn").at("infeasible"));
  EXPECT_FALSE(std::isfinite(search(part.part, kShort).objective));
}

TEST_F(PartInfeasibleAsDrawn, NamesTheTolerancesThatFailAndByHowMuch) {
  ASSERT_FALSE(plan.conflicts.empty());
  for (const auto& c : plan.conflicts) {
    const bool first = c.limit == "t1 cylindricity" || c.limit == "d2:diameter diameter";
    EXPECT_TRUE(first || c.limit == "d1:diameter diameter") << c.limit;
    EXPECT_NE(c.where.find(first ? "setup 1, chuck, d2" : "setup 2, chuck, d1"),
              std::string::npos)
        << c.where;
    EXPECT_GT(c.value, c.allowed) << c.limit;
    EXPECT_EQ(c.unit, "mm");
  }
}

TEST_F(PartInfeasibleAsDrawn, CanBeMadeOnceEveryLimitGivesWayAsTold) {
  ASSERT_FALSE(plan.relax.empty());
  for (const auto& r : plan.relax) EXPECT_GT(r.needed, r.now) << r.limit;
  const std::vector<double> all(plan.relax.size(), 1.001);
  EXPECT_TRUE(std::isfinite(search(opened(all), kShort).objective));
}

TEST_F(PartInfeasibleAsDrawn, CannotBeMadeWhenOneGivesWayByLess) {
  ASSERT_FALSE(plan.relax.empty());
  for (std::size_t i = 0; i < plan.relax.size(); ++i) {
    std::vector<double> factors(plan.relax.size(), 100);
    factors[i] = 0.99;
    EXPECT_FALSE(std::isfinite(search(opened(factors), kShort).objective))
        << plan.relax[i].limit;
  }
}

TEST_F(PartInfeasibleAsDrawn, HasAResultDocument) {
  const auto json = document::to_json(plan, part.assumed);
  EXPECT_EQ(json.at("status"), "infeasible");
  EXPECT_EQ(json.dump(),
            document::to_json(planning::plan(part.part), part.assumed).dump());
}

}  // namespace
}  // namespace turnwright::reference
