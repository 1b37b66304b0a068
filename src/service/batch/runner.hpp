#pragma once
#include <cstdint>
#include <functional>

#include "folder.hpp"
#include "turnwright/document/catalogue.hpp"

namespace turnwright::service {

/// Part `index` of `count`, from 1: consecutive chunks, about equally many in every part.
struct Shard {
  std::int64_t index = 1, count = 1;

  std::int64_t first(std::int64_t chunks) const { return chunks * (index - 1) / count; }
  std::int64_t end(std::int64_t chunks) const { return chunks * index / count; }
};

/// Progress of a run, in lines.
struct BatchProgress {
  std::int64_t lines = 0;  ///< of the shard
  std::int64_t found = 0;  ///< in chunks of earlier runs
  std::int64_t done = 0;   ///< by this run
};

/// Answers the lines of the missing chunks of a shard, `jobs` lines at once.  The files
/// depend neither on `jobs` nor on earlier runs; memory depends neither on the number of
/// lines nor on that of chunks.
/// @param tell  called after every line, in order, from any thread but one at a time.
/// @throws InputError, OutputError as the folder.
void run_batch(BatchInput& input, const BatchFolder& folder, const Shard& shard,
               const document::Catalogue& catalogue, unsigned jobs,
               const std::function<void(const BatchProgress&)>& tell);

}  // namespace turnwright::service
