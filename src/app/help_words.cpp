#include "help_words.hpp"

#include <fmt/args.h>
#include <fmt/format.h>

#include <regex>

#include "turnwright/base/language.hpp"

namespace turnwright::app {
namespace {

constexpr const char* kLabels[] = {
    to_translate("Usage"),    to_translate("OPTIONS"), to_translate("SUBCOMMAND"),
    to_translate("REQUIRED"), to_translate("Needs"),   to_translate("Excludes"),
    to_translate("TEXT"),     to_translate("INT"),     to_translate("NUMBER"),
    to_translate("WORD"),     to_translate("NAME"),    to_translate("Positionals")};

/// CLI11's sentences, and what to say in their place.
struct Sentence {
  const char* pattern;
  const char* english;
};
constexpr Sentence kSentences[] = {
    {"A subcommand is required", to_translate("A subcommand is required")},
    {"(.+) is required", to_translate("{} is required")},
    {"The following argument was not expected: (.+)",
     to_translate("The following argument was not expected: {}")},
    {"The following arguments were not expected: (.+)",
     to_translate("The following arguments were not expected: {}")},
    {"(.+) requires (.+)", to_translate("{} requires {}")},
    {"(.+) excludes (.+)", to_translate("{} excludes {}")},
    {"(.+): (.+) not in (.+)", to_translate("{}: {} not in {}")},
    {"(.+): ([0-9]+) required (.+) missing", to_translate("{}: {} required {} missing")},
    {"(.+): At Most ([0-9]+) required but received ([0-9]+)",
     to_translate("{}: at most {}, but given {} times")}};

std::string spoken_error(const std::string& said) {
  for (const auto& sentence : kSentences) {
    std::smatch match;
    if (!std::regex_match(said, match, std::regex(sentence.pattern))) continue;
    fmt::dynamic_format_arg_store<fmt::format_context> values;
    for (std::size_t i = 1; i < match.size(); ++i) values.push_back(match[i].str());
    return fmt::vformat(translated(sentence.english), values);
  }
  return said;
}

std::string failure(const CLI::App*, const CLI::Error& error) {
  return spoken_error(error.what()) + '\n' + tr("Run with --help for more information.") +
         '\n';
}

void group_options(CLI::App& app) {
  for (auto* option : app.get_options()) option->group(tr("Options"));
  app.get_option("--help")->description(tr("Print this help message and exit"));
}

}  // namespace

void speak_in_help(CLI::App& app) {
  for (const char* label : kLabels) app.get_formatter()->label(label, tr(label));
  app.failure_message(failure);
  group_options(app);
  app.get_version_ptr()->description(tr("Display program version information and exit"));
  for (auto* command : app.get_subcommands({})) {
    command->group(tr("Subcommands"));
    group_options(*command);
  }
}

}  // namespace turnwright::app
