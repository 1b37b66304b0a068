// Tables that are wider than the page.
#include "report/text/layout.hpp"

#include <gtest/gtest.h>

#include <string>

#include "../words.hpp"

namespace turnwright::report {
namespace {

TEST(Layout, ATableGivesWayAtBlanksBeforeWithinWords) {
  const std::vector<Column> columns{
      {"id", Align::left}, {"why", Align::left}, {std::string(72, 'n')}};
  const auto out =
      table(columns, {{{"Zylindrizit\u00e4t", "of all that stands", "1"}, ""},
                      {{"d1:diameter", "it", "2"}, ""}});
  EXPECT_TRUE(has(out, "Zylindrizit\u00e4t"));
  EXPECT_FALSE(has(out, "of all that"));
  std::size_t begin = 0;
  for (auto end = out.find('\n'); end != out.npos; end = out.find('\n', begin)) {
    EXPECT_LE(characters(out.substr(begin, end - begin)), kPageWidth);
    begin = end + 1;
  }
}

TEST(Layout, WordsBreakWhereNothingElseGivesWay) {
  const auto out = table({{"id", Align::left}, {std::string(88, 'n')}},
                         {{{"Zylindrizit\u00e4t", "1"}, ""}});
  EXPECT_FALSE(has(out, "Zylindrizit\u00e4t"));
  EXPECT_TRUE(has(out, "Zylind"));
}

}  // namespace
}  // namespace turnwright::report
