#include "exchange/demands/pmi.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "pmi_text.hpp"
#include "step_file.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::exchange {
namespace {

using Lines = std::vector<std::string>;

// Faces #100 to #103 with an aspect each, #110 to #113; #100 with the datum A too.
const std::string kFaces =
    "#100=ADVANCED_FACE('',(),$,.T.);#101=ADVANCED_FACE('',(),$,.T.);"
    "#102=ADVANCED_FACE('',(),$,.T.);#103=ADVANCED_FACE('',(),$,.T.);"
    "#110=SHAPE_ASPECT('','',#9,.T.);#111=SHAPE_ASPECT('','',#9,.T.);"
    "#112=SHAPE_ASPECT('','',#9,.T.);#113=SHAPE_ASPECT('','',#9,.T.);"
    "#120=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#110,$,#100);"
    "#121=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#111,$,#101);"
    "#122=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#112,$,#102);"
    "#123=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#113,$,#103);"
    "#130=DATUM('','',#9,.F.,'A');#131=DATUM_FEATURE('','',#9,.T.);"
    "#132=SHAPE_ASPECT_RELATIONSHIP('','',#131,#130);"
    "#133=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#131,$,#100);"
    "#134=DATUM('','',#9,.F.,'B');"
    "#140=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(0.02),#1);\n";

Pmi pmi_of(const std::string& data) {
  const StepFile file(kFaces + data);
  return read_pmi(file.exchange);
}

Lines tolerances(const std::string& data) {
  const auto pmi = pmi_of(data);
  Lines all;
  for (const auto& t : pmi.tolerances) all.push_back(text(t));
  for (const auto& r : pmi.unread) all.push_back("unread " + r.at);
  return all;
}

Lines dimensions(const std::string& data) {
  const auto pmi = pmi_of(data);
  Lines all;
  for (const auto& d : pmi.dimensions) all.push_back(text(d));
  for (const auto& a : pmi.angles) all.push_back(text(a));
  for (const auto& r : pmi.unread) all.push_back("unread " + r.at);
  return all;
}

TEST(Pmi, SimpleAndComplexInstancesSayTheSame) {
  const std::string system =
      "#200=DATUM_REFERENCE_COMPARTMENT('','',#9,.F.,#130,$);"
      "#201=DATUM_SYSTEM('','',#9,.F.,(#200));";
  const Lines wanted{"total run-out 0.02 | A | #101"};
  EXPECT_EQ(tolerances(system + "#210=TOTAL_RUNOUT_TOLERANCE('','',#140,#111,(#201));"),
            wanted);
  EXPECT_EQ(tolerances(system + "#210=(GEOMETRIC_TOLERANCE('','',#140,#111)"
                                "GEOMETRIC_TOLERANCE_WITH_DATUM_REFERENCE((#201))"
                                "TOTAL_RUNOUT_TOLERANCE());"),
            wanted);
}

TEST(Pmi, EverySymbolIsRead) {
  const std::vector<std::pair<std::string, std::string>> symbols{
      {"ANGULARITY", "angularity"},
      {"CIRCULAR_RUNOUT", "circular run-out"},
      {"COAXIALITY", "coaxiality"},
      {"CONCENTRICITY", "concentricity"},
      {"CYLINDRICITY", "cylindricity"},
      {"FLATNESS", "flatness"},
      {"LINE_PROFILE", "line profile"},
      {"PARALLELISM", "parallelism"},
      {"PERPENDICULARITY", "perpendicularity"},
      {"POSITION", "position"},
      {"ROUNDNESS", "roundness"},
      {"STRAIGHTNESS", "straightness"},
      {"SURFACE_PROFILE", "surface profile"},
      {"SYMMETRY", "symmetry"},
      {"TOTAL_RUNOUT", "total run-out"}};
  for (const auto& [entity, name] : symbols)
    EXPECT_EQ(tolerances("#200=" + entity + "_TOLERANCE('','',#140,#112);"),
              Lines{name + " 0.02 | #102"});
}

TEST(Pmi, EveryMeasureHasItsOwnUnit) {
  EXPECT_EQ(tolerances("#200=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(0.002),#2);"
                       "#201=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(8.),#4);"
                       "#202=ROUNDNESS_TOLERANCE('','',#200,#110);"
                       "#203=ROUNDNESS_TOLERANCE('','',#201,#110);"
                       "#204=ROUNDNESS_TOLERANCE('','',#140,#110);"),
            (Lines{"roundness 0.0508 | #100", "roundness 0.008 | #100",
                   "roundness 0.02 | #100"}));
}

// A nominal size in mm between limits in inches, as CTC-03 has it the other way round.
TEST(Pmi, NominalSizeAndLimitsMayDifferInTheirUnits) {
  EXPECT_EQ(
      dimensions("#200=DIMENSIONAL_SIZE(#110,'diameter');"
                 "#201=DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(#200,#202);"
                 "#202=SHAPE_DIMENSION_REPRESENTATION('',(#203),$);"
                 "#203=(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()"
                 "MEASURE_WITH_UNIT(LENGTH_MEASURE(30.),#1)"
                 "REPRESENTATION_ITEM('nominal value'));"
                 "#204=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(-0.00500000000002),#2);"
                 "#205=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(0.001),#2);"
                 "#206=TOLERANCE_VALUE(#204,#205);"
                 "#207=PLUS_MINUS_TOLERANCE(#206,#200);"),
      Lines{"diameter 30 -0.127 0.0254 | #100"});
}

std::string size_with(const std::string& items, const std::string& more = "") {
  return "#200=DIMENSIONAL_SIZE(#110,'diameter');"
         "#201=DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(#200,#202);"
         "#202=SHAPE_DIMENSION_REPRESENTATION('',(" +
         items +
         "),$);"
         "#203=MEASURE_REPRESENTATION_ITEM('nominal value',LENGTH_MEASURE(35.),#1);"
         "#204=MEASURE_REPRESENTATION_ITEM('upper limit',LENGTH_MEASURE(35.2),#1);"
         "#205=MEASURE_REPRESENTATION_ITEM('lower limit',LENGTH_MEASURE(34.9),#1);"
         "#206=DESCRIPTIVE_REPRESENTATION_ITEM('dimensional note','theoretical');" +
         more;
}

TEST(Pmi, LimitsMayBeItemsBesideTheNominalSize) {
  EXPECT_EQ(dimensions(size_with("#203,#204,#205")),
            Lines{"diameter 35 -0.1 0.2 | #100"});
  EXPECT_EQ(dimensions(size_with("#204,#205")),
            Lines{"diameter 35.05 -0.15 0.15 | #100"});
  EXPECT_EQ(dimensions(size_with("#203,#204")), Lines{"diameter 35 | #100"});
}

TEST(Pmi, NotesMakeADimensionBasic) {
  EXPECT_EQ(dimensions(size_with("#203,#206")),
            Lines{"diameter 35 [theoretical] | #100"});
  EXPECT_EQ(dimensions(size_with("#203,#210",
                                 "#210=COMPOUND_REPRESENTATION_ITEM('',"
                                 "SET_REPRESENTATION_ITEM((#206)));")),
            Lines{"diameter 35 [theoretical] | #100"});
  EXPECT_EQ(dimensions(
                size_with("#210",
                          "#210=(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()"
                          "MEASURE_WITH_UNIT(LENGTH_MEASURE(0.4),#1)"
                          "QUALIFIED_REPRESENTATION_ITEM((#211))REPRESENTATION_ITEM(''));"
                          "#211=TYPE_QUALIFIER('maximum');")),
            Lines{"diameter 0.4 [maximum] | #100"});
}

TEST(Pmi, FitIsTheClassOfISO286) {
  const std::vector<std::pair<std::string, std::string>> forms{
      {"'k','shaft','6',''", "k6"},     {"'K','shaft','6',''", "k6"},
      {"'h','hole','7',''", "H7"},      {"'H','','7',''", "H7"},
      {"'js','shaft','IT7',''", "js7"}, {"'G6','hole','',''", "G6"},
      {"'JS','hole','13',''", "JS13"}};
  for (const auto& [parameters, fit] : forms)
    EXPECT_EQ(dimensions("#200=DIMENSIONAL_SIZE(#110,'diameter');"
                         "#201=LIMITS_AND_FITS(" +
                         parameters + ");#202=PLUS_MINUS_TOLERANCE(#201,#200);"),
              Lines{"diameter no value " + fit + " | #100"})
        << parameters;
}

TEST(Pmi, LocationsHaveTwoEnds) {
  const std::string value =
      "#201=DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(#200,#202);"
      "#202=SHAPE_DIMENSION_REPRESENTATION('',(#203),$);"
      "#203=MEASURE_REPRESENTATION_ITEM('nominal value',LENGTH_MEASURE(40.),#1);";
  EXPECT_EQ(
      dimensions("#200=DIMENSIONAL_LOCATION('linear distance','',#110,#111);" + value),
      Lines{"linear distance 40 | #100 -> #101"});
  EXPECT_EQ(dimensions("#200=(DIMENSIONAL_LOCATION()DIRECTED_DIMENSIONAL_LOCATION()"
                       "SHAPE_ASPECT_RELATIONSHIP('linear distance','',#110,#111));" +
                       value),
            Lines{"linear distance 40 | #100 -> #101"});
}

TEST(Pmi, AnglesAreNoLengths) {
  EXPECT_EQ(
      dimensions("#200=ANGULAR_LOCATION('angle','',#110,#111,.SMALL.);"
                 "#201=DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(#200,#202);"
                 "#202=SHAPE_DIMENSION_REPRESENTATION('',(#203),$);"
                 "#203=MEASURE_REPRESENTATION_ITEM('',PLANE_ANGLE_MEASURE(60.),#7);"
                 "#204=PLANE_ANGLE_MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(-0.5),#7);"
                 "#205=PLANE_ANGLE_MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(0.5),#7);"
                 "#206=TOLERANCE_VALUE(#204,#205);#207=PLUS_MINUS_TOLERANCE(#206,#200);"),
      Lines{"angle 60 deg -0.5 0.5"});
}

TEST(Pmi, DatumsStandInTheirOrder) {
  const std::string compartments =
      "#200=DATUM_REFERENCE_COMPARTMENT('','',#9,.F.,#130,$);"
      "#201=DATUM_REFERENCE_COMPARTMENT('','',#9,.F.,#134,"
      "(SIMPLE_DATUM_REFERENCE_MODIFIER(.MAXIMUM_MATERIAL_REQUIREMENT.)));"
      "#202=DATUM_REFERENCE_COMPARTMENT('','',#9,.F.,"
      "COMMON_DATUM_LIST((#203,#204)),$);"
      "#203=DATUM_REFERENCE_ELEMENT('','',#9,.F.,#130,$);"
      "#204=DATUM_REFERENCE_ELEMENT('','',#9,.F.,#134,$);"
      "#205=DATUM_REFERENCE_COMPARTMENT('','',#9,.F.,#130,(#206));"
      "#206=DATUM_REFERENCE_MODIFIER_WITH_VALUE(.DISTANCE.,#140);";
  const std::vector<std::pair<std::string, std::string>> systems{
      {"#200,#201", "A B(maximum material requirement)"},
      {"#201,#200", "B(maximum material requirement) A"},
      {"#202", "A-B"},
      {"#205", "A(distance)"}};
  for (const auto& [parts, wanted] : systems)
    EXPECT_EQ(tolerances(compartments + "#210=DATUM_SYSTEM('','',#9,.F.,(" + parts +
                         "));#211=PARALLELISM_TOLERANCE('','',#140,#111,(#210));"),
              Lines{"parallelism 0.02 | " + wanted + " | #101"});
}

TEST(Pmi, DatumsOfAP214AreSortedByTheirRank) {
  EXPECT_EQ(
      tolerances("#200=DATUM_REFERENCE(2,#130);"
                 "#201=REFERENCED_MODIFIED_DATUM(1,#134,.MAXIMUM_MATERIAL_CONDITION.);"
                 "#202=PARALLELISM_TOLERANCE('','',#140,#111,(#200,#201));"),
      Lines{"parallelism 0.02 | B(maximum material condition) A | #101"});
}

TEST(Pmi, ModifiersAreReadOutOfAllRecords) {
  const std::vector<std::pair<std::string, std::string>> modifiers{
      {"GEOMETRIC_TOLERANCE_WITH_MODIFIERS((.FREE_STATE.,.TANGENT_PLANE.))",
       "free state, tangent plane"},
      {"MODIFIED_GEOMETRIC_TOLERANCE(.MAXIMUM_MATERIAL_CONDITION.)",
       "maximum material condition"},
      {"UNEQUALLY_DISPOSED_GEOMETRIC_TOLERANCE(#140)", "unequally disposed by 0.02 mm"},
      {"GEOMETRIC_TOLERANCE_WITH_MAXIMUM_TOLERANCE(#140)", "at most 0.02 mm"},
      {"GEOMETRIC_TOLERANCE_WITH_DEFINED_UNIT(#140)", "per 0.02 mm"},
      {"GEOMETRIC_TOLERANCE_WITH_DEFINED_UNIT(#140)"
       "GEOMETRIC_TOLERANCE_WITH_DEFINED_AREA_UNIT(.SQUARE.,$)",
       "per 0.02 mm square"}};
  for (const auto& [record, words] : modifiers)
    EXPECT_EQ(tolerances("#200=(GEOMETRIC_TOLERANCE('','',#140,#111)" + record +
                         "STRAIGHTNESS_TOLERANCE());"),
              Lines{"straightness 0.02 [" + words + "] | #101"});
}

TEST(Pmi, ZonesGiveTheirFormAndProjection) {
  EXPECT_EQ(tolerances("#200=POSITION_TOLERANCE('','',#140,#111);"
                       "#201=TOLERANCE_ZONE_FORM('cylindrical or circular');"
                       "#202=TOLERANCE_ZONE('','',#9,.F.,(#200),#201);"
                       "#203=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(2.),#2);"
                       "#204=PROJECTED_ZONE_DEFINITION(#202,(),$,#203);"),
            Lines{"position 0.02 dia [projected by 50.8 mm] | #101"});
}

TEST(Pmi, LowerSegmentsOfACompositeToleranceSaySo) {
  EXPECT_EQ(
      tolerances("#200=POSITION_TOLERANCE('','',#140,#111);"
                 "#201=POSITION_TOLERANCE('','',#140,#111);"
                 "#202=GEOMETRIC_TOLERANCE_RELATIONSHIP('composite','',#200,#201);"),
      (Lines{"position 0.02 | #101",
             "position 0.02 [lower segment of the composite tolerance #200] | #101"}));
}

TEST(Pmi, CompositeAspectsHaveTheFacesOfTheirMembers) {
  EXPECT_EQ(tolerances("#200=COMPOSITE_SHAPE_ASPECT('','',#9,.F.);"
                       "#201=SHAPE_ASPECT_RELATIONSHIP('','',#200,#111);"
                       "#202=SHAPE_ASPECT_RELATIONSHIP('','',#200,#112);"
                       "#203=ALL_AROUND_SHAPE_ASPECT('','',#9,.F.);"
                       "#204=SHAPE_ASPECT_RELATIONSHIP('','',#203,#200);"
                       "#205=ROUNDNESS_TOLERANCE('','',#140,#200);"
                       "#206=SURFACE_PROFILE_TOLERANCE('','',#140,#203);"),
            (Lines{"roundness 0.02 | #101 #102",
                   "surface profile 0.02 [all around] | #101 #102"}));
}

TEST(Pmi, FacesMayHangOnASetOrOnASize) {
  EXPECT_EQ(tolerances("#200=SHAPE_ASPECT('','',#9,.T.);"
                       "#201=ITEM_IDENTIFIED_REPRESENTATION_USAGE('','',#200,$,"
                       "SET_REPRESENTATION_ITEM((#103,#102)));"
                       "#202=DIMENSIONAL_SIZE(#200,'diameter');"
                       "#203=ROUNDNESS_TOLERANCE('','',#140,#200);"
                       "#204=STRAIGHTNESS_TOLERANCE('','',#140,#202);"),
            (Lines{"roundness 0.02 | #103 #102", "straightness 0.02 | #103 #102"}));
}

TEST(Pmi, CentreOfSymmetryIsAnAxis) {
  EXPECT_EQ(tolerances("#200=CENTRE_OF_SYMMETRY('','',#9,.F.);"
                       "#201=SHAPE_ASPECT_DERIVING_RELATIONSHIP('','',#200,#111);"
                       "#202=STRAIGHTNESS_TOLERANCE('','',#140,#200);"),
            Lines{"straightness 0.02 | axis of #101"});
}

TEST(Pmi, DatumsHaveTheFacesOfTheirFeatures) {
  const auto pmi = pmi_of(
      "#200=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#134,$,#103);"
      "#201=DATUM('','',#9,.F.,'C');"
      "#202=PLACED_DATUM_TARGET_FEATURE('','point',#9,.T.,'1');"
      "#203=SHAPE_ASPECT_RELATIONSHIP('','',#202,#201);"
      "#204=FEATURE_FOR_DATUM_TARGET_RELATIONSHIP('','',#112,#202);"
      "#205=DATUM('','',#9,.F.,'D');"
      "#206=(DATUM_FEATURE()DIMENSIONAL_SIZE(#113,'diameter')"
      "DIMENSIONAL_SIZE_WITH_DATUM_FEATURE()SHAPE_ASPECT('','',#9,.T.));"
      "#207=SHAPE_ASPECT_RELATIONSHIP('','',#206,#205);");
  ASSERT_EQ(pmi.datums.size(), 4u);
  EXPECT_EQ(faces_text(pmi.datums[0].of), "#100");
  EXPECT_EQ(faces_text(pmi.datums[1].of), "#103");  // on the datum itself
  EXPECT_EQ(faces_text(pmi.datums[2].of), "#102");
  EXPECT_TRUE(pmi.datums[2].targets);
  EXPECT_FALSE(pmi.datums[1].targets);
  EXPECT_EQ(pmi.datums[3].letter, "D");
  EXPECT_EQ(faces_text(pmi.datums[3].of), "#103");
  ASSERT_EQ(pmi.dimensions.size(), 1u);
  EXPECT_EQ(faces_text(pmi.dimensions[0].of), "#103");
}

TEST(Pmi, RoughnessIsInItsUnit) {
  const auto pmi = pmi_of(
      "#200=PROPERTY_DEFINITION('surface_condition','',#111);"
      "#201=SURFACE_TEXTURE_REPRESENTATION('',(#202,#203),$);"
      "#202=DESCRIPTIVE_REPRESENTATION_ITEM('measuring method','Ra');"
      "#203=MEASURE_REPRESENTATION_ITEM('characteristic value',LENGTH_MEASURE(1.6),#4);"
      "#204=PROPERTY_DEFINITION_REPRESENTATION(#200,#201);");
  ASSERT_EQ(pmi.textures.size(), 1u);
  EXPECT_EQ(pmi.textures[0].parameter, "Ra");
  EXPECT_DOUBLE_EQ(pmi.textures[0].value_um, 1.6);
  EXPECT_EQ(faces_text(pmi.textures[0].of), "#101");
}

TEST(Pmi, ProductNumberRevisionMaterialAndNotesAreRead) {
  const auto pmi = pmi_of(
      "#200=PROPERTY_DEFINITION('semantic text','',#9);"
      "#201=REPRESENTATION('',(#202),$);"
      "#202=DESCRIPTIVE_REPRESENTATION_ITEM('','General tolerances ISO 2768-mK');"
      "#203=PROPERTY_DEFINITION_REPRESENTATION(#200,#201);"
      "#204=PROPERTY_DEFINITION('pmi validation property','',#9);"
      "#205=PROPERTY_DEFINITION_REPRESENTATION(#204,#201);"
      "#206=MATERIAL_DESIGNATION('42CrMo4',(#10));");
  EXPECT_EQ(pmi.part_number, "4711-08");
  EXPECT_EQ(pmi.part_name, "SHAFT");
  EXPECT_EQ(pmi.revision, "C");
  EXPECT_EQ(pmi.material, "42CrMo4");
  ASSERT_EQ(pmi.notes.size(), 1u);
  EXPECT_EQ(pmi.notes[0].text, "General tolerances ISO 2768-mK");
}

TEST(Pmi, AnnotationsWithoutDataAreToldApart) {
  const auto pmi = pmi_of(
      "#200=ROUNDNESS_TOLERANCE('','',#140,#111);"
      "#201=DRAUGHTING_CALLOUT('Roundness.1',());#202=DRAUGHTING_CALLOUT('Note.1',());"
      "#203=DRAUGHTING_MODEL_ITEM_ASSOCIATION('','',#200,$,#201);"
      "#204=DRAUGHTING_MODEL_ITEM_ASSOCIATION('','',#111,$,#202);");
  EXPECT_EQ(pmi.annotations, 2u);
  EXPECT_EQ(pmi.strokes_alone, Lines{"Note.1"});
}

TEST(Pmi, WhatIsBrokenIsToldAndCostsNothingElse) {
  EXPECT_EQ(tolerances("#200=ROUNDNESS_TOLERANCE('','',#111,#111);"  // no measure
                       "#201=ROUNDNESS_TOLERANCE('','',#140);"       // too short
                       "#202=ROUNDNESS_TOLERANCE('','',0.02,#111);"
                       "#203=ROUNDNESS_TOLERANCE('','',#140,'');"
                       "#204=ROUNDNESS_TOLERANCE('','',$,#111);"
                       "#205=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',7,$,#101);"
                       "#206=PERPENDICULARITY_TOLERANCE('','',#140,#111,(#140));"
                       "#207=ROUNDNESS_TOLERANCE('','',#140,#111);"
                       "#208=TOLERANCE_ZONE('','',#9,.F.,(#207),#140);"),
            (Lines{"roundness no value | #101", "roundness 0.02 | #101", "unread #205",
                   "unread #200", "unread #201", "unread #202", "unread #203",
                   "unread #206", "unread #208"}));
  EXPECT_EQ(dimensions(size_with("#203",
                                 "#210=TOLERANCE_VALUE(#204,#205);"
                                 "#211=PLUS_MINUS_TOLERANCE(#210,#200);")),
            Lines{"unread #200"});  // the lower limit is the higher one
}

TEST(Pmi, ReasonsNameTheirPlace) {
  const auto pmi = pmi_of("#200=ROUNDNESS_TOLERANCE('','',#5,#111);");
  ASSERT_EQ(pmi.unread.size(), 1u);
  EXPECT_NE(pmi.unread[0].text.find("a length with its unit"), std::string::npos)
      << pmi.unread[0].text;
}

TEST(Pmi, AspectsInACircleAreWalkedOnce) {
  EXPECT_EQ(tolerances("#200=COMPOSITE_SHAPE_ASPECT('','',#9,.F.);"
                       "#201=COMPOSITE_SHAPE_ASPECT('','',#9,.F.);"
                       "#202=SHAPE_ASPECT_RELATIONSHIP('','',#200,#201);"
                       "#203=SHAPE_ASPECT_RELATIONSHIP('','',#201,#200);"
                       "#204=SHAPE_ASPECT_RELATIONSHIP('','',#201,#111);"
                       "#205=SHAPE_ASPECT_RELATIONSHIP('','',#200,#200);"
                       "#206=ROUNDNESS_TOLERANCE('','',#140,#200);"),
            Lines{"roundness 0.02 | #101"});
  EXPECT_EQ(dimensions(size_with("#203,#210",
                                 "#210=COMPOUND_REPRESENTATION_ITEM('',"
                                 "LIST_REPRESENTATION_ITEM((#210,#206)));")),
            Lines{"diameter 35 [theoretical] | #100"});
}

double seconds(const std::string& data, std::size_t& found) {
  const StepFile file(kFaces + data);
  const auto start = std::chrono::steady_clock::now();
  found = read_pmi(file.exchange).tolerances.size();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(Pmi, HundredThousandTolerancesOfOneAspectTakeNoSeconds) {
  std::string data;
  for (int i = 0; i < 100000; ++i)
    data += fmt::format("#{}=ROUNDNESS_TOLERANCE('','',#140,#111);", 1000 + i);
  std::size_t found = 0;
  EXPECT_LT(seconds(data, found), 10);
  EXPECT_EQ(found, 100000u);
}

// One system of 6 x 6 datums, a name of 1 MB: shared by all they would be many GB.
TEST(Pmi, WhatManyShareHasToBeShort) {
  std::string elements, compartments;
  std::string data = "#200=DATUM('','',#9,.F.,'" + std::string(1 << 20, 'A') + "');";
  for (int i = 0; i < 6; ++i) {
    data += fmt::format("#{}=DATUM_REFERENCE_ELEMENT('','',#9,.F.,#130,$);", 210 + i);
    elements += fmt::format("{}#{}", i ? "," : "", 210 + i);
  }
  for (int i = 0; i < 6; ++i) {
    data += fmt::format(
        "#{}=DATUM_REFERENCE_COMPARTMENT('','',#9,.F.,COMMON_DATUM_LIST(({})),$);",
        220 + i, elements);
    compartments += fmt::format("{}#{}", i ? "," : "", 220 + i);
  }
  data += "#230=DATUM_SYSTEM('','',#9,.F.,(" + compartments + "));";
  data += "#231=DATUM_REFERENCE(1,#200);";
  for (int i = 0; i < 20000; ++i)
    data += fmt::format("#{}=PARALLELISM_TOLERANCE('','',#140,#111,(#{}));", 1000 + i,
                        i % 2 ? 230 : 231);
  std::size_t found = 1;
  EXPECT_LT(seconds(data, found), 20);
  EXPECT_EQ(found, 0u);
}

// One property with a name of 1 MB, whose relations would each decode it.
TEST(Pmi, ALongNameThatManyRelationsShareIsNotReadByEach) {
  std::string data = "#200=PROPERTY_DEFINITION('" + std::string(1 << 20, 'A') +
                     "','',#9);"
                     "#201=REPRESENTATION('',(#202),#1);#202=DESCRIPTIVE_REPRESENTATION_"
                     "ITEM('','text');";
  for (int i = 0; i < 100000; ++i)
    data += fmt::format("#{}=PROPERTY_DEFINITION_REPRESENTATION(#200,#201);", 1000 + i);
  std::size_t found = 1;
  EXPECT_LT(seconds(data, found), 10);
}

// A chain of composites with a tolerance on each link: the faces of all would be n^2 / 2.
TEST(Pmi, FeaturesThatOutgrowTheFileAreRefused) {
  std::string data = "#1000=SHAPE_ASPECT('','',#9,.F.);";
  for (int i = 0; i < 30000; ++i) {
    const int n = 1000 + 4 * i;
    data += fmt::format(
        "#{}=SHAPE_ASPECT('','',#9,.F.);#{}=SHAPE_ASPECT_RELATIONSHIP('','',#{},#{});"
        "#{}=ADVANCED_FACE('',(),$,.T.);"
        "#{}=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#{},$,#{});"
        "#{}=ROUNDNESS_TOLERANCE('','',#140,#{});",
        n + 4, n + 1, n + 4, n, n + 2, 1000000 + i, n, n + 2, 2000000 + i, n);
  }
  const StepFile file(kFaces + data);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THROW(read_pmi(file.exchange), InputError);
  const auto took = std::chrono::steady_clock::now() - start;
  EXPECT_LT(std::chrono::duration<double>(took).count(), 20);
}

}  // namespace
}  // namespace turnwright::exchange
