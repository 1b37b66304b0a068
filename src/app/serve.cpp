#include "serve.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>

#include "options.hpp"
#include "service/batch/folder.hpp"
#include "service/http/reserve.hpp"
#include "service/http/server.hpp"
#include "service/log.hpp"
#include "service/output.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/document/catalogue.hpp"

namespace turnwright::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMega = 1'000'000;
constexpr std::size_t kReserve = 16 * kMega;  // bytes

struct ServeArguments {
  service::ServerOptions options;
  std::optional<fs::path> keys, jobs, page;
  double deadline_s = 60;
  unsigned batch_threads = 1;
  std::size_t body_memory_MB = service::ServerOptions{}.body_bytes / kMega;
};

/// Default place of the job store: the user's state folder.
fs::path usual_job_file() {
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  const fs::path base = state && *state ? fs::path(state)
                        : home && *home ? fs::path(home) / ".local/state"
                                        : fs::temp_directory_path();
  return base / "turnwright" / "jobs.sqlite";
}

/// The job store; none if no option names one and the default place cannot be used.
std::unique_ptr<service::JobStore> open_jobs(const std::optional<fs::path>& asked,
                                             const std::string& data) {
  if (asked) try {
      return std::make_unique<service::JobStore>(*asked, data);
    } catch (const std::runtime_error& error) {
      throw wrong_option("--jobs", error.what(),
                         tr("a job store of this version that no other process has open"),
                         "file");
    }
  const auto file = usual_job_file();
  try {
    fs::create_directories(file.parent_path());
    return std::make_unique<service::JobStore>(file, data);
  } catch (const std::exception& error) {
    service::log_event("no batches",
                       std::string(error.what()) + "; --jobs FILE names another place");
    return nullptr;
  }
}

/// The page from a folder, read again for every answer.
service::HttpApi::Page page_of(const fs::path& folder) {
  const auto read = [file = folder / "index.html"]() -> std::string {
    std::ifstream in(file, std::ios::binary);
    if (!in)
      throw InputError(file.string(),
                       {{"", tr("nothing that can be read"), tr("the page"), "file"}});
    return {std::istreambuf_iterator<char>(in), {}};
  };
  read();  // errors are reported at the start
  return read;
}

std::string told_limits(const ServeArguments& arguments) {
  return "bodies and answers of all calls together: " +
         std::to_string(arguments.options.body_bytes / kMega) + " MB (--body-memory)";
}

void serve(ServeArguments arguments, const std::optional<fs::path>& data) {
  if (arguments.keys) arguments.options.keys = service::read_keys(*arguments.keys);
  arguments.options.deadline =
      std::chrono::milliseconds(static_cast<long>(1e3 * arguments.deadline_s));
  arguments.options.body_bytes = kMega * arguments.body_memory_MB;
  service::start_log();
  const auto folder = document::data_folder(data);
  const auto catalogue = document::load_catalogue(folder);
  const auto jobs = open_jobs(arguments.jobs, service::data_sha256(folder) + ' ' +
                                                  std::string(service::version()));
  std::optional<service::Batches> batches;
  if (jobs) batches.emplace(*jobs, catalogue, arguments.batch_threads);
  const service::HttpApi api(
      folder, catalogue, batches ? &*batches : nullptr,
      arguments.page ? page_of(*arguments.page) : service::built_in_page);
  const service::MemoryReserve reserve(kReserve);
  service::Server server(arguments.options, api);
  const bool v6 = arguments.options.address.find(':') != std::string::npos;
  service::print(
      "turnwright serves http://" +
      (v6 ? '[' + arguments.options.address + ']' : arguments.options.address) + ':' +
      std::to_string(server.port()) + "/\n");
  service::log_event("limits", told_limits(arguments));
  server.run();
  service::log_event("stopped", "every call that had arrived is answered");
}

}  // namespace

void add_serve(CLI::App& app, const std::optional<fs::path>& data,
               const std::function<void(std::function<void()>)>& chosen) {
  auto* command = app.add_subcommand("serve", tr("answer requests over HTTP"));
  auto arguments = std::make_shared<ServeArguments>();
  auto& options = arguments->options;
  command->add_option("--address", options.address, tr("numeric address to listen on"))
      ->capture_default_str();
  add_number<std::uint16_t>(*command, "--port", options.port, {0, 65'535},
                            tr("port to listen on; 0: any free one"));
  add_path(*command, "--keys", arguments->keys,
           tr("file of bearer keys, one a line; needed for addresses that other machines "
              "reach"));
  add_path(*command, "--jobs", arguments->jobs,
           tr("file that keeps the batches (default: turnwright/jobs.sqlite in "
              "$XDG_STATE_HOME)"));
  add_path(*command, "--page", arguments->page,
           tr("folder of another page, index.html, read anew for every answer"));
  add_number<unsigned>(*command, "--threads", options.threads, {0, 1024},
                       tr("threads that compute; 0: one a core"));
  add_number<unsigned>(*command, "--batch-threads", arguments->batch_threads, {1, 1024},
                       tr("threads that work on batches"));
  add_number<std::size_t>(*command, "--queue", options.queue, {0, 1'000'000},
                          tr("calls that may wait for a thread; more are answered 503"));
  add_number<std::size_t>(*command, "--connections", options.connections, {1, 1'000'000},
                          tr("connections open at once"));
  add_number<std::size_t>(*command, "--body-memory", arguments->body_memory_MB,
                          {4, 1'000'000},
                          tr("MB that bodies and answers of all calls may take together; "
                             "more are answered 503"));
  add_number<double>(*command, "--deadline", arguments->deadline_s, {0.001, 86'400},
                     tr("seconds a call may be computed; then it is answered 504"));
  command->footer(
      tr("Stops on SIGTERM or SIGINT, when every call that has arrived is answered.") +
      '\n' + tr("Examples:") +
      "\n  turnwright serve --port 8080\n"
      "  curl http://127.0.0.1:8080/v1/parts\n"
      "  curl -H 'Content-Type: application/json' --data @part.json "
      "http://127.0.0.1:8080/v1/plan");
  command->callback([arguments, &data, chosen] {
    chosen([arguments, &data] { serve(*arguments, data); });
  });
}

}  // namespace turnwright::app
