#include "review.hpp"

#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "document/json/file.hpp"
#include "document/json/parse.hpp"
#include "foreign_file.hpp"
#include "options.hpp"
#include "service/output.hpp"
#include "service/requests.hpp"
#include "terminal.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct ReviewArguments {
  std::vector<std::string> files;
  std::optional<fs::path> part, output, corrected;
  std::size_t setup = 1;
  double zero_mm = 0;
  std::string control = "linuxcnc";
  std::vector<std::string> tools;  ///< "1=PCLNL-CNMG120408-PM"
  bool json = false;
};

constexpr ForeignFile kProgram{to_translate("a program of at most so many"),
                               to_translate("a NC program"), 2'000'000};

// "2=DRILL-HM-5D 19 mm".
json numbered_tool(const std::string& text) {
  const auto equals = text.find('=');
  const auto number =
      number_in(text.substr(0, std::min(equals, text.size())), Range<int>{0, 9999});
  if (equals == text.npos || !number || equals + 1 == text.size())
    throw wrong_option("--tool", '"' + text + '"', tr("a number, = and an id"), "format");
  return {{"number", *number}, {"id", text.substr(equals + 1)}};
}

json request_of(const ReviewArguments& arguments) {
  if (!arguments.part) {
    if (arguments.files.size() > 1)
      throw wrong_option("--part", tr("nothing"), tr("the part document of the programs"),
                         "missing");
    return document::parse(read_foreign_file(arguments.files[0], kProgram),
                           name_of_foreign_file(arguments.files[0]),
                           document::kLocalLimits);
  }
  json request{{"part", document::parse_file(*arguments.part)},
               {"control", arguments.control},
               {"programs", json::array()}};
  for (std::size_t i = 0; i < arguments.files.size(); ++i)
    request["programs"].push_back(
        {{"setup", arguments.setup - 1 + i},
         {"text", read_foreign_file(arguments.files[i], kProgram)},
         {"zero_mm", arguments.zero_mm}});
  for (const auto& tool : arguments.tools)
    request["tools"].push_back(numbered_tool(tool));
  return request;
}

// Problems of tools that options gave are told under their name.
nlohmann::ordered_json answered(const service::Request& row, const json& request,
                                const document::Catalogue& catalogue,
                                const ReviewArguments& arguments) {
  try {
    return service::answer(row, request, {catalogue});
  } catch (const InputError& e) {
    if (!arguments.part) throw;
    auto problems = e.problems();
    for (auto& p : problems)
      if (p.pointer.starts_with("/tools/")) p.pointer = "--tool";
    throw InputError(tr("command line"), std::move(problems));
  }
}

// The corrected programs under the names of those given, in a folder of their own.
void write_corrected(const ReviewArguments& arguments,
                     const nlohmann::ordered_json& result) {
  if (!result.contains("corrected")) return;
  service::make_folder(*arguments.corrected);
  const auto& programs = result["corrected"]["programs"];
  for (std::size_t i = 0; i < programs.size(); ++i) {
    const auto setup = programs[i]["setup"].get<std::size_t>() + 1;
    fs::path name = "setup-" + std::to_string(setup) + ".nc";
    if (arguments.part && arguments.files[i] != "-")
      name = fs::path(arguments.files[i]).filename();
    service::write_file(*arguments.corrected / name,
                        programs[i]["text"].get<std::string>());
  }
}

// No program is written over one that was given, nor over another of this call.
void refuse_to_overwrite(const ReviewArguments& arguments) {
  std::set<fs::path> names;
  for (const auto& file : arguments.files) {
    std::error_code none;
    const auto name = fs::path(file).filename();
    const bool own =
        file != "-" && fs::equivalent(*arguments.corrected / name, file, none);
    if (own || !names.insert(name).second)
      throw wrong_option(
          "--corrected", '"' + arguments.corrected->string() + '"',
          tr("a folder other than that of the programs, which have names of "
             "their own"),
          "exists");
  }
}

void run(const ReviewArguments& arguments, const std::optional<fs::path>& data) {
  auto request = request_of(arguments);
  if (arguments.corrected) {
    refuse_to_overwrite(arguments);
    request["correct"] = true;
  }
  const auto catalogue = document::load_catalogue(document::data_folder(data));
  const auto& row = *service::find_request("review");
  const auto result = answered(row, request, catalogue, arguments);
  if (arguments.corrected) write_corrected(arguments, result);
  const auto text = result.dump(2) + '\n';
  const bool to_file = arguments.output && *arguments.output != "-";
  if (to_file) service::write_file(*arguments.output, text);
  const bool json_asked = arguments.json || (arguments.output && !to_file);
  if (json_asked)
    service::print(text);
  else
    print_report(row.text(result));
}

}  // namespace

void add_review(CLI::App& app, const std::optional<fs::path>& data,
                const std::function<void(std::function<void()>)>& chosen) {
  const auto& row = *service::find_request("review");
  auto* command = app.add_subcommand("review", tr(row.summary));
  auto arguments = std::make_shared<ReviewArguments>();
  command
      ->add_option("PROGRAM", arguments->files,
                   tr("NC programs of the part's setups in their order; without --part a "
                      "request document, - reads standard input"))
      ->required();
  add_path(*command, "--part", arguments->part, tr("part document of the programs"));
  command
      ->add_option(
          "--control", arguments->control,
          tr("control that the programs are for: linuxcnc, fanuc, fanuc-b, haas, "
             "siemens-iso, siemens, okuma"))
      ->type_name("NAME");
  add_number(*command, "--setup", arguments->setup, Range<std::size_t>{1, 10},
             tr("setup of the first program"));
  add_number(
      *command, "--zero", arguments->zero_mm, Range<double>{-1e4, 1e4},
      tr("place of the programs' zero, from the finished face of the free end [mm]"));
  command
      ->add_option(
          "--tool", arguments->tools,
          tr("a tool's number and id, 1=PCLNL-CNMG120408-PM; of drills and blades "
             "with their size, \"2=DRILL-HM-5D 19 mm\"; once for each tool"))
      ->allow_extra_args(false)
      ->type_name("N=ID");
  add_path(
      *command, "--corrected", arguments->corrected,
      tr("write the programs with words F and S changed to the least cost of their own "
         "passes to this folder"));
  add_path(*command, "-o,--output", arguments->output,
           tr("write the result (JSON) here; - is standard output"),
           Dash::is_standard_output);
  command->add_flag("--json", arguments->json, tr("print the result as JSON"));
  // Unlike echo, printf leaves the line ends of the program as they are written.
  command->footer(tr("Examples:") + "\n  printf '%s' '" + row.example +
                  "' | turnwright review -\n  turnwright nc parts/pump-shaft.json "
                  "--setup 1 | turnwright review - --part parts/pump-shaft.json");
  command->callback([arguments, &data, chosen] {
    chosen([arguments, &data] { run(*arguments, data); });
  });
}

}  // namespace turnwright::app
