#include "flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "expression.hpp"
#include "letters.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::review {
namespace {

constexpr std::size_t kMostExecuted = 200'000;  // beyond each line once
constexpr std::size_t kDeepestCalls = 10;       // calls in calls
constexpr double kMostRuns = 9999;

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

bool is_comment(char c) { return c == '(' || c == ';'; }

// A letter's whole number at the front of a text as a label, and what follows.
std::optional<std::pair<std::string, std::string_view>> numbered(std::string_view text,
                                                                 char letter) {
  if (text.empty() || capital(text.front()) != letter) return std::nullopt;
  text = without_blanks(text.substr(1));
  std::size_t end = 0;
  while (end < text.size() && is_digit(text[end])) ++end;
  if (end == 0) return std::nullopt;
  auto digits = text.substr(0, end);
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size() - 1));
  return std::pair{std::string(digits), without_blanks(text.substr(end))};
}

// The same of a letter before a number or a name: "NLAP1", "OSUB", "N10G0".
std::optional<std::pair<std::string, std::string_view>> labelled(std::string_view text,
                                                                 char letter) {
  if (auto number = numbered(text, letter)) return number;
  if (text.size() < 2 || capital(text[0]) != letter || !is_letter(text[1]))
    return std::nullopt;
  const auto [name, rest] = name_at_front(text.substr(1));
  if (rest.data() == text.data() + 1 + name.size() && !rest.empty() &&
      !is_comment(rest[0]))
    return std::nullopt;
  return std::pair{name, rest};
}

std::string_view without_slash(std::string_view line) {
  line = without_blanks(line);
  if (!line.starts_with('/')) return line;
  line.remove_prefix(1);
  if (!line.empty() && is_digit(line.front())) line.remove_prefix(1);  // "/2": a switch
  return without_blanks(line);
}

// "MARK:" at the front of a text, and what follows.
std::optional<std::pair<std::string, std::string_view>> marked(std::string_view text) {
  const auto [name, rest] = name_at_front(text);
  if (name.empty() || !rest.starts_with(':')) return std::nullopt;
  return std::pair{name, without_blanks(rest.substr(1))};
}

// Without the comment that begins with ";", which no text in quotes begins.
std::string_view without_siemens_comment(std::string_view line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] == ';' && !quoted) return line.substr(0, i);
  }
  return line;
}

// The program that begins in a line of Siemens: "%_N_SHAFT_MPF", "PROC SHAFT(REAL D)".
std::string siemens_program(std::string_view line) {
  constexpr std::string_view kArchive = "%_N_";
  if (std::ranges::equal(line.substr(0, kArchive.size()), kArchive, {}, capital)) {
    auto name = name_at_front(line.substr(kArchive.size())).first;
    if (name.ends_with("_mpf") || name.ends_with("_spf")) name.resize(name.size() - 4);
    return name;
  }
  const auto [word, rest] = name_at_front(siemens_statement_of(line));
  return word == "proc" ? name_at_front(rest).first : "";
}

}  // namespace

std::string label_of(double number) { return fmt::format("{}", number); }

std::pair<std::string, std::string_view> name_at_front(std::string_view text) {
  std::string name;
  std::size_t end = 0;
  while (end < text.size() &&
         (is_letter(text[end]) || text[end] == '_' || (end > 0 && is_digit(text[end]))))
    name += small(text[end++]);
  return {name, without_blanks(text.substr(end))};
}

std::string label_at_front(std::string_view text, Language language) {
  text = without_blanks(text);
  for (const char letter : {'N', 'O'}) {
    auto label =
        language == Language::okuma ? labelled(text, letter) : numbered(text, letter);
    if (label) return std::move(label->first);
  }
  return name_at_front(text).first;
}

bool names_okuma_file(std::string_view line) {
  line = without_blanks(line);
  return line.starts_with('$') && line.ends_with('%');
}

std::string_view okuma_statement_of(std::string_view line) {
  line = without_slash(line);
  if (const auto N = labelled(line, 'N')) line = N->second;
  const auto front = name_at_front(line);
  if (front.first == "noex") line = front.second;
  const auto end = std::ranges::find_if(line, is_comment) - line.begin();
  return without_blanks(line.substr(0, static_cast<std::size_t>(end)));
}

