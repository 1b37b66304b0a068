#include "measured_file.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "document/json/csv.hpp"
#include "document/json/text_lines.hpp"

namespace turnwright::document {
namespace {

bool is_utf8(const std::string& bytes) {
  try {
    (void)nlohmann::json(bytes).dump();
    return true;
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
}

std::string from_latin_1(std::string_view bytes) {
  std::string out;
  for (const char c : bytes) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x80) {
      out += c;
    } else {
      out += static_cast<char>(0xC0 | (code >> 6));
      out += static_cast<char>(0x80 | (code & 0x3F));
    }
  }
  return out;
}

bool is_universal(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == text.npos || !text.substr(first).starts_with("-1")) return false;
  const auto behind = text.find_first_not_of(" \t\r", first + 2);
  return behind != text.npos && text[behind] == '\n';
}

/// Whether bytes stand among its lines.
bool is_binary_universal(std::string_view bytes) {
  return is_universal(bytes) && bytes.find("\n    58b ") != bytes.npos;
}

/// The table of a .frf, the file of CutPro: three columns, the names and units of which stand
/// behind the values of the first line; nothing if it is none.
std::optional<std::string> table_of_frf(std::string_view text) {
  std::vector<std::string_view> cells;
  const std::string_view line = text.substr(0, text.find('\n'));
  for (std::size_t at = 0; at <= line.size();) {
    const auto end = std::min(line.find('\t', at), line.size());
    cells.push_back(trimmed(line.substr(at, end - at)));
    at = end + 1;
  }
  constexpr std::size_t kColumns = 3, kName = 3, kHertz = 4, kReal = 5, kUnit = 6;
  if (cells.size() <= kUnit || !cells[kName].starts_with("Freq") ||
      !cells[kReal].starts_with("Real"))
    return std::nullopt;
  for (std::size_t i = 0; i < kColumns; ++i)
    if (!csv_number(cells[i])) return std::nullopt;
  const std::string unit = " [" + std::string(cells[kUnit]) + "]";
  std::string out =
      "Freq [" + std::string(cells[kHertz]) + "]\tReal" + unit + "\tImag" + unit;
  for (std::size_t i = 0; i < kColumns; ++i)
    out += (i == 0 ? '\n' : '\t') + std::string(cells[i]);
  return out.append(text.substr(line.size()));
}

}  // namespace

nlohmann::json measured_file(const std::string& bytes) {
  std::string text =
      is_utf8(bytes) && !is_binary_universal(bytes) ? bytes : from_latin_1(bytes);
  if (is_universal(text)) return {{"uff", {{"text", std::move(text)}}}};
  if (auto table = table_of_frf(text)) return {{"csv", *std::move(table)}};
  return {{"csv", std::move(text)}};
}

}  // namespace turnwright::document
