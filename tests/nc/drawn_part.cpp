#include "drawn_part.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cutters.hpp"

namespace turnwright::nc::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kChord_mm = 2e-6;  // of arcs
constexpr double kStep_mm = 5e-3;   // along the centres of a rolling corner
constexpr double kTouch_mm = 1e-7;  // of its distance

double length(const Spot& a) { return std::hypot(a.x, a.z); }

}  // namespace

void Pieces::add(const Piece& piece) {
  const auto [low, high] = std::minmax(piece.a.z, piece.b.z);
  for (long k = std::lround(std::floor(low)); k <= std::lround(std::floor(high)); ++k)
    near_[k].push_back(all_.size());
  all_.push_back(piece);
}

Pieces::Nearest Pieces::nearest(const Spot& p) const {
  Nearest best{kInfinity, 0};
  if (near_.empty()) return best;
  const long at = std::lround(std::floor(p.z));
  const long most =
      std::max(std::abs(at - near_.begin()->first), std::abs(at - near_.rbegin()->first));
  for (long k = 0; k <= most && static_cast<double>(k) - 1 < best.mm; ++k)
    for (const long bucket : {at - k, at + k}) {
      const auto found = near_.find(bucket);
      if (found == near_.end()) continue;
      for (const auto i : found->second) {
        const double mm = distance(p, all_[i].a, all_[i].b);
        if (mm < best.mm) best = {mm, all_[i].of};
      }
    }
  return best;
}

DrawnPart::DrawnPart(const Planned& p) : sizes_(p), p_(p) {
  for (const bool outer : {false, true})
    corner_mm_[outer] = finishing_corner_mm(p, outer);
  least_ = body(Threads::root);
  full_ = body(Threads::blank);
  add_walls(run(true, Threads::blank));
  add_walls(run(false, Threads::blank));
  for (std::size_t i = 0; i < full_.polygon.size(); ++i) roll(i);
}

std::size_t DrawnPart::surface(const std::string& id) {
  const auto it = std::find(surfaces_.begin(), surfaces_.end(), id);
  if (it != surfaces_.end()) return static_cast<std::size_t>(it - surfaces_.begin());
  const auto e = part::extent(p_.part.drawing, id);
  surfaces_.push_back(id);
  outer_.push_back(!(id == "hole" || (e && e->inner)));
  return surfaces_.size() - 1;
}

void DrawnPart::append(Run& run, const std::string& id, const Polygon& line) {
  for (const auto& spot : line) {
    run.points.push_back(spot);
    run.before.push_back(surface(id));
  }
}

// The line of an element; beside a step the wall belongs to both, and is named so by
// add_walls.
template <class Element>
void DrawnPart::append(Run& run, const std::vector<Element>& all, std::size_t k,
                       Threads threads) {
  const auto& e = all[k];
  const double z0 = sizes_.begin(e, k), sign = run.outer ? 1 : -1;
  std::vector<double> at{0, 1};
  if (e.cut && e.cut->kind == part::CutKind::arc) {
    const double R = e.cut->radius_mm;
    const int n = 1 + static_cast<int>(2 * e.cut->path_mm / std::sqrt(8 * R * kChord_mm));
    for (int i = 1; i < n; ++i) at.push_back((1 - std::cos(M_PI * i / n)) / 2);
  }
  for (const auto& c : p_.plan.compensation)
    for (const auto& [z, dr] : c.table_mm)
      if (c.on == e.id && z > z0 && z < z0 + e.length_mm)
        at.push_back((z - z0) / e.length_mm);
  std::sort(at.begin(), at.end());
  const auto root = [&](const Element& thread) {
    return sign * thread.left_mm / 2 - thread.cut->depth_mm;
  };
  const auto is_thread = [&](std::size_t i) {
    return i < all.size() && all[i].cut && all[i].cut->kind == part::CutKind::thread;
  };
  // A thread is cut to its root, and into the chamfer beside it.
  double most = kInfinity;
  if (threads == Threads::root) {
    if (is_thread(k)) most = root(e);
    for (const auto beside : {k - 1, k + 1})
      if (!e.cut && e.left_mm != e.right_mm && is_thread(beside))
        most = std::min(most, root(all[beside]));
  }
  Polygon line;
  for (const double u : at) {
    const double z = z0 + u * e.length_mm;
    const double h = sign * (Sizes::drawn(e, u) + sizes_.correction(e.id, z));
    line.push_back({sign * std::min(h, most), z});
  }
  append(run, e.id, line);
}

DrawnPart::Run DrawnPart::run(bool outer, Threads threads) {
  const auto& d = p_.part.drawing;
  Run run{outer, {}, {}};
  if (outer) {
    for (std::size_t k = 0; k < d.outer.size(); ++k) append(run, d.outer, k, threads);
    return run;
  }
  std::vector<std::size_t> order(d.inner.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return sizes_.begin(d.inner[a], a) < sizes_.begin(d.inner[b], b);
  });
  const double hole = d.stock.inner_mm / 2;
  double z = 0;
  const auto stays = [&](double to) {
    if (to - z > 1e-6) append(run, "hole", {{hole, z}, {hole, to}});
  };
  for (const auto k : order) {
    stays(sizes_.begin(d.inner[k], k));
    append(run, d.inner, k, threads);
    z = sizes_.begin(d.inner[k], k) + d.inner[k].length_mm;
  }
  stays(sizes_.length());
  return run;
}

