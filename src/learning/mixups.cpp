#include "turnwright/learning/mixups.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "median.hpp"

namespace turnwright::learning {
namespace {

constexpr double kInch_mm = 25.4, kThousand = 1000;

struct Explanation {
  MixUp kind;
  bool of_form;  ///< also of form and place
  double (*meant)(double y, double nominal);
};
constexpr std::array<Explanation, 9> kExplanations{{
    {MixUp::inch, true, [](double y, double) { return kInch_mm * y; }},
    {MixUp::inch_twice, true, [](double y, double) { return y / kInch_mm; }},
    {MixUp::micrometre, true, [](double y, double) { return y / kThousand; }},
    {MixUp::metre, true, [](double y, double) { return kThousand * y; }},
    {MixUp::radius, false, [](double y, double) { return 2 * y; }},
    {MixUp::diameter, false, [](double y, double) { return y / 2; }},
    {MixUp::sign, false, [](double y, double) { return -y; }},
    {MixUp::deviation, false, [](double y, double nominal) { return nominal + y; }},
    {MixUp::deviation_sign, false, [](double y, double nominal) { return nominal - y; }},
}};

// The explanation that brings y nearest to the mean, and within reach of it.
std::optional<MixUp> nearest(double y, double nominal, double mean, double reach) {
  std::optional<MixUp> best;
  for (const auto& e : kExplanations) {
    if (nominal == 0 && !e.of_form) continue;
    const double off = std::abs(e.meant(y, nominal) - mean);
    if (!(off <= reach)) continue;
    reach = off;
    best = e.kind;
  }
  return best;
}

constexpr double kBelongs = 6;  // standard deviations

bool belongs(double y, const Expected& e) {
  return std::abs(y - e.mean_mm) <= kBelongs * e.s_mm;
}

void name_swaps(std::span<const Suspect> suspects, std::span<const Expected> expected,
                std::vector<Named>& named) {
  for (std::size_t i = 0; i < suspects.size(); ++i)
    for (std::size_t j = i + 1; j < suspects.size(); ++j) {
      const Suspect &a = suspects[i], &b = suspects[j];
      if (a.part != b.part || named[i].with || named[j].with) continue;
      if (!belongs(a.y_mm, expected[b.characteristic]) ||
          !belongs(b.y_mm, expected[a.characteristic]))
        continue;
      named[i] = {MixUp::swapped, b.characteristic};
      named[j] = {MixUp::swapped, a.characteristic};
    }
}

}  // namespace

std::vector<Named> mix_ups(std::span<const Suspect> suspects,
                           std::span<const Expected> expected) {
  std::vector<Named> named(suspects.size());
  name_swaps(suspects, expected, named);
  for (std::size_t i = 0; i < suspects.size(); ++i) {
    if (named[i].with) continue;
    const Expected& e = expected[suspects[i].characteristic];
    double reach = kBelongs * e.s_mm;
    if (e.nominal_mm == 0) reach = std::min(reach, std::abs(e.mean_mm) / 2);
    if (e.nominal_mm != 0 && reach > 0.1 * std::abs(e.nominal_mm)) continue;
    if (const auto kind = nearest(suspects[i].y_mm, e.nominal_mm, e.mean_mm, reach))
      named[i].kind = *kind;
  }
  return named;
}

std::optional<MixUp> mix_up_of_all(const Series& series, const Limits& limits,
                                   double nominal_mm) {
  if (!limits.lower_mm || nominal_mm == 0 || series.empty()) return std::nullopt;
  std::vector<double> y;
  for (const auto& o : series) y.push_back(o.y_mm);
  const double middle = (limits.upper_mm + *limits.lower_mm) / 2,
               width = limits.upper_mm - *limits.lower_mm, m = median(y);
  if (std::abs(m - middle) <= 2 * width) return std::nullopt;
  return nearest(m, nominal_mm, middle, width);
}

}  // namespace turnwright::learning
