#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace turnwright::service {

/// A result that could not be written; the message names the file and the reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that appears whole or not at all: written under a name of its own, renamed when
/// it is complete.  Several processes, on several machines, may make the same file at
/// once; the last one stands.  Links are followed.
class NewFile {
 public:
  /// @param scratch  folder on the file's file system for what is not complete; "": the
  ///   file's own.
  /// @throws OutputError here and below.
  explicit NewFile(std::filesystem::path file, const std::filesystem::path& scratch = {});
  ~NewFile();  ///< leaves nothing of a file that was not published
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void write(std::string_view text);
  /// Flushes to the disk and renames.
  void publish();

 private:
  void check(bool good) const;

  std::filesystem::path file_, target_, temporary_;
  int descriptor_ = -1;
};

/// Puts `text` into the file whole or not at all.  What is no regular file (/dev/stdout,
/// a pipe) is written straight.
void write_file(const std::filesystem::path& file, std::string_view text);

/// Makes the folder if it is missing, and those above it.
void make_folder(const std::filesystem::path& folder);

/// Writes to standard output and makes sure that it arrived.
void print(const std::string& text);

}  // namespace turnwright::service
