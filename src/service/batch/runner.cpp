#include "runner.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>

#include "document/json/parse.hpp"
#include "known_answers.hpp"

namespace turnwright::service {
namespace {

// So many lines may wait behind one that takes long before the pipeline stops.
constexpr std::size_t kInFlightPerJob = 64;

// Answers that are computed faster than they are looked up are not kept.
constexpr auto kWorthKeeping = std::chrono::milliseconds(1);

/// A line in the pipeline; a blank one has no record.
struct Item {
  std::int64_t chunk = 0, number = 0;  ///< the line's number, from 1
  std::string text;                    ///< the line, then its record
  BatchStatus status = BatchStatus::ok;
  std::string key;         ///< of its chunk, with the chunk's last line
  std::int64_t found = 0;  ///< lines before it that earlier runs have answered
};

// What filters do until one of them fails, which ends the pipeline early.  TBB does not free
// the items in flight when a filter throws.
class FirstFailure {
 public:
  template <class Work>
  void unless(const Work& work) {
    if (happened_) return;
    try {
      work();
    } catch (...) {
      if (!happened_.exchange(true)) what_ = std::current_exception();
    }
  }
  // Once all filters have ended.
  void rethrow() const {
    if (what_) std::rethrow_exception(what_);
  }

 private:
  std::atomic<bool> happened_ = false;
  std::exception_ptr what_;
};

// A line that BatchInput has cut off is not blank, even if it begins with blanks.
bool blank_item(const std::string& line) {
  return line.size() <= document::ParseLimits{}.bytes &&
         line.find_first_not_of(" \t\r") == std::string::npos;
}

/// The lines of the chunks that are missing, in order.
class Missing {
 public:
  Missing(BatchInput& input, const BatchFolder& folder, const Shard& shard)
      : input_(input),
        folder_(folder),
        next_(shard.first(folder.manifest().chunks())),
        end_(shard.end(folder.manifest().chunks())),
        lines_(lines_before(end_) - lines_before(next_)) {
    input_.seek(0);
    for (std::int64_t chunk = 0; chunk < next_; ++chunk) folder_.read_key(chunk, input_);
  }

  std::int64_t lines() const { return lines_; }
  std::int64_t found() const { return found_; }

  bool next(Item& item) {
    if (left_ == 0 && !next_chunk()) return false;
    item.chunk = next_ - 1;
    item.number = ++number_;
    item.found = found_;
    // If a line has disappeared meanwhile the chunk is refused by the digest of its
    // input.
    input_.next(key_, &item.text);
    if (--left_ == 0) item.key = key_.hex();
    return true;
  }

 private:
  std::int64_t lines_before(std::int64_t chunk) const {
    const auto& manifest = folder_.manifest();
    return std::min(chunk * manifest.chunk_lines, manifest.input.lines);
  }

  bool next_chunk() {
    while (next_ < end_) {
      const auto chunk = next_++;
      const auto begin = input_.position();
      const auto lines = lines_before(chunk + 1) - lines_before(chunk);
      const auto key = folder_.read_key(chunk, input_);
      if (read_chunk(folder_.chunk_file(chunk), key)) {
        found_ += lines;
        continue;
      }
      input_.seek(begin);
      left_ = lines;
      number_ = lines_before(chunk);
      key_ = folder_.key_of(chunk);
      return true;
    }
    return false;
  }

  BatchInput& input_;
  const BatchFolder& folder_;
  std::int64_t next_, end_;  ///< chunks
  std::int64_t lines_ = 0, found_ = 0;
  std::int64_t left_ = 0, number_ = 0;  ///< lines of the chunk under way
  Sha256 key_;
};

void answer(Item& item, const document::Catalogue& catalogue, KnownAnswers& known) {
  if (blank_item(item.text)) return item.text.clear();
  BatchRecord record;
  try {
    const auto request = read_batch_line(item.text);
    if (auto earlier = known.find(request.digest)) {
      record = std::move(*earlier);
    } else {
      const auto begun = std::chrono::steady_clock::now();
      record = batch_record(request, {catalogue});
      if (std::chrono::steady_clock::now() - begun > kWorthKeeping)
        known.keep(request.digest, record);
    }
  } catch (const InputError& error) {
    record = batch_record(error);
  }
  item.text = numbered(item.number, record.text) + '\n';
  item.status = record.status;
}

/// Writes the records, which come in the order of their lines.
class Records {
 public:
  explicit Records(const BatchFolder& folder) : folder_(folder) {}

  void add(const Item& item) {
    if (!writer_) writer_.emplace(folder_.chunk_file(item.chunk));
    if (!item.text.empty()) writer_->add(item.text, item.status);
    if (item.key.empty()) return;
    writer_->publish(item.key);
    writer_.reset();
  }

 private:
  const BatchFolder& folder_;
  std::optional<ChunkWriter> writer_;
};

}  // namespace

void run_batch(BatchInput& input, const BatchFolder& folder, const Shard& shard,
               const document::Catalogue& catalogue, unsigned jobs,
               const std::function<void(const BatchProgress&)>& tell) {
  make_folder(folder.work());
  Missing missing(input, folder, shard);
  BatchProgress progress{.lines = missing.lines()};
  KnownAnswers known;
  Records records(folder);

  FirstFailure failure;
  const auto read = tbb::make_filter<void, Item>(
      tbb::filter_mode::serial_in_order, [&](tbb::flow_control& flow) {
        Item item;
        bool more = false;
        failure.unless([&] { more = missing.next(item); });
        if (!more) flow.stop();
        return item;
      });
  const auto work =
      tbb::make_filter<Item, Item>(tbb::filter_mode::parallel, [&](Item item) {
        failure.unless([&] { answer(item, catalogue, known); });
        return item;
      });
  const auto write = tbb::make_filter<Item, void>(tbb::filter_mode::serial_in_order,
                                                  [&](const Item& item) {
                                                    failure.unless([&] {
                                                      records.add(item);
                                                      progress.found = item.found;
                                                      ++progress.done;
                                                      tell(progress);
                                                    });
                                                  });

  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, jobs);
  tbb::task_arena arena(static_cast<int>(jobs));
  arena.execute(
      [&] { tbb::parallel_pipeline(jobs * kInFlightPerJob, read & work & write); });
  failure.rethrow();
  progress.found = missing.found();
  tell(progress);
}

}  // namespace turnwright::service
