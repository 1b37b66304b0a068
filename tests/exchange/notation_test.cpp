#include "turnwright/exchange/notation.hpp"

#include <gtest/gtest.h>

#include <random>

#include "reference_outlines.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::exchange {
namespace {

void expect_equal(const std::optional<part::Limits>& a,
                  const std::optional<part::Limits>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  EXPECT_EQ(a->lower_mm, b->lower_mm);
  EXPECT_EQ(a->upper_mm, b->upper_mm);
}

void expect_equal(const Demands& a, const Demands& b) {
  EXPECT_EQ(a.fit, b.fit);
  EXPECT_EQ(a.Ra_um, b.Ra_um);
  EXPECT_EQ(a.Rz_um, b.Rz_um);
  expect_equal(a.limits, b.limits);
}

void expect_equal(const std::vector<Element>& a, const std::vector<Element>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE(b[i].id);
    EXPECT_EQ(a[i].id, b[i].id);
    EXPECT_EQ(a[i].shape, b[i].shape);
    EXPECT_EQ(a[i].length_mm, b[i].length_mm);
    EXPECT_EQ(a[i].left_mm, b[i].left_mm);
    EXPECT_EQ(a[i].right_mm, b[i].right_mm);
    EXPECT_EQ(a[i].flats, b[i].flats);
    EXPECT_EQ(a[i].pitch_mm, b[i].pitch_mm);
    EXPECT_EQ(a[i].radius_mm, b[i].radius_mm);
    EXPECT_EQ(a[i].convex, b[i].convex);
    EXPECT_EQ(a[i].from, b[i].from);
    EXPECT_EQ(a[i].knurl, b[i].knurl);
    expect_equal(a[i].demands, b[i].demands);
  }
}

void expect_equal(const std::vector<Edge>& a, const std::vector<Edge>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE(b[i].at);
    EXPECT_EQ(a[i].at, b[i].at);
    EXPECT_EQ(a[i].chamfer_mm, b[i].chamfer_mm);
    EXPECT_EQ(a[i].angle_deg, b[i].angle_deg);
    EXPECT_EQ(a[i].radius_mm, b[i].radius_mm);
    EXPECT_EQ(a[i].fillet_mm, b[i].fillet_mm);
    EXPECT_EQ(a[i].undercut, b[i].undercut);
  }
}

void expect_equal(const std::vector<part::Tolerance>& a,
                  const std::vector<part::Tolerance>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE(b[i].id);
    EXPECT_EQ(a[i].id, b[i].id);
    EXPECT_EQ(a[i].kind, b[i].kind);
    EXPECT_EQ(a[i].of, b[i].of);
    EXPECT_EQ(a[i].datum, b[i].datum);
    EXPECT_EQ(a[i].common_datum, b[i].common_datum);
    EXPECT_EQ(a[i].between, b[i].between);
    EXPECT_EQ(a[i].value_mm, b[i].value_mm);
    expect_equal(a[i].limits, b[i].limits);
  }
}

void expect_equal(const std::vector<Milled>& a, const std::vector<Milled>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE(b[i].id);
    EXPECT_EQ(a[i].id, b[i].id);
    EXPECT_EQ(a[i].kind, b[i].kind);
    EXPECT_EQ(a[i].on, b[i].on);
    EXPECT_EQ(a[i].z_mm, b[i].z_mm);
    EXPECT_EQ(a[i].length_mm, b[i].length_mm);
    EXPECT_EQ(a[i].width_mm, b[i].width_mm);
    EXPECT_EQ(a[i].depth_mm, b[i].depth_mm);
    EXPECT_EQ(a[i].angle_deg, b[i].angle_deg);
    EXPECT_EQ(a[i].through, b[i].through);
    expect_equal(a[i].demands, b[i].demands);
  }
}

void expect_equal(const Outline& a, const Outline& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.material, b.material);
  EXPECT_EQ(a.general, b.general);
  EXPECT_EQ(a.title.drawing_number, b.title.drawing_number);
  EXPECT_EQ(a.title.revision, b.title.revision);
  EXPECT_EQ(a.title.customer, b.title.customer);
  expect_equal(a.outer, b.outer);
  expect_equal(a.inner, b.inner);
  expect_equal(a.edges, b.edges);
  ASSERT_EQ(a.faces.size(), b.faces.size());
  for (std::size_t i = 0; i < a.faces.size(); ++i) {
    EXPECT_EQ(a.faces[i].id, b.faces[i].id);
    expect_equal(a.faces[i].demands, b.faces[i].demands);
  }
  expect_equal(a.tolerances, b.tolerances);
  expect_equal(a.milled, b.milled);
}

