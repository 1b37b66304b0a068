#include "section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace turnwright::review {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
// Lines lie between the round numbers of drawings.
constexpr double kOffset = 0.4937;

double cross(const Spot& a, const Spot& b) { return a.z * b.x - a.x * b.z; }
double dot(const Spot& a, const Spot& b) { return a.z * b.z + a.x * b.x; }

// Extent of a polygon in a direction.
Interval extent(const Polygon& polygon, const Spot& direction) {
  Interval all{kUnbounded, -kUnbounded};
  for (const auto& p : polygon) {
    all.from = std::min(all.from, dot(p, direction));
    all.to = std::max(all.to, dot(p, direction));
  }
  return all;
}

// Whether a side of `a` separates the insides.
bool separated(const Polygon& a, const Polygon& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto side = a[(i + 1) % a.size()] - a[i];
    const Spot outwards{-side.z, side.x};  // to the right of it
    if (extent(b, outwards).from >= dot(a[i], outwards)) return true;
  }
  return false;
}

// Keeps what lies to the left of a line.
Polygon left_of(const Polygon& convex, const Spot& on, const Spot& along) {
  Polygon kept;
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const auto &p = convex[i], &q = convex[(i + 1) % convex.size()];
    const double dp = cross(along, p - on), dq = cross(along, q - on);
    if (dp >= 0) kept.push_back(p);
    if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) {
      const double u = dp / (dp - dq);
      kept.push_back({std::lerp(p.x, q.x, u), std::lerp(p.z, q.z, u)});
    }
  }
  return kept;
}

void take_off(Intervals& all, const Interval& cut) {
  for (std::size_t i = 0; i < all.size();) {
    auto& a = all[i];
    if (cut.to <= a.from) return;
    if (cut.from >= a.to) {
      ++i;
    } else if (cut.from <= a.from && cut.to >= a.to) {
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
    } else if (cut.from > a.from && cut.to < a.to) {
      const Interval rest{cut.to, a.to};
      a.to = cut.from;
      all.insert(all.begin() + static_cast<std::ptrdiff_t>(i) + 1, rest);
      return;
    } else {
      (cut.from <= a.from ? a.from : a.to) = cut.from <= a.from ? cut.to : cut.from;
      ++i;
    }
  }
}

double common_mm(const Interval& a, const Interval& b) {
  return std::min(a.to, b.to) - std::max(a.from, b.from);
}

bool crosses_axis(const Polygon& polygon) {
  return std::any_of(polygon.begin(), polygon.end(),
                     [](const Spot& p) { return p.x < 0; });
}

}  // namespace

Spot operator+(const Spot& a, const Spot& b) { return {a.x + b.x, a.z + b.z}; }
Spot operator-(const Spot& a, const Spot& b) { return {a.x - b.x, a.z - b.z}; }

Polygon hull(Polygon points) {
  std::sort(points.begin(), points.end(), [](const Spot& a, const Spot& b) {
    return a.z < b.z || (a.z == b.z && a.x < b.x);
  });
  Polygon all;
  for (const bool upper : {false, true}) {
    const auto start = all.size();
    for (const auto& p : points) {
      while (all.size() >= start + 2 &&
             cross(all.back() - all[all.size() - 2], p - all.back()) <= 0)
        all.pop_back();
      all.push_back(p);
    }
    if (!all.empty()) all.pop_back();  // begins the other half
    if (!upper) std::reverse(points.begin(), points.end());
  }
  return all;
}

Polygon swept(const Polygon& convex, const Spot& from, const Spot& to) {
  const auto way = to - from;
  const auto n = convex.size();
  const auto ahead = [&](std::size_t i) {  // a side that faces the way
    return cross(way, convex[(i + 1) % n] - convex[i]) > 0;
  };
  Polygon all;
  bool before = ahead(n - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const bool after = ahead(i);
    all.push_back(convex[i] + (before ? to : from));
    if (before != after) all.push_back(convex[i] + (after ? to : from));
    before = after;
  }
  return all;
}

Polygon mirrored(Polygon polygon) {
  for (auto& p : polygon) p.x = -p.x;
  std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

Polygon eroded(const Polygon& convex, double by) {
  auto kept = convex;
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const auto side = convex[(i + 1) % convex.size()] - convex[i];
    const double l = std::hypot(side.x, side.z);
    const Spot inwards{by * side.z / l, -by * side.x / l};
    kept = left_of(kept, convex[i] + inwards, side);
  }
  return kept.size() < 3 ? Polygon{} : kept;
}

bool overlap(const Polygon& a, const Polygon& b) {
  return !separated(a, b) && !separated(b, a);
}

double distance_square(const Spot& p, const Spot& a, const Spot& b) {
  const auto way = b - a;
  const double l = dot(way, way);
  const double u = l > 0 ? std::clamp(dot(p - a, way) / l, 0.0, 1.0) : 0;
  const auto off = p - Spot{a.x + u * way.x, a.z + u * way.z};
  return dot(off, off);
}

Intervals without(const Intervals& a, const Intervals& b) {
  auto rest = a;
  for (const auto& cut : b) take_off(rest, cut);
  return rest;
}

Lines::Lines(Family family, double from, double to, double pitch)
    : family_(family),
      first_(from + kOffset * pitch),
      pitch_(pitch),
      on_(static_cast<std::size_t>((to - from) / pitch)) {}

