#include "service/batch/folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "../../temporary_folder.hpp"
#include "service/batch/runner.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::service::folder_test {
namespace {

namespace fs = std::filesystem;

class BatchFolderTest : public TemporaryFolder {
 protected:
  void put(const std::string& text) const {
    std::ofstream(folder_ / "lines", std::ios::binary) << text;
  }
  BatchFolder begin(BatchInput& input, std::int64_t chunk) const {
    make_folder(folder_ / "results");
    return {folder_ / "results", input.contents(), "data", chunk};
  }
  /// A chunk with the record "{}" for each of its lines.
  static void write_chunk(const BatchFolder& folder, BatchInput& input,
                          std::int64_t chunk) {
    input.seek(0);
    std::string key;
    for (std::int64_t i = 0; i <= chunk; ++i) key = folder.read_key(i, input);
    ChunkWriter writer(folder.chunk_file(chunk));
    writer.add("{}\n", BatchStatus::ok);
    writer.publish(key);
  }
};

TEST_F(BatchFolderTest, EqualLinesOfTwoChunksHaveTwoKeys) {
  put("a\na\na\n");
  BatchInput input(folder_ / "lines");
  const auto folder = begin(input, 1);
  EXPECT_EQ(folder.manifest().chunks(), 3);
  const auto first = folder.read_key(0, input);
  EXPECT_NE(first, folder.read_key(1, input));
}

TEST_F(BatchFolderTest, IsNotPutTogetherWhileAChunkIsMissing) {
  put("a\nb\n");
  BatchInput input(folder_ / "lines");
  const auto folder = begin(input, 1);
  write_chunk(folder, input, 0);
  EXPECT_THROW(folder.assemble(input), InputError);
  EXPECT_FALSE(fs::exists(folder_ / "results/results.jsonl"));
  EXPECT_FALSE(folder.complete());
  write_chunk(folder, input, 1);
  const auto summary = folder.assemble(input);
  EXPECT_EQ(summary.counts.ok, 2);
  EXPECT_EQ(summary.bytes, 6);
  EXPECT_EQ(summary.sha256, sha256_hex("{}\n{}\n"));
  EXPECT_FALSE(fs::exists(folder.work()));
  ASSERT_TRUE(folder.complete());
  EXPECT_EQ(folder.complete()->sha256, summary.sha256);
}

TEST_F(BatchFolderTest, AnInputThatChangesUnderTheRunIsNotedWhateverTheChunksSay) {
  put("a\nb\n");
  BatchInput input(folder_ / "lines");
  const auto folder = begin(input, 1);
  put("a\nc\n");  // both chunks answer what is read now
  write_chunk(folder, input, 0);
  write_chunk(folder, input, 1);
  EXPECT_THROW(folder.assemble(input), InputError);
  put("a\nb\n");
  EXPECT_THROW(folder.assemble(input), InputError);
  EXPECT_FALSE(fs::exists(folder_ / "results/results.jsonl"));
}

TEST_F(BatchFolderTest, ALockTellsWhyItIsNotHad) {
  const auto told = [](const fs::path& folder) {
    try {
      const FolderLock lock(folder);
    } catch (const OutputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(told(folder_), "");
  const FolderLock lock(folder_);
  EXPECT_NE(told(folder_).find("another run"), std::string::npos);
  EXPECT_NE(told(folder_ / "none").find("No such file"), std::string::npos);
}

TEST(Shards, AreConsecutiveAndCoverEveryChunkOnce) {
  for (const std::int64_t chunks : {0, 1, 7, 1000})
    for (const std::int64_t count : {1, 2, 7, 13}) {
      std::int64_t next = 0;
      for (std::int64_t index = 1; index <= count; ++index) {
        const Shard shard{index, count};
        EXPECT_EQ(shard.first(chunks), next);
        next = shard.end(chunks);
        EXPECT_LE(next - shard.first(chunks), chunks / count + 1);
      }
      EXPECT_EQ(next, chunks);
    }
}

using DataDigest = TemporaryFolder;

TEST_F(DataDigest, ChangesWithEveryFileAndName) {
  fs::create_directories(folder_ / "materials");
  fs::create_directories(folder_ / "tools/fixed");
  std::ofstream(folder_ / "materials/a.json") << "1";
  const auto first = data_sha256(folder_);
  std::ofstream(folder_ / "tools/fixed/b.json") << "2";
  const auto second = data_sha256(folder_);
  fs::rename(folder_ / "tools/fixed/b.json", folder_ / "tools/fixed/c.json");
  const auto third = data_sha256(folder_);
  std::ofstream(folder_ / "materials/readme.txt") << "3";
  EXPECT_EQ(data_sha256(folder_), third);
  EXPECT_NE(first, second);
  EXPECT_NE(second, third);
}

TEST_F(DataDigest, IsOfTheLanguageThatResultsAreIn) {
  fs::create_directories(folder_ / "materials");
  fs::create_directories(folder_ / "languages/de");
  std::ofstream(folder_ / "materials/a.json") << "1";
  const auto english = data_sha256(folder_);
  std::ofstream(folder_ / "languages/de/all.json") << "2";
  EXPECT_EQ(data_sha256(folder_), english);
  speak("de", {});
  EXPECT_NE(data_sha256(folder_), english);
  speak("en", {});
}

}  // namespace
}  // namespace turnwright::service::folder_test
