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

/// The records of consecutive lines in a file that appears at once and tells by itself
/// whether it is whole: behind the records a line seals them,
///
///     {"ok": 97, "infeasible": 2, "errors": 1, "sha256": ..}
///
/// with the SHA-256 over the chunk's key, the records and the three counts.  The key says
/// what the records answer (batch_folder.hpp); a file of another key is not accepted.
namespace turnwright::service {

/// How lines ended.
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

  /// @param record  with its line's end.
  void add(std::string_view record, BatchStatus status);
  void publish(std::string_view key);

 private:
  NewFile file_;
  Sha256 records_;
  BatchCounts counts_;
};

/// What the chunk in `file` counts; none if it is missing, not whole, or of another key.
/// @param records  gets the records piece by piece; void where none is returned.
std::optional<BatchCounts> read_chunk(
    const std::filesystem::path& file, std::string_view key,
    const std::function<void(std::string_view)>& records = {});

}  // namespace turnwright::service
