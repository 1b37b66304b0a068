#include "turnwright/planning/limit_words.hpp"

#include <gtest/gtest.h>

#include "turnwright/base/language.hpp"

namespace turnwright::planning::limit_words_test {
namespace {

class LimitWords : public ::testing::Test {
 protected:
  void TearDown() override { speak("en", {}); }
};

TEST_F(LimitWords, AreInEnglishTheNameOfTheLimit) {
  for (const std::string name :
       {"t1", "d1:diameter diameter", "roughness Ra of d2", "grip force in setup 2",
        "damping ratio of chuck and toolpost of lathe-medium", "stations of the turret",
        "t2 total-axial-runout of d1 .. d4", ""})
    EXPECT_EQ(limit_words(name), name);
}

TEST_F(LimitWords, AreTranslatedAroundTheIds) {
  speak("de", {{"roughness Ra", "Rauheit Ra"},
               {"damping ratio of chuck and toolpost", "Dämpfung"},
               {"grip force", "Spannkraft"},
               {"cylindricity", "Zylindrizität"},
               {"setup {}", "Aufspannung {}"},
               {"{} of {}", "{} von {}"}});
  EXPECT_EQ(limit_words("roughness Ra of d2"), "Rauheit Ra von d2");
  EXPECT_EQ(limit_words("damping ratio of chuck and toolpost of lathe-small"),
            "Dämpfung von lathe-small");
  EXPECT_EQ(limit_words("grip force in setup 2"), "Spannkraft in Aufspannung 2");
  EXPECT_EQ(limit_words("t1 cylindricity of d1 .. d2"), "t1 Zylindrizität von d1 .. d2");
  EXPECT_EQ(limit_words("t1"), "t1");
}

}  // namespace
}  // namespace turnwright::planning::limit_words_test