std::string_view siemens_statement_of(std::string_view line) {
  line = without_blanks(without_siemens_comment(without_slash(line)));
  if (const auto N = numbered(line, 'N')) line = N->second;
  if (const auto mark = marked(line)) line = mark->second;
  return line;
}

std::string_view statement_of(std::string_view line) {
  line = without_slash(line);
  if (const auto N = numbered(line, 'N')) line = N->second;
  const auto end = std::ranges::find_if(line, is_comment) - line.begin();
  return without_blanks(line.substr(0, static_cast<std::size_t>(end)));
}

std::pair<std::string, std::string_view> keyword_of(std::string_view text) {
  std::string word;
  while (!text.empty() && is_letter(text.front())) {
    word += capital(text.front());
    text.remove_prefix(1);
  }
  return {word, without_blanks(text)};
}

// "O100 sub" of LinuxCNC begins no program.
Labels::Labels(const std::vector<std::string_view>& lines, Language language)
    : end_of_first_(lines.size()), end_(lines.size()) {
  bool blocks_before = false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto line = without_slash(lines[i]);
    const bool okuma = language == Language::okuma;
    const auto N = okuma ? labelled(line, 'N') : numbered(line, 'N');
    if (N) blocks_.emplace_back(N->first, i);
    std::string begins;
    if (language == Language::siemens) {
      begins = siemens_program(line);
      if (const auto mark = marked(N ? N->second : line))
        blocks_.emplace_back(mark->first, i);
    } else {
      auto O = okuma ? labelled(line, 'O') : numbered(line, 'O');
      if (!O) O = numbered(line, ':');
      if (O && (O->second.empty() || is_comment(O->second.front()))) begins = O->first;
    }
    if (!begins.empty())
      begin(begins, i, blocks_before);
    else if (begins_.empty() && !line.starts_with('%') &&
             !(okuma && names_okuma_file(line)))
      blocks_before = blocks_before || !statement_of(line).empty();
  }
  std::ranges::sort(blocks_);
}

// "PROC SHAFT" behind "%_N_SHAFT_SPF" is the same program.
void Labels::begin(const std::string& name, std::size_t line, bool blocks_before) {
  const auto known = programs_.emplace(name, line);
  if (!known.second && !begins_.empty() && known.first->second == begins_.back()) return;
  begins_.push_back(line);
  if (begins_.size() == (blocks_before ? 1 : 2)) end_of_first_ = line;
}

std::optional<std::size_t> Labels::program(const std::string& name) const {
  const auto found = programs_.find(name);
  if (found == programs_.end()) return std::nullopt;
  return found->second;
}

std::size_t Labels::end_of_program(std::size_t begin) const {
  const auto next = std::ranges::upper_bound(begins_, begin);
  return next == begins_.end() ? end_ : *next;
}

std::optional<std::size_t> Labels::block(const std::string& label, std::size_t from,
                                         std::size_t to) const {
  const auto found = std::ranges::lower_bound(blocks_, std::pair{label, from});
  if (found == blocks_.end() || found->first != label || found->second >= to)
    return std::nullopt;
  return found->second;
}

std::optional<std::size_t> Labels::last_block(const std::string& label, std::size_t from,
                                              std::size_t to) const {
  const auto behind = std::ranges::lower_bound(blocks_, std::pair{label, to});
  if (behind == blocks_.begin()) return std::nullopt;
  const auto& found = *std::prev(behind);
  if (found.first != label || found.second < from) return std::nullopt;
  return found.second;
}

Flow::Flow(const std::vector<std::string_view>& lines, gcode::Control control)
    : parameters(control),
      lines_(lines),
      labels_(lines, language_of(control)),
      most_(lines.size() + kMostExecuted) {
  const auto end = labels_.end_of_first();
  calls_.push_back({.begin = 0, .end = end, .stop = end});
}

std::optional<std::size_t> Flow::next() {
  while (at_ >= calls_.back().stop)
    if (endless() || !leave()) return std::nullopt;
  if (spent()) return std::nullopt;
  line_ = at_++;
  return line_;
}