std::string mistakes(std::string_view text) {
  try {
    read_notation(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Notation, IsReadAsItIsSaid) {
  const Outline o =
      read_notation("d50 h7 x 40 Ra1.6; d30 k6 x 32; M24x1.5 x 25; bore d20 H7 x 60");
  ASSERT_EQ(o.outer.size(), 3u);
  ASSERT_EQ(o.inner.size(), 1u);
  EXPECT_EQ(o.outer[0].id, "d1");
  EXPECT_EQ(o.outer[0].left_mm, 50);
  EXPECT_EQ(o.outer[0].right_mm, 50);
  EXPECT_EQ(o.outer[0].length_mm, 40);
  EXPECT_EQ(o.outer[0].demands.fit, "h7");
  EXPECT_EQ(o.outer[0].demands.Ra_um, 1.6);
  EXPECT_EQ(o.outer[1].demands.fit, "k6");
  EXPECT_EQ(o.outer[2].id, "d3");
  EXPECT_EQ(o.outer[2].shape, Shape::thread);
  EXPECT_EQ(o.outer[2].left_mm, 24);
  EXPECT_EQ(o.outer[2].pitch_mm, 1.5);
  EXPECT_EQ(o.outer[2].length_mm, 25);
  EXPECT_EQ(o.inner[0].id, "b1");
  EXPECT_EQ(o.inner[0].from, part::End::right);
  EXPECT_EQ(o.inner[0].demands.fit, "H7");
  EXPECT_EQ(o.inner[0].length_mm, 60);
}

// Each line says the same thing in two ways.
TEST(Notation, TakesWhatPeopleWrite) {
  const std::pair<const char*, const char*> same[] = {
      {"d50,5 x 40", "Ø50.5 × 40"},
      {"d50x40", "⌀ 50 X40"},
      {"d30-d40 x 25", "cone d30/d40 x 25"},
      {"d30-40x25", "cone Ø30-Ø40 x 25"},
      {"M24 x 25 6g", "thread m24 6g X25"},
      {"M24x1.5x25", "M 24 x 1.5 x 25"},
      {"d50 ±0.05 x 40", "d50 +-0,05 x 40"},
      {"d50 ±0.05 x 40", "D50 +/-0.05 x 40"},
      {"d50 -0.01/+0.02 x 40", "d50 +0.02/-0.01 x 40"},
      {"d50 0/-0.1 x 40", "d50 -0.1/0 x 40"},
      {"d50 x 40 RA 1.6 rz 6.3", "d50 x 40 Ra1.6 Rz6.3"},
      {"d50 x 40; 1×45°", "d50 x 40; right: chamfer 1"},
      {"r 0.8 1x45; d50 x 40", "left: R0.8 1x45; d50 x 40"},
      {"d50 x 40; E0.8x0.3; d60 x 5", "d50 x 40\r\nd60 x 5\nd1|d2: e0.8x0.3"},
      {"bore right d20 x 60",
       "\xef\xbb\xbf"
       "bore d20 x 60;;\n"},
      {"arc d30-d40 x 25 R60", "arc d30-d40 x 25 R60 convex"}};
  for (const auto& [a, b] : same) {
    SCOPED_TRACE(a);
    expect_equal(read_notation(a), read_notation(b));
  }
}

TEST(Notation, ABoresR7IsAFitAndACornersR7AFillet) {
  const Outline o = read_notation("d50 x 40; R7; d70 x 40; bore d20 R7 x 30");
  EXPECT_EQ(o.inner[0].demands.fit, "R7");
  ASSERT_EQ(o.edges.size(), 1u);
  EXPECT_EQ(o.edges[0].at, "d1|d2");
  EXPECT_EQ(o.edges[0].fillet_mm, 7);
  EXPECT_EQ(read_notation("d50 d9 x 40").outer[0].demands.fit, "d9");
  EXPECT_EQ(read_notation("d50 m6 x 40").outer[0].demands.fit, "m6");
  EXPECT_EQ(read_notation("bore d50 E8 x 40").inner[0].demands.fit, "E8");
}

TEST(Notation, ReadsWhatStaysAsTheBarIs) {
  const Outline o =
      read_notation("stock hex27 x 20; d20 h9 x 30; stock d50x5; stock square 20 x 8");
  ASSERT_EQ(o.outer.size(), 4u);
  for (const auto& [k, across, flats] : {std::tuple{0, 27, 6}, {2, 50, 0}, {3, 20, 4}}) {
    const auto& e = o.outer[static_cast<std::size_t>(k)];
    EXPECT_EQ(e.shape, Shape::as_stock);
    EXPECT_EQ(e.left_mm, across);
    EXPECT_EQ(e.right_mm, across);
    EXPECT_EQ(e.flats, flats);
  }
  EXPECT_NE(mistakes("stock hex27 h9 x 20").find("has no fit"), std::string::npos);
  EXPECT_NE(mistakes("stock M20 x 20").find("hex27"), std::string::npos);
  EXPECT_NE(mistakes("bore stock d20 x 10").find("\"stock\""), std::string::npos);
}

TEST(Notation, ReadsInches) {
  const Outline inches = read_notation(
      "unit: in; d2 +0.0005/-0.0003 x 1.5 Ra32; 0.06x45; 1/2-13 UNC x 1; M12 x 0.5; "
      "circularity d1 0.0004; length left to right ±0.01; keyway 0.25x0.125x1 on d1 at "
      "0.2; "
      "bore d1 H7 x 0.75");
  const Outline mm = read_notation(
      "d50.8 +0.0127/-0.00762 x 38.1 Ra0.8128; 1.524x45; 1/2-13 UNC x 25.4; M12 x 12.7; "
      "circularity d1 0.01016; length left to right ±0.254; "
      "keyway 6.35x3.175x25.4 on d1 at 5.08; bore d25.4 H7 x 19.05");
  expect_equal(inches, mm);
  ASSERT_EQ(inches.assumed.size(), 1u);
  EXPECT_TRUE(mm.assumed.empty());
}

TEST(Notation, TellsWhatIsTooLargeInTheUnitsOfTheText) {
  EXPECT_EQ(mistakes("unit: in; d2 x 1 Ra125"), "");
  EXPECT_NE(mistakes("unit: in; d2 x 1 Ra5000").find("<= 3937.01 uin"),
            std::string::npos);
  EXPECT_NE(mistakes("unit: in; d900 x 1").find("<= 787.402 in"), std::string::npos);
  EXPECT_NE(mistakes("unit: furlong; d2 x 1").find("mm or in"), std::string::npos);
  EXPECT_NE(mistakes("d900000 x 1").find("<= 20000 mm"), std::string::npos);
}

TEST(Notation, RoundsEdgesAndAtEndsRIsTheEdgesRadiusToo) {
  const Outline o = read_notation(
      "R1; d30 x 20; round2 R0.8; d50 x 40; round 1,5; bore d20 x 30; right|b1: R0.5");
  ASSERT_EQ(o.edges.size(), 5u);
  EXPECT_EQ(o.edges[0].radius_mm, 1);
  EXPECT_EQ(o.edges[1].radius_mm, 2);
  EXPECT_EQ(o.edges[2].fillet_mm, 0.8);
  EXPECT_EQ(o.edges[3].at, "right");
  EXPECT_EQ(o.edges[3].radius_mm, 1.5);
  EXPECT_EQ(o.edges[4].radius_mm, 0.5);
  EXPECT_FALSE(o.edges[0].fillet_mm || o.edges[4].fillet_mm);
}

TEST(Notation, MeasuresAChamferAlongTheAxis) {
  const Outline o = read_notation("2x15; d30 x 40; 1,5x30°");
  ASSERT_EQ(o.edges.size(), 2u);
  EXPECT_EQ(o.edges[0].at, "left");
  EXPECT_EQ(o.edges[0].chamfer_mm, 2);
  EXPECT_EQ(o.edges[0].angle_deg, 15);
  EXPECT_EQ(o.edges[1].at, "right");
  EXPECT_EQ(o.edges[1].chamfer_mm, 1.5);
  EXPECT_EQ(o.edges[1].angle_deg, 30);
}

TEST(Notation, LimitsWithBlanksAreOneMistake) {
  const auto said = mistakes("d50 +0,02 / -0,01 x 40");
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 0) << said;
}

TEST(Notation, HasInchThreads) {
  const Outline o = read_notation(
      "1/2-13 UNC x 25; 1-1/4-7 UNC-2A x 40; thread #10-24 UNC 2A x 8 Ra3.2\n"
      "bore 3/8-24 UNF 2B x 20; .500-20 x 12");
  ASSERT_EQ(o.outer.size(), 4u);
  EXPECT_EQ(o.outer[0].shape, Shape::thread);
  EXPECT_EQ(o.outer[0].left_mm, 12.7);
  EXPECT_EQ(o.outer[0].pitch_mm, 25.4 / 13);
  EXPECT_EQ(o.outer[0].length_mm, 25);
  EXPECT_EQ(o.outer[1].left_mm, 31.75);
  EXPECT_EQ(o.outer[1].demands.fit, "2A");
  EXPECT_NEAR(o.outer[2].left_mm, 4.826, 1e-12);
  EXPECT_EQ(o.outer[2].demands.Ra_um, 3.2);
  EXPECT_EQ(o.outer[3].pitch_mm, 1.27);
  ASSERT_EQ(o.inner.size(), 1u);
  EXPECT_EQ(o.inner[0].demands.fit, "2B");
  EXPECT_EQ(notation(o),
            "1/2-13 UN x 25\n1-1/4-7 UN 2A x 40\n#10-24 UN 2A x 8 Ra3.2\n"
            "1/2-20 UN x 12\nbore 3/8-24 UN 2B x 20\n");
  expect_equal(read_notation(notation(o)), o);
}

TEST(Notation, HasFacesTolerancesAndMilledPlaces) {
  const Outline o = read_notation(
      "name: Pin; drawing: 4711-A; revision: B; customer: \"Smith; Sons\"\n"
      "material: C45; general: ISO 2768-mK\n"
      "d30 x 40; d40 x 50; face left Ra3.2; face d1|d2 Ra 1.6 Rz 10\n"
      "total-radial-runout d2 to d1 0.04; cylindricity d1 0,008\n"
      "length left to d1|d2 +0.1/0; diameter d2 ±0.02\n"
      "circular-axial-runout d1|d2 to d1-d2 0.03\n"
      "keyway 10x5x40 on d2 at 42; flat 2x25 on d1 at 0 angle 90°; slot 8x4x20 on d1 at "
      "0");
  EXPECT_EQ(o.name, "Pin");
  EXPECT_EQ(o.title.drawing_number, "4711-A");
  EXPECT_EQ(o.title.revision, "B");
  EXPECT_EQ(o.title.customer, "Smith; Sons");
  EXPECT_EQ(o.general, "ISO 2768-mK");
  ASSERT_EQ(o.faces.size(), 2u);
  EXPECT_EQ(o.faces[1].demands.Rz_um, 10);
  ASSERT_EQ(o.tolerances.size(), 5u);
  EXPECT_EQ(o.tolerances[4].datum, "d1");
  EXPECT_EQ(o.tolerances[4].common_datum, "d2");
  EXPECT_EQ(o.tolerances[0].kind, part::ToleranceKind::total_radial_runout);
  EXPECT_EQ(o.tolerances[0].datum, "d1");
  EXPECT_EQ(o.tolerances[0].value_mm, 0.04);
  EXPECT_EQ(o.tolerances[2].between[1], "d1|d2");
  EXPECT_EQ(o.tolerances[2].limits->upper_mm, 0.1);
  EXPECT_EQ(o.tolerances[3].of, "d2");
  ASSERT_EQ(o.milled.size(), 3u);
  EXPECT_EQ(o.milled[0].width_mm, 10);
  EXPECT_EQ(o.milled[0].depth_mm, 5);
  EXPECT_EQ(o.milled[0].length_mm, 40);
  EXPECT_EQ(o.milled[0].z_mm, 42);
  EXPECT_EQ(o.milled[1].angle_deg, 90);
  EXPECT_EQ(o.milled[2].kind, Milled::Kind::slot);
}

TEST(Notation, HasCrossHoles) {
  const Outline o = read_notation(
      "d30 x 40; d40 x 50; cross-hole d6 x 8 on d1 at 20; cross-hole ø5.5 H12 through "
      "wall "
      "on d2 at 60 angle 45 times 3; cross-hole d8 +0.2/0 through on d2 at 80; "
      "cross-hole "
      "d4 through part on d1 at 5");
  ASSERT_EQ(o.milled.size(), 4u);
  const auto& a = o.milled[0];
  EXPECT_EQ(a.kind, Milled::Kind::cross_hole);
  EXPECT_EQ(a.on, "d1");
  EXPECT_EQ(a.width_mm, 6);
  EXPECT_EQ(a.depth_mm, 8);
  EXPECT_EQ(a.z_mm, 20);
  EXPECT_EQ(a.through, Milled::Through::no);
  const auto& b = o.milled[1];
  EXPECT_EQ(b.width_mm, 5.5);
  EXPECT_EQ(b.demands.fit, "H12");
  EXPECT_EQ(b.through, Milled::Through::wall);
  EXPECT_EQ(b.angle_deg, 45);
  EXPECT_EQ(b.count, 3);
  EXPECT_EQ(o.milled[2].demands.limits->upper_mm, 0.2);
  EXPECT_EQ(o.milled[2].through, Milled::Through::part);
  EXPECT_EQ(o.milled[3].through, Milled::Through::part);
  EXPECT_EQ(notation(o),
            "d30 x 40\nd40 x 50\ncross-hole d6 x 8 on d1 at 20\n"
            "cross-hole d5.5 H12 through wall on d2 at 60 angle 45 times 3\n"
            "cross-hole d8 +0.2/0 through part on d2 at 80\n"
            "cross-hole d4 through part on d1 at 5\n");
}

TEST(Notation, NamesEveryMistakeByLineAndColumn) {
  EXPECT_EQ(
      mistakes("d50 h7 Ra1.6 x4O; d3O x 20\nnmae: Pin; Ø60 y7 x 5 (2)"),
      "notation: line 1, column 14: got \"x4O\", expected a length like x 40\n"
      "notation: line 1, column 19: got \"d3O\", expected a diameter like d50, two of "
      "a cone like d30-d40, or a thread like M24x1.5 or 1/2-13 UNC\n"
      "notation: line 2, column 1: got \"nmae\", expected name, material, general, "
      "drawing, revision, customer, unit, or an edge like left or d1|d2 before the "
      "colon\n"
      "notation: line 2, column 23: got \"(2)\", expected a length like x 40, a fit "
      "like h7, limits like +0.02/-0.01 or a roughness like Ra1.6");
}

TEST(Notation, RefusesWhatIsMissingOrTwiceOrOutOfRange) {
  const std::pair<const char*, const char*> slips[] = {
      {"", "line 1, column 1: got no element, expected elements like"},
      {"d50", "got \"d50\", expected a length like x 40 for this element"},
      {"d50 x", "got \"x\", expected a length"},
      {"d0 x 40", "got \"d0\", expected a number > 0 and <= 20000 mm"},
      {"d50 x -40", "got \"x -40\", expected a length"},
      {"d50 x 30000", "expected a number > 0 and <= 20000 mm"},
      {"d50 x 40 x 30", "got \"x 30\", expected one length"},
      {"d50 h7 k6 x 40", "got \"k6\", expected one fit, or limits instead of it"},
      {"d50 h7 ±0.1 x 40", "got \"±0.1\", expected one fit"},
      {"d50 0/0 x 40", "expected limits that differ"},
      {"d50 x 40 Ra1 Ra2", "got \"Ra2\", expected one Ra"},
      {"d50 x 40 Rax", "got \"Rax\", expected a roughness like Ra1.6"},
      {"d50-d40 h7 x 40", "fits are of cylinders, grooves and threads"},
      {"arc d50-d40 x 40", "a radius like R60 for this arc"},
      {"arc d50 x 40 R9", "the diameters at both ends"},
      {"groove d50-d40 x 4", "the diameter of the groove's floor"},
      {"thread d24 x 25", "got \"d24\", expected a thread like M24x1.5"},
      {"bore", "got \"bore\", expected a diameter"},
      {"M24x25", "a length like x 40 for this element"},
      {"d50 x 40; 1x95", "got \"1x95\", expected a chamfer like 1x45"},
      {"d50 x 40; E0.8", "got \"E0.8\", expected an undercut of DIN 509"},
      {"d50 x 40; DIN76-C", "got \"DIN76-C\", expected"},
      {"d50 x 40; R0.8 d7", "got \"d7\", expected a chamfer"},
      {"d50 x 40; left:", "a feature like 1x45 after the colon"},
      {"d50 x 40; name:", "a text after the colon"},
      {"d50 x 40; name: A; name: B", "this line of the title once"},
      {"d50 x 40; name: \"A", "a text that ends with its"},
      {"d50 x 40; face left", "expected a roughness like Ra1.6"},
      {"d50 x 40; face", "an element or a face"},
      {"d50 x 40; face d2 Ra1",
       "got \"d2\", expected an element of d1 to d1, left, right"},
      {"d50 x 40; cylindricity d1", "got nothing more after it, expected the width"},
      {"d50 x 40; cylindricity d1 0", "expected a number > 0 and <= 10 mm"},
      {"d50 x 40; cylindricity d1 0.1 0.2", "got \"0.2\", expected nothing more"},
      {"d50 x 40; coaxiality d1 to d7 0.1",
       "got \"d7\", expected an element of d1 to d1"},
      {"d50h7 x 40", "blanks between diameter, fit and length, like d50 h7 x 40"},
      {"d50h7x40", "blanks between diameter, fit and length, like d50 h7 x 40"},
      {"d50 h7 x 40, d30 k6 x 32", "got \"x 40,\", expected ';' or a new line"},
      {"d50 h7, x 40", "got \"h7,\", expected ';' or a new line"},
      {"d50, x 40", "got \"d50,\", expected ';' or a new line"},
      {"d50 +0,02 / -0,01 x 40",
       "got \"+0,02\", expected limits without blanks, like +0.02/-0.01"},
      {"d50 x 40; coaxiality d1 to d1-d7 0.1", "got \"d7\", expected an element of d1"},
      {"d50 x 40; coaxiality d1 to d1-d1 0.1", "two different elements"},
      {"d50 x 40; coaxiality d1 to left-d1 0.1", "got \"left\", expected an element"},
      {"d50 x 40; coaxiality d1 to - 0.1", "expected two different elements"},
      {"d50 x 40; length left right ±0.1", "got \"right\", expected to"},
      {"d50 x 40; length left to right 0.1", "limits like +0.05/-0.02"},
      {"d50 x 40; keyway 10x5 on d1 at 2", "width, depth and length like 10x5x40"},
      {"d50 x 40; keyway 10x5x20 on left at 2",
       "got \"left\", expected an element of d1"},
      {"d50 x 40; keyway 10x5x20 at 2", "expected on and an element"},
      {"d50 x 40; cross-hole 6 x 8 on d1 at 2", "the diameter of the hole like d6, > 0"},
      {"d50 x 40; cross-hole d6 on d1 at 2",
       "its depth like x 8, > 0, or through wall, or through part"},
      {"d50 x 40; cross-hole d6 x 0 on d1 at 2", "its depth like x 8"},
      {"d50 x 40; cross-hole d6 through bore on d1 at 2", "expected on and an element"},
      {"d50 x 40; cross-hole d6 x 8 on d1", "at and its middle along the part"},
      {"d50 x 40; flat 2x20 on d1", "expected at and its left end"},
      {"d50 x nan", "got \"x nan\", expected a length"},
      {"d50 x 1e2", "got \"x 1e2\", expected a length"},
      {"d50 x 40\nhello", "line 2, column 1: got \"hello\", expected an element like"}};
  for (const auto& [text, message] : slips) {
    SCOPED_TRACE(text);
    const std::string said = mistakes(text);
    EXPECT_NE(said.find(message), std::string::npos) << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 0) << said;
  }
}

