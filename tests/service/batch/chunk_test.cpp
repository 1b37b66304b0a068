#include "service/batch/chunk.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "../../temporary_folder.hpp"

namespace turnwright::service::chunk_test {
namespace {

namespace fs = std::filesystem;

class BatchChunk : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    ChunkWriter writer(file());
    writer.add("{\"a\":1}\n", BatchStatus::ok);
    writer.add("{\"b\":2}\n", BatchStatus::error);
    writer.add("{\"c\":3}\n", BatchStatus::ok);
    writer.publish("key");
  }
  fs::path file() const { return folder_ / "0.jsonl"; }
  std::string bytes() const {
    std::ifstream in(file(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(BatchChunk, GivesBackWhatWasWritten) {
  std::string records;
  const auto counts =
      read_chunk(file(), "key", [&](std::string_view some) { records += some; });
  ASSERT_TRUE(counts);
  EXPECT_EQ(counts->ok, 2);
  EXPECT_EQ(counts->infeasible, 0);
  EXPECT_EQ(counts->errors, 1);
  EXPECT_EQ(records, "{\"a\":1}\n{\"b\":2}\n{\"c\":3}\n");
}

TEST_F(BatchChunk, OfAnotherKeyIsNotAccepted) {
  EXPECT_FALSE(read_chunk(file(), "keys"));
  EXPECT_FALSE(read_chunk(file(), ""));
  EXPECT_FALSE(read_chunk(folder_ / "1.jsonl", "key"));
  EXPECT_FALSE(read_chunk(folder_, "key"));
}

TEST_F(BatchChunk, CutAnywhereOrChangedAnywhereIsNotAccepted) {
  const auto whole = bytes();
  for (std::size_t size = 0; size < whole.size(); size += size < 30 ? 1 : 11) {
    std::ofstream(file(), std::ios::binary) << whole.substr(0, size);
    EXPECT_FALSE(read_chunk(file(), "key")) << size;
  }
  for (std::size_t at = 0; at < whole.size(); at += 3) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ (1 << at % 8));
    std::ofstream(file(), std::ios::binary) << changed;
    EXPECT_FALSE(read_chunk(file(), "key")) << at;
  }
  for (const std::string more : {"x", "\n", "{}\n"}) {
    std::ofstream(file(), std::ios::binary) << whole + more;
    EXPECT_FALSE(read_chunk(file(), "key"));
  }
  std::ofstream(file(), std::ios::binary) << whole;
  EXPECT_TRUE(read_chunk(file(), "key"));
}

TEST_F(BatchChunk, NotPublishedLeavesNothing) {
  {
    ChunkWriter writer(folder_ / "1.jsonl");
    writer.add("{}\n", BatchStatus::ok);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(BatchChunk, OfBlankLinesHoldsOnlyItsSeal) {
  ChunkWriter(folder_ / "1.jsonl").publish("key");
  const auto counts = read_chunk(folder_ / "1.jsonl", "key");
  ASSERT_TRUE(counts);
  EXPECT_EQ(counts->records(), 0);
}

}  // namespace
}  // namespace turnwright::service::chunk_test
