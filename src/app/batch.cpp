#include "batch.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <thread>

#include "base/say.hpp"
#include "options.hpp"
#include "progress_line.hpp"
#include "service/batch/runner.hpp"
#include "service/batch/slurm.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/document/catalogue.hpp"

namespace turnwright::app {
namespace {

namespace fs = std::filesystem;
using service::BatchProgress;

struct BatchArguments {
  fs::path lines, folder;
  std::optional<unsigned> jobs;
  std::optional<std::int64_t> chunk;
  std::optional<service::Shard> shard;
  std::int64_t task_lines = service::SlurmOptions{}.task_lines;
  bool slurm = false, reconcile = false;
};

constexpr Range<std::int64_t> kShards{1, 1'000'000};

/// @throws InputError unless the text has the form "2/5".
service::Shard shard_of(const std::string& text) {
  const auto slash = std::min(text.find('/'), text.size());
  const auto index = number_in(std::string_view(text).substr(0, slash), kShards);
  const auto behind = std::min(slash + 1, text.size());
  const auto count = number_in(std::string_view(text).substr(behind), kShards);
  if (!index || !count || *index > *count)
    throw wrong_option("--shard", '"' + text + '"',
                       say("i/n with 1 <= i <= n <= {}", kShards.most), "range");
  return {*index, *count};
}

std::string name(const service::Shard& shard) {
  return std::to_string(shard.index) + '/' + std::to_string(shard.count);
}

void tell(const service::BatchFolder& folder, const service::BatchSummary& summary) {
  const auto& counts = summary.counts;
  service::print(say("{}: {} records, {} ok, {} infeasible, {} errors\n",
                     (folder.path() / "results.jsonl").string(), counts.records(),
                     counts.ok, counts.infeasible, counts.errors));
}

void run_here(const BatchArguments& arguments, const fs::path& data,
              service::BatchInput& input, const service::BatchFolder& folder) {
  const auto catalogue = document::load_catalogue(data);
  const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
  ProgressLine line(to_translate("{} of {} lines, {}/s, {} left"));
  service::run_batch(input, folder, arguments.shard.value_or(service::Shard{}), catalogue,
                     arguments.jobs.value_or(cores), [&line](const BatchProgress& now) {
                       line.tell(now.found, now.done, now.lines);
                     });
}

/// Whether all chunks are complete, so that the results can be put together.
bool run_on_cluster(const BatchArguments& arguments, const fs::path& data,
                    service::BatchInput& input, const service::BatchFolder& folder) {
  service::SlurmBatch cluster(input, folder,
                              {.program = fs::read_symlink("/proc/self/exe"),
                               .data = fs::canonical(data),
                               .task_lines = arguments.task_lines,
                               .jobs = arguments.jobs.value_or(1)});
  if (arguments.reconcile) {
    cluster.complete([](const std::string& text) { service::print(text + '\n'); });
    return true;
  }
  const auto array = cluster.submit();
  if (array.empty()) return true;
  service::print(
      say("submitted as array {}; --reconcile waits for the results\n", array));
  return false;
}

void run_batch(const BatchArguments& arguments,
               const std::optional<fs::path>& data_option) {
  const auto data = document::data_folder(data_option);
  service::BatchInput input(arguments.lines);
  const auto contents = input.contents();
  service::make_folder(arguments.folder);
  std::optional<service::FolderLock> lock;
  if (!arguments.shard) lock.emplace(arguments.folder);
  const service::BatchFolder folder(arguments.folder, contents,
                                    service::data_sha256(data), arguments.chunk);
  if (const auto summary = folder.complete()) return tell(folder, *summary);
  if (arguments.slurm || arguments.reconcile) {
    if (!run_on_cluster(arguments, data, input, folder)) return;
  } else {
    run_here(arguments, data, input, folder);
  }
  if (!arguments.shard) return tell(folder, folder.assemble(input));
  service::print(say("shard {} is done\n", name(*arguments.shard)));
}

}  // namespace

void add_batch(CLI::App& app, const std::optional<fs::path>& data,
               const std::function<void(std::function<void()>)>& chosen) {
  auto* command =
      app.add_subcommand("batch", tr("many requests, one a line, to a folder"));
  auto arguments = std::make_shared<BatchArguments>();
  command
      ->add_option("LINES", arguments->lines,
                   tr("file of lines {\"name\": \"plan\", \"document\": {..}}"))
      ->required();
  add_path(*command, "-o,--output", arguments->folder,
           tr("folder of the results; a run that was interrupted continues there"))
      ->required();
  add_number<unsigned>(*command, "--jobs", arguments->jobs, {1, 1024},
                       tr("lines at once (default: one a core)"));
  auto* shard = command->add_option_function<std::string>(
      "--shard",
      [arguments](const std::string& text) { arguments->shard = shard_of(text); },
      tr("part i/n of the lines; when all are done, a run without --shard puts them "
         "together"));
  add_number<std::int64_t>(
      *command, "--chunk", arguments->chunk, {1, 1'000'000},
      tr("lines that are kept together; a kill costs no more (default: 100)"));
  auto* slurm = command->add_flag("--slurm", arguments->slurm,
                                  tr("submit as an array of Slurm, and return"));
  auto* reconcile =
      command->add_flag("--reconcile", arguments->reconcile,
                        tr("wait for Slurm's tasks, submit what is missing, until all is "
                           "there; then put it together"));
  slurm->excludes(shard);
  reconcile->excludes(shard)->excludes(slurm);
  add_number<std::int64_t>(*command, "--task-lines", arguments->task_lines,
                           {1, 100'000'000}, tr("lines of one of Slurm's tasks"));
  command->footer(
      tr("Writes results.jsonl, one record a line, in the order of LINES, and "
         "summary.json.") +
      '\n' + tr("Example:") +
      "\n"
      R"(  printf '{"name": "multipass", "document": {"dt_mm": %d}}\n' 6 8 > depths.jsonl)"
      "\n  turnwright batch depths.jsonl -o depths");
  command->callback([arguments, &data, chosen] {
    chosen([arguments, &data] { run_batch(*arguments, data); });
  });
}

}  // namespace turnwright::app
