#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
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

class Spool;

/// State of a batch.
struct Job {
  std::int64_t id = 0;
  std::string state;  ///< "running", "cancelled", "done", or "outdated": see JobStore
  std::int64_t lines = 0;  ///< lines of the file that was sent
  std::int64_t done = 0;   ///< lines of these that are answered or blank
  std::int64_t errors = 0;
};

/// Batches that survive the process: requests and records are in one SQLite file (WAL,
/// synchronous = FULL).  When submit() or finish() returns the data are on disk.  A
/// killed process loses at most the lines that it had taken and not finished.  These are
/// taken again, except a line that ended the process itself (FatalLines), which becomes
/// an error. May be used from several threads of one process; a second process is
/// refused.
///
/// All records of a job, and all records that known() finds, were computed from the same
/// data.  A job that was started with other data is "outdated": its records stay and no
/// more are added.  A job without records is continued.
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

  /// @param data  digest of the data on which answers depend apart from their request.
  /// @throws std::runtime_error if the file cannot be opened, is not a job store of this
  ///   version or is in use; it is then not changed.
  JobStore(const std::filesystem::path& file, std::string data);
  ~JobStore();

  /// File in which lines of a job may be kept while they arrive.
  std::shared_ptr<Spool> spool() const;
  /// File in which lines that end the process are noted for the next one.
  const std::filesystem::path& fatal_file() const { return fatal_file_; }

  /// The lines of a job: true and the next one, or false behind the last.
  using NextLine = std::function<bool(std::string& line)>;

  /// Stores a job of lines, which are not kept in memory.  Blank lines are counted, so that numbers
  /// are those of the file that was sent, but have no record.
  /// @return its id; none, with nothing stored, if more than kMostLines lines are not
  ///   blank.
  /// @throws Cancelled, with nothing stored, if a stop is requested before the end.
  std::optional<std::int64_t> submit(const NextLine& next,
                                     const std::stop_token& stop = {});
  /// The same for lines that end in "\n".
  std::optional<std::int64_t> submit(std::string_view text,
                                     const std::stop_token& stop = {});
  static constexpr std::size_t kMostLines = 1'000'000;
  std::optional<Job> job(std::int64_t id) const;
  std::vector<Job> jobs() const;
  /// Cancels the lines that have not been taken; false if there is no such job.
  bool cancel(std::int64_t id);
  /// Removes the job and its results; false if there is none.
  bool remove(std::int64_t id);

  /// Takes up to `count` lines that have not been taken, oldest job first.
  std::vector<Line> take(std::size_t count);
  /// The record of an equal request that was computed from these data, if one is stored.
  std::optional<std::string> known(const std::string& digest) const;
  void finish(std::span<const Record> records);

  /// Records in the order of lines, from number `from` up to the first missing one, at
  /// most about `bytes`.
  Results results(std::int64_t id, std::int64_t from, std::size_t bytes) const;

 private:
  void finish_fatal_lines();

  mutable std::mutex mutex_;
  std::filesystem::path file_, fatal_file_;
  std::string data_;
  std::unique_ptr<SQLite::Database> database_;
  std::map<std::int64_t, std::int64_t> taken_;  ///< last line taken, by job
};

}  // namespace turnwright::service
