#pragma once
#include <signal.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace turnwright::service {

/// Lines of jobs that end the process.  While an object of this class lives, a fault of
/// the process (out of stack, abort()) first notes in a file which line its thread
/// computes, so that the next process can continue without it.  A kill from outside
/// (SIGKILL) notes nothing, because the line is not its cause.  There may be one object
/// at a time.
class FatalLines {
 public:
  struct Line {
    std::int64_t job = 0, number = 0;
  };

  /// @param notes  file that is created when there is something to note.
  explicit FatalLines(const std::filesystem::path& notes);
  ~FatalLines();
  FatalLines(const FatalLines&) = delete;
  FatalLines& operator=(const FatalLines&) = delete;

  /// The lines noted in the file; none if there is no file.
  static std::vector<Line> noted(const std::filesystem::path& notes);

  /// Marks the line that this thread computes while the object lives.
  class Computing {
   public:
    explicit Computing(const Line& line);
    ~Computing();
    Computing(const Computing&) = delete;
    Computing& operator=(const Computing&) = delete;

   private:
    Line line_;
    std::array<char, 32'768> stack_;  ///< stack of the handler, as the other may be full
    stack_t before_{};
  };
};

}  // namespace turnwright::service
