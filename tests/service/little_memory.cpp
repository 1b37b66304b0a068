#include "little_memory.hpp"

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> most{SIZE_MAX};

}  // namespace

void* operator new(std::size_t bytes) {
  void* memory = bytes > most ? nullptr : std::malloc(bytes > 0 ? bytes : 1);
  if (!memory) throw std::bad_alloc();
  return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace turnwright::service {

LittleMemory::LittleMemory(std::size_t bytes) { most = bytes; }
LittleMemory::~LittleMemory() { most = SIZE_MAX; }

}  // namespace turnwright::service
