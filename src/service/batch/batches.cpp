#include "turnwright/service/batches.hpp"

#include <sys/resource.h>

#include <chrono>

#include "turnwright/base/cancelled.hpp"
#include "turnwright/service/batch_line.hpp"
#include "turnwright/service/log.hpp"

namespace turnwright::service {
namespace {

// Few lines are lost with the process, yet short lines share a write to the disk.
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
    : store_(store), catalogue_(catalogue) {
  for (unsigned i = 0; i < threads; ++i)
    workers_.emplace_back([this](const std::stop_token& stop) { work(stop); });
}

Batches::~Batches() = default;  // the threads are asked to stop, then joined

void Batches::wake() {
  {
    const std::lock_guard lock(mutex_);
    ++wakes_;
  }
  changed_.notify_all();
}

void Batches::work(const std::stop_token& stop) {
  // On Linux the priority of a process id 0 is that of the calling thread.
  setpriority(PRIO_PROCESS, 0, kNice);
  std::uint64_t seen = 0;
  while (!stop.stop_requested()) {
    {
      const std::lock_guard lock(mutex_);
      seen = wakes_;
    }
    try {
      if (work_some(stop)) continue;
    } catch (const std::exception& error) {  // a full disk; what was taken stays open
      log_event("batches wait for a wake", error.what());
    }
    std::unique_lock lock(mutex_);
    changed_.wait(lock, stop, [&] { return wakes_ != seen; });
  }
}

// Line by line, so that threads share a small job and a cancelled one ends soon.
bool Batches::work_some(const std::stop_token& stop) {
  std::vector<JobStore::Record> ready;
  auto written = std::chrono::steady_clock::now();
  bool worked = false;
  const auto next = [&] {
    return stop.stop_requested() ? std::vector<JobStore::Line>() : store_.take(1);
  };
  try {
    for (auto lines = next(); !lines.empty(); lines = next()) {
      worked = true;
      ready.push_back(answered(store_, lines.front(), {catalogue_, stop}));
      const auto now = std::chrono::steady_clock::now();
      if (ready.size() < kTogether && now - written < kBetweenWrites) continue;
      store_.finish(ready);
      ready.clear();
      written = now;
    }
  } catch (const Cancelled&) {
  }
  store_.finish(ready);
  return worked;
}

}  // namespace turnwright::service
