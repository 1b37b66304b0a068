#include "siemens_statements.hpp"

#include <algorithm>
#include <initializer_list>

#include "expression.hpp"
#include "letters.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::review {
namespace {

std::string_view trimmed_blanks(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string small_letters(std::string_view text) {
  std::string all;
  for (const char c : text) all += small(c);
  return all;
}

bool one_of(std::string_view word, std::initializer_list<std::string_view> all) {
  return std::ranges::find(all, word) != all.end();
}

bool jumps(std::string_view word) {
  return one_of(word, {"goto", "gotof", "gotob", "gotos"});
}

// Splits a text at its first word of a jump, which stands alone.
std::pair<std::string_view, std::string_view> before_jump(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_letter(text[i]) && text[i] != '_') continue;
    const auto [word, rest] = name_at_front(text.substr(i));
    if (jumps(word)) return {trimmed_blanks(text.substr(0, i)), text.substr(i)};
    while (i + 1 < text.size() &&
           (is_letter(text[i + 1]) || is_digit(text[i + 1]) || text[i + 1] == '_'))
      ++i;
  }
  return {trimmed_blanks(text), {}};
}

// "IF R1 > 3 GOTOF MARK" is one block; "IF R1 > 3" begins a branch.
bool begins_branch(std::string_view rest) { return before_jump(rest).second.empty(); }

// "REPEAT" alone begins a loop that UNTIL ends; with labels it repeats them.
bool begins_part(const std::string& word, std::string_view rest) {
  if (word == "if") return begins_branch(rest);
  if (word == "repeat") return rest.empty();
  return one_of(word, {"while", "for", "loop"});
}

std::string ended_by(const std::string& word) {
  if (word == "endif" || word == "else") return "if";
  if (word == "endwhile") return "while";
  if (word == "endfor") return "for";
  if (word == "endloop") return "loop";
  return word == "until" ? "repeat" : "";
}

void jump(Flow& flow, std::string_view text) {
  const auto [word, rest] = name_at_front(text);
  if (word == "gotos") return flow.go_to_begin();
  const auto label = label_at_front(rest, Language::siemens);
  const auto line = word == "gotof"   ? flow.block_ahead(label)
                    : word == "gotob" ? flow.block_behind(label)
                                      : flow.block(label);
  if (!line) throw NotFollowed(tr("There is no such label that way."));
  flow.go_to(*line);
}

// The number of "P=3", "P3" or "P=R1" at the front of a text; 1 if there is none.
double times_of(std::string_view text, const Parameters& parameters) {
  text = trimmed_blanks(text);
  if (text.empty()) return 1;
  if (capital(text.front()) != 'P')
    throw NotFollowed(tr("Behind what is repeated or called only P is followed."));
  text = trimmed_blanks(text.substr(1));
  if (text.starts_with('=')) text.remove_prefix(1);
  return value_of(text, parameters).value_or(1);
}

// Divides "FIRST LAST P=3" into names and what begins with P.
void repeat_lines(Flow& flow, std::string_view rest, bool one_block) {
  std::vector<std::string> labels;
  for (rest = trimmed_blanks(rest); !rest.empty();) {
    const auto [name, behind] = name_at_front(rest);
    const bool times =
        name == "p" || (name.size() > 1 && name.front() == 'p' &&
                        name.find_first_not_of("0123456789", 1) == name.npos);
    if (name.empty() || times) break;
    labels.push_back(label_at_front(rest, Language::siemens));
    rest = behind;
  }
  if (labels.empty() || labels.size() > 2)
    throw NotFollowed(tr("One label or two are followed."));
  const double times = times_of(rest, flow.parameters);
  const auto find = [&flow](const std::string& label) {
    const auto line = flow.block_behind(label);
    return line ? line : flow.block(label);
  };
  const auto first = find(labels.front());
  if (!first) throw NotFollowed(tr("There is no such label."));
  if (one_block) return flow.repeat(*first, *first, times);
  std::optional<std::size_t> last;
  if (labels.size() == 2)
    last = flow.block(labels.back());
  else
    last = flow.block_between("endlabel", *first, flow.line());
  if (!last && *first < flow.line()) last = flow.line() - 1;
  if (!last || *last < *first) throw NotFollowed(tr("The section has no end."));
  flow.repeat(*first, *last, times);
}

