#include "dxf_half.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "base/say.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::exchange::dxf {
namespace {

constexpr std::size_t kNamed = 5;  // places in one message

class HalfReader {
 public:
  HalfReader(const std::vector<Stroke>& strokes, double join_mm, const View& view)
      : join_(join_mm), view_(view) {
    h_.graph = joined(strokes, join_mm);
    used_.resize(g().links.size());
    pruned_.resize(g().links.size());
  }

  Half read() {
    prune();
    find_ends();
    walk_outside();
    check_outside();
    find_bores();
    h_.left_face = face(left_, h_.through              ? h_.from_right.back().to
                               : !h_.from_left.empty() ? h_.from_left.back().to
                                                       : kNone);
    std::reverse(h_.left_face.begin(), h_.left_face.end());
    for (Link& l : h_.left_face) l = l.reversed();
    h_.right_face =
        face(right_, h_.from_right.empty() ? kNone : h_.from_right.front().from);
    list_unused();
    return std::move(h_);
  }

 private:
  static constexpr Node kNone = static_cast<Node>(-1);
  const Graph& g() const { return h_.graph; }
  const Place& place(Node n) const { return g().nodes[n]; }
  bool on_axis(Node n) const { return place(n).y == 0; }
  bool at_left(Node n) const { return place(n).x <= z0_ + join_; }
  bool at_right(Node n) const { return place(n).x >= z1_ - join_; }
  bool contour(std::uint32_t k) const { return g().links[k].role == Role::contour; }
  bool upright(const Link& l) const {
    return !l.centre && std::abs(place(l.from).x - place(l.to).x) <= join_;
  }

  // Leaves out what ends nowhere: it bounds nothing.
  void prune() {
    std::vector<std::size_t> degree(g().nodes.size());
    for (std::uint32_t k = 0; k < g().links.size(); ++k)
      if (contour(k)) ++degree[g().links[k].from], ++degree[g().links[k].to];
    std::vector<Node> open;
    for (Node n = 0; n < degree.size(); ++n)
      if (degree[n] == 1 && !on_axis(n)) open.push_back(n);
    dangling_ = open;
    while (!open.empty()) {
      const Node n = open.back();
      open.pop_back();
      for (const auto k : g().at[n]) {
        if (!contour(k) || pruned_[k]) continue;
        pruned_[k] = true;
        const Node other = g().leaving(n, k).to;
        if (--degree[other] == 1 && !on_axis(other)) open.push_back(other);
        break;
      }
    }
  }

  // The ends of the part, and the outermost corner of each.
  void find_ends() {
    bool any = false;
    for (std::uint32_t k = 0; k < g().links.size(); ++k)
      if (contour(k))
        for (const Node n : {g().links[k].from, g().links[k].to}) {
          z0_ = std::min(z0_, place(n).x);
          z1_ = std::max(z1_, place(n).x);
          any = any || !pruned_[k];
        }
    if (!any) open_contour(tr("a contour that is open everywhere"));
    for (std::uint32_t k = 0; k < g().links.size(); ++k)
      if (contour(k) && !pruned_[k])
        for (const Node n : {g().links[k].from, g().links[k].to}) {
          if (at_left(n) && (left_ == kNone || place(n).y > place(left_).y)) left_ = n;
          if (at_right(n) && (right_ == kNone || place(n).y > place(right_).y))
            right_ = n;
        }
    if (left_ == kNone) open_contour(tr("no closed contour at the left end"));
    if (right_ == kNone) open_contour(tr("no closed contour at the right end"));
  }

  [[noreturn]] void open_contour(const std::string& got) const {
    std::vector<std::string> places;
    for (const Node n : dangling_) {
      if (places.size() == kNamed) break;
      places.push_back(view_.where(place(n)));
    }
    refuse(
        "",
        places.empty() ? got : say("{}: lines end at {}", got, fmt::join(places, "; ")),
        tr("a contour that is closed or ends on the axis"));
  }

  // Along the outermost lines: at every corner the leftmost way.
  void walk_outside() {
    Place heading{0, 1};
    Node n = left_;
    std::vector<bool> seen(g().nodes.size());
    while (!at_right(n) || n == left_) {
      seen[n] = true;
      const auto ways = turning(g(), n, heading, Hand::left, [&](std::uint32_t k) {
        return contour(k) && !pruned_[k] && !used_[k];
      });
      if (ways.empty())
        open_contour(say("a contour that ends at {}", view_.where(place(n))));
      const Link& way = ways.front();
      n = way.to;
      if (seen[n] || (on_axis(n) && !at_right(n)))
        open_contour(say("a contour that comes back to {} before the right end",
                         view_.where(place(n))));
      use(way);
      h_.outside.push_back(way);
      heading = g().arriving(way);
    }
    right_ = n;
  }

