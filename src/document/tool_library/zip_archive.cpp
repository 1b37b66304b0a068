#include "zip_archive.hpp"

#include <zip.h>

#include <memory>

#include "base/say.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::document {
namespace {

constexpr zip_int64_t kMostFiles = 10'000;

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};

[[noreturn]] void refuse_zip(const std::string& entry, const std::string& got,
                             const std::string& expected, const std::string& code) {
  throw InputError(tr("zip archive"), {{entry, got, expected, code}});
}

std::string reason_of(zip_error_t& error) {
  std::string text = zip_error_strerror(&error);
  zip_error_fini(&error);
  return text;
}

std::unique_ptr<zip_t, Discard> opened(std::string_view bytes) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* const source =
      zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (!source) refuse_zip("", reason_of(error), tr("a zip archive"), "format");
  zip_t* const archive = zip_open_from_source(source, ZIP_RDONLY, &error);
  if (!archive) {
    zip_source_free(source);
    refuse_zip("", reason_of(error), tr("a zip archive"), "format");
  }
  zip_error_fini(&error);
  return std::unique_ptr<zip_t, Discard>(archive);
}

std::string read_entry(zip_t* archive, zip_uint64_t index, const std::string& name,
                       std::size_t most_bytes) {
  const std::unique_ptr<zip_file_t, Discard> file(zip_fopen_index(archive, index, 0));
  if (!file) refuse_zip(name, zip_strerror(archive), tr("an entry to read"), "format");
  std::string bytes, block(1 << 16, '\0');
  for (;;) {
    const auto count = zip_fread(file.get(), block.data(), block.size());
    if (count < 0)
      refuse_zip(name, zip_file_strerror(file.get()), tr("whole data"), "format");
    if (count == 0) return bytes;
    bytes.append(block, 0, static_cast<std::size_t>(count));
    if (bytes.size() > most_bytes)
      refuse_zip(name, tr("more bytes than the archive may unpack to"),
                 say("at most {} more bytes", most_bytes), "limit");
  }
}

}  // namespace

std::vector<ZipEntry> zip_entries(std::string_view archive, std::size_t most_bytes,
                                  const std::function<bool(std::string_view)>& wanted) {
  const auto zip = opened(archive);
  const auto count = zip_get_num_entries(zip.get(), 0);
  if (count > kMostFiles)
    refuse_zip("", say("{} entries", count), say("at most {}", kMostFiles), "limit");
  std::vector<ZipEntry> entries;
  for (zip_uint64_t i = 0; i < static_cast<zip_uint64_t>(count); ++i) {
    const char* const name = zip_get_name(zip.get(), i, 0);
    if (!name || !wanted(name)) continue;
    entries.push_back({name, read_entry(zip.get(), i, name, most_bytes)});
    most_bytes -= entries.back().bytes.size();
  }
  return entries;
}

std::string zipped(const std::vector<ZipEntry>& entries) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* const source = zip_source_buffer_create(nullptr, 0, 0, &error);
  if (!source) refuse_zip("", reason_of(error), tr("room for an archive"), "limit");
  zip_source_keep(source);
  const std::unique_ptr<zip_source_t, void (*)(zip_source_t*)> kept(source,
                                                                    zip_source_free);
  zip_t* const archive = zip_open_from_source(source, ZIP_TRUNCATE, &error);
  if (!archive) {
    zip_source_free(source);
    refuse_zip("", reason_of(error), tr("room for an archive"), "limit");
  }
  std::unique_ptr<zip_t, Discard> open(archive);
  for (const auto& [name, bytes] : entries) {
    zip_source_t* const entry = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
    if (zip_file_add(archive, name.c_str(), entry, ZIP_FL_ENC_UTF_8) >= 0) continue;
    zip_source_free(entry);
    refuse_zip(name, zip_strerror(archive), tr("a file of another name"), "duplicate");
  }
  if (zip_close(archive) != 0)
    refuse_zip("", zip_strerror(archive), tr("room for an archive"), "limit");
  (void)open.release();
  std::string all, block(1 << 16, '\0');
  zip_source_open(source);
  for (zip_int64_t n = 0; (n = zip_source_read(source, block.data(), block.size())) > 0;)
    all.append(block, 0, static_cast<std::size_t>(n));
  zip_source_close(source);
  return all;
}

bool is_zip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

}  // namespace turnwright::document
