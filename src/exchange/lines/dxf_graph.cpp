#include "dxf_graph.hpp"

#include <numbers>
#include <unordered_map>

#include "turnwright/base/cancelled.hpp"

namespace turnwright::exchange::dxf {
namespace {

constexpr double kLevel = 1e-7;  // mm or of the length: lines along or across the axis
constexpr double kTold = 1e-6;   // mm: what writers round is not worth telling

struct CellHash {
  std::size_t operator()(const std::pair<long long, long long>& c) const {
    return std::hash<long long>()(c.first * 1000003 ^ c.second);
  }
};

// Finds the node at a place, or makes one.
class Nodes {
 public:
  Nodes(std::vector<Place>& places, double join_mm) : places_(places), join_(join_mm) {}

  /// The node, and how far it is.
  std::pair<Node, double> at(const Place& p) {
    const auto cell = [this](double x) { return std::llround(std::floor(x / join_)); };
    const long long cx = cell(p.x), cy = cell(p.y);
    Node best = 0;
    double nearest = join_;
    bool found = false;
    for (long long i = -1; i <= 1; ++i)
      for (long long k = -1; k <= 1; ++k) {
        const auto known = cells_.find({cx + i, cy + k});
        if (known == cells_.end()) continue;
        for (const Node n : known->second)
          if (const double d = length(places_[n] - p);
              d <= nearest && (!found || d < nearest))
            best = n, nearest = d, found = true;
      }
    if (found) return {best, nearest};
    places_.push_back(p);
    best = static_cast<Node>(places_.size() - 1);
    cells_[{cx, cy}].push_back(best);
    return {best, 0};
  }

 private:
  std::vector<Place>& places_;
  double join_;
  std::unordered_map<std::pair<long long, long long>, std::vector<Node>, CellHash> cells_;
};

bool runs_level(const Stroke& s) {
  const Place d = s.to - s.from;
  return !s.centre && std::abs(d.y) <= kLevel * std::max(1.0, std::abs(d.x));
}
bool runs_upright(const Stroke& s) {
  const Place d = s.to - s.from;
  return !s.centre && std::abs(d.x) <= kLevel * std::max(1.0, std::abs(d.y));
}

// How far along the stroke a place between its ends lies, in mm; nothing beside it.
std::optional<double> along_stroke(const Stroke& s, const Place& p, double join_mm) {
  if (length(p - s.from) <= join_mm || length(p - s.to) <= join_mm) return std::nullopt;
  const Place chord = s.to - s.from;
  if (!s.centre) {
    const double l = length(chord), t = dot(p - s.from, chord) / l;
    if (!(t > 0 && t < l) || std::abs(cross(chord, p - s.from)) / l > join_mm)
      return std::nullopt;
    return t;
  }
  const double R = length(s.from - *s.centre);
  if (std::abs(length(p - *s.centre) - R) > join_mm) return std::nullopt;
  const double sign = s.counterclockwise ? 1 : -1;
  const Place u = s.from - *s.centre, v = p - *s.centre;
  const double a = sign * std::atan2(cross(u, v), dot(u, v));
  if (!(a > 0 && a < sweep_rad(s))) return std::nullopt;
  return a * R;
}

class Joiner {
 public:
  Joiner(const std::vector<Stroke>& strokes, double join_mm)
      : strokes_(strokes), join_(join_mm) {}

  Graph join() {
    Nodes nodes(g_.nodes, join_);
    for (const Stroke& s : strokes_) {
      ends_.push_back({end(nodes, s.from, s), end(nodes, s.to, s)});
    }
    for (Node n = 0; n < g_.nodes.size(); ++n) by_x_.push_back(n);
    std::sort(by_x_.begin(), by_x_.end(),
              [&](Node a, Node b) { return g_.nodes[a].x < g_.nodes[b].x; });
    level_.resize(g_.nodes.size());
    upright_.resize(g_.nodes.size());
    std::vector<std::vector<Node>> chains;
    for (std::size_t i = 0; i < strokes_.size(); ++i) {
      leave_if_asked();
      chains.push_back(chain(i));
      for (const Node n : chains.back()) settle(n, strokes_[i]);
    }
    for (std::size_t i = 0; i < strokes_.size(); ++i) {
      leave_if_asked();
      add_links(strokes_[i], chains[i]);
    }
    return std::move(g_);
  }

 private:
  Node end(Nodes& nodes, const Place& p, const Stroke& s) {
    const auto [node, gap] = nodes.at(p);
    if (gap > kTold) g_.bridged.push_back({p, gap, s.source});
    return node;
  }

