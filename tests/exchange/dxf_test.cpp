#include "turnwright/exchange/dxf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>
#include <stop_token>

#include "reference_outlines.hpp"
#include "same_outline.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/exchange/notation.hpp"

namespace turnwright::exchange {
namespace {

using compared::expect_same;

std::string dxf_file(const std::string& name) {
  std::ifstream in(TURNWRIGHT_SOURCE_DIR "/tests/data/dxf/" + name + ".dxf");
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

std::string told(const std::vector<Remark>& remarks) {
  std::string out;
  for (const Remark& r : remarks) out += r.at + ": " + r.text + '\n';
  return out;
}

// A drawing shows a thread as a cylinder of its nominal diameter.
Outline as_drawn(Outline o) {
  for (auto* list : {&o.outer, &o.inner})
    for (Element& e : *list)
      if (e.shape == Shape::thread) e.shape = Shape::cylinder;
  return o;
}

class ReferencePart : public testing::TestWithParam<const char*> {};

TEST_P(ReferencePart, IsReadFromItsDrawing) {
  for (const auto& [name, o] : reference::outlines()) {
    SCOPED_TRACE(name + GetParam());
    Outline read;
    ASSERT_NO_THROW(
        try {
          read = read_dxf(dxf_file(name + GetParam()));
        } catch (const InputError& e) {
          ADD_FAILURE() << e.what();
          throw;
        });
    SCOPED_TRACE(told(read.assumed) + told(read.ignored) + notation(read));
    expect_same(read, as_drawn(o));
  }
}
INSTANTIATE_TEST_SUITE_P(Dxf, ReferencePart, testing::Values("-half", "-full"));

TEST(Dxf, WhatStandardsDescribeIsKnownByItsSizes) {
  for (const auto& [name, drawn] : reference::outlines(reference::kFeatures))
    for (const char* view : {"-half", "-full"}) {
      SCOPED_TRACE(name + view);
      expect_same(read_dxf(dxf_file(name + view)), drawn);
    }
}

TEST(Dxf, AnUndercutOfAnotherPitchIsTold) {
  std::string text = dxf_file("threaded-shaft-half");
  const std::string note = "M24x1.5";
  text.replace(text.rfind(note), note.size(), "M24x2");
  const Outline o = read_dxf(text);
  EXPECT_EQ(o.outer[0].pitch_mm, 2);
  EXPECT_EQ(o.edges.size(), 3u);
  EXPECT_NE(
      told(o.ignored).find("The undercut at d1|d2 is left out: it is the DIN 76-A of a "
                           "thread with a pitch of 1.5 mm, and d1 has a pitch of 2 mm."),
      std::string::npos);
}

// The parts of write_dxf.py that are no reference parts.
Outline shaft() {
  return read_notation("1x45; d30 x 30; R0.8; d50 x 40; d24 x 25; 1.5x45");
}
Outline bush() {
  return read_notation("d60 x 20; d45 x 30; bore d30 x 35; bore d20 x 15");
}

class Shaft : public testing::TestWithParam<const char*> {};

TEST_P(Shaft, IsReadHoweverItIsWritten) {
  expect_same(read_dxf(dxf_file(GetParam())), shaft());
}
INSTANTIATE_TEST_SUITE_P(Dxf, Shaft,
                         testing::Values("blocks", "old-polyline", "seen-from-behind"));

TEST(Dxf, HalfSectionGivesItsBoreFromTheHalfThatShowsIt) {
  const Outline o = read_dxf(dxf_file("half-section"));
  expect_same(o, bush());
  EXPECT_EQ(told(o.ignored), ": 1 x HATCH: not read.\n");
}

class Dimensioned : public testing::TestWithParam<const char*> {};

TEST_P(Dimensioned, GivesItsElementsWhatTheDimensionsSay) {
  const Outline o = read_dxf(dxf_file(GetParam()));
  SCOPED_TRACE(told(o.ignored));
  ASSERT_EQ(o.outer.size(), 3u);
  EXPECT_EQ(o.outer[0].demands.fit, "k6");
  ASSERT_TRUE(o.outer[1].demands.limits);
  EXPECT_NEAR(o.outer[1].demands.limits->upper_mm, 0.02, 1e-9);
  EXPECT_NEAR(o.outer[1].demands.limits->lower_mm, -0.01, 1e-9);
  EXPECT_EQ(o.outer[2].shape, Shape::thread);
  EXPECT_EQ(o.outer[2].pitch_mm, 1.5);
  EXPECT_EQ(o.outer[2].demands.fit, "6g");
  EXPECT_EQ(o.outer[2].demands.Ra_um, 1.6);
  ASSERT_EQ(o.tolerances.size(), 2u);
  EXPECT_EQ(o.tolerances[0].between[0], "left");
  EXPECT_EQ(o.tolerances[0].between[1], "d1|d2");
  EXPECT_NEAR(o.tolerances[0].limits->upper_mm, 0.1, 1e-9);
  EXPECT_NEAR(o.tolerances[0].limits->lower_mm, -0.05, 1e-9);
  EXPECT_EQ(o.tolerances[1].between[0], "d2|d3");
  EXPECT_EQ(o.tolerances[1].between[1], "right");
  EXPECT_NEAR(o.tolerances[1].limits->upper_mm, 0.2, 1e-9);
  EXPECT_EQ(o.general, "ISO 2768-mK");
  const std::string ignored = told(o.ignored);
  EXPECT_NE(ignored.find("\"<> +0.1/0\" does not measure between two faces"),
            std::string::npos);
  EXPECT_NE(ignored.find("\"Ø26 h7\" does not say the drawn size, 24 mm"),
            std::string::npos);
  EXPECT_NE(ignored.find("The text \"Ra 3,2\""), std::string::npos);
  EXPECT_EQ(o.ignored.size(), 4u);  // and the circle of the view from the end
}
INSTANTIATE_TEST_SUITE_P(Dxf, Dimensioned,
                         testing::Values("dimensions", "dimensions-inch"));

// A drawing written by hand, entity by entity.
class Sheet {
 public:
  Sheet& group(int code, const std::string& value) {
    text_ += std::to_string(code) + '\n' + value + '\n';
    return *this;
  }
  Sheet& group(int code, double value) {
    std::ostringstream digits;
    digits.precision(17);
    digits << value;
    return group(code, digits.str());
  }
  Sheet& line(double x0, double y0, double x1, double y1, const char* layer = "0",
              const char* linetype = "BYLAYER") {
    group(0, "LINE").group(8, layer).group(6, linetype);
    return group(10, x0).group(20, y0).group(11, x1).group(21, y1);
  }
  Sheet& lines(const std::vector<std::pair<double, double>>& points) {
    for (std::size_t i = 1; i < points.size(); ++i)
      line(points[i - 1].first, points[i - 1].second, points[i].first, points[i].second);
    return *this;
  }
  Sheet& axis(double x0, double x1, double y = 0) {
    return line(x0, y, x1, y, "0", "CENTER");
  }
  std::string text() const {
    return before_ + "0\nSECTION\n2\nENTITIES\n" + text_ + "0\nENDSEC\n0\nEOF\n";
  }
  std::string entities() const { return text_; }
  Sheet& before(const std::string& sections) {
    before_ += sections;
    return *this;
  }

 private:
  std::string before_ = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n", text_;
};

std::string dxf_refusal(const std::string& text, const DxfOptions& options = {}) {
  try {
    return "read as " + notation(read_dxf(text, options));
  } catch (const InputError& e) {
    return e.what();
  }
}

Outline pin() { return read_notation("d20 x 30; d40 x 10"); }
const std::vector<std::pair<double, double>> kPin{{0, 0},   {0, 10},  {30, 10},
                                                  {30, 20}, {40, 20}, {40, 0}};

TEST(Dxf, TakesLinesInAnyOrderAndDirectionTwiceAndInPieces) {
  Sheet s;
  s.line(40, 20, 30, 20).line(0, 10, 12, 10).line(30, 10, 12, 10).line(0, 0, 0, 10);
  s.line(40, 0, 40, 20).line(30, 20, 30, 10).line(40, 20, 30, 20).line(5, 10, 25, 10);
  expect_same(read_dxf(s.text()), pin());
}

TEST(Dxf, ShoulderLinesAcrossAFullProfileAreUnderstood) {
  Sheet s;
  s.axis(-5, 45).lines(kPin).line(30, 20, 30, -20).line(0, 0, 0, -10);
  s.line(0, -10, 30, -10).line(30, -20, 40, -20).line(40, -20, 40, 0);
  const Outline o = read_dxf(s.text());
  expect_same(o, pin());
  EXPECT_TRUE(o.ignored.empty()) << told(o.ignored);
}

TEST(Dxf, SymmetryIsTheAxisOfAFullProfileWithoutACentreLine) {
  Sheet s;
  for (const double side : {1.0, -1.0})
    s.line(7, 50, 7, 50 + side * 10)
        .line(7, 50 + side * 10, 37, 50 + side * 10)
        .line(37, 50 + side * 10, 37, 50 + side * 20)
        .line(37, 50 + side * 20, 47, 50 + side * 20)
        .line(47, 50 + side * 20, 47, 50);
  const Outline o = read_dxf(s.text());
  expect_same(o, pin());
  EXPECT_NE(told(o.assumed).find("the axis of its symmetry"), std::string::npos);
}

// Half of the drawing is the section of a bore with many lines, half is seen from outside:
// fewer than half of the lines have a mirror image, but there is a centre line.
TEST(Dxf, ADrawnCentreLineIsTheAxisOfAHalfSection) {
  Sheet s;
  s.axis(-5, 65).lines({{0, 0}, {0, 30}, {60, 30}, {60, 0}});
  s.lines({{0, -24}, {0, -30}, {60, -30}, {60, -12}});
  s.lines({{60, -12},
           {45, -12},
           {45, -15},
           {30, -15},
           {30, -18},
           {20, -18},
           {20, -21},
           {10, -21},
           {10, -24},
           {0, -24}});
  expect_same(
      read_dxf(s.text()),
      read_notation("d60 x 60; bore d24 x 15; bore left d48 x 10; bore left d42 x 10; "
                    "bore left d36 x 10; bore left d30 x 15"));
}

// The sections of a ring lie on either side of its axis, whichever way it is drawn.
TEST(Dxf, ARingWithoutACentreLineTurnsAboutItsBore) {
  const Outline ring = read_notation("d50 x 20; bore d30 x 20");
  Sheet level, upright;
  for (const double side : {1.0, -1.0}) {
    level.lines({{0, side * 15}, {0, side * 25}, {20, side * 25}, {20, side * 15}});
    level.line(0, side * 15, 20, side * 15);
    upright.lines({{side * 15, 0}, {side * 25, 0}, {side * 25, 20}, {side * 15, 20}});
    upright.line(side * 15, 0, side * 15, 20);
  }
  expect_same(read_dxf(level.text()), ring);
  expect_same(read_dxf(upright.text()), ring);
}

TEST(Dxf, AnInchThreadOfADimensionIsInMillimetres) {
  Sheet s;
  s.lines({{0, 0}, {0, 6.35}, {25, 6.35}, {25, 20}, {40, 20}, {40, 0}});
  s.group(0, "DIMENSION").group(8, "0").group(70, "0").group(1, "1/2-13 UNC-2A Ra3.2");
  s.group(50, 90.0).group(13, 10.0).group(23, -6.35).group(14, 10.0).group(24, 6.35);
  const Outline o = read_dxf(s.text());
  ASSERT_EQ(o.outer.size(), 2u);
  EXPECT_EQ(o.outer[0].shape, Shape::thread) << told(o.ignored);
  EXPECT_EQ(o.outer[0].pitch_mm, 25.4 / 13);
  EXPECT_EQ(o.outer[0].demands.fit, "2A");
  EXPECT_EQ(o.outer[0].demands.Ra_um, 3.2);
}

TEST(Dxf, InvisibleEntitiesAreNotThere) {
  Sheet s;
  s.lines(kPin).line(30, 20, 30, 27).group(60, "1");
  const Outline o = read_dxf(s.text());
  expect_same(o, pin());
  EXPECT_EQ(told(o.ignored), ": 1 x invisible entity: not read.\n");
}

TEST(Dxf, UprightDrawingBeginsBelow) {
  Sheet s;
  for (std::size_t i = 1; i < kPin.size(); ++i)
    s.line(-kPin[i - 1].second, kPin[i - 1].first, -kPin[i].second, kPin[i].first);
  expect_same(read_dxf(s.text()), pin());
}

TEST(Dxf, SmallGapIsClosedAndTold) {
  Sheet s;
  s.lines({{0, 0}, {0, 10}, {29.9996, 10}});
  s.lines({{30, 10.0003}, {30, 20}, {40, 20}, {40, 0}});
  const Outline o = read_dxf(s.text());
  expect_same(o, pin());
  EXPECT_NE(told(o.assumed).find("A gap of 0.0005 mm at x = 30, y = 10.0003 was closed"),
            std::string::npos)
      << told(o.assumed);
}

TEST(Dxf, LargeGapAndABranchAreNamedByTheirPlaces) {
  Sheet gap;
  gap.axis(-5, 45).lines({{0, 0}, {0, 10}, {29, 10}});
  gap.lines({{30, 10}, {30, 20}, {40, 20}, {40, 0}});
  const std::string said = dxf_refusal(gap.text());
  EXPECT_NE(said.find("x = 29, y = 10"), std::string::npos) << said;
  EXPECT_NE(said.find("x = 30, y = 10"), std::string::npos) << said;
  Sheet branch;
  branch.lines(kPin).line(30, 20, 30, 27);
  EXPECT_NE(dxf_refusal(branch.text()).find("LINE of line 86 at x = 30, y = 27"),
            std::string::npos)
      << dxf_refusal(branch.text());
}

TEST(Dxf, HalvesThatDifferAreNamedByThePlace) {
  Sheet s;
  s.axis(-5, 45).lines(kPin).lines({{0, 0}, {0, -10}, {28, -10}, {28, -20}});
  s.lines({{28, -20}, {40, -20}, {40, 0}});
  const std::string said = dxf_refusal(s.text());
  EXPECT_NE(said.find("two halves whose outsides differ at x = "), std::string::npos)
      << said;
}

TEST(Dxf, HalvesThatDifferAtTheLeftEndAreNamedToo) {
  Sheet s;  // chamfered above alone
  s.axis(-5, 45).lines({{0, 0}, {0, 8}, {2, 10}, {30, 10}, {30, 20}, {40, 20}, {40, 0}});
  s.lines({{0, 0}, {0, -10}, {30, -10}, {30, -20}, {40, -20}, {40, 0}});
  const std::string said = dxf_refusal(s.text());
  EXPECT_NE(said.find("two halves whose outsides differ at x = "), std::string::npos)
      << said;
}

// A dimension of the pin's first diameter, with what it changes of its style.
Sheet dimensioned(const std::string& style, std::optional<double> factor = {}) {
  Sheet s;
  s.lines(kPin).group(0, "DIMENSION").group(8, "0").group(3, style).group(70, "0");
  s.group(13, 10.0).group(23, 10.0).group(14, 10.0).group(24, 0.0);
  if (factor)
    s.group(1001, "ACAD").group(1000, "DSTYLE").group(1002, "{").group(1070, "144");
  if (factor) s.group(1040, *factor).group(1002, "}");
  return s;
}
constexpr const char* kStyles =
    "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nDIMSTYLE\n0\nDIMSTYLE\n2\nhalf\n144\n0.5\n"
    "0\nDIMSTYLE\n2\ntight\n71\n1\n0\nENDTAB\n0\nENDSEC\n";

TEST(Dxf, APartDrawnAtAScaleIsRefused) {
  const auto refused = [](Sheet s) { return dxf_refusal(s.before(kStyles).text()); };
  EXPECT_NE(refused(dimensioned("half")).find("0.5 times what is drawn (DIMLFAC)"),
            std::string::npos);
  EXPECT_NE(refused(dimensioned("tight", 2.0)).find("2 times what is drawn"),
            std::string::npos);
  EXPECT_EQ(refused(dimensioned("half", 1.0)).find("DIMLFAC"), std::string::npos);
}

TEST(Dxf, LimitsOfAStyleAreTold) {
  const Outline o = read_dxf(dimensioned("tight").before(kStyles).text());
  EXPECT_NE(
      told(o.ignored).find("The dimension style TIGHT adds limits to its dimensions"),
      std::string::npos)
      << told(o.ignored);
}

TEST(Dxf, HiddenBlindBoreWithTheDrillsPointIsABore) {
  Sheet s;
  s.axis(-5, 45).lines(kPin).line(30, 10, 30, 0);
  const auto hidden = [&s](double x0, double y0, double x1, double y1) {
    s.line(x0, y0, x1, y1, "0", "HIDDEN");
  };
  hidden(40, 5, 20, 5);
  hidden(20, 5, 20, 0);
  hidden(20, 5, 20 - 5 / std::sqrt(3.0), 0);
  const Outline o = read_dxf(s.text());
  expect_same(o, read_notation("d20 x 30; d40 x 10; bore d10 x 20"));
  EXPECT_NE(told(o.assumed).find("left to the drill's point"), std::string::npos);
}

TEST(Dxf, LinesOfAnOuterThreadAreNoBore) {
  Sheet s;  // core line, and the end of the thread across the part
  s.axis(-5, 45).lines(kPin).line(0, 9, 20, 9).line(20, 10, 20, 0).line(30, 10, 30, 0);
  const Outline o = read_dxf(s.text());
  expect_same(o, pin());
  EXPECT_NE(told(o.ignored).find("A line inside the contour that is no bore"),
            std::string::npos);
}

TEST(Dxf, BoresOfBothEndsAreReadFromTheirs) {
  Sheet s;  // a section: no end face inside of the mouths
  s.axis(-5, 65).lines({{0, 8}, {0, 25}, {60, 25}, {60, 12}, {35, 12}, {35, 0}});
  s.lines({{0, 8}, {20, 8}, {20, 0}});
  expect_same(read_dxf(s.text()),
              read_notation("d50 x 60; bore d24 x 25; bore left d16 x 20"));
}

TEST(Dxf, OtherViewsAndFramesBeyondTheCentreLineAreLeftOut) {
  Sheet s;
  s.axis(-5, 45).lines(kPin).lines({{100, 0}, {100, 20}, {120, 20}, {120, 0}});
  s.line(-50, -90, 200, -90).line(-50, 90, 200, 90).line(-50, -90, -50, 90);
  expect_same(read_dxf(s.text()), pin());
}

TEST(Dxf, LayersSayWhatIsNoContour) {
  Sheet s;
  s.before(
      "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n0\nLAYER\n2\nOLD\n70\n1\n62\n7\n6\n"
      "CONTINUOUS\n0\nLAYER\n2\nSPARE\n70\n0\n62\n-"
      "7\n6\nCONTINUOUS\n0\nLAYER\n2\nFINE\n70\n"
      "0\n62\n7\n6\nCENTER2\n0\nENDTAB\n0\nENDSEC\n");
  s.lines(kPin).line(0, 15, 50, 15, "OLD").line(0, 15, 50, 15, "spare");
  s.line(-3, 0, 43, 0, "Fine")
      .line(0, 60, 50, 60, "Bemassung")
      .line(0, 50, 9, 50, "Rahmen");
  expect_same(read_dxf(s.text()), pin());
}

TEST(Dxf, UnitIsToldWhereTheFileIsSilent) {
  Sheet s;
  s.lines(kPin);
  std::string text = s.text();
  text = text.substr(text.find("0\nSECTION\n2\nENTITIES"));
  const Outline mm = read_dxf(text);
  expect_same(mm, pin());
  EXPECT_NE(told(mm.assumed).find("it is taken to be in mm"), std::string::npos);
  const Outline inch =
      read_dxf("0\nSECTION\n2\nHEADER\n9\n$MEASUREMENT\n70\n0\n0\nENDSEC\n" + text);
  EXPECT_NEAR(inch.outer[0].left_mm, 20 * 25.4, 1e-9);
  const Outline given = read_dxf(text, {.join_mm = 1e-3, .unit_mm = 10});
  EXPECT_NEAR(given.outer[0].left_mm, 200, 1e-9);
  EXPECT_EQ(told(given.assumed).find("taken to be in mm"), std::string::npos);
}

TEST(Dxf, RefusesWhatItCannotReadByName) {
  const auto with = [](const char* type) {
    Sheet s;
    s.lines(kPin).group(0, type).group(5, "2F").group(8, "0");
    return dxf_refusal(s.text());
  };
  EXPECT_NE(with("SPLINE").find("SPLINE 2F: got SPLINE in the contour"),
            std::string::npos);
  EXPECT_NE(with("ELLIPSE").find("ELLIPSE 2F"), std::string::npos);
  EXPECT_NE(with("ARC").find("ARC 2F: got an arc without a radius"), std::string::npos);
  EXPECT_NE(with("INSERT").find("INSERT 2F: got no block"), std::string::npos);
  EXPECT_NE(dxf_refusal("AutoCAD Binary DXF\r\n\x1a\0").find("a binary DXF file"),
            std::string::npos);
  EXPECT_NE(dxf_refusal("AC1027\0\0").find("a DWG file"), std::string::npos);
  EXPECT_NE(dxf_refusal("").find("no section ENTITIES"), std::string::npos);
  EXPECT_NE(
      dxf_refusal("hello\nworld\n").find("line 1: got \"hello\", expected a group code"),
      std::string::npos);
  EXPECT_NE(
      dxf_refusal("0\nSECTION\n2\nENTITIES\n0\nLINE\n10\n").find("a group code without"),
      std::string::npos);
  EXPECT_NE(dxf_refusal("0\nSECTION\n2\nENTITIES\n0\nLINE\n10\n1\n").find("breaks off"),
            std::string::npos);
  Sheet nan, far, none, away;
  nan.lines(kPin).group(0, "LINE").group(10, "nan");
  EXPECT_NE(dxf_refusal(nan.text()).find("got \"nan\", expected a number"),
            std::string::npos);
  far.lines(kPin).line(0, 0, 1e300, 3);
  EXPECT_NE(dxf_refusal(far.text()).find("more than 10 km from the origin"),
            std::string::npos);
  EXPECT_NE(dxf_refusal(none.text()).find("no lines of a contour"), std::string::npos);
  away.lines({{5, 5}, {5, 10}, {30, 10}, {30, 17}, {40, 17}, {40, 5}, {5, 5}});
  EXPECT_NE(dxf_refusal(away.text()).find("no axis"), std::string::npos);
}

std::string block(const std::string& name, const std::string& entities) {
  return "0\nBLOCK\n2\n" + name + "\n10\n0\n20\n0\n" + entities + "0\nENDBLK\n";
}
std::string insert(const std::string& name) { return "0\nINSERT\n2\n" + name + "\n"; }
std::string blocks(const std::string& all) {
  return "0\nSECTION\n2\nBLOCKS\n" + all + "0\nENDSEC\n";
}

TEST(Dxf, BlocksWithinThemselvesDeepOrMultipliedEndInAMessage) {
  Sheet s;
  s.group(0, "INSERT").group(2, "A");
  const auto with = [&](const std::string& all) {
    Sheet sheet = s;
    return dxf_refusal(sheet.before(blocks(all)).text());
  };
  EXPECT_NE(with(block("A", insert("B")) + block("B", insert("a"))).find("within itself"),
            std::string::npos);
  std::string deep, many;
  for (int i = 0; i < 40; ++i)
    deep += block(i == 0 ? "A" : "N" + std::to_string(i),
                  insert("N" + std::to_string(i + 1)));
  EXPECT_NE(with(deep).find("nested more than 16 deep"), std::string::npos);
  for (int i = 0; i < 12; ++i) {  // 10^12 entities
    std::string ten;
    for (int k = 0; k < 10; ++k) ten += insert("N" + std::to_string(i + 1));
    many += block(i == 0 ? "A" : "N" + std::to_string(i), ten);
  }
  many += block("N12", "0\nPOINT\n10\n0\n");
  EXPECT_NE(with(many).find("more than 2000000 entities"), std::string::npos);
}

// From few entities, each of them as long as the file allows.
TEST(Dxf, BlocksDrawnOutAreBoundedInBytesToo) {
  Sheet s;
  s.group(0, "INSERT").group(2, "N6");
  const auto with = [&](const std::string& innermost) {
    std::string all = block("N0", innermost);
    for (int i = 1; i <= 6; ++i) {
      std::string eight;
      for (int k = 0; k < 8; ++k) eight += insert("N" + std::to_string(i - 1));
      all += block("N" + std::to_string(i), eight);
    }
    Sheet sheet = s;
    return dxf_refusal(sheet.before(blocks(all)).text());
  };
  const std::string bound = "more than 50 MB with the blocks drawn out";
  std::string groups;
  for (int i = 0; i < 2000; ++i) groups += "1000\n\n";
  EXPECT_NE(with("0\nPOINT\n8\n0\n" + groups).find(bound), std::string::npos);
  EXPECT_NE(with("0\nTEXT\n1\n" + std::string(9000, 'x') + "\n").find(bound),
            std::string::npos);
  // What is kept of each note and dimension counts, however short it is in the file.
  for (const char* kept : {"0\nTEXT\n", "0\nDIMENSION\n"}) {
    std::string twice;
    for (int i = 0; i < 4; ++i) twice += kept;
    EXPECT_NE(with(twice).find(bound), std::string::npos) << kept;
  }
}

TEST(Dxf, LongNamesOfLayersCountForEveryLineDrawnOut) {
  const std::string name(20000, 'x'), bound = "more than 50 MB with the blocks drawn out";
  std::string points;
  for (int i = 0; i < 3000; ++i) points += "0\nPOINT\n";
  const auto file_of = [](const std::string& sections, const std::string& entities) {
    return sections + "0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
  };
  const std::string of_block =
      file_of(blocks(block("A", points)), "0\nINSERT\n2\nA\n8\n" + name + "\n");
  EXPECT_NE(dxf_refusal(of_block).find(bound), std::string::npos);
  const std::string of_layer = file_of(
      "0\nSECTION\n2\nTABLES\n0\nLAYER\n2\n0\n6\n" + name + "\n0\nENDSEC\n", points);
  EXPECT_NE(dxf_refusal(of_layer).find(bound), std::string::npos);
}

TEST(Dxf, HearsThatNobodyWaits) {
  std::stop_source source;
  source.request_stop();
  const std::stop_token token = source.get_token();
  const Listening listening(token);
  EXPECT_THROW(read_dxf(dxf_file("motor-shaft-full")), Cancelled);
}

TEST(Dxf, MillionLinesEndInAMessageAndAMillionNotesInAnAnswer) {
  std::string lines, points;
  for (int i = 0; i < 1000000; ++i) {
    lines += "0\nLINE\n8\n0\n10\n" + std::to_string(i % 977) + "\n20\n1\n11\n5\n21\n2\n";
    points += "0\nPOINT\n8\n0\n10\n1\n";
  }
  Sheet pin_sheet;
  pin_sheet.lines(kPin);
  const auto file_of = [](const std::string& entities) {
    return "0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
  };
  EXPECT_NE(dxf_refusal(file_of(lines)).find("more than 5000 lines and arcs"),
            std::string::npos);
  expect_same(read_dxf(file_of(pin_sheet.entities() + points)), pin());
}

// Broken files: an outline or an InputError, nothing else.
TEST(Dxf, NeverFallsOverABrokenFile) {
  for (const char* name : {"motor-shaft-full", "dimensions", "blocks", "half-section"}) {
    const std::string whole = dxf_file(name);
    for (std::size_t n = 0; n < whole.size(); n += 37) dxf_refusal(whole.substr(0, n));
    std::mt19937 random(3);
    for (int i = 0; i < 400; ++i) {
      std::string changed = whole;
      for (int k = 0; k < 4; ++k)
        changed[random() % changed.size()] = "0123456789.-\nAE"[random() % 15];
      dxf_refusal(changed);
    }
  }
}

}  // namespace
}  // namespace turnwright::exchange
