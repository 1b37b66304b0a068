// The reserve of address space for the moment when memory ends.
#include "service/http/reserve.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <new>
#include <stdexcept>

namespace turnwright::service {
namespace {

constexpr std::size_t kReserve = 64 << 20;

std::size_t address_space() {
  std::ifstream statm("/proc/self/statm");
  std::size_t pages = 0;
  statm >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

/// While it lives, the process gets no more address space than it has.
class NoMoreSpace {
 public:
  NoMoreSpace() {
    ::getrlimit(RLIMIT_AS, &before_);
    auto limit = before_;
    limit.rlim_cur = address_space();
    ::setrlimit(RLIMIT_AS, &limit);
  }
  NoMoreSpace(const NoMoreSpace&) = delete;
  NoMoreSpace& operator=(const NoMoreSpace&) = delete;
  ~NoMoreSpace() { ::setrlimit(RLIMIT_AS, &before_); }

 private:
  rlimit before_ = {};
};

TEST(MemoryReserve, IsGivenUpOnceAndComesBackWhenThereIsSpace) {
  const auto without = address_space();
  {
    const MemoryReserve reserve(kReserve);
    EXPECT_GE(address_space(), without + kReserve);
    EXPECT_TRUE(MemoryReserve::refill());
    {
      const auto gives_up = std::get_new_handler();
      ASSERT_NE(gives_up, nullptr);
      gives_up();
      EXPECT_LT(address_space(), without + kReserve);
      EXPECT_THROW(gives_up(), std::bad_alloc);
      const NoMoreSpace none;
      EXPECT_FALSE(MemoryReserve::refill());
    }
    EXPECT_TRUE(MemoryReserve::refill());
    EXPECT_GE(address_space(), without + kReserve);
  }
  EXPECT_LT(address_space(), without + kReserve);
  EXPECT_EQ(std::get_new_handler(), nullptr);
}

TEST(MemoryReserve, IsOneAtMost) {
  const MemoryReserve reserve(kReserve);
  EXPECT_THROW(MemoryReserve{kReserve}, std::domain_error);
}

TEST(MemoryReserve, IsNotMissedWhereThereIsNone) { EXPECT_TRUE(MemoryReserve::refill()); }

}  // namespace
}  // namespace turnwright::service