std::optional<std::size_t> Flow::block(const std::string& label) const {
  const auto& call = calls_.back();
  const auto next = block_ahead(label);
  return next ? next : labels_.block(label, call.begin, call.end);
}

std::optional<std::size_t> Flow::block_ahead(const std::string& label) const {
  return labels_.block(label, line_, calls_.back().end);
}

std::optional<std::size_t> Flow::block_behind(const std::string& label) const {
  return labels_.last_block(label, calls_.back().begin, line_ + 1);
}

std::size_t Flow::block_or_throw(double N) const {
  const auto line = block(N);
  if (!line) throw NotFollowed(tr("There is no block of this number."));
  return *line;
}

void Flow::push(Call call, double times) {
  if (calls_.size() > kDeepestCalls)
    throw NotFollowed(tr("Calls are followed ten deep, and no deeper."));
  call.times = std::lround(std::clamp(times, 0.0, kMostRuns));
  if (call.times == 0) return;
  call.back = at_;
  at_ = call.from;
  calls_.push_back(std::move(call));
}

void Flow::call_program(double number, double times) {
  const auto line = program(label_of(number));
  if (!line) throw NotFollowed(tr("The subprogram is not in the text."));
  const auto end = labels_.end_of_program(*line);
  push({.begin = *line, .end = end, .from = *line + 1, .stop = end}, times);
}

void Flow::call_blocks(double N, double times) {
  const auto& now = calls_.back();
  push({.begin = now.begin, .end = now.end, .from = block_or_throw(N), .stop = now.end},
       times);
}

bool Flow::call_named(const std::string& name, double times) {
  const auto line = program(name);
  if (!line) throw NotFollowed(tr("The subprogram is not in the text."));
  const auto end = labels_.end_of_program(*line);
  const auto depth = calls_.size();
  push({.begin = *line, .end = end, .from = *line + 1, .stop = end}, times);
  if (calls_.size() == depth) return false;
  calls_.back().own_variables = true;
  parameters.enter({});
  return true;
}

void Flow::repeat(std::size_t first, std::size_t last, double times) {
  const auto& now = calls_.back();
  push({.begin = now.begin,
        .end = now.end,
        .from = first,
        .stop = last + 1,
        .section = true},
       times);
}

void Flow::call_macro(double number, double times,
                      const std::map<int, double>& arguments) {
  const auto depth = calls_.size();
  call_program(number, times);
  if (calls_.size() == depth) return;
  calls_.back().own_variables = true;
  parameters.enter(arguments);
}

void Flow::enter(std::size_t line, const std::map<int, double>& arguments) {
  push({.begin = 0, .end = lines_.size(), .from = line, .stop = lines_.size()}, 1);
  calls_.back().own_variables = true;
  parameters.enter(arguments);
}

bool Flow::leave(std::optional<double> N) {
  if (calls_.size() == 1) return false;
  auto& call = calls_.back();
  call.loops.clear();
  if (--call.times > 0 && !N) {
    at_ = call.from;
    if (call.own_variables) parameters.begin_again();
    ++executed_;  // of an empty program, too
    return true;
  }
  at_ = call.back;
  if (call.own_variables) parameters.leave();
  calls_.pop_back();
  if (N) at_ = block_or_throw(*N);
  return true;
}

std::pair<bool, std::string_view> Flow::holds(std::string_view text) {
  std::size_t end = 0;
  int depth = 0;
  for (; end < text.size(); ++end) {
    if (text[end] == '[') ++depth;
    if (text[end] == ']' && --depth == 0) break;
  }
  end = std::min(end + 1, text.size());
  const bool is =
      not_in_doubt([&] { return bracketed_value(text, parameters, end) != 0; });
  return {is, without_blanks(text.substr(end))};
}

bool Flow::holds_all(std::string_view condition) {
  return not_in_doubt([&] { return value_of(condition, parameters).value_or(0) != 0; });
}

bool Flow::not_in_doubt(const std::function<bool()>& condition) {
  try {
    return condition();
  } catch (const NotFollowed& why) {
    doubt(why);
    return false;
  }
}

bool Flow::leave_program(std::optional<double> N) {
  while (calls_.back().section) calls_.pop_back();
  return leave(N);
}

}  // namespace turnwright::review
