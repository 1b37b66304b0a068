#pragma once
#include <chrono>
#include <cstdint>
#include <string>

namespace turnwright::app {

/// A line on standard error that is rewritten as work proceeds, if that is a terminal.
class ProgressLine {
 public:
  /// @param line  in English, "{} of {} lines, {}/s, {} left": how many items of all, how
  ///   many a second, the time that is left.
  explicit ProgressLine(const char* line);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// @param found  items that were complete before this run; they count as done.
  void tell(std::int64_t found, std::int64_t done, std::int64_t all);

 private:
  const char* line_;
  bool terminal_ = false;
  std::chrono::steady_clock::time_point begun_, told_;
};

}  // namespace turnwright::app
