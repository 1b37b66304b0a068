#include <iconv.h>

#include <array>
#include <cstdint>

#include "turnwright/exchange/part21.hpp"

namespace turnwright::exchange {
namespace {

constexpr char32_t kReplacement = 0xfffd;

void append_utf8(std::string& out, char32_t c) {
  if (c > 0x10ffff || (c >= 0xd800 && c < 0xe000)) c = kReplacement;
  const auto byte = [&out](char32_t x) { out += static_cast<char>(x); };
  const auto rest = [&byte, c](int shift) { byte(0x80 | (c >> shift & 0x3f)); };
  if (c < 0x80) return byte(c);
  if (c < 0x800) return byte(0xc0 | c >> 6), rest(0);
  if (c < 0x10000) return byte(0xe0 | c >> 12), rest(6), rest(0);
  byte(0xf0 | c >> 18), rest(12), rest(6), rest(0);
}

/// Character of ISO 8859-`part` in UTF-8.
void append_8859(std::string& out, char c, int part) {
  if (part == 1) return append_utf8(out, static_cast<unsigned char>(c));
  const std::string name = "ISO-8859-" + std::to_string(part);
  std::array<char, 8> utf8{};
  char *from = &c, *to = utf8.data();
  std::size_t left = 1, room = utf8.size();
  const iconv_t table = iconv_open("UTF-8", name.c_str());
  const bool known = table != reinterpret_cast<iconv_t>(-1);
  const bool done =
      known && iconv(table, &from, &left, &to, &room) != static_cast<std::size_t>(-1);
  if (known) iconv_close(table);
  if (!done) return append_utf8(out, kReplacement);
  out.append(utf8.data(), utf8.size() - room);
}

std::optional<char32_t> hexadecimal(std::string_view digits) {
  char32_t x = 0;
  for (const char c : digits) {
    const auto digit = std::string_view("0123456789ABCDEF").find(c & ~('a' - 'A'));
    const bool letter = digit != std::string_view::npos && digit > 9;
    if (!letter && !(c >= '0' && c <= '9')) return std::nullopt;
    x = x << 4 |
        static_cast<char32_t>(letter ? digit : static_cast<std::size_t>(c - '0'));
  }
  return x;
}

/// Bytes of the UTF-8 character at the beginning of `s`; 0 if it is none.
std::size_t utf8_length(std::string_view s) {
  const auto lead = static_cast<unsigned char>(s[0]);
  const std::size_t n = lead >= 0xf0 && lead < 0xf5   ? 4
                        : lead >= 0xe0 && lead < 0xf0 ? 3
                        : lead >= 0xc2 && lead < 0xe0 ? 2
                                                      : 0;
  if (n > s.size()) return 0;
  for (std::size_t i = 1; i < n; ++i)
    if ((static_cast<unsigned char>(s[i]) & 0xc0) != 0x80) return 0;
  return n;
}

class Decoder {
 public:
  explicit Decoder(std::string_view encoded) : rest_(encoded) {}

  std::string decode() && {
    while (!rest_.empty()) one();
    return std::move(out_);
  }

 private:
  void one() {
    if (rest_[0] == '\\' && directive()) return;
    if (rest_.starts_with("''") || rest_.starts_with("\\\\")) return keep(1), drop(1);
    if (rest_[0] == '\n' || rest_[0] == '\r') return drop(1);  // a string over lines
    if (static_cast<unsigned char>(rest_[0]) < 0x80) return keep(1);
    if (const auto n = utf8_length(rest_)) return keep(n);
    append_8859(out_, rest_[0], 1);
    drop(1);
  }

  bool directive() {
    if (rest_.starts_with("\\S\\") && rest_.size() > 3) {
      append_8859(out_, static_cast<char>(rest_[3] | 0x80), page_);
      return drop(4), true;
    }
    if (rest_.size() > 3 && rest_[1] == 'P' && rest_[3] == '\\' && rest_[2] >= 'A' &&
        rest_[2] <= 'I') {
      page_ = rest_[2] - 'A' + 1;
      return drop(4), true;
    }
    if (rest_.starts_with("\\X\\") && rest_.size() >= 5) {
      append_utf8(out_, hexadecimal(rest_.substr(3, 2)).value_or(kReplacement));
      return drop(5), true;
    }
    if (rest_.starts_with("\\X2\\")) return drop(4), wide(4), true;
    if (rest_.starts_with("\\X4\\")) return drop(4), wide(8), true;
    return false;
  }

  /// Characters of `digits` hexadecimal digits each until \X0\.  Pairs of surrogates, which
  /// some programs write, are one character.
  void wide(std::size_t digits) {
    char32_t high = 0;
    while (rest_.size() >= digits && rest_[0] != '\\') {
      const char32_t c = hexadecimal(rest_.substr(0, digits)).value_or(kReplacement);
      drop(digits);
      if (c >= 0xd800 && c < 0xdc00) {
        high = c;
        continue;
      }
      const bool pair = high && c >= 0xdc00 && c < 0xe000;
      append_utf8(out_, pair ? 0x10000 + ((high - 0xd800) << 10) + (c - 0xdc00) : c);
      high = 0;
    }
    if (rest_.starts_with("\\X0\\"))
      drop(4);
    else
      append_utf8(out_, kReplacement), drop(rest_.size());
  }

  void keep(std::size_t n) { out_ += rest_.substr(0, n), drop(n); }
  void drop(std::size_t n) { rest_.remove_prefix(n); }

  std::string_view rest_;
  std::string out_;
  int page_ = 1;
};

}  // namespace

std::string part21_text(std::string_view encoded) { return Decoder(encoded).decode(); }

}  // namespace turnwright::exchange
