#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "../parts.hpp"
#include "turnwright/planning/plan.hpp"
#include "turnwright/planning/process_plan.hpp"

// Windows against `predict`, which knows nothing of how they are traced.
namespace turnwright::planning {
namespace {

struct At {
  double v = 0, f = 0;
};

// A plan and what becomes of it with other conditions of one operation.
class Planned {
 public:
  explicit Planned(nlohmann::json document)
      : document_(std::move(document)), plan_(planning::plan(part(document_))) {
    document_ = as_planned(document_, plan_);
  }
  const ProcessPlan& plan() const { return plan_; }

  struct Outcome {
    double cost = 0, worst = 0;  // of the operation; the least margin of any constraint
  };
  Outcome with(const std::string& id, const At& x) const {
    auto d = document_;
    for (auto& o : d["operations"])
      if (o["id"] == id) {
        o["conditions"]["vc_m_min"] = x.v;
        o["conditions"]["f_mm_rev"] = x.f;
      }
    const auto r = predict(part_to_predict(d));
    Outcome out{0, 1e9};
    for (const auto& s : r.setups)
      for (const auto& o : s.operations) {
        if (o.id == id) out.cost = o.cost;
        for (const auto& c : o.constraints) out.worst = std::min(out.worst, c.margin);
      }
    return out;
  }

 private:
  nlohmann::json document_;
  ProcessPlan plan_;
};

// Signed turns of the corners about a point: straight edges in logarithms.
bool inside(const OperatingWindow& w, const At& x) {
  double angle = 0;
  const std::size_t n = w.vc_m_min.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t l = (k + 1) % n;
    const double ax = std::log(w.vc_m_min[k] / x.v), ay = std::log(w.f_mm_rev[k] / x.f);
    const double bx = std::log(w.vc_m_min[l] / x.v), by = std::log(w.f_mm_rev[l] / x.f);
    angle += std::atan2(ax * by - ay * bx, ax * bx + ay * by);
  }
  return angle > 3;
}

At centre(const OperatingWindow& w) {
  double v = 0, f = 0;
  for (std::size_t k = 0; k < w.vc_m_min.size(); ++k) {
    v += std::log(w.vc_m_min[k]);
    f += std::log(w.f_mm_rev[k]);
  }
  const auto n = static_cast<double>(w.vc_m_min.size());
  return {std::exp(v / n), std::exp(f / n)};
}

class Windows : public testing::TestWithParam<const char*> {};

TEST_P(Windows, HoldWhatIsKeptAndNothingElse) {
  const std::string name = GetParam();
  const Planned p(name == "pin" ? pin() : nominal(reference_part(name)));
  ASSERT_EQ(p.plan().status, PlanStatus::ok);
  std::mt19937 seed(5);
  std::uniform_real_distribution<double> unit(0, 1);
  std::set<std::string> seen;
  int in = 0, out = 0, refused = 0;
  for (const auto& s : p.plan().setups)
    for (const auto& o : s.operations) {
      EXPECT_EQ(o.window.has_value(), o.kind != OperationKind::fixed) << o.id;
      if (!o.window) continue;
      const auto& w = *o.window;
      const std::size_t n = w.vc_m_min.size();
      ASSERT_EQ(w.f_mm_rev.size(), n);
      ASSERT_EQ(w.limits.size(), n);
      for (const auto& l : w.limits) seen.insert(l);
      const double most = o.cost * (1 + w.percent / 100);
      const auto kept = [&](const At& x) {
        const auto r = p.with(o.id, x);
        return r.worst >= -1e-9 && r.cost <= most * (1 + 1e-9);
      };
      for (std::size_t k = 0; k < n; k += 1 + n / 12)
        EXPECT_TRUE(kept({w.vc_m_min[k], w.f_mm_rev[k]})) << o.id << " corner " << k;
      // Between two random corners and the middle: inside where the polygon is convex.
      for (int trial = 0; trial < 8; ++trial) {
        const auto k = static_cast<std::size_t>(unit(seed) * static_cast<double>(n));
        const auto l = static_cast<std::size_t>(unit(seed) * static_cast<double>(n));
        const double t = unit(seed);
        const At x{w.vc_m_min[k] * std::pow(w.vc_m_min[l] / w.vc_m_min[k], t),
                   w.f_mm_rev[k] * std::pow(w.f_mm_rev[l] / w.f_mm_rev[k], t)};
        if (!inside(w, x)) continue;
        ++in;
        EXPECT_TRUE(kept(x)) << o.id << ' ' << x.v << ' ' << x.f;
      }
      // Beyond the middle of an edge, 0.3 % away from the centre.
      const At c = centre(w);
      for (std::size_t k = 0; k < n; k += 1 + n / 8) {
        const std::size_t l = (k + 1) % n;
        const double v = std::sqrt(w.vc_m_min[k] * w.vc_m_min[l]);
        const double f = std::sqrt(w.f_mm_rev[k] * w.f_mm_rev[l]);
        EXPECT_TRUE(kept({v, f})) << o.id << " edge " << k;
        const double far = std::hypot(std::log(v / c.v), std::log(f / c.f));
        const double beyond = 1 + 0.003 / far;
        const At x{c.v * std::pow(v / c.v, beyond), c.f * std::pow(f / c.f, beyond)};
        if (inside(w, x)) continue;
        ++out;
        refused += !kept(x);
      }
    }
  EXPECT_GT(in, 20);
  EXPECT_GT(out, 20);
  EXPECT_EQ(refused, out);
  EXPECT_GT(seen.size(), 3u);
}

INSTANTIATE_TEST_SUITE_P(Parts, Windows,
                         testing::Values("pin", "piston-rod", "flanged-bush"));

TEST(Window, GoesAsFarAsItIsAsked) {
  auto d = pin();
  const auto area = [&](double percent) {
    d["window_percent"] = percent;
    const auto r = plan(part(d));
    const auto& w = *r.setups[0].operations.back().window;
    EXPECT_EQ(w.percent, percent);
    double sum = 0;
    for (std::size_t k = 0; k < w.vc_m_min.size(); ++k) {
      const std::size_t l = (k + 1) % w.vc_m_min.size();
      sum += std::log(w.vc_m_min[k]) * std::log(w.f_mm_rev[l]) -
             std::log(w.vc_m_min[l]) * std::log(w.f_mm_rev[k]);
    }
    return sum / 2;
  };
  const double five = area(5), ten = area(10);
  EXPECT_GT(five, 0);
  EXPECT_GT(ten, 1.2 * five);
}

TEST(Window, GivenSpeedOrFeedHasNone) {
  auto d = pin();
  d["operations"] = {{{"id", "f"}, {"setup", 0}, {"kind", "face"}, {"on", {"right"}}},
                     {{"id", "e"},
                      {"setup", 0},
                      {"kind", "finish"},
                      {"on", {"d2"}},
                      {"conditions", {{"vc_m_min", 200}}}},
                     {{"id", "g"}, {"setup", 1}, {"kind", "face"}, {"on", {"left"}}},
                     {{"id", "h"}, {"setup", 1}, {"kind", "finish"}, {"on", {"d1"}}}};
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  for (const auto& s : r.setups)
    for (const auto& o : s.operations) EXPECT_EQ(o.window.has_value(), o.id != "e");
  for (const auto& s : predict(part_to_predict(as_planned(d, r))).setups)
    for (const auto& o : s.operations) EXPECT_FALSE(o.window);
}

}  // namespace
}  // namespace turnwright::planning
