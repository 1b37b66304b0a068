#include "side_by_side.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <stop_token>

#include "turnwright/base/cancelled.hpp"

namespace turnwright::planning {

void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work) {
  const auto* const heard = Listening::heard();
  const std::stop_token stop = heard ? *heard : std::stop_token();
  const auto one = [&](std::size_t i) {
    const Listening listening(stop);
    work(i);
  };
  // A thread that waits for the others takes no work of another request meanwhile.
  tbb::this_task_arena::isolate(
      [&] { tbb::parallel_for(std::size_t{0}, count, one, tbb::simple_partitioner()); });
}

}  // namespace turnwright::planning
