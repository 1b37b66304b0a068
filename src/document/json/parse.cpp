#include "parse.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>
#include <vector>

#include "base/say.hpp"
#include "pointer.hpp"
#include "reader.hpp"
#include "slip.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::document {
namespace {

using nlohmann::json;

// "line 3, column 7" of the last byte read.
std::string place(std::string_view text, std::size_t bytes_read) {
  const auto before = text.substr(0, bytes_read == 0 ? 0 : bytes_read - 1);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const auto start = before.rfind('\n');
  const auto column = before.size() - (start == before.npos ? 0 : start + 1) + 1;
  return say("line {}, column {}", line, column);
}

// Printable ASCII of a parser's message, which repeats raw bytes of the document.
std::string printable(std::string text) {
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return text;
}

// The reason in nlohmann's message, without its number, the place (which is reported
// separately) and the whole token.
std::string reason(const std::string& what) {
  std::string text = what;
  for (const std::string_view lead : {"syntax error while parsing ", "] "})
    if (const auto at = what.find(lead); at != what.npos) {
      text = what.substr(at + lead.size());
      break;
    }
  if (const auto from = text.find("; last read: '"); from != text.npos) {
    const auto to = text.find("'; expected ", from);
    text.erase(from, to == text.npos ? to : to + 1 - from);
  }
  // "object key - unexpected '}'" reads better in the reverse order.
  if (const auto dash = text.find(" - "); dash != text.npos) {
    const auto end = std::min(text.find("; expected "), text.size());
    text = text.substr(dash + 3, end - dash - 3) + " in " + text.substr(0, dash) +
           text.substr(end);
  }
  return printable(text);
}

// What nlohmann's messages consist of.
constexpr const char* kParserWords[] = {
    // where it was
    to_translate("in value"), to_translate("in object key"),
    to_translate("in object separator"), to_translate("in array"),
    to_translate("in object"),
    // what it read and what it expected
    to_translate("true literal"), to_translate("false literal"),
    to_translate("null literal"), to_translate("string literal"),
    to_translate("number literal"), to_translate("end of input"),
    to_translate("'[', '{', or a literal"),
    // what is wrong with it
    to_translate("invalid literal"), to_translate("invalid number"),
    to_translate("digit after '-'"), to_translate("digit after '.'"),
    to_translate("digit after exponent sign"),
    to_translate("invalid string: missing closing quote"),
    to_translate("invalid string: ill-formed UTF-8 byte"),
    to_translate("invalid string: forbidden character after backslash"),
    to_translate("invalid string: '\\u' must be followed by 4 hex digits"),
    to_translate("invalid string: surrogate U+D800..U+DBFF must be followed by "
                 "U+DC00..U+DFFF"),
    to_translate("invalid string: surrogate U+DC00..U+DFFF must follow U+D800..U+DBFF"),
    to_translate("invalid BOM; must be 0xEF 0xBB 0xBF if given")};

std::string parser_word(const std::string& english) {
  return std::ranges::count(kParserWords, english) > 0 ? tr(english) : english;
}

// A reason in the program's language, as far as it is known.
std::string in_words(const std::string& english) {
  constexpr std::string_view kUnexpected = "unexpected ";
  if (const auto in = english.rfind(" in "); in != english.npos)
    return in_words(english.substr(0, in)) + ' ' + parser_word(english.substr(in + 1));
  if (english.starts_with(kUnexpected))
    return say("unexpected {}", parser_word(english.substr(kUnexpected.size())));
  return parser_word(english);
}

// number_word() finds words that are not JSON but numbers in other languages.
constexpr std::array<std::string_view, 3> kNoNumbers{"nan", "inf", "infinity"};

/// "NaN", "-Infinity" or the like, if the byte before `end` is in such a word.
std::string number_word(std::string_view text, std::size_t end) {
  const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)); };
  std::size_t from = std::min(end, text.size()), to = from;
  while (from > 0 && letter(text[from - 1])) --from;
  while (to < text.size() && letter(text[to])) ++to;
  std::string word(text.substr(from, to - from));
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (std::find(kNoNumbers.begin(), kNoNumbers.end(), word) == kNoNumbers.end())
    return {};
  if (from > 0 && (text[from - 1] == '-' || text[from - 1] == '+')) --from;
  return std::string(text.substr(from, to - from));
}

// A byte order mark of another encoding, or a NUL beside the first character.
bool is_utf16(std::string_view text) {
  using namespace std::string_view_literals;
  return text.starts_with("\xff\xfe"sv) || text.starts_with("\xfe\xff"sv) ||
         (text.size() > 3 && (text[0] == '\0') != (text[1] == '\0'));
}

bool nonzero(const std::string& digits) {
  const auto mantissa = digits.substr(0, digits.find_first_of("eE"));
  return mantissa.find_first_of("123456789") != mantissa.npos;
}

// Builds the value and reports errors that the finished value would not show, such as
// duplicate keys.
class Builder : public nlohmann::json_sax<json> {
 public:
  Builder(std::string_view text, Problems& problems, const ParseLimits& limits)
      : text_(text), problems_(problems), limits_(limits) {}

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(json::number_integer_t value) override { return add(value); }
  bool number_unsigned(json::number_unsigned_t value) override { return add(value); }
  bool number_float(json::number_float_t value, const std::string& digits) override {
    if (value == 0 && nonzero(digits)) {
      report(pointer(), printable(digits.substr(0, limits_.key_bytes)),
             tr("a number that a double can hold"), "number");
    }
    return add(value);
  }
  bool string(std::string& value) override {
    if (value.size() > limits_.string_bytes)
      report(pointer(), say("a text of {} bytes", value.size()),
             say("at most {} bytes", limits_.string_bytes), "size");
    return add(std::move(value));
  }
  bool binary(json::binary_t&) override { return false; }  // never comes from text

