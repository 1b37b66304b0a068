#pragma once
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

#include "turnwright/service/job_store.hpp"
#include "turnwright/service/requests.hpp"

namespace turnwright::service {

/// Works through the jobs of a store until it is destroyed; then leaves what is under
/// way, to be taken again by the next process.
class Batches {
 public:
  /// @param threads  at least 1; they give way to interactive work.
  Batches(JobStore& store, const document::Catalogue& catalogue, unsigned threads);
  ~Batches();

  JobStore& store() { return store_; }
  /// Tells the workers that there are new lines.
  void wake();

 private:
  void work(const std::stop_token& stop);
  bool work_some(const std::stop_token& stop);

  JobStore& store_;
  const document::Catalogue& catalogue_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::uint64_t wakes_ = 0;
  std::vector<std::jthread> workers_;
};

}  // namespace turnwright::service