  // The nodes on a stroke, in its direction.
  std::vector<Node> chain(std::size_t i) const {
    const Stroke& s = strokes_[i];
    const double R = s.centre ? length(s.from - *s.centre) : 0;
    const double x0 = (s.centre ? s.centre->x - R : std::min(s.from.x, s.to.x)) - join_;
    const double x1 = (s.centre ? s.centre->x + R : std::max(s.from.x, s.to.x)) + join_;
    std::vector<std::pair<double, Node>> inside;
    auto n = std::lower_bound(by_x_.begin(), by_x_.end(), x0,
                              [&](Node a, double x) { return g_.nodes[a].x < x; });
    for (; n != by_x_.end() && g_.nodes[*n].x <= x1; ++n)
      if (*n != ends_[i].first && *n != ends_[i].second)
        if (const auto t = along_stroke(s, g_.nodes[*n], join_))
          inside.push_back({*t, *n});
    std::sort(inside.begin(), inside.end());
    std::vector<Node> out{ends_[i].first};
    for (const auto& [t, node] : inside) out.push_back(node);
    out.push_back(ends_[i].second);
    return out;
  }

  // A corner lies on the lines along and across the axis that meet in it.
  void settle(Node n, const Stroke& s) {
    Place& p = g_.nodes[n];
    if (runs_level(s) && !level_[n]) {
      level_[n] = true;
      p.y = (s.from.y + s.to.y) / 2;
    }
    if (runs_upright(s) && !upright_[n]) {
      upright_[n] = true;
      p.x = (s.from.x + s.to.x) / 2;
    }
    if (std::abs(p.y) <= join_) p.y = 0;
  }

  void add_links(const Stroke& s, const std::vector<Node>& chain) {
    for (std::size_t k = 1; k < chain.size(); ++k) {
      if (chain[k] == chain[k - 1]) continue;
      add({chain[k - 1], chain[k], s.centre, s.counterclockwise, s.role, s.source});
    }
  }

  void add(const Link& link) {
    g_.at.resize(g_.nodes.size());
    for (const auto k : g_.at[link.from]) {
      const Link known = g_.leaving(link.from, k);
      if (known.to != link.to || known.centre.has_value() != link.centre.has_value())
        continue;
      if (link.centre && (known.counterclockwise != link.counterclockwise ||
                          length(*known.centre - *link.centre) > 10 * join_))
        continue;
      if (link.role == Role::contour) g_.links[k].role = Role::contour;
      return;
    }
    const auto k = static_cast<std::uint32_t>(g_.links.size());
    g_.links.push_back(link);
    g_.at[link.from].push_back(k);
    g_.at[link.to].push_back(k);
  }

  const std::vector<Stroke>& strokes_;
  double join_;
  Graph g_;
  std::vector<std::pair<Node, Node>> ends_;
  std::vector<Node> by_x_;
  std::vector<bool> level_, upright_;
};

// Unit vector along an arc at one of its points.
Place along_arc(const Place& p, const Link& link) {
  const Place u = p - *link.centre;
  const double sign = (link.counterclockwise ? 1 : -1) / length(u);
  return sign * Place{-u.y, u.x};
}

}  // namespace

Place Graph::tangent(const Link& link) const {
  if (link.centre) return along_arc(nodes[link.from], link);
  const Place d = nodes[link.to] - nodes[link.from];
  return 1 / length(d) * d;
}

Place Graph::arriving(const Link& link) const {
  return link.centre ? along_arc(nodes[link.to], link) : tangent(link);
}

Graph joined(const std::vector<Stroke>& strokes, double join_mm) {
  Graph g = Joiner(strokes, join_mm).join();
  g.at.resize(g.nodes.size());
  return g;
}

std::vector<Link> turning(const Graph& g, Node node, const Place& heading, Hand hand,
                          const std::function<bool(std::uint32_t)>& allowed) {
  constexpr double kBack = 1e-6;  // rad: straight back is the last choice
  struct Choice {
    long long turn = 0;  // in steps of kBack
    double bend = 0;
    Link link;
  };
  const long long half_turn = std::llround(std::numbers::pi / kBack);
  std::vector<Choice> choices;
  const double sign = hand == Hand::left ? 1 : -1;
  for (const auto k : g.at[node]) {
    if (!allowed(k)) continue;
    const Link link = g.leaving(node, k);
    const Place t = g.tangent(link);
    auto turn =
        std::llround(sign * std::atan2(cross(heading, t), dot(heading, t)) / kBack);
    if (turn >= half_turn - 1) turn = -half_turn;
    const double R = link.centre ? length(g.nodes[node] - *link.centre) : 0;
    const double bend = link.centre ? sign * (link.counterclockwise ? 1 : -1) / R : 0;
    choices.push_back({turn, bend, link});
  }
  std::stable_sort(choices.begin(), choices.end(), [](const Choice& a, const Choice& b) {
    return a.turn != b.turn ? a.turn > b.turn : a.bend > b.bend;
  });
  std::vector<Link> out;
  for (auto& c : choices) out.push_back(c.link);
  return out;
}

}  // namespace turnwright::exchange::dxf
