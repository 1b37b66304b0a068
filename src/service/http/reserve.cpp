#include "reserve.hpp"

#include <sys/mman.h>

#include <atomic>
#include <new>
#include <stdexcept>

namespace turnwright::service {
namespace {

// `new` calls a function that finds only what is global.
std::atomic<void*> held = nullptr;
std::atomic<std::size_t> size = 0;  // 0: there is no reserve

void give_up() {
  void* const reserve = held.exchange(nullptr);
  if (!reserve) throw std::bad_alloc();
  ::munmap(reserve, size);
}

}  // namespace

MemoryReserve::MemoryReserve(std::size_t bytes) {
  if (size != 0) throw std::domain_error("MemoryReserve: there is one already");
  size = bytes;
  refill();
  std::set_new_handler(give_up);
}

MemoryReserve::~MemoryReserve() {
  std::set_new_handler(nullptr);
  if (void* const reserve = held.exchange(nullptr)) ::munmap(reserve, size);
  size = 0;
}

bool MemoryReserve::refill() {
  if (held || size == 0) return true;
  void* const fresh = ::mmap(nullptr, size, PROT_NONE,
                             MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (fresh == MAP_FAILED) return false;
  void* none = nullptr;
  if (!held.compare_exchange_strong(none, fresh)) ::munmap(fresh, size);
  return true;
}

}  // namespace turnwright::service
