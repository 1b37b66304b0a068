#include "chunk.hpp"

#include <fstream>
#include <vector>

namespace turnwright::service {
namespace {

// The seal is shorter, whatever it counts.
constexpr std::streamoff kLongestSeal = 512;

/// Over digests of fixed length, so that no two chunks give the same bytes.
std::string sealed_sha256(std::string_view key, std::string_view records,
                          const BatchCounts& counts) {
  return sha256_hex(std::string(key) + ' ' + std::string(records) + ' ' +
                    std::to_string(counts.ok) + ' ' + std::to_string(counts.infeasible) +
                    ' ' + std::to_string(counts.errors));
}

std::string seal(std::string_view key, std::string_view records,
                 const BatchCounts& counts) {
  const nlohmann::ordered_json line{{"ok", counts.ok},
                                    {"infeasible", counts.infeasible},
                                    {"errors", counts.errors},
                                    {"sha256", sealed_sha256(key, records, counts)}};
  return line.dump() + '\n';
}

std::string last_line(std::istream& in, std::streamoff size) {
  const auto from = std::max<std::streamoff>(0, size - kLongestSeal);
  std::string tail(static_cast<std::size_t>(size - from), '\0');
  in.seekg(from);
  in.read(tail.data(), size - from);
  if (!in || tail.empty() || tail.back() != '\n') return {};
  const auto before = tail.rfind('\n', tail.size() - 2);
  return tail.size() < 2 || before == tail.npos ? tail : tail.substr(before + 1);
}

BatchCounts counts_of(const std::string& line) {
  const auto json = nlohmann::json::parse(line, nullptr, false);
  const auto count = [&](const char* name) {
    const auto member = json.is_object() ? json.find(name) : json.end();
    const bool counts = member != json.end() && member->is_number_integer();
    return counts ? member->get<std::int64_t>() : -1;
  };
  return {count("ok"), count("infeasible"), count("errors")};
}

}  // namespace

void BatchCounts::add(BatchStatus status) {
  switch (status) {
    case BatchStatus::ok:
      ++ok;
      break;
    case BatchStatus::infeasible:
      ++infeasible;
      break;
    case BatchStatus::error:
      ++errors;
  }
}

BatchCounts& BatchCounts::operator+=(const BatchCounts& other) {
  ok += other.ok;
  infeasible += other.infeasible;
  errors += other.errors;
  return *this;
}

void ChunkWriter::add(std::string_view record, BatchStatus status) {
  file_.write(record);
  records_.update(record);
  counts_.add(status);
}

void ChunkWriter::publish(std::string_view key) {
  file_.write(seal(key, records_.hex(), counts_));
  file_.publish();
}

std::optional<BatchCounts> read_chunk(
    const std::filesystem::path& file, std::string_view key,
    const std::function<void(std::string_view)>& records) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = in.tellg();
  if (!in || size <= 0) return std::nullopt;
  const std::string found = last_line(in, size);
  Sha256 digest;
  std::vector<char> piece(1 << 16);
  in.seekg(0);
  for (auto left = size - static_cast<std::streamoff>(found.size()); left > 0;) {
    const auto wanted = std::min(left, static_cast<std::streamoff>(piece.size()));
    if (!in.read(piece.data(), wanted)) return std::nullopt;
    const std::string_view bytes(piece.data(), static_cast<std::size_t>(wanted));
    digest.update(bytes);
    if (records) records(bytes);
    left -= wanted;
  }
  const auto counts = counts_of(found);
  if (found != seal(key, digest.hex(), counts)) return std::nullopt;
  return counts;
}

}  // namespace turnwright::service
