#pragma once
#include <signal.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace turnwright::service {

/// Lines of jobs that end the process.  While an object lives, a fault of the process
/// (out of stack, abort()) first notes in a file which line its thread computes, so that
/// the next process can go on without it.  A kill from outside (SIGKILL) notes nothing:
/// it says nothing about the line.  One object at a time.
class FatalLines {
 public:
  struct Line {
    std::int64_t job = 0, number = 0;
  };

  /// @param notes  made when there is something to note.
  explicit FatalLines(const std::filesystem::path& notes);
  ~FatalLines();
  FatalLines(const FatalLines&) = delete;
  FatalLines& operator=(const FatalLines&) = delete;

  /// What is noted in the file; nothing if there is none.
  static std::vector<Line> noted(const std::filesystem::path& notes);

  /// While it lives, this thread computes the line.
  class Computing {
   public:
    explicit Computing(const Line& line);
    ~Computing();
    Computing(const Computing&) = delete;
    Computing& operator=(const Computing&) = delete;

   private:
    Line line_;
    std::array<char, 32'768> stack_;  ///< that a fault is noted on: no other may be left
    stack_t before_{};
  };
};

}  // namespace turnwright::service
