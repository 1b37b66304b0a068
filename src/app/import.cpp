#include "import.hpp"

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "document/json/parse.hpp"
#include "foreign_file.hpp"
#include "options.hpp"
#include "service/output.hpp"
#include "service/requests.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/document/import.hpp"

namespace turnwright::app {
namespace {

namespace fs = std::filesystem;

struct ImportArguments {
  std::string file;
  std::optional<fs::path> output;
  bool json = false, quiet = false;
  nlohmann::json members =
      nlohmann::json::object();  ///< of the request, beside the drawing
};

constexpr ForeignFile kDrawing{to_translate("a drawing of at most so many"),
                               to_translate("a STEP, DXF or text file"),
                               document::kLargestDrawing};

// A drawing, or a request of the capability as other commands take one.
nlohmann::json request_of(const ImportArguments& arguments) {
  auto bytes = read_foreign_file(arguments.file, kDrawing);
  const auto first = bytes.find_first_not_of(" \t\r\n");
  const bool drawing = first == std::string::npos || bytes[first] != '{';
  const auto name = name_of_foreign_file(arguments.file);
  auto request = drawing ? document::import_request(std::move(bytes))
                         : document::parse(bytes, name, document::kLocalLimits);
  if (request.is_object() && request.contains("outer"))
    throw InputError(name,
                     {{"document", tr("a part document"),
                       tr("a drawing, for plan takes this file as it is"), "type"}});
  request.update(arguments.members);
  return request;
}

nlohmann::ordered_json imported(const ImportArguments& arguments, const fs::path& data) {
  const auto request = request_of(arguments);
  const auto catalogue = document::load_catalogue(data);
  try {
    return service::answer(*service::find_request("import"), request, {catalogue});
  } catch (const InputError& e) {
    rethrow_of_foreign_file(e, arguments.file);
  }
}

void tell(const std::string& what, const nlohmann::ordered_json& remarks) {
  for (const auto& r : remarks) {
    const auto at = r["at"].get<std::string>();
    std::cerr << what << ": "
              << visible((at.empty() ? "" : at + ": ") + r["text"].get<std::string>())
              << '\n';
  }
}

void run(const ImportArguments& arguments, const std::optional<fs::path>& data) {
  const auto result = imported(arguments, document::data_folder(data));
  const auto text = (arguments.json ? result : result["part"]).dump(2) + '\n';
  if (arguments.output && *arguments.output != "-")
    service::write_file(*arguments.output, text);
  else
    service::print(text);
  if (arguments.json || arguments.quiet) return;
  tell(tr("assumed"), result["assumed"]);
  tell(tr("ignored"), result["ignored"]);
}

}  // namespace

void add_import(CLI::App& app, const std::optional<fs::path>& data,
                const std::function<void(std::function<void()>)>& chosen) {
  auto* command = app.add_subcommand(
      "import", tr("STEP, DXF or a line of text -> part document for plan"));
  auto arguments = std::make_shared<ImportArguments>();
  command
      ->add_option("DRAWING", arguments->file,
                   tr("STEP or DXF file, or elements as text; - reads standard input"))
      ->required();
  add_path(*command, "-o,--output", arguments->output,
           tr("write the part document here; - is standard output"),
           Dash::is_standard_output);
  command->add_flag("--json", arguments->json,
                    tr("the whole result: part, what was assumed and what was ignored"));
  command->add_flag("--quiet", arguments->quiet,
                    tr("do not tell what was assumed and ignored"));
  const auto text = [&](const char* option, const char* key, const std::string& help) {
    command
        ->add_option_function<std::string>(
            option,
            [arguments, key](const std::string& word) { arguments->members[key] = word; },
            help)
        ->type_name("WORD");
  };
  text("--material", "material", tr("id of the material, if the drawing names none"));
  text("--machine", "machine", tr("id of the lathe; otherwise lathe-medium"));
  text("--general", "general", tr("general tolerances; otherwise ISO 2768-mK"));
  text("--name", "name", tr("name of the part; otherwise the drawing's"));
  text("--body", "body", tr("which body of a STEP file with several, by name"));
  text("--source", "source", tr("step, dxf or notation, if it is not recognised"));
  command->footer(
      tr("Examples:") +
      "\n"
      "  echo 'd50 h7 x 40 Ra1.6; d30 k6 x 32' | turnwright import - --material C45 "
      "--json\n"
      "  echo 'd50 x 40; 1x45; d30 h7 x 32' | turnwright import - --material C45 --quiet "
      "| "
      "turnwright plan -");
  command->callback([arguments, &data, chosen] {
    chosen([arguments, &data] { run(*arguments, data); });
  });
}

}  // namespace turnwright::app
