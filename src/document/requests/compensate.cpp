#include "turnwright/document/compensate.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/say.hpp"
#include "document/catalogue/machine_fields.hpp"
#include "document/json/fields.hpp"
#include "turnwright/volumetric/compensation.hpp"

namespace turnwright::document {
namespace {

using namespace volumetric;
using nlohmann::json;

constexpr std::size_t kLines = 2'000'000, kLineBytes = 1000;
constexpr std::size_t kMoves = 500'000;  // 500 MB with the corrected program
const Bounds kPlace = within(-1e5, 1e5, "mm"), kTolerance = within(1e-6, 1, "mm");

struct CompensationRequest {
  Machine machine;
  NcSetup setup;
  CompensationOptions options;
  std::vector<std::string> lines;
};

std::vector<std::string> lines_of(const Reader& r) {
  std::vector<std::string> out;
  if (r.is_array()) {
    for (const Reader& line : r.as_items(1, kLines)) {
      if (line.is_text())
        out.push_back(line.json());
      else
        line.problem(tr("a line of the program"), "type");
    }
    return out;
  }
  if (!r.is_text()) {
    r.problem(tr("the text of a program, or the list of its lines"), "type");
    return out;
  }
  const std::string text = r.as_text(kLines * kLineBytes);
  for (std::size_t at = 0; at < text.size();) {
    const auto end = std::min(text.find('\n', at), text.size());
    out.push_back(text.substr(at, end - at));
    if (out.back().ends_with('\r')) out.back().pop_back();
    at = end + 1;
  }
  return out;
}

std::vector<std::string> read_program(const Reader& r) {
  if (r.broken()) return {};
  auto out = lines_of(r);
  if (out.size() > kLines)
    r.problem(say("{} lines", out.size()), say("at most {} lines", kLines), "count");
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto fault = [&](const std::string& got, const std::string& expected) {
      const auto at = r.is_array() ? r.pointer() + "/" + std::to_string(i)
                                   : r.pointer() + "#line " + std::to_string(i + 1);
      r.problems().add({at, got, expected, "range"});
    };
    if (out[i].size() > kLineBytes)
      fault(say("{} bytes", out[i].size()), tr("a line of at most 1000 bytes"));
    if (out[i].find('\n') != std::string::npos)
      fault(tr("a line feed within the line"), tr("one line of the program"));
  }
  return out;
}

void read_offsets(Reader& r, NcSetup& s) {
  if (auto work = r.optional_object("work_offsets_mm")) {
    for (const char* name : {"G54", "G55", "G56", "G57", "G58", "G59"})
      if (work->has(name)) s.work_offsets_mm[name] = read_vec3(*work, name, kPlace);
    work->finish();
  }
  if (auto tools = r.optional_object("tool_offsets_mm")) {
    for (int number = 1; number < 100; ++number) {
      const std::string key = std::to_string(number);
      if (tools->has(key)) s.tool_offsets_mm[number] = read_vec3(*tools, key, kPlace);
    }
    tools->finish();
  }
}

CompensationOptions read_options(Reader& r) {
  CompensationOptions o;
  o.method = r.choice_or<Method>("method",
                                 {{"full-field", Method::full_field},
                                  {"affine", Method::affine},
                                  {"average", Method::average}},
                                 Method::full_field);
  o.at_rest = r.choice_or<AtRest>(
      "at_rest", {{"last", AtRest::last}, {"none", AtRest::none}}, AtRest::last);
  o.passes = static_cast<int>(r.integer_or("passes", 1, 10, o.passes));
  o.decimals = static_cast<int>(r.integer_or("decimals", 3, 9, o.decimals));
  return o;
}

CompensationRequest read_compensation_request(const json& document) {
  Problems problems{.document = "compensate"};
  Reader r = Reader(document, problems).as_object();
  CompensationRequest q;
  read_format(r, "turnwright-compensate/1");
  q.machine = read_chain(r);
  if (r.has("tool_point_mm"))
    q.machine.tool_point_mm = read_vec3(r, "tool_point_mm", kPlace);
  const std::string& chain = q.machine.chain;
  q.setup.axes.clear();
  for (const char axis : {'X', 'Y', 'Z'})
    if (chain.find(axis) != std::string::npos) q.setup.axes += axis;
  q.setup.moves_max = kMoves;
  q.setup.lathe = r.boolean_or("lathe", q.setup.axes == "XZ");
  q.setup.diameter = r.boolean_or("diameter", false);
  q.setup.tolerance_mm = r.number_or("tolerance_mm", kTolerance, 1e-3);
  if (r.has("start_mm")) q.setup.start_mm = read_vec3(r, "start_mm", kPlace);
  read_offsets(r, q.setup);
  q.options = read_options(r);
  q.options.tolerance_mm = q.setup.tolerance_mm;
  q.lines = read_program(r.at("program", tr("the text of a program, or its lines")));
  r.finish();
  if (q.lines.empty() && problems.list.empty())
    r.problem_at("program", tr("at least one line"), "range");
  problems.throw_if_any();
  return q;
}

json assumed(const json& request, const NcSetup& setup, const NcProgram& program) {
  json out = json::array();
  const auto assume = [&out](const std::string& pointer, json value,
                             const std::string& why) {
    out.push_back({{"pointer", pointer}, {"value", std::move(value)}, {"why", why}});
  };
  if (!request.contains("start_mm"))
    assume("/start_mm", {0, 0, 0}, tr("where the tip stands before the first move"));
  if (setup.lathe && !request.contains("diameter"))
    assume("/diameter", false, tr("X words are radii until G7"));
  if (program.rapid_assumed > 0)
    assume("/program#line " + std::to_string(program.rapid_assumed), "G0",
           tr("coordinates before any of G0 to G3"));
  return out;
}

json deviation_json(const Deviation& d) {
  return {{"max_mm", d.max_mm}, {"rms_mm", d.rms_mm}};
}

}  // namespace

json compensate(const json& request) { return compensated(request).result; }

CompensateAnswer compensated(const json& request) {
  const CompensationRequest q = read_compensation_request(request);
  const std::vector<std::string_view> lines(q.lines.begin(), q.lines.end());
  const NcProgram program = gcode::read_nc(lines, q.setup);
  Problems problems{.document = "compensate"};
  for (const gcode::NcProblem& p : program.problems)
    problems.add(
        {"/program#line " + std::to_string(p.line), p.got, p.expected, "unsupported"});
  problems.throw_if_any();
  Compensated c = volumetric::compensate(program, q.machine, q.setup, q.options);
  json result = {
      {"program", c.lines},
      {"residual",
       {{"before", deviation_json(c.before)}, {"after", deviation_json(c.after)}}},
      {"points", c.points},
      {"added_moves", c.added},
      {"largest_correction_mm", c.largest_correction_mm},
      {"assumed", assumed(request, q.setup, program)}};
  return {std::move(result), std::move(c)};
}

}  // namespace turnwright::document