TEST(Notation, OfTheReferencePartsIsReadBack) {
  const auto parts = reference::outlines();
  EXPECT_EQ(parts.size(), 16u);
  for (const auto& [name, o] : parts) {
    SCOPED_TRACE(name + "\n" + notation(o));
    expect_equal(read_notation(notation(o)), o);
  }
}

TEST(Notation, OfTheThreadedSpindleReadsAsADrawingDoes) {
  const auto o = reference::outlines().at("threaded-spindle");
  EXPECT_EQ(notation(o),
            "name: Threaded spindle with run-out groove and fillet\n"
            "material: C45\n"
            "general: ISO 2768-mK\n"
            "M24x1.5 6g x 25\n"
            "groove d21.7 x 4\n"
            "d30 k6 x 40 Ra0.8\n"
            "d40 h11 x 59\n"
            "arc d40-d28 x 6 R6 concave\n"
            "d28 h7 x 50 Ra1.6\n"
            "face left Ra3.2\n"
            "face right Ra3.2\n"
            "cylindricity d3 0.008\n"
            "total-radial-runout d3 to d6 0.02\n");
}

// Outlines of every shape, demand and feature, by chance.
class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}

  Outline outline() {
    Outline o;
    o.name = text();
    o.title = {text(), text(), text()};
    o.material = text();
    for (std::size_t n = count(1, 6); o.outer.size() < n;)
      o.outer.push_back(element("d" + std::to_string(o.outer.size() + 1)));
    for (std::size_t n = count(0, 4); o.inner.size() < n;) {
      o.inner.push_back(element("b" + std::to_string(o.inner.size() + 1)));
      if (one_in(2)) o.inner.back().from = part::End::left;
    }
    add_edges(o, "left");
    for (std::size_t i = 1; i < o.outer.size(); ++i)
      add_edges(o, o.outer[i - 1].id + '|' + o.outer[i].id);
    add_edges(o, "right");
    if (!o.inner.empty()) add_edges(o, "left|b1");
    if (o.inner.size() > 1) add_edges(o, "b1|b2");
    if (one_in(2)) o.faces.push_back({.id = "left", .demands = {.Ra_um = size()}});
    if (one_in(2)) o.faces.push_back({.id = "right", .demands = {.Rz_um = size()}});
    for (const auto& row : part::tolerance_kinds()) add_tolerance(o, row);
    for (std::size_t n = count(0, 3); o.milled.size() < n;) {
      using enum Milled::Kind;
      Milled m{.id = "m" + std::to_string(o.milled.size() + 1),
               .kind = one_in(3)   ? flat
                       : one_in(2) ? slot
                                   : keyway,
               .on = "d1",
               .z_mm = one_in(2) ? 0 : size(),
               .length_mm = size(),
               .depth_mm = size(),
               .count = one_in(3) ? 6 : 1,
               .angle_deg = one_in(2) ? 0 : -size()};
      if (m.kind != flat) m.width_mm = size();
      if (one_in(4)) make_cross_hole(m);
      o.milled.push_back(m);
    }
    return o;
  }

 private:
  void make_cross_hole(Milled& m) {
    m.kind = Milled::Kind::cross_hole;
    m.width_mm = size();
    m.length_mm = 0;
    if (one_in(2)) m.through = one_in(2) ? Milled::Through::wall : Milled::Through::part;
    if (m.through != Milled::Through::no) m.depth_mm = 0;
    if (one_in(3)) m.demands.fit = "H12";
  }
  std::size_t count(std::size_t least, std::size_t most) {
    return std::uniform_int_distribution<std::size_t>(least, most)(random_);
  }
  bool one_in(std::size_t n) { return count(1, n) == 1; }
  // Short decimals and numbers with all their digits, down to 1e-7.
  double size() {
    if (one_in(2)) return static_cast<double>(count(1, 999)) / 10;
    return std::pow(10.0, std::uniform_real_distribution<double>(-7, 1.9)(random_));
  }
  std::string text() {
    static const std::vector<std::string> kTexts{
        "",           "Pin", "a: b",       "Smith; Sons", "2\" pipe",
        "\"quoted\"", "\"",  "Welle Ø 40", " x "};
    return kTexts[count(0, kTexts.size() - 1)];
  }
  // A bore does not stay as the bar is, and only bores have holes.
  Element element(const std::string& id) {
    static constexpr Shape kAll[] = {Shape::cylinder, Shape::cone,   Shape::arc,
                                     Shape::groove,   Shape::thread, Shape::as_stock};
    Element e{.id = id, .shape = kAll[count(0, 5)], .length_mm = size()};
    if (id[0] == 'b' && e.shape == Shape::as_stock) e.shape = Shape::hole;
    e.left_mm = e.right_mm = size();
    if (e.shape == Shape::as_stock) {
      e.flats = one_in(2) ? 6 : one_in(2) ? 4 : 0;
      return e;
    }
    const bool sloped = e.shape == Shape::cone || e.shape == Shape::arc;
    if (sloped) e.right_mm = size();
    if (e.shape == Shape::arc) {
      e.radius_mm = size();
      e.convex = one_in(2);
    }
    if (e.shape == Shape::thread && one_in(2)) e.pitch_mm = size();
    if (!sloped && one_in(2)) e.demands.fit = e.shape == Shape::thread ? "6g" : "js7";
    if (!e.demands.fit && one_in(2)) e.demands.limits = limits();
    if (one_in(3)) e.demands.Ra_um = size();
    if (one_in(3)) e.demands.Rz_um = size();
    return e;
  }
  part::Limits limits() {
    const double x = size();
    if (one_in(4)) return {-x, x};
    if (one_in(3)) return {0, x};
    if (one_in(2)) return {-x, 0};
    return {-x - 1, -x};
  }
  void add_edges(Outline& o, const std::string& at) {
    if (one_in(4))
      o.edges.push_back({.at = at, .radius_mm = size()});
    else if (one_in(2))
      o.edges.push_back({.at = at,
                         .chamfer_mm = size(),
                         .angle_deg = static_cast<double>(count(1, 89))});
    const bool end = at.find("left") != at.npos || at.find("right") != at.npos;
    if (!end && one_in(3)) o.edges.push_back({.at = at, .fillet_mm = size()});
    if (one_in(3))
      o.edges.push_back({.at = at,
                         .undercut = one_in(2)   ? "E0.8x0.3"
                                     : one_in(2) ? "H1.2x0.3"
                                                 : "DIN 76-B"});
  }
  void add_tolerance(Outline& o, const part::ToleranceFacts& row) {
    if (one_in(2)) return;
    part::Tolerance t;
    t.id = "t" + std::to_string(o.tolerances.size() + 1);
    t.kind = row.kind;
    if (row.kind == part::ToleranceKind::length)
      t.between = {"left", "right"};
    else
      t.of = "d1";
    if (row.kind == part::ToleranceKind::length ||
        row.kind == part::ToleranceKind::diameter) {
      t.limits = limits();
      t.value_mm = t.limits->upper_mm - t.limits->lower_mm;
    } else {
      t.value_mm = static_cast<double>(count(1, 999)) / 1e4;
      if (row.datum != part::DatumFeature::none) t.datum = "right";
      if (o.outer.size() > 1 && !t.datum.empty() && one_in(3))
        t.datum = o.outer.back().id, t.common_datum = "d1";
    }
    o.tolerances.push_back(t);
  }

  std::mt19937 random_;
};

