// Which setup makes which surface: what is found once for all grips against its definition,
// element by element.
#include "planning/preparation/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stop_token>

#include "../parts.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/paths/pass_lengths.hpp"
#include "planning/values/surface_request.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;
using part::End;

double one_of(std::initializer_list<double> values, std::mt19937_64& draw) {
  return values.begin()[draw() % values.size()];
}

// Cylinders, cones and threads in any order, bores from both ends, in three setups.
json random_document(std::mt19937_64& draw) {
  json outer = json::array(), inner = json::array(), setups = json::array();
  double length = 0;
  const auto id = [](const char* kind, std::size_t i) {
    return kind + std::to_string(i);
  };
  for (std::size_t i = 0, n = 2 + draw() % 7; i < n; ++i) {
    const double l = one_of({3, 6.1, 12.7}, draw), d = one_of({30, 36, 42}, draw);
    json e = {{"id", id("d", i)}, {"length_mm", l}};
    if (draw() % 4 == 0)
      e.update({{"kind", "cone"}, {"left_mm", d}, {"right_mm", one_of({30, 36}, draw)}});
    else if (draw() % 5 == 0)
      e.update({{"kind", "thread"}, {"designation", "M36x1.5"}, {"fit", "6g"}});
    else
      e.update({{"kind", "cylinder"}, {"diameter_mm", d}});
    if (e["kind"] == "cone" && e["left_mm"] == e["right_mm"]) e["left_mm"] = 42;
    if (e["kind"] == "cylinder" && draw() % 2 == 0) e["fit"] = "h7";
    outer.push_back(e);
    length += l;
  }
  for (std::size_t i = 0, n = draw() % 4; i < n; ++i)
    inner.push_back({{"id", id("b", i)},
                     {"kind", "cylinder"},
                     {"from", draw() % 2 == 0 ? "left" : "right"},
                     {"length_mm", length / 8},
                     {"diameter_mm", one_of({14, 16, 18}, draw)}});
  for (int s = 0; s < 3; ++s) {
    setups.push_back({{"hold", draw() % 2 == 0 ? "left" : "right"}});
    if (draw() % 4 > 0) setups.back()["clampings"] = {"chuck"};
  }
  json d = {{"material", "C45"},
            {"machine", "lathe-medium"},
            {"stock",
             {{"kind", "bar"},
              {"diameter_mm", 45},
              {"length_mm", length + 4},
              {"left_allowance_mm", 2}}},
            {"outer", outer},
            {"setups", setups}};
  if (!inner.empty()) d["inner"] = inner;
  return d;
}

// Some have a valley that could only be a groove, which the reader refuses.
PreparedPart random_part(std::mt19937_64& draw) {
  for (;;) try {
      return part(random_document(draw));
    } catch (const InputError&) {
    }
}

// Whether an element lies outside the jaws, widens towards them, and nothing between it and
// the free end is larger.
bool reachable(const PreparedPart& p, std::size_t s, std::size_t i) {
  const auto& e = p.drawing.outer;
  const double z0 = part::left_z_mm(p.drawing, i), z1 = z0 + e[i].length_mm;
  const bool left = holds_left(p, s);
  if (left ? z0 < jaws_z_mm(p, s) - 1e-9 : z1 > jaws_z_mm(p, s) + 1e-9) return false;
  const double outward = left ? e[i].right_mm : e[i].left_mm;
  if (outward > (left ? e[i].left_mm : e[i].right_mm)) return false;
  for (std::size_t k = left ? i + 1 : 0; k < (left ? e.size() : i); ++k)
    if (std::max(e[k].left_mm, e[k].right_mm) > outward + 1e-9) return false;
  return true;
}

BeforeJaws before_jaws(const PreparedPart& p, std::size_t s, std::size_t i) {
  const auto& clampings = p.setups[s].clampings;
  if (p.drawing.outer[i].cut ||
      std::ranges::find(clampings, Clamping::between_centres) != clampings.end())
    return {};
  const auto around = surroundings(p, s, Clamping::chuck, {}, {false, i});
  double corner_mm = INFINITY;
  for (const auto* t : tools_for(p, catalogue::ToolUse::finishing))
    corner_mm = std::min(corner_mm, t->re_mm);
  if (const auto level = around.level_behind) {
    bool made = false;
    for (std::size_t t = 0; t < s; ++t) made = made || reachable(p, t, *level);
    if (!made) return {};
  }
  return {needed_beyond_mm(around, corner_mm), around.z1 - around.root_z};
}

