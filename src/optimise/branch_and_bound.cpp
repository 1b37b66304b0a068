#include "turnwright/optimise/branch_and_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace turnwright::optimise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-11;  // see Interval: arithmetic is not rounded outwards

struct Node {
  double lower = -kInfinity;  // of f over the box
  long birth = 0;
  std::size_t piece = 0;
  Box box;
};
struct Later {
  bool operator()(const Node& a, const Node& b) const {
    return a.lower != b.lower ? a.lower > b.lower : a.birth > b.birth;
  }
};

Box middle(const Box& box) {
  Box c;
  for (std::size_t j = 0; j < box.size(); ++j) c[j] = Interval(mid(box[j]));
  return c;
}

// Enclosures of f, the constraints and the combinations over a box, and their values at
// its middle; index 0 is f, then g, then the combinations (without their cut).
class Functions {
 public:
  void evaluate(const Piece& piece, const Box& box) {
    box_ = box;
    take(piece, box, over_);
    take(piece, middle(box), at_middle_);
    lower_.resize(over_.size());
    for (std::size_t k = 0; k < over_.size(); ++k) lower_[k] = least(k);
  }
  std::size_t size() const { return over_.size(); }
  double lower(std::size_t k) const { return lower_[k]; }

  // Narrows the box to where function k can be <= limit; false if nowhere.
  bool narrow(std::size_t k, double limit, Box& box) const {
    const Box c = middle(box_);
    std::array<double, kBoxVariables> least{};
    double sum = at_middle_[k].v.lo;
    for (std::size_t j = 0; j < box_.size(); ++j) {
      least[j] = (over_[k].d[j] * (box_[j] - c[j])).lo;
      sum += least[j];
    }
    if (!std::isfinite(sum)) return true;
    for (std::size_t j = 0; j < box.size(); ++j) {
      const double rest =
          limit + kRounding - (sum - least[j]);  // H_j (y_j - c_j) <= rest
      const Interval H = over_[k].d[j];
      const double m = c[j].lo;
      if (H.lo > 0)
        box[j].hi = std::min(box[j].hi, m + (rest >= 0 ? rest / H.lo : rest / H.hi));
      else if (H.hi < 0)
        box[j].lo = std::max(box[j].lo, m + (rest >= 0 ? rest / H.hi : rest / H.lo));
      else if (rest < 0)  // both signs: a gap in the middle, kept as it is
        continue;
      if (box[j].lo > box[j].hi) return false;
    }
    return true;
  }

  // How much the functions move along variable j.
  double sweep(std::size_t j) const {
    double s = 0;
    for (std::size_t k = 0; k < over_.size(); ++k) {
      const Interval& d = over_[k].d[j];
      const double move = std::max(std::abs(d.lo), std::abs(d.hi)) * width(box_[j]);
      s = std::max(s, std::isfinite(move) ? move : width(box_[j]));
    }
    return s;
  }

 private:
  void take(const Piece& piece, const Box& box, std::vector<Bound>& out) {
    piece.bound(box, f_, g_);
    out.clear();
    out.push_back(f_);
    out.insert(out.end(), g_.begin(), g_.end());
    for (const auto& c : piece.combinations) {
      Bound sum = f_ * c.weight;
      for (std::size_t i = 0; i < g_.size(); ++i)
        if (c.multipliers[i] > 0) sum = sum + g_[i] * c.multipliers[i];
      out.push_back(sum);
    }
  }
  double least(std::size_t k) const {
    Interval form = at_middle_[k].v;
    for (std::size_t j = 0; j < box_.size(); ++j)
      form = form + over_[k].d[j] * (box_[j] - Interval(mid(box_[j])));  // Eq. (1)
    return form.lo > over_[k].v.lo ? form.lo : over_[k].v.lo;
  }

  Box box_;
  Bound f_;
  std::vector<Bound> g_, over_, at_middle_;
  std::vector<double> lower_;
};

class Search {
 public:
  Search(std::vector<Piece>& pieces, double incumbent, const SearchOptions& options)
      : pieces_(pieces), options_(options) {
    result_.upper_bound = incumbent;
    result_.piece_bounds.assign(pieces.size(), kInfinity);
  }

  SearchResult run() {
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      queue_.push({-kInfinity, births_++, p, pieces_[p].box});
    while (!queue_.empty() && result_.nodes < options_.max_nodes) {
      Node node = queue_.top();
      queue_.pop();
      if (node.lower >= cut())
        settle(node.piece, node.lower);
      else
        expand(node);
    }
    result_.complete = queue_.empty();
    for (; !queue_.empty(); queue_.pop()) settle(queue_.top().piece, queue_.top().lower);
    result_.lower_bound = kInfinity;
    for (double& b : result_.piece_bounds) {
      b = std::min(b, cut());
      result_.lower_bound = std::min(result_.lower_bound, b);
    }
    return result_;
  }

 private:
  double cut() const { return result_.upper_bound - options_.gap; }
  double limit(const Piece& piece, std::size_t k) const {
    if (k == 0) return cut();
    const std::size_t c = k - 1 - piece.constraints;
    if (k <= piece.constraints || piece.combinations[c].weight == 0) return 0;
    return cut() * piece.combinations[c].weight;
  }
  void settle(std::size_t piece, double bound) {
    auto& b = result_.piece_bounds[piece];
    b = std::min(b, bound);
  }

  // Drops the node, or narrows it and puts its halves into the queue.
  void expand(Node& node) {
    const auto& piece = pieces_[node.piece];
    for (int round = 0; round < kNarrowings; ++round) {
      ++result_.nodes;
      functions_.evaluate(piece, node.box);
      node.lower = std::max(node.lower, functions_.lower(0));
      const double before = size(node.box);
      for (std::size_t k = 0; k < functions_.size(); ++k) {
        const double most = limit(piece, k);
        if (functions_.lower(k) > most + kRounding ||
            (std::isfinite(most) && !functions_.narrow(k, most, node.box)))
          return settle(node.piece, cut());  // holds nothing feasible below the cut
      }
      if (size(node.box) > kWorthwhile * before) break;
    }
    if (piece.try_point)
      result_.upper_bound = std::min(result_.upper_bound, piece.try_point(node.box));
    halve(node);
  }

  void halve(const Node& node) {
    std::size_t widest = 0;
    for (std::size_t j = 1; j < node.box.size(); ++j)
      if (functions_.sweep(j) > functions_.sweep(widest)) widest = j;
    const double m = mid(node.box[widest]);
    if (!(width(node.box[widest]) > 1e-12))  // below rounding: nothing left to split
      return settle(node.piece, node.lower);
    Node left = node, right = node;
    left.box[widest].hi = m;
    right.box[widest].lo = m;
    left.birth = births_++;
    right.birth = births_++;
    queue_.push(left);
    queue_.push(right);
  }

  static double size(const Box& box) {
    double s = 0;
    for (const auto& x : box) s += width(x);
    return s;
  }

  static constexpr int kNarrowings = 4;       // repeats of (1) before halving
  static constexpr double kWorthwhile = 0.8;  // repeat while the box shrinks below this
  std::vector<Piece>& pieces_;
  SearchOptions options_;
  SearchResult result_;
  std::priority_queue<Node, std::vector<Node>, Later> queue_;
  long births_ = 0;
  Functions functions_;
};

}  // namespace

SearchResult branch_and_bound(std::vector<Piece>& pieces, double incumbent,
                              const SearchOptions& options) {
  return Search(pieces, incumbent, options).run();
}

}  // namespace turnwright::optimise
