#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "service/digest.hpp"

namespace turnwright::service {

/// The lines of a file, one at a time: what it holds in memory does not depend on their
/// number.
class BatchInput {
 public:
  /// @throws InputError if there is no regular file that can be read, here and below.
  explicit BatchInput(const std::filesystem::path& file);
  ~BatchInput();
  BatchInput(const BatchInput&) = delete;
  BatchInput& operator=(const BatchInput&) = delete;

  /// Goes to the next line, false behind the last one.  Every byte of it goes to
  /// `digest`; `text`, where wanted, gets it without its end, cut where it is longer than
  /// any request may be (document::ParseLimits) and one byte.
  bool next(Sha256& digest, std::string* text = nullptr);

  /// Where the next line begins [bytes].
  std::int64_t position() const { return position_; }
  void seek(std::int64_t position);

  /// Of the whole file; goes to its beginning and back.
  struct Contents {
    std::string sha256;
    std::int64_t bytes = 0, lines = 0;
    bool operator==(const Contents&) const = default;
  };
  Contents contents();

  const std::filesystem::path& file() const { return file_; }

 private:
  bool fill();

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< of what is in the buffer and not yet given
  std::int64_t position_ = 0;
};

}  // namespace turnwright::service
