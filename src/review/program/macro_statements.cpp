#include "macro_statements.hpp"

#include <array>
#include <tuple>

#include "expression.hpp"
#include "letters.hpp"
#include "turnwright/base/language.hpp"
#include "words.hpp"

namespace turnwright::review {
namespace {

constexpr std::size_t kLoops = 10;  // numbers of loops, of which controls have three

// The number of a loop: behind DO, which a condition may precede, and END.
std::optional<std::size_t> loop_number(std::string_view text) {
  if (text.size() != 1 || !is_digit(text.front())) return std::nullopt;
  return static_cast<std::size_t>(text.front() - '0');
}

// Behind the brackets at the front of a text.
std::string_view behind_brackets(std::string_view text) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '[') ++depth;
    if (text[i] == ']' && --depth == 0) return statement_of(text.substr(i + 1));
  }
  return {};
}

}  // namespace

MacroStatements::MacroStatements(const Flow& flow) {
  std::array<std::optional<std::size_t>, kLoops> open;
  for (std::size_t i = 0; i < flow.lines().size(); ++i) {
    auto [word, rest] = keyword_of(statement_of(flow.lines()[i]));
    if (word == "WHILE") std::tie(word, rest) = keyword_of(behind_brackets(rest));
    const auto number = loop_number(rest);
    if (!number) continue;
    if (word == "DO") open[*number] = i;
    if (word != "END" || !open[*number]) continue;
    ends_[*open[*number]] = i;
    ends_[i] = *open[*number];
    open[*number].reset();
  }
}

std::size_t MacroStatements::other_end(std::size_t line) const {
  const auto found = ends_.find(line);
  if (found == ends_.end())
    throw NotFollowed(tr("The loop's other end is not in the text."));
  return found->second;
}

bool MacroStatements::direct(Flow& flow) const {
  const auto [word, rest] = keyword_of(statement_of(flow.lines()[flow.line()]));
  if (word == "IF")
    branch(flow, rest);
  else if (word == "GOTO")
    go_to(flow, rest);
  else if (word == "END")
    flow.go_to(other_end(flow.line()));
  else if (word == "WHILE" && !flow.holds(rest).first)
    flow.go_to(other_end(flow.line()) + 1);
  return word == "IF" || word == "GOTO" || word == "END" || word == "WHILE" ||
         word == "DO";
}

void MacroStatements::branch(Flow& flow, std::string_view rest) const {
  const auto [holds, then] = flow.holds(rest);
  const auto [word, what] = keyword_of(then);
  if (word != "GOTO" && word != "THEN")
    throw NotFollowed(tr("Behind a condition GOTO or THEN is followed."));
  if (!holds) return;
  if (word == "GOTO") return go_to(flow, what);
  auto block = block_of(what, Language::macro_b);
  if (!block.words.empty() || !block.rest.empty() || block.assignments.empty())
    throw NotFollowed(tr("Behind THEN a variable must be set."));
  evaluate(block, flow.parameters);
}

void MacroStatements::go_to(Flow& flow, std::string_view number) const {
  flow.go_to(flow.block_or_throw(value_of(number, flow.parameters).value_or(0)));
}

}  // namespace turnwright::review
