#pragma once
#include <fstream>
#include <sstream>
#include <string>

#include "turnwright/exchange/part21.hpp"

namespace turnwright::exchange {

/// A STEP file written in a test, with its text, which the exchange points into.  Known to
/// all of them: #1 mm, #2 inch, #4 um, #5 rad, #7 degree, #9 the shape of product SHAFT.
struct StepFile {
  explicit StepFile(const std::string& data)
      : text(
            "ISO-10303-21;HEADER;FILE_DESCRIPTION((''),'2;1');"
            "FILE_NAME('','',(''),(''),'','','');FILE_SCHEMA(('AP242'));ENDSEC;DATA;\n"
            "#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
            "#2=(CONVERSION_BASED_UNIT('inch',#3)LENGTH_UNIT()NAMED_UNIT(*));\n"
            "#3=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#1);\n"
            "#4=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MICRO.,.METRE.));\n"
            "#5=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n"
            "#6=PLANE_ANGLE_MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(0.017453292519943295),#"
            "5);\n"
            "#7=(CONVERSION_BASED_UNIT('degree',#6)NAMED_UNIT(*)PLANE_ANGLE_UNIT());\n"
            "#9=PRODUCT_DEFINITION_SHAPE('','',#10);\n"
            "#10=PRODUCT_DEFINITION('design','',#11,$);\n"
            "#11=PRODUCT_DEFINITION_FORMATION('C','',#12);\n"
            "#12=PRODUCT('4711-08','SHAFT','',());\n" +
            data + "ENDSEC;END-ISO-10303-21;\n"),
        exchange(read_part21(text)) {}

  const std::string text;
  const Exchange exchange;
};

/// tests/data/step/, or the folder in which a test has its files written anew.
inline std::string step_folder() {
  const char* given = std::getenv("TURNWRIGHT_STEP_FILES");
  return given ? given : TURNWRIGHT_SOURCE_DIR "/tests/data/step";
}

/// The text of a file of that folder.
inline std::string step_text(const std::string& name) {
  std::ifstream file(step_folder() + "/" + name, std::ios::binary);
  std::ostringstream all;
  all << file.rdbuf();
  return all.str();
}

}  // namespace turnwright::exchange
