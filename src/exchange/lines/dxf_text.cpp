#include "dxf_text.hpp"

#include <array>
#include <charconv>

#include "exchange/text/notation_demands.hpp"
#include "exchange/text/thread_words.hpp"

namespace turnwright::exchange::dxf {
namespace {

void append_character(std::string& out, unsigned c) {
  constexpr unsigned kEmptySet = 0x2205, kDiameter = 0x2300;
  if (c == kEmptySet || c == kDiameter || c == 0xf8) c = 0xd8;  // Ø
  if (c < 0x20 || (c >= 0xd800 && c < 0xe000) || c > 0xffff) c = ' ';
  const auto byte = [&out](unsigned x) { out += static_cast<char>(x); };
  if (c < 0x80) return byte(c);
  if (c < 0x800) return byte(0xc0 | c >> 6), byte(0x80 | (c & 0x3f));
  byte(0xe0 | c >> 12), byte(0x80 | (c >> 6 & 0x3f)), byte(0x80 | (c & 0x3f));
}

class TextReader {
 public:
  explicit TextReader(std::string_view text) : s_(text) {}

  std::string read() {
    while (at_ < s_.size()) {
      const char c = s_[at_];
      if (c == '%' && s_.substr(at_, 2) == "%%")
        sign();
      else if (c == '\\' && at_ + 1 < s_.size())
        format();
      else if (c == '{' || c == '}')
        ++at_;
      else
        out_ += s_[at_++];
    }
    return std::move(out_);
  }

 private:
  // %%c, %%d, %%p; other letters turn underlining on and off.
  void sign() {
    const char c = at_ + 2 < s_.size() ? static_cast<char>(s_[at_ + 2] | 0x20) : ' ';
    at_ = std::min(at_ + 3, s_.size());
    if (c == 'c') out_ += "Ø";
    if (c == 'd') out_ += "°";
    if (c == 'p') out_ += "±";
  }

  void format() {
    const char c = s_[at_ + 1];
    at_ += 2;
    if (c == 'U' && at_ < s_.size() && s_[at_] == '+') return unicode();
    if (c == 'S') return stack();
    if (c == 'P' || c == '~' || c == 'X') {
      out_ += ' ';
    } else if (c == '\\' || c == '{' || c == '}') {
      out_ += c;
    } else if (std::string_view("fFHACWQTp").find(c) != std::string_view::npos) {
      const auto end = s_.find(';', at_);
      at_ = end == std::string_view::npos ? s_.size() : end + 1;
    }
  }

  void unicode() {
    constexpr std::size_t kDigits = 4;
    unsigned c = 0;
    const auto digits = s_.substr(at_ + 1, kDigits);
    const auto end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data(), end, c, 16);
    at_ += 1 + static_cast<std::size_t>(read.ptr - digits.data());
    append_character(out_, c);
  }

  // "+0.02^-0.01;": the upper and the lower one.
  void stack() {
    auto end = s_.find(';', at_);
    if (end == std::string_view::npos) end = s_.size();
    if (!out_.empty() && out_.back() != ' ') out_ += ' ';
    for (const char c : s_.substr(at_, end - at_)) {
      if (c == ' ') continue;
      out_ += c == '^' || c == '#' ? '/' : c;
    }
    at_ = std::min(end + 1, s_.size());
  }

  std::string_view s_;
  std::size_t at_ = 0;
  std::string out_;
};

// Takes the size at the beginning of a word; whether there is one.
bool take_size(notated::Word& word, Said& out) {
  using notated::take;
  if (take(word, {"<>"})) return true;
  out.diameter = take(word, {"Ø", "ø", "⌀", "∅"});
  if (out.diameter && take(word, {"<>"})) return true;
  out.thread = !out.diameter && take(word, {"m"});
  out.size = notated::take_number(word);
  if (!out.size) return false;
  if (out.thread && take(word, {"x", "×"})) {
    const auto pitch = notated::take_number(word);
    if (!pitch || !(*pitch > 0)) return false;
    out.pitch = *pitch;
  }
  if (out.thread) take(word, {"-"});  // M24x1.5-6g
  return *out.size > 0;
}

bool take_demand(notated::Word word, Said& out) {
  notated::Mistakes mistakes(word);
  if (notated::take_roughness(word, out.demands, mistakes)) return mistakes.none();
  if (out.demands.fit || out.demands.limits) return false;
  if (out.thread ? notated::is_thread_class(word) : notated::is_fit(word))
    out.demands.fit = std::string(word);
  else if (const auto l = notated::limits(word); l && l->lower_mm < l->upper_mm)
    out.demands.limits = l;
  else
    return false;
  return true;
}

}  // namespace

std::string in_utf8(std::string_view s) {
  if (notated::utf8_length(s) == s.size()) return std::string(s);
  std::string out;
  for (const char c : s) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80)
      out += c;
    else
      append_character(out, byte);
  }
  return out;
}

std::string shown_text(std::string_view text) {
  const std::string read = in_utf8(TextReader(text).read());
  std::string out;
  for (std::string_view rest = read; !rest.empty();) {
    const bool diameter = rest.starts_with("∅") || rest.starts_with("⌀");
    const std::size_t taken = diameter ? std::string_view("∅").size() : 1;
    out += diameter ? "Ø" : rest.substr(0, taken);
    rest.remove_prefix(taken);
  }
  return out;
}

std::optional<Said> said(const std::string& shown) {
  const auto words = notated::words(shown);
  if (words.empty()) return Said{};
  Said out;
  std::size_t next = 0;
  if (const auto inch = notated::take_inch_thread(words, next)) {
    out.thread = true;
    out.size = inch->d_mm;
    out.pitch = inch->pitch_mm;
    if (!inch->tolerance_class.empty()) out.demands.fit = inch->tolerance_class;
  } else {
    notated::Word first = words[next++];
    if (!take_size(first, out)) return std::nullopt;
    if (!first.empty() && !take_demand(first, out)) return std::nullopt;
  }
  for (std::size_t i = next; i < words.size(); ++i)
    if (!take_demand(words[i], out)) return std::nullopt;
  return out;
}

}  // namespace turnwright::exchange::dxf
