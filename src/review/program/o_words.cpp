#include "o_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "expression.hpp"
#include "letters.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::review {
namespace {

constexpr double kMostRepeats = 1e6;  // of a repetition; lines are counted anyhow

// The label at the front of a text behind its O, small and without blanks; what follows.
std::pair<std::string, std::string_view> label_before_word(std::string_view text) {
  std::string label;
  std::size_t at = 0;
  const char closing = text.starts_with('<') ? '>' : text.starts_with('[') ? ']' : '\0';
  if (closing) {
    const auto end = closing == '>' ? text.find('>') : text.rfind(']');
    if (end == text.npos) return {};
    for (const char c : text.substr(0, end + 1))
      if (!is_blank(c)) label += small(c);
    at = end + 1;
  } else {
    while (at < text.size() && is_digit(text[at])) label += text[at++];
    label.erase(0, std::min(label.find_first_not_of('0'), label.size()));
  }
  while (at < text.size() && is_blank(text[at])) ++at;
  return {label, text.substr(at)};
}

}  // namespace

std::optional<OWords::Line> OWords::read(std::string_view text) {
  static const std::map<std::string, Kind> kKinds{{"SUB", Kind::sub},
                                                  {"ENDSUB", Kind::endsub},
                                                  {"RETURN", Kind::back},
                                                  {"CALL", Kind::call},
                                                  {"IF", Kind::if_},
                                                  {"ELSEIF", Kind::elseif},
                                                  {"ELSE", Kind::else_},
                                                  {"ENDIF", Kind::endif},
                                                  {"WHILE", Kind::while_},
                                                  {"ENDWHILE", Kind::endwhile},
                                                  {"DO", Kind::do_},
                                                  {"REPEAT", Kind::repeat},
                                                  {"ENDREPEAT", Kind::endrepeat},
                                                  {"BREAK", Kind::leave},
                                                  {"CONTINUE", Kind::go_on}};
  if (text.empty() || capital(text.front()) != 'O') return std::nullopt;
  const auto begins = text.find_first_not_of(" \t", 1);
  if (begins == text.npos) return std::nullopt;
  // "o[#1] call [2]": the brackets of the label end before the word.
  auto labelled = text.substr(begins);
  if (labelled.starts_with('[')) {
    const auto end = labelled.find(']');
    if (end == labelled.npos) return std::nullopt;
    const auto [word, rest] = keyword_of(statement_of(labelled.substr(end + 1)));
    if (word != "CALL") return std::nullopt;
    return Line{.label = std::string(labelled.substr(0, end + 1)),
                .kind = Kind::call,
                .rest = rest};
  }
  const auto [label, behind] = label_before_word(labelled);
  const auto [word, rest] = keyword_of(behind);
  const auto kind = kKinds.find(word);
  if (label.empty() || kind == kKinds.end()) return std::nullopt;
  return Line{.label = label, .kind = kind->second, .rest = rest};
}

OWords::OWords(const Flow& flow) {
  for (std::size_t i = 0; i < flow.lines().size(); ++i) {
    auto line = read(statement_of(flow.lines()[i]));
    if (!line) continue;
    line->line = i;
    all_.push_back(std::move(*line));
    tie(all_.size() - 1);
  }
}

// Ties a line to the open one of its label.
void OWords::tie(std::size_t i) {
  auto& line = all_[i];
  auto& open = open_[line.label];
  if (line.kind == Kind::while_ && !open.empty() && all_[open.back()].kind == Kind::do_)
    line.kind = Kind::do_while;
  switch (line.kind) {
    case Kind::back:
    case Kind::call:
    case Kind::leave:
    case Kind::go_on:
      return;
    case Kind::sub:
    case Kind::if_:
    case Kind::while_:
    case Kind::do_:
    case Kind::repeat:
      line.first = i;
      open.push_back(i);
      begun_[line.label].push_back(i);
      if (line.kind == Kind::sub) subroutines_.emplace(line.label, i);
      return;
    default:
      break;
  }
  if (open.empty()) return;
  all_[open.back()].next = i;
  line.first = all_[open.back()].first;
  open.back() = i;
  if (line.kind == Kind::elseif || line.kind == Kind::else_) return;
  open.pop_back();
  for (std::size_t k = line.first; k != kNone; k = all_[k].next) all_[k].last = i;
}

const OWords::Line& OWords::tied(std::size_t i) const {
  if (i == kNone || all_[i].last == kNone)
    throw NotFollowed(tr("The O word's other end is not in the text."));
  return all_[i];
}

