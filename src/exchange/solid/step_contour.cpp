#include "step_contour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "base/say.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::exchange {
namespace {

constexpr std::size_t kMostSides = 5000;  // a turned part has some hundred
constexpr double kRound_rad = 2 * std::numbers::pi / 3;

[[noreturn]] void refuse(Id face, std::string got, std::string expected) {
  throw InputError("STEP file",
                   {{name_of(face), std::move(got), std::move(expected), "not-turned"}});
}

bool on_axis(const Point& p) { return p.r_mm < kSame_mm; }

std::string place(const Point& p) {
  return fmt::format("z = {:.6g}, r = {:.6g} mm", p.z_mm, p.r_mm);
}

/// Sides as arcs of a directed graph whose nodes are the places where they meet.
class Graph {
 public:
  Graph(const std::vector<Face>& faces, std::vector<TurnedSide> sides)
      : faces_(faces), sides_(std::move(sides)) {
    find_nodes();
    out_.resize(nodes_), in_.resize(nodes_), axis_.resize(nodes_);
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      out_[from_[i]].insert(i), in_[to_[i]].insert(i);
      axis_[from_[i]] = axis_[from_[i]] || on_axis(sides_[i].from);
      axis_[to_[i]] = axis_[to_[i]] || on_axis(sides_[i].to);
    }
  }

  std::vector<TurnedSide> chain() {
    const auto open = largest_open();
    prune();
    std::vector<std::size_t> starts;
    std::size_t left = 0;
    for (std::size_t node = 0; node < nodes_; ++node) {
      left += out_[node].size();
      if (axis_[node]) starts.insert(starts.end(), out_[node].begin(), out_[node].end());
    }
    if (left == 0) refuse_open(open);
    std::vector<TurnedSide> chain;
    for (auto at = starts.empty() ? leftmost() : starts[0];;) {
      chain.push_back(sides_[at]);
      const auto node = to_[at];
      out_[from_[at]].erase(at);
      if (axis_[node] || out_[node].empty()) break;
      if (out_[node].size() > 1) refuse_branch(node);
      at = *out_[node].begin();
    }
    if (chain.size() < left) refuse_hollow();
    return chain;
  }

 private:
  /// Ends closer than kSame_mm along z and r are one node.
  void find_nodes() {
    const auto n = sides_.size();
    std::vector<std::size_t> order(2 * n), node(2 * n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto point = [&](std::size_t i) {
      return i < n ? sides_[i].from : sides_[i - n].to;
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return point(a).z_mm < point(b).z_mm;
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
      const auto p = point(order[i]);
      node[order[i]] = nodes_;
      for (std::size_t j = i; j-- > 0;) {
        const auto q = point(order[j]);
        if (p.z_mm - q.z_mm >= kSame_mm) break;
        if (std::abs(p.r_mm - q.r_mm) < kSame_mm) node[order[i]] = node[order[j]];
      }
      if (node[order[i]] == nodes_) ++nodes_;
    }
    from_.assign(node.begin(), node.begin() + static_cast<std::ptrdiff_t>(n));
    to_.assign(node.begin() + static_cast<std::ptrdiff_t>(n), node.end());
  }

  bool open_before(std::size_t i) const {
    return !axis_[from_[i]] && in_[from_[i]].empty();
  }
  bool open_behind(std::size_t i) const { return !axis_[to_[i]] && out_[to_[i]].empty(); }

  void prune() {
    std::vector<std::size_t> look(sides_.size());
    std::iota(look.begin(), look.end(), std::size_t{0});
    while (!look.empty()) {
      const auto i = look.back();
      look.pop_back();
      if (!out_[from_[i]].count(i) || (!open_before(i) && !open_behind(i))) continue;
      out_[from_[i]].erase(i), in_[to_[i]].erase(i);
      look.insert(look.end(), in_[from_[i]].begin(), in_[from_[i]].end());
      look.insert(look.end(), out_[to_[i]].begin(), out_[to_[i]].end());
    }
  }

  /// Of the sides with an open end the one that tells most: the largest.
  std::size_t largest_open() const {
    std::size_t open = sides_.size();
    double most = 0;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const auto& s = sides_[i];
      const double size =
          std::hypot(s.to.z_mm - s.from.z_mm, s.to.r_mm - s.from.r_mm) * s.largest_mm();
      if ((open_before(i) || open_behind(i)) && size > most) open = i, most = size;
    }
    return open;
  }

  /// Of a closed profile the side that begins furthest to the left, innermost.
  std::size_t leftmost() const {
    std::size_t first = sides_.size();
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      if (!out_[from_[i]].count(i)) continue;
      if (first == sides_.size()) first = i;
      const auto &a = sides_[i].from, &b = sides_[first].from;
      const bool level = std::abs(a.z_mm - b.z_mm) < kSame_mm;
      if (level ? a.r_mm < b.r_mm : a.z_mm < b.z_mm) first = i;
    }
    return first;
  }

  Id id(std::size_t side) const { return faces_[sides_[side].faces[0]].id; }

  [[noreturn]] void refuse_open(std::size_t open) const {
    const auto& s = sides_[open];
    const auto& end = open_behind(open) ? s.to : s.from;
    refuse(id(open), say("a face that no other about the axis meets at {}", place(end)),
           tr("a half profile that closes"));
  }
  [[noreturn]] void refuse_branch(std::size_t node) const {
    const auto first = *out_[node].begin(), second = *std::next(out_[node].begin());
    refuse(id(first),
           say("a face that begins with {} at {}", name_of(id(second)),
               place(sides_[first].from)),
           tr("one way round the half profile"));
  }
  [[noreturn]] void refuse_hollow() const {
    for (const auto& sides : out_)
      if (!sides.empty())
        refuse(id(*sides.begin()), tr("a hollow inside the body, or a second body"),
               tr("one half profile from end to end"));
    refuse(0, tr("nothing"), tr("a half profile"));
  }

  const std::vector<Face>& faces_;
  std::vector<TurnedSide> sides_;
  std::size_t nodes_ = 0;
  std::vector<std::size_t> from_, to_;  // nodes of each side
  std::vector<std::set<std::size_t>> out_, in_;
  std::vector<char> axis_;
};

