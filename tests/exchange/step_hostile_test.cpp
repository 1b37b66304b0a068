#include <gtest/gtest.h>

#include <cctype>
#include <random>
#include <stop_token>
#include <string>

#include "step_file.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/exchange/notation.hpp"
#include "turnwright/exchange/step.hpp"

namespace turnwright::exchange {
namespace {

std::string answer(const std::string& text) {
  try {
    read_step(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "read";
}

/// A file of tests/data/step/ with the first `from` behind `behind` changed.
std::string changed(std::string text, const std::string& behind, const std::string& from,
                    const std::string& to) {
  const auto at = text.find(from, text.find(behind));
  return text.replace(at, from.size(), to);
}

const std::string kShaft = "cases/turned-x.step";

TEST(HostileStep, BrokenGeometryIsRefusedByName) {
  const auto text = step_text(kShaft);
  const auto expect = [](const std::string& changed, const std::string& part) {
    const auto said = answer(changed);
    EXPECT_NE(said.find(part), said.npos) << said;
  };
  expect(changed(text, "CYLINDRICAL_SURFACE", "DIRECTION('',(1.,0.,0.))",
                 "DIRECTION('',(0.,0.,0.))"),
         "a direction that is not zero");
  expect(changed(text, "CYLINDRICAL_SURFACE", ",15.)", ",-15.)"), "a radius > 0");
  expect(changed(text, "CYLINDRICAL_SURFACE", ",15.)", ",'15')"), "expected a number");
  expect(changed(text, "CYLINDRICAL_SURFACE", ",15.)", ",NAN)"), "line ");
  expect(changed(text, "ADVANCED_FACE", "ADVANCED_FACE", "FACE"), "ADVANCED_FACE");
  expect(changed(text, "MANIFOLD_SOLID_BREP", "MANIFOLD_SOLID_BREP", "FACETED_BREP"),
         "a solid with exact faces");
  expect(changed(text, "MANIFOLD_SOLID_BREP", "MANIFOLD_SOLID_BREP", "BLOCK"),
         "no solid and no shell");
}

TEST(HostileStep, CirclesOfReferencesEnd) {
  const std::string head =
      "#20=MANIFOLD_SOLID_BREP('',#21);#21=CLOSED_SHELL('',(#22));"
      "#22=ADVANCED_FACE('',(#23),#30,.T.);#23=FACE_BOUND('',#24,.T.);"
      "#24=EDGE_LOOP('',(#25));#25=ORIENTED_EDGE('',*,*,#26,.T.);"
      "#26=EDGE_CURVE('',#27,#27,#29,.T.);#27=VERTEX_POINT('',#28);"
      "#28=CARTESIAN_POINT('',(0.,0.,0.));";
  const StepFile surface(head +
                         "#29=SURFACE_CURVE('',#29,(),.CURVE_3D.);"
                         "#30=RECTANGULAR_TRIMMED_SURFACE('',#30,0.,1.,0.,1.,.T.,.T.);");
  EXPECT_NE(answer(surface.text).find("without a cylinder"), std::string::npos);
  const StepFile shell(
      "#20=MANIFOLD_SOLID_BREP('',#21);#21=ORIENTED_CLOSED_SHELL('',*,#21,.T.);");
  EXPECT_NE(answer(shell.text).find("CLOSED_SHELL"), std::string::npos);
  const StepFile unit(
      "#20=MANIFOLD_SOLID_BREP('',#21);#21=CLOSED_SHELL('',());"
      "#40=SHAPE_REPRESENTATION('',(#20),#41);#41=(GLOBAL_UNIT_ASSIGNED_CONTEXT((#42))"
      "REPRESENTATION_CONTEXT('',''));#42=(CONVERSION_BASED_UNIT('x',#43)LENGTH_UNIT());"
      "#43=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(2.),#42);");
  EXPECT_NE(answer(unit.text).find("a unit of the SI in the end"), std::string::npos);
}

/// Numbers of instances and parts of numbers are exchanged at random: every such file is
/// read or refused, and none twice as long as the time of the whole test allows.
TEST(HostileStep, FilesWithWrongReferencesAreAnswered) {
  for (const char* name : {"cases/slot.step", "cases/half-round-groove.step",
                           "cases/ball-end.step", "cases/double-d.step"}) {
    const auto text = step_text(name);
    std::mt19937 random(20);
    std::vector<std::size_t> digits;
    for (std::size_t i = text.find("DATA;"); i < text.size(); ++i)
      if (std::isdigit(static_cast<unsigned char>(text[i]))) digits.push_back(i);
    for (int round = 0; round < 150; ++round) {
      auto copy = text;
      for (int i = 0; i < 1 + round % 4; ++i)
        copy[digits[random() % digits.size()]] = static_cast<char>('0' + random() % 10);
      EXPECT_FALSE(answer(copy).empty());
    }
  }
}

/// One edge loop, however long, that many faces share would be read by each of them.
TEST(HostileStep, LoopsSharedByAllFacesAreRefused) {
  std::string data =
      "#20=MANIFOLD_SOLID_BREP('',#21);#23=FACE_BOUND('',#24,.T.);"
      "#25=ORIENTED_EDGE('',*,*,#26,.T.);#26=EDGE_CURVE('',#27,#27,#29,.T.);"
      "#27=VERTEX_POINT('',#28);#28=CARTESIAN_POINT('',(0.,0.,0.));#29=BOUNDED_CURVE();"
      "#30=PLANE('',#31);#31=AXIS2_PLACEMENT_3D('',#28,$,$);\n";
  std::string loop = "#25", faces = "#1000";
  for (int i = 1; i < 3000; ++i) loop += ",#25", faces += ",#" + std::to_string(1000 + i);
  data += "#24=EDGE_LOOP('',(" + loop + "));#21=CLOSED_SHELL('',(" + faces + "));";
  for (int i = 0; i < 3000; ++i)
    data += "#" + std::to_string(1000 + i) + "=ADVANCED_FACE('',(#23),#30,.T.);\n";
  const StepFile file(data);
  EXPECT_NE(answer(file.text).find("edges that each bound two faces"), std::string::npos);
}

/// One shell, however often a body or oriented shells refer to it, gives its faces once.
TEST(HostileStep, ShellsReferredToManyTimesAreOne) {
  const auto text = step_text(kShaft);
  const auto brep = text.find("MANIFOLD_SOLID_BREP(");
  const auto shell =
      text.substr(text.find('#', brep), text.find(')', brep) - text.find('#', brep));
  std::string turned, shells = shell;
  for (int i = 0; i < 30000; ++i) {
    const auto id = "#" + std::to_string(1000000 + i);
    turned += id + "=ORIENTED_CLOSED_SHELL('',*," + shell + ",.T.);\n";
    shells += "," + id + "," + shell;
  }
  auto many = text;
  many.replace(brep, text.find(';', brep) - brep,
               "SHELL_BASED_SURFACE_MODEL('',(" + shells + "))");
  many.insert(many.rfind("ENDSEC"), turned);
  EXPECT_EQ(notation(read_step(many)), notation(read_step(text)));
}

TEST(HostileStep, HearsThatNobodyWaits) {
  std::stop_source source;
  source.request_stop();
  const std::stop_token token = source.get_token();
  const Listening listening(token);
  EXPECT_THROW(read_step(step_text(kShaft)), Cancelled);
}

}  // namespace
}  // namespace turnwright::exchange
