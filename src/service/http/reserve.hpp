#pragma once
#include <cstddef>

namespace turnwright::service {

/// Address space that is given up when `new` finds none, so that the small allocations of
/// the network library still succeed, whose failure would end the process: Boost.Asio
/// starts operations in functions that must not throw.  A process has at most one.
class MemoryReserve {
 public:
  explicit MemoryReserve(std::size_t bytes);
  ~MemoryReserve();
  MemoryReserve(const MemoryReserve&) = delete;
  MemoryReserve& operator=(const MemoryReserve&) = delete;

  /// Whether the reserve is there, or can be had again; true where there is no reserve.
  static bool refill();
};

}  // namespace turnwright::service
