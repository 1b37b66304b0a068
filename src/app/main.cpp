#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <functional>
#include <iostream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/say.hpp"
#include "batch.hpp"
#include "document/json/file.hpp"
#include "document/json/parse.hpp"
#include "document/json/reader.hpp"
#include "document/json/utf8.hpp"
#include "document/response/measured_file.hpp"
#include "exit.hpp"
#include "foreign_file.hpp"
#include "help_words.hpp"
#include "import.hpp"
#include "import_tools.hpp"
#include "mcp.hpp"
#include "nc_options.hpp"
#include "options.hpp"
#include "process_card.hpp"
#include "progress_line.hpp"
#include "review.hpp"
#include "serve.hpp"
#include "service/listing.hpp"
#include "service/output.hpp"
#include "service/requests.hpp"
#include "terminal.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/document/listen.hpp"
#include "turnwright/document/nc.hpp"
#include "turnwright/document/translations.hpp"

namespace turnwright::app {
namespace {

namespace fs = std::filesystem;

/// The options and arguments of the command line.
struct Arguments {
  std::optional<fs::path> data;
  std::string file;
  std::optional<fs::path> result_file;
  std::optional<fs::path> drawings;
  std::optional<fs::path> programs;
  nlohmann::json nc = nlohmann::json::object();  ///< settings of NC programs
  std::optional<std::size_t> setup;              ///< whose program alone is wanted
  std::optional<fs::path> report_file;
  std::optional<fs::path> card;         ///< process card of a quote
  std::optional<fs::path> table, part;  ///< of measured parts, in place of a request
  std::vector<fs::path> results;        ///< QIF files of measured parts
  std::vector<fs::path> responses;      ///< files of measured responses, for `frf`
  std::optional<fs::path> sound;        ///< of a cut, for `wav`
  std::optional<double> speed_rpm;      ///< of that cut
  std::optional<int> teeth;             ///< that made it
  std::optional<fs::path> readings;     ///< of a laser, for `readings`
  std::optional<fs::path> comp_file;    ///< of LinuxCNC, for `comp_file`
  std::optional<fs::path> written_comp_file;
  bool update = false;  ///< the factors of the models by them
  bool json = false;
  std::string listed;
};

nlohmann::json read_request(const std::string& file) {
  if (file != "-") return document::parse_file(file);
  char none = 0;
  if (::read(STDIN_FILENO, &none, 0) < 0)  // a folder, or closed
    throw InputError(tr("standard input"),
                     {{"", say("nothing: it cannot be read: {}", std::strerror(errno)),
                       tr("a JSON document"), "file"}});
  return document::parse(std::cin, tr("standard input"), document::kLocalLimits);
}

// "/qif/files/0#line 12" under the name of the file.
void name_results(const std::vector<fs::path>& files, std::string& pointer) {
  constexpr std::string_view kFiles = "/qif/files/";
  if (files.empty() || !pointer.starts_with(kFiles)) return;
  const auto end = std::min(pointer.find_first_of("#/", kFiles.size()), pointer.size());
  std::size_t i = 0;
  std::from_chars(pointer.data() + kFiles.size(), pointer.data() + end, i);
  if (i < files.size()) pointer.replace(0, end, files[i].string());
}

// Problems of the request are reported under the name that the user gave it, and below
// the place `root` in the request that his document has there.
service::Drawn answer(const service::Request& row, const Arguments& arguments,
                      const nlohmann::json& request, const std::string& root,
                      const document::Catalogue& catalogue,
                      const nc::Settings& settings) {
  ProgressLine line(to_translate("{} of {} cuts, {}/s, {} left"));
  const service::Context context{catalogue,
                                 {},
                                 [&line](std::size_t done, std::size_t all) {
                                   line.tell(0, static_cast<std::int64_t>(done),
                                             static_cast<std::int64_t>(all));
                                 },
                                 settings};
  try {
    if (arguments.drawings || arguments.programs || arguments.report_file)
      return service::drawn_answer(row, request, context);
    return {service::answer(row, request, context), {}, {}};
  } catch (const InputError& e) {
    if (e.document() != row.name) throw;
    auto problems = e.problems();
    for (auto& problem : problems)
      if (problem.pointer.starts_with(root)) problem.pointer.erase(0, root.size());
    for (auto& problem : problems) name_results(arguments.results, problem.pointer);
    throw InputError(!arguments.file.empty() ? name_of_foreign_file(arguments.file)
                     : arguments.table       ? arguments.table->string()
                                             : row.name,
                     std::move(problems));
  }
}

void write_drawings(const fs::path& folder,
                    const std::vector<service::Picture>& drawings) {
  service::make_folder(folder);
  for (const auto& picture : drawings)
    service::write_file(folder / picture.file, picture.svg);
}

constexpr const char* kToolTable = "tools.tbl";

/// Whether a file of this name may have been written by write_programs() for some plan
/// and control.
bool is_of_programs(std::string_view name) {
  const auto digits = std::min(name.find_first_of("0123456789"), name.size());
  std::size_t number = 0;
  std::from_chars(name.data() + digits, name.data() + name.size(), number);
  toolpath::SetupProgram program;
  program.setup = number - 1;
  const auto is_name = [&](const gcode::Dialect& d) {
    return name == document::file_name(program, d.control);
  };
  return name == kToolTable || std::ranges::any_of(gcode::dialects(), is_name);
}

/// Writes the programs of this plan into the folder and removes those of any other plan.
void write_programs(const fs::path& folder, const nc::Programs& programs,
                    const nc::Settings& settings) {
  std::vector<service::NamedText> files;
  for (const auto& program : programs.setups)
    files.push_back(
        {document::file_name(program, settings.control), nc::text(program, settings)});
  if (!files.empty() && settings.control == gcode::Control::linuxcnc)
    files.push_back({kToolTable, nc::tool_table(programs.setups)});
  service::make_folder(folder);
  for (const auto& name : service::replace_files(folder, files, is_of_programs))
    std::cerr << say("removed {}, of an earlier plan\n",
                     visible((folder / name).string()));
  for (const auto& why : programs.cannot)
    std::cerr << say("no NC program: {}\n", visible(why));
  if (files.empty() && programs.cannot.empty())
    std::cerr << tr("no NC program: there is no feasible plan\n");
}

/// The file or folder to which an option writes.
struct Output {
  const char* option;
  fs::path path;
  bool (*makes)(
      const std::string& name);  ///< for a folder: whether it receives such a file
};

std::vector<Output> outputs(const Arguments& arguments) {
  std::vector<Output> all;
  const auto add = [&all](const char* option, const std::optional<fs::path>& path,
                          bool (*makes)(const std::string&)) {
    std::error_code error;
    // A pipe or a device may receive more than one output.
    if (!path || *path == "-" || fs::is_other(*path, error)) return;
    auto resolved = fs::weakly_canonical(fs::absolute(*path), error);
    if (!resolved.has_filename()) resolved = resolved.parent_path();  // "folder/"
    all.push_back({option, std::move(resolved), makes});
  };
  add("--output", arguments.result_file, nullptr);
  add("--report", arguments.report_file, nullptr);
  add("--xlsx", arguments.card, nullptr);
  add("--write-comp-file", arguments.written_comp_file, nullptr);
  add("--drawings", arguments.drawings,
      [](const std::string& name) { return name.ends_with(".svg"); });
  add("--nc", arguments.programs,
      [](const std::string& name) { return is_of_programs(name); });
  return all;
}

/// Whether both outputs would write the same file.  Two outputs may go into one folder.
bool collide(const Output& a, const Output& b) {
  if (b.makes && !a.makes && a.path.parent_path() == b.path)
    return b.makes(a.path.filename().string());
  return a.path == b.path && !(a.makes && b.makes);
}

/// @throws OutputError if the path cannot be a folder.
void require_folder(const fs::path& folder) {
  std::error_code error;
  for (auto at = fs::absolute(folder); !fs::is_directory(at, error);
       at = at.parent_path())
    if (fs::exists(at, error))
      throw service::OutputError(
          say("{}: cannot be written: {}", folder.string(),
              std::make_error_code(std::errc::not_a_directory).message()));
}

/// Checks the outputs before anything is computed.
/// @throws InputError if two outputs have the same place, OutputError.
void require_places(const Arguments& arguments) {
  const auto all = outputs(arguments);
  for (auto b = all.begin(); b != all.end(); ++b)
    for (auto a = all.begin(); a != b; ++a)
      if (collide(*a, *b))
        throw wrong_option(b->option, b->path.string(),
                           say("another place than that of {}", a->option), "file");
  for (const auto& folder : {arguments.drawings, arguments.programs})
    if (folder) require_folder(*folder);
}

/// Exit code of a result, and of its programs if they were requested.
Exit exit_code(const service::Drawn& drawn, bool programs) {
  if (service::infeasible(drawn.result)) return kInfeasible;
  const bool none = service::not_programmed(drawn.result) ||
                    (programs && !drawn.programs.cannot.empty());
  return none ? kRange : kOk;
}

/// Whether requests have the schema NAME.request.json: "nc", "learn" ..
bool takes(const service::Request& row, const std::string& name) {
  return service::request_schema(row) == name + ".request.json";
}

/// Whether a document is the part of a request of `nc` alone.
bool is_part(const nlohmann::json& document) {
  return document.is_object() && !document.contains("part");
}

/// Prints or writes the program of one setup, or why there is none.
void put_program(const nlohmann::ordered_json& result, const Arguments& arguments) {
  std::string setups;
  for (const auto& program : result["programs"]) {
    const auto setup = program["setup"].get<std::size_t>() + 1;
    setups += (setups.empty() ? "" : ", ") + std::to_string(setup);
    if (setup != *arguments.setup) continue;
    const auto text = program["text"].get<std::string>();
    if (arguments.result_file && *arguments.result_file != "-")
      return service::write_file(*arguments.result_file, text);
    return service::print(text);
  }
  if (!setups.empty())
    throw wrong_option("--setup", std::to_string(*arguments.setup),
                       say("a setup with a program: {}", setups), "range");
  for (const auto& why : result["cannot"])
    std::cerr << say("no NC program: {}\n", visible(why.get<std::string>()));
  if (result["cannot"].empty())
    std::cerr << tr("no NC program: there is no feasible plan\n");
}

constexpr ForeignFile kResults{to_translate("a measurement of at most so many"),
                               to_translate("a QIF 3.0 file"),
                               document::kLocalLimits.bytes};

constexpr ForeignFile kMeasured{to_translate("a table of at most so many"),
                                to_translate("a table of measured parts"),
                                document::kLocalLimits.bytes};

constexpr ForeignFile kSound{to_translate("a sound of at most so many"),
                             to_translate("a .wav file"),
                             document::kLargestSound / 4 * 3};

constexpr ForeignFile kResponse{to_translate("a measurement of at most so many"),
                                to_translate("a CSV or universal file"),
                                document::kLocalLimits.bytes};

/// Puts a file's text into the first entry of "frf" that has no data, or into a new one.
void add_response(const std::filesystem::path& file, nlohmann::json& request) {
  const auto data = document::measured_file(read_foreign_file(file.string(), kResponse));
  if (request.contains("frf") && !request["frf"].is_array()) return;  // refused later
  auto& all = request["frf"];
  if (all.is_null()) all = nlohmann::json::array();
  const auto empty = std::ranges::find_if(all, [](const nlohmann::json& r) {
    return r.is_object() && !r.contains("csv") && !r.contains("uff") &&
           (!r.contains("taps") || (r["taps"].is_object() && !r["taps"].contains("csv")));
  });
  auto& entry = empty == all.end() ? all.emplace_back(nlohmann::json::object()) : *empty;
  if (entry.contains("taps") && data.contains("csv"))
    entry["taps"]["csv"] = data["csv"];
  else
    entry.update(data);
}

constexpr ForeignFile kReadings{to_translate("a table of at most so many"),
                                to_translate("a table of readings"),
                                document::kLocalLimits.bytes};

constexpr ForeignFile kCompFile{to_translate("a table of at most so many"),
                                to_translate("a compensation file of LinuxCNC"),
                                document::kLocalLimits.bytes};

/// Puts a file's text under a key of a member of the request, which is made if it is absent.
void add_text(const std::optional<fs::path>& file, const ForeignFile& kind,
              const char* member, const char* key, nlohmann::json& request) {
  if (!file) return;
  auto text = document::readable(read_foreign_file(file->string(), kind));
  auto& group = request[member];
  if (group.is_null()) group = nlohmann::json::object();
  if (group.is_object()) group[key] = std::move(text);  // otherwise refused later
}

/// Puts the sound of a cut, its speed and teeth into the request.
void add_sound(const Arguments& arguments, nlohmann::json& request) {
  if (arguments.sound)
    request["wav"] =
        document::sound_base64(read_foreign_file(arguments.sound->string(), kSound));
  if (arguments.speed_rpm) request["n_rpm"] = *arguments.speed_rpm;
  if (arguments.teeth) request["teeth"] = *arguments.teeth;
}

nlohmann::json asked(const service::Request& row, const Arguments& arguments) {
  const bool sound = takes(row, "listen");
  if (arguments.file.empty() && !arguments.table && arguments.results.empty() &&
      !(arguments.sound && arguments.speed_rpm))
    throw wrong_option(
        "REQUEST", tr("nothing"),
        sound ? tr("a request document, or --wav with a sound and --speed")
              : tr("a request document, --csv with a table, or --qif with files"),
        "missing");
  auto request =
      arguments.file.empty() ? nlohmann::json::object() : read_request(arguments.file);
  if (!request.is_object()) return request;
  if (arguments.table)
    request["csv"] =
        document::readable(read_foreign_file(arguments.table->string(), kMeasured));
  if (!arguments.results.empty() && !request.contains("qif"))
    request["qif"] = {{"files", nlohmann::json::array()}};
  const bool lists = request.contains("qif") && request["qif"].is_object() &&
                     request["qif"].value("files", nlohmann::json()).is_array();
  for (const auto& file : arguments.results)
    if (lists)
      request["qif"]["files"].push_back(
          document::readable(read_foreign_file(file.string(), kResults)));
  if (arguments.part) request["part"] = document::parse_file(*arguments.part);
  if (arguments.update) request["update"] = true;
  for (const auto& file : arguments.responses) add_response(file, request);
  add_sound(arguments, request);
  add_text(arguments.readings, kReadings, "readings", "csv", request);
  add_text(arguments.comp_file, kCompFile, "comp_file", "text", request);
  if (arguments.written_comp_file && !request.contains("write_comp_file"))
    request["write_comp_file"] = nlohmann::json::object();
  return request;
}

Exit run_request(const service::Request& row, const Arguments& arguments) {
  require_places(arguments);
  const auto settings = nc_settings(arguments.nc);
  auto request = asked(row, arguments);
  const bool part_alone = takes(row, "nc") && is_part(request);
  if (part_alone) request = {{"part", std::move(request)}};
  if (takes(row, "nc") && request.is_object()) request.update(arguments.nc);
  const auto catalogue = document::load_catalogue(document::data_folder(arguments.data));
  const auto drawn =
      answer(row, arguments, request, part_alone ? "/part" : "", catalogue, settings);
  const auto& result = drawn.result;
  if (arguments.setup) {
    put_program(result, arguments);
    return exit_code(drawn, false);
  }
  const std::string json = result.dump(2) + '\n';
  const bool to_file = arguments.result_file && *arguments.result_file != "-";
  if (to_file) service::write_file(*arguments.result_file, json);
  if (arguments.drawings) write_drawings(*arguments.drawings, drawn.drawings);
  if (arguments.programs) write_programs(*arguments.programs, drawn.programs, settings);
  if (arguments.report_file)
    service::write_file(*arguments.report_file,
                        service::html_report(row, request, drawn));
  if (arguments.card) service::write_file(*arguments.card, process_card(result));
  if (arguments.written_comp_file)
    service::write_file(*arguments.written_comp_file,
                        result["comp_file"]["text"].get<std::string>());
  const bool json_asked = arguments.json || (arguments.result_file && !to_file);
  if (row.text && !json_asked)
    print_report(row.text(result));
  else if (json_asked || !to_file)
    service::print(json);
  return exit_code(drawn, arguments.programs.has_value());
}

std::vector<service::Entry> entries(const Arguments& arguments) {
  const auto folder = document::data_folder(arguments.data);
  if (arguments.listed == "parts") return service::list_parts(folder);
  if (arguments.listed == "schemas") return service::list_schemas(folder);
  const auto catalogue = document::load_catalogue(folder);
  if (arguments.listed == "tools") return service::list_tools(catalogue);
  if (arguments.listed == "machines") return service::list_machines(catalogue);
  if (arguments.listed == "shops") return service::list_shops(catalogue);
  return service::list_materials(catalogue);
}

constexpr std::array kLists{"materials", "tools", "machines",
                            "shops",     "parts", "schemas"};

// Without a list to print: which lists there are.
Exit run_lists() {
  for (const char* list : kLists)
    service::print(std::string("turnwright list ") + list + '\n');
  return kOk;
}

Exit run_list(const Arguments& arguments) {
  if (arguments.listed.empty()) return run_lists();
  const auto list = entries(arguments);
  std::size_t width = 0;
  for (const auto& entry : list) width = std::max(width, entry.id.size());
  std::string text;
  for (const auto& entry : list)
    text += entry.id + std::string(width + 2 - entry.id.size(), ' ') + entry.name + '\n';
  service::print(text);
  return kOk;
}

/// Adds a subcommand per row of the request table, but for `import`, `import-tools` and
/// `review`, which take files of other programs.
void add_commands(CLI::App& app, Arguments& arguments, std::function<Exit()>& chosen) {
  for (const auto& row : service::requests()) {
    if (row.name == "import" || row.name == "import-tools" || row.name == "review")
      continue;
    auto* command = app.add_subcommand(row.name, tr(row.summary));
    auto* file = command->add_option("REQUEST", arguments.file,
                                     tr("request document; - reads standard input"));
    if (takes(row, "learn")) {
      add_path(*command, "--csv", arguments.table,
               tr("table of measured parts, in place of the request's rows"));
      add_paths(*command, "--qif", arguments.results,
                tr("measured results (QIF 3.0), in place of the request's rows"))
          ->allow_extra_args();
      add_path(*command, "--part", arguments.part,
               tr("part document, whose tolerances are the characteristics"));
      command->add_flag("--update", arguments.update,
                        tr("also update the factors of the models, and write documents"));
    } else if (!takes(row, "listen")) {
      file->required();
    }
    if (takes(row, "stability"))
      add_paths(
          *command, "--frf", arguments.responses,
          tr("measured response (CSV, universal file) of the next entry of frf; taps "
             "where that has the key taps"));
    if (takes(row, "listen")) {
      add_path(*command, "--wav", arguments.sound,
               tr("sound of the cut, as wav of the request"));
      add_number<double>(*command, "--speed", arguments.speed_rpm, Range<double>{1, 1e6},
                         tr("spindle speed in 1/min, in place of the request's n_rpm"));
      add_number<int>(*command, "--teeth", arguments.teeth, Range<int>{1, 100},
                      tr("teeth of the cutter, in place of the request's; 1 in turning"));
    }
    if (takes(row, "positioning")) {
      add_path(*command, "--csv", arguments.readings,
               tr("table of a laser's readings, as csv of the request's readings"));
      add_path(*command, "--comp-file", arguments.comp_file,
               tr("compensation file of LinuxCNC, as text of the request's comp_file"));
      add_path(*command, "--write-comp-file", arguments.written_comp_file,
               tr("write the compensation file for LinuxCNC here"));
    }
    add_path(*command, "-o,--output", arguments.result_file,
             tr("write the result (JSON) here; - is standard output"),
             Dash::is_standard_output);
    command->add_flag("--json", arguments.json, tr("print the result as JSON"));
    if (row.drawn)
      add_path(*command, "--drawings", arguments.drawings,
               tr("write the result's pictures (SVG) to this folder"));
    if (row.drawn && service::request_schema(row) == "part.json") {
      auto* folder = add_path(*command, "--nc", arguments.programs,
                              tr("write NC programs to this folder: setup-1.ngc, .."));
      for (auto* option : add_nc_options(*command, arguments.nc)) option->needs(folder);
    }
    if (takes(row, "nc")) {
      add_nc_options(*command, arguments.nc);
      add_number<std::size_t>(
          *command, "--setup", arguments.setup, Range<std::size_t>{1, 100},
          tr("print, or write to --output, the program of this setup"));
    }
    if (takes(row, "quote"))
      add_path(*command, "--xlsx", arguments.card,
               tr("write a process card (Excel: prices, routing, ways) here"));
    if (row.html)
      add_path(*command, "--report", arguments.report_file,
               tr("write the report (HTML, printable) here"));
    const std::string of_files =
        takes(row, "learn")
            ? "\n  turnwright learn --csv docs/examples/learn/pin.csv --part "
              "docs/examples/guide/pin.json"
            : "";
    command->footer(tr("Example:") + "\n  echo '" + row.example + "' | turnwright " +
                    row.name + " -" + of_files);
    command->callback([&row, &arguments, &chosen] {
      chosen = [&row, &arguments] { return run_request(row, arguments); };
    });
  }
}

/// Adds `list` and `schema`.
void add_lists(CLI::App& app, Arguments& arguments, std::function<Exit()>& chosen) {
  auto* list =
      app.add_subcommand("list", tr("ids and names of what a request may refer to"));
  list->add_option(
          "WHAT", arguments.listed,
          tr("materials, tools, machines, shops, parts or schemas; without it, these"))
      ->check(CLI::IsMember(std::vector<std::string>(kLists.begin(), kLists.end())));
  list->footer(tr("Example:") + "\n  turnwright list materials");
  list->callback(
      [&arguments, &chosen] { chosen = [&arguments] { return run_list(arguments); }; });
  auto* schema = app.add_subcommand("schema", tr("prints the JSON schema of a document"));
  schema->add_option("NAME", arguments.listed,
                     tr("a name that `list schemas` shows; without it, these"));
  schema->footer(tr("Example:") + "\n  turnwright schema part");
  schema->callback([&arguments, &chosen] {
    chosen = [&arguments] {
      if (arguments.listed.empty()) {
        arguments.listed = "schemas";
        return run_list(arguments);
      }
      service::print(
          service::schema(document::data_folder(arguments.data), arguments.listed));
      return kOk;
    };
  });
}

// A first part document, which an editor completes by its schema.
Exit run_new(const Arguments& arguments) {
  const auto schema = document::data_folder(arguments.data) / "schemas" / "part.json";
  nlohmann::ordered_json part{{"$schema", schema.string()}};
  part.update(nlohmann::ordered_json::parse(service::find_request("plan")->example));
  const auto text = part.dump(2) + '\n';
  if (!arguments.result_file || *arguments.result_file == "-") {
    service::print(text);
    return kOk;
  }
  if (fs::exists(*arguments.result_file))
    throw wrong_option("--output", arguments.result_file->string(),
                       tr("a file that is not there yet"), "exists");
  service::write_file(*arguments.result_file, text);
  return kOk;
}

void add_new(CLI::App& app, Arguments& arguments, std::function<Exit()>& chosen) {
  auto* command =
      app.add_subcommand("new", tr("a first part document to change and plan"));
  add_path(*command, "-o,--output", arguments.result_file,
           tr("write it here; - is standard output"), Dash::is_standard_output);
  command->footer(tr("Example:") + "\n  turnwright new | turnwright plan -");
  command->callback(
      [&arguments, &chosen] { chosen = [&arguments] { return run_new(arguments); }; });
}

/// Reports an unknown command.
/// @throws InputError if there is one.
void refuse_unknown(const CLI::App& app) {
  for (const auto& word : app.remaining()) {
    if (word.starts_with('-')) continue;
    std::vector<std::string> commands;
    for (const auto* command : app.get_subcommands([](const CLI::App*) { return true; }))
      commands.push_back(command->get_name());
    const auto near = document::nearest(word, commands);
    throw wrong_option("COMMAND", '"' + word + '"',
                       near.empty() ? tr("a command; turnwright --help names all")
                                    : say("a command (did you mean \"{}\"?)", near),
                       "choice");
  }
}

/// The value of an option that counts before the others are read; `otherwise` without it.
std::string early_option(int argc, char** argv, const std::string& option,
                         std::string otherwise) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == option && i + 1 < argc) return argv[i + 1];
    if (word.starts_with(option + '='))
      return std::string(word.substr(option.size() + 1));
  }
  return otherwise;
}

