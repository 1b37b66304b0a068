#pragma once
#include <chrono>
#include <cstdint>
#include <string>

namespace turnwright::app {

/// One line on standard error that is written over and over, if that is a terminal.
class ProgressLine {
 public:
  /// @param what  that is counted, "lines".
  explicit ProgressLine(std::string what);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// @param found  of all that were there before; so many more are done.
  void tell(std::int64_t found, std::int64_t done, std::int64_t all);

 private:
  std::string what_;
  bool terminal_ = false;
  std::chrono::steady_clock::time_point begun_, told_;
};

}  // namespace turnwright::app
