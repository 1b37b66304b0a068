#include <gtest/gtest.h>

#include "../test_catalogue.hpp"
#include "document/json/file.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/document/review.hpp"

namespace turnwright::document::review_document_test {
namespace {

using nlohmann::json;

json request() {
  return parse_file(source_path("schemas/review.request.json"))["examples"][0];
}

const Catalogue& real_catalogue() {
  static const auto kCatalogue = load_catalogue(source_path(""));
  return kCatalogue;
}

std::string refusal(const json& r) {
  try {
    auto asked = load_review_request(r, real_catalogue());
    const auto& part = asked.part.usable.front().document.part;
    review_input(asked, part, real_catalogue());
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

json with(const char* pointer, const json& value) {
  auto r = request();
  r[json::json_pointer(pointer)] = value;
  return r;
}

TEST(ReviewDocument, NamesEveryProblemWithItsPlace) {
  EXPECT_EQ(refusal(request()), "");
  EXPECT_EQ(refusal(with("/control", "heidenhain")).find("review: /control: got"), 0u);
  EXPECT_EQ(refusal(with("/tools/0/id", "PCLNL")),
            "review: /tools/0/id: got PCLNL, expected the id of a tool of the part or "
            "catalogue");
  EXPECT_EQ(refusal(with("/tools/0/id", "DRILL-HM-5D")),
            "review: /tools/0/size_mm: got nothing, expected the diameter of a drill or "
            "the width of a blade");
  EXPECT_EQ(refusal(with("/tools/0/id", "DRILL-HM-5D 19 mm")), "");
  EXPECT_EQ(refusal(with("/programs/0/setup", 2)).find("review: /programs: got"), 0u);
  EXPECT_NE(refusal(with("/part/material", "wood")).find("/part/material"),
            std::string::npos);
  auto twice = request();
  twice["programs"].push_back(twice["programs"][0]);
  twice["tools"].push_back(twice["tools"][0]);
  const auto told = refusal(twice);
  EXPECT_NE(told.find("/programs/1/setup: got 0"), std::string::npos) << told;
  EXPECT_NE(told.find("/tools/1/number: got 1"), std::string::npos) << told;
}

TEST(ReviewDocument, FindsToolsInCommentsOfPrograms) {
  auto r = request();
  r.erase("tools");
  r["programs"][0]["text"] =
      "(T1 PCLNL-CNMG120408-PM, CORNER 0.8 MM)\n"
      "(T2 DRILL-HM-5D 19 MM)\n(T3 SOMETHING)\nT0101";
  const auto asked = load_review_request(r, real_catalogue());
  const auto in =
      review_input(asked, asked.part.usable.front().document.part, real_catalogue());
  ASSERT_EQ(in.tools.size(), 2u);
  EXPECT_EQ(in.tools[0].turning->id, "PCLNL-CNMG120408-PM");
  EXPECT_EQ(in.tools[1].fixed->id, "DRILL-HM-5D");
  EXPECT_EQ(in.tools[1].size_mm, 19);
}

}  // namespace
}  // namespace turnwright::document::review_document_test