/// Makes help, messages and reports speak the language of --language or TURNWRIGHT_LANGUAGE.
void speak_as_asked(int argc, char** argv) {
  const char* variable = std::getenv("TURNWRIGHT_LANGUAGE");
  const auto language =
      early_option(argc, argv, "--language", variable && *variable ? variable : "en");
  if (language == "en") return;
  const auto data = early_option(argc, argv, "--data", "");
  speak(language, document::translations(
                      document::data_folder(data.empty() ? std::nullopt
                                                         : std::optional<fs::path>(data)),
                      language));
}

int run(int argc, char** argv) {
  speak_as_asked(argc, argv);
  CLI::App app(
      tr("Plans turned parts: certified cheapest conditions inside every tolerance."),
      "turnwright");
  app.set_version_flag("--version", std::string(service::version()));
  app.require_subcommand(1);
  Arguments arguments;
  app.fallthrough();
  add_path(app, "--data", arguments.data,
           tr("folder with materials/, tools/ and machines/"));
  std::string language;  // heard by speak_as_asked()
  app.add_option("--language", language, tr("of help, messages and reports: en or de"))
      ->default_str("en");
  std::string examples = tr("Examples:") +
                         "\n  turnwright new\n  turnwright list parts\n"
                         "  turnwright schema part\n"
                         "  turnwright batch --help\n  turnwright serve --help\n"
                         "  turnwright mcp --help\n";
  for (const auto& row : service::requests())
    examples += "  turnwright " + row.name + " --help\n";
  app.footer(
      tr("Exit codes: 0 done, 1 no feasible plan, 2 wrong input, 3 outside a model's "
         "range,\n"
         "or no NC program can be made, 70 internal error, 74 result not written.") +
      '\n' + examples);
  std::function<Exit()> chosen;
  add_commands(app, arguments, chosen);
  add_lists(app, arguments, chosen);
  add_new(app, arguments, chosen);
  const auto choose = [&chosen](std::function<void()> work) {
    chosen = [work = std::move(work)] {
      work();
      return kOk;
    };
  };
  add_import(app, arguments.data, choose);
  add_import_tools(app, choose);
  add_review(app, arguments.data, choose);
  add_batch(app, arguments.data, choose);
  add_serve(app, arguments.data, choose);
  add_mcp(app, arguments.data, choose);
  speak_in_help(app);
  if (argc == 1) {
    service::print(app.help());
    return kOk;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (app.get_subcommands().empty()) refuse_unknown(app);
    std::ostringstream help;
    if (app.exit(e, help, std::cerr) != 0) return kInput;
    service::print(help.str());
    return kOk;
  }
  return chosen();
}

}  // namespace
}  // namespace turnwright::app

int main(int argc, char** argv) {
  using namespace turnwright;
  std::signal(SIGXFSZ, SIG_IGN);  // a file at its size limit is then a write error
  try {
    return app::run(argc, argv);
  } catch (const InputError& e) {
    std::cerr << e.what() << '\n';
    return app::kInput;
  } catch (const ModelRangeError& e) {
    std::cerr << visible(e.what()) << '\n';
    return app::kRange;
  } catch (const service::OutputError& e) {
    std::cerr << visible(e.what()) << '\n';
    return app::kOutput;
  } catch (const std::exception& e) {
    std::cerr << say("internal error: {}\n", visible(e.what()));
    return app::kInternal;
  }
}
