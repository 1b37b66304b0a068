// Chamfers, fillets and undercuts as a part document asks for them.
#include <gtest/gtest.h>

#include <cmath>

#include "document/json/file.hpp"
#include "refusal.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/document/part_plan.hpp"

namespace turnwright::document::edges_test {
namespace {

using nlohmann::json;

// d1 30, d2 50, d3 40, with a groove before d5 36; bores from the right 24, then 20.
json stepped(const std::vector<json>& edges) {
  const auto cylinder = [](const char* id, double length, double d) {
    return json{
        {"id", id}, {"kind", "cylinder"}, {"length_mm", length}, {"diameter_mm", d}};
  };
  json bores = {cylinder("b1", 30, 24), cylinder("b2", 40, 20)};
  for (auto& b : bores) b["from"] = "right";
  json groove = cylinder("d4", 3, 34);
  groove["kind"] = "groove";
  return {{"material", "test-steel"},
          {"stock", {{"kind", "bar"}, {"diameter_mm", 55}, {"length_mm", 135}}},
          {"outer",
           {cylinder("d1", 30, 30), cylinder("d2", 40, 50), cylinder("d3", 30, 40),
            groove, cylinder("d5", 30, 36)}},
          {"inner", bores},
          {"edges", edges}};
}

part::Drawing read(const std::vector<json>& edges) {
  return load_part_plan(stepped(edges), test_catalogue(), "t").plan.drawing;
}

std::string refusal(const std::vector<json>& edges) { return refusal_of(stepped(edges)); }

json edge(const char* at, json shape) {
  shape["at"] = at;
  return shape;
}

TEST(Edges, AChamferBelongsToTheElementThatStands) {
  const auto d =
      read({edge("left", {{"chamfer_mm", 2}, {"angle_deg", 30}}),
            edge("d2|d1", {{"chamfer_mm", 1}}), edge("d2|d3", {{"chamfer_mm", 1.5}}),
            edge("right|d5", {{"chamfer_mm", 0.5}})});
  ASSERT_TRUE(d.outer[0].left_chamfer);
  EXPECT_EQ(d.outer[0].left_chamfer->axial_mm, 2);
  EXPECT_NEAR(d.outer[0].left_chamfer->radial_mm, 2 / std::sqrt(3), 1e-12);
  EXPECT_FALSE(d.outer[0].right_chamfer);
  ASSERT_TRUE(d.outer[1].left_chamfer && d.outer[1].right_chamfer);
  EXPECT_NEAR(d.outer[1].left_chamfer->radial_mm, 1, 1e-12);
  EXPECT_EQ(d.outer[1].right_chamfer->axial_mm, 1.5);
  EXPECT_FALSE(d.outer[2].left_chamfer);
  ASSERT_TRUE(d.outer[4].right_chamfer);
}

// Inside the narrower bore stands.
TEST(Edges, OfBoresAreTheirMouthsAndSteps) {
  const auto d =
      read({edge("right|b1", {{"chamfer_mm", 1}}), edge("b1|b2", {{"chamfer_mm", 0.5}})});
  EXPECT_TRUE(d.inner[0].right_chamfer);
  EXPECT_FALSE(d.inner[0].left_chamfer);
  EXPECT_TRUE(d.inner[1].right_chamfer);
  EXPECT_FALSE(d.inner[1].left_chamfer);
}

TEST(Edges, FilletsAndUndercutsBelongToTheElementBelow) {
  const auto d = read({edge("d1|d2", {{"fillet_mm", 0.8}}),
                       edge("d3|d2", {{"undercut", "DIN 509 - E0,8x0,3"}}),
                       edge("b2|b1", {{"fillet_mm", 0.4}})});
  EXPECT_EQ(d.outer[0].right_fillet_mm, 0.8);
  EXPECT_FALSE(d.outer[0].left_fillet_mm || d.outer[1].left_fillet_mm);
  ASSERT_TRUE(d.outer[2].left_undercut);
  EXPECT_EQ(d.outer[2].left_undercut->radius_mm, 0.8);
  EXPECT_EQ(d.outer[2].left_undercut->depth_mm, 0.3);
  EXPECT_EQ(d.outer[2].left_undercut->width_mm, 2.5);
  EXPECT_EQ(d.inner[0].left_fillet_mm, 0.4);
}

// The title block breaks every edge that is not named and has room: not the drilled end's
// mouth of a part whose bores are named, nothing twice.
TEST(Edges, OfTheTitleBlockAreBrokenInTheMiddleOfItsSizes) {
  auto document = stepped({edge("d2|d3", {{"chamfer_mm", 2}})});
  document["general_edges_mm"] = {0.2, 0.4};
  const auto d = load_part_plan(document, test_catalogue(), "t").plan.drawing;
  const auto is_broken = [](const std::optional<part::Chamfer>& c) {
    return c && c->general && std::abs(c->axial_mm - 0.3) < 1e-12 &&
           c->radial_mm == c->axial_mm;
  };
  EXPECT_TRUE(is_broken(d.outer[0].left_chamfer));
  EXPECT_TRUE(is_broken(d.outer[1].left_chamfer));
  EXPECT_EQ(d.outer[1].right_chamfer->axial_mm, 2);
  EXPECT_FALSE(d.outer[1].right_chamfer->general);
  EXPECT_TRUE(is_broken(d.outer[2].right_chamfer));
  EXPECT_FALSE(d.outer[2].left_chamfer) << "the foot of a step";
  EXPECT_TRUE(is_broken(d.outer[4].left_chamfer) && d.outer[4].left_chamfer->by_blade);
  EXPECT_TRUE(is_broken(d.outer[4].right_chamfer));
  EXPECT_TRUE(is_broken(d.inner[0].right_chamfer));
  for (const json& wrong :
       {json({0.4, 0.2}), json({0.2}), json(0.3), json({-0.2, 0.4})}) {
    document["general_edges_mm"] = wrong;
    EXPECT_THROW(load_part_plan(document, test_catalogue(), "t"), InputError) << wrong;
  }
}

// d3 stands out of the groove's blank, which is as high as d5: there its blade cuts the rim.
TEST(Edges, AtAGrooveAreChamfers) {
  const auto d = read({edge("d3|d4", {{"chamfer_mm", 1}}),
                       edge("d5|d4", {{"chamfer_mm", 0.4}, {"angle_deg", 30}})});
  ASSERT_TRUE(d.outer[2].right_chamfer && d.outer[4].left_chamfer);
  EXPECT_FALSE(d.outer[2].right_chamfer->by_blade);
  EXPECT_TRUE(d.outer[4].left_chamfer->by_blade);
  EXPECT_EQ(d.outer[4].left_chamfer->axial_mm, 0.4);
  EXPECT_EQ(
      refusal({edge("d4|d5", {{"chamfer_mm", 1}})}),
      "t: /edges/0/chamfer_mm: got 1, expected a chamfer that takes at most 0.95 mm "
      "of the radius there (this one takes 1)");
}

TEST(Edges, ThatThePartHasNotAreRefusedByName) {
  EXPECT_EQ(refusal({edge("d1|d3", {{"chamfer_mm", 1}})}),
            "t: /edges/0/at: got \"d1|d3\", expected an edge of the part (did you mean "
            "\"d1|d2\"?)");
  EXPECT_EQ(refusal({edge("left|b1", {{"chamfer_mm", 1}})}),
            "t: /edges/0/at: got \"left|b1\", expected an edge of the part: \"left\", "
            "\"right\", \"d1|d2\", \"d2|d3\", \"d3|d4\", \"d4|d5\", \"right|b1\", "
            "\"b2|b1\"");
  EXPECT_EQ(
      refusal({edge("left", {{"chamfer_mm", 1}}), edge("d1|left", {{"chamfer_mm", 1}})}),
      "t: /edges/1/at: got \"d1|left\", expected each edge once");
}

TEST(Edges, HaveOneShapeThatFits) {
  EXPECT_EQ(
      refusal({edge("left", json::object())}),
      "t: /edges/0: got an edge without a shape, expected chamfer_mm or radius_mm for "
      "the edge, or fillet_mm or undercut for the inner corner at its foot");
  EXPECT_EQ(
      refusal({edge("d1|d2", {{"chamfer_mm", 1}, {"fillet_mm", 1}})}),
      "t: /edges/0: got an edge with several shapes, expected chamfer_mm or radius_mm "
      "for the edge, or fillet_mm or undercut for the inner corner at its foot");
  EXPECT_EQ(
      refusal({edge("d2|d3", {{"chamfer_mm", 5}})}),
      "t: /edges/0/chamfer_mm: got 5, expected a chamfer that takes at most 4.95 mm "
      "of the radius there (this one takes 5)");
  EXPECT_EQ(refusal({edge("d1|d2", {{"chamfer_mm", 39}, {"angle_deg", 1}}),
                     edge("d2|d3", {{"chamfer_mm", 2}})}),
            "t: /edges/1/chamfer_mm: got 2, expected less than the 1 mm that d2 is long "
            "beside the edge at its other end");
  EXPECT_EQ(refusal({edge("right", {{"chamfer_mm", 3}})}),
            "t: /edges/0/chamfer_mm: got 3, expected a chamfer that takes at most 2.7 mm "
            "of the radius there (this one takes 3)");
  EXPECT_EQ(
      refusal({edge("left", {{"fillet_mm", 1}})}),
      "t: /edges/0/fillet_mm: got 1, expected a chamfer_mm or radius_mm: there is no "
      "inner corner at a face of the part");
}

TEST(Edges, RoundedEdgesAreQuartersOfACircle) {
  const auto d =
      read({edge("left", {{"radius_mm", 1}}), edge("d2|d3", {{"radius_mm", 2}}),
            edge("right|b1", {{"radius_mm", 1.5}})});
  for (const auto& [c, R] : {std::pair{d.outer[0].left_chamfer, 1.0},
                             {d.outer[1].right_chamfer, 2.0},
                             {d.inner[0].right_chamfer, 1.5}}) {
    ASSERT_TRUE(c && c->round);
    EXPECT_EQ(c->axial_mm, R);
    EXPECT_EQ(c->radial_mm, R);
  }
}

// A rim of 40 mm that is round all over; on its own a radius leaves something of its element.
TEST(Edges, TwoRoundedEdgesMayMeet) {
  auto document =
      stepped({edge("d1|d2", {{"radius_mm", 4}}), edge("d2|d3", {{"radius_mm", 4}})});
  document["outer"][1]["length_mm"] = 8;
  const auto d = load_part_plan(document, test_catalogue(), "t").plan.drawing;
  EXPECT_TRUE(d.outer[1].left_chamfer->round && d.outer[1].right_chamfer->round);
  document["edges"].erase(1);
  document["outer"][1]["length_mm"] = 4;
  EXPECT_NE(refusal_of(document).find("less than the 4 mm that are free of d2"),
            std::string::npos)
      << refusal_of(document);
}

TEST(Edges, RoundedEdgesAreThoseOfCylindersThatHaveRoomAndAreNotGround) {
  EXPECT_EQ(refusal({edge("d2|d3", {{"radius_mm", 5}})}),
            "t: /edges/0/radius_mm: got 5, expected a radius that takes at most 4.95 mm "
            "there");
  EXPECT_EQ(refusal({edge("left", {{"radius_mm", 1}, {"angle_deg", 30}})}),
            "t: /edges/0/angle_deg: got 30, expected no such key");
  EXPECT_EQ(
      refusal({edge("left", {{"radius_mm", 1}}), edge("left", {{"chamfer_mm", 1}})}),
      "t: /edges/1/at: got \"left\", expected each edge once");
  EXPECT_EQ(refusal({edge("left", {{"radius_mm", 0}})}),
            "t: /edges/0/radius_mm: got 0, expected a number > 0 and <= 1000 mm");
}

// Whichever of the two is named first.
TEST(Edges, AtBothEndsOfAnElementAndOfAStepDoNotMeet) {
  const auto narrow = edge("d1|d2", {{"undercut", "E0.8x0.3"}}),
             wide = edge("left", {{"chamfer_mm", 28}, {"angle_deg", 5}}),
             high = edge("d2|d1", {{"chamfer_mm", 9.6}}),
             round = edge("d1|d2", {{"undercut", "E0.8x0.3"}});
  EXPECT_EQ(refusal({narrow, wide}),
            "t: /edges/1/chamfer_mm: got 28, expected less than the 27.5 mm that d1 is "
            "long beside the edge at its other end");
  EXPECT_EQ(refusal({wide, narrow}),
            "t: /edges/1/undercut: got \"E0.8x0.3\", expected an undercut that is less "
            "wide than the 2 mm that are left of d1");
  EXPECT_EQ(refusal({round, high}),
            "t: /edges/1/chamfer_mm: got 9.6, expected a chamfer that takes at most 9.45 "
            "mm of the radius there (this one takes 9.6)");
  EXPECT_EQ(refusal({high, round}),
            "t: /edges/1/undercut: got \"E0.8x0.3\", expected an undercut that "
            "takes at most 0.35 mm of the shoulder");
}

// A step counts as it is cut: between the middles of both sizes.
TEST(Edges, FitTheStepThatIsCut) {
  auto document = stepped({edge("d2|d3", {{"chamfer_mm", 4}})});
  document["outer"][1]["limits_mm"] = {-3, -2};
  try {
    load_part_plan(document, test_catalogue(), "t");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "t: /edges/0/chamfer_mm: got 4, expected a chamfer that takes at most "
                 "3.7 mm of the radius there (this one takes 4)");
  }
}

TEST(Edges, UndercutsAreThoseOfTheStandard) {
  const auto refused = [](const char* what) {
    return "t: /edges/0/undercut: got \"" + std::string(what) +
           "\", expected an undercut of DIN 509 with a radius and a depth of its table: "
           "of "
           "form E or F like \"E0.8x0.3\", \"G0.4x0.2\", \"H0.8x0.3\" or \"H1.2x0.3\"";
  };
  for (const char* what :
       {"G0.8x0.3", "H0.4x0.2", "I0.8x0.3", "E0.8x0.4", "0.8x0.3", "E", "E0.8x0.3x1"})
    EXPECT_EQ(refusal({edge("d1|d2", {{"undercut", what}})}), refused(what));
  EXPECT_EQ(refusal({edge("d3|d2", {{"undercut", "E4x0.5"}})}), "accepted");
  EXPECT_EQ(refusal({edge("d3|d2", {{"undercut", "DIN 509-F0,8x0,3"}})}), "accepted");
  EXPECT_EQ(refusal({edge("d3|d2", {{"undercut", "E0.8\u00d70.3"}})}), "accepted");
  EXPECT_EQ(refusal({edge("d3|d2", {{"undercut", "DIN 509-G0,4x0,2"}})}), "accepted");
  EXPECT_EQ(refusal({edge("d3|d2", {{"undercut", "H1.2x0.3"}})}), "accepted");
  EXPECT_EQ(
      refusal({edge("b1|b2", {{"undercut", "E0.4x0.2"}})}),
      "t: /edges/0/undercut: got \"E0.4x0.2\", expected the inner corner between two "
      "outer elements, \"d1|d2\"");
}

// Of a thread those of DIN 76, of a cylinder those of DIN 509.
TEST(Edges, UndercutsOfThreadsFollowTheirPitch) {
  const auto threaded = [](double pitch, const char* undercut) {
    auto d = stepped({edge("d1|d2", {{"undercut", undercut}})});
    d["outer"][0]["kind"] = "thread";
    d["outer"][0]["pitch_mm"] = pitch;
    return d;
  };
  for (const char* what : {"DIN 76-A", "DIN76-B", "DIN 76-1 A"})
    EXPECT_EQ(refusal_of(threaded(1.5, what)), "accepted") << what;
  const auto d =
      load_part_plan(threaded(2, "DIN 76-B"), test_catalogue(), "t").plan.drawing;
  ASSERT_TRUE(d.outer[0].right_undercut);
  EXPECT_EQ(d.outer[0].right_undercut->width_mm, 5);
  EXPECT_EQ(
      refusal_of(threaded(1.6, "DIN 76-A")),
      "t: /edges/0/undercut: got \"DIN 76-A\", expected a thread with a pitch of DIN "
      "76's table, 0.5 to 6 mm, not 1.6 mm");
  for (const char* what : {"E0.8x0.3", "DIN 76-C", "DIN 76"})
    EXPECT_EQ(refusal_of(threaded(1.5, what)),
              "t: /edges/0/undercut: got \"" + std::string(what) +
                  "\", expected an undercut of DIN 76 behind a thread, \"DIN 76-A\" or "
                  "\"DIN 76-B\"");
  EXPECT_NE(refusal({edge("d1|d2", {{"undercut", "DIN 76-A"}})}), "accepted");
}

// Other problems of the document are told beside those of its edges, and an element
// without a size makes no edge wrong.
TEST(Edges, OfAnUnreadablePartAreLeftAlone) {
  auto document = stepped({edge("d1|d2", {{"chamfer_mm", 1}})});
  document["outer"][1].erase("diameter_mm");
  try {
    load_part_plan(document, test_catalogue(), "t");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("/edges"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace turnwright::document::edges_test