  void use(const Link& way) {
    for (const auto k : g().at[way.from]) {
      const Link& l = g().links[k];
      const bool same = (l.from == way.from && l.to == way.to) ||
                        (l.from == way.to && l.to == way.from);
      if (same && l.centre.has_value() == way.centre.has_value()) used_[k] = true;
    }
  }

  // Radius of the outside at a place along the axis.
  double outside_mm(double x) const {
    double r = 0;
    for (const Link& l : h_.outside) {
      const Place a = place(l.from), b = place(l.to);
      if (x < std::min(a.x, b.x) - join_ || x > std::max(a.x, b.x) + join_) continue;
      r = std::max({r, x <= std::min(a.x, b.x) ? std::min(a.y, b.y) : 0,
                    std::abs(a.x - b.x) <= join_ ? std::max(a.y, b.y) : 0});
      if (l.centre) {
        const double R = length(a - *l.centre), dx = x - l.centre->x;
        const double rise = std::sqrt(std::max(0.0, R * R - dx * dx));
        r = std::max(r, l.centre->y + ((a.x < b.x) == l.counterclockwise ? -rise : rise));
      } else if (std::abs(a.x - b.x) > join_) {
        r = std::max(r, a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x));
      }
    }
    return r;
  }

  void check_outside() {
    std::vector<std::string> places;
    for (std::uint32_t k = 0; k < g().links.size() && places.size() < kNamed; ++k) {
      if (!contour(k) || used_[k]) continue;
      leave_if_asked();
      for (const Node n : {g().links[k].from, g().links[k].to})
        if (place(n).y > outside_mm(place(n).x) + 2 * join_) {
          places.push_back(
              say("{} at {}", view_.source(g().links[k].source), view_.where(place(n))));
          break;
        }
    }
    if (!places.empty())
      refuse("", say("lines outside of the closed contour: {}", fmt::join(places, "; ")),
             tr("a closed outer contour, and other lines on layers for notes or off"));
  }

  // Lines of an end face from its outer corner to a bore's mouth, or to the axis.
  std::vector<Link> face(Node top, Node mouth) {
    std::vector<Link> out;
    Node n = top;
    while (n != mouth && !on_axis(n)) {
      const auto ways = turning(g(), n, {0, -1}, Hand::left, [&](std::uint32_t k) {
        const Link l = g().leaving(n, k);
        return contour(k) && upright(l) && place(l.to).y < place(n).y;
      });
      if (ways.empty())
        open_contour(say("an end face that ends at {}", view_.where(place(n))));
      use(ways.front());
      out.push_back(ways.front());
      n = ways.front().to;
    }
    return out;
  }

  // Whether lines lead from the outside into the part, upright, as shoulders are seen.
  bool shoulder_lines() const {
    std::vector<bool> outside(g().nodes.size());
    for (const Link& l : h_.outside)
      if (!at_right(l.to)) outside[l.to] = true;
    for (std::uint32_t k = 0; k < g().links.size(); ++k) {
      const Link& l = g().links[k];
      if (contour(k) && !used_[k] && upright(l) && (outside[l.from] || outside[l.to]))
        return true;
    }
    return false;
  }

  bool hidden_lines() const {
    for (const Link& l : g().links)
      if (l.role == Role::hidden) return true;
    return false;
  }

  void find_bores() {
    if (hidden_lines()) find_bores(Role::hidden);
    if (!h_.bored()) {
      find_bores(Role::contour);
      h_.doubtful = h_.bored() && shoulder_lines();
    }
    for (const auto* path : {&h_.from_right, &h_.from_left})
      for (const Link& l : *path) use(l);
  }

  void find_bores(Role role) {
    const auto allowed = [this, role](std::uint32_t k) {
      const Link& l = g().links[k];
      const bool end_face = upright(l) && (at_left(l.from) || at_right(l.from));
      return !used_[k] && !end_face && (l.role == role);
    };
    h_.from_right = bore(allowed, false);
    h_.through = !h_.from_right.empty() && !on_axis(h_.from_right.back().to);
    if (h_.through) return;
    h_.from_left = bore(allowed, true);
    std::reverse(h_.from_left.begin(), h_.from_left.end());
    for (Link& l : h_.from_left) l = l.reversed();
  }

  // From the mouth nearest to the axis: at every corner the way nearest to the material
  // that leads to the axis, or through the part.
  std::vector<Link> bore(const std::function<bool(std::uint32_t)>& allowed,
                         bool left) const {
    std::vector<Node> mouths;
    const Node top = left ? left_ : right_;
    for (Node n = 0; n < g().nodes.size(); ++n)
      if ((left ? at_left(n) : at_right(n)) && !on_axis(n) && place(n).y < place(top).y)
        mouths.push_back(n);
    std::sort(mouths.begin(), mouths.end(),
              [&](Node a, Node b) { return place(a).y < place(b).y; });
    std::vector<bool> seen(g().nodes.size());
    for (const Node mouth : mouths) {
      const auto path = way_in(mouth, allowed, left, seen);
      if (!path.empty() && !is_thread_line(path, allowed)) return path;
    }
    return {};
  }

