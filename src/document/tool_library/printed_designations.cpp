#include "printed_designations.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>

namespace turnwright::document {
namespace {

bool is_digit_at(const std::string& text, std::size_t at) {
  return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
}

// One case, and blanks where designations are divided; decimal points stay.
std::string plain(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool point =
        c == '.' && i > 0 && is_digit_at(text, i - 1) && is_digit_at(text, i + 1);
    out += std::isalnum(c) != 0 || point ? static_cast<char>(std::toupper(c)) : ' ';
  }
  return out;
}

/// A's and 0's for letters and digits, without blanks, of the beginning of a text.
std::string pattern(std::string_view text) {
  constexpr std::size_t kLongest = 12;
  std::string out;
  for (const unsigned char c : text) {
    if (out.size() == kLongest) break;
    if (c != ' ') out += std::isdigit(c) != 0 ? '0' : 'A';
  }
  return out;
}

bool is_letter(char c) { return c >= 'A' && c <= 'Z'; }

bool starts_word(const std::string& text, std::size_t at) {
  return text[at] != ' ' && (at == 0 || text[at - 1] == ' ');
}

// What stands at a place, of so many symbols without blanks.
std::string standing(std::string_view text, std::size_t symbols) {
  std::size_t end = 0;
  for (; end < text.size() && symbols > 0; ++end)
    if (text[end] != ' ') --symbols;
  return std::string(text.substr(0, end));
}

template <class Decode>
auto decoded(Decode decode, const std::string& text)
    -> std::optional<decltype(decode(text))> {
  try {
    return decode(text);
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

bool has_letters_of_an_insert(std::string_view text) {
  constexpr std::string_view kTypes = "ABCFGHJMNQRTUWX", kClasses = "ACEFGHJKLMNU";
  return catalogue::included_angle_deg(text[0]) &&
         catalogue::clearance_of_letter_deg(text[1]) &&
         kClasses.find(text[2]) != kClasses.npos && kTypes.find(text[3]) != kTypes.npos;
}

void find_insert(std::string_view rest, const std::string& form,
                 PrintedDesignations& found) {
  constexpr std::size_t kSymbols = 10, kInch = 12;  // CNMG120408, CNMG1.81.51
  const bool four_letters = form.starts_with("AAAA") &&
                            rest.substr(0, 4).find(' ') == rest.npos &&
                            (rest.size() == 4 || !is_letter(rest[4]));
  if (!four_letters || !has_letters_of_an_insert(rest)) return;
  const auto text = standing(rest, kSymbols);
  const bool sized =
      form.size() >= kSymbols && form.substr(4, 2) == "00" && form.substr(8, 2) == "00";
  const auto insert = sized
                          ? decoded(catalogue::decode_iso1832, text)
                          : decoded(catalogue::decode_inch_insert, standing(rest, kInch));
  if (!found.insert) found.insert = insert;
  if (!insert && found.insert_letters.empty()) found.insert_letters = rest.substr(0, 4);
  if (!insert && sized && found.unreadable.empty()) found.unreadable = text;
}

void find_holder(std::string_view rest, const std::string& form,
                 PrintedDesignations& found) {
  constexpr std::size_t kHolder = 12, kBar = 11;  // DCLNR2020K12, A16MSCLCR09
  if (found.holder || found.bar) return;
  if (form.starts_with("AAAAA0000A00")) {
    found.holder_text = standing(rest, kHolder);
    found.holder = decoded(catalogue::decode_iso5608, found.holder_text);
  } else if (form.starts_with("A00AAAAAA00")) {
    found.holder_text = standing(rest, kBar);
    found.bar = decoded(catalogue::decode_iso5609, found.holder_text);
  }
  if (!found.holder && !found.bar) found.holder_text.clear();
}

}  // namespace

PrintedDesignations printed_designations(const std::vector<std::string>& texts) {
  constexpr std::size_t kLongest = 400;  // a name, a remark; more is prose
  PrintedDesignations found;
  for (const auto& given : texts) {
    const auto text = plain(given.substr(0, kLongest));
    for (std::size_t at = 0; at < text.size(); ++at) {
      if (!starts_word(text, at)) continue;
      const auto rest = std::string_view(text).substr(at);
      const auto form = pattern(rest);
      find_insert(rest, form, found);
      find_holder(rest, form, found);
    }
  }
  return found;
}

}  // namespace turnwright::document
