#include "turnwright/part/tolerance_kind.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace turnwright::part {
namespace {

using enum ToleranceKind;

TEST(ToleranceKind, EveryKindHasARowInItsPlaceAndANameOfItsOwn) {
  std::set<std::string> names;
  for (std::size_t k = 0; k < tolerance_kinds().size(); ++k) {
    const auto kind = static_cast<ToleranceKind>(k);
    EXPECT_EQ(tolerance_kinds()[k].kind, kind);
    EXPECT_STREQ(facts(kind).name, name(kind));
    EXPECT_TRUE(names.insert(name(kind)).second) << name(kind);
  }
  EXPECT_GE(names.size(), 17U);
  EXPECT_STREQ(name(profile_without_datum), "profile-without-datum");
  EXPECT_STREQ(name(circular_axial_runout), "circular-axial-runout");
}

std::set<ToleranceKind> kinds_with(bool (*has)(const ToleranceFacts&)) {
  std::set<ToleranceKind> all;
  for (const auto& row : tolerance_kinds())
    if (has(row)) all.insert(row.kind);
  return all;
}

using Kinds = std::set<ToleranceKind>;

// ISO 1101, table 1: form needs no datum; orientation, location and run-out do.
TEST(ToleranceKind, FormsAndSizesHaveNoDatum) {
  EXPECT_EQ(kinds_with([](const auto& row) { return row.datum == DatumFeature::none; }),
            (Kinds{diameter, length, straightness, circularity, flatness, cylindricity,
                   profile_without_datum}));
}

TEST(ToleranceKind, SizesAndLocatedProfilesHaveTwoEnds) {
  EXPECT_EQ(kinds_with([](const auto& row) { return has_two_ends(row.kind); }),
            (Kinds{diameter, length, profile}));
}

// A part off its axis, or of three lobes, is seen where the radius is compared around it.
TEST(ToleranceKind, LobesAndChuckingAnewAreSeenAroundTheAxis) {
  EXPECT_EQ(kinds_with([](const auto& row) { return row.sees_lobes; }),
            (Kinds{circularity, cylindricity, circular_radial_runout, total_radial_runout,
                   profile, profile_without_datum}));
  EXPECT_EQ(
      kinds_with([](const auto& row) { return row.rechucked == Rechucked::run_out; }),
      (Kinds{position, coaxiality, circular_radial_runout, total_radial_runout}));
  EXPECT_EQ(
      kinds_with([](const auto& row) { return row.rechucked == Rechucked::tilted; }),
      (Kinds{parallelism, perpendicularity, angularity, circular_axial_runout,
             total_axial_runout}));
  EXPECT_EQ(
      kinds_with([](const auto& row) { return row.rechucked == Rechucked::displaced; }),
      (Kinds{profile}));
}

TEST(ToleranceKind, AnAxisThatIsPerpendicularIsNoMatterOfTheCut) {
  EXPECT_EQ(facts(perpendicularity).rule, ToleranceRule::range);
  EXPECT_EQ(facts(perpendicularity).rule_of_axis(), ToleranceRule::machine);
  EXPECT_EQ(facts(flatness).rule_of_axis(), ToleranceRule::range);
}

}  // namespace
}  // namespace turnwright::part
