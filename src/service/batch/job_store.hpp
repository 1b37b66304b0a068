#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace SQLite {
class Database;
}

namespace turnwright::service {

/// A batch as its owner sees it.
struct Job {
  std::int64_t id = 0;
  std::string state;  ///< "running", "cancelled", "done", or "outdated": see JobStore
  std::int64_t lines = 0;  ///< of the sender's file
  std::int64_t done = 0;   ///< of these: answered, or blank
  std::int64_t errors = 0;
};

/// Batches that outlive the process: requests and records in one SQLite file (WAL,
/// synchronous = FULL).  What submit() or finish() returned from is on disk; a killed
/// process loses at most the lines it had taken and not finished, and these are taken
/// again, but for one that ended the process itself (FatalLines): it is an error.  Safe
/// from several threads of one process; a second process is refused.
///
/// All records of a job, and every one that known() finds, were computed from the same
/// data: a job that was begun with others is "outdated", its records stay and no more are
/// added; one that has no record yet is gone on with.
class JobStore {
 public:
  struct Line {
    std::int64_t job = 0, number = 0;  ///< number from 1
    std::string text;
  };
  struct Record {
    std::int64_t job = 0, number = 0;
    std::string digest;  ///< of the request; "" where the record is an error
    std::string text;
    bool error = false;
  };
  struct Results {
    std::string jsonl;
    std::int64_t next = 0;  ///< number of the first line not in `jsonl`
  };

  /// @param data  digest of what answers depend on besides their request.
  /// @throws std::runtime_error if the file cannot be opened, is no job store of this
  ///   version or is in use; it is left as it was.
  JobStore(const std::filesystem::path& file, std::string data);
  ~JobStore();

  /// Where lines that end the process are noted for the next one.
  const std::filesystem::path& fatal_file() const { return fatal_file_; }

  /// A job of lines that end in "\n".  Blank lines count, so that numbers are those of
  /// the sender's file, and have no record.
  /// @return its id; none, and nothing is stored, if more lines than kMostLines are not
  ///   blank.
  /// @throws Cancelled, and nothing is stored, if `stop` is asked for before the end.
  std::optional<std::int64_t> submit(std::string_view text,
                                     const std::stop_token& stop = {});
  static constexpr std::size_t kMostLines = 1'000'000;
  std::optional<Job> job(std::int64_t id) const;
  std::vector<Job> jobs() const;
  /// Lines not yet taken are left; false if there is no such job.
  bool cancel(std::int64_t id);
  /// Removes the job and its results; false if there is none.
  bool remove(std::int64_t id);

  /// Up to `count` lines that nobody has taken, oldest job first.
  std::vector<Line> take(std::size_t count);
  /// The record of an equal request, if one is stored that was computed from these data.
  std::optional<std::string> known(const std::string& digest) const;
  void finish(std::span<const Record> records);

  /// Records in the order of lines from number `from` up to the first one missing, at
  /// most about `bytes`.
  Results results(std::int64_t id, std::int64_t from, std::size_t bytes) const;

 private:
  void finish_fatal_lines();

  mutable std::mutex mutex_;
  std::filesystem::path fatal_file_;
  std::string data_;
  std::unique_ptr<SQLite::Database> database_;
  std::map<std::int64_t, std::int64_t> taken_;  ///< last line taken, by job
};

}  // namespace turnwright::service
