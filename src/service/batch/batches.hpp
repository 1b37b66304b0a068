#pragma once
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include "fatal_lines.hpp"
#include "job_store.hpp"
#include "service/requests.hpp"

namespace turnwright::service {

/// Computes the jobs of a store until it is destroyed.  Lines that are then being
/// computed are abandoned and computed again by the next process.
class Batches {
 public:
  /// @param threads  at least 1; they have a lower priority than interactive work.
  Batches(JobStore& store, const document::Catalogue& catalogue, unsigned threads);
  ~Batches();

  JobStore& store() { return store_; }
  /// As the functions of the store; lines of the job that are being computed are stopped
  /// and get no record.
  bool cancel(std::int64_t id);
  bool remove(std::int64_t id);
  /// Wakes the workers because there are new lines.
  void wake();

 private:
  /// The line that a worker computes, or has computed last.
  struct UnderWay {
    std::int64_t job = 0;
    std::stop_source stop{std::nostopstate};
  };

  void work(const std::stop_token& stop, UnderWay& own);
  bool work_some(const std::stop_token& stop, UnderWay& own);
  std::optional<JobStore::Line> next(UnderWay& own);
  void stop_lines(std::int64_t id);

  JobStore& store_;
  const document::Catalogue& catalogue_;
  const FatalLines fatal_lines_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::uint64_t wakes_ = 0;
  std::vector<UnderWay> under_way_;  ///< one a worker
  std::vector<std::jthread> workers_;
};

}  // namespace turnwright::service