Spot Lines::spot(std::size_t i, double along) const {
  return family_ == Family::columns ? Spot{along, at(i)} : Spot{at(i), along};
}

std::size_t Lines::from(double place) const {
  const double i = std::ceil((place - first_) / pitch_);
  return static_cast<std::size_t>(std::clamp(i, 0.0, static_cast<double>(on_.size())));
}

std::pair<std::size_t, std::size_t> Lines::range(const Polygon& polygon) const {
  double low = kUnbounded, high = -kUnbounded;
  for (const auto& p : polygon) {
    low = std::min(low, across(p));
    high = std::max(high, across(p));
  }
  return {from(low), from(high)};
}

void Lines::spans(const Polygon& convex, std::size_t first, std::size_t last) const {
  spans_.assign(last - first, {kUnbounded, -kUnbounded});
  for (std::size_t k = 0; k < convex.size(); ++k) {
    const auto *a = &convex[k], *b = &convex[(k + 1) % convex.size()];
    if (across(*a) > across(*b)) std::swap(a, b);
    const double width = across(*b) - across(*a);
    if (!(width > 0)) continue;
    const double slope = (along(*b) - along(*a)) / width;
    const auto end = std::min(from(across(*b)), last);
    for (auto i = std::max(from(across(*a)), first); i < end; ++i) {
      const double v = along(*a) + slope * (at(i) - across(*a));
      auto& span = spans_[i - first];
      span.from = std::min(span.from, v);
      span.to = std::max(span.to, v);
    }
  }
}

void Lines::fill(const Polygon& polygon) {
  std::vector<std::vector<double>> crossings(on_.size());
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto *a = &polygon[k], *b = &polygon[(k + 1) % polygon.size()];
    if (across(*a) > across(*b)) std::swap(a, b);
    const double width = across(*b) - across(*a);
    for (auto i = from(across(*a)); i < from(across(*b)); ++i)
      crossings[i].push_back(along(*a) +
                             (along(*b) - along(*a)) * (at(i) - across(*a)) / width);
  }
  for (std::size_t i = 0; i < on_.size(); ++i) {
    auto& all = crossings[i];
    std::sort(all.begin(), all.end());
    for (std::size_t k = 0; k + 1 < all.size(); k += 2)
      on_[i].push_back({all[k], all[k + 1]});
  }
}

void Lines::cut(const Polygon& convex) {
  for_each(convex, [&](std::size_t i, const Interval& span) { take_off(on_[i], span); });
}

void Lines::cut(const Polygon& convex, const Taken& taken) {
  for_each(convex, [&](std::size_t i, const Interval& span) {
    double length = 0;
    for (const auto& a : on_[i]) length += std::max(0.0, common_mm(a, span));
    if (!(length > 0)) return;
    take_off(on_[i], span);
    taken(i, length);
  });
}

double Lines::common(const Polygon& convex) const {
  double most = 0;
  for_each(convex, [&](std::size_t i, const Interval& span) {
    for (const auto& a : on_[i]) most = std::max(most, common_mm(a, span));
  });
  return most;
}

void Lines::keep_only(std::size_t i, const Interval& kept) {
  take_off(on_[i], {-kUnbounded, kept.from});
  take_off(on_[i], {kept.to, kUnbounded});
}

Section::Section(const Spot& low, const Spot& high, double pitch)
    : columns(Family::columns, low.z, high.z, pitch),
      rows(Family::rows, low.x, high.x, pitch) {}

void Section::fill(const Polygon& polygon) {
  columns.fill(polygon);
  rows.fill(polygon);
}

void Section::cut(const Polygon& convex) {
  columns.cut(convex);
  rows.cut(convex);
  if (!crosses_axis(convex)) return;
  columns.cut(mirrored(convex));
  rows.cut(mirrored(convex));
}

void Section::cut(const Polygon& convex, Family family, const Lines::Taken& taken) {
  auto& measured = family == Family::columns ? columns : rows;
  auto& other = family == Family::columns ? rows : columns;
  measured.cut(convex, taken);
  other.cut(convex);
  if (crosses_axis(convex)) cut(mirrored(convex));
}

double Section::depth(const Polygon& convex) const {
  const auto here = [&](const Polygon& polygon) {
    const double c = columns.common(polygon), r = rows.common(polygon);
    return c > 0 && r > 0 ? std::min(c, r) : std::max(c, r);
  };
  const double depth = here(convex);
  return crosses_axis(convex) ? std::max(depth, here(mirrored(convex))) : depth;
}

void Section::drop_loose(double z) {
  std::size_t middle = 0;
  while (middle + 1 < columns.size() && columns.at(middle) < z) ++middle;
  auto from = middle, to = middle;
  while (from > 0 && !columns.on(from - 1).empty()) --from;
  while (to + 1 < columns.size() && !columns.on(to + 1).empty()) ++to;
  bool loose = false;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if ((i < from || i > to) && !columns.on(i).empty()) {
      columns.clear(i);
      loose = true;
    }
  if (!loose) return;
  const double pitch = columns.at(1) - columns.at(0);
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows.keep_only(i, {columns.at(from) - pitch, columns.at(to) + pitch});
}

}  // namespace turnwright::review
