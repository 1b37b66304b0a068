// Messages are lines that a terminal can show.
#include "turnwright/base/errors.hpp"

#include <gtest/gtest.h>

namespace turnwright {
namespace {

TEST(Visible, ControlCharactersAreWrittenAndTextStays) {
  EXPECT_EQ(visible("d1 \u00d820 h7 \u4e2d"), "d1 \u00d820 h7 \u4e2d");
  EXPECT_EQ(visible(std::string_view("a\0b\n\x1b[31m\x7f", 10)),
            "a\\u0000b\\u000a\\u001b[31m\\u007f");
  EXPECT_EQ(visible("\xc2\x85\xc2\x9f\u00a0"), "\\u0085\\u009f\u00a0");
  EXPECT_EQ(visible("cut off \xc2"), "cut off \xc2");
  EXPECT_EQ(visible("no UTF-8: \xc2"
                    "b"),
            "no UTF-8: \xc2"
            "b");
}

TEST(InputErrors, AreALineForEachProblemWhateverItsKeysAre) {
  const InputError e("a\nb.json", {{"/x\x1b]0;t\a", "1", "no such key", "unknown-key"},
                                   {"", "2", "3", "range"}});
  EXPECT_STREQ(e.what(),
               "a\\u000ab.json: /x\\u001b]0;t\\u0007: got 1, expected no such key\n"
               "a\\u000ab.json: document: got 2, expected 3");
  EXPECT_EQ(e.problems()[0].pointer, "/x\x1b]0;t\a");
}

}  // namespace
}  // namespace turnwright
