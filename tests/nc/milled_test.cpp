// Milled places: a cutter of the right diameter that goes where the program says takes a
// round bar down to the drawn floor, no more and no less, with the material on its right.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "check.hpp"
#include "plans.hpp"

namespace turnwright::nc {
namespace {

using namespace test;
using Kind = Move::Kind;

// The surface of a bar seen by the cutter, which comes down along X: heights over a grid of
// places beside the plane of the axis (y) and along it (z), in the program's coordinates.
class Bar {
 public:
  static constexpr double kGrid_mm = 0.2;

  Bar(double R, double low, double high) : R_(R), low_(low), columns_(cells(high - low)) {
    rows_ = cells(2 * R);
    h_.assign(static_cast<std::size_t>(rows_ * columns_), 0);
    for (int i = 0; i < rows_; ++i)
      for (int j = 0; j < columns_; ++j)
        at(i, j) = std::sqrt(std::max(0.0, R * R - y(i) * y(i)));
  }

  struct Taken {
    double right = 0, left = 0;  ///< area taken off beside the way
  };
  /// Moves a flat end of the diameter D; what it takes off on each side of its way.
  Taken move(const Move& a, const Move& b, double D) {
    Taken t;
    const double ly = b.y_mm - a.y_mm, lz = b.z_mm - a.z_mm;
    const double l = std::hypot(ly, lz), dx = b.x_mm - a.x_mm;
    const int n = 1 + static_cast<int>(std::hypot(l, dx) / (kGrid_mm / 2));
    for (int k = 0; k <= n; ++k) {
      const double u = static_cast<double>(k) / n, cy = a.y_mm + u * ly,
                   cz = a.z_mm + u * lz, x = a.x_mm + u * dx;
      under(cy, cz, D, [&](int i, int j) {
        if (at(i, j) <= x + 1e-9) return;
        at(i, j) = x;
        // With X towards the eye, Y to the right and Z up.
        const double side = (y(i) - cy) * lz - (z(j) - cz) * ly;
        (side > 0 ? t.right : t.left) += kGrid_mm * kGrid_mm;
      });
    }
    return t;
  }
  /// The highest surface below a flat end of the diameter D.
  double below(double cy, double cz, double D) {
    double most = 0;
    under(cy, cz, D, [&](int i, int j) { most = std::max(most, at(i, j)); });
    return most;
  }
  template <class Each>  // (y, z, height, height before)
  void each(Each e) const {
    for (int i = 0; i < rows_; ++i)
      for (int j = 0; j < columns_; ++j)
        e(y(i), z(j), at(i, j), std::sqrt(std::max(0.0, R_ * R_ - y(i) * y(i))));
  }

 private:
  static int cells(double l) { return static_cast<int>(std::ceil(l / kGrid_mm)); }
  double y(int i) const { return -R_ + (i + 0.5) * kGrid_mm; }
  double z(int j) const { return low_ + (j + 0.5) * kGrid_mm; }
  // The cells of which the middle is under a flat end.
  template <class Cell>
  void under(double cy, double cz, double D, Cell cell) {
    const auto first = [](double from) {
      return std::max(0, static_cast<int>(from / kGrid_mm));
    };
    for (int i = first(cy + R_ - D / 2); i < rows_ && y(i) < cy + D / 2; ++i)
      for (int j = first(cz - low_ - D / 2); j < columns_ && z(j) < cz + D / 2; ++j)
        if (std::hypot(y(i) - cy, z(j) - cz) < D / 2) cell(i, j);
  }
  double& at(int i, int j) { return h_[static_cast<std::size_t>(i * columns_ + j)]; }
  double at(int i, int j) const { return h_[static_cast<std::size_t>(i * columns_ + j)]; }

  double R_, low_;
  int rows_ = 0, columns_;
  std::vector<double> h_;
};

// A pin of 40 mm, 60 mm long, with an end of 30 mm and 12 mm away from the jaws, and one
// place of it, whose z_mm counts from the end in the jaws.
constexpr double kLength_mm = 72;
nlohmann::json pin(const std::string& hold, nlohmann::json place) {
  auto document = nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "pin", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 44, "length_mm": 134},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 60, "diameter_mm": 40},
              {"id": "d2", "kind": "cylinder", "length_mm": 12, "diameter_mm": 30}],
    "machine": "turn-mill",
    "tools": ["PCLNL-CNMG120408-PM", "PDJNL-DNMG150604-PF"],
    "setups": [{"grip_mm": 55, "clampings": ["chuck"]}]})");
  const bool left = hold == "left";
  document["stock"]["left_allowance_mm"] = left ? 60 : 2;
  document["setups"][0]["hold"] = hold;
  if (!left) {
    std::swap(document["outer"][0], document["outer"][1]);
    place["z_mm"] =
        kLength_mm - place["z_mm"].get<double>() - place["length_mm"].get<double>();
  }
  document["milling"] = {place};
  return document;
}

