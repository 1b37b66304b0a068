#include "drawn_part.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cutters.hpp"

namespace turnwright::nc::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kArcChord_mm = 2e-6;  // of arcs
constexpr double kStep_mm = 5e-3;      // along the centres of a rolling corner
constexpr double kTouch_mm = 1e-7;     // of its distance

constexpr double kBucket_mm = 0.2;

double length(const Spot& a) { return std::hypot(a.x, a.z); }
long bucket(double z) { return std::lround(std::floor(z / kBucket_mm)); }

}  // namespace

void Pieces::add(const Piece& piece) {
  const auto [low, high] = std::minmax(piece.a.z, piece.b.z);
  for (long k = bucket(low); k <= bucket(high); ++k) near_[k].push_back(all_.size());
  all_.push_back(piece);
}

Pieces::Nearest Pieces::nearest(const Spot& p) const {
  Nearest best{kInfinity, 0};
  if (near_.empty()) return best;
  const long at = bucket(p.z);
  const long most =
      std::max(std::abs(at - near_.begin()->first), std::abs(at - near_.rbegin()->first));
  const auto look = [&](long k) {
    const auto found = near_.find(k);
    if (found == near_.end()) return;
    for (const auto i : found->second) {
      const double square = distance_square(p, all_[i].a, all_[i].b);
      if (square < best.mm) best = {square, all_[i].of};
    }
  };
  for (long k = 0; k <= most; ++k) {
    const double least = kBucket_mm * static_cast<double>(k - 1);
    if (k > 0 && least * least > best.mm) break;
    look(at - k);
    if (k > 0) look(at + k);
  }
  best.mm = std::sqrt(best.mm);
  return best;
}

DrawnPart::DrawnPart(const Planned& p)
    : sizes_(p), p_(p), corners_mm_(finishing_corners_mm(p)) {
  least_ = body(Threads::root);
  full_ = body(Threads::blank);
  add_walls(run(true, Threads::blank));
  add_walls(run(false, Threads::blank));
  for (const auto& id : surfaces_)
    if (const double r = corner_mm(id); r > 0 && !rolled_.contains(r))
      rolled_[r] = rolled(r);
}

std::size_t DrawnPart::surface(const std::string& id) {
  const auto it = std::find(surfaces_.begin(), surfaces_.end(), id);
  if (it != surfaces_.end()) return static_cast<std::size_t>(it - surfaces_.begin());
  surfaces_.push_back(id);
  return surfaces_.size() - 1;
}

double DrawnPart::corner_mm(const std::string& surface) const {
  const auto found = corners_mm_.find(surface);
  return found == corners_mm_.end() ? 0 : found->second;
}

void DrawnPart::append(Run& run, const std::string& id, const Polygon& line) {
  for (const auto& spot : line) {
    run.points.push_back(spot);
    run.before.push_back(surface(id));
  }
}

