#include "turnwright/optimise/branch_and_bound.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/interval.hpp"

namespace turnwright::optimise {
namespace {

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

// Enclosures of f, the constraints and the combinations over a box with their gradients,
// and their values at the best centre c of each; index 0 is f, then g, then the
// combinations (without their cut).
class Functions {
 public:
  // False if nothing in the box is feasible and below the cut.
  bool evaluate(const Piece& piece, const Box& box, double cut) {
    piece_ = &piece;
    box_ = box;
    if (!piece.bound(box, cut, f_, g_)) return false;
    gather(f_, g_, over_);
    for (auto& v : at_) v.clear();
    lower_.resize(over_.size());
    for (std::size_t k = 0; k < over_.size(); ++k) lower_[k] = over_[k].v.lo;
    return true;
  }
  std::size_t size() const { return over_.size(); }
  bool excluded(std::size_t k, double limit) const { return excludes(over_[k], limit); }
  double upper(std::size_t k) const { return over_[k].v.hi; }

  // Lower bound by (1) or by the natural extension.
  double lower(std::size_t k) { return std::max(lower_[k], sum(terms(k))); }

  // Narrows the box to where function k can be <= limit; false if nowhere.
  bool narrow(std::size_t k, double limit, Box& box) {
    const Terms t = terms(k);
    const double least = sum(t);
    if (!std::isfinite(least)) return true;
    for (std::size_t j = 0; j < box.size(); ++j) {
      const double rest =
          limit + kBoxRounding - (least - t.least[j]);  // H (y - c) <= rest
      const Interval H = over_[k].d[j];
      if (H.lo > 0)
        box[j].hi =
            std::min(box[j].hi, t.centre[j] + (rest >= 0 ? rest / H.lo : rest / H.hi));
      else if (H.hi < 0)
        box[j].lo =
            std::max(box[j].lo, t.centre[j] + (rest >= 0 ? rest / H.hi : rest / H.lo));
      if (box[j].lo > box[j].hi) return false;
    }
    return true;
  }

  // The change of the functions along variable j.
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
  // Eq. (1) of one function: its centre, the value there and the least of each term.
  struct Terms {
    Point centre{};
    double value = 0;
    std::array<double, kBoxVariables> least{};
  };
  static double sum(const Terms& t) {
    double s = t.value;
    for (const double x : t.least) s += x;
    return s;
  }

  Terms terms(std::size_t k) {
    Terms t;
    std::size_t code = 0;
    for (std::size_t j = 0; j < box_.size(); ++j) {
      const Interval& H = over_[k].d[j];
      const bool rises = H.lo >= 0, falls = H.hi <= 0;
      t.centre[j] = rises ? box_[j].lo : falls ? box_[j].hi : mid(box_[j]);
      code = 3 * code + (rises ? 0 : falls ? 1 : 2);
      const double half = width(box_[j]) / 2;
      if (!rises && !falls && half > 0) t.least[j] = half * std::min(H.lo, -H.hi);
    }
    t.value = values_at(code, t.centre)[k];
    return t;
  }

  const std::vector<double>& values_at(std::size_t code, const Point& centre) {
    auto& v = at_[code];
    if (v.empty()) {
      double f = 0;
      piece_->value(centre, f, values_);
      gather(f, values_, v);
    }
    return v;
  }

  template <class T>
  void gather(const T& f, const std::vector<T>& g, std::vector<T>& all) const {
    const auto n = piece_->constraints;
    all.assign(1, f);
    all.insert(all.end(), g.begin(), g.begin() + static_cast<std::ptrdiff_t>(n));
    for (const auto& c : piece_->combinations) {
      T sum = (g.size() > n ? g[n] : f) * c.weight;
      for (std::size_t i = 0; i < n; ++i)
        if (c.multipliers[i] > 0) sum = sum + g[i] * c.multipliers[i];
      all.push_back(sum);
    }
  }

  const Piece* piece_ = nullptr;
  Box box_;
  Bound f_;
  std::vector<Bound> g_, over_;
  std::vector<double> lower_, values_;
  std::array<std::vector<double>, 27> at_;  // by the choice of lower, upper, middle
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
      leave_if_asked();
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
      if (!functions_.evaluate(piece, node.box, cut())) return settle(node.piece, cut());
      const double before = size(node.box);
      for (std::size_t k = 0; k < functions_.size(); ++k)
        if (functions_.excluded(k, limit(piece, k)))
          return settle(node.piece, cut());  // holds nothing feasible below the cut
      node.lower = std::max(node.lower, functions_.lower(0));
      for (std::size_t k = 0; k < functions_.size(); ++k) {
        const double most = limit(piece, k) + kBoxRounding;
        if (!std::isfinite(most) || functions_.upper(k) <= most) continue;
        if (functions_.lower(k) > most || !functions_.narrow(k, most, node.box))
          return settle(node.piece, cut());
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
    if (!(width(node.box[widest]) > 1e-10))  // below rounding: nothing left to split
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
