#include "recipes.hpp"

#include <algorithm>
#include <cmath>

#include "planning/values/most_passes.hpp"

namespace turnwright::planning {
namespace {

using catalogue::Tool;

constexpr std::size_t kMostRecipes = 100'000;  // of a pair of tools

// Numbers of passes.
struct Counts {
  int low = 1, high = 0;
};

// The numbers of passes whose depths, within the tool's range, can add up to `stock`.
Counts counts(const std::optional<int>& given, double least_stock, double most_stock,
              const Tool& t) {
  if (given) return {*given, *given};
  const int low = counted_passes(std::ceil(least_stock / t.ap_mm.upper - 1e-9));
  const int high =
      counted_passes(std::floor(most_stock / catalogue::least_depth_mm(t) + 1e-9));
  return {std::max(1, low), std::min(high, kMostPasses)};
}

// The single pass over stock that is as thin as the least depth of a shoulder, or
// thinner.
Counts counts_alone(const std::optional<int>& given, double stock, const Tool& t) {
  auto c = counts(given, stock, stock, t);
  if (c.low <= kMostPasses) c.high = std::max(c.low, c.high);
  return c;
}

}  // namespace

std::vector<Recipe> recipes(const PreparedPart& p, const MachinedSurface& f,
                            const SurfaceRequest& w, const Tool* rough,
                            const Tool* finish) {
  std::vector<Recipe> all;
  if (w.given && ((w.rough && !rough) || (w.finish && !finish))) return all;
  if (const auto* last = finish ? finish : rough; last && !f.makes_edges(*last))
    return all;
  for (const auto* tool : {rough, finish})
    if (tool && !f.clears_centre(*tool)) return all;
  const auto ranges = cutting::speed_ranges(p.machine).size();
  const auto pieces = [](const Tool* t) {
    return t ? std::max<std::size_t>(t->chip.size(), 1) : 1;
  };
  const auto add = [&](Recipe r) {
    for (std::size_t i = 0; i < (r.rough ? ranges : 1); ++i)
      for (std::size_t j = 0; j < (r.finish ? ranges : 1); ++j)
        for (std::size_t k = 0; k < pieces(r.rough); ++k)
          for (std::size_t l = 0; l < pieces(r.finish); ++l) {
            r.rough_range = i;
            r.finish_range = j;
            r.rough_piece = k;
            r.finish_piece = l;
            all.push_back(r);
          }
  };
  const std::size_t alike = (rough ? ranges * pieces(rough) : 1) *
                            (finish ? ranges * pieces(finish) : 1);  // of each count
  const auto most_of = [&](const Counts& c) {
    const auto counts = std::max<std::size_t>(1, kMostRecipes / alike);
    return std::min(c.high, c.low + static_cast<int>(counts) - 1);
  };
  const bool free = !w.given && !f.is_face();
  const double stock =
      f.is_shoulder() && finish ? catalogue::least_depth_mm(*finish) : f.stock_mm();
  if (finish && (!w.given || !w.rough)) {  // without roughing
    const auto c = counts_alone(w.fixed.finish.passes, stock, *finish);
    const int most = free ? std::min(c.high, kFinishingPasses) : most_of(c);
    for (int n = c.low; n <= most; ++n) add({nullptr, finish, 0, n, 0, 0});
  }
  if (rough && finish) {
    const int first = w.fixed.finish.passes.value_or(1);
    const int last = w.fixed.finish.passes.value_or(free ? kFinishingPasses : 1);
    for (int nf = first; nf <= last; ++nf) {
      const auto c = counts(w.fixed.rough.passes, stock - nf * finish->ap_mm.upper,
                            stock - nf * catalogue::least_depth_mm(*finish), *rough);
      for (int n = c.low; n <= most_of(c); ++n) add({rough, finish, n, nf, 0, 0});
    }
  }
  if (rough && !finish && w.given) {
    const auto c = counts_alone(w.fixed.rough.passes, stock, *rough);
    for (int n = c.low; n <= most_of(c); ++n) add({rough, nullptr, n, 0, 0, 0});
  }
  return all;
}

}  // namespace turnwright::planning
