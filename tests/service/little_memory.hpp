#pragma once
#include <cstddef>

namespace turnwright::service {

/// While it lives, `new` of more bytes than `most` throws std::bad_alloc, in every
/// thread.
class LittleMemory {
 public:
  explicit LittleMemory(std::size_t most);
  LittleMemory(const LittleMemory&) = delete;
  LittleMemory& operator=(const LittleMemory&) = delete;
  ~LittleMemory();
};

}  // namespace turnwright::service
