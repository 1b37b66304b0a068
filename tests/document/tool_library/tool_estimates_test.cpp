#include "document/tool_library/tool_estimates.hpp"

#include <gtest/gtest.h>

#include "../schema_check.hpp"
#include "turnwright/document/catalogue.hpp"

namespace turnwright::document::tool_estimates_test {
namespace {

// The shipped tools of carbide have windows after makers' catalogues.
TEST(ToolEstimates, AreThoseOfTheShippedCatalogue) {
  int count = 0;
  for (const auto& tool : load_catalogue(source_path("")).tools) {
    if (tool.groups == std::vector{catalogue::IsoGroup::H}) continue;  // CBN
    SCOPED_TRACE(tool.id);
    const auto insert = catalogue::decode_iso1832(tool.insert);
    EXPECT_NEAR(usual_feed_mm_rev(tool.re_mm).upper, tool.f_mm_rev.upper,
                0.35 * tool.f_mm_rev.upper);
    EXPECT_LT(usual_depth_mm(insert, tool.re_mm).upper, 3 * tool.ap_mm.upper);
    EXPECT_GT(usual_depth_mm(insert, tool.re_mm).upper, tool.ap_mm.upper / 3);
    EXPECT_EQ(usual_clearance_deg(insert), tool.alpha_deg);
    const bool for_undercuts = tool.id.starts_with("SVHBL");
    EXPECT_EQ(for_undercuts ? 107.5 : usual_kapr_deg(insert.shape), tool.kapr_deg);
    EXPECT_NEAR(usual_rake_deg(insert), tool.gamma_deg, 12.1);
    ++count;
  }
  EXPECT_GT(count, 10);
}

// A depth of cut whatever the corner; what a tool may do follows its corner.
TEST(ToolEstimates, EveryToolMayDoSomething) {
  for (const char* designation :
       {"VBMT 160400", "CNMG 120416", "DNMG 150602", "TNMG 160408"}) {
    const auto insert = catalogue::decode_iso1832(designation);
    const auto depth = usual_depth_mm(insert, insert.re_mm);
    EXPECT_GT(depth.lower, 0) << designation;
    EXPECT_LE(depth.lower, depth.upper) << designation;
    EXPECT_FALSE(usual_uses(insert, 93, insert.re_mm).empty()) << designation;
  }
  using Uses = std::vector<std::string>;
  const auto uses = [](const char* designation, double kapr_deg) {
    const auto insert = catalogue::decode_iso1832(designation);
    return usual_uses(insert, kapr_deg, insert.re_mm);
  };
  EXPECT_EQ(uses("CNMG 120408", 95), (Uses{"roughing", "finishing", "facing"}));
  EXPECT_EQ(uses("CNMG 120408", 75), (Uses{"roughing", "finishing"}));
  EXPECT_EQ(uses("CNMG 120416", 95), (Uses{"roughing", "facing"}));
  EXPECT_EQ(uses("DNMG 150602", 93), (Uses{"finishing", "facing"}));
  EXPECT_EQ(uses("VBMT 160404", 93), (Uses{"finishing"}));
}

}  // namespace
}  // namespace turnwright::document::tool_estimates_test
