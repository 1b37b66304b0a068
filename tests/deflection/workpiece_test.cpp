#include "turnwright/deflection/workpiece.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "random_shafts.hpp"
#include "turnwright/deflection/shoulder.hpp"

namespace turnwright::deflection {
namespace {

using part::FeedTowards;

const part::Shaft kStepped{
    210000, 0.3, {{50, 40, 40, 0, 0}, {20, 30, 20, 0, 0}, {40, 36, 36, 10, 10}}};

TEST(Workpiece, TheToolDiameterIsTheLeftSegmentsAtAStepAndLocalInACone) {
  const Workpiece part(kStepped);
  const auto D = [&](double a) { return part.diameter_mm(part.segment_at(a), a); };
  EXPECT_EQ(D(0), 40);
  EXPECT_EQ(D(50), 40);
  EXPECT_NEAR(D(50 + 1e-9), 30, 1e-8);
  EXPECT_EQ(D(60), 25);
  EXPECT_EQ(D(70), 20);
  EXPECT_EQ(D(71), 36);
  EXPECT_EQ(D(110), 36);
}

TEST(Workpiece, InProcessTheUncutSideIsTheThickerPart) {
  for (const auto towards : {FeedTowards::chuck, FeedTowards::tail}) {
    const Workpiece part(kStepped, {.in_process = Cut{2, towards}});
    EXPECT_EQ(part.diameter_mm(0, 10), 40);  // the finished one
    for (const Supports& s : random_shafts::supports())
      for (const double a : {5.0, 50.0, 63.0, 105.0}) {
        const Beam built({kStepped.E_MPa, kStepped.nu,
                          part::in_process(kStepped.segments, a, 2, towards)});
        Flexibility f;
        part.at({&a, 1}, s, {&f, 1});
        EXPECT_NEAR(f.f_ww_mm_N / built.at(a, s).f_ww_mm_N, 1, 1e-12);
        EXPECT_NEAR(f.f_pp_rad_Nmm / built.at(a, s).f_pp_rad_Nmm, 1, 1e-12);
      }
  }
}

TEST(Workpiece, ASteadyRestSeesThePartBeingCut) {
  for (const auto towards : {FeedTowards::chuck, FeedTowards::tail}) {
    const Workpiece part(kStepped, {.in_process = Cut{2, towards}});
    for (const Supports& s : random_shafts::supports()) {
      const SteadyRest rest{63, 2e-5};
      const RestedBeam rested = part.rested(s, rest);
      for (const double a : {5.0, 50.0, 63.0, 105.0}) {
        const RestedBeam built({kStepped.E_MPa, kStepped.nu,
                                part::in_process(kStepped.segments, a, 2, towards)},
                               s, rest);
        EXPECT_NEAR(rested.at(a).part.f_ww_mm_N / built.at(a).part.f_ww_mm_N, 1, 1e-12);
        EXPECT_NEAR(rested.at(a).rest_per_N, built.at(a).rest_per_N, 1e-12);
      }
    }
  }
}

TEST(Workpiece, ACantileverTurnedAwayFromTheChuckIsTheFinishedOne) {
  const Workpiece cut(kStepped, {.in_process = Cut{2, FeedTowards::tail}}),
      finished(kStepped);
  const Supports chuck{Method::chuck, {1.8e-5, 8.6e-8, 1.1e-9}, 0, 0};
  for (const double a : {5.0, 60.0, 110.0}) {
    Flexibility x, y;
    cut.at({&a, 1}, chuck, {&x, 1});
    finished.at({&a, 1}, chuck, {&y, 1});
    EXPECT_EQ(x.f_ww_mm_N, y.f_ww_mm_N);
  }
}

TEST(Workpiece, UncutMaterialStiffensAsTheFourthPowerOfTheDiameter) {
  // a slender bar turned from 24 to 20 mm towards the chuck: finished diameters overstate
  // the deflection by (24/20)^4
  const Workpiece cut({210000, 0.3, {{1000, 20, 20, 0, 0}}},
                      {.in_process = Cut{2, FeedTowards::chuck}}),
      finished({210000, 0.3, {{1000, 20, 20, 0, 0}}});
  const double a = 1000;
  Flexibility x, y;
  cut.at({&a, 1}, {}, {&x, 1});
  finished.at({&a, 1}, {}, {&y, 1});
  EXPECT_NEAR(y.f_pp_rad_Nmm / x.f_pp_rad_Nmm, std::pow(1.2, 4), 1e-12);
}

TEST(Workpiece, ShouldersAreCorrectedInEitherShape) {
  const Supports tail{Method::chuck_tailstock, {}, 0, 1e-5};
  const double a = 60;
  Flexibility x, y;
  Workpiece(kStepped, {.shoulder_correction = true}).at({&a, 1}, tail, {&x, 1});
  y = Beam({kStepped.E_MPa, kStepped.nu, shoulder_corrected(kStepped.segments)})
          .at(a, tail);
  EXPECT_EQ(x.f_ww_mm_N, y.f_ww_mm_N);
  Flexibility plain, in_cut, in_cut_plain;
  Workpiece(kStepped).at({&a, 1}, tail, {&plain, 1});
  EXPECT_GT(x.f_ww_mm_N, plain.f_ww_mm_N);
  const std::optional<Cut> cut = Cut{1, FeedTowards::chuck};
  Workpiece(kStepped, {cut, true}).at({&a, 1}, tail, {&in_cut, 1});
  Workpiece(kStepped, {cut, false}).at({&a, 1}, tail, {&in_cut_plain, 1});
  EXPECT_GT(in_cut.f_ww_mm_N, in_cut_plain.f_ww_mm_N);
}

TEST(Workpiece, ThinWallsAreBelowAFifthOfTheRadius) {
  const std::vector<part::Segment> segments{{10, 40, 40, 0, 0},
                                            {10, 40, 40, 32, 32},
                                            {10, 40, 40, 32.1, 32},
                                            {10, 40, 40, 0, 33},
                                            {10, 40, 60, 20, 20}};
  EXPECT_EQ(thin_walls(segments), (std::vector<std::size_t>{2, 3}));
}

}  // namespace
}  // namespace turnwright::deflection
