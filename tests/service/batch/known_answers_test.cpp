#include "service/batch/known_answers.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace turnwright::service::known_answers_test {
namespace {

TEST(KnownAnswers, KeepsTheFirstAnswerAndNoErrors) {
  KnownAnswers known;
  EXPECT_FALSE(known.find("a"));
  known.keep("a", {"one", BatchStatus::infeasible});
  known.keep("a", {"two", BatchStatus::ok});
  known.keep("b", {"three", BatchStatus::error});
  ASSERT_TRUE(known.find("a"));
  EXPECT_EQ(known.find("a")->text, "one");
  EXPECT_EQ(known.find("a")->status, BatchStatus::infeasible);
  EXPECT_FALSE(known.find("b"));
}

TEST(KnownAnswers, SpillsToTheDiskAndTakesSeveralThreads) {
  KnownAnswers known;
  const auto text = [](int i) {
    return std::string(20'000, static_cast<char>('a' + i % 26));
  };
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&known, &text, t] {
      for (int i = t; i < 1000; i += 4) known.keep(std::to_string(i), {text(i)});
    });
  for (auto& thread : threads) thread.join();
  for (int i = 0; i < 1000; ++i) {
    const auto found = known.find(std::to_string(i));
    ASSERT_TRUE(found) << i;
    EXPECT_EQ(found->text, text(i));
  }
}

}  // namespace
}  // namespace turnwright::service::known_answers_test
