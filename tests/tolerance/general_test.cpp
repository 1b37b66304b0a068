#include "turnwright/tolerance/general.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace turnwright::tolerance {
namespace {

using enum LinearClass;
using enum GeometricalClass;

// ISO 2768-1, Table 1 as a public transcription has it, typed range by range.
TEST(General, LinearDeviationsEqualTheTable) {
  struct Row {
    double from_mm, to_mm, f_mm, m_mm, c_mm, v_mm;  // 0: an empty cell
  };
  for (const Row& r : std::vector<Row>{{0.5, 3, 0.05, 0.1, 0.2, 0},
                                       {3, 6, 0.05, 0.1, 0.3, 0.5},
                                       {6, 30, 0.1, 0.2, 0.5, 1},
                                       {30, 120, 0.15, 0.3, 0.8, 1.5},
                                       {120, 400, 0.2, 0.5, 1.2, 2.5},
                                       {400, 1000, 0.3, 0.8, 2, 4},
                                       {1000, 2000, 0.5, 1.2, 3, 6},
                                       {2000, 4000, 0, 2, 4, 8}}) {
    const double first = r.from_mm == 0.5 ? 0.5 : std::nextafter(r.from_mm, 1e9);
    for (const double size : {first, r.to_mm})
      for (const auto& [tolerance_class, value] :
           {std::pair{f, r.f_mm}, {m, r.m_mm}, {c, r.c_mm}, {v, r.v_mm}}) {
        if (value == 0) {
          EXPECT_THROW(general_limits_mm(size, tolerance_class), std::domain_error);
          continue;
        }
        const auto limits = general_limits_mm(size, tolerance_class);
        EXPECT_EQ(limits.upper_mm, value) << size;
        EXPECT_EQ(limits.lower_mm, -value) << size;
      }
  }
}

// ISO 2768-1, radii and chamfers, angles, as two public transcriptions have them.
TEST(General, EdgesAndAnglesEqualTheTables) {
  struct Row {
    double over_mm, to_mm, f_m, c, v;
  };
  for (const Row& r :
       std::vector<Row>{{0.4999, 3, 0.2, 0.4, 0.4}, {3, 6, 0.5, 1, 1}, {6, 1e4, 1, 2, 2}})
    for (const double size : {std::max(0.5, std::nextafter(r.over_mm, 1e9)), r.to_mm})
      for (const auto& [tolerance_class, value] :
           {std::pair{f, r.f_m}, {m, r.f_m}, {c, r.c}, {v, r.v}}) {
        const auto limits = general_edge_limits_mm(size, tolerance_class);
        EXPECT_EQ(limits.upper_mm, value) << size;
        EXPECT_EQ(limits.lower_mm, -value) << size;
      }
  for (const Row& r : std::vector<Row>{{0, 10, 60, 90, 180},
                                       {10, 50, 30, 60, 120},
                                       {50, 120, 20, 30, 60},
                                       {120, 400, 10, 15, 30},
                                       {400, 1e4, 5, 10, 20}})
    for (const double leg : {std::nextafter(r.over_mm, 1e9), r.to_mm})
      for (const auto& [tolerance_class, minutes] :
           {std::pair{f, r.f_m}, {m, r.f_m}, {c, r.c}, {v, r.v}})
        EXPECT_NEAR(general_angle_rad(leg, tolerance_class) * 10800 / std::acos(-1.0),
                    minutes, 1e-12)
            << leg;
}

// ISO 2768-2 as a public transcription has it (run-outs: handbook), typed range by range.
TEST(General, FormAndPositionEqualTheTables) {
  struct Row {
    double over_mm, to_mm, H_mm, K_mm, L_mm;
  };
  for (const Row& r : std::vector<Row>{{0, 10, 0.02, 0.05, 0.1},
                                       {10, 30, 0.05, 0.1, 0.2},
                                       {30, 100, 0.1, 0.2, 0.4},
                                       {100, 300, 0.2, 0.4, 0.8},
                                       {300, 1000, 0.3, 0.6, 1.2},
                                       {1000, 3000, 0.4, 0.8, 1.6}})
    for (const double size : {std::nextafter(r.over_mm, 1e9), r.to_mm}) {
      EXPECT_EQ(general_straightness_mm(size, H), r.H_mm) << size;
      EXPECT_EQ(general_straightness_mm(size, K), r.K_mm) << size;
      EXPECT_EQ(general_straightness_mm(size, L), r.L_mm) << size;
    }
  for (const Row& r : std::vector<Row>{{0, 100, 0.2, 0.4, 0.6},
                                       {100, 300, 0.3, 0.6, 1},
                                       {300, 1000, 0.4, 0.8, 1.5},
                                       {1000, 3000, 0.5, 1, 2}})
    for (const double size : {std::nextafter(r.over_mm, 1e9), r.to_mm}) {
      EXPECT_EQ(general_perpendicularity_mm(size, H), r.H_mm) << size;
      EXPECT_EQ(general_perpendicularity_mm(size, K), r.K_mm) << size;
      EXPECT_EQ(general_perpendicularity_mm(size, L), r.L_mm) << size;
    }
  for (const Row& r : std::vector<Row>{{0, 100, 0.5, 0.6, 0.6},
                                       {100, 300, 0.5, 0.6, 1},
                                       {300, 1000, 0.5, 0.8, 1.5},
                                       {1000, 3000, 0.5, 1, 2}})
    for (const double size : {std::nextafter(r.over_mm, 1e9), r.to_mm}) {
      EXPECT_EQ(general_symmetry_mm(size, H), r.H_mm) << size;
      EXPECT_EQ(general_symmetry_mm(size, K), r.K_mm) << size;
      EXPECT_EQ(general_symmetry_mm(size, L), r.L_mm) << size;
    }
  EXPECT_EQ(general_runout_mm(H), 0.1);
  EXPECT_EQ(general_runout_mm(K), 0.2);
  EXPECT_EQ(general_runout_mm(L), 0.5);
}

TEST(General, ReadsTheDesignation) {
  const auto mK = general_tolerance("ISO 2768-mK");
  EXPECT_EQ(mK.linear, m);
  EXPECT_EQ(mK.geometrical, K);
  const auto only_m = general_tolerance("ISO 2768-m");
  EXPECT_EQ(only_m.linear, m);
  EXPECT_FALSE(only_m.geometrical);
  const auto fH = general_tolerance("ISO 2768-fH");
  EXPECT_EQ(fH.linear, f);
  EXPECT_EQ(fH.geometrical, H);
  const auto only_L = general_tolerance("ISO 2768-L");
  EXPECT_FALSE(only_L.linear);
  EXPECT_EQ(only_L.geometrical, L);
}

TEST(General, RefusesOtherDesignations) {
  for (const std::string text : {"ISO 2768", "ISO 2768-", "ISO 2768-x", "ISO 2768-Km",
                                 "ISO 2768-mKK", "iso 2768-m", "DIN 7168-m", ""})
    try {
      general_tolerance(text);
      ADD_FAILURE() << text;
    } catch (const std::domain_error& e) {
      EXPECT_EQ(e.what(),
                "general tolerance '" + text +
                    "': write \"ISO 2768-\" with f, m, c or v for sizes and H, K "
                    "or L for form and position, such as \"ISO 2768-mK\"");
    }
}

TEST(General, RefusesSizesOutsideTheTables) {
  for (const double bad : {0.0, 0.49, 4000.1, -5.0, std::nan("")}) {
    EXPECT_THROW(general_limits_mm(bad, m), std::domain_error) << bad;
  }
  for (const double bad : {0.0, 3000.1, -5.0, std::nan("")}) {
    EXPECT_THROW(general_straightness_mm(bad, H), std::domain_error) << bad;
    EXPECT_THROW(general_perpendicularity_mm(bad, H), std::domain_error) << bad;
    EXPECT_THROW(general_symmetry_mm(bad, H), std::domain_error) << bad;
  }
  for (const double bad : {0.0, 0.49, -5.0, std::nan("")})
    EXPECT_THROW(general_edge_limits_mm(bad, m), std::domain_error) << bad;
  for (const double bad : {0.0, -5.0, std::nan("")})
    EXPECT_THROW(general_angle_rad(bad, m), std::domain_error) << bad;
}

part::Drawing step() {
  part::Drawing d;
  d.stock = {.outer_mm = 62, .length_mm = 152, .left_allowance_mm = 1};
  d.outer = {{.id = "d1", .length_mm = 50, .left_mm = 60, .right_mm = 60},
             {.id = "d2", .length_mm = 100, .left_mm = 30, .right_mm = 30}};
  return d;
}

std::vector<std::string> implied(const part::Drawing& d, GeometricalClass form) {
  std::vector<std::string> out;
  for (const auto& t : implied_form_tolerances(d, form)) {
    EXPECT_FALSE(t.limits);
    out.push_back(t.id + " " + std::to_string(t.value_mm).substr(0, 4));
  }
  return out;
}

using Ids = std::vector<std::string>;

// Table 1 of part 2, K: 0.2 mm over 30 to 100 mm, 0.1 mm over 10 to 30 mm.
TEST(General, ImpliesFormWhereNothingHoldsIt) {
  EXPECT_EQ(implied(step(), K), (Ids{"d1:straightness 0.20", "d2:straightness 0.20",
                                     "left:flatness 0.20", "right:flatness 0.10"}));
  part::Drawing d = step();
  d.inner = {{.id = "b1", .length_mm = 20, .left_mm = 12, .right_mm = 12}};
  EXPECT_EQ(implied(d, K)[2], "b1:straightness 0.10");
  EXPECT_TRUE(implied({}, K).empty());
}

TEST(General, ImpliesNoFormThatASizeOrZoneHoldsAsClosely) {
  using enum part::ToleranceKind;
  part::Drawing d = step();
  d.outer[0].limits = part::Limits{-0.2, 0.2};   // the radius varies by 0.2
  d.outer[1].limits = part::Limits{-0.2, 0.21};  // by 0.205
  EXPECT_EQ(implied(d, K)[0], "d2:straightness 0.20");
  const auto add = [&](part::ToleranceKind kind, const std::string& of, double value_mm) {
    part::Tolerance t;
    t.kind = kind;
    t.of = of;
    t.value_mm = value_mm;
    d.tolerances.push_back(std::move(t));
  };
  add(total_radial_runout, "d2", 0.2);
  add(perpendicularity, "left", 0.21);
  add(total_axial_runout, "right", 0.1);
  EXPECT_EQ(implied(d, K), Ids{"left:flatness 0.20"});
  d.tolerances[0].kind = circularity;  // holds no generatrix
  EXPECT_EQ(implied(d, K)[0], "d2:straightness 0.20");
}

TEST(General, ImpliesNoFormOfCutsUnfacedEndsAndSizesBeyondTheTable) {
  part::Drawing d = step();
  d.outer[0].cut = part::Cut{};
  d.outer[1].length_mm = 3000.5;
  d.stock.left_allowance_mm = 0;
  d.stock.length_mm = 3050.5;
  EXPECT_TRUE(implied(d, H).empty());
}

}  // namespace
}  // namespace turnwright::tolerance
