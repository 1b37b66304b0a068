#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "service/digest.hpp"

namespace turnwright::service {

/// Reads the lines of a file one at a time, in memory that does not depend on their
/// number.
class BatchInput {
 public:
  /// @throws InputError if the file is not a readable regular file, here and below.
  explicit BatchInput(const std::filesystem::path& file);
  /// Reads an open file, which it closes; `file` names it in errors.
  BatchInput(int descriptor, std::filesystem::path file);
  ~BatchInput();
  BatchInput(const BatchInput&) = delete;
  BatchInput& operator=(const BatchInput&) = delete;

  /// Reads the next line; false behind the last one.  `digest` receives all its bytes.
  /// `text`, if given, receives the line without its end, but at most one byte more than
  /// the largest request (document::ParseLimits).
  bool next(Sha256& digest, std::string* text = nullptr) { return read(&digest, text); }
  bool next(std::string& text) { return read(nullptr, &text); }

  /// Position of the next line [bytes].
  std::int64_t position() const { return position_; }
  void seek(std::int64_t position);

  /// Digest and size of the whole file; the position is kept.
  struct Contents {
    std::string sha256;
    std::int64_t bytes = 0, lines = 0;
    bool operator==(const Contents&) const = default;
  };
  Contents contents();

  const std::filesystem::path& file() const { return file_; }

 private:
  bool read(Sha256* digest, std::string* text);
  bool fill();

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< of what is in the buffer and not yet given
  std::int64_t position_ = 0;
};

}  // namespace turnwright::service
