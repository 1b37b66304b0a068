#include "words.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>

#include "letters.hpp"

namespace turnwright::review {
namespace {

// Reads a line from its front.
class Scanner {
 public:
  explicit Scanner(std::string_view line) : line_(line) {}

  bool done() const { return at_ >= line_.size(); }
  char next() const { return done() ? '\0' : line_[at_]; }
  void skip() { ++at_; }
  void skip_blanks() {
    while (!done() && is_blank(next())) ++at_;
  }
  std::size_t at() const { return at_; }
  void back_to(std::size_t at) { at_ = at; }
  std::string_view since(std::size_t from) const {
    return line_.substr(from, at_ - from);
  }
  std::string_view rest() const { return line_.substr(std::min(at_, line_.size())); }

  /// The text up to a closing bracket, or the end.
  std::string comment(char closing) {
    const auto end = std::min(line_.find(closing, at_), line_.size());
    std::string inside(line_.substr(at_, end - at_));
    at_ = end + 1;
    return inside;
  }
  /// A number with an optional sign; where there is none the place stays.
  std::optional<double> number() {
    const auto start = at_;
    skip_blanks();
    if (next() == '+') skip();
    double value = 0;
    const auto [end, error] = std::from_chars(
        line_.data() + at_, line_.data() + line_.size(), value, std::chars_format::fixed);
    if (error != std::errc() || !(std::abs(value) <= kLargestWord)) {
      at_ = start;
      return std::nullopt;
    }
    at_ = static_cast<std::size_t>(end - line_.data());
    return value;
  }

