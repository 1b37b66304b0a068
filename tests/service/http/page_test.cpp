#include "service/http/page.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "service/digest.hpp"

namespace turnwright::service::page_test {
namespace {

TEST(Page, IsTheFileThatIsCheckedIn) {
  std::ifstream file(TURNWRIGHT_SOURCE_DIR "/web/dist/index.html", std::ios::binary);
  ASSERT_TRUE(file);
  EXPECT_EQ(built_in_page(), std::string(std::istreambuf_iterator<char>(file), {}));
}

TEST(Page, RunsNothingButWhatStandsInIt) {
  // printf 'run()', and p{}, each' | openssl dgst -sha256 -binary | base64
  const auto policy = content_security_policy(
      "<!doctype html><style>p{}</style><script type=\"module\">run()</script><p>");
  EXPECT_NE(
      policy.find("script-src 'sha256-AvyuiL0SD1mVY3NNxR+V2uo+lhk6RMFrytWmRt6CrJQ=';"),
      std::string::npos)
      << policy;
  EXPECT_NE(
      policy.find("style-src 'sha256-gG2yISYereRMiG2lMXrbiUgi0Ubw9p7QCeWcroOvy9Y=';"),
      std::string::npos)
      << policy;
  EXPECT_NE(policy.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(policy.find("unsafe"), std::string::npos);
}

TEST(Page, AsksForNothingFromElsewhere) {
  const auto page = built_in_page();
  for (const char* outside : {"<link rel=\"stylesheet\"", "src=\"http", "@import"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST(Page, AnElementWithoutEndIsAFault) {
  EXPECT_THROW(content_security_policy("<script>run()"), std::domain_error);
}

TEST(Digest, Base64OfTheEmptyText) {
  // The digest of nothing (FIPS 180-4, e3b0c442..) in base64.
  EXPECT_EQ(sha256_base64(""), "47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU=");
}

}  // namespace
}  // namespace turnwright::service::page_test
