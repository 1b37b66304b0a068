#include "batches.hpp"

#include <sys/resource.h>

#include <chrono>

#include "line.hpp"
#include "service/log.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::service {
namespace {

// A compromise: few lines are lost with the process, and short lines share a disk write.
constexpr std::size_t kTogether = 64;
constexpr auto kBetweenWrites = std::chrono::milliseconds(200);
constexpr int kNice = 5;

JobStore::Record answered(const JobStore& store, const JobStore::Line& line,
                          const Context& context) {
  JobStore::Record record{line.job, line.number, {}, {}, false};
  const auto take = [&](BatchRecord made) {
    record.text = std::move(made.text);
    record.error = made.status == BatchStatus::error;
  };
  try {
    const BatchRequest request = read_batch_line(line.text);
    if (auto known = store.known(request.digest))
      record.text = std::move(*known);
    else
      take(batch_record(request, context));
    if (!record.error) record.digest = request.digest;
  } catch (const InputError& error) {
    take(batch_record(error));
  } catch (const std::bad_alloc& error) {
    take(batch_record(error));
  }
  return record;
}

}  // namespace

Batches::Batches(JobStore& store, const document::Catalogue& catalogue, unsigned threads)
    : store_(store),
      catalogue_(catalogue),
      fatal_lines_(store.fatal_file()),
      under_way_(threads) {
  for (auto& own : under_way_)
    workers_.emplace_back([this, &own](const std::stop_token& stop) { work(stop, own); });
}

Batches::~Batches() = default;  // requests the threads to stop and joins them

void Batches::wake() {
  {
    const std::lock_guard lock(mutex_);
    ++wakes_;
  }
  changed_.notify_all();
}

bool Batches::cancel(std::int64_t id) {
  const std::lock_guard lock(mutex_);
  const bool found = store_.cancel(id);
  stop_lines(id);
  return found;
}

bool Batches::remove(std::int64_t id) {
  const std::lock_guard lock(mutex_);
  const bool found = store_.remove(id);
  stop_lines(id);
  return found;
}

void Batches::stop_lines(std::int64_t id) {
  for (auto& line : under_way_)
    if (line.job == id) line.stop.request_stop();
}

// Under the lock, so that a job cannot be cancelled after its line has been taken and
// before its stop source is stored.
std::optional<JobStore::Line> Batches::next(UnderWay& own) {
  const std::lock_guard lock(mutex_);
  auto lines = store_.take(1);
  if (lines.empty()) return std::nullopt;
  own = {lines[0].job, std::stop_source()};
  return std::move(lines[0]);
}

void Batches::work(const std::stop_token& stop, UnderWay& own) {
  // On Linux the priority of a process id 0 is that of the calling thread.
  setpriority(PRIO_PROCESS, 0, kNice);
  std::uint64_t seen = 0;
  while (!stop.stop_requested()) {
    {
      const std::lock_guard lock(mutex_);
      seen = wakes_;
    }
    try {
      if (work_some(stop, own)) continue;
    } catch (
        const std::exception& error) {  // a full disk; lines that were taken stay open
      log_event("batches wait for a wake", error.what());
    }
    std::unique_lock lock(mutex_);
    changed_.wait(lock, stop, [&] { return wakes_ != seen; });
  }
}

// Line by line, so that threads share a small job and a cancelled one ends soon.
bool Batches::work_some(const std::stop_token& stop, UnderWay& own) {
  std::vector<JobStore::Record> ready;
  auto written = std::chrono::steady_clock::now();
  bool worked = false;
  while (!stop.stop_requested()) {
    const auto line = next(own);
    if (!line) break;
    worked = true;
    const std::stop_callback leave(stop, [&own] { own.stop.request_stop(); });
    const FatalLines::Computing computing({line->job, line->number});
    try {
      ready.push_back(answered(store_, *line, {catalogue_, own.stop.get_token()}));
    } catch (const Cancelled&) {
      continue;  // the job has ended, or the worker
    }
    const auto now = std::chrono::steady_clock::now();
    if (ready.size() < kTogether && now - written < kBetweenWrites) continue;
    store_.finish(ready);
    ready.clear();
    written = now;
  }
  store_.finish(ready);
  return worked;
}

}  // namespace turnwright::service
