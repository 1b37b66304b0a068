// Text of pictures is XML whatever it is made of.
#include "report/picture/svg.hpp"

#include <gtest/gtest.h>

namespace turnwright::report::svg_test {
namespace {

TEST(Svg, TextOfAnyCharactersIsXml) {
  EXPECT_EQ(escaped("a<b>&\"\t\u00d8"), "a&lt;b&gt;&amp;&quot;\t\u00d8");
  EXPECT_EQ(escaped("a\uffffb\ufffec\x01"
                    "d"),
            "a\ufffdb\ufffdc\ufffdd");
  EXPECT_EQ(escaped("\uffee\xef\xbf"), "\uffee\xef\xbf");
  // Controls that XML knows, but neither HTML nor a terminal should be sent.
  EXPECT_EQ(escaped("a\x7f"
                    "b\xc2\x9b"
                    "c\xc2\x85\xc2\xa0\xc2"),
            "a\ufffdb\ufffdc\ufffd\xc2\xa0\xc2");
}

}  // namespace
}  // namespace turnwright::report::svg_test
