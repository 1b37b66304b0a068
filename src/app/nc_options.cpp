#include "nc_options.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "base/say.hpp"
#include "options.hpp"
#include "turnwright/document/nc.hpp"

namespace turnwright::app {
namespace {

using nlohmann::json;

constexpr Range<int> kNumbers{1, 99999};

std::string option_of(std::string key) {
  std::replace(key.begin(), key.end(), '_', '-');
  return "--" + key;
}

// "PCLNL-CNMG120408-PM=3" or "..=3:13", with the offset.
json shop_tool(const std::string& text) {
  const auto equals = text.rfind('=');
  const auto numbers = equals == text.npos ? "" : text.substr(equals + 1);
  const auto colon = numbers.find(':');
  const auto number = number_in(numbers.substr(0, colon), kNumbers);
  json tool{{"id", text.substr(0, equals)}, {"number", number.value_or(0)}};
  bool good = equals != text.npos && equals > 0 && number;
  if (colon != numbers.npos) {
    const auto offset = number_in(numbers.substr(colon + 1), kNumbers);
    tool["offset"] = offset.value_or(0);
    good = good && offset;
  }
  if (!good)
    throw wrong_option("--tool", '"' + text + '"', tr("ID=NUMBER or ID=NUMBER:OFFSET"),
                       "text");
  return tool;
}

std::string control_ids() {
  std::string all;
  for (const auto& d : gcode::dialects())
    all += (all.empty() ? "" : ", ") + std::string(d.id);
  return all;
}

// "tool_on=M133 P{S}": a code for milling by its name.
void add_milling_code(json& settings, const std::string& text) {
  const auto equals = text.find('=');
  if (equals == text.npos || equals == 0)
    throw wrong_option("--milling", '"' + text + '"', tr("NAME=CODE"), "text");
  settings["milling"][text.substr(0, equals)] = text.substr(equals + 1);
}

}  // namespace

std::vector<CLI::Option*> add_nc_options(CLI::App& command, json& settings) {
  std::vector<CLI::Option*> all;
  const auto text = [&](const std::string& key, const std::string& help) {
    auto* option = command.add_option_function<std::string>(
        option_of(key),
        [&settings, key](const std::string& word) { settings[key] = word; }, help);
    all.push_back(option->type_name("WORD"));
  };
  const auto flag = [&](const std::string& key, const std::string& help) {
    all.push_back(command.add_flag_callback(
        option_of(key), [&settings, key] { settings[key] = true; }, help));
  };
  text("control", say("the programs' control: {}", control_ids()));
  all.push_back(command
                    .add_option_function<std::string>(
                        "--program-number",
                        [&settings](const std::string& word) {
                          const auto number = number_in(word, kNumbers);
                          if (!number)
                            throw wrong_option("--program-number", '"' + word + '"',
                                               tr("an integer from 1 to 99999"), "range");
                          settings["program_number"] = *number;
                        },
                        tr("number of the first setup's program; the others count on"))
                    ->type_name("N"));
  text("work_offset", tr("work offset, G54 unless given"));
  text("block_numbers", tr("which blocks have numbers: none, tools, all"));
  text("spindle", tr("M3 or M4: the spindle's sense while turning"));
  text("coolant", tr("the code that turns the coolant on, or off"));
  flag("optional_stops", tr("M1 before each change of the tool"));
  flag("reference_returns",
       tr("to the reference position at both ends and before each change of the tool"));
  flag("cycles", tr("threads by the control's own cycle"));
  flag("drill_cycles", tr("holes by the control's own cycles"));
  all.push_back(command
                    .add_option_function<std::vector<std::string>>(
                        "--tool",
                        [&settings](const std::vector<std::string>& tools) {
                          for (const auto& tool : tools)
                            settings["tools"].push_back(shop_tool(tool));
                        },
                        tr("the shop's number of a tool, ID=NUMBER or ID=NUMBER:OFFSET"))
                    ->type_name("WORD"));
  all.push_back(command
                    .add_option_function<std::vector<std::string>>(
                        "--milling",
                        [&settings](const std::vector<std::string>& codes) {
                          for (const auto& code : codes) add_milling_code(settings, code);
                        },
                        tr("a code of the axis C or the driven tools, c_axis_on=CODE, "
                           "c_axis_off, lock, unlock, tool_on (with {S}), tool_off"))
                    ->type_name("WORD"));
  return all;
}

nc::Settings nc_settings(const json& settings) {
  try {
    return document::load_nc_settings(settings, tr("command line"));
  } catch (const InputError& e) {
    auto problems = e.problems();
    for (auto& problem : problems) {
      const auto key = problem.pointer.substr(1, problem.pointer.find('/', 1) - 1);
      problem.pointer = key == "tools" ? "--tool" : option_of(key);
    }
    throw InputError(e.document(), std::move(problems));
  }
}

}  // namespace turnwright::app
