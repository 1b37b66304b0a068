#include "mcp.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>

#include "exit.hpp"
#include "options.hpp"
#include "service/batch/input.hpp"
#include "service/mcp/mcp_server.hpp"
#include "service/output.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/document/catalogue.hpp"

namespace turnwright::app {
namespace {

// A client that no longer reads cannot be told anything.
void send_line(const nlohmann::ordered_json& message) {
  try {
    service::print(message.dump() + '\n');
  } catch (const service::OutputError& e) {
    std::cerr << visible(e.what()) << '\n';
    std::_Exit(kOutput);
  }
}

void serve_lines(double deadline_s, const std::optional<std::filesystem::path>& data) {
  const auto folder = document::data_folder(data);
  const auto catalogue = document::load_catalogue(folder);
  service::mcp::Server server(
      folder, catalogue, send_line,
      {.deadline = std::chrono::milliseconds(static_cast<long>(1e3 * deadline_s))});
  service::BatchInput input(::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0),
                            tr("standard input"));
  for (std::string line; input.next(line);)
    if (line.find_first_not_of(" \t\r") != std::string::npos) server.receive(line);
}

}  // namespace

void add_mcp(CLI::App& app, const std::optional<std::filesystem::path>& data,
             const std::function<void(std::function<void()>)>& chosen) {
  auto* command = app.add_subcommand(
      "mcp", tr("answer a language model over standard input and output (MCP)"));
  auto deadline_s = std::make_shared<double>(60);
  add_number<double>(*command, "--deadline", *deadline_s, {0.001, 86'400},
                     tr("seconds that one call may take"));
  command->footer(
      tr("For the configuration of a client:") +
      "\n"
      "  {\"mcpServers\": {\"turnwright\": {\"command\": \"turnwright\", \"args\": "
      "[\"mcp\"]}}}\n" +
      tr("Example:") +
      "\n"
      "  echo '{\"jsonrpc\": \"2.0\", \"id\": 1, \"method\": \"tools/list\"}' | "
      "turnwright "
      "mcp");
  command->callback([deadline_s, &data, chosen] {
    chosen([deadline_s, &data] { serve_lines(*deadline_s, data); });
  });
}

}  // namespace turnwright::app
