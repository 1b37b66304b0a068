#include "folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <vector>

#include "base/say.hpp"
#include "document/json/file.hpp"
#include "document/json/reader.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/base/pattern.hpp"

namespace turnwright::service {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr long kMost = std::numeric_limits<long>::max();
const std::vector<std::string> kManifestFormat{"turnwright-batch/1"};
const std::vector<std::string> kSummaryFormat{"turnwright-batch-summary/1"};

struct Stored {
  std::string version;
  BatchManifest manifest;
};

Stored read_manifest(const fs::path& file) {
  const auto json = document::parse_file(file);
  document::Problems problems{.document = file.string()};
  auto r = document::Reader(json, problems).as_object();
  r.at("format").as_choice(kManifestFormat);
  Stored stored{r.text("turnwright_version"), {}};
  auto input = r.object("input");
  stored.manifest.input = {input.text("sha256"), input.integer("bytes", 0, kMost),
                           input.integer("lines", 0, kMost)};
  input.finish();
  stored.manifest.data_sha256 = r.text("data_sha256");
  stored.manifest.chunk_lines = r.integer("chunk_lines", 1, kMost);
  r.finish();
  problems.throw_if_any();
  return stored;
}

std::string told(const BatchInput::Contents& input) {
  return say("{} lines, SHA-256 {}", input.lines, input.sha256);
}

void require_same(const fs::path& file, const Stored& begun, const BatchManifest& now) {
  document::Problems problems{.document = file.string()};
  const auto same = [&](const char* pointer, const std::string& got,
                        const std::string& expected) {
    if (got != expected)
      problems.add({pointer, got, say("{}, with which this batch was begun", expected),
                    "changed"});
  };
  same("/turnwright_version", std::string(version()), begun.version);
  same("/input", told(now.input), told(begun.manifest.input));
  same("/data_sha256", now.data_sha256, begun.manifest.data_sha256);
  same("/chunk_lines", std::to_string(now.chunk_lines),
       std::to_string(begun.manifest.chunk_lines));
  problems.throw_if_any();
}

[[noreturn]] void refuse(const fs::path& file, const std::string& got,
                         const std::string& expected) {
  throw InputError(file.string(), {{"", got, expected, "file"}});
}

std::string text_of(const BatchSummary& summary) {
  const auto& counts = summary.counts;
  const ordered_json json{
      {"format", kSummaryFormat[0]},
      {"records", counts.records()},
      {"ok", counts.ok},
      {"infeasible", counts.infeasible},
      {"errors", counts.errors},
      {"results", {{"bytes", summary.bytes}, {"sha256", summary.sha256}}}};
  return json.dump(2) + '\n';
}

BatchSummary read_summary(const fs::path& file) {
  const auto json = document::parse_file(file);
  document::Problems problems{.document = file.string()};
  auto r = document::Reader(json, problems).as_object();
  r.at("format").as_choice(kSummaryFormat);
  const long records = r.integer("records", 0, kMost);
  BatchSummary summary;
  summary.counts = {r.integer("ok", 0, kMost), r.integer("infeasible", 0, kMost),
                    r.integer("errors", 0, kMost)};
  auto results = r.object("results");
  summary.bytes = results.integer("bytes", 0, kMost);
  summary.sha256 = results.text("sha256");
  results.finish();
  r.finish();
  problems.throw_if_any();
  if (records != summary.counts.records())
    refuse(file, say("{} records", records), tr("ok, infeasible and errors together"));
  return summary;
}

// Incomplete files have a name with a dot and a number (NewFile).
bool is_of_work(const std::string& name) {
  static const Pattern kNames(
      R"(\d+\.jsonl|slurm\.sh|slurm-\d+\.log|\.(\d+\.jsonl|slurm\.sh|manifest\.json|)"
      R"(results\.jsonl|summary\.json)\.[0-9a-f]{16})");
  return kNames.match(name).has_value();
}

/// Removes the batch's own files from its folder `work`, and the folder if it is then
/// empty. Follows no link.  Files that could not be removed are removed by the next run.
void remove_work(const fs::path& work) {
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(work, error))) return;
  for (const auto& entry : fs::directory_iterator(work, error))
    if (fs::is_regular_file(entry.symlink_status(error)) &&
        is_of_work(entry.path().filename().string()))
      fs::remove(entry.path(), error);
  fs::remove(work, error);
}

/// Whether this folder `work` is from a run that ended before it had written its
/// manifest.
bool is_before_manifest(const fs::path& work) {
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(work, error))) return false;
  return std::all_of(
      fs::directory_iterator(work, error), fs::directory_iterator(),
      [](const auto& entry) {
        return entry.path().filename().string().starts_with(".manifest.json.");
      });
}

/// A file or folder with a name that batches use; without a manifest it is of no batch.
std::optional<fs::path> stranger(const fs::path& folder) {
  const auto there = [](const fs::path& file) {
    std::error_code error;
    return fs::exists(fs::symlink_status(file, error));
  };
  for (const char* name : {"results.jsonl", "summary.json"})
    if (there(folder / name)) return folder / name;
  const auto work = folder / "work";
  if (there(work) && !is_before_manifest(work)) return work;
  return std::nullopt;
}

}  // namespace

