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

/// A file that appears whole or not at all: it is written under a temporary name and
/// renamed when it is complete.  Several processes, on several machines, may write the
/// same file at once; the last one wins.  Links are followed.
class NewFile {
 public:
  /// @param scratch  folder for the incomplete file, on the same file system; "": the
  ///   folder of the file.
  /// @throws OutputError here and below.
  explicit NewFile(std::filesystem::path file, const std::filesystem::path& scratch = {});
  ~NewFile();  ///< removes a file that was not published
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

/// Writes `text` to the file, whole or not at all.  A device or pipe (/dev/stdout) is
/// written directly.
void write_file(const std::filesystem::path& file, std::string_view text);

struct NamedText {
  std::string name, text;
};

/// Writes `files` into the folder and removes all other files whose names `ours` accepts,
/// which are those of an earlier run.  Everything new is on the disk before the first old
/// file is removed, and every old file is removed before the first new one gets its name.
/// So the folder never shows files of two runs, even after an interruption.  Links are
/// followed.
/// @return the names of removed files without a successor, sorted.
/// @throws OutputError
std::vector<std::string> replace_files(const std::filesystem::path& folder,
                                       const std::vector<NamedText>& files,
                                       const std::function<bool(std::string_view)>& ours);

/// Makes the folder and its parents if they are missing.
void make_folder(const std::filesystem::path& folder);

/// Writes to standard output and checks that all was written.  Control characters in the
/// lines are made visible(), so that names cannot command a terminal; JSON keeps its
/// meaning.
/// @param style  gives each line its colours; absent: none.
void print(const std::string& text, std::string (*style)(std::string_view) = nullptr);

}  // namespace turnwright::service
