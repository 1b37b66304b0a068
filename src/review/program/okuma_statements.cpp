#include "okuma_statements.hpp"

#include <algorithm>

#include "expression.hpp"
#include "letters.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::review {
namespace {

constexpr std::string_view kWords[] = {"if", "goto", "call", "rts", "modin", "modout"};

void go_to(Flow& flow, std::string_view text) {
  const auto line = flow.block(label_at_front(text, Language::okuma));
  if (!line) throw NotFollowed(tr("There is no block of this name."));
  flow.go_to(*line);
}

void branch(Flow& flow, std::string_view rest) {
  const auto [holds, then] = flow.holds(rest);
  const auto [word, behind] = name_at_front(then);
  if (holds) go_to(flow, word == "goto" ? behind : then);
}

// "CALL O100 Q2 LA=3": Q times, with values for variables of its own.
void call(Flow& flow, std::string_view rest) {
  if (rest.empty() || capital(rest.front()) != 'O')
    throw NotFollowed(tr("The subprogram has no name."));
  const auto name = label_at_front(rest, Language::okuma);
  auto block = block_of(name_at_front(rest).second, Language::okuma);
  std::vector<std::pair<std::string, double>> values;
  double times = 1;
  for (const auto& w : block.words) {
    const double value = w.expression.empty()
                             ? w.value.value_or(0)
                             : value_of(w.expression, flow.parameters).value_or(0);
    if (w.name == "Q")
      times = value;
    else if (w.name.size() > 1 && w.text.find('=') != w.text.npos)
      values.emplace_back(w.name, value);
    else
      throw NotFollowed(tr("Behind a call Q and values of variables are followed."));
  }
  if (!block.rest.empty() || !block.assignments.empty())
    throw NotFollowed(tr("Behind a call Q and values of variables are followed."));
  if (!flow.call_named(name, times)) return;
  for (const auto& [variable, value] : values)
    set_variable(flow.parameters, variable, value);
  flow.parameters.keep_first();
}

}  // namespace

OkumaStatements::OkumaStatements(const Flow& flow) {
  for (std::size_t i = 0; i < flow.lines().size(); ++i) {
    const auto block = block_of(flow.lines()[i], Language::okuma);
    if (std::ranges::any_of(block.words,
                            [](const Word& w) { return w.name == "G" && w.value == 80; }))
      ends_.push_back(i);
  }
}

bool OkumaStatements::is_directing(std::string_view line) {
  const auto word = name_at_front(okuma_statement_of(line)).first;
  return std::ranges::find(kWords, word) != std::end(kWords);
}

bool OkumaStatements::direct(Flow& flow) const {
  const auto statement = okuma_statement_of(flow.lines()[flow.line()]);
  const auto [word, rest] = name_at_front(statement);
  if (!is_directing(statement)) return false;
  if (word == "if")
    branch(flow, rest);
  else if (word == "goto")
    go_to(flow, rest);
  else if (word == "call")
    call(flow, rest);
  else if (word != "rts")
    throw NotFollowed(tr("Calls after each block are not followed."));
  else if (!flow.leave())
    throw NotFollowed(tr("There is no subprogram to leave."));
  return true;
}

std::optional<std::size_t> OkumaStatements::end_of_contour(std::size_t line) const {
  const auto found = std::ranges::lower_bound(ends_, line);
  if (found == ends_.end()) return std::nullopt;
  return *found;
}

std::optional<std::string> label_in(const Block& block) {
  for (const auto& w : block.words)
    if (w.name.starts_with('N')) return label_at_front(w.text, Language::okuma);
  return std::nullopt;
}

}  // namespace turnwright::review
