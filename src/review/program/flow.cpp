#include "flow.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "expression.hpp"
#include "letters.hpp"

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

// A letter's whole number at the front of a text, and what follows.
std::optional<std::pair<double, std::string_view>> numbered(std::string_view text,
                                                            char letter) {
  if (text.empty() || capital(text.front()) != letter) return std::nullopt;
  text = without_blanks(text.substr(1));
  unsigned long number = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return std::pair{static_cast<double>(number), without_blanks(text)};
}

std::string_view without_slash(std::string_view line) {
  line = without_blanks(line);
  return without_blanks(line.substr(line.starts_with('/') ? 1 : 0));
}

bool is_comment(char c) { return c == '(' || c == ';'; }

}  // namespace

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

// Programs begin with "O1234 (NAME)" or ":1234"; "O100 sub" of LinuxCNC is none.
Labels::Labels(const std::vector<std::string_view>& lines)
    : end_of_first_(lines.size()), end_(lines.size()) {
  bool blocks_before = false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto line = without_slash(lines[i]);
    if (const auto N = numbered(line, 'N')) blocks_.emplace_back(N->first, i);
    auto O = numbered(line, 'O');
    if (!O) O = numbered(line, ':');
    if (O && (O->second.empty() || is_comment(O->second.front()))) {
      programs_.emplace(O->first, i);
      begins_.push_back(i);
      if (begins_.size() == (blocks_before ? 1 : 2)) end_of_first_ = i;
    } else if (begins_.empty() && !line.starts_with('%')) {
      blocks_before = blocks_before || !statement_of(line).empty();
    }
  }
  std::ranges::sort(blocks_);
}

std::optional<std::size_t> Labels::program(double number) const {
  const auto found = programs_.find(number);
  if (found == programs_.end()) return std::nullopt;
  return found->second;
}

std::size_t Labels::end_of_program(std::size_t begin) const {
  const auto next = std::ranges::upper_bound(begins_, begin);
  return next == begins_.end() ? end_ : *next;
}

std::optional<std::size_t> Labels::block(double N, std::size_t from,
                                         std::size_t to) const {
  const auto found = std::ranges::lower_bound(blocks_, std::pair{N, from});
  if (found == blocks_.end() || found->first != N || found->second >= to)
    return std::nullopt;
  return found->second;
}

Flow::Flow(const std::vector<std::string_view>& lines, gcode::Control control)
    : parameters(control),
      lines_(lines),
      labels_(lines),
      most_(lines.size() + kMostExecuted) {
  calls_.push_back({0, labels_.end_of_first()});
}

std::optional<std::size_t> Flow::next() {
  while (at_ >= calls_.back().end)
    if (endless() || !leave()) return std::nullopt;
  if (spent()) return std::nullopt;
  line_ = at_++;
  return line_;
}

std::optional<std::size_t> Flow::block(double N) const {
  const auto& call = calls_.back();
  const auto next = labels_.block(N, line_, call.end);
  return next ? next : labels_.block(N, call.begin, call.end);
}

std::size_t Flow::block_or_throw(double N) const {
  const auto line = block(N);
  if (!line) throw NotFollowed("There is no block of this number.");
  return *line;
}

void Flow::push(Call call, double times) {
  if (calls_.size() > kDeepestCalls)
    throw NotFollowed("Calls are followed ten deep, and no deeper.");
  call.times = std::lround(std::clamp(times, 0.0, kMostRuns));
  if (call.times == 0) return;
  call.back = at_;
  at_ = call.from;
  calls_.push_back(std::move(call));
}

void Flow::call_program(double number, double times) {
  const auto line = labels_.program(number);
  if (!line) throw NotFollowed("The subprogram is not in the text.");
  push({*line, labels_.end_of_program(*line), *line + 1}, times);
}

void Flow::call_blocks(double N, double times) {
  const auto& now = calls_.back();
  push({now.begin, now.end, block_or_throw(N)}, times);
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
  push({0, lines_.size(), line}, 1);
  calls_.back().own_variables = true;
  parameters.enter(arguments);
}

bool Flow::leave(std::optional<double> N) {
  if (calls_.size() == 1) return false;
  auto& call = calls_.back();
  call.loops.clear();
  if (--call.times > 0 && !N) {
    at_ = call.from;
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
  try {
    const bool holds = bracketed_value(text, parameters, end) != 0;
    return {holds, without_blanks(text.substr(end))};
  } catch (const NotFollowed& why) {
    doubt(why);
    return {false, without_blanks(text.substr(end))};
  }
}

}  // namespace turnwright::review