nlohmann::json keyway(double z, double w, const char* tool) {
  return {{"id", "m"},     {"kind", "keyway"}, {"on", "d1"},
          {"z_mm", z},     {"length_mm", 32},  {"width_mm", w},
          {"depth_mm", 4}, {"angle_deg", 30},  {"tool", tool}};
}
nlohmann::json slot(double z, double w, const char* tool) {
  auto all = keyway(z, w, tool);
  all["kind"] = "slot";
  all["depth_mm"] = 5;
  return all;
}
nlohmann::json flat(double z, double length, const char* tool, double depth = 2) {
  return {{"id", "m"},           {"kind", "flat"},    {"on", "d1"},       {"z_mm", z},
          {"length_mm", length}, {"depth_mm", depth}, {"angle_deg", 200}, {"tool", tool}};
}

struct Case {
  const char* name;
  const char* hold;
  nlohmann::json place;
};

std::vector<Case> cases() {
  return {{"keyway", "left", keyway(20, 8, "KEYWAY-HM-8")},
          {"keyway, other end", "right", keyway(20, 8, "KEYWAY-HM-8")},
          {"keyway wider than its cutter", "left", keyway(20, 10, "KEYWAY-HM-8")},
          {"the same, other end", "right", keyway(20, 10, "KEYWAY-HM-8")},
          {"slot open to the end", "left", slot(28, 8, "KEYWAY-HM-8")},
          {"slot open to the other end", "right", slot(28, 10, "KEYWAY-HM-8")},
          {"flat", "left", flat(20, 30, "ENDMILL-HM-10")},
          {"flat, other end", "right", flat(20, 30, "ENDMILL-HM-16")},
          {"open flat", "left", flat(40, 20, "ENDMILL-HM-10", 5)}};
}

struct Milled {
  const planning::OperationPlan* plan = nullptr;
  const Step* step = nullptr;
  SetupProgram program;
};

Milled milled(const Planned& p, const Programs& all) {
  Milled m;
  for (const auto& program : all.setups)
    for (const auto& step : program.steps)
      if (step.milling) {
        m.program = program;
        m.step = &step;
      }
  for (const auto& s : p.plan.setups)
    for (const auto& o : s.operations)
      if (o.milled) m.plan = &o;
  return m;
}

double cutter_mm(const Planned& p, const std::string& id) {
  return std::ranges::find(p.part.milled[0].cutters, id, &catalogue::MillingCutter::id)
      ->dc_mm;
}

TEST(MilledPlaces, AreMilledAsDrawnAndNothingElse) {
  for (const auto& c : cases()) {
    const auto& p = planned(pin(c.hold, c.place));
    ASSERT_EQ(p.plan.status, planning::PlanStatus::ok) << c.name;
    const auto all = programs(p.part, p.plan);
    const auto m = milled(p, all);
    ASSERT_TRUE(m.step) << c.name;
    const bool left = c.hold == std::string("left");
    const auto& place = p.part.milled[0];
    const double D = cutter_mm(p, m.plan->tool), R = 20, floor = R - place.depth_mm;
    // Zero of the program is the end away from the jaws, +Z away from them.
    const double z0 = left ? place.z_mm - kLength_mm : -place.z_mm - place.length_mm,
                 z1 = z0 + place.length_mm;
    const double low = -kLength_mm, high = -12;
    EXPECT_NEAR(m.step->milling->C_deg, left ? place.angle_deg : 360 - place.angle_deg,
                1e-9)
        << c.name;

    Bar bar(R, low, high);
    Move at{Kind::rapid, m.program.change_x_mm, m.program.change_z_mm};
    for (const auto& move : m.step->moves) {
      if (move.kind == Kind::rapid) {
        for (double u = 0; u <= 1; u += 0.125)
          EXPECT_LE(bar.below(std::lerp(at.y_mm, move.y_mm, u),
                              std::lerp(at.z_mm, move.z_mm, u), D),
                    std::lerp(at.x_mm, move.x_mm, u) + 1e-9)
              << c.name << ": a rapid in the material";
      } else {
        bar.move(at, move, D);
      }
      at = move;
    }
    // Within half a cell of its edge a place may be either.
    const double g = Bar::kGrid_mm;
    const bool flat = place.kind == planning::MilledKind::flat;
    const bool open_high = z1 > high - 1e-9, open_low = false;
    bar.each([&](double y, double z, double h, double before) {
      // How far inside the place, whose closed ends keep the cutter's round.
      double inside = std::min({place.width_mm / 2 - std::abs(y),
                                open_high ? 1e9 : z1 - z, open_low ? 1e9 : z - z0});
      const double r = D / 2, corner_y = place.width_mm / 2 - r;
      for (const double end : {open_high ? 1e9 : z1 - r - z, open_low ? 1e9 : z - z0 - r})
        if (end < 0 && std::abs(y) > corner_y)
          inside = std::min(inside, r - std::hypot(std::abs(y) - corner_y, end));
      // Each lane has a round of its own.
      if (flat && ((!open_high && z > z1 - r) || z < z0 + r)) return;
      const auto where = fmt::format("{} y {} z {}", c.name, y, z);
      if (inside > g) {
        EXPECT_NEAR(h, std::min(before, floor), 1e-9) << where;
      } else if (inside < -g) {
        EXPECT_NEAR(h, before, 1e-9) << where;
      }
    });
    if (testing::Test::HasFailure()) return;
  }
}

