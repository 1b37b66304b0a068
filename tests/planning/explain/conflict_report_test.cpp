#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <set>

#include "../parts.hpp"
#include "planning/limits/relaxation.hpp"
#include "planning/values/readable.hpp"
#include "turnwright/planning/plan.hpp"
#include "turnwright/planning/process_plan.hpp"

/// Over-constrained parts, judged by planning documents that were changed as a reader
/// would change them: nothing of the explanation is used to check it.
namespace turnwright::planning {
namespace {

using nlohmann::json;

json source_document(const std::string& folder, const std::string& id) {
  return file(folder + "/" + id + ".json");
}

constexpr double kEnough = 50;  // times what a machine or tool bears: no limit any more

// The one limit no document can open at will, so it travels beside: how many times as
// much chatter the part may bear.
constexpr const char* kChatter = "chatter stiffness";

ProcessPlan certified_plan(json d) {
  const double times = d.value(kChatter, 1.0);
  d.erase(kChatter);
  auto p = part(d);
  p.chatter_times = times;
  return plan(p);
}
bool feasible(const json& d) { return certified_plan(d).status == PlanStatus::ok; }

// Machine and tools in place of their ids, so that they can be changed.
json inlined(json d) {
  d["machine"] = source_document("machines", d["machine"]);
  for (auto& t : d["tools"]) t = source_document("tools", t);
  return d;
}

json* element(json& d, const std::string& id) {
  for (const char* list : {"outer", "inner", "faces"})
    if (d.contains(list))
      for (auto& e : d[list])
        if (e["id"] == id) return &e;
  return nullptr;
}

std::string surface_in(const std::string& where) {
  return where.substr(where.rfind(", ") + 2);
}

// The width of a tolerance that was given as limits, about their middle.
void open_limits(json& e, double width) {
  const double middle = (e[0].get<double>() + e[1].get<double>()) / 2;
  e = {middle - width / 2, middle + width / 2};
}

void scale_machine(json& d, const std::string& limit, double factor) {
  auto& m = d["machine"];
  if (limit == kChatter)
    d[kChatter] = d.value(kChatter, 1.0) * factor;
  else if (limit == "power" || limit == "torque")
    for (auto& c : m["spindle"]["curve"]) {
      c["P_kW"] = c["P_kW"].get<double>() * factor;
      c["M_Nm"] = c["M_Nm"].get<double>() * factor;
    }
  else if (limit == "feed force")
    m["feed"]["feed_force_max_N"] = m["feed"]["feed_force_max_N"].get<double>() * factor;
  else if (limit == "grip of the chuck")
    m["chuck"]["grip_force_N"] = m["chuck"]["grip_force_N"].get<double>() * factor;
  else if (limit == "cutting force")
    for (auto& t : d["tools"])
      t["strength"]["Fc_max_N"] = t["strength"]["Fc_max_N"].get<double>() * factor;
  else if (limit == "least tool life")
    for (auto& t : d["tools"])
      t["life"]["T_min"][0] = t["life"]["T_min"][0].get<double>() / factor;
  else
    FAIL() << "no way to change " << limit;
}

// The part with one limit opened to a value, or without it.
struct Change {
  std::string limit, surface;
  double now = 0;
  std::optional<double> to;
};
json changed(json d, const Change& c) {
  const auto id = c.limit.substr(0, c.limit.find(' '));
  const auto size = id.find(":diameter");
  if (size != std::string::npos) {
    open_limits((*element(d, id.substr(0, size)))["limits_mm"], c.to.value_or(1));
    return d;
  }
  for (std::size_t i = 0; d.contains("tolerances") && i < d["tolerances"].size(); ++i) {
    auto& t = d["tolerances"][i];
    if (t["id"] != id) continue;
    if (!c.to)
      d["tolerances"].erase(i);
    else if (t.contains("limits_mm"))
      open_limits(t["limits_mm"], *c.to);
    else
      t["value_mm"] = *c.to;
    return d;
  }
  if (c.limit.rfind("roughness ", 0) == 0) {
    auto& e = *element(d, c.surface);
    const auto key = c.limit.substr(10, 2) + "_um";
    if (c.to)
      e[key] = *c.to;
    else
      e.erase(key);
    return d;
  }
  if (id == "left:flatness" || id == "right:flatness") ADD_FAILURE() << c.limit;
  scale_machine(d, c.limit, c.to ? std::max(*c.to / c.now, c.now / *c.to) : kEnough);
  return d;
}

Change removal(const Conflict& c) {
  return {c.limit, surface_in(c.where), c.allowed, {}};
}
Change opening(const Relaxation& r) {
  const auto of = r.limit.rfind(" of ");
  const bool machine = r.limit == "grip of the chuck";
  return {machine || of == std::string::npos ? r.limit : r.limit.substr(0, of),
          machine || of == std::string::npos ? "" : r.limit.substr(of + 4), r.now,
          r.needed};
}

// Only some of the conflicts' limits; what the drawing asks and is in no set goes, and
// what the machine and the tools bear is more than enough unless it is among them.
json only(const json& d, const std::vector<Conflict>& kept) {
  const auto is_kept = [&](const std::string& id, const std::string& surface) {
    for (const auto& c : kept)
      if (c.limit.substr(0, id.size()) == id &&
          (surface.empty() || surface_in(c.where) == surface))
        return true;
    return false;
  };
  json out = d;
  auto tolerances = json::array();
  for (const auto& t : d["tolerances"])
    if (is_kept(t["id"].get<std::string>() + " ", "")) tolerances.push_back(t);
  out["tolerances"] = tolerances;
  for (const char* list : {"outer", "inner", "faces"})
    if (out.contains(list))
      for (auto& e : out[list]) {
        const std::string id = e["id"];
        if (e.contains("limits_mm") && !is_kept(id + ":diameter ", ""))
          e["limits_mm"] = {-0.5, 0.5};
        if (e.contains("Ra_um") && !is_kept("roughness Ra", id)) e.erase("Ra_um");
      }
  for (const char* limit : {kChatter, "power", "feed force", "cutting force",
                            "least tool life", "grip of the chuck"})
    if (!is_kept(limit, "")) scale_machine(out, limit, kEnough);
  return out;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  int whole(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<unsigned>(high - low + 1));
  }
  bool one_in(int n) { return whole(1, n) == 1; }

