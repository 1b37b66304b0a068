#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "chunk.hpp"
#include "input.hpp"

/// The folder of a batch:
///
///     manifest.json    input, data and version; number of lines per chunk
///     work/N.jsonl     chunk N (from 0), while the batch is not complete
///     results.jsonl    every record, in the order of lines; appears at once
///     summary.json     records of each kind, length and SHA-256 of results.jsonl
///
/// Everything is a function of the input, the data and the version, and no file is
/// changed once it has its name.  So a run that is killed, cut off or started twice does
/// no harm, on one machine or on several that share the folder.
namespace turnwright::service {

struct BatchManifest {
  BatchInput::Contents input;
  std::string data_sha256;  ///< of materials, tools and machines, and the language
  std::int64_t chunk_lines = 100;

  std::string text() const;  ///< content of manifest.json, with the version
  std::int64_t chunks() const { return (input.lines + chunk_lines - 1) / chunk_lines; }
};

struct BatchSummary {
  BatchCounts counts;
  std::int64_t bytes = 0;  ///< of results.jsonl
  std::string sha256;
};

/// SHA-256 over names and contents of all files that load_catalogue() reads, and of the
/// translations into the program's language: results have sentences.
std::string data_sha256(const std::filesystem::path& data_folder);

class BatchFolder {
 public:
  /// Starts a batch in the folder, or continues it.
  /// @param chunk_lines  none: the number the batch was started with, or the default of
  ///   BatchManifest for a new batch.
  /// @throws InputError if the batch was started with another input, other data, version
  ///   or chunks, or if the folder has no manifest but a file with a name that batches
  ///   use; OutputError.
  BatchFolder(std::filesystem::path folder, const BatchInput::Contents& input,
              const std::string& data_sha256, std::optional<std::int64_t> chunk_lines);

  const std::filesystem::path& path() const { return folder_; }
  const BatchManifest& manifest() const { return manifest_; }
  std::filesystem::path work() const { return folder_ / "work"; }
  std::filesystem::path chunk_file(std::int64_t chunk) const;

  /// A digest that becomes the chunk's key once it has received the chunk's lines.
  Sha256 key_of(std::int64_t chunk) const;
  /// The key of the chunk whose lines come next; the input is then behind them.
  std::string read_key(std::int64_t chunk, BatchInput& input) const;

  /// The summary of a complete batch; none if it is not complete.
  /// @throws InputError if results.jsonl was changed.
  std::optional<BatchSummary> complete() const;

  /// Puts the chunks together and removes the batch's files from `work/`.
  /// @throws OutputError; InputError if a chunk is missing or the input has changed.
  BatchSummary assemble(BatchInput& input) const;

 private:
  std::filesystem::path folder_;
  BatchManifest manifest_;
  std::string id_;
};

/// A lock that excludes a second run from the folder; it also ends with a killed process.
class FolderLock {
 public:
  /// @throws OutputError if another run holds it.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace turnwright::service
