#include "turnwright/optimise/relaxation_search.hpp"

#include <algorithm>
#include <queue>

#include "turnwright/base/interval.hpp"

namespace turnwright::optimise {
namespace {

constexpr double kNarrow = 1e-12;  // a box that rounding keeps from being split
constexpr double kEdge = 0.1;      // no part is smaller than this share of its box

struct OpenBox {
  double lower = -kInfinity;
  long birth = 0;
  Box box;
};
struct HigherBound {
  bool operator()(const OpenBox& a, const OpenBox& b) const {
    return a.lower != b.lower ? a.lower > b.lower : a.birth > b.birth;
  }
};

}  // namespace

SearchResult relaxation_search(
    const Box& box, double incumbent,
    const std::function<Relaxed(const Box&, double cut)>& relax,
    const SearchOptions& options) {
  SearchResult result;
  result.upper_bound = incumbent;
  result.complete = true;
  double settled = kInfinity;
  const auto cut = [&] { return result.upper_bound - options.gap; };
  std::priority_queue<OpenBox, std::vector<OpenBox>, HigherBound> queue;
  long births = 0;
  queue.push({-kInfinity, births++, box});
  while (!queue.empty() && queue.top().lower < cut()) {
    if (result.nodes == options.max_nodes) {
      result.complete = false;
      break;
    }
    const OpenBox node = queue.top();
    queue.pop();
    ++result.nodes;
    const Relaxed r = relax(node.box, cut());
    result.upper_bound = std::min(result.upper_bound, r.upper);
    const double lower = std::max(node.lower, r.lower);
    const Interval side = node.box[r.split];
    if (!(lower < cut()) || !(width(side) > kNarrow)) {
      settled = std::min(settled, lower);
      continue;
    }
    const double margin = kEdge * width(side);
    const double at = std::clamp(r.at, side.lo + margin, side.hi - margin);
    OpenBox left{lower, births++, node.box}, right{lower, births++, node.box};
    left.box[r.split].hi = at;
    right.box[r.split].lo = at;
    queue.push(left);
    queue.push(right);
  }
  result.lower_bound = queue.empty() ? settled : std::min(settled, queue.top().lower);
  return result;
}

}  // namespace turnwright::optimise