 private:
  std::mt19937 engine_;
};

double rounded(double x, double digit) { return std::round(x / digit) * digit; }

// A stepped shaft, or a tube, whose smaller end stands out of the jaws, with two or three
// tolerances of which some ask for microns.
json random_part(unsigned seed) {
  Random r(seed);
  const char* machines[] = {"lathe-small", "lathe-medium", "lathe-heavy"};
  const char* materials[] = {"C45", "42CrMo4-QT", "16MnCr5"};
  const bool tube = r.one_in(4);
  const double D = tube ? rounded(r.between(40, 70), 1) : rounded(r.between(16, 50), 1);
  const int steps = r.whole(1, 2);
  json d{{"format", "turnwright-part/1"},
         {"material", materials[r.whole(0, 2)]},
         {"machine", machines[tube || D > 30 ? r.whole(1, 2) : r.whole(0, 1)]},
         {"tools",
          {"PCLNL-CNMG120408-PM",
           r.one_in(2) ? "PDJNL-DNMG150604-PF" : "SVJBL-VBMT160404-PF"}},
         {"machine_share_um", r.whole(0, 1)}};
  const double held = rounded(r.between(20, 40), 1);
  double length = held, d_mm = D;
  d["outer"] = {{{"id", "d1"},
                 {"kind", "cylinder"},
                 {"length_mm", held},
                 {"diameter_mm", D - 1},
                 {"limits_mm", {-0.3, 0.3}}}};
  for (int k = 0; k < steps; ++k) {
    d_mm -= rounded(r.between(2, 5), 0.5);
    const double l = rounded(r.between(1, 5) * d_mm / steps, 1);
    length += l;
    json e{{"id", "d" + std::to_string(k + 2)},
           {"kind", "cylinder"},
           {"length_mm", l},
           {"diameter_mm", d_mm}};
    const double half = std::pow(10, r.between(-3, -1.3));
    e["limits_mm"] = {rounded(-half, 1e-5), rounded(half, 1e-5)};
    if (r.one_in(2)) e["Ra_um"] = rounded(std::pow(10, r.between(-1.2, 0.5)), 0.01);
    d["outer"].push_back(e);
  }
  d["stock"] = {{"kind", tube ? "tube" : "bar"}, {"length_mm", length}};
  if (tube) {
    d["stock"]["outer_mm"] = D;
    d["stock"]["inner_mm"] = rounded(d_mm * r.between(0.3, 0.5), 1);
  } else {
    d["stock"]["diameter_mm"] = D;
  }
  const char* kinds[] = {"cylindricity", "straightness", "total-radial-runout",
                         "profile"};
  d["tolerances"] = json::array();
  const auto last = "d" + std::to_string(steps + 1);
  for (int k = 0; k < 2; ++k) {
    const std::string kind = kinds[r.whole(0, 3)];
    json t{{"id", "t" + std::to_string(k)},
           {"kind", kind},
           {"of", r.one_in(3) ? "d2" : last},
           {"value_mm", rounded(std::pow(10, r.between(-3, -1.7)), 1e-5)}};
    if (kind == "total-radial-runout") t["datum"] = "d1";
    d["tolerances"].push_back(t);
  }
  json clampings = json::array();
  for (const char* c : {"chuck", "chuck-tailstock", "between-centres"})
    if (r.one_in(2)) clampings.push_back(c);
  if (clampings.empty()) clampings.push_back("chuck");
  d["setups"] = {{{"hold", "left"}, {"grip_mm", held}, {"clampings", clampings}},
                 {{"hold", "right"},
                  {"grip_mm", rounded(std::min(length - held, d_mm) * 0.9, 1)},
                  {"clampings", {"chuck"}}}};
  d = inlined(d);
  d["machine"]["chuck"]["diameter_mm"] = {3, 400};  // jaws that hold every part
  d["machine"]["live_centre"] = {{"point_mm", 1},
                                 {"point_length_mm", 900},
                                 {"body_mm", 1},
                                 {"uncertainty_pct", 0},
                                 {"source", "a centre that no tool meets"}};
  return d;
}

struct OverConstrainedPart {
  json document;
  ProcessPlan plan;
};

// The same, closer and closer until nothing can make it.
OverConstrainedPart over_constrained(unsigned seed) {
  OverConstrainedPart p{random_part(seed), {}};
  for (;;) {
    p.plan = certified_plan(p.document);
    if (p.plan.status == PlanStatus::infeasible) return p;
    for (auto& t : p.document["tolerances"])
      t["value_mm"] = t["value_mm"].get<double>() / 2;
    for (auto& e : p.document["outer"]) {
      auto& limits = e["limits_mm"];
      if (e["id"] != "d1")
        open_limits(limits, (limits[1].get<double>() - limits[0].get<double>()) / 2);
    }
  }
}

std::map<std::size_t, std::vector<Conflict>> sets_of(const ProcessPlan& r) {
  std::map<std::size_t, std::vector<Conflict>> sets;
  for (const auto& c : r.conflicts) sets[c.set].push_back(c);
  return sets;
}

std::vector<Conflict> less(std::vector<Conflict> set, std::size_t i) {
  set.erase(set.begin() + static_cast<long>(i));
  return set;
}

void expect_irreducible(const json& d, const std::vector<Conflict>& set) {
  EXPECT_FALSE(feasible(only(d, set))) << only(d, set).dump();
  for (std::size_t i = 0; i < set.size(); ++i)
    EXPECT_TRUE(feasible(only(d, less(set, i)))) << "without " << set[i].sentence;
}

// One of every set, whichever.
void expect_resolving(const json& d, const ProcessPlan& r) {
  std::map<std::size_t, std::vector<Relaxation>> of_set;
  for (const auto& x : r.relax) of_set[x.set].push_back(x);
  ASSERT_EQ(of_set.size(), sets_of(r).size()) << d.dump();
  json all = d;
  for (const auto& [set, choices] : of_set) {
    all = changed(all, opening(choices.front()));
    for (std::size_t i = 1; i < choices.size(); ++i) {
      json other = changed(d, opening(choices[i]));
      for (const auto& [k, first] : of_set)
        if (k != set) other = changed(other, opening(first.front()));
      EXPECT_TRUE(feasible(other)) << choices[i].sentence;
    }
  }
  EXPECT_TRUE(feasible(all)) << all.dump();
}

// A size that the machine alone uses up conflicts alone, whatever else is asked.
TEST(Conflicts, ASizeTheMachineUsesUpStandsAlone) {
  auto d = nominal(reference_part("drilled-bush"));
  d["machine"] = "lathe-worn";
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::infeasible);
  std::map<std::size_t, std::set<std::string>> sets;
  for (const auto& c : r.conflicts) sets[c.set].insert(c.limit);
  EXPECT_EQ(sets, (std::map<std::size_t, std::set<std::string>>{
                      {1, {"d2:diameter diameter"}}, {2, {"b1:diameter diameter"}}}));
  EXPECT_EQ(r.relax.size(), 2u);
}