  // Depth first; a node is left for good once all ways from it were tried.
  std::vector<Link> way_in(Node mouth, const std::function<bool(std::uint32_t)>& allowed,
                           bool left, std::vector<bool>& seen) const {
    const Hand hand = left ? Hand::left : Hand::right;
    std::vector<Link> path;
    std::vector<std::vector<Link>> ways;  // left to try at each node of the path
    const auto arrive = [&](Node n, const Place& heading) {
      seen[n] = true;
      ways.push_back(turning(g(), n, heading, hand, allowed));
      std::reverse(ways.back().begin(), ways.back().end());
    };
    if (seen[mouth]) return {};
    arrive(mouth, {left ? 1.0 : -1.0, 0});
    while (!ways.empty()) {
      if (ways.back().empty()) {
        ways.pop_back();
        if (!path.empty()) path.pop_back();
        continue;
      }
      const Link way = ways.back().back();
      ways.back().pop_back();
      if (seen[way.to]) continue;
      path.push_back(way);
      const bool through = left ? at_right(way.to) : at_left(way.to);
      if (on_axis(way.to) || (through && !left)) return path;
      if (through) {
        path.pop_back();
        continue;
      }
      arrive(way.to, g().arriving(way));
    }
    return {};
  }

  // The end of an outer thread is drawn across the whole of it, the bottom of a bore is
  // not.
  bool is_thread_line(const std::vector<Link>& path,
                      const std::function<bool(std::uint32_t)>& allowed) const {
    const Link& last = path.back();
    if (!on_axis(last.to) || !upright(last) || last.role == Role::hidden) return false;
    for (const auto k : g().at[last.from]) {
      const Link l = g().leaving(last.from, k);
      const bool of_path = path.size() > 1 && l.to == path[path.size() - 2].from;
      if (allowed(k) && upright(l) && !of_path && place(l.to).y > place(l.from).y)
        return true;
    }
    return false;
  }

  void list_unused() {
    std::set<std::uint32_t> sources;
    for (std::uint32_t k = 0; k < g().links.size(); ++k)
      if (!used_[k] && !upright(g().links[k])) sources.insert(g().links[k].source);
    h_.unused.assign(sources.begin(), sources.end());
  }

  double join_;
  const View& view_;
  Half h_;
  std::vector<bool> used_, pruned_;
  std::vector<Node> dangling_;
  double z0_ = 1e300, z1_ = -1e300;
  Node left_ = kNone, right_ = kNone;
};

double distance_mm(const Graph& g, const Link& l, const Place& p) {
  const Place a = g.nodes[l.from], b = g.nodes[l.to];
  const double at_ends = std::min(length(p - a), length(p - b));
  if (l.centre) {
    const Place u = a - *l.centre, v = p - *l.centre, w = b - *l.centre;
    const double sign = l.counterclockwise ? 1 : -1;
    const bool within = sign * cross(u, v) >= 0 && sign * cross(v, w) >= 0;
    return within ? std::abs(length(v) - length(u)) : at_ends;
  }
  const Place d = b - a;
  const double t = dot(p - a, d) / dot(d, d);
  return t >= 0 && t <= 1 ? std::abs(cross(d, p - a)) / length(d) : at_ends;
}

}  // namespace

std::string View::where(Place local) const {
  if (other_side) local.y = -local.y;
  const Place p = 1 / drawn->unit_mm * axis.drawn(local);
  return fmt::format("x = {:.6g}, y = {:.6g}", p.x, p.y);
}

Half read_half(const std::vector<Stroke>& strokes, double join_mm, const View& view) {
  return HalfReader(strokes, join_mm, view).read();
}

std::optional<Place> difference(const Half& a, const Half& b,
                                std::vector<Link> Half::*chain, double within_mm) {
  const auto lies_there = [&](const Place& p) {
    const auto near = [&](const Link& of_b) {
      return distance_mm(b.graph, of_b, p) <= within_mm;
    };
    return std::any_of((b.*chain).begin(), (b.*chain).end(), near);
  };
  for (const Link& of_a : a.*chain) {
    leave_if_asked();
    for (const Node end : {of_a.from, of_a.to})
      if (!lies_there(a.graph.nodes[end])) return a.graph.nodes[end];
  }
  return std::nullopt;
}

}  // namespace turnwright::exchange::dxf
