#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "runner.hpp"

/// A batch as job arrays of Slurm, whose tasks are shards of it and share the folder.
///
/// Slurm runs a task at least once, and may forget an array that it has acknowledged.  So
/// only the content of the folder counts: chunks that are missing when no task is left
/// are submitted again.
namespace turnwright::service {

struct SlurmOptions {
  std::filesystem::path program;  ///< its path on every node
  std::filesystem::path data;     ///< path of materials, tools and machines on every node
  std::int64_t task_lines = 1000;  ///< more if the array would have over 1000 tasks
  unsigned jobs = 1;               ///< cores of a task
};

class SlurmBatch {
 public:
  SlurmBatch(BatchInput& input, const BatchFolder& folder, SlurmOptions options);

  /// Submits the missing chunks as one array.
  /// @return the number of the array, "" if nothing is missing.
  /// @throws OutputError if Slurm refuses or tasks of this batch are in its queue.
  std::string submit();

  /// Waits until no task is left and submits the missing chunks, until none is missing.
  /// @throws OutputError if three arrays in a row bring nothing new, or if Slurm does not
  ///   answer for ten minutes.
  void complete(const std::function<void(const std::string&)>& tell);

 private:
  std::vector<std::int64_t> missing_tasks();
  std::string submit(const std::vector<std::int64_t>& tasks);
  void wait();

  BatchInput& input_;
  const BatchFolder& folder_;
  SlurmOptions options_;
  std::int64_t tasks_;
  std::string name_;  ///< of the arrays
};

}  // namespace turnwright::service
