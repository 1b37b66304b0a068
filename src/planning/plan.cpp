#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "attempt.hpp"

namespace turnwright::planning {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Certificate total_certificate(const Attempt& a) {
  Certificate c;
  c.kind = CertificateKind::global;
  std::set<std::string> engines;
  for (const auto& s : a.setups)
    for (const auto& f : s.chosen.features) {
      const auto& k = f.answer.certificate;
      c.nodes += k.nodes;
      engines.insert(k.engine);
      if (k.kind != CertificateKind::global) {
        c.kind = k.kind;
        c.reason = f.task.feature.surface() + ": " + k.reason;
      }
    }
  for (const auto& e : engines) c.engine += (c.engine.empty() ? "" : " and ") + e;
  c.lower_bound = std::min(a.lower_bound, a.objective);
  c.gap = a.objective > 0 ? 1 - c.lower_bound / a.objective : 0;
  if (c.kind == CertificateKind::global && c.gap > kCertified) {
    c.kind = CertificateKind::local;
    c.reason =
        "with other tools or another clamping the budget of boxes ended before "
        "every box was settled";
  }
  return c;
}

Certificate no_certificate(const Attempt& a) {
  Certificate c;
  c.reason =
      a.lower_bound < kInfinity
          ? "no plan was found, but the budget of boxes ended before every box was "
            "settled"
          : "proved: no plan keeps every limit";
  for (const auto& s : a.setups)
    for (const auto& f : s.chosen.features) c.nodes += f.answer.certificate.nodes;
  return c;
}

SetupPlan setup_plan(const PartPlan& p, std::size_t index, const Comparison& c,
                     ProcessPlan& result) {
  SetupPlan s;
  s.hold = p.setups[index].hold;
  s.rejected = c.rejected;
  s.rejected_tools = c.chosen.rejected_tools;
  if (!c.solved) {
    for (const auto& r : c.rejected)
      result.conflicts.push_back({"clamping", fmt::format("setup {}", index), 0, 0, "",
                                  std::string(name(r.clamping)) + ": " + r.why});
    return s;
  }
  s.clamping = c.chosen.clamping;
  s.grip_force_N = jaw_force_N(p, index, s.clamping, Stage::roughing);
  s.finishing_grip_force_N = jaw_force_N(p, index, s.clamping, Stage::finishing);
  s.operations = operations_in_order(p, c.chosen);
  return s;
}

// What the path's correction, judged as it is cut, does not bring within its tolerance.
bool add_missed(ProcessPlan& result) {
  for (const auto& t : result.tolerances) {
    if (t.verdict != Verdict::not_met) continue;
    result.conflicts.push_back(
        {t.id + " " + part::name(t.kind), t.of, t.allowed_mm.back() - t.margin_mm,
         t.allowed_mm.back(), "mm",
         fmt::format("{} of {} is {} mm outside its limits even with the path corrected",
                     t.id, t.of, readable(-t.margin_mm))});
  }
  if (result.conflicts.empty()) return false;
  result.status = PlanStatus::infeasible;
  result.cost_per_part = result.time_per_part_min = 0;
  result.profit_per_min.reset();
  result.certificate = {};
  result.certificate.reason =
      "no plan was found: the correction would have to be too large";
  return true;
}

ProcessPlan planned(const PartPlan& p) {
  ProcessPlan result;
  const auto work = assign(p);
  add_obstacles(p, work, result);
  if (!result.conflicts.empty()) {
    result.status = PlanStatus::infeasible;
    result.certificate.reason = "proved: no condition or tool changes the conflicts told";
    return result;
  }
  const auto a = best_attempt(p, work);
  std::vector<SolvedSetup> chosen;
  for (std::size_t s = 0; s < a.setups.size(); ++s) {
    result.setups.push_back(setup_plan(p, s, a.setups[s], result));
    chosen.push_back(a.setups[s].chosen);
  }
  if (!a.feasible) {
    result.status = PlanStatus::infeasible;
    result.certificate = no_certificate(a);
    explain(p, a, result);
    return result;
  }
  result.tolerances = tolerance_results(p, chosen);
  result.cost_per_part = a.total.cost;
  result.time_per_part_min = a.total.minutes;
  if (p.price) result.profit_per_min = (*p.price - a.total.cost) / a.total.minutes;
  result.certificate = total_certificate(a);
  if (add_missed(result)) return result;
  result.deviations = deviations(chosen);
  result.compensation = compensations(chosen);
  result.prices = prices(p, chosen);
  return result;
}

// From the deviation of a size that goes furthest to the one at its other end, as a share
// of it; both ends alike of what has no two ends.
double other_end(const part::Tolerance& t, const ToleranceResult& r) {
  if (t.kind != part::ToleranceKind::diameter) return -1;
  const double middle = (t.limits->upper_mm + t.limits->lower_mm) / 2;
  const double low = r.predicted_mm[0] - middle, high = r.predicted_mm[1] - middle;
  return std::abs(low) > std::abs(high) ? high / low : low / high;
}

// Sizes that fail at their other limit too are asked for what that takes, (2) of
// allowance.hpp, until all conform; past some rounds as if their errors had both signs.
ProcessPlan robust_plan(PartPlan p) {
  constexpr int kRounds = 4;
  constexpr double kConforms = 1e-6;
  auto result = planned(p);
  for (int round = 0; round <= kRounds && result.status == PlanStatus::ok; ++round) {
    bool all = true;
    for (std::size_t i = 0; i < result.tolerances.size(); ++i) {
      const auto& r = result.tolerances[i];
      if (r.P_conform >= p.conformance - kConforms) continue;
      all = false;
      p.other_ends[i] = round < kRounds ? other_end(p.drawing.tolerances[i], r) : -1;
    }
    if (all) break;
    result = planned(p);
  }
  if (result.status != PlanStatus::ok) return result;
  auto nominal = p;
  nominal.robust = false;
  const auto n = planned(nominal);
  if (n.status == PlanStatus::ok)
    result.robustness = Robustness{p.conformance, n.cost_per_part, n.time_per_part_min};
  return result;
}

// The corner of the convex hull of cost against time that a line through two of its
// corners cuts off, and those beyond; nothing cheaper by more than the certificates' gap.
void add_corners(const PartPlan& p, const Assignment& work, const ParetoPoint& slow,
                 const ParetoPoint& fast, std::vector<ParetoPoint>& all) {
  constexpr double kWorth = 2e-4;
  const double saved = slow.time_per_part_min - fast.time_per_part_min;
  const double minute = (fast.cost_per_part - slow.cost_per_part) / saved;
  if (!(saved > kWorth * fast.time_per_part_min && minute > 0) || all.size() >= p.pareto)
    return;
  const auto a = attempt(p, work, {p.machine_per_min + minute, 1});
  const ParetoPoint corner{a.total.cost, a.total.minutes, minute};
  const auto worth = [&](const ParetoPoint& x) {
    return x.cost_per_part + minute * x.time_per_part_min;
  };
  if (!a.feasible || !(worth(corner) < worth(slow) * (1 - kWorth))) return;
  all.push_back(corner);
  add_corners(p, work, slow, corner, all);
  add_corners(p, work, corner, fast, all);
}

// Of points with rising cost those on the hull: time falls, a minute gets ever dearer.
// The certificates' gap may leave a point beside it.
std::vector<ParetoPoint> hull(const std::vector<ParetoPoint>& rising) {
  std::vector<ParetoPoint> kept;
  const auto minute = [](const ParetoPoint& a, const ParetoPoint& b) {
    return (b.cost_per_part - a.cost_per_part) /
           (a.time_per_part_min - b.time_per_part_min);
  };
  for (const auto& x : rising) {
    if (!kept.empty() && !(x.time_per_part_min < kept.back().time_per_part_min)) continue;
    while (kept.size() > 1 &&
           minute(kept.end()[-2], kept.back()) >= minute(kept.back(), x))
      kept.pop_back();
    kept.push_back(x);
  }
  return kept;
}

std::vector<ParetoPoint> pareto(const PartPlan& p) {
  const auto work = assign(p);
  const auto cheapest = attempt(p, work, {p.machine_per_min, 1});
  const auto fastest = attempt(p, work, {1, 0});
  std::vector<ParetoPoint> all{{cheapest.total.cost, cheapest.total.minutes, 0},
                               {fastest.total.cost, fastest.total.minutes, {}}};
  add_corners(p, work, all[0], all[1], all);
  std::sort(all.begin(), all.end(), [](const ParetoPoint& a, const ParetoPoint& b) {
    return a.cost_per_part < b.cost_per_part;
  });
  return hull(all);
}

}  // namespace

ProcessPlan plan(const PartPlan& p) {
  auto result = p.robust ? robust_plan(p) : planned(p);
  if (p.pareto > 0 && result.status == PlanStatus::ok) result.pareto = pareto(p);
  return result;
}

}  // namespace turnwright::planning