DrawnPart::Body DrawnPart::body(Threads threads) {
  const auto outside = run(true, threads), inside = run(false, threads);
  Body b;
  for (std::size_t i = 0; i < outside.points.size(); ++i) {
    b.polygon.push_back(outside.points[i]);
    b.of.push_back(outside.before[std::min(i + 1, outside.points.size() - 1)]);
  }
  b.of.back() = surface("right");
  for (std::size_t i = inside.points.size(); i-- > 0;) {
    b.polygon.push_back(inside.points[i]);
    b.of.push_back(inside.before[i]);
  }
  b.of.back() = surface("left");
  for (std::size_t i = 0; i < b.polygon.size(); ++i) {
    const auto &from = b.polygon[i], &to = b.polygon[(i + 1) % b.polygon.size()];
    if (from.x > 0 || to.x > 0) b.pieces.add({from, to, b.of[i]});
  }
  return b;
}

// Centres of the corner that touch a piece or its end, where it touches nothing else.
void DrawnPart::roll(std::size_t i) {
  const auto& all = full_.polygon;
  const auto at = [&](std::size_t k) { return all[k % all.size()]; };
  const auto a = at(i), b = at(i + 1), way = b - a;
  const double r = corner_mm_[is_outer(full_.of[i])];
  if (length(way) == 0 || (a.x == 0 && b.x == 0) || !(r > 0)) return;
  std::size_t next = i + 2;
  while (length(at(next) - b) == 0) ++next;
  const auto on = at(next) - b;
  // Angles of the normals to the left, outwards.
  const double normal = std::atan2(way.z, -way.x);
  const double turn =
      std::remainder(std::atan2(on.z, -on.x) - normal, 2 * std::numbers::pi);
  const auto beside = [&](const Spot& p, double angle) {
    return p + Spot{r * std::sin(angle), r * std::cos(angle)};
  };
  keep_clear(i, length(way) / kStep_mm, [&](double u) {
    return beside({a.x + u * way.x, a.z + u * way.z}, normal);
  });
  constexpr double kCorner_rad = 0.02;  // more than between the chords of arcs
  if (turn > kCorner_rad) {
    const double half = (std::numbers::pi - turn) / 2;  // of the corner's angle
    const double back = r / std::tan(half);
    const auto l = length(way);
    fillets_[is_outer(full_.of[i])].push_back(
        {beside({b.x - back * way.x / l, b.z - back * way.z / l}, normal), b, back});
  }
  if (turn < 0)  // an edge: the corner goes round it
    keep_clear(i, -turn / std::sqrt(8 * kChord_mm / r),
               [&](double u) { return beside(b, normal + u * turn); });
}

template <class Centre>
void DrawnPart::keep_clear(std::size_t i, double steps, const Centre& centre) {
  const bool outer = is_outer(full_.of[i]);
  const double r = corner_mm_[outer];
  const auto clear = [&](double u) {
    return full_.pieces.nearest(centre(u)).mm >= r - kTouch_mm;
  };
  const int n = 1 + static_cast<int>(steps);
  bool before = clear(0);
  for (int k = 1; k <= n; ++k) {
    double low = static_cast<double>(k - 1) / n, high = static_cast<double>(k) / n;
    const bool after = clear(high);
    if (before != after) {  // ends, or begins, between
      double in = before ? low : high, out = before ? high : low;
      for (int j = 0; j < 40; ++j) (clear((in + out) / 2) ? in : out) = (in + out) / 2;
      (before ? high : low) = in;
    }
    if (before || after) rolled_[outer].add({centre(low), centre(high), full_.of[i]});
    before = after;
  }
}

void DrawnPart::add_walls(const Run& run) {
  const auto add = [&](Wall w, bool foot) {
    const double r = foot ? corner_mm_[run.outer] : 0;
    constexpr double kEdge_mm = 0.02;
    w.from_x = w.low_x + (run.outer ? r : 0) + kEdge_mm;
    w.to_x = w.high_x - (run.outer ? 0 : r) - kEdge_mm;
    if (w.from_x < w.to_x) walls_.push_back(w);
  };
  for (std::size_t i = 0; i + 1 < run.points.size(); ++i) {
    const auto &a = run.points[i], &b = run.points[i + 1];
    if (b.z - a.z > 1e-9) continue;
    const auto [low, high] = std::minmax(a.x, b.x);
    add({surfaces_[run.before[i]] + "|" + surfaces_[run.before[i + 1]], a.z, low, high,
         (b.x > a.x) == run.outer, 0, 0},
        true);
  }
  if (!run.outer) return;
  const auto hole = this->run(false, Threads::blank);
  if (sizes_.faced(true))
    add({"left", 0, hole.points.front().x, run.points.front().x, true, 0, 0}, false);
  if (sizes_.faced(false))
    add({"right", sizes_.length(), hole.points.back().x, run.points.back().x, false, 0,
         0},
        false);
}

double DrawnPart::beyond_mm(const Spot& p) const {
  if (p.z < 0 ? !sizes_.faced(true) : p.z > sizes_.length() && !sizes_.faced(false))
    return 0;  // nothing is to be made there
  const auto contour = full_.pieces.nearest(p);
  const bool outer = is_outer(contour.of);
  const double r = corner_mm_[outer];
  if (contour.mm >= r) return contour.mm;
  double beyond = std::max(0.0, r - rolled_[outer].nearest(p).mm);
  for (const auto& f : fillets_[outer])
    if (length(p - f.corner) < f.reach)
      beyond = std::min(beyond, std::max(0.0, r - length(p - f.centre)));
  return beyond;
}

const std::string& DrawnPart::surface_at(const Spot& p) const {
  return surfaces_[full_.pieces.nearest(p).of];
}

}  // namespace turnwright::nc::test