TEST(Conflicts, ALimitFarOutOfReachIsToldWithWhatIsInReach) {
  auto d = reference_part("coupling-shaft");
  d["outer"][0]["Ra_um"] = 1e-6;
  const auto r = plan(part(d));
  ASSERT_EQ(r.relax.size(), 1u);
  d["outer"][0]["Ra_um"] = r.relax[0].needed;
  EXPECT_EQ(plan(part(d)).status, PlanStatus::ok);
}

// Jaws grip harder where a tolerance is wider, so what the cut alone needs is not enough.
TEST(Conflicts, AToleranceThatSetsTheJawsForceIsToldAsFarAsItHasToOpen) {
  auto d = reference_part("aluminium-tube");
  d["machine_share_um"] = 0;
  auto& value = d["tolerances"][0]["value_mm"];
  value = 0.001;
  const auto r = plan(part(d));
  ASSERT_EQ(r.relax.size(), 1u);
  EXPECT_EQ(r.relax[0].limit, "t1 cylindricity of b1");
  value = r.relax[0].needed;
  EXPECT_EQ(plan(part(d)).status, PlanStatus::ok);
  value = 0.98 * r.relax[0].needed;
  EXPECT_EQ(plan(part(d)).status, PlanStatus::infeasible);
}

// Window of the tool, speeds of the machine, roughness of the drawing, as their files have
// them.
TEST(Conflicts, LimitsAreToldByNameWithWhatTheyAre) {
  using enum Check;
  auto d = pin();
  d["tools"] = {"PDJNL-DNMG150604-PF"};
  d["outer"][0]["Rz_um"] = 25;
  const auto p = prepare(part(d));
  const auto told = [&](Check check, std::size_t owner = 0) {
    const auto n = value_of(p, {&limit_row(check), owner});
    return fmt::format("{} {} {:g} {}", n.name, n.at_most ? "<=" : ">=", n.now, n.unit);
  };
  EXPECT_EQ(told(depth_min), "least depth of cut >= 0.25 mm");
  EXPECT_EQ(told(depth_max), "largest depth of cut <= 1.5 mm");
  EXPECT_EQ(told(feed_min), "least feed >= 0.06 mm/rev");
  EXPECT_EQ(told(feed_max), "largest feed <= 0.3 mm/rev");
  EXPECT_EQ(told(vc_min), "least cutting speed >= 20 m/min");
  EXPECT_EQ(told(vc_max), "largest cutting speed <= 500 m/min");
  EXPECT_EQ(told(spindle_min), "least spindle speed >= 40 1/min");
  EXPECT_EQ(told(spindle_max), "largest spindle speed <= 4500 1/min");
  EXPECT_EQ(told(Ra, 1), "roughness Ra <= 3.2 um");
  EXPECT_EQ(told(Rz, 0), "roughness Rz <= 25 um");
}

