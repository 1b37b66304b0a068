#include "turnwright/service/job_store.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "temporary_folder.hpp"
#include "turnwright/service/batch_line.hpp"
#include "turnwright/service/batches.hpp"

namespace turnwright::service {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class JobStoreTest : public TemporaryFolder {
 protected:
  fs::path file() const { return folder_ / "jobs.sqlite"; }
};

JobStore::Record record(const JobStore::Line& line, std::string text) {
  return {line.job, line.number, "", std::move(text), false};
}

TEST_F(JobStoreTest, LinesAreTakenOnceInOrderOldestJobFirst) {
  JobStore store(file());
  const auto first = *store.submit("a\n\nb");
  const auto second = *store.submit("c\n");
  const auto lines = store.take(2);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].text + lines[1].text, "ab");
  EXPECT_EQ(lines[1].number, 3);  // the number in the sender's file
  const auto rest = store.take(9);
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].job, second);
  EXPECT_TRUE(store.take(9).empty());
  EXPECT_EQ(store.job(first)->lines, 2);
}

TEST_F(JobStoreTest, TooManyLinesAreNoJobAndEmptyOnesAreNone) {
  JobStore store(file());
  std::string lines;
  for (std::size_t i = 0; i <= JobStore::kMostLines; ++i) lines += "0\n";
  EXPECT_FALSE(store.submit(lines));
  EXPECT_TRUE(store.jobs().empty());
  EXPECT_TRUE(store.submit(std::string(2 * JobStore::kMostLines, '\n') + "a"));
  EXPECT_EQ(store.take(9).at(0).number,
            static_cast<std::int64_t>(2 * JobStore::kMostLines + 1));
}

TEST_F(JobStoreTest, ResultsStopWhereOneIsMissing) {
  JobStore store(file());
  const auto id = *store.submit("a\nb\nc");
  const auto lines = store.take(3);
  store.finish(
      std::vector{record(lines[0], R"({"x":1})"), record(lines[2], R"({"x":3})")});
  EXPECT_EQ(store.results(id, 1, 1000).jsonl, "{\"line\":1,\"x\":1}\n");
  EXPECT_EQ(store.results(id, 1, 1000).next, 2);
  EXPECT_EQ(store.job(id)->state, "running");
  store.finish(std::vector{record(lines[1], R"({"x":2})")});
  EXPECT_EQ(store.job(id)->state, "done");
  EXPECT_EQ(store.results(id, 2, 1000).jsonl,
            "{\"line\":2,\"x\":2}\n{\"line\":3,\"x\":3}\n");
  EXPECT_EQ(store.results(id, 1, 1).next, 2);  // a page holds at least one line
}

TEST_F(JobStoreTest, WhatWasTakenAndNotFinishedIsTakenAgainAfterARestart) {
  {
    JobStore store(file());
    store.submit("a\nb\nc");
    const auto lines = store.take(2);
    store.finish(std::vector{record(lines[0], "{}")});
  }
  JobStore store(file());
  const auto lines = store.take(9);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].text + lines[1].text, "bc");
  EXPECT_EQ(store.job(1)->done, 1);
}

TEST_F(JobStoreTest, ARecordOnceStoredStays) {
  JobStore store(file());
  const auto id = *store.submit("a");
  const auto lines = store.take(1);
  store.finish(
      std::vector{record(lines[0], R"({"x":1})"), record(lines[0], R"({"x":2})")});
  EXPECT_EQ(store.results(id, 1, 1000).jsonl, "{\"line\":1,\"x\":1}\n");
  EXPECT_EQ(store.job(id)->done, 1);
}

TEST_F(JobStoreTest, CancelledLinesAreLeftAndRemovedJobsForgotten) {
  JobStore store(file());
  const auto id = *store.submit("a\nb\n");
  const auto lines = store.take(1);
  EXPECT_TRUE(store.cancel(id));
  EXPECT_TRUE(store.take(9).empty());
  store.finish(std::vector{record(lines[0], "{}")});
  EXPECT_EQ(store.job(id)->state, "cancelled");
  EXPECT_EQ(store.job(id)->done, 1);
  EXPECT_TRUE(store.remove(id));
  EXPECT_FALSE(store.job(id));
  EXPECT_FALSE(store.remove(id));
  EXPECT_FALSE(store.cancel(id));
  store.finish(std::vector{record(lines[0], "{}")});  // too late: no harm
  EXPECT_TRUE(store.jobs().empty());
}

TEST_F(JobStoreTest, OneProcessAtATimeAndOnlyJobStores) {
  JobStore store(file());
  EXPECT_THROW(JobStore{file()}, std::runtime_error);
  std::ofstream(folder_ / "text") << std::string(4096, 'x');
  EXPECT_THROW(JobStore{folder_ / "text"}, std::runtime_error);
  EXPECT_THROW(JobStore{folder_ / "missing" / "jobs.sqlite"}, std::runtime_error);
}

TEST_F(JobStoreTest, BatchesAnswerEveryLineAndEqualOnesAlike) {
  const auto catalogue = document::load_catalogue(TURNWRIGHT_SOURCE_DIR);
  JobStore store(file());
  const std::string good = R"({"name": "multipass", "document": {"dt_mm": 8}})";
  std::vector<std::string> lines(40, good);
  lines[3] = "no json";
  lines[4] = R"({"name": "multipas", "document": {}})";
  lines[5] = R"({"name": "multipass", "document": {"dt_mm": "8"}})";
  lines[6] = R"({"name": "multipass", "document": {"dt_mm": 100}})";
  std::string text;
  for (const auto& line : lines) text += line + '\n';
  const auto id = *store.submit(text);
  {
    Batches batches(store, catalogue, 2);
    while (store.job(id)->state == "running")
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(store.job(id)->errors, 3);
  std::istringstream results(store.results(id, 1, 100'000'000).jsonl);
  std::vector<json> all;
  for (std::string line; std::getline(results, line);) all.push_back(json::parse(line));
  ASSERT_EQ(all.size(), lines.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].at("line"), i + 1);
    EXPECT_EQ(all[i].at("status"), i >= 3 && i <= 5 ? "error"
                                   : i == 6         ? "infeasible"
                                                    : "ok");
  }
  EXPECT_EQ(all[0].at("result"), all[39].at("result"));
  EXPECT_EQ(all[4].at("errors").at(0).at("pointer"), "/name");
  EXPECT_EQ(all[5].at("errors").at(0).at("pointer"), "/dt_mm");
}

}  // namespace
}  // namespace turnwright::service
