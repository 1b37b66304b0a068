#pragma once
#include <cstddef>
#include <functional>

namespace turnwright::planning {

/// work(0) to work(count - 1), of which none may depend on another, on all threads of the
/// caller's arena.  Who stops the caller stops them (base/cancelled.hpp).
/// @throws the exception of one of them.
void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace turnwright::planning