TEST(Notation, OfAnyOutlineIsReadBack) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    const Outline o = Chance(seed).outline();
    SCOPED_TRACE(notation(o));
    ASSERT_NO_THROW(expect_equal(read_notation(notation(o)), o));
    if (HasFailure()) break;
  }
}

// Whatever stands there, the answer is an outline or a list of at most 100 mistakes.
TEST(Notation, NeverFallsOverAnyText) {
  std::mt19937 random(7);
  const std::string pieces[] = {"d",  "50", "x",    " ",    ";", "\n",   ":",  "|",
                                "\"", "Ra", "bore", "left", "M", "1x45", "±",  "/",
                                "-",  "°",  "\xff", "E",    "R", "face", "to", "length"};
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (int k = 0; k < 12; ++k) text += pieces[random() % std::size(pieces)];
    mistakes(text);
  }
  std::string many;
  for (int i = 0; i < 5000; ++i) many += "d5O x 4;";
  const std::string said = mistakes(many);
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 99);
}

// An outer element of that shape would be refused by the planner, without a word of why.
TEST(Notation, AHoleStandsInABore) {
  EXPECT_EQ(mistakes("d30 x 50; hole d8 H7 x 20"),
            "notation: line 1, column 11: got \"hole\", expected a hole in a bore, like "
            "bore hole d8 x 30");
  EXPECT_EQ(read_notation("d30 x 50; bore hole d8 x 20").inner.at(0).shape, Shape::hole);
}

