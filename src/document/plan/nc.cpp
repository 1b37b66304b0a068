#include "turnwright/document/nc.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

#include "base/say.hpp"
#include "document/json/fields.hpp"
#include "document/json/read_below.hpp"
#include "document/plan/controls.hpp"

namespace turnwright::document {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr long kTools = 99;  // two digits in the words of most controls
constexpr std::size_t kListedTools = 200;

const Choices<nc::BlockNumbers> kBlockNumbers{{"none", nc::BlockNumbers::none},
                                              {"tools", nc::BlockNumbers::tools},
                                              {"all", nc::BlockNumbers::all}};
const Choices<nc::SpindleTurn> kTurns{{"M3", nc::SpindleTurn::M3},
                                      {"M4", nc::SpindleTurn::M4}};

template <class E>
std::string choice_word(const Choices<E>& choices, E value) {
  return std::string(std::find_if(choices.begin(), choices.end(), [&](const auto& c) {
                       return c.second == value;
                     })->first);
}

std::string quoted_list(std::span<const std::string_view> words) {
  std::string all;
  for (const auto w : words) all += (all.empty() ? "\"" : ", \"") + std::string(w) + '"';
  return all;
}

void read_work_offset(Reader& r, const gcode::Dialect& d, nc::Settings& s) {
  if (!r.has("work_offset")) return;
  s.work_offset = r.text("work_offset");
  if (s.work_offset.empty()) return;  // reported
  const auto& all = d.work_offsets;
  if (std::find(all.begin(), all.end(), s.work_offset) != all.end()) return;
  r.problem_at("work_offset",
               all.empty() ? say("none: {} has no such words", std::string(d.name))
                           : say("one of {}", quoted_list(all)),
               "choice");
}

void read_program_number(Reader& r, const gcode::Dialect& d, nc::Settings& s) {
  if (!r.has("program_number")) return;
  if (d.programs > 0) {
    s.program_number = static_cast<int>(r.integer("program_number", 1, d.programs));
    return;
  }
  r.problem_at("program_number",
               say("none: programs of {} go by their file's name", std::string(d.name)),
               "choice");
}

void read_coolant(Reader& r, nc::Settings& s) {
  if (!r.has("coolant")) return;
  const auto given = r.text("coolant");
  const bool code = given.size() >= 2 && given.size() <= 5 && given[0] == 'M' &&
                    std::all_of(given.begin() + 1, given.end(),
                                [](unsigned char c) { return std::isdigit(c) != 0; });
  if (!code && !given.empty() && given != "off")
    r.problem_at("coolant", tr("\"off\" or a code like \"M8\""), "choice");
  s.coolant = code ? given : "";
}

// Each number, and each offset that is a register of its own, belongs to one tool.
void read_tools(Reader& r, const gcode::Dialect& d, nc::Settings& s) {
  std::set<std::string> ids;
  std::set<int> numbers, offsets;
  const auto once = [](Reader& item, std::string_view key, bool first) {
    if (!first) item.problem_at(key, tr("one that no other tool has"), "duplicate");
  };
  for (auto& entry : r.optional_items("tools", 0, kListedTools)) {
    auto item = entry.as_object();
    nc::ShopTool tool{.id = item.text("id"),
                      .number = static_cast<int>(item.integer("number", 1, kTools))};
    if (const auto offset = item.optional_integer("offset", 1, kTools))
      tool.offset = static_cast<int>(*offset);
    item.finish();
    if (item.broken()) continue;
    once(item, "id", ids.insert(tool.id).second);
    once(item, "number", numbers.insert(tool.number).second);
    if (d.offset == gcode::OffsetNumber::free)
      once(item, "offset", offsets.insert(tool.offset.value_or(tool.number)).second);
    if (d.offset == gcode::OffsetNumber::of_tool && tool.offset)
      item.problem_at(
          "offset",
          say("none: the offset of {} is that of the tool's number", std::string(d.name)),
          "choice");
    s.tools.push_back(std::move(tool));
  }
}

/// The members of `milling` and where their codes go.
using MillingCode = std::pair<const char*, std::string nc::MillingCodes::*>;
constexpr std::array kMillingCodes{
    MillingCode{"c_axis_on", &nc::MillingCodes::c_axis_on},
    MillingCode{"c_axis_off", &nc::MillingCodes::c_axis_off},
    MillingCode{"lock", &nc::MillingCodes::lock},
    MillingCode{"unlock", &nc::MillingCodes::unlock},
    MillingCode{"tool_on", &nc::MillingCodes::tool_on},
    MillingCode{"tool_off", &nc::MillingCodes::tool_off}};
constexpr std::size_t kLongestCode = 40;

// Capitals, digits and the signs of words; {S} stands for the speed, once.
bool is_code(std::string code, bool with_speed) {
  if (code.empty() || code.size() > kLongestCode) return false;
  if (with_speed) {
    const auto at = code.find("{S}");
    if (at == code.npos) return false;
    code.erase(at, 3);
  }
  return std::ranges::all_of(code, [](unsigned char c) {
    return std::isupper(c) != 0 || std::isdigit(c) != 0 || c == ' ' || c == '.' ||
           c == '=' || c == '$' || c == '-';
  });
}

void read_milling(Reader& r, nc::Settings& s) {
  auto group = r.optional_object("milling");
  if (!group) return;
  for (const auto& [key, member] : kMillingCodes) {
    if (!group->has(key)) continue;
    const auto code = group->text(key);
    const bool with_speed = member == &nc::MillingCodes::tool_on;
    if (!code.empty() && !is_code(code, with_speed))
      group->problem_at(key,
                        with_speed ? tr("codes like \"S{S} M13\", with {S} for the speed")
                                   : tr("codes like \"M35\""),
                        "choice");
    s.milling.*member = code;
  }
  group->finish();
}

nc::Settings read_settings(Reader& r) {
  nc::Settings s;
  s.control = r.choice_or("control", controls(), gcode::Control::linuxcnc);
  const auto& d = gcode::dialect(s.control);
  read_work_offset(r, d, s);
  read_program_number(r, d, s);
  s.block_numbers = r.choice_or("block_numbers", kBlockNumbers, s.block_numbers);
  s.spindle = r.choice_or("spindle", kTurns, s.spindle);
  read_coolant(r, s);
  s.optional_stops = r.boolean_or("optional_stops", s.optional_stops);
  s.reference_returns = r.boolean_or("reference_returns", s.reference_returns);
  s.cycles = r.boolean_or("cycles", s.cycles);
  if (s.cycles && d.thread_cycle.empty())
    r.problem_at("cycles", say("false: no cycle of {} is known", std::string(d.name)),
                 "choice");
  s.drill_cycles = r.boolean_or("drill_cycles", s.drill_cycles);
  read_milling(r, s);
  read_tools(r, d, s);
  return s;
}

ordered_json tools_of(const std::vector<toolpath::SetupProgram>& programs) {
  auto all = ordered_json::array();
  std::set<int> listed;
  for (const auto& p : programs)
    for (const auto& t : p.tools)
      if (listed.insert(t.number).second)
        all.push_back({{"id", t.id}, {"number", t.number}, {"offset", t.offset}});
  return all;
}

// As a request may give them.
ordered_json settings_json(const nc::Settings& s,
                           const std::vector<toolpath::SetupProgram>& programs) {
  const auto& d = gcode::dialect(s.control);
  ordered_json out{{"control", d.id}};
  if (d.programs > 0) out["program_number"] = s.program_number;
  if (const auto offset = nc::work_offset(s); !offset.empty())
    out["work_offset"] = offset;
  out["block_numbers"] = choice_word(kBlockNumbers, s.block_numbers);
  out["spindle"] = choice_word(kTurns, s.spindle);
  out["coolant"] = s.coolant.empty() ? "off" : s.coolant;
  out["optional_stops"] = s.optional_stops;
  out["reference_returns"] = s.reference_returns;
  out["cycles"] = s.cycles;
  out["drill_cycles"] = s.drill_cycles;
  for (const auto& [key, member] : kMillingCodes)
    if (!(s.milling.*member).empty()) out["milling"][key] = s.milling.*member;
  out["tools"] = tools_of(programs);
  if (d.offset == gcode::OffsetNumber::of_tool)
    for (auto& tool : out["tools"]) tool.erase("offset");
  return out;
}

}  // namespace

