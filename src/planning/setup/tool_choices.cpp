#include "tool_choices.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace turnwright::planning {

using catalogue::Tool;

std::size_t ToolChoices::size(std::size_t group) const {
  return group == 0 ? lists_[0].size() * lists_[1].size() * lists_[2].size()
                    : lists_[3].size() * lists_[4].size();
}

Tools ToolChoices::of_group(std::size_t group, std::size_t choice) const {
  const auto last = [&](std::size_t list) {
    const auto& tools = lists_[list];
    return tools[std::exchange(choice, choice / tools.size()) % tools.size()];
  };
  Tools tools;
  if (group == 0) {
    tools.finish = last(2);
    tools.rough = last(1);
    tools.face = last(0);
  } else {
    tools.bore_finish = last(4);
    tools.bore_rough = last(3);
  }
  return tools;
}

std::size_t ToolChoices::number(const std::array<std::size_t, kGroups>& groups) const {
  return groups[0] * size(1) + groups[1];
}

Tools ToolChoices::operator[](std::size_t number) const {
  auto tools = of_group(0, number / size(1));
  const auto bores = of_group(1, number % size(1));
  tools.bore_rough = bores.bore_rough;
  tools.bore_finish = bores.bore_finish;
  return tools;
}

ToolChoices with_only(const ToolChoices& choices, std::size_t list, const Tool* tool) {
  auto lists = choices.lists();
  lists[list] = {tool};
  return ToolChoices(std::move(lists));
}

ToolChoices few_alike(const ToolChoices& choices, const std::set<const Tool*>& apart) {
  using In = std::array<bool, kToolMembers.size()>;
  std::map<const Tool*, In> in;
  for (std::size_t i = 0; i < kToolMembers.size(); ++i)
    for (const auto* tool : choices.lists()[i]) in[tool][i] = true;
  auto lists = choices.lists();
  for (auto& list : lists) {
    std::map<In, std::size_t> kept;
    std::erase_if(list, [&](const Tool* tool) {
      return tool && !apart.contains(tool) && ++kept[in.at(tool)] > kToolMembers.size();
    });
  }
  return ToolChoices(std::move(lists));
}

CheapestFirst::CheapestFirst(const ToolChoices& choices, AllTerms terms, double floor,
                             Objective objective)
    : choices_(choices),
      terms_(std::move(terms)),
      floor_(floor),
      objective_(std::move(objective)) {
  for (auto& group : terms_) {
    std::erase_if(group, [](const auto& term) { return !std::isfinite(term.first); });
    std::ranges::sort(group);
  }
  push({});
}

void CheapestFirst::push(const Places& places) {
  double sum = floor_;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (places[k] >= terms_[k].size()) return;
    sum += terms_[k][places[k]].first;
  }
  drawn_next_.emplace(sum, places);
}

// Each combination of places is pushed once: by the one before it in the first group that is
// not at its beginning.
void CheapestFirst::draw() {
  const auto places = drawn_next_.top().second;
  drawn_next_.pop();
  for (std::size_t k = 0; k < places.size(); ++k) {
    auto next = places;
    ++next[k];
    push(next);
    if (places[k] > 0) break;
  }
  std::array<std::size_t, ToolChoices::kGroups> groups{};
  for (std::size_t k = 0; k < places.size(); ++k) groups[k] = terms_[k][places[k]].second;
  const auto number = choices_.number(groups);
  if (const auto objective = objective_(number)) ready_.emplace(*objective, number);
}

std::optional<std::pair<double, std::size_t>> CheapestFirst::next() {
  constexpr double kRounding = 1e-12;  // of the sums, relative
  while (true) {
    const auto may_be_less = [this] {
      const double least = ready_.top().first;
      return drawn_next_.top().first <= least + kRounding * std::abs(least);
    };
    while (!drawn_next_.empty() && (ready_.empty() || may_be_less())) draw();
    if (ready_.empty()) return std::nullopt;
    const auto least = ready_.top();
    ready_.pop();
    const auto now = objective_(least.second);
    if (now == least.first) return least;
    if (now) ready_.emplace(*now, least.second);
  }
}

}  // namespace turnwright::planning
