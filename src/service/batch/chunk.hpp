#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "line.hpp"
#include "service/digest.hpp"
#include "service/output.hpp"

/// The records of consecutive lines, in a file that appears at once and shows by itself
/// whether it is complete: behind the records a last line seals them,
///
///     {"ok": 97, "infeasible": 2, "errors": 1, "sha256": ..}
///
/// with the SHA-256 over the chunk's key, the records and the three counts.  The key
/// identifies the requests that the records answer (folder.hpp); a file with another key
/// is not accepted.
namespace turnwright::service {

/// Numbers of lines by their status.
struct BatchCounts {
  std::int64_t ok = 0, infeasible = 0, errors = 0;

  std::int64_t records() const { return ok + infeasible + errors; }
  void add(BatchStatus status);
  BatchCounts& operator+=(const BatchCounts& other);
};

class ChunkWriter {
 public:
  /// @throws OutputError here and below.
  explicit ChunkWriter(const std::filesystem::path& file) : file_(file) {}

  /// @param record  a record with the end of its line.
  void add(std::string_view record, BatchStatus status);
  void publish(std::string_view key);

 private:
  NewFile file_;
  Sha256 records_;
  BatchCounts counts_;
};

/// The counts of the chunk in `file`; none if it is missing, incomplete, or has another
/// key.
/// @param records  receives the records piece by piece; they are void if none is
///   returned.
std::optional<BatchCounts> read_chunk(
    const std::filesystem::path& file, std::string_view key,
    const std::function<void(std::string_view)>& records = {});

}  // namespace turnwright::service