NcRequest load_nc_request(const json& request, const Catalogue& catalogue) {
  Problems problems{.document = "nc"};
  Reader r = Reader(request, problems).as_object();
  read_format(r, "turnwright-nc/1");
  const auto part = r.object("part");
  NcRequest out{.settings = read_settings(r)};
  r.finish();
  read_below(part, problems,
             [&] { out.part = prepared_candidates(part.json(), catalogue, "nc"); });
  problems.throw_if_any();
  return out;
}

nc::Settings load_nc_settings(const json& settings, const std::string& document) {
  Problems problems{.document = document};
  Reader r = Reader(settings, problems).as_object();
  auto out = read_settings(r);
  r.finish();
  problems.throw_if_any();
  return out;
}

std::string file_name(const toolpath::SetupProgram& program, gcode::Control control) {
  return "setup-" + std::to_string(program.setup + 1) +
         std::string(gcode::dialect(control).extension);
}

ordered_json to_json(const nc::Programs& programs, const planning::ProcessPlan& plan,
                     const nc::Settings& settings) {
  const bool planned = plan.status == planning::PlanStatus::ok;
  auto all = programs;
  nc::number_tools(all.setups, settings);
  ordered_json out{{"status", !planned             ? "infeasible"
                              : all.cannot.empty() ? "ok"
                                                   : "not-programmed"},
                   {"settings", settings_json(settings, all.setups)},
                   {"programs", ordered_json::array()},
                   {"cannot", all.cannot}};
  for (const auto& p : all.setups)
    out["programs"].push_back({{"setup", p.setup},
                               {"name", file_name(p, settings.control)},
                               {"minutes",
                                {{"cutting", p.minutes.cutting},
                                 {"air", p.minutes.air},
                                 {"tool_changes", p.minutes.tool_changes},
                                 {"operator_stops", p.minutes.operator_stops}}},
                               {"text", nc::text(p, settings)}});
  out["tool_table"] = nc::tool_table(all.setups);
  return out;
}

}  // namespace turnwright::document