// Lanes and sides along Z; a first lane at full width has material on both sides, and the
// rounds of lanes at a closed end leave a little to the next one.
TEST(MilledPlaces, AreDownMilled) {
  for (const auto& c : cases()) {
    const auto& p = planned(pin(c.hold, c.place));
    const auto m = milled(p, programs(p.part, p.plan));
    ASSERT_TRUE(m.plan) << c.name;
    const double D = cutter_mm(p, m.plan->tool);
    const bool full = m.plan->milled->ae_mm > D - 1e-9;
    const auto all = programs(p.part, p.plan);
    const auto again = milled(p, all);
    Bar bar(20, -kLength_mm, -12);
    Move at{Kind::rapid, again.program.change_x_mm, again.program.change_z_mm};
    double right = 0;
    for (const auto& move : again.step->moves) {
      const bool along = at.z_mm != move.z_mm && move.kind == Kind::feed;
      const auto t = bar.move(at, move, D);
      if (along && (!full || move.y_mm != 0)) {
        EXPECT_LE(t.left, 0.1 * t.right + 2) << c.name;
        right += t.right;
      }
      at = move;
    }
    const bool has_sides = p.part.milled[0].width_mm > D + 1e-9;
    EXPECT_EQ(right > 10, has_sides) << c.name;
  }
}

// The plan's feed times lengths, and each layer's plunge at 0.3 of the feed; the way from 1
// mm above the bar is the program's alone.
TEST(MilledPlaces, TakeThePlansTime) {
  for (const auto& c : cases()) {
    const auto& p = planned(pin(c.hold, c.place));
    const auto all = programs(p.part, p.plan);
    const auto m = milled(p, all);
    ASSERT_TRUE(m.plan) << c.name;
    double fed = 0;
    Move at{};
    for (const auto& move : m.step->moves) {
      if (move.kind == Kind::feed)
        fed += std::hypot(move.x_mm - at.x_mm, move.y_mm - at.y_mm, move.z_mm - at.z_mm) /
               move.feed_share;
      at = move;
    }
    const double planned_mm = m.plan->time_min * m.plan->milled->vf_mm_min;
    const double above =
        (p.part.milled[0].kind == planning::MilledKind::keyway
             ? 1.0
             : static_cast<double>(m.plan->passes.size()) * m.plan->milled->lanes);
    const bool entered = p.part.milled[0].kind == planning::MilledKind::flat;
    EXPECT_NEAR(fed, planned_mm + above, entered ? 0.06 * planned_mm : 1e-6) << c.name;
    EXPECT_EQ(m.step->milling->f_mm_min, m.plan->milled->vf_mm_min);
    EXPECT_EQ(m.step->milling->n_rpm, m.plan->passes[0].n_rpm);
  }
}

nlohmann::json cross_hole(const nlohmann::json& own) {
  nlohmann::json place{{"id", "m"},
                       {"kind", "cross-hole"},
                       {"on", "d1"},
                       {"diameter_mm", 8},
                       {"depth_mm", 33},
                       {"angle_deg", 30},
                       {"tool", "DRILL-HSS-5D"}};
  place.update(own);
  return place;
}

// The pin with a hole, held at its left end.
nlohmann::json drilled_pin(const nlohmann::json& own) {
  auto document = pin("left", keyway(20, 8, "KEYWAY-HM-8"));
  document["tools"].push_back("DRILL-HSS-5D");
  document["milling"] = {cross_hole(own)};
  return document;
}

// A program of millions of moves would be no use, and more than memory holds.
TEST(MilledPlaces, OfMoreMovesThanAProgramHasAreNotProgrammed) {
  auto p = planned(pin("left", flat(20, 32, "ENDMILL-HM-12")));
  auto& o = p.plan.setups[0].operations.back();
  ASSERT_TRUE(o.milled);
  o.passes.assign(1000, o.passes.front());
  o.milled->lanes = 1000;
  const auto all = programs(p.part, p.plan);
  EXPECT_TRUE(all.setups.empty());
  ASSERT_EQ(all.cannot.size(), 1U);
  EXPECT_EQ(all.cannot[0], "setup 1: its program would have more than 200000 moves");
}