std::string BatchManifest::text() const {
  const ordered_json json{
      {"format", kManifestFormat[0]},
      {"turnwright_version", version()},
      {"input",
       {{"sha256", input.sha256}, {"bytes", input.bytes}, {"lines", input.lines}}},
      {"data_sha256", data_sha256},
      {"chunk_lines", chunk_lines}};
  return json.dump(2) + '\n';
}

std::string data_sha256(const fs::path& data_folder) {
  std::vector<fs::path> files;
  const std::vector<std::string> folders{"materials", "tools", "machines", "shops",
                                         "languages/" + language()};
  for (const auto& folder : folders)
    if (fs::is_directory(data_folder / folder))
      for (const auto& entry : fs::recursive_directory_iterator(data_folder / folder))
        if (entry.path().extension() == ".json")
          files.push_back(fs::relative(entry.path(), data_folder));
  std::sort(files.begin(), files.end());
  std::string digests;
  for (const auto& file : files) {
    std::ifstream in(data_folder / file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    digests += file.generic_string() + ' ' + sha256_hex(text) + '\n';
  }
  return sha256_hex(digests);
}

BatchFolder::BatchFolder(fs::path folder, const BatchInput::Contents& input,
                         const std::string& data_sha256,
                         std::optional<std::int64_t> chunk_lines)
    : folder_(std::move(folder)) {
  manifest_.input = input;
  manifest_.data_sha256 = data_sha256;
  if (chunk_lines) manifest_.chunk_lines = *chunk_lines;
  const auto file = folder_ / "manifest.json";
  // Files of others are looked for before the manifest: between the two another shard may
  // start the batch.
  const auto strange = stranger(folder_);
  if (fs::exists(file)) {
    const Stored begun = read_manifest(file);
    if (!chunk_lines) manifest_.chunk_lines = begun.manifest.chunk_lines;
    require_same(file, begun, manifest_);
  } else {
    if (strange)
      refuse(
          *strange, tr("something of no batch: there is no manifest.json"),
          tr("a folder without results.jsonl, summary.json and work, or one that a batch "
             "was begun in"));
    make_folder(work());
    NewFile out(file, work());
    out.write(manifest_.text());
    out.publish();
  }
  id_ = sha256_hex(manifest_.text());
}

fs::path BatchFolder::chunk_file(std::int64_t chunk) const {
  return work() / (std::to_string(chunk) + ".jsonl");
}

Sha256 BatchFolder::key_of(std::int64_t chunk) const {
  Sha256 key;
  key.update(id_ + ' ' + std::to_string(chunk) + '\n');
  return key;
}

std::string BatchFolder::read_key(std::int64_t chunk, BatchInput& input) const {
  Sha256 key = key_of(chunk);
  for (std::int64_t i = 0; i < manifest_.chunk_lines && input.next(key); ++i) continue;
  return key.hex();
}

std::optional<BatchSummary> BatchFolder::complete() const {
  const auto summary_file = folder_ / "summary.json";
  const auto file = folder_ / "results.jsonl";
  if (!fs::exists(summary_file) || !fs::exists(file)) return std::nullopt;
  const auto summary = read_summary(summary_file);
  const auto found = BatchInput(file).contents();
  if (found.bytes != summary.bytes || found.sha256 != summary.sha256)
    refuse(file, say("{} bytes, SHA-256 {}", found.bytes, found.sha256),
           say("{} bytes, SHA-256 {}, as this batch wrote it; without the file it is "
               "made anew",
               summary.bytes, summary.sha256));
  remove_work(work());
  return summary;
}

BatchSummary BatchFolder::assemble(BatchInput& input) const {
  BatchSummary summary;
  Sha256 digest;
  make_folder(work());  // of a batch without a line
  NewFile out(folder_ / "results.jsonl", work());
  input.seek(0);
  for (std::int64_t chunk = 0; chunk < manifest_.chunks(); ++chunk) {
    const auto counts =
        read_chunk(chunk_file(chunk), read_key(chunk, input), [&](std::string_view some) {
          out.write(some);
          digest.update(some);
          summary.bytes += static_cast<std::int64_t>(some.size());
        });
    if (!counts)
      refuse(chunk_file(chunk), tr("no whole chunk"),
             tr("the records of this batch; run again"));
    summary.counts += *counts;
  }
  if (input.contents() != manifest_.input)
    refuse(input.file(), tr("another content than when the run began"),
           tr("a file that nobody changes meanwhile"));
  summary.sha256 = digest.hex();
  out.publish();
  NewFile told(folder_ / "summary.json", work());
  told.write(text_of(summary));
  told.publish();
  remove_work(work());
  return summary;
}

FolderLock::FolderLock(const fs::path& folder)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  const std::string why = errno == EWOULDBLOCK
                              ? tr("another run is at work on this batch")
                              : std::strerror(errno);
  if (descriptor_ >= 0) ::close(descriptor_);
  throw OutputError(folder.string() + ": " + why);
}

FolderLock::~FolderLock() { ::close(descriptor_); }

}  // namespace turnwright::service
