// Text of pictures is XML whatever it is made of.
#include "report/picture/svg.hpp"

#include <gtest/gtest.h>

namespace turnwright::report {
namespace {

TEST(Svg, TextOfAnyCharactersIsXml) {
  EXPECT_EQ(escaped("a<b>&\"\t\u00d8"), "a&lt;b&gt;&amp;&quot;\t\u00d8");
  EXPECT_EQ(escaped("a\uffffb\ufffec\x01"
                    "d"),
            "a\ufffdb\ufffdc\ufffdd");
  EXPECT_EQ(escaped("\uffee\xef\xbf"), "\uffee\xef\xbf");
}

}  // namespace
}  // namespace turnwright::report
