#pragma once
#include <cstdint>
#include <functional>

#include "folder.hpp"
#include "turnwright/document/catalogue.hpp"

namespace turnwright::service {

/// Part `index` of `count`, from 1: consecutive chunks, about as many as in every other.
struct Shard {
  std::int64_t index = 1, count = 1;

  std::int64_t first(std::int64_t chunks) const { return chunks * (index - 1) / count; }
  std::int64_t end(std::int64_t chunks) const { return chunks * index / count; }
};

/// How far the run is, in lines.
struct BatchProgress {
  std::int64_t lines = 0;  ///< of the shard
  std::int64_t found = 0;  ///< in chunks that earlier runs left
  std::int64_t done = 0;   ///< by this run
};

/// Answers the lines of the shard's chunks that are missing, `jobs` at once.  The files
/// depend neither on `jobs` nor on what was there before; memory depends neither on the
/// number of lines nor on that of chunks.
/// @param tell  hears of every line, in order, from any thread but one at a time.
/// @throws InputError, OutputError as the folder does.
void run_batch(BatchInput& input, const BatchFolder& folder, const Shard& shard,
               const document::Catalogue& catalogue, unsigned jobs,
               const std::function<void(const BatchProgress&)>& tell);

}  // namespace turnwright::service