// What an undercut takes of the shoulder, from where its circle meets the shoulder's plane:
// round to where it leans back and straight back to it; `out` is the direction into the
// shoulder.  Nothing of form E.
Polygon recess(const part::Undercut& u, const Spot& from, double out) {
  Polygon all;
  if (!(u.recess_mm > 0)) return all;
  const double r = u.radius_mm, c = Sizes::centre(u), lean = Sizes::lean_of(u);
  const double begins = std::asin(c / r);  // angle from below the centre
  const double centre_x = from.x + r * std::cos(begins);
  for (int i = 1; i <= 200; ++i) {
    const double a = begins + (M_PI / 2 + lean - begins) * i / 200;
    all.push_back({centre_x - r * std::cos(a), from.z + out * (r * std::sin(a) - c)});
  }
  const double left = out * (all.back().z - from.z);
  all.push_back({all.back().x + left / std::tan(lean), from.z});
  return all;
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
    const int n =
        1 + static_cast<int>(2 * e.cut->path_mm / std::sqrt(8 * R * kArcChord_mm));
    for (int i = 1; i < n; ++i) at.push_back((1 - std::cos(M_PI * i / n)) / 2);
  }
  for (const auto& c : p_.plan.compensation)
    for (const auto& [z, dr] : c.table_mm)
      if (c.on == e.id && z > z0 && z < z0 + e.length_mm)
        at.push_back((z - z0) / e.length_mm);
  const auto add_edge = [&](const std::optional<part::Chamfer>& c, bool left) {
    if (!c) return;
    const int n =
        c->round ? 1 + static_cast<int>(std::sqrt(c->axial_mm / kArcChord_mm)) : 1;
    for (int i = 1; i <= n; ++i) {
      const double u =
          c->axial_mm / e.length_mm * (c->round ? 1 - std::cos(M_PI / 2 * i / n) : 1);
      at.push_back(left ? u : 1 - u);
    }
  };
  add_edge(e.left_chamfer, true);
  add_edge(e.right_chamfer, false);
  if constexpr (requires { e.left_undercut; })
    for (const bool left : {true, false})
      if (const auto& u = left ? e.left_undercut : e.right_undercut) {
        std::vector<double> x{u->width_mm,
                              u->width_mm - u->depth_mm / std::tan(Sizes::slope_of(*u))};
        for (int i = 0; i <= 200; ++i)
          x.push_back(Sizes::centre(*u) - u->radius_mm * std::cos(M_PI / 400 * i));
        for (const double from : x)
          if (from >= 0) at.push_back(left ? from / e.length_mm : 1 - from / e.length_mm);
      }
  std::sort(at.begin(), at.end());
  const double low_z = z0 + (e.left_chamfer ? e.left_chamfer->axial_mm : 0);
  const double high_z =
      z0 + e.length_mm - (e.right_chamfer ? e.right_chamfer->axial_mm : 0);
  const auto [straight_from, straight_to] = Sizes::straight(e);
  // Chamfers go down from where they leave the surface, rounded edges on a circle that is
  // tangent to it there.
  const auto falls = [](const part::Chamfer& c, double beyond) {
    const double angle = std::asin(std::min(1.0, beyond / c.axial_mm));
    return c.round ? c.axial_mm * (1 - std::cos(angle))
                   : c.radial_mm * beyond / c.axial_mm;
  };
  const auto chamfered = [&](double z) {
    if (z < low_z) return falls(*e.left_chamfer, low_z - z);
    if (z > high_z) return falls(*e.right_chamfer, z - high_z);
    return 0.0;
  };
  const auto root = [&](const Element& thread) {
    return sign * thread.cut->core.left_mm / 2;
  };
  const auto is_thread = [&](std::size_t i) {
    return i < all.size() && all[i].cut &&
           (all[i].cut->kind == part::CutKind::thread ||
            all[i].cut->kind == part::CutKind::knurl);
  };
  // A thread is cut, and a knurl pressed, to its root, and into the chamfer or arc that rises to it.
  double most = kInfinity;
  if (threads == Threads::root) {
    const bool rises =
        e.cut ? e.cut->kind == part::CutKind::arc : e.left_mm != e.right_mm;
    if (is_thread(k)) most = root(e);
    for (const auto beside : {k - 1, k + 1})
      if (rises && is_thread(beside)) most = std::min(most, root(all[beside]));
  }
  Polygon line;
  for (const double u : at) {
    const double z = z0 + u * e.length_mm;
    const double size =
        Sizes::drawn(e, u) +
        sizes_.correction(e.id, std::clamp(z, z0 + straight_from, z0 + straight_to));
    const double h = sign * size - chamfered(z) - Sizes::undercut(e, z - z0);
    line.push_back({sign * std::min(h, most), z});
  }
  if (e.left_chamfer && e.left_chamfer->round)
    roundings_.emplace_back(line.front(), e.left_chamfer->axial_mm);
  if (e.right_chamfer && e.right_chamfer->round)
    roundings_.emplace_back(line.back(), e.right_chamfer->axial_mm);
  if constexpr (requires { e.left_undercut; }) {
    if (e.left_undercut) {
      auto behind = recess(*e.left_undercut, line.front(), -1);
      line.insert(line.begin(), behind.rbegin(), behind.rend());
    }
    if (e.right_undercut) {
      const auto behind = recess(*e.right_undercut, line.back(), 1);
      line.insert(line.end(), behind.begin(), behind.end());
    }
  }
  append(run, e.id, line);
}

