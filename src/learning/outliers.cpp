#include "turnwright/learning/outliers.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "median.hpp"
#include "turnwright/base/distributions.hpp"
#include "within.hpp"

namespace turnwright::learning {
namespace {

std::vector<std::size_t> gross(const Series& series) {
  constexpr double kFactor = 8 * 1.4826;
  std::vector<double> y, off;
  for (const auto& o : series) y.push_back(o.y_mm - o.offset_mm);
  const double middle = median(y);
  for (const double value : y) off.push_back(std::abs(value - middle));
  const double reach = kFactor * median(off);
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < off.size(); ++i)
    if (reach > 0 && off[i] > reach) all.push_back(i);
  return all;
}

struct Extreme {
  std::size_t row = 0;
  double t = 0;         ///< (1), absolute
  double critical = 0;  ///< (2)
};

std::optional<Extreme> most_extreme(const Series& series, double p) {
  Table table = table_of(series, false);
  Within w = within_fit(table);
  if (w.degrees < kLeastDegrees) {
    table = table_of(series, true);
    w = within_fit(table);
  }
  if (w.degrees < kLeastDegrees || !(w.rss > 0)) return std::nullopt;
  constexpr double kFree = 1e-9;  // a value alone on its edge has no residual
  Extreme e;
  for (Eigen::Index i = 0; i < w.residual.size(); ++i) {
    const double free = 1 - w.leverage[i], r = w.residual[i];
    if (free < kFree) continue;
    const double rest = std::max(w.rss * free - r * r, 1e-12 * w.rss * free);
    const double t = std::abs(r) * std::sqrt((w.degrees - 1) / rest);
    if (t > e.t) e = {static_cast<std::size_t>(i), t, 0};
  }
  e.critical =
      student_upper_quantile(p / (2 * static_cast<double>(series.size())), w.degrees - 1);
  return e;
}

}  // namespace

Series without(const Series& series, const std::vector<std::size_t>& left_out) {
  Series rest;
  for (std::size_t i = 0; i < series.size(); ++i)
    if (!std::ranges::binary_search(left_out, i)) rest.push_back(series[i]);
  return rest;
}

std::vector<std::size_t> outliers(const Series& series, double p) {
  constexpr std::size_t kMost = 20, kShare = 10;
  if (!(p > 0) || series.empty()) return {};
  auto named = gross(series);
  std::vector<std::size_t> rows(series.size());
  std::iota(rows.begin(), rows.end(), 0);
  std::erase_if(rows, [&](auto i) { return std::ranges::binary_search(named, i); });
  Series rest = without(series, named);
  std::vector<std::size_t> suspects;
  std::size_t sure = 0;
  for (auto k = std::clamp<std::size_t>(rest.size() / kShare, 1, kMost); k > 0; --k) {
    const auto e = most_extreme(rest, p);
    if (!e) break;
    suspects.push_back(rows[e->row]);
    if (e->t > e->critical) sure = suspects.size();
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(e->row));
    rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(e->row));
  }
  named.insert(named.end(), suspects.begin(),
               suspects.begin() + static_cast<std::ptrdiff_t>(sure));
  std::ranges::sort(named);
  return named;
}

}  // namespace turnwright::learning
