#include "service/batch/input.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "../../temporary_folder.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::service::input_test {
namespace {

using BatchInputTest = TemporaryFolder;

void put(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

std::vector<std::string> lines(BatchInput& input) {
  std::vector<std::string> all;
  Sha256 digest;
  for (std::string line; input.next(digest, &line);) all.push_back(line);
  return all;
}

TEST_F(BatchInputTest, LinesEndWithANewlineOrTheFile) {
  const auto file = folder_ / "lines";
  for (const auto& [text, expected] :
       std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"", {}},
           {"\n", {""}},
           {"a", {"a"}},
           {"a\n", {"a"}},
           {"a\n\nb", {"a", "", "b"}},
           {std::string("a\0b\r\n", 5), {std::string("a\0b\r", 4)}}}) {
    put(file, text);
    BatchInput input(file);
    EXPECT_EQ(lines(input), expected);
    const auto contents = input.contents();
    EXPECT_EQ(contents.lines, static_cast<std::int64_t>(expected.size()));
    EXPECT_EQ(contents.bytes, static_cast<std::int64_t>(text.size()));
    EXPECT_EQ(contents.sha256, sha256_hex(text));
  }
}

TEST_F(BatchInputTest, LinesLongerThanTheBufferAreWholeAndThoseOfNoRequestCut) {
  const auto file = folder_ / "lines";
  const std::string one(1'999'999, 'x'), two(3'000'000, 'y');
  put(file, one + '\n' + two + "\nz");
  BatchInput input(file);
  const auto all = lines(input);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0], one);
  EXPECT_EQ(all[1], std::string(2'000'001, 'y'));
  EXPECT_EQ(all[2], "z");
}

TEST_F(BatchInputTest, GoesBackToWhereALineBegan) {
  const auto file = folder_ / "lines";
  put(file, "one\ntwo\nthree\n");
  BatchInput input(file);
  Sha256 digest;
  input.next(digest);
  const auto second = input.position();
  EXPECT_EQ(second, 4);
  input.next(digest);
  input.seek(second);
  EXPECT_EQ(lines(input), (std::vector<std::string>{"two", "three"}));
}

TEST_F(BatchInputTest, WantsARegularFile) {
  EXPECT_THROW(BatchInput{folder_}, InputError);
  EXPECT_THROW(BatchInput(folder_ / "none"), InputError);
  EXPECT_THROW(BatchInput("/dev/null"), InputError);
}

}  // namespace
}  // namespace turnwright::service::input_test