  bool start_object(std::size_t) override { return open(json::object()); }
  bool start_array(std::size_t) override { return open(json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(std::string& value) override {
    if (value.size() > limits_.key_bytes)
      return report(pointer_of_container(), say("a key of {} bytes", value.size()),
                    say("at most {} bytes", limits_.key_bytes), "size");
    auto& level = stack_.back();
    if (level.node->contains(value))
      report(child_pointer(pointer_of_container(), value), tr("the key a second time"),
             tr("each key once"), "duplicate-key");
    level.key = std::move(value);
    return true;
  }

  bool parse_error(std::size_t position, const std::string&,
                   const json::exception& error) override {
    if (dynamic_cast<const json::out_of_range*>(&error))
      return report(pointer(), say("a number too large ({})", place(text_, position)),
                    tr("a number that a double can hold"), "number");
    if (const auto word = number_word(text_, position); !word.empty())
      return report(pointer(), say("broken JSON at {}: {}", place(text_, position), word),
                    say("a number; JSON knows no {}", word), "syntax");
    const std::string why = reason(error.what());
    if (const auto slip = usual_slip(text_, position, why))
      return report("", say("broken JSON at {}: {}", place(text_, position), slip->got),
                    slip->wanted, "syntax");
    const auto split = why.rfind("; expected ");
    return report("",
                  say("broken JSON at {}: {}", place(text_, position),
                      in_words(why.substr(0, split))),
                  split == why.npos ? tr("valid JSON") : in_words(why.substr(split + 11)),
                  "syntax");
  }

  json take() { return std::move(root_); }

 private:
  struct Level {
    json* node;
    std::string key;  // of the member being read
  };

  std::string pointer_up_to(std::size_t levels) const {
    std::string out;
    for (std::size_t i = 0; i < levels; ++i)
      out = child_pointer(out, stack_[i].node->is_array()
                                   ? std::to_string(index(stack_[i], i))
                                   : stack_[i].key);
    return out;
  }
  // An array that has an open child counts it already.
  std::size_t index(const Level& level, std::size_t i) const {
    return i + 1 < stack_.size() ? level.node->size() - 1 : level.node->size();
  }
  std::string pointer() const { return pointer_up_to(stack_.size()); }
  std::string pointer_of_container() const { return pointer_up_to(stack_.size() - 1); }

  bool report(std::string pointer, std::string got, std::string expected,
              std::string code) {
    problems_.add(
        {std::move(pointer), std::move(got), std::move(expected), std::move(code)});
    return false;
  }

  json* put(json value) {
    if (stack_.empty()) return &(root_ = std::move(value));
    auto& level = stack_.back();
    if (level.node->is_array()) {
      level.node->push_back(std::move(value));
      return &level.node->back();
    }
    return &((*level.node)[level.key] = std::move(value));
  }
  bool add(json value) {
    put(std::move(value));
    return true;
  }
  bool open(json container) {
    if (stack_.size() == limits_.depth)
      return report("", tr("objects and lists nested too deeply"),
                    say("at most {} levels", limits_.depth), "depth");
    json* node = put(std::move(container));
    stack_.push_back({node, ""});
    return true;
  }
  bool close() {
    stack_.pop_back();
    return true;
  }

  std::string_view text_;
  Problems& problems_;
  ParseLimits limits_;
  json root_;
  std::vector<Level> stack_;
};

}  // namespace

json parse(std::string_view text, const std::string& document,
           const ParseLimits& limits) {
  Problems problems{.document = document};
  if (text.size() > limits.bytes) {
    problems.add({"", say("{} bytes", text.size()), say("at most {} bytes", limits.bytes),
                  "size"});
    problems.throw_if_any();
  }
  if (text.find_first_not_of(" \t\r\n") == text.npos) {
    problems.add({"", tr("an empty document"), tr("a JSON document"), "syntax"});
    problems.throw_if_any();
  }
  if (is_utf16(text)) {
    problems.add({"", tr("UTF-16 or UTF-32"), tr("JSON in UTF-8"), "syntax"});
    problems.throw_if_any();
  }
  Builder builder(text, problems, limits);
  json::sax_parse(text.begin(), text.end(), &builder);
  // The library ends at a NUL, whatever follows.
  if (const auto nul = text.find('\0'); nul != text.npos && problems.list.empty())
    problems.add({"", say("broken JSON at {}: a NUL", place(text, nul + 1)),
                  tr("valid JSON"), "syntax"});
  problems.throw_if_any();
  return builder.take();
}

json parse(std::istream& in, const std::string& document, const ParseLimits& limits) {
  std::string text;
  std::vector<char> piece(1 << 16);
  while (text.size() <= limits.bytes &&
         in.read(piece.data(), static_cast<std::streamsize>(piece.size())).gcount() > 0)
    text.append(piece.data(), static_cast<std::size_t>(in.gcount()));
  // One byte more than allowed is enough to refuse the rest.
  text.resize(std::min(text.size(), limits.bytes + 1));
  return parse(text, document, limits);
}

}  // namespace turnwright::document
