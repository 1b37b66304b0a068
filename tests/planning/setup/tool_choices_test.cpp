// Choices of tools beside a list of all of them.
#include "planning/setup/tool_choices.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

namespace turnwright::planning {
namespace {

using catalogue::Tool;
using Given = std::vector<std::pair<double, std::size_t>>;

/// Tools of no other meaning than to differ.
const std::vector<Tool>& tools() {
  static const std::vector<Tool> all(40);
  return all;
}

ToolChoices random_choices(std::mt19937& random) {
  ToolChoices::Lists lists;
  for (auto& list : lists) {
    for (const auto& tool : tools())
      if (random() % 8 == 0) list.push_back(&tool);
    if (list.empty() || random() % 2 == 0) list.push_back(nullptr);
  }
  return ToolChoices(std::move(lists));
}

TEST(ToolChoices, AreNumberedWithTheLastListFastest) {
  const auto* t = tools().data();
  const ToolChoices choices(
      {ToolList{t}, {t + 1, t + 2}, {t + 3}, {nullptr}, {t + 4, t + 5}});
  ASSERT_EQ(choices.size(), 4u);
  EXPECT_EQ(choices[1].bore_finish, t + 5);
  EXPECT_EQ(choices[1].rough, t + 1);
  EXPECT_EQ(choices[2].rough, t + 2);
  EXPECT_EQ(choices[3].face, t);
  EXPECT_EQ(choices[3].bore_rough, nullptr);
  EXPECT_EQ(choices.number({1, 0}), 2u);
}

/// Random terms, some infinite, and objectives of every choice that are not below their sum;
/// some choices are not allowed.
struct RandomObjectives {
  explicit RandomObjectives(unsigned seed)
      : random(seed), choices(random_choices(random)) {
    std::uniform_real_distribution<double> between(0, 1);
    for (std::size_t g = 0; g < terms.size(); ++g)
      for (std::size_t i = 0; i < choices.size(g); ++i)
        terms[g].emplace_back(
            random() % 10 ? between(random) : std::numeric_limits<double>::infinity(), i);
    for (std::size_t i = 0; i < choices.size(); ++i) {
      const double sum = floor + terms[0][i / choices.size(1)].first +
                         terms[1][i % choices.size(1)].first;
      objectives.push_back(sum + (random() % 3 ? between(random) : 0));
      allowed.push_back(random() % 4 > 0);
    }
  }

  CheapestFirst cheapest_first() {
    return {choices, terms, floor, [this](std::size_t i) {
              return allowed[i] ? std::optional(objectives[i]) : std::nullopt;
            }};
  }
  Given listed() const {
    Given all;
    for (std::size_t i = 0; i < objectives.size(); ++i)
      if (allowed[i] && std::isfinite(objectives[i])) all.emplace_back(objectives[i], i);
    std::ranges::sort(all);
    return all;
  }

  std::mt19937 random;
  ToolChoices choices;
  double floor = 0.5;
  CheapestFirst::AllTerms terms;
  std::vector<double> objectives;
  std::vector<bool> allowed;
};

TEST(CheapestFirst, GivesChoicesInTheOrderOfAList) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    RandomObjectives some(seed);
    auto search = some.cheapest_first();
    Given given;
    while (const auto next = search.next()) given.push_back(*next);
    EXPECT_EQ(given, some.listed()) << seed;
  }
}

TEST(CheapestFirst, PutsBackAChoiceWhoseObjectiveHasRisen) {
  for (unsigned seed = 20; seed < 30; ++seed) {
    RandomObjectives some(seed);
    auto search = some.cheapest_first();
    const auto first = search.next();
    if (!first) continue;
    for (std::size_t i = 0; i < some.objectives.size(); i += 3) some.objectives[i] += 0.3;
    auto wanted = some.listed();
    std::erase_if(wanted, [&](const auto& one) { return one.second == first->second; });
    Given given;
    while (const auto next = search.next()) given.push_back(*next);
    EXPECT_EQ(given, wanted) << seed;
  }
}

std::pair<std::size_t, std::size_t> fewest_and_most(const ToolChoices& choices) {
  std::size_t fewest = 99, most = 0;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    std::set<const Tool*> used;
    for (const auto member : kToolMembers)
      if (const auto* tool = choices[i].*member) used.insert(tool);
    fewest = std::min(fewest, used.size());
    most = std::max(most, used.size());
  }
  return {fewest, most};
}

TEST(FewAlike, UseAsFewAndAsManyToolsAsAll) {
  std::mt19937 random(1);
  for (int k = 0; k < 30; ++k) {
    const auto all = random_choices(random);
    EXPECT_EQ(fewest_and_most(few_alike(all, {})), fewest_and_most(all)) << k;
  }
}

TEST(FewAlike, StayFewHoweverManyToolsThereAre) {
  ToolList all;
  for (const auto& tool : tools()) all.push_back(&tool);
  const ToolChoices choices({all, all, all, all, all});
  EXPECT_EQ(few_alike(choices, {}).size(), 3125u);
  const std::set<const Tool*> apart{&tools()[20]};
  EXPECT_EQ(few_alike(choices, apart).size(), 7776u);
}

}  // namespace
}  // namespace turnwright::planning
