#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <queue>
#include <set>
#include <utility>
#include <vector>

#include "turnwright/catalogue/tool.hpp"

/// All choices of the tools of a setup, which are too many to list: a workshop of 150 inserts
/// has millions for a bush.
namespace turnwright::planning {

/// The tools of a setup, one for each use.
struct Tools {
  const catalogue::Tool *face = nullptr, *rough = nullptr, *finish = nullptr;
  const catalogue::Tool *bore_rough = nullptr, *bore_finish = nullptr;
};

/// The members of Tools, in the order of the lists below.
inline constexpr std::array kToolMembers{&Tools::face, &Tools::rough, &Tools::finish,
                                         &Tools::bore_rough, &Tools::bore_finish};

/// The tools that may be chosen for a use; nullptr: none, or that of the request.
using ToolList = std::vector<const catalogue::Tool*>;

/// Every combination of a tool for each use, numbered from 0 with bore_finish running
/// fastest.
class ToolChoices {
 public:
  /// Uses whose tools decide together what surfaces cost: outside, and in bores.
  static constexpr std::size_t kGroups = 2;

  using Lists = std::array<ToolList, kToolMembers.size()>;

  ToolChoices() = default;
  explicit ToolChoices(Lists lists) : lists_(std::move(lists)) {}

  static constexpr std::size_t group_of(std::size_t list) { return list < 3 ? 0 : 1; }

  std::size_t size() const { return size(0) * size(1); }
  /// Number of choices for the uses of a group.
  std::size_t size(std::size_t group) const;
  /// The tools of one choice for a group, those of the other uses nullptr.
  Tools of_group(std::size_t group, std::size_t choice) const;
  /// The number of a choice with these choices of the groups.
  std::size_t number(const std::array<std::size_t, kGroups>& groups) const;
  Tools operator[](std::size_t number) const;

  const Lists& lists() const { return lists_; }

 private:
  Lists lists_ = {};
};

/// The choices with one tool alone in a list.
ToolChoices with_only(const ToolChoices& choices, std::size_t list,
                      const catalogue::Tool* tool);

/// Choices with as many different tools, at least and at most, as all of them: of the tools
/// that stand in the same lists, the first as many as there are lists.  Tools of `apart` are
/// kept too.
ToolChoices few_alike(const ToolChoices& choices,
                      const std::set<const catalogue::Tool*>& apart);

/// Choices in the order of their objective, the number of a choice deciding between equals.
/// It is at least the sum of `floor` and one term for each group: choices are drawn by that
/// sum, and given out once no other can be less.  Objectives may rise in the meantime.
class CheapestFirst {
 public:
  /// The choices of a group: term and number.
  using Terms = std::vector<std::pair<double, std::size_t>>;
  using AllTerms = std::array<Terms, ToolChoices::kGroups>;
  /// A choice's objective; none if it is not allowed.
  using Objective = std::function<std::optional<double>(std::size_t number)>;

  /// @param terms  infinite ones are left out
  CheapestFirst(const ToolChoices& choices, AllTerms terms, double floor,
                Objective objective);

  /// The next choice with its objective.
  std::optional<std::pair<double, std::size_t>> next();

 private:
  using Places = std::array<std::size_t, ToolChoices::kGroups>;
  template <class T>
  using Least = std::priority_queue<T, std::vector<T>, std::greater<T>>;

  void push(const Places& places);
  void draw();

  const ToolChoices& choices_;
  AllTerms terms_;  // in ascending order
  double floor_;
  Objective objective_;
  Least<std::pair<double, Places>> drawn_next_;
  Least<std::pair<double, std::size_t>> ready_;
};

}  // namespace turnwright::planning
