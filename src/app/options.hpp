#pragma once
#include <CLI/CLI.hpp>
#include <charconv>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

#include "base/say.hpp"
#include "turnwright/base/errors.hpp"

/// Values of options: one rule for every number, and one for every file and folder.
namespace turnwright::app {

/// A number as messages and the help have it.
template <class Number>
std::string written(Number number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

/// An error in which the command line is the document and the option the place in it.
inline InputError wrong_option(const std::string& option, const std::string& got,
                               const std::string& expected, const std::string& code) {
  return {tr("command line"), {{option, got, expected, code}}};
}

template <class Number>
struct Range {
  Number least, most;
};

/// The decimal number that the whole of `text` represents; none if it is not a number or
/// outside the range.  NaN is outside every range.
template <class Number>
std::optional<Number> number_in(std::string_view text, const Range<Number>& range) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data(), end, value);
  const bool good =
      error == std::errc() && read == end && value >= range.least && value <= range.most;
  return good ? std::optional(value) : std::nullopt;
}

/// Adds an option "--name" with a number, which is stored in `value`.
template <class Number, class Value>
CLI::Option* add_number(CLI::App& app, const std::string& option, Value& value,
                        const Range<Number>& range, const std::string& help) {
  const auto put = [&value, option, range](const std::string& text) {
    const auto number = number_in(text, range);
    if (!number) {
      const auto least = written(range.least), most = written(range.most);
      throw wrong_option(option, '"' + text + '"',
                         std::is_integral_v<Number>
                             ? say("an integer from {} to {}", least, most)
                             : say("a number from {} to {}", least, most),
                         "range");
    }
    value = *number;
  };
  return app.add_option_function<std::string>(option, put, help)
      ->type_name(std::is_integral_v<Number> ? "INT" : "NUMBER");
}

/// The same, with the present content of `value` as the default that the help shows.
template <class Number>
CLI::Option* add_number(CLI::App& app, const std::string& option, Number& value,
                        const Range<Number>& range, const std::string& help) {
  return add_number<Number, Number>(app, option, value, range, help)
      ->default_str(written(value));
}

enum class Dash { is_no_name, is_standard_output };

/// The path of an option; errors name the last of its names.
inline std::filesystem::path path_of(const std::string& names, const std::string& text,
                                     Dash dash) {
  if (text.empty() || (text == "-" && dash == Dash::is_no_name))
    throw wrong_option(names.substr(names.rfind(',') + 1), '"' + text + '"',
                       tr("a name in the file system (./- for one that is called -)"),
                       "file");
  return text;
}

/// Adds an option with a file or folder.
/// @param names  for example "-o,--output"
template <class Path>
CLI::Option* add_path(CLI::App& app, const std::string& names, Path& path,
                      const std::string& help, Dash dash = Dash::is_no_name) {
  return app.add_option_function<std::string>(
      names,
      [&path, names, dash](const std::string& text) {
        path = path_of(names, text, dash);
      },
      help);
}
/// The same, any number of times.
inline CLI::Option* add_paths(CLI::App& app, const std::string& names,
                              std::vector<std::filesystem::path>& paths,
                              const std::string& help) {
  return app
      .add_option_function<std::vector<std::string>>(
          names,
          [&paths, names](const std::vector<std::string>& texts) {
            for (const auto& text : texts)
              paths.push_back(path_of(names, text, Dash::is_no_name));
          },
          help)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace turnwright::app
