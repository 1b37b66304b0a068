#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace turnwright::document {

struct ZipEntry {
  std::string name, bytes;
};

/// The entries of a zip archive whose names `wanted` accepts, in the archive's order; their
/// bytes together are at most `most_bytes`, whatever sizes the archive states.
/// @throws InputError, whose pointer is the entry's name, if the archive or an entry cannot
///   be read, has more than 10,000 entries or unpacks to more bytes.
std::vector<ZipEntry> zip_entries(std::string_view archive, std::size_t most_bytes,
                                  const std::function<bool(std::string_view)>& wanted);

/// An archive of these entries.
/// @throws InputError, whose pointer is the entry's name, if one cannot be added.
std::string zipped(const std::vector<ZipEntry>& entries);

/// Whether bytes begin as a zip archive does.
bool is_zip(std::string_view bytes);

}  // namespace turnwright::document
