// What holds of the plan of any part.  RC_PARAMS sets how many are tried and the seed.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <future>

#include "random_parts.hpp"
#include "turnwright/document/process_plan.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

using namespace properties;

constexpr double kCertified = 1e-4;  // gap that a certificate may leave

bool made(const ProcessPlan& r) { return r.status == PlanStatus::ok; }

// Every plan is inside its limits, and predicted with its own conditions it is itself.
RC_GTEST_PROP(AnyPlan, KeepsItsLimitsAsPredicted, (const RandomShaft& shaft)) {
  const auto d = json_of(shaft);
  const auto r = plan(part(d));
  RC_CLASSIFY(made(r));
  if (!made(r)) {
    RC_ASSERT(!r.conflicts.empty());
    return;
  }
  RC_ASSERT(r.certificate.lower_bound <= r.cost_per_part * (1 + 1e-9));
  RC_ASSERT(r.certificate.gap <= 1e-4);
  const auto again = predict(part_to_predict(as_planned(d, r)));
  RC_ASSERT(made(again));
  RC_ASSERT(std::abs(again.cost_per_part - r.cost_per_part) <= 1e-9 * r.cost_per_part);
  for (std::size_t i = 0; i < r.tolerances.size(); ++i) {
    RC_ASSERT(again.tolerances[i].verdict != Verdict::not_met);
    RC_ASSERT(std::abs(again.tolerances[i].margin_mm - r.tolerances[i].margin_mm) <=
              1e-9);
  }
  for (const auto& setup : again.setups)
    for (const auto& o : setup.operations)
      for (const auto& c : o.constraints) RC_ASSERT(c.margin >= -1e-9);
}

// More wear never widens a margin, whichever tolerance it is, and never lets more parts be
// kept.  Without offsets: one that more wear makes necessary brings a size to its middle.
RC_GTEST_PROP(AnyPlan, WithMoreWearHasNoWiderMargin, (const RandomShaft& shaft)) {
  auto d = json_of(shaft);
  d["budget"] = {{"edge_wear_mm", 0.1}, {"first_part_gauged", false}};
  const auto r = plan(part(d));
  RC_CLASSIFY(made(r));
  if (!made(r)) return;
  auto conditions = as_planned(d, r);
  auto before = r.tolerances;
  for (const double VB_mm : {0.15, 0.2, 0.3}) {
    conditions["budget"]["edge_wear_mm"] = VB_mm;
    const auto at = predict(part_to_predict(conditions));
    RC_ASSERT(at.tolerances.size() == before.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      RC_ASSERT(at.tolerances[i].margin_mm <= before[i].margin_mm + 1e-9);
      RC_ASSERT(at.tolerances[i].P_conform <= before[i].P_conform + 1e-6);
    }
    before = at.tolerances;
  }
}

// A plan of the harder part also makes the easier one.  Where only a corrected path makes
// the harder part, an easier part that needs none is planned without, see
// docs/planning-proof.md.
void no_dearer(const ProcessPlan& easier, const ProcessPlan& harder) {
  if (!made(harder) || !harder.compensation.empty()) return;
  RC_ASSERT(made(easier));
  RC_ASSERT(easier.cost_per_part <= harder.cost_per_part * (1 + kCertified));
}

RC_GTEST_PROP(AnyPlan, WithLooserTolerancesIsNoDearer, (const RandomShaft& shaft)) {
  auto p = part(json_of(shaft));
  const auto harder = plan(p);
  for (auto& t : p.drawing.tolerances) {
    t.value_mm *= 1.5;
    if (t.limits) {
      const double more = (t.limits->upper_mm - t.limits->lower_mm) / 4;
      t.limits->upper_mm += more;
      t.limits->lower_mm -= more;
    }
  }
  no_dearer(plan(p), harder);
}

RC_GTEST_PROP(AnyPlan, InAStifferChuckIsNoDearer, (const RandomShaft& shaft)) {
  auto p = part(json_of(shaft));
  const auto harder = plan(p);
  for (catalogue::RootCompliance* c :
       {&p.machine.chuck.radial, &p.machine.chuck.tangential}) {
    c->c0_mm_N /= 2;
    c->c1_rad_N /= 2;
    c->c2_rad_Nmm /= 2;
  }
  no_dearer(plan(p), harder);
}

// Another currency, the same plan.
RC_GTEST_PROP(AnyPlan, CostsInAnyCurrencyTheSame, (const RandomShaft& shaft)) {
  auto p = part(json_of(shaft));
  const auto r = plan(p);
  const double rate = *rc::gen::element(0.01, 7.5, 1000.0);
  p.machine_per_min *= rate;
  for (auto& t : p.tools) t.edge_cost *= rate;
  for (auto& t : p.fixed_tools) t.edge_cost *= rate;
  const auto other = plan(p);
  RC_ASSERT(made(other) == made(r));
  RC_ASSERT(std::abs(other.cost_per_part / rate - r.cost_per_part) <=
            kCertified * r.cost_per_part);
}

// Seen from the other end it is the same part, held by the other end first.
RC_GTEST_PROP(AnyPlan, OfTheMirroredPartIsAsGood, (const RandomShaft& shaft)) {
  RandomShaft one = shaft;
  one.cylindricity_um = 0;  // of the last cylinder
  auto d = json_of(mirrored(one));
  std::swap(d["setups"][0], d["setups"][1]);
  const auto r = plan(part(json_of(one))), other = plan(part(d));
  RC_ASSERT(made(other) == made(r));
  if (made(r))
    RC_ASSERT(std::abs(other.cost_per_part - r.cost_per_part) <=
              kCertified * r.cost_per_part);
}

RC_GTEST_PROP(AnyPlan, IsTheSameOnEveryThread, (const RandomShaft& shaft)) {
  const auto loaded = [&] {
    const auto p = part(json_of(shaft));
    return document::to_json(plan(p), std::vector<document::Assumption>{}).dump();
  };
  auto other = std::async(std::launch::async, loaded);
  const auto here = loaded();
  RC_ASSERT(here == other.get());
}

}  // namespace
}  // namespace turnwright::planning