std::optional<std::pair<std::size_t, std::size_t>> OWords::subroutine(
    double number) const {
  const auto sub = subroutines_.find(label_of(number));
  if (sub == subroutines_.end() || all_[sub->second].last == kNone) return std::nullopt;
  return std::pair{all_[sub->second].line, all_[all_[sub->second].last].line};
}

bool OWords::direct(Flow& flow) const {
  const auto found = std::ranges::lower_bound(all_, flow.line(), {}, &Line::line);
  if (found == all_.end() || found->line != flow.line()) return false;
  const auto& line = *found;
  switch (line.kind) {
    case Kind::sub:
      tied(line.first);
      after(flow, all_[line.last]);
      break;
    case Kind::endsub:
    case Kind::back:
      back(flow, line);
      break;
    case Kind::call:
      call(flow, line);
      break;
    case Kind::if_:
    case Kind::elseif:
    case Kind::else_:
    case Kind::endif:
      branch(flow, line);
      break;
    case Kind::while_:
    case Kind::endwhile:
    case Kind::do_:
    case Kind::do_while:
      loop(flow, line);
      break;
    case Kind::repeat:
    case Kind::endrepeat:
      repeat(flow, line);
      break;
    case Kind::leave:
    case Kind::go_on:
      leave_loop(flow, line);
      break;
  }
  return true;
}

// From an if to the first branch whose condition holds; from the end of a branch, which is
// the next elseif or else, behind them all.
void OWords::branch(Flow& flow, const Line& line) const {
  tied(line.first);
  if (line.kind != Kind::if_) return after(flow, all_[line.last]);
  const Line* at = &line;
  while (at->kind != Kind::endif && at->kind != Kind::else_ && !flow.spent() &&
         !flow.holds(at->rest).first)
    at = &all_[at->next];
  after(flow, *at);
}

void OWords::loop(Flow& flow, const Line& line) const {
  const auto& first = tied(line.first);
  if (line.kind == Kind::while_ && !flow.holds(line.rest).first)
    after(flow, all_[line.last]);
  if (line.kind == Kind::endwhile) flow.go_to(first.line);
  if (line.kind == Kind::do_while && flow.holds(line.rest).first) after(flow, first);
}

void OWords::repeat(Flow& flow, const Line& line) const {
  const auto& first = tied(line.first);
  if (line.kind == Kind::repeat) {
    std::size_t end = 0;
    const double times = bracketed_value(line.rest, flow.parameters, end);
    if (!(times >= 1)) return after(flow, all_[line.last]);
    flow.loops()[first.line] = std::lround(std::min(times, kMostRepeats));
  } else if (--flow.loops()[first.line] > 0) {
    after(flow, first);
  }
}

void OWords::call(Flow& flow, const Line& line) const {
  auto label = line.label;
  if (label.starts_with('[')) {
    const auto number = value_of(label, flow.parameters).value_or(0);
    label = fmt::format("{:.0f}", number);
  }
  const auto sub = subroutines_.find(label);
  if (sub == subroutines_.end())
    throw NotFollowed(tr("The subprogram is not in the text."));
  std::map<int, double> arguments;
  auto rest = line.rest;
  for (int n = 1; !rest.empty(); ++n) {
    std::size_t end = 0;
    arguments[n] = bracketed_value(rest, flow.parameters, end);
    rest = statement_of(rest.substr(end));
  }
  flow.enter(all_[tied(sub->second).first].line + 1, arguments);
}

void OWords::back(Flow& flow, const Line& line) const {
  std::size_t end = 0;
  if (!line.rest.empty())
    flow.parameters.set("_value", bracketed_value(line.rest, flow.parameters, end));
  if (!flow.leave()) throw NotFollowed(tr("There is no subroutine to come back from."));
}

void OWords::leave_loop(Flow& flow, const Line& line) const {
  const auto begun = begun_.find(line.label);
  if (begun == begun_.end()) tied(kNone);
  const auto& all = begun->second;
  const auto behind = std::ranges::lower_bound(
      all, line.line, {}, [&](std::size_t i) { return all_[i].line; });
  if (behind == all.begin()) tied(kNone);
  const auto& last = all_[tied(*std::prev(behind)).last];
  if (line.kind == Kind::leave)
    after(flow, last);
  else
    flow.go_to(last.line);
}

}  // namespace turnwright::review