// Half a gigabyte of elements in a megabyte of text would be no part.
TEST(Notation, HasFiveThousandStatementsAtMost) {
  std::string many;
  for (int i = 0; i < 5000; ++i) many += "d5x4;";
  EXPECT_EQ(read_notation(many).outer.size(), 5000U);
  EXPECT_EQ(mistakes(many + ";\n d6x7"),
            "notation: line 2, column 2: got \"d6x7\", expected at most 5000 statements");
}

TEST(Notation, CentreHolesStandInTheEnds) {
  const auto o = read_notation("d30 x 40; centre right a4/8,5; Centre left B2.5/8");
  ASSERT_EQ(o.centre_holes.size(), 2U);
  EXPECT_EQ(o.centre_holes[0].at, part::End::right);
  EXPECT_EQ(o.centre_holes[0].designation, "A4/8,5");
  EXPECT_EQ(o.centre_holes[1].at, part::End::left);
  EXPECT_EQ(notation(o), "d30 x 40\ncentre right A4/8,5\ncentre left B2.5/8\n");
  auto named = o;
  named.centre_holes = {{part::End::right, "ISO 6411 - R 4/8.5"}};
  EXPECT_EQ(notation(named), "d30 x 40\ncentre right R4/8.5\n");
  EXPECT_THROW(read_notation("d30 x 40; centre A4/8.5"), InputError);
}

