#pragma once
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

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
  void flush();  ///< to the disk
  /// Flushes and renames.
  void publish();

 private:
  void check(bool good) const;

  std::filesystem::path file_, target_, temporary_;
  int descriptor_ = -1;
};

/// Puts `text` into the file whole or not at all.  What is no regular file (/dev/stdout,
/// a pipe) is written straight.
void write_file(const std::filesystem::path& file, std::string_view text);

struct NamedText {
  std::string name, text;
};

/// Makes the folder hold `files`, and of the names that `ours` knows no others: what an
/// earlier run left goes.  Everything new is on the disk before the first old file goes,
/// and every old one is gone before the first new one gets its name: whenever it is cut
/// short, the folder never shows files of two runs.  Links are followed.
/// @return the names that are gone, sorted.
/// @throws OutputError
std::vector<std::string> replace_files(const std::filesystem::path& folder,
                                       const std::vector<NamedText>& files,
                                       const std::function<bool(std::string_view)>& ours);

/// Makes the folder if it is missing, and those above it.
void make_folder(const std::filesystem::path& folder);

/// Writes to standard output and makes sure that it arrived.
void print(const std::string& text);

}  // namespace turnwright::service
