#include "turnwright/base/pattern.hpp"

#include <gtest/gtest.h>

namespace turnwright {
namespace {

using Groups = Pattern::Groups;

TEST(Pattern, MatchesTheWholeTextOrNothing) {
  const Pattern size(R"((\d+)x(\d+)?)");
  EXPECT_EQ(size.match("12x3"), (Groups{"12x3", "12", "3"}));
  EXPECT_EQ(size.match("12x"), (Groups{"12x", "12", ""}));
  EXPECT_EQ(size.match("12x3 "), std::nullopt);
  EXPECT_EQ(size.match(std::string_view("a12x34").substr(1, 4)),
            (Groups{"12x3", "12", "3"}));
}

TEST(Pattern, FindsTheFirstPlaceAndAllOfThem) {
  const Pattern letter(R"(\b([a-c])\b)");
  EXPECT_EQ(letter.find_in("x b, a"), (Groups{"b", "b"}));
  EXPECT_EQ(letter.find_in("ab"), std::nullopt);
  EXPECT_EQ(letter.all_in("a b ab c"),
            (std::vector<Groups>{{"a", "a"}, {"b", "b"}, {"c", "c"}}));
  EXPECT_TRUE(letter.all_in("").empty());
}

TEST(Pattern, CapitalsCountUnlessTheyAreToldNotTo) {
  EXPECT_FALSE(Pattern("tap").find_in("A TAP"));
  EXPECT_TRUE(Pattern("tap", Pattern::Case::any).find_in("A TAP"));
}

}  // namespace
}  // namespace turnwright