// One parameter of PROC, or one variable of DEF: "REAL D", "INT N=3", "D[5]=1".
struct Declared {
  std::string type, name;
  std::string_view index, value;
};
Declared declared_in(std::string_view text, const std::string& type_before) {
  Declared d;
  text = trimmed_blanks(text);
  d.type = type_before;
  const auto [word, rest] = name_at_front(text);
  if (one_of(word, {"real", "int", "bool", "string", "char", "axis", "frame", "var"})) {
    d.type = word;
    text = rest;
    if (word == "string" && text.starts_with('['))  // its length
      text = trimmed_blanks(text.substr(std::min(text.find(']'), text.size() - 1) + 1));
  }
  auto [name, behind] = name_at_front(text);
  d.name = name;
  if (behind.starts_with('[')) {
    const auto end = std::min(behind.find(']'), behind.size() - 1);
    d.index = behind.substr(1, end - 1);
    behind = trimmed_blanks(behind.substr(end + 1));
  }
  if (behind.starts_with('=')) d.value = trimmed_blanks(behind.substr(1));
  return d;
}

bool counts(const std::string& type) { return one_of(type, {"real", "int", "bool"}); }

void declare(Parameters& p, const Declared& d, double value) {
  p.declare(d.name, d.type != "real");
  if (d.index.empty()) p.set(d.name, value);
}

// "DEF REAL A, B=3, C[5]"; texts and axes are named nowhere else.
void define(Flow& flow, std::string_view rest) {
  std::string type;
  for (const auto& text : texts_of_arguments("(" + std::string(rest) + ")")) {
    const auto d = declared_in(text, type);
    type = d.type;
    if (d.name.empty() || type.empty())
      throw NotFollowed(tr("A type and names are followed behind DEF."));
    if (!counts(type)) continue;
    if (!d.index.empty() && !d.value.empty())
      throw NotFollowed(tr("Arrays are followed without first values."));
    declare(flow.parameters, d,
            d.value.empty() ? 0 : value_of(d.value, flow.parameters).value_or(0));
  }
}

// Calls a program with the values that stand in brackets, then times.
void call(Flow& flow, const std::string& name, std::string_view rest) {
  std::vector<std::string> texts;
  if (rest.starts_with('(')) {
    texts = texts_of_arguments(rest);
    rest = rest.substr(std::min(rest.rfind(')') + 1, rest.size()));
  }
  const double times = times_of(rest, flow.parameters);
  const auto begin = flow.program(name);
  if (!begin) throw NotFollowed(tr("The subprogram is not in the text."));
  std::string_view head;
  for (auto i = *begin; i < flow.end_of_program(*begin) && i < *begin + 5; ++i) {
    const auto [word, behind] = name_at_front(siemens_statement_of(flow.lines()[i]));
    if (word == "proc") head = name_at_front(behind).second;
  }
  std::vector<std::pair<Declared, double>> values;
  if (head.starts_with('(')) {
    const auto wanted = texts_of_arguments(head.substr(0, head.rfind(')') + 1));
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const auto d = declared_in(wanted[i], "");
      if (d.name.empty()) continue;
      if (!counts(d.type))
        throw NotFollowed(tr("Only REAL, INT and BOOL are followed as values of calls."));
      const std::string_view given =
          i < texts.size() && !texts[i].empty() ? texts[i] : d.value;
      values.emplace_back(
          Declared{d.type, d.name, {}, {}},
          given.empty() ? 0 : value_of(given, flow.parameters).value_or(0));
    }
  }
  if (!flow.call_named(name, times)) return;
  for (const auto& [d, value] : values) declare(flow.parameters, d, value);
  flow.parameters.keep_first();
}

}  // namespace

std::vector<std::string> texts_of_arguments(std::string_view bracketed) {
  std::vector<std::string> all{""};
  int depth = 0;
  bool quoted = false;
  for (const char c : bracketed) {
    if (c == '"') quoted = !quoted;
    if (!quoted && (c == ')' || c == ']') && --depth == 0) {
      for (auto& text : all) text = trimmed_blanks(text);
      return all;
    }
    if (!quoted && depth == 1 && c == ',')
      all.emplace_back();
    else if (depth > 0)
      all.back() += c;
    if (!quoted && (c == '(' || c == '[')) ++depth;
  }
  throw NotFollowed(tr("The brackets are not closed."));
}

SiemensStatements::SiemensStatements(const Flow& flow) {
  for (std::size_t i = 0; i < flow.lines().size(); ++i) {
    const auto [word, rest] = name_at_front(siemens_statement_of(flow.lines()[i]));
    if (begins_part(word, rest) || !ended_by(word).empty()) tie(i, word);
  }
}

void SiemensStatements::tie(std::size_t line, const std::string& word) {
  auto& part = parts_[line];
  part.word = word;
  const auto begins = ended_by(word);
  if (begins.empty()) {
    part.first = line;
    open_.push_back(line);
    return;
  }
  if (open_.empty() || parts_[parts_[open_.back()].first].word != begins) return;
  parts_[open_.back()].next = line;
  part.first = parts_[open_.back()].first;
  open_.back() = line;
  if (word == "else") return;
  open_.pop_back();
  for (auto at = part.first; at != kNone; at = parts_[at].next) parts_[at].last = line;
}

