#include "import_tools.hpp"

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "base/say.hpp"
#include "document/json/parse.hpp"
#include "document/tool_library/zip_archive.hpp"
#include "foreign_file.hpp"
#include "options.hpp"
#include "service/output.hpp"
#include "service/requests.hpp"
#include "turnwright/document/import.hpp"
#include "turnwright/document/import_tools.hpp"

namespace turnwright::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct ImportToolsArguments {
  std::vector<std::string> files;
  std::optional<fs::path> output, folder;
  bool force = false, json = false;
  nlohmann::json members =
      nlohmann::json::object();  ///< of the request, beside the library
};

constexpr ForeignFile kLibrary{to_translate("a tool library of at most so many"),
                               to_translate("a .tools, .json, .csv, .xml or .fctb file"),
                               document::kLargestLibrary};

// A request of the capability, as other commands take one, begins with one of its members;
// a library in JSON with others.
bool is_request(const std::string& bytes) {
  const auto brace = bytes.find_first_not_of(" \t\r\n");
  if (brace == bytes.npos || bytes[brace] != '{') return false;
  const auto quote = bytes.find('"', brace);
  if (quote == bytes.npos) return false;
  const auto key = std::string_view(bytes).substr(quote + 1);
  constexpr std::array kMembers{"text\"", "base64\"", "format\"",
                                "unit\"", "groups\"", "$schema\""};
  return std::ranges::any_of(kMembers,
                             [&](const char* member) { return key.starts_with(member); });
}

// Several files, as FreeCAD has a library and its bits, are an archive of them.
std::string archive_of(const std::vector<std::string>& files) {
  std::vector<document::ZipEntry> entries;
  for (const auto& file : files)
    entries.push_back({file, read_foreign_file(file, kLibrary)});
  return document::zipped(entries);
}

// The file under whose name problems are told.
const std::string& told_of(const ImportToolsArguments& arguments) {
  return arguments.files.front();
}

nlohmann::json library_request(const ImportToolsArguments& arguments) {
  auto bytes = arguments.files.size() == 1
                   ? read_foreign_file(arguments.files.front(), kLibrary)
                   : archive_of(arguments.files);
  auto request = is_request(bytes)
                     ? document::parse(bytes, name_of_foreign_file(told_of(arguments)),
                                       document::kLocalLimits)
                     : document::import_request(std::move(bytes));
  request.update(arguments.members);
  return request;
}

ordered_json imported_tools(const ImportToolsArguments& arguments) {
  const auto request = library_request(arguments);
  try {
    const document::Catalogue none;
    return service::answer(*service::find_request("import-tools"), request, {none});
  } catch (const InputError& e) {
    rethrow_of_foreign_file(e, told_of(arguments));
  }
}

// "assumed: CNMG-12/life and 3 more: The life is not said".
void tell_remarks(const std::string& what, const ordered_json& remarks) {
  for (const auto& r : remarks) {
    const auto& at = r["at"];
    auto line = what + ": " + at[0].get<std::string>();
    if (at.size() > 1) line += say(" and {} more", at.size() - 1);
    std::cerr << visible(line + ": " + r["text"].get<std::string>()) << '\n';
  }
}

/// @throws InputError naming every file that is there already.
void require_new(const fs::path& folder, const std::vector<service::NamedText>& files) {
  std::vector<Problem> problems;
  for (const auto& file : files)
    if (fs::exists(folder / file.name))
      problems.push_back({"--out", say("{}, which exists", (folder / file.name).string()),
                          tr("a folder without it, or --force to replace it"), "file"});
  if (!problems.empty()) throw InputError(tr("command line"), std::move(problems));
}

// Returns the paths, a line each.
std::string write_tools(const ImportToolsArguments& arguments,
                        const ordered_json& result) {
  const auto folder = *arguments.folder / "tools";
  std::vector<service::NamedText> files;
  for (const auto& tool : result["tools"]) {
    const bool fixed = tool["format"] == "turnwright-fixed-tool/1";
    files.push_back({(fixed ? "fixed/" : "") + tool["id"].get<std::string>() + ".json",
                     tool.dump(2) + '\n'});
  }
  if (!arguments.force) require_new(folder, files);
  service::make_folder(folder);
  for (const auto& file : files) service::make_folder((folder / file.name).parent_path());
  service::replace_files(folder, files, [](std::string_view) { return false; });
  std::string list;
  for (const auto& file : files) list += (folder / file.name).string() + '\n';
  return list;
}

void run_import_tools(const ImportToolsArguments& arguments) {
  const auto result = imported_tools(arguments);
  const auto text = result.dump(2) + '\n';
  const bool to_file = arguments.output && *arguments.output != "-";
  if (to_file) service::write_file(*arguments.output, text);
  const auto list = arguments.folder ? write_tools(arguments, result) : std::string();
  if (arguments.json || (arguments.output && !to_file) || (!arguments.folder && !to_file))
    return service::print(text);
  if (!arguments.folder) return;
  service::print(list);
  tell_remarks(tr("assumed"), result["assumed"]);
  tell_remarks(tr("contradiction"), result["contradictions"]);
  tell_remarks(tr("ignored"), result["ignored"]);
}

}  // namespace

void add_import_tools(CLI::App& app,
                      const std::function<void(std::function<void()>)>& chosen) {
  auto* command = app.add_subcommand("import-tools",
                                     tr(service::find_request("import-tools")->summary));
  auto arguments = std::make_shared<ImportToolsArguments>();
  command
      ->add_option(
          "LIBRARY", arguments->files,
          tr(".tools or .json of Fusion, .csv with symbols of ISO 13399, .xml of "
             "MTConnect, .fctb of FreeCAD, several with their .fctl; - reads "
             "standard input"))
      ->required();
  add_path(
      *command, "--out", arguments->folder,
      tr("write each document to tools/ID.json in this data folder, of taps, reamers "
         "and countersinks to tools/fixed/ID.json"));
  command->add_flag("--force", arguments->force,
                    tr("replace files that are there already"));
  add_path(*command, "-o,--output", arguments->output,
           tr("write the result (JSON) here; - is standard output"),
           Dash::is_standard_output);
  command->add_flag("--json", arguments->json,
                    tr("print the result as JSON, with --out too"));
  command
      ->add_option_function<std::string>(
          "--groups",
          [arguments](const std::string& letters) {
            auto& groups = arguments->members["groups"] = nlohmann::json::array();
            for (const char letter : letters)
              if (letter != ',') groups.push_back(std::string(1, letter));
          },
          tr("ISO 513 groups of tools whose library says none; otherwise P,M,K"))
      ->type_name("P,M,..");
  command
      ->add_option_function<std::string>(
          "--unit",
          [arguments](const std::string& unit) { arguments->members["unit"] = unit; },
          tr("unit of a table without column unit: mm or inch; otherwise mm"))
      ->type_name("UNIT");
  command->footer(
      tr("Examples:") +
      "\n"
      "  printf 'insert;RE;KAPR\\nCNMG 120408;0,8;95\\n' | turnwright import-tools -\n"
      "  printf 'id;insert;holder\\nR1;CNMG 432;DCLNL 2525M 12\\n' | turnwright "
      "import-tools - --groups P,K");
  command->callback(
      [arguments, chosen] { chosen([arguments] { run_import_tools(*arguments); }); });
}

}  // namespace turnwright::app