TEST(Notation, SeatsAreLeftForTheGrinder) {
  const auto o = read_notation("d30 k6 x 40 Ra0.4 grind0,3; cone d30-d20 x 10 grind 0.2");
  EXPECT_EQ(o.outer.at(0).demands.grinding_mm, 0.3);
  EXPECT_EQ(o.outer.at(1).demands.grinding_mm, 0.2);
  EXPECT_EQ(notation(o), "d30 k6 x 40 Ra0.4 grind0.3\ncone d30-d20 x 10 grind0.2\n");
  for (const char* text : {"M30x1.5 x 40 grind0.3", "d30 x 40 grind", "d30 x 40 grind6",
                           "d30 x 40 grind0.3 grind0.2"})
    EXPECT_THROW(read_notation(text), InputError) << text;
}

TEST(Notation, KnurlsStandAtOuterCylinders) {
  const auto o = read_notation("d30 x 20 rge1,2 Ra3.2; d20 x 30 RAA0.8");
  EXPECT_EQ(o.outer.at(0).knurl, "RGE1.2");
  EXPECT_EQ(o.outer.at(0).demands.Ra_um, 3.2);
  EXPECT_EQ(o.outer.at(1).knurl, "RAA0.8");
  EXPECT_EQ(notation(o), "d30 x 20 RGE1.2 Ra3.2\nd20 x 30 RAA0.8\n");
  for (const char* text : {"d30 x 40 RAA0.7", "d30 x 40 RAA0.8 RAA1", "M30 x 40 RAA0.8",
                           "d30 x 40; bore d20 x 10 RAA0.8"})
    EXPECT_THROW(read_notation(text), InputError) << text;
}

}  // namespace
}  // namespace turnwright::exchange