double DrawnPart::along_face_mm(const Spot& beside, double within_mm) const {
  double most = 0;
  for (const auto& [begins, R] : roundings_) {
    const double flat = std::sqrt(2 * R * within_mm);
    if (length(beside - begins) < 2 * flat) most = std::max(most, flat);
  }
  return most;
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
    // A wall belongs to the element at its foot, whose tool makes it.
    const std::size_t next = std::min(i + 1, outside.points.size() - 1);
    const bool rises = outside.points[next].x > outside.points[i].x;
    b.of.push_back(outside.before[rises ? i : next]);
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

DrawnPart::Rolled DrawnPart::rolled(double r) const {
  Rolled rolled;
  for (std::size_t i = 0; i < full_.polygon.size(); ++i) roll(rolled, r, i);
  return rolled;
}

// Adds the centres while the corner touches a piece or its end, and nothing else.
void DrawnPart::roll(Rolled& rolled, double r, std::size_t i) const {
  const auto& all = full_.polygon;
  const auto at = [&](std::size_t k) { return all[k % all.size()]; };
  const auto a = at(i), b = at(i + 1), way = b - a;
  const double l = length(way);
  if (l == 0 || (a.x == 0 && b.x == 0)) return;
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
  const auto along = [&](double u) { return Spot{a.x + u * way.x, a.z + u * way.z}; };
  keep_clear(rolled, r, l / kStep_mm, [&](double u) { return beside(along(u), normal); });
  if (turn < 0)  // an edge: the corner goes round it
    keep_clear(rolled, r, -turn / std::sqrt(8 * kArcChord_mm / r),
               [&](double u) { return beside(b, normal + u * turn); });
  constexpr double kChords_rad = 0.02;  // more than between the chords of arcs
  if (turn > kChords_rad) {
    const double back = r / std::tan((std::numbers::pi - turn) / 2);
    rolled.fillets.push_back({beside(along(1 - back / l), normal), b, back});
  }
}

template <class Centre>
void DrawnPart::keep_clear(Rolled& rolled, double r, double steps,
                           const Centre& centre) const {
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
    if (before || after) rolled.centres.add({centre(low), centre(high), 0});
    before = after;
  }
}

void DrawnPart::add_walls(const Run& run) {
  constexpr double kEdge_mm = 0.02;
  const auto add = [&](Wall w, double fillet) {
    w.from_x = w.low_x + (run.outer ? fillet : 0) + kEdge_mm;
    w.to_x = w.high_x - (run.outer ? 0 : fillet) - kEdge_mm;
    if (w.from_x < w.to_x) walls_.push_back(w);
  };
  const auto drilled = [&](const std::string& id) {
    const auto& inner = p_.part.drawing.inner;
    const auto e = std::ranges::find(inner, id, &part::InnerElement::id);
    return e != inner.end() && part::is_hole(*e);
  };
  for (std::size_t i = 0; i + 1 < run.points.size(); ++i) {
    const auto &a = run.points[i], &b = run.points[i + 1];
    if (std::abs(b.z - a.z) > 1e-9) continue;
    const auto [low, high] = std::minmax(a.x, b.x);
    const auto &before = surfaces_[run.before[i]], &after = surfaces_[run.before[i + 1]];
    // The bottom of a blind hole is left to the drill's point.
    if (!run.outer && low == 0 && (drilled(before) || drilled(after))) continue;
    add({before + "|" + after, a.z, low, high, (b.x > a.x) == run.outer, 0, 0},
        std::max(corner_mm(before), corner_mm(after)));
  }
  if (!run.outer) return;
  const auto hole = this->run(false, Threads::blank);
  const auto end = [&](const char* face, const Spot& in, const Spot& out) {
    if (sizes_.faced(face == std::string("left")))
      add({face, out.z, in.x, out.x, out.z == 0, 0, 0}, 0);
  };
  end("left", hole.points.front(), run.points.front());
  end("right", hole.points.back(), run.points.back());
}

double DrawnPart::beyond_mm(const Spot& p) const {
  if (p.z < 0 ? !sizes_.faced(true) : p.z > sizes_.length() && !sizes_.faced(false))
    return 0;  // nothing is to be made there
  const auto contour = full_.pieces.nearest(p);
  const double r = corner_mm(surfaces_[contour.of]);
  if (contour.mm >= r) return contour.mm;
  const auto& corner = rolled_.at(r);
  double beyond = std::max(0.0, r - corner.centres.nearest(p).mm);
  for (const auto& f : corner.fillets)
    if (length(p - f.corner) < f.reach)
      beyond = std::min(beyond, std::max(0.0, r - length(p - f.centre)));
  return beyond;
}

const std::string& DrawnPart::surface_at(const Spot& p) const {
  return surfaces_[full_.pieces.nearest(p).of];
}

}  // namespace turnwright::nc::test
