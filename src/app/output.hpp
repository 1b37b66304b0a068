#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>

namespace turnwright::app {

/// A result that could not be written; the message names the file and the reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Puts `text` into the file whole or not at all: it is written beside the file, flushed
/// to the disk and renamed.  Links are followed; what is no regular file (/dev/stdout, a
/// pipe) is written straight.
void write_file(const std::filesystem::path& file, const std::string& text);

/// Makes the folder if it is missing, and those above it.
void make_folder(const std::filesystem::path& folder);

/// Writes to standard output and makes sure that it arrived.
void print(const std::string& text);

}  // namespace turnwright::app