// By (3) of docs/planning-chatter.md what is stable grows with zeta (1 + zeta), so what is told
// of chatter can be had by damping.
TEST(Conflicts, ChatterIsToldInTimesOfWhatIsStable) {
  constexpr double kLittle = 0.0005;
  json d = pin();
  d["damping_ratio"] = kLittle;
  const auto r = certified_plan(d);
  ASSERT_EQ(r.conflicts.size(), 1u);
  EXPECT_NE(r.conflicts[0].sentence.find("times what is stable at best"),
            std::string::npos)
      << r.conflicts[0].sentence;
  ASSERT_EQ(r.relax.size(), 1u);
  const double times = r.relax[0].needed;
  EXPECT_EQ(
      r.relax[0].sentence,
      fmt::format("to keep chatter stiffness, stiffness or damping would have to be {} "
                  "times as large",
                  readable(times)));
  const auto damped = [&](double by) {
    const double product = by * kLittle * (1 + kLittle);
    d["damping_ratio"] = 2 * product / (1 + std::sqrt(1 + 4 * product));
    return feasible(d);
  };
  EXPECT_TRUE(damped(times));
  EXPECT_FALSE(damped(0.98 * times));
}

class MachineLimit : public testing::TestWithParam<std::pair<const char*, double>> {};

