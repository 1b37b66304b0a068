#include "service/http/budget.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "../../temporary_folder.hpp"
#include "service/http/intake.hpp"

namespace turnwright::service::budget_test {
namespace {

namespace errc = boost::system::errc;

TEST(Budget, CountsWhatIsHeldAndGivesItBack) {
  Budget budget(1'000'000);
  {
    Budget::Share first(budget), second(budget);
    EXPECT_TRUE(first.resize(500'000));
    EXPECT_FALSE(second.resize(250'001));
    EXPECT_TRUE(second.resize(250'000));
    EXPECT_FALSE(second.resize(250'001));
    EXPECT_EQ(budget.used(), 750'000u);
    EXPECT_TRUE(first.resize(100'000));
    EXPECT_TRUE(second.resize(650'000));
    EXPECT_EQ(budget.used(), 750'000u);
  }
  EXPECT_EQ(budget.used(), 0u);
  EXPECT_FALSE(Budget::Share(budget).resize(SIZE_MAX));
}

TEST(Budget, LargeCallsLeaveRoomForSmallOnes) {
  Budget budget(1'000'000);
  Budget::Share large(budget), small(budget);
  EXPECT_TRUE(large.resize(750'000));
  EXPECT_FALSE(budget.has_room(Budget::kSmall + 1));
  EXPECT_TRUE(budget.has_room(Budget::kSmall));
  EXPECT_TRUE(small.resize(Budget::kSmall));
}

TEST(Budget, HoldsForThreadsTogether) {
  Budget budget(100'000);
  std::atomic<std::size_t> most = 0;
  const auto work = [&] {
    for (int i = 0; i < 20'000; ++i) {
      Budget::Share share(budget);
      if (!share.resize(40'000)) continue;
      const auto used = budget.used();
      if (used > most) most = used;
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i) threads.emplace_back(work);
  }
  EXPECT_LE(most, 100'000u);
  EXPECT_EQ(budget.used(), 0u);
}

TEST(Intake, CountsABodyBeforeItIsAllocated) {
  Budget budget(4'000'000);
  const std::string piece(10'000, 'x');
  {
    Intake body(budget, nullptr);
    boost::system::error_code ec;
    while (!ec) {
      ec = body.take(piece);
      EXPECT_LE(body.text.capacity(), std::max<std::size_t>(budget.used(), 15));
    }
    EXPECT_EQ(ec, errc::not_enough_memory);
    EXPECT_LE(budget.used(), 3'000'000u);
    EXPECT_GE(body.text.size(), 1'500'000u);  // doubled, at worst
  }
  EXPECT_EQ(budget.used(), 0u);
}

using IntakeTest = TemporaryFolder;

TEST_F(IntakeTest, KeepsABatchInAFileWithoutAName) {
  Budget budget(1'000'000);
  auto spool = std::make_shared<Spool>(folder_ / "jobs");
  Intake body(budget, spool);
  std::string long_line(100'000, 'a');
  EXPECT_FALSE(body.take("first\n\n" + long_line));
  EXPECT_FALSE(body.take("b\nlast"));
  EXPECT_EQ(body.text, "");
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
  for (int again = 0; again < 2; ++again) {
    auto lines = spool->lines();
    std::string line;
    for (const auto& expected :
         {std::string("first"), std::string(), long_line + 'b', std::string("last")}) {
      EXPECT_TRUE(lines.next(line));
      EXPECT_EQ(line, expected);
    }
    EXPECT_FALSE(lines.next(line));
  }
  EXPECT_EQ(body.take(std::string(800'000, 'x')), errc::no_space_on_device);
}

}  // namespace
}  // namespace turnwright::service::budget_test