/// One place for the end of a and the beginning of b.
void meet(TurnedSide& a, TurnedSide& b) {
  using enum TurnedSide::Kind;
  Point p = a.to;
  if (b.kind == plane) p.z_mm = b.from.z_mm;
  if (b.kind == cylinder) p.r_mm = b.from.r_mm;
  a.to = b.from = p;
}

void add_sides(const TurnedSide& turned, const std::vector<Face>& faces, double left_mm,
               Profile& profile) {
  Side side{turned.from, turned.to};
  for (const auto i : turned.faces) side.sources.push_back(name_of(faces[i].id));
  const auto shifted = [left_mm](Point p) {
    p.z_mm -= left_mm;
    return p;
  };
  side.from = shifted(side.from), side.to = shifted(side.to);
  if (turned.kind != TurnedSide::Kind::round) return profile.sides.push_back(side);
  side.centre = shifted(turned.centre);
  side.counterclockwise = !turned.convex;
  constexpr double kHalf = std::numbers::pi - 1e-6;  // a side turns by less than half
  if (turned.turn_rad < kHalf) return profile.sides.push_back(side);
  const double half = turned.turn_rad / 2 * (turned.convex ? -1 : 1);
  const double z = side.from.z_mm - side.centre->z_mm;
  const double r = side.from.r_mm - side.centre->r_mm;
  const Point middle{side.centre->z_mm + z * std::cos(half) - r * std::sin(half),
                     side.centre->r_mm + z * std::sin(half) + r * std::cos(half)};
  auto second = side;
  side.to = second.from = middle;
  profile.sides.push_back(side);
  profile.sides.push_back(second);
}

}  // namespace

void check_turned(const std::vector<Face>& faces, const std::vector<TurnedSide>& sides,
                  const Axis& axis) {
  const TurnedSide* largest = nullptr;
  for (const auto& s : sides)
    if (s.outside() && (!largest || s.largest_mm() > largest->largest_mm())) largest = &s;
  if (!largest)
    refuse(faces[0].id, tr("a body with no face about its axis on the outside"),
           tr("a turned part"));
  const double R = largest->largest_mm();
  const auto id = faces[largest->faces[0]].id;
  for (const auto& face : faces)
    for (const auto& b : face.boundary)
      if (!(axis.r_mm(b.from) < R + kSame_mm))
        refuse(face.id,
               say("a corner {:.6g} mm from the axis of {}, whose diameter is {:.6g} mm",
                   axis.r_mm(b.from), name_of(id), 2 * R),
               tr("a turned part, all of it within its largest diameter"));
  double round = 0;
  for (const auto& s : sides)
    if (s.outside() && s.largest_mm() > R - kSame_mm)
      round = std::max(round, s.round_rad);
  if (!(round >= kRound_rad))
    refuse(id,
           say("{:.0f} % of a circle of {:.6g} mm diameter",
               50 * round / std::numbers::pi, 2 * R),
           tr("a turned part, a third or more of its largest circle there"));
}

Contour contour_of(const std::vector<Face>& faces, std::vector<TurnedSide> sides) {
  Contour contour;
  contour.sides = Graph(faces, std::move(sides)).chain();
  auto& chain = contour.sides;
  for (std::size_t i = 1; i < chain.size(); ++i) meet(chain[i - 1], chain[i]);
  if (on_axis(chain.front().from) && on_axis(chain.back().to))
    chain.front().from.r_mm = chain.back().to.r_mm = 0;
  else
    meet(chain.back(), chain.front());
  contour.left_mm = chain.front().from.z_mm;
  for (const auto& s : chain)
    contour.left_mm = std::min({contour.left_mm, s.from.z_mm, s.to.z_mm});
  contour.used.resize(faces.size());
  for (const auto& s : chain) {
    for (const auto i : s.faces) contour.used[i] = true;
    add_sides(s, faces, contour.left_mm, contour.profile);
  }
  return contour;
}

Contour step_contour(const std::vector<Face>& faces, const Axis& axis) {
  std::vector<TurnedSide> sides;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (auto side = side_of(faces[i], i, axis)) sides.push_back(std::move(*side));
    if (sides.size() > kMostSides)
      refuse(faces[i].id, tr("more than 5000 faces about the axis"), tr("a turned part"));
  }
  sides = merged(std::move(sides));
  check_turned(faces, sides, axis);
  return contour_of(faces, std::move(sides));
}

}  // namespace turnwright::exchange