TEST_P(MachineLimit, OpensAsFarAsToldAndNoLess) {
  const auto [limit, factor] = GetParam();
  auto d = inlined(pin());
  scale_machine(d, limit, factor);
  const auto r = certified_plan(d);
  ASSERT_EQ(r.relax.size(), 1u) << d.dump();
  auto c = opening(r.relax[0]);
  EXPECT_EQ(c.limit, limit);
  EXPECT_TRUE(feasible(changed(d, c)));
  c.to = *c.to * (*c.to > c.now ? 0.98 : 1.02);
  EXPECT_FALSE(feasible(changed(d, c)));
}

INSTANTIATE_TEST_SUITE_P(Conflicts, MachineLimit,
                         testing::Values(std::pair{"power", 0.01},
                                         std::pair{"feed force", 0.01},
                                         std::pair{"cutting force", 0.01},
                                         std::pair{"least tool life", 1e-4},
                                         std::pair{"grip of the chuck", 0.01}));

// Jaws that close with less than the chuck for a hollow part's sake: their force counts, and
// that more of it strains the part is said.
TEST(GripConflict, TellsTheForceOfTheJawsThatSpareTheHollowPart) {
  auto d = inlined(pin());
  d["stock"] = {{"kind", "tube"}, {"outer_mm", 46}, {"inner_mm", 10}, {"length_mm", 94}};
  d["outer"][1]["diameter_mm"] = 14;
  d["machine"]["chuck"]["friction"] = 0.08;
  const auto p = part(d);
  const auto r = certified_plan(d);
  ASSERT_TRUE(p.jaws[1].spares_tube);
  ASSERT_EQ(r.status, PlanStatus::infeasible);
  ASSERT_EQ(r.conflicts.at(0).limit, "grip of the chuck");
  EXPECT_EQ(r.conflicts[0].allowed, p.jaws[1].roughing_N);
  ASSERT_EQ(r.relax.size(), 1u);
  EXPECT_NE(r.relax[0].sentence.find("strains the hollow part"), std::string::npos);
  // With that force on a part that bears it it is feasible.
  const auto with = [&](double force_N) {
    auto q = part(d);
    q.jaws[1].roughing_N = q.jaws[1].finishing_N = force_N;
    return plan(q).status == PlanStatus::ok;
  };
  EXPECT_TRUE(with(r.relax[0].needed));
  EXPECT_FALSE(with(r.relax[0].now));
}

// A shoulder between bores is faced for its tolerances alone; without a bar that is what is
// told of it, once, and not that its tolerances would come to their limits.
TEST(NoTool, OfAShoulderBetweenBoresIsToldInPlaceOfItsTolerances) {
  auto d = pin();
  d["stock"] = {{"kind", "tube"}, {"outer_mm", 42}, {"inner_mm", 10}, {"length_mm", 92}};
  d["inner"] = json::parse(R"([
    {"id": "b1", "kind": "cylinder", "from": "right", "length_mm": 12, "diameter_mm": 18},
    {"id": "b2", "kind": "cylinder", "from": "right", "length_mm": 78, "diameter_mm": 12}])");
  d["tolerances"] = json::parse(R"([
    {"id": "t1", "kind": "flatness", "of": "b1|b2", "value_mm": 0.02},
    {"id": "t2", "kind": "length", "between": ["right", "b1|b2"], "limits_mm": [0, 0.1]}])");
  const auto r = plan(part(d));
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  std::string told;
  for (const auto& c : r.conflicts) told += c.sentence + "\n";
  EXPECT_EQ(told,
            "b1: none of the tools for boring has a grade for C45\n"
            "b2: none of the tools for boring has a grade for C45\n"
            "b1|b2: none of the tools for boring has a grade for C45\n");
}

class OverConstrained : public testing::TestWithParam<unsigned> {};

TEST_P(OverConstrained, SetsAreIrreducibleAndWhatIsToldMakesThePartFeasible) {
  const auto [d, r] = over_constrained(GetParam());
  ASSERT_FALSE(r.conflicts.empty());
  json rest = d;
  for (const auto& [k, set] : sets_of(r)) {
    SCOPED_TRACE(set.front().sentence);
    ASSERT_GT(k, 0u) << d.dump();
    expect_irreducible(d, set);
    for (const auto& c : set) rest = changed(rest, removal(c));
  }
  EXPECT_TRUE(feasible(rest));
  expect_resolving(d, r);
}

INSTANTIATE_TEST_SUITE_P(Parts, OverConstrained, testing::Range(0u, 50u));

}  // namespace
}  // namespace turnwright::planning
