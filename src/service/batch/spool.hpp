#pragma once
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "input.hpp"

namespace turnwright::service {

/// The lines of a batch while they arrive: a file without a name, so that nothing of them
/// remains when the process ends.
class Spool {
 public:
  /// @param beside  the file stands in the folder of this one.
  /// @throws OutputError here and below.
  explicit Spool(const std::filesystem::path& beside);
  ~Spool();
  Spool(const Spool&) = delete;
  Spool& operator=(const Spool&) = delete;

  void write(std::string_view text);
  /// A reader of all that was written, from the beginning.
  BatchInput lines() const;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace turnwright::service