// It opens to the free end and is not wider inside, nor are those before it narrower.
bool bore_reachable(const PreparedPart& p, std::size_t s, std::size_t i) {
  const auto& all = p.drawing.inner;
  const auto& e = all[i];
  if (e.from == p.setups[s].hold) return false;
  for (std::size_t k = 0; k < i; ++k)
    if (all[k].from == e.from && all[k].left_mm < e.left_mm - 1e-9) return false;
  return true;
}

TEST(Reach, WhatIsFoundOnceForAllGripsIsWhatEachSetupReaches) {
  std::mt19937_64 draw(1);
  std::size_t reached = 0, beside = 0, opened = 0;
  for (int n = 0; n < 60; ++n) {
    auto p = random_part(draw);
    const Ways ways(p);
    for (int again = 0; again < 3; ++again) {
      for (double& grip : p.grips_mm) grip = one_of({5, 9.3, 15, 21.2}, draw);
      const Reach reach(p, ways);
      for (std::size_t s = 0; s < p.setups.size(); ++s) {
        for (std::size_t i = 0; i < p.drawing.outer.size(); ++i) {
          EXPECT_EQ(reach.outer(s, i), reachable(p, s, i)) << n;
          const auto room = reach.before_jaws(s, i), expected = before_jaws(p, s, i);
          EXPECT_EQ(room.needed_mm, expected.needed_mm) << n;
          EXPECT_EQ(room.left_mm, expected.left_mm) << n;
          reached += reach.outer(s, i);
          beside += !room.enough();
        }
        for (std::size_t i = 0; i < p.drawing.inner.size(); ++i) {
          EXPECT_EQ(reach.bore(s, i), bore_reachable(p, s, i)) << n;
          opened += reach.bore(s, i);
        }
      }
      const auto work = assign(p, ways);
      EXPECT_EQ(work, assign(p));
      EXPECT_EQ(left_out(p, ways), work.unreachable.size());
    }
  }
  EXPECT_GT(reached, 300u);
  EXPECT_GT(beside, 100u);
  EXPECT_GT(opened, 50u);
}

TEST(Reach, TheSurroundingsOfAllElementsAreThoseOfEach) {
  std::mt19937_64 draw(2);
  for (int n = 0; n < 30; ++n) {
    const auto p = random_part(draw);
    for (std::size_t s = 0; s < p.setups.size(); ++s) {
      const auto all = outer_surroundings(p, s, Clamping::chuck, p.work.setups[s]);
      ASSERT_EQ(all.size(), p.drawing.outer.size());
      for (std::size_t i = 0; i < all.size(); ++i) {
        const auto one =
            surroundings(p, s, Clamping::chuck, p.work.setups[s], {false, i});
        EXPECT_EQ(all[i].z0, one.z0);
        EXPECT_EQ(all[i].z1, one.z1);
        EXPECT_EQ(all[i].root_z, one.root_z);
        EXPECT_EQ(all[i].wall_z, one.wall_z);
        EXPECT_EQ(all[i].touch_z, one.touch_z);
        EXPECT_EQ(all[i].level_behind, one.level_behind);
      }
    }
  }
}

// A finishing tool's corner of 0.4 mm passes the end of a cylinder behind which nothing
// stands; between centres no jaws are in its way.
TEST(Reach, BetweenCentresNoJawsAreInTheWay) {
  auto d = pin();
  d["setups"][1] = {{"hold", "right"}, {"clampings", {"between-centres"}}};
  const auto p = part(d);
  const Ways ways(p);
  const Reach reach(p, ways);
  EXPECT_NEAR(reach.before_jaws(0, 0).needed_mm, 0.4, 1e-12);
  EXPECT_EQ(reach.before_jaws(1, 0).needed_mm, 0);
  EXPECT_TRUE(reach.before_jaws(1, 0).enough());
}

TEST(Reach, ACancelledPreparationIsLeft) {
  const PlanRequest request = part(pin());
  std::stop_source stop;
  const auto token = stop.get_token();
  const Listening listening(token);
  EXPECT_NO_THROW(prepare(request));
  stop.request_stop();
  EXPECT_THROW(prepare(request), Cancelled);
}

}  // namespace
}  // namespace turnwright::planning
