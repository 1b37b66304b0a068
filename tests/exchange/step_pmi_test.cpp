#include "exchange/demands/step_pmi.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "step_file.hpp"

namespace turnwright::exchange {
namespace {

using Lines = std::vector<std::string>;

// d1 30 x 40, d2 50 x 30, a cone d3, a groove d4, a bore b1 from the right.  The faces are
// named after them: "#d1", "#left" ..
Outline toleranced_shaft() {
  Outline o;
  const auto element = [](const char* id, Shape shape, double l, double d) {
    return Element{.id = id,
                   .shape = shape,
                   .length_mm = l,
                   .left_mm = d,
                   .right_mm = d,
                   .sources = {std::string("#") + id}};
  };
  o.outer = {element("d1", Shape::cylinder, 40, 30),
             element("d2", Shape::cylinder, 30, 50), element("d3", Shape::cone, 20, 40),
             element("d4", Shape::groove, 3, 30)};
  o.outer[0].sources = {"#d1", "#d1b"};  // two halves
  o.inner = {element("b1", Shape::cylinder, 25, 20)};
  const auto face = [](const char* id) {
    return FaceOf{.id = id, .sources = {std::string("#") + id}};
  };
  o.faces = {face("left"), face("d1|d2"), face("right")};
  o.edges = {{.at = "left", .chamfer_mm = 1, .sources = {"#edge"}}};
  return o;
}

Feature on(const char* face) { return {.at = "#1", .faces = {face}}; }

GeometricTolerance tolerance(Symbol symbol, const char* face, const char* datum = "") {
  GeometricTolerance t{.at = "#9", .symbol = symbol, .width_mm = 0.02, .of = on(face)};
  if (*datum) t.datums = {{.letters = {datum}}};
  return t;
}

// Datum A on d1, B on the left end, D on d2.
Pmi with_datums() {
  Pmi pmi;
  pmi.datums = {{.at = "#2", .letter = "A", .of = on("#d1")},
                {.at = "#3", .letter = "B", .of = on("#left")},
                {.at = "#4", .letter = "D", .of = on("#d2")}};
  return pmi;
}

std::string text(const part::Tolerance& t) {
  auto out = fmt::format("{} {} ", t.id, part::name(t.kind));
  out += t.limits ? fmt::format("{}..{} {} {}", t.between[0], t.between[1],
                                t.limits->lower_mm, t.limits->upper_mm)
                  : fmt::format("{} {}", t.of, t.value_mm);
  return t.datum.empty() ? out : out + " to " + part::datum_words(t);
}

// Tolerances of the outline, then the remarks.
Lines lines(const Outline& o) {
  Lines all;
  for (const auto& t : o.tolerances) all.push_back(text(t));
  for (const auto& r : o.assumed) all.push_back(r.text);
  for (const auto& r : o.ignored) all.push_back(r.text);
  return all;
}

Lines lines(const GeometricTolerance& t) {
  auto pmi = with_datums();
  pmi.tolerances = {t};
  auto o = toleranced_shaft();
  add_pmi(pmi, o);
  return lines(o);
}

TEST(StepPmi, RunOutsAreRadialOnAnElementAndAxialOnAFace) {
  EXPECT_EQ(lines(tolerance(Symbol::circular_runout, "#d2", "A")),
            Lines{"t1 circular-radial-runout d2 0.02 to d1"});
  EXPECT_EQ(lines(tolerance(Symbol::circular_runout, "#d3", "A")),
            Lines{"t1 circular-radial-runout d3 0.02 to d1"});
  EXPECT_EQ(lines(tolerance(Symbol::circular_runout, "#d1|d2", "A")),
            Lines{"t1 circular-axial-runout d1|d2 0.02 to d1"});
  EXPECT_EQ(lines(tolerance(Symbol::total_runout, "#d2", "A")),
            Lines{"t1 total-radial-runout d2 0.02 to d1"});
  EXPECT_EQ(lines(tolerance(Symbol::total_runout, "#right", "A")),
            Lines{"t1 total-axial-runout right 0.02 to d1"});
}

TEST(StepPmi, EverySymbolHasItsKind) {
  EXPECT_EQ(lines(tolerance(Symbol::cylindricity, "#b1")),
            Lines{"t1 cylindricity b1 0.02"});
  EXPECT_EQ(lines(tolerance(Symbol::roundness, "#d3")), Lines{"t1 circularity d3 0.02"});
  EXPECT_EQ(lines(tolerance(Symbol::straightness, "#d1")),
            Lines{"t1 straightness d1 0.02"});
  EXPECT_EQ(lines(tolerance(Symbol::flatness, "#left")), Lines{"t1 flatness left 0.02"});
  EXPECT_EQ(lines(tolerance(Symbol::parallelism, "#right", "B")),
            Lines{"t1 parallelism right 0.02 to left"});
  EXPECT_EQ(lines(tolerance(Symbol::perpendicularity, "#right", "A")),
            Lines{"t1 perpendicularity right 0.02 to d1"});
  EXPECT_EQ(lines(tolerance(Symbol::perpendicularity, "#d2", "B")),
            Lines{"t1 perpendicularity d2 0.02 to left"});
  EXPECT_EQ(lines(tolerance(Symbol::angularity, "#d3", "A")),
            Lines{"t1 angularity d3 0.02 to d1"});
  EXPECT_EQ(lines(tolerance(Symbol::coaxiality, "#b1", "A")),
            Lines{"t1 coaxiality b1 0.02 to d1"});
  EXPECT_EQ(lines(tolerance(Symbol::concentricity, "#d2", "A")),
            Lines{"t1 coaxiality d2 0.02 to d1"});
  EXPECT_EQ(lines(tolerance(Symbol::surface_profile, "#d3", "A")),
            Lines{"t1 profile d3 0.02 to d1"});
  EXPECT_EQ(lines(tolerance(Symbol::line_profile, "#d3")),
            Lines{"t1 profile-without-datum d3 0.02"});
  auto position = tolerance(Symbol::position, "#b1", "A");
  position.diametral = true;
  EXPECT_EQ(lines(position), Lines{"t1 position b1 0.02 to d1"});
}

TEST(StepPmi, SplitFacesAreOneFeatureAndTwoFeaturesAreTwo) {
  auto t = tolerance(Symbol::roundness, "#d1");
  t.of.faces = {"#d1", "#d1b"};
  EXPECT_EQ(lines(t), Lines{"t1 circularity d1 0.02"});
  t.of.faces = {"#d2", "#d1b"};
  EXPECT_EQ(lines(t), (Lines{"t1 circularity d1 0.02", "t2 circularity d2 0.02"}));
}

TEST(StepPmi, ANoteMakesAThreadOfADiameter) {
  const auto with_note = [](const char* face, const char* note) {
    Pmi pmi;
    pmi.dimensions = {{.at = "#8",
                       .name = "diameter",
                       .nominal_mm = 30,
                       .notes = {note},
                       .of = on(face)}};
    pmi.tolerances = {tolerance(Symbol::roundness, face)};
    auto o = toleranced_shaft();
    add_pmi(pmi, o);
    return o;
  };
  const auto o = with_note("#d1", "M30x1.5-6g");
  EXPECT_EQ(o.outer[0].shape, Shape::thread);
  EXPECT_EQ(o.outer[0].pitch_mm, 1.5);
  EXPECT_EQ(o.outer[0].demands.fit, "6g");
  EXPECT_EQ(lines(o),
            Lines{"The roundness tolerance of 0.02 mm is left out: d1 is made at "
                  "fixed conditions."});
  EXPECT_EQ(with_note("#d1", "M30").outer[0].shape, Shape::thread);
  EXPECT_EQ(lines(with_note("#d2", "1-1/4-7 UNC")).back(),
            "The diameter 30 mm (1-1/4-7 UNC) is left out: d2 has a diameter of 50 mm.");
  EXPECT_EQ(lines(with_note("#left", "M30")).front(),
            "The diameter 30 mm (M30) is left out: a thread is of one cylinder.");
  EXPECT_EQ(with_note("#d1", "theoretical").outer[0].shape, Shape::cylinder);
}

TEST(StepPmi, ACommonDatumIsTheAxisOfTwoElements) {
  const auto common = [](Symbol symbol, const char* face,
                         std::vector<std::string> letters) {
    auto t = tolerance(symbol, face, "A");
    t.datums[0].letters = std::move(letters);
    return lines(t);
  };
  EXPECT_EQ(common(Symbol::circular_runout, "#d3", {"A", "D"}),
            Lines{"t1 circular-radial-runout d3 0.02 to d1-d2"});
  EXPECT_EQ(common(Symbol::total_runout, "#right", {"D", "A"}),
            Lines{"t1 total-axial-runout right 0.02 to d2-d1"});
  // The run-out of a seat to both seats.
  EXPECT_EQ(common(Symbol::circular_runout, "#d2", {"A", "D"}),
            Lines{"t1 circular-radial-runout d2 0.02 to d1-d2"});
  EXPECT_EQ(
      common(Symbol::circular_runout, "#d3", {"A", "B"}),
      Lines{"The circular run-out tolerance of 0.02 mm to A-B is left out: its datum "
            "is a cylinder or cone in a part document, and left is a face."});
  EXPECT_EQ(
      common(Symbol::surface_profile, "#d3", {"A", "B"}),
      Lines{"The surface profile tolerance of 0.02 mm to A-B is left out: its datum "
            "is a cylinder or cone in a part document, and left is a face."});
  EXPECT_EQ(common(Symbol::circular_runout, "#d3", {"A", "A"}),
            Lines{"The circular run-out tolerance of 0.02 mm to A-A is left out: both "
                  "elements of its common datum are d1."});
  EXPECT_EQ(
      common(Symbol::circular_runout, "#d3", {"A", "X"}),
      Lines{"The circular run-out tolerance of 0.02 mm to A-X is left out: the file "
            "has no datum X."});
}

TEST(StepPmi, WhatQualifiesAToleranceKeepsItOut) {
  auto modified = tolerance(Symbol::coaxiality, "#d2", "A");
  modified.modifiers = {"maximum material requirement"};
  EXPECT_EQ(
      lines(modified),
      Lines{"The coaxiality tolerance of 0.02 mm (maximum material requirement) to A "
            "is left out: a part document has no such modifier."});
  auto datum = tolerance(Symbol::coaxiality, "#d2", "A");
  datum.datums[0].modifiers = {"least material requirement"};
  EXPECT_EQ(
      lines(datum),
      Lines{"The coaxiality tolerance of 0.02 mm to A (least material requirement) is "
            "left out: a part document has no modifiers of datums."});
  auto two = tolerance(Symbol::surface_profile, "#d2", "A");
  two.datums.push_back({.letters = {"B"}});
  EXPECT_EQ(lines(two),
            Lines{"The surface profile tolerance of 0.02 mm to A, B is left out: "
                  "a part document has one datum, or the common one of two elements; A "
                  "is d1, B is left."});
}

// Reasons behind "is left out: ".
std::string reason(const GeometricTolerance& t) {
  const auto all = lines(t);
  EXPECT_EQ(all.size(), 1u);
  const auto at = all.front().find("left out: ");
  return at == std::string::npos ? all.front() : all.front().substr(at + 10);
}

TEST(StepPmi, TolerancesThatAPartDocumentLacksAreNamed) {
  EXPECT_EQ(reason(tolerance(Symbol::symmetry, "#d2", "A")),
            "a part document has no tolerance of this kind.");
  EXPECT_EQ(reason(tolerance(Symbol::flatness, "#d1")),
            "it is of a face in a part document, and d1 is a cylinder.");
  EXPECT_EQ(reason(tolerance(Symbol::cylindricity, "#d3")),
            "it is of a cylinder in a part document, and d3 is a cone.");
  EXPECT_EQ(reason(tolerance(Symbol::roundness, "#d4")),
            "d4 is made at fixed conditions.");
  EXPECT_EQ(reason(tolerance(Symbol::roundness, "#elsewhere")),
            "its feature is not in the outline.");
  EXPECT_EQ(
      reason(tolerance(Symbol::roundness, "#edge")),
      "it is of a cylinder or cone in a part document, and left is an edge or a milled "
      "place.");
  EXPECT_EQ(reason(tolerance(Symbol::position, "#d2", "A")),
            "a part document has the position of an axis, in a cylindrical zone.");
  auto axis = tolerance(Symbol::straightness, "#d1");
  axis.diametral = true;
  EXPECT_EQ(reason(axis),
            "a part document has it of a surface, not of an axis or median plane.");
}

TEST(StepPmi, DatumsThatCannotBeAreNamed) {
  EXPECT_EQ(reason(tolerance(Symbol::coaxiality, "#d2")), "it has no datum.");
  EXPECT_EQ(reason(tolerance(Symbol::roundness, "#d2", "A")),
            "it has no datum in a part document.");
  EXPECT_EQ(reason(tolerance(Symbol::coaxiality, "#d2", "X")),
            "the file has no datum X.");
  EXPECT_EQ(reason(tolerance(Symbol::coaxiality, "#d1", "A")), "its datum is d1 itself.");
  EXPECT_EQ(reason(tolerance(Symbol::coaxiality, "#d1", "B")),
            "its datum is a cylinder or cone in a part document, and left is a face.");
  auto pmi = with_datums();
  pmi.datums[0].targets = true;
  pmi.datums[1].of.faces = {"#left", "#right"};
  pmi.datums[2].of.faces = {"#elsewhere"};
  pmi.tolerances = {tolerance(Symbol::coaxiality, "#b1", "A"),
                    tolerance(Symbol::parallelism, "#d1|d2", "B"),
                    tolerance(Symbol::coaxiality, "#b1", "D")};
  auto o = toleranced_shaft();
  add_pmi(pmi, o);
  ASSERT_EQ(o.ignored.size(), 3u);
  EXPECT_NE(o.ignored[0].text.find("datum A is made of datum targets"),
            std::string::npos);
  EXPECT_NE(o.ignored[1].text.find("datum B is on more than one feature: left, right"),
            std::string::npos);
  EXPECT_NE(o.ignored[2].text.find("datum D is not in the outline"), std::string::npos);
  EXPECT_EQ(o.ignored[2].at, "#9");
}

TEST(StepPmi, ValuesThatNoDocumentTakesAreNamed) {
  auto t = tolerance(Symbol::roundness, "#d1");
  for (const double width : {0.0, -0.02, 10.5, std::nan("")}) {
    t.width_mm = width;
    EXPECT_EQ(reason(t), "a part document has values > 0 and up to 10 mm.") << width;
  }
  t.width_mm = std::nullopt;
  EXPECT_EQ(reason(t), "the file gives no value.");
}

Dimension diameter(const char* face, double nominal_mm, double lower_mm,
                   double upper_mm) {
  return {.at = "#8",
          .name = "diameter",
          .nominal_mm = nominal_mm,
          .limits = part::Limits{lower_mm, upper_mm},
          .of = on(face)};
}

Outline with(const Dimension& d) {
  Pmi pmi;
  pmi.dimensions = {d};
  auto o = toleranced_shaft();
  add_pmi(pmi, o);
  return o;
}

TEST(StepPmi, DiametersGiveLimitsOrFits) {
  const auto o = with(diameter("#d1", 30, -0.1, 0.05));
  ASSERT_TRUE(o.outer[0].demands.limits);
  EXPECT_EQ(o.outer[0].demands.limits->lower_mm, -0.1);
  EXPECT_EQ(o.outer[0].demands.limits->upper_mm, 0.05);
  EXPECT_TRUE(o.ignored.empty());
  auto fit = diameter("#b1", 20, 0, 0);
  fit.limits = {};
  fit.fit = "H7";
  EXPECT_EQ(with(fit).inner[0].demands.fit, "H7");
  fit.fit = "h7";
  EXPECT_FALSE(with(fit).inner[0].demands.fit);
  EXPECT_EQ(with(fit).ignored.size(), 1u);
}

// Modelled at 29.9 where the drawing says 30 -0.2/0: the limits of size stay 29.8 and 30.
TEST(StepPmi, LimitsStayLimitsOfSize) {
  auto shape = toleranced_shaft();
  shape.outer[0].left_mm = shape.outer[0].right_mm = 29.9;
  Pmi pmi;
  pmi.dimensions = {diameter("#d1", 30, -0.2, 0)};
  add_pmi(pmi, shape);
  ASSERT_TRUE(shape.outer[0].demands.limits);
  EXPECT_NEAR(shape.outer[0].demands.limits->lower_mm, 29.8 - 29.9, 1e-12);
  EXPECT_NEAR(shape.outer[0].demands.limits->upper_mm, 30 - 29.9, 1e-12);
  EXPECT_TRUE(shape.ignored.empty());
  EXPECT_EQ(
      lines(with(diameter("#d1", 31, -0.2, 0))),
      Lines{"The diameter 31 mm +0/-0.2 mm is left out: the shape has 30 mm there, not "
            "31 mm."});
}

TEST(StepPmi, DistancesBetweenFacesAreLengths) {
  auto d = diameter("#right", 93, -0.2, 0.3);
  d.name = "linear distance";
  d.to = on("#left");
  EXPECT_EQ(lines(with(d)), Lines{"t1 length left..right -0.2 0.3"});
  d = diameter("#d1|d2", 40, -0.1, 0.1);
  d.name = "linear distance";
  d.to = on("#left");
  EXPECT_EQ(lines(with(d)), Lines{"t1 length left..d1|d2 -0.1 0.1"});
  d.nominal_mm = 41;
  EXPECT_EQ(with(d).ignored.size(), 1u);
  auto thickness = diameter("#left", 93, -0.2, 0.3);
  thickness.name = "thickness";
  thickness.of.faces = {"#right", "#left"};
  EXPECT_EQ(lines(with(thickness)), Lines{"t1 length left..right -0.2 0.3"});
}

TEST(StepPmi, SizesThatAPartDocumentLacksAreNamed) {
  auto d = diameter("#d1", 30, -0.1, 0.1);
  d.to = on("#left");
  EXPECT_EQ(lines(with(d)),
            Lines{"The diameter 30 mm +0.1/-0.1 mm is left out: it is not "
                  "between two faces of the outline."});
  d = diameter("#d1", 15, -0.1, 0.1);
  d.name = "radius";
  EXPECT_EQ(lines(with(d)), Lines{"The radius 15 mm +0.1/-0.1 mm is left out: a part "
                                  "document has tolerances of diameters, not of radii."});
  d = diameter("#d1", 30, -0.1, 0.1);
  d.notes = {"statistical"};
  EXPECT_EQ(lines(with(d)), Lines{"The diameter 30 mm +0.1/-0.1 mm (statistical) is left "
                                  "out: a part document has no such modifier."});
  EXPECT_EQ(lines(with(diameter("#d3", 40, -0.1, 0.1))).size(), 1u);
  EXPECT_EQ(lines(with(diameter("#left", 40, -0.1, 0.1))).size(), 1u);
  EXPECT_EQ(lines(with(diameter("#d1", 30, 0.1, 0.1))).size(), 1u);
  EXPECT_EQ(lines(with(diameter("#d1", 30, -40, -30))).size(), 1u);
  EXPECT_EQ(lines(with(diameter("#d1", 30, -1, 200))).size(), 1u);
}

TEST(StepPmi, BasicSizesAreCountedTogether) {
  auto d = diameter("#d1", 30, -0.1, 0.1);
  d.notes = {"theoretical"};
  Pmi pmi;
  pmi.dimensions = {d,
                    {.at = "#7", .name = "diameter", .nominal_mm = 50, .of = on("#d2")}};
  auto o = toleranced_shaft();
  add_pmi(pmi, o);
  EXPECT_EQ(lines(o),
            Lines{"2 dimensions are without a tolerance: the shape has the size."});
  EXPECT_FALSE(o.outer[0].demands.limits);
}

TEST(StepPmi, SecondToleranceOfADiameterIsNamed) {
  Pmi pmi;
  pmi.dimensions = {diameter("#d1", 30, -0.1, 0.1), diameter("#d1b", 30, -0.2, 0.2)};
  auto o = toleranced_shaft();
  add_pmi(pmi, o);
  EXPECT_EQ(o.outer[0].demands.limits->upper_mm, 0.1);
  EXPECT_EQ(o.ignored.size(), 1u);
}

TEST(StepPmi, RoughnessIsADemandOfItsSurface) {
  Pmi pmi;
  pmi.textures = {{.at = "#6", .parameter = "Ra", .value_um = 1.6, .of = on("#d1")},
                  {.at = "#6", .parameter = "Rz", .value_um = 25, .of = on("#left")},
                  {.at = "#6", .parameter = "Ra", .value_um = 0.8, .of = on("#b1")},
                  {.at = "#6", .parameter = "Ra", .value_um = 1600, .of = on("#d2")},
                  {.at = "#6", .parameter = "Rmr", .value_um = 1, .of = on("#d2")},
                  {.at = "#6", .parameter = "Ra", .value_um = 1, .of = on("#edge")},
                  {.at = "#6", .parameter = "Ra", .value_um = 1, .of = on("#elsewhere")}};
  auto o = toleranced_shaft();
  add_pmi(pmi, o);
  EXPECT_EQ(o.outer[0].demands.Ra_um, 1.6);
  EXPECT_EQ(o.faces[0].demands.Rz_um, 25);
  EXPECT_EQ(o.inner[0].demands.Ra_um, 0.8);
  EXPECT_FALSE(o.outer[1].demands.Ra_um);
  EXPECT_EQ(o.ignored.size(), 4u);
}

TEST(StepPmi, TitleMaterialAndGeneralTolerancesAreFilledIn) {
  Pmi pmi;
  pmi.part_number = "4711-08";
  pmi.part_name = "shaft";
  pmi.revision = "C";
  pmi.material = "C45";
  auto o = toleranced_shaft();
  o.title.revision = "D";  // known already
  add_pmi(pmi, o);
  EXPECT_EQ(o.title.drawing_number, "4711-08");
  pmi.part_number = pmi.part_name;  // the name of a model is no number of a drawing
  auto unnumbered = toleranced_shaft();
  add_pmi(pmi, unnumbered);
  EXPECT_EQ(unnumbered.title.drawing_number, "");
  EXPECT_EQ(o.title.revision, "D");
  EXPECT_EQ(o.name, "shaft");
  EXPECT_EQ(o.material, "C45");
  const std::vector<std::pair<std::string, std::string>> notes{
      {"General tolerances ISO 2768-mK", "ISO 2768-mK"},
      {"DIN ISO 2768 - m", "ISO 2768-m"},
      {"ISO 2768-1-f", "ISO 2768-f"},
      {"tolerances to ISO 2768 mK unless noted", "ISO 2768-mK"},
      {"ISO 2768-2: K", "ISO 2768-K"},
      {"ISO 2768 medium", ""},
      {"ISO 2768", ""},
      {"part 27681", ""},
      {"sharp edges broken", ""}};
  for (const auto& [note, general] : notes) {
    pmi.notes = {{.at = "#5", .name = "", .text = note}};
    auto with_note = toleranced_shaft();
    add_pmi(pmi, with_note);
    EXPECT_EQ(with_note.general, general) << note;
  }
}

TEST(StepPmi, AnglesAndStrokesAreNamed) {
  Pmi pmi;
  constexpr double kDeg = std::numbers::pi / 180;
  pmi.angles = {{.at = "#5",
                 .name = "angle",
                 .nominal_rad = 60 * kDeg,
                 .lower_rad = -0.5 * kDeg,
                 .upper_rad = 0.5 * kDeg}};
  pmi.annotations = 3;
  pmi.strokes_alone = {"Note.1", "Note.2"};
  auto o = toleranced_shaft();
  add_pmi(pmi, o);
  EXPECT_EQ(lines(o),
            (Lines{"The angle 60 +0.5/-0.5 deg is left out: a part document has no "
                   "tolerances of angles.",
                   "2 of 3 annotations are strokes without data: Note.1, Note.2."}));
  pmi.angles.clear();
  auto drawn_only = toleranced_shaft();
  add_pmi(pmi, drawn_only);
  EXPECT_EQ(lines(drawn_only),
            Lines{"Dimensions and tolerances are drawn only: 3 annotations are strokes "
                  "without data, of which nothing was read."});
}

// Holds a tolerance on toleranced_shaft() with datums A, B, D against the table of kinds.
void expect_allowed(const part::Tolerance& t) {
  using Of = part::Toleranced;
  using Wanted = part::DatumFeature;
  const auto& facts = part::facts(t.kind);
  const bool face = t.of == "left" || t.of == "d1|d2", datum_face = t.datum == "left";
  const bool cylinder = t.of == "d1" || t.of == "d2" || t.of == "b1";
  EXPECT_TRUE(facts.of != Of::face || face);
  EXPECT_TRUE(facts.of != Of::element || !face);
  EXPECT_TRUE(facts.of != Of::cylinder || cylinder);
  EXPECT_EQ(facts.datum == Wanted::none, t.datum.empty());
  EXPECT_NE(t.datum, t.of);
  EXPECT_TRUE(facts.datum != Wanted::element || !datum_face);
  EXPECT_TRUE(facts.datum != Wanted::face || datum_face);
  EXPECT_TRUE(facts.datum != Wanted::other || face != datum_face);
}

TEST(StepPmi, KindsKeepTheRulesOfTheirTable) {
  std::size_t made = 0;
  for (int s = 0; s <= static_cast<int>(Symbol::total_runout); ++s)
    for (const auto face :
         {"#d1", "#d2", "#d3", "#d4", "#b1", "#left", "#d1|d2", "#edge"})
      for (const auto datum : {"", "A", "B", "D"})
        for (const bool diametral : {false, true}) {
          auto t = tolerance(static_cast<Symbol>(s), face, datum);
          t.diametral = diametral;
          auto pmi = with_datums();
          pmi.tolerances = {t};
          auto o = toleranced_shaft();
          add_pmi(pmi, o);
          ASSERT_EQ(o.tolerances.size() + o.ignored.size(), 1u);
          made += o.tolerances.size();
          for (const auto& one : o.tolerances) expect_allowed(one);
        }
  EXPECT_GT(made, 100u);
}

// The three steps of the files in tests/data/step/pmi, with the faces that these hold.
Outline three_steps(const Exchange& file) {
  auto o = toleranced_shaft();
  o.outer.resize(3);
  o.inner.clear();
  o.edges.clear();
  o.outer[2] = {.id = "d3", .length_mm = 50, .left_mm = 25, .right_mm = 25};
  const auto face_on = [&](const char* surface, auto wanted) {
    Lines found;
    for (const auto& face : file.all("ADVANCED_FACE")) {
      const auto on = face.record(0)[2].instance();
      if (on.is(surface) && wanted(on.record(0))) found.push_back(name_of(face.id()));
    }
    return found;
  };
  const auto plane = [&](double x) {
    return face_on("PLANE", [&](const Record& r) {
      const auto origin = r[1].instance().record(0)[1].instance();
      return std::abs(origin.record(0)[1][0].real() - x) < 1e-9;
    });
  };
  for (auto& e : o.outer)
    e.sources = face_on("CYLINDRICAL_SURFACE",
                        [&](const Record& r) { return r[2].real() == e.left_mm / 2; });
  o.faces[0].sources = plane(0);
  o.faces[1].sources = plane(40);
  o.faces[2].sources = plane(120);
  return o;
}

struct Read {
  explicit Read(const std::string& name)
      : text(step_text(name)), file(read_part21(text)), outline(three_steps(file)) {
    add_pmi(file, outline);
  }
  const std::string text;
  const Exchange file;
  Outline outline;
};

void expect_limits(const Element& e, double lower_mm, double upper_mm) {
  ASSERT_TRUE(e.demands.limits);
  EXPECT_EQ(e.demands.limits->lower_mm, lower_mm);
  EXPECT_EQ(e.demands.limits->upper_mm, upper_mm);
}

// Open CASCADE's file, with what scripts/step_pmi/shaft.cpp has it write.
TEST(StepPmi, FileOfAnotherWriterGivesWhatItWasMadeOf) {
  const Read read("pmi/shaft.stp");
  const auto& o = read.outline;
  EXPECT_EQ(o.outer[0].demands.fit, "k6");
  expect_limits(o.outer[1], -0.1, 0.05);
  EXPECT_EQ(o.material, "C45");
  EXPECT_EQ(o.name, "SHAFT-3");
  EXPECT_EQ(lines(o),
            (Lines{"t1 length left..right -0.2 0.3", "t2 length left..d1|d2 -0.1 0.1",
                   "t3 cylindricity d1 0.008", "t4 circular-radial-runout d3 0.02 to d1",
                   "t5 total-axial-runout d1|d2 0.03 to d1", "t6 flatness left 0.015",
                   "t7 coaxiality d2 0.05 to d1"}));
}

// PMI written by hand on the same shape: inches and micrometres, simple and complex forms,
// limits as items, ranked datums, a common datum, a modifier.
TEST(StepPmi, FileWrittenByHandGivesWhatItSays) {
  const Read read("pmi/shaft_by_hand.stp");
  const auto& o = read.outline;
  EXPECT_EQ(o.outer[0].demands.fit, "k6");
  EXPECT_EQ(o.outer[0].demands.Ra_um, 0.8);
  expect_limits(o.outer[1], -0.004 * 25.4, 0.002 * 25.4);
  expect_limits(o.outer[2], -0.1, 0);
  EXPECT_EQ(o.general, "ISO 2768-mK");
  EXPECT_EQ(
      lines(o),
      (Lines{"t1 length left..right -0.3 0", "t2 cylindricity d1 0.0127",
             "t3 circular-radial-runout d3 0.02 to d1",
             "t4 circular-axial-runout d1|d2 0.03 to d1",
             "t5 total-radial-runout d2 0.03 to d1-d3", "t6 straightness d1 0.03",
             "1 dimension is without a tolerance: the shape has the size.",
             "The coaxiality tolerance of diameter 0.03 mm (maximum material "
             "requirement) to A is left out: a part document has no such modifier."}));
}

}  // namespace
}  // namespace turnwright::exchange
