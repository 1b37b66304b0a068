#include "slurm.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <sstream>
#include <thread>

#include "base/say.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::service {
namespace {

namespace fs = std::filesystem;
using std::chrono::steady_clock;

constexpr std::int64_t kMostTasks = 1000;  // Slurm's own default limit
constexpr int kFruitless = 3;
constexpr auto kBetweenLooks = std::chrono::seconds(2);
constexpr auto kLongestSilence = std::chrono::minutes(10);

std::string quoted(const fs::path& path) {
  std::string text = "'";
  for (const char c : path.string()) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + '\'';
}

/// The output of a shell command; none if it fails.
std::optional<std::string> output_of(const std::string& command) {
  std::FILE* pipe = ::popen(command.c_str(), "re");
  if (!pipe) return std::nullopt;
  std::string text;
  char piece[4096];
  while (const auto size = std::fread(piece, 1, sizeof piece, pipe))
    text.append(piece, size);
  if (::pclose(pipe) != 0) return std::nullopt;
  return text;
}

/// Numbers in rising order in Slurm's notation: "1-3,7".
std::string ranges(const std::vector<std::int64_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    if (!text.empty()) text += ',';
    text += std::to_string(numbers[i]);
    if (last > i) text += '-' + std::to_string(numbers[last]);
    i = last + 1;
  }
  return text;
}

struct Queued {
  std::string task;    ///< "12_3"
  std::string reason;  ///< why it waits
};

/// Tasks of the arrays of that name; none if Slurm does not answer.
std::optional<std::vector<Queued>> queue(const std::string& name) {
  const auto text = output_of(
      "squeue --noheader --array --format='%F_%K %r' --name=" + name + " 2>/dev/null");
  if (!text) return std::nullopt;
  std::vector<Queued> tasks;
  std::istringstream in(*text);
  for (Queued task; in >> task.task && std::getline(in >> std::ws, task.reason);)
    tasks.push_back(task);
  return tasks;
}

// A task whose node died is held for two minutes, in case the node comes back.  A task
// that a node refused, or that was requeued too often, is held for good; it is cancelled
// and submitted again.
void release(const Queued& task) {
  if (task.reason == "BeginTime")
    output_of("scontrol update JobId=" + task.task + " StartTime=now 2>/dev/null");
  if (task.reason.starts_with("launch") || task.reason == "JobHoldMaxRequeue")
    output_of("scancel " + task.task + " 2>/dev/null");
}

}  // namespace

SlurmBatch::SlurmBatch(BatchInput& input, const BatchFolder& folder, SlurmOptions options)
    : input_(input),
      folder_(folder),
      options_(std::move(options)),
      tasks_(std::clamp<std::int64_t>(
          (folder.manifest().input.lines + options_.task_lines - 1) / options_.task_lines,
          1, kMostTasks)),
      name_("turnwright-" + sha256_hex(fs::canonical(folder.path()).string() + '\n' +
                                       folder.manifest().text())
                                .substr(0, 16)) {}

std::string SlurmBatch::submit() {
  const auto waiting = queue(name_);
  if (waiting && !waiting->empty())
    throw OutputError(
        say("{}: {} tasks of this batch are in Slurm's queue; --reconcile waits for them",
            folder_.path().string(), waiting->size()));
  const auto tasks = missing_tasks();
  return tasks.empty() ? "" : submit(tasks);
}

void SlurmBatch::complete(const std::function<void(const std::string&)>& tell) {
  std::size_t least = 0;
  for (int fruitless = 0;;) {
    wait();
    const auto tasks = missing_tasks();
    if (tasks.empty()) return;
    fruitless = least == 0 || tasks.size() < least ? 0 : fruitless + 1;
    least = tasks.size();
    if (fruitless == kFruitless)
      throw OutputError(say("{}: tasks {} bring nothing; see {}/slurm-*.log",
                            folder_.path().string(), ranges(tasks),
                            folder_.work().string()));
    const auto array = submit(tasks);
    tell(say("tasks {} of {} are missing: submitted as array {}", ranges(tasks), tasks_,
             array));
  }
}

std::vector<std::int64_t> SlurmBatch::missing_tasks() {
  const auto chunks = folder_.manifest().chunks();
  std::vector<std::int64_t> missing;
  input_.seek(0);
  for (std::int64_t task = 1; task <= tasks_; ++task) {
    const Shard shard{task, tasks_};
    bool whole = true;
    for (auto chunk = shard.first(chunks); chunk < shard.end(chunks); ++chunk) {
      const auto key = folder_.read_key(chunk, input_);
      whole = whole && read_chunk(folder_.chunk_file(chunk), key);
    }
    if (!whole) missing.push_back(task);
  }
  return missing;
}

std::string SlurmBatch::submit(const std::vector<std::int64_t>& tasks) {
  const auto script = fs::canonical(folder_.work()) / "slurm.sh";
  write_file(script,
             "#!/bin/bash\n"
             "#SBATCH --job-name=" +
                 name_ + "\n#SBATCH --array=" + ranges(tasks) +
                 "\n#SBATCH --cpus-per-task=" + std::to_string(options_.jobs) +
                 "\n#SBATCH --requeue --open-mode=append --output=slurm-%a.log\nexec " +
                 quoted(options_.program) + " --data " + quoted(options_.data) +
                 " --language " + language() + " batch " +
                 quoted(fs::canonical(input_.file())) + " -o " +
                 quoted(fs::canonical(folder_.path())) + " --jobs " +
                 std::to_string(options_.jobs) + " --shard \"$SLURM_ARRAY_TASK_ID/" +
                 std::to_string(tasks_) + "\"\n");
  const auto number = output_of(
      "sbatch --parsable --chdir=" + quoted(script.parent_path()) + ' ' + quoted(script));
  if (!number) throw OutputError(say("{}: sbatch did not take it", script.string()));
  return number->substr(0, number->find_first_of(";\n"));
}

void SlurmBatch::wait() {
  auto heard = steady_clock::now();
  for (;; std::this_thread::sleep_for(kBetweenLooks)) {
    const auto tasks = queue(name_);
    if (tasks && tasks->empty()) return;
    if (tasks) {
      heard = steady_clock::now();
      std::for_each(tasks->begin(), tasks->end(), release);
    } else if (steady_clock::now() - heard > kLongestSilence) {
      throw OutputError(
          say("{}: Slurm has not answered for long", folder_.path().string()));
    }
  }
}

}  // namespace turnwright::service