const SiemensStatements::Part& SiemensStatements::tied(std::size_t line) const {
  const auto found = parts_.find(line);
  if (found == parts_.end() || found->second.last == kNone)
    throw NotFollowed(tr("The other end of the branch or loop is not in the text."));
  return found->second;
}

bool SiemensStatements::is_directing(std::string_view line) {
  const auto [word, rest] = name_at_front(siemens_statement_of(line));
  return begins_part(word, rest) || !ended_by(word).empty() || jumps(word) ||
         one_of(word, {"if", "repeat", "repeatb", "call", "case"});
}

std::optional<std::pair<std::size_t, std::size_t>> SiemensStatements::contour(
    const Flow& flow, std::string_view name) {
  const auto parts = name.find(':');
  if (parts != name.npos) {
    const auto first = flow.block(small_letters(name.substr(0, parts)));
    const auto last = flow.block(small_letters(name.substr(parts + 1)));
    if (!first || !last || *last < *first) return std::nullopt;
    return std::pair{*first, *last};
  }
  const auto begin = flow.program(small_letters(name));
  if (!begin) return std::nullopt;
  return std::pair{*begin + 1, flow.end_of_program(*begin) - 1};
}

bool SiemensStatements::direct(Flow& flow) const {
  const auto statement = siemens_statement_of(flow.lines()[flow.line()]);
  const auto [word, rest] = name_at_front(statement);
  if (word.empty()) return false;
  if (word == "proc" || word == "extern") return true;
  if (word == "def") return define(flow, rest), true;
  if (word == "if" && !begins_branch(rest)) {
    const auto [condition, target] = before_jump(rest);
    if (flow.holds_all(condition)) jump(flow, target);
    return true;
  }
  if (jumps(word)) return jump(flow, statement), true;
  if (begins_part(word, rest) || !ended_by(word).empty()) {
    if (word == "if" || word == "else" || word == "endif")
      branch(flow, rest);
    else
      loop(flow, word, rest);
    return true;
  }
  if (word == "repeat" || word == "repeatb")
    return repeat_lines(flow, rest, word == "repeatb"), true;
  if (word == "ret") {
    if (!flow.leave_program()) throw NotFollowed(tr("There is no subprogram to leave."));
    return true;
  }
  if (word == "call") {
    const auto end = rest.find('"', 1);
    if (!rest.starts_with('"') || end == rest.npos)
      throw NotFollowed(tr("Only CALL \"NAME\" is followed."));
    return call(flow, small_letters(rest.substr(1, end - 1)), rest.substr(end + 1)), true;
  }
  const bool numbered = word.size() > 1 && word.front() == 'l' &&
                        word.find_first_not_of("0123456789", 1) == word.npos;
  if (numbered || (flow.program(word) && !rest.starts_with('=')))
    return call(flow, word, rest), true;
  return false;
}

// To the branch that holds; from the end of one behind them all.
void SiemensStatements::branch(Flow& flow, std::string_view rest) const {
  const auto& part = tied(flow.line());
  if (part.word != "if") return flow.go_to(part.last + 1);
  if (!flow.holds_all(rest)) flow.go_to(part.next + 1);
}

void SiemensStatements::loop(Flow& flow, const std::string& word,
                             std::string_view rest) const {
  const auto& part = tied(flow.line());
  if (word == "while") {
    if (!flow.holds_all(rest)) flow.go_to(part.last + 1);
  } else if (word == "for" || word == "endfor") {
    const auto begin = siemens_statement_of(flow.lines()[part.first]);
    count(flow, name_at_front(begin).second, word == "for");
  } else if (word == "until") {
    if (!flow.holds_all(rest)) flow.go_to(part.first + 1);
  } else if (word != "loop" && word != "repeat") {
    flow.go_to(part.first);
  }
}

// "R1 = 1 TO 5": one more each time.
void SiemensStatements::count(Flow& flow, std::string_view rest, bool begins) const {
  const auto lower = small_letters(rest);
  const auto to = lower.find(" to ");
  const auto is = rest.find('=');
  if (to == lower.npos || is == rest.npos || is > to)
    throw NotFollowed(
        tr("FOR is followed as a variable, \"=\", a value, TO and a value."));
  const auto variable = trimmed_blanks(rest.substr(0, is));
  auto& p = flow.parameters;
  const double value = begins ? value_of(rest.substr(is + 1, to - is - 1), p).value_or(0)
                              : value_of(variable, p).value_or(0) + 1;
  set_variable(p, variable, value);
  const auto& part = tied(flow.line());
  const bool goes_on = value <= value_of(rest.substr(to + 4), p).value_or(0);
  flow.go_to(goes_on ? part.first + 1 : part.last + 1);
}

}  // namespace turnwright::review