// The drill's tip stays on the part's axis; it goes deeper by feed alone, comes out after each
// peck, back to 0.5 mm before the depth it had, and takes the plan's time.
TEST(CrossHoles, AreDrilledInPecksAlongTheRadius) {
  const double point = 4 / std::tan(59 * 3.14159265358979 / 180), R = 20;
  const auto& p = planned(drilled_pin({{"at_mm", 40}}));
  ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
  const auto all = programs(p.part, p.plan);
  const Step* step = nullptr;
  for (const auto& s : all.setups.at(0).steps)
    if (s.milling) step = &s;
  ASSERT_TRUE(step);
  const auto& o = p.plan.setups[0].operations.back();
  ASSERT_EQ(o.kind, planning::OperationKind::cross_drill);
  EXPECT_NEAR(step->milling->C_deg, 30, 1e-9);
  EXPECT_EQ(step->milling->n_rpm, o.passes[0].n_rpm);
  EXPECT_FALSE(step->milling->needs_y);
  const double vf = o.passes[0].f_mm_rev * o.passes[0].n_rpm;
  EXPECT_NEAR(step->milling->f_mm_min, vf, 1e-9 * vf);

  double fed = 0, deepest = R, last = R;
  int feeds = 0;
  Move at{};
  for (const auto& move : step->moves) {
    if (move.kind == Kind::feed) {
      EXPECT_NEAR(move.z_mm, 40 - kLength_mm, 1e-9);
      EXPECT_EQ(move.z_mm, at.z_mm);
      EXPECT_EQ(move.y_mm, 0);
      EXPECT_LT(move.x_mm, deepest);
      fed += at.x_mm - move.x_mm;
      last = deepest;
      deepest = move.x_mm;
      ++feeds;
    } else if (at.z_mm == move.z_mm && move.x_mm < R && feeds > 0) {
      EXPECT_NEAR(move.x_mm, deepest + 0.5, 1e-9);  // back into the hole
    }
    at = move;
  }
  // 24 mm, then every 8 mm at most, of 35.4.
  EXPECT_EQ(feeds, 3);
  EXPECT_NEAR(deepest, R - 33 - point, 1e-9);
  EXPECT_NEAR(last, R - 24 - (33 + point - 24) / 2, 1e-9);
  EXPECT_NEAR(fed, o.time_min * vf + 1, 1e-6);  // from 1 mm above
  EXPECT_GT(at.x_mm, R);
}

TEST(CrossHoles, StayStopsWithoutAnAxisC) {
  auto p = planned(drilled_pin({{"at_mm", 40}}));
  p.part.machine.driven_tools->c_axis = false;
  const auto all = programs(p.part, p.plan);
  const auto& o = p.plan.setups[0].operations.back();
  const auto& step = all.setups.at(0).steps.back();
  EXPECT_TRUE(step.stop);
  EXPECT_FALSE(step.milling);
  ASSERT_EQ(step.comments.size(), 2U);
  EXPECT_EQ(step.comments[0],
            fmt::format("stop: not in this program: s1-drill-m with DRILL-HSS-5D 8 mm, "
                        "driven, {:.0f} 1/min, {:.4g} mm/min",
                        o.passes[0].n_rpm, o.passes[0].f_mm_rev * o.passes[0].n_rpm));
  EXPECT_EQ(step.comments[1], "no axis C");
}

// What the machine cannot do somebody does.
TEST(MilledPlaces, StayStopsWithoutTheAxes) {
  const auto stops = [](const Planned& p) {
    int n = 0;
    for (const auto& program : programs(p.part, p.plan).setups)
      for (const auto& s : program.steps)
        n += static_cast<int>(s.stop && !s.comments.empty() &&
                              s.comments[0].starts_with("stop: not in this program: "));
    return n;
  };
  auto straight = planned(pin("left", keyway(20, 8, "KEYWAY-HM-8")));
  auto wide = planned(pin("left", keyway(20, 10, "KEYWAY-HM-8")));
  for (auto* p : {&straight, &wide}) {
    EXPECT_EQ(stops(*p), 0);
    p->part.machine.driven_tools->y_max_mm = 0.9;
    EXPECT_EQ(stops(*p), p == &wide ? 1 : 0);
    p->part.machine.driven_tools->c_axis = false;
    EXPECT_EQ(stops(*p), 1);
  }
}

}  // namespace
}  // namespace turnwright::nc
