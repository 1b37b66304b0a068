#include "turnwright/base/pattern.hpp"

#include <regex>

namespace turnwright {
namespace {

Pattern::Groups groups(const std::cmatch& m) { return {m.begin(), m.end()}; }

auto syntax(Pattern::Case letters) {
  return letters == Pattern::Case::any ? std::regex::ECMAScript | std::regex::icase
                                       : std::regex::ECMAScript;
}

}  // namespace

struct Pattern::Compiled {
  std::regex expression;
};

Pattern::Pattern(const std::string& expression, Case letters)
    : compiled_(new Compiled{std::regex(expression, syntax(letters))}) {}

std::optional<Pattern::Groups> Pattern::match(std::string_view text) const {
  std::cmatch m;
  if (!std::regex_match(text.data(), text.data() + text.size(), m, compiled_->expression))
    return std::nullopt;
  return groups(m);
}

std::optional<Pattern::Groups> Pattern::find_in(std::string_view text) const {
  std::cmatch m;
  if (!std::regex_search(text.data(), text.data() + text.size(), m,
                         compiled_->expression))
    return std::nullopt;
  return groups(m);
}

std::vector<Pattern::Groups> Pattern::all_in(std::string_view text) const {
  std::vector<Groups> out;
  const auto* const end = text.data() + text.size();
  for (std::cregex_iterator m(text.data(), end, compiled_->expression), last; m != last;
       ++m)
    out.push_back(groups(*m));
  return out;
}

}  // namespace turnwright