 private:
  std::string_view line_;
  std::size_t at_ = 0;
};

// Skips brackets to the one that closes the first, of round ones too where they are of
// expressions.
bool skip_brackets(Scanner& in, bool round = false) {
  int depth = 0;
  for (; !in.done(); in.skip()) {
    const char c = in.next();
    if (c == '[' || (round && c == '(')) ++depth;
    if ((c == ']' || (round && c == ')')) && --depth == 0) return in.skip(), true;
  }
  return false;
}

// Skips a function with its brackets: SIN[30], ATAN[1]/[2].
bool skip_function(Scanner& in) {
  while (is_letter(in.next())) in.skip();
  in.skip_blanks();
  if (in.next() != '[' || !skip_brackets(in)) return false;
  const auto end = in.at();
  in.skip_blanks();
  const bool second = in.next() == '/';
  if (second) in.skip(), in.skip_blanks();
  if (second && in.next() == '[') return skip_brackets(in);
  in.back_to(end);
  return true;
}

// Skips one value of an expression: a number, a parameter, brackets or a function.
bool skip_value(Scanner& in) {
  while (is_blank(in.next()) || in.next() == '-' || in.next() == '+') in.skip();
  while (in.next() == '#') in.skip(), in.skip_blanks();
  if (in.next() == '[') return skip_brackets(in);
  if (in.next() == '<') {
    while (!in.done() && in.next() != '>') in.skip();
    if (in.done()) return false;
    return in.skip(), true;
  }
  return is_letter(in.next()) ? skip_function(in) : in.number().has_value();
}

// Skips the longest of these names here.
bool skip_one_of(Scanner& in, std::span<const std::string_view> names) {
  const auto start = in.at();
  in.skip_blanks();
  for (const auto name : names) {
    const auto rest = in.rest().substr(0, name.size());
    if (!std::ranges::equal(rest, name, {}, capital)) continue;
    in.back_to(in.at() + name.size());
    return true;
  }
  in.back_to(start);
  return false;
}

// Skips an operator between two values.
bool skip_operator(Scanner& in) {
  constexpr std::string_view kBetween[] = {"**",  "*",   "/",   "+", "-",
                                           "MOD", "AND", "XOR", "OR"};
  return skip_one_of(in, kBetween);
}

bool begins_name(char c) { return is_letter(c) || c == '_' || c == '$'; }

// A name of letters, or one letter and a number.
void skip_name(Scanner& in) {
  if (!begins_name(in.next())) return;
  in.skip();
  const bool numbered = is_digit(in.next());
  while (is_digit(in.next()) || (!numbered && begins_name(in.next()))) in.skip();
}

// Skips one value as Siemens writes it: a number, a variable with its index, a function.
bool skip_named_value(Scanner& in, Language language) {
  constexpr std::string_view kBefore[] = {"B_NOT", "NOT", "-", "+"};
  const char opening = language == Language::siemens ? '(' : '[';
  while (skip_one_of(in, kBefore)) {
  }
  in.skip_blanks();
  if (in.next() == opening) return skip_brackets(in, true);
  if (begins_name(in.next())) {
    skip_name(in);
    return (in.next() != opening && in.next() != '[') || skip_brackets(in, true);
  }
  if (!in.number()) return false;
  if (capital(in.next()) != 'E') return true;
  const auto end = in.at();
  in.skip();
  if (capital(in.next()) == 'X' && (in.skip(), in.number())) return true;
  return in.back_to(end), true;
}

// Skips an expression of Siemens or Okuma, which ends with its line or before another word.
bool skip_named_expression(Scanner& in, Language language) {
  constexpr std::string_view kNamedBetween[] = {
      "*",   "/",   "+",  "-",  "DIV", "MOD", "B_AND", "B_XOR", "B_OR",
      "AND", "XOR", "OR", "==", "<>",  ">=",  "<=",    ">",     "<"};
  constexpr std::string_view kOkumaBetween[] = {"*", "/", "+", "-"};
  const std::span<const std::string_view> between =
      language == Language::okuma ? std::span<const std::string_view>(kOkumaBetween)
                                  : std::span<const std::string_view>(kNamedBetween);
  do
    if (!skip_named_value(in, language)) return false;
  while (skip_one_of(in, between));
  return true;
}

// "#1=#2+3": Fanuc reckons without brackets too.
std::optional<Assignment> assignment_of(Scanner& in) {
  Assignment a;
  const auto start = in.at();
  if (!skip_value(in)) return std::nullopt;
  a.parameter = in.since(start);
  in.skip_blanks();
  if (in.next() != '=') return std::nullopt;
  in.skip();
  const auto from = in.at();
  std::size_t end = from;
  do {
    if (!skip_value(in)) return std::nullopt;
    end = in.at();
  } while (skip_operator(in));
  in.back_to(end);
  a.expression = in.since(from);
  return a;
}

// A message of Siemens to the operator, MSG("text") or MSG(), which moves nothing; its text.
std::optional<std::string> message_of(Scanner& in) {
  constexpr std::string_view kBegins = "MSG(";
  const auto rest = in.rest();
  if (!std::ranges::equal(rest.substr(0, kBegins.size()), kBegins, {}, capital))
    return std::nullopt;
  const bool quoted = rest.substr(kBegins.size()).starts_with('"');
  const auto text = kBegins.size() + (quoted ? 1 : 0);
  const auto end = rest.find(quoted ? "\")" : ")", text);
  if (end == rest.npos) return std::nullopt;
  in.back_to(in.at() + end + (quoted ? 2 : 1));
  return std::string(rest.substr(text, end - text));
}

// "N10 MARK:" in front of a block of Siemens, whose number is a word.
void skip_label(Scanner& in) {
  in.skip_blanks();
  const auto start = in.at();
  if (capital(in.next()) == 'N') {
    in.skip();
    if (in.number())
      in.skip_blanks();
    else
      in.back_to(start);
  }
  const auto from = in.at();
  skip_name(in);
  if (in.at() == from || in.next() != ':') return in.back_to(start);
  in.skip();
}

// "NLAP1" in front of a block of Okuma.
void skip_named_number(Scanner& in) {
  in.skip_blanks();
  const auto start = in.at();
  if (capital(in.next()) != 'N') return;
  in.skip();
  if (!is_letter(in.next())) return in.back_to(start);
  skip_name(in);
  if (!in.done() && !is_blank(in.next())) in.back_to(start);
}

// "R1=5", "R[R2]=5", "depth[1]=5"; names of DEF alone are words at first.
std::optional<Assignment> named_assignment_of(Scanner& in, Language language) {
  const char letter = language == Language::okuma ? 'V' : 'R';
  const auto start = in.at();
  Assignment a;
  const char first = capital(in.next());
  skip_name(in);
  const auto name = in.since(start);
  const bool numbered =
      first == letter && name.size() > 1 &&
      std::ranges::all_of(name.substr(1), [](char c) { return is_digit(c); });
  const bool indexed = in.next() == '[' && skip_brackets(in, true);
  a.parameter = in.since(start);
  in.skip_blanks();
  if ((!numbered && !indexed) || in.next() != '=') return std::nullopt;
  in.skip();
  const auto from = in.at();
  if (!skip_named_expression(in, language)) return std::nullopt;
  a.expression = in.since(from);
  return a;
}

// The name of a word: a letter, a letter and a number before "=", or several letters.
std::string name_of(Scanner& in, bool names) {
  const auto start = in.at();
  std::string name(1, capital(in.next()));
  in.skip();
  if (!names) return name;
  const bool several = is_letter(in.next()) || in.next() == '_';
  while (is_digit(in.next()) || (several && (is_letter(in.next()) || in.next() == '_'))) {
    name += capital(in.next());
    in.skip();
  }
  if (several || in.next() == '=') return name;
  in.back_to(start + 1);
  return name.substr(0, 1);
}

// "IC(..)" and "AC(..)" say how a coordinate is meant, whatever the mode.
void read_meaning(Word& w) {
  const auto expression = std::string_view(w.expression);
  const auto open = expression.find('(');
  if (open != 2 || !expression.ends_with(')')) return;
  const char first = capital(expression[0]);
  if (capital(expression[1]) != 'C' || (first != 'I' && first != 'A')) return;
  w.meant = first == 'I' ? Word::Meant::incremental : Word::Meant::absolute;
  w.expression = w.expression.substr(open);
}

// What stands behind the name of a word.
bool read_value(Scanner& in, Language language, Word& w) {
  const bool names = has_names(language);
  const bool equals = in.next() == '=';
  if (equals) in.skip();
  const auto from = in.at();
  w.value = in.number();
  if (!names) {
    if (w.value) return true;
    const auto begins = in.at();
    if (!skip_value(in)) return false;
    w.expression = in.since(begins);
    return true;
  }
  if (!equals) return w.value.has_value();
  const auto end = in.at();
  in.back_to(from);
  if (!skip_named_expression(in, language)) return in.back_to(end), w.value.has_value();
  if (w.value && in.at() == end) return true;
  w.value.reset();
  w.expression = in.since(from);
  read_meaning(w);
  return true;
}

std::optional<Word> word_of(Scanner& in, Language language) {
  const auto start = in.at();
  Word w;
  w.name = name_of(in, has_names(language));
  if ((w.name.size() == 1 || in.next() == '=') && !read_value(in, language, w))
    return std::nullopt;
  if (in.next() == '(' && w.name.size() > 1) return std::nullopt;
  w.text = in.since(start);
  w.at = start;
  w.point = w.text.find('.') != std::string::npos;
  return w;
}

}  // namespace

const Word* Block::find(std::string_view name) const {
  const auto found = std::ranges::find(words, name, &Word::name);
  return found == words.end() ? nullptr : &*found;
}

std::optional<double> Block::value(std::string_view name) const {
  const auto* word = find(name);
  return word ? word->value : std::nullopt;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

Block block_of(std::string_view line, Language language) {
  const bool names = has_names(language);
  Block block;
  Scanner in(line);
  in.skip_blanks();
  if (in.next() == '/') {
    block.deletable = true;
    in.skip();
    if (is_digit(in.next())) in.skip();  // "/2": by the second of several switches
  }
  if (language == Language::siemens) skip_label(in);
  if (language == Language::okuma) skip_named_number(in);
  for (in.skip_blanks(); !in.done(); in.skip_blanks()) {
    const char c = in.next();
    const auto start = in.at();
    if (c == ';' || (c == '(' && language != Language::siemens)) {
      in.skip();
      block.comments.push_back(in.comment(c == '(' ? ')' : '\n'));
      continue;
    }
    if (const auto message =
            language == Language::siemens ? message_of(in) : std::nullopt) {
      block.comments.push_back(*message);
      continue;
    }
    if (c == '#' && !names) {
      const auto assignment = assignment_of(in);
      if (assignment) {
        block.assignments.push_back(*assignment);
        continue;
      }
      in.back_to(start);
      block.rest = in.rest();
      break;
    }
    if (const auto assignment =
            names && begins_name(c) ? named_assignment_of(in, language) : std::nullopt) {
      block.assignments.push_back(*assignment);
      continue;
    }
    in.back_to(start);
    // "$1", the spindle of a word in LinuxCNC.
    const bool spindle = c == '$' && language == Language::linuxcnc;
    const auto word = is_letter(c) || spindle ? word_of(in, language) : std::nullopt;
    if (!word) {
      in.back_to(start);
      block.rest = in.rest();
      break;
    }
    block.words.push_back(*word);
  }
  return block;
}

}  // namespace turnwright::review
