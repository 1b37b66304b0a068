#include "turnwright/catalogue/chip_window.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace turnwright::catalogue {
namespace {

constexpr double kRounding = 1e-12;  // of logarithms and of areas in them

struct Vertex {
  double x = 0, y = 0;  // ln ap, ln f
};
using Polygon = std::vector<Vertex>;

// Twice the area of a triangle, positive where it turns left.
double turn(const Vertex& a, const Vertex& b, const Vertex& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

Polygon logs(const std::vector<ChipPoint>& points) {
  Polygon p;
  for (const auto& v : points) p.push_back({std::log(v.ap_mm), std::log(v.f_mm_rev)});
  return p;
}

double area(const Polygon& p) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) sum += turn(p[0], p[i], p[i + 1]);
  return sum / 2;
}

bool between(const Vertex& a, const Vertex& b, const Vertex& x) {
  return std::min(a.x, b.x) <= x.x && x.x <= std::max(a.x, b.x) &&
         std::min(a.y, b.y) <= x.y && x.y <= std::max(a.y, b.y);
}

// Whether two closed segments have a point in common.
bool meet(const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d) {
  const double ca = turn(c, d, a), cb = turn(c, d, b);
  const double ac = turn(a, b, c), ad = turn(a, b, d);
  if (((ca > 0 && cb < 0) || (ca < 0 && cb > 0)) &&
      ((ac > 0 && ad < 0) || (ac < 0 && ad > 0)))
    return true;
  return (ca == 0 && between(c, d, a)) || (cb == 0 && between(c, d, b)) ||
         (ac == 0 && between(a, b, c)) || (ad == 0 && between(a, b, d));
}

std::size_t next(const Polygon& p, std::size_t i) { return (i + 1) % p.size(); }
std::size_t previous(const Polygon& p, std::size_t i) {
  return (i + p.size() - 1) % p.size();
}

bool inward(const Polygon& p, std::size_t i) {
  return turn(p[previous(p, i)], p[i], p[next(p, i)]) < -kRounding;
}
long inward(const Polygon& p) {
  long n = 0;
  for (std::size_t i = 0; i < p.size(); ++i) n += inward(p, i);
  return n;
}

// Whether vertex j lies in the angle that the polygon has at vertex i.
bool in_angle(const Polygon& p, std::size_t i, std::size_t j) {
  const auto &a = p[previous(p, i)], &b = p[next(p, i)];
  const bool left = turn(p[i], b, p[j]) > kRounding;
  const bool right = turn(p[i], p[j], a) > kRounding;
  return inward(p, i) ? left || right : left && right;
}

bool is_diagonal(const Polygon& p, std::size_t i, std::size_t j) {
  if (j == i || j == next(p, i) || j == previous(p, i)) return false;
  if (!in_angle(p, i, j) || !in_angle(p, j, i)) return false;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const std::size_t l = next(p, k);
    if (k == i || k == j || l == i || l == j) continue;
    if (meet(p[i], p[j], p[k], p[l])) return false;
  }
  return true;
}

// The vertices from i to j.
Polygon part(const Polygon& p, std::size_t i, std::size_t j) {
  Polygon out{p[i]};
  while (i != j) out.push_back(p[i = next(p, i)]);
  return out;
}

void split(const Polygon& p, std::vector<Polygon>& convex) {
  std::size_t i = 0;
  while (i < p.size() && !inward(p, i)) ++i;
  if (i == p.size()) {
    convex.push_back(p);
    return;
  }
  std::optional<std::size_t> best;
  long least = std::numeric_limits<long>::max();
  for (std::size_t j = 0; j < p.size(); ++j) {
    if (!is_diagonal(p, i, j)) continue;
    const long left = inward(part(p, i, j)) + inward(part(p, j, i));
    if (left < least) {
      least = left;
      best = j;
    }
  }
  split(part(p, i, *best), convex);
  split(part(p, *best, i), convex);
}

ChipPiece piece_of(const Polygon& p) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vertex low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  for (const auto& v : p) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y)};
  }
  ChipPiece piece{
      {std::exp(low.x), std::exp(high.x)}, {std::exp(low.y), std::exp(high.y)}, {}};
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto &a = p[i], &b = p[next(p, i)];
    if (std::abs(b.x - a.x) <= kRounding || std::abs(b.y - a.y) <= kRounding) continue;
    const double m = (b.y - a.y) / (b.x - a.x);
    piece.edges.push_back({std::exp(a.y - m * a.x), m, b.x < a.x});
  }
  return piece;
}

}  // namespace

bool is_simple(const std::vector<ChipPoint>& polygon) {
  const auto p = logs(polygon);
  if (p.size() < 3 || !(std::abs(area(p)) > kRounding)) return false;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const std::size_t j = next(p, i);
    if (std::hypot(p[j].x - p[i].x, p[j].y - p[i].y) <= kRounding) return false;
    for (std::size_t k = i + 1; k < p.size(); ++k) {
      const std::size_t l = next(p, k);
      if (k == j || l == i) {  // neighbours may not run back on each other
        const auto &at = k == j ? p[j] : p[i], &a = k == j ? p[i] : p[j],
                   &b = k == j ? p[l] : p[k];
        const bool back = (a.x - at.x) * (b.x - at.x) + (a.y - at.y) * (b.y - at.y) > 0;
        if (back && std::abs(turn(a, at, b)) <= kRounding) return false;
      } else if (meet(p[i], p[j], p[k], p[l])) {
        return false;
      }
    }
  }
  return true;
}

std::vector<ChipPiece> convex_pieces(const std::vector<ChipPoint>& polygon) {
  auto p = logs(polygon);
  if (area(p) < 0) std::reverse(p.begin(), p.end());
  std::vector<Polygon> convex;
  split(p, convex);
  std::vector<ChipPiece> pieces;
  for (const auto& c : convex) pieces.push_back(piece_of(c));
  return pieces;
}

bool holds(const ChipPiece& piece, const ChipPoint& x) {
  const auto within = [](double value, const Range& r) {
    return value >= r.lower * (1 - kRounding) && value <= r.upper * (1 + kRounding);
  };
  return within(x.ap_mm, piece.ap_mm) && within(x.f_mm_rev, piece.f_mm_rev) &&
         std::all_of(piece.edges.begin(), piece.edges.end(), [&](const ChipEdge& e) {
           const double edge = e.f1_mm_rev * std::pow(x.ap_mm, e.exponent);
           return e.upper ? x.f_mm_rev <= edge * (1 + kRounding)
                          : x.f_mm_rev >= edge * (1 - kRounding);
         });
}

}  // namespace turnwright::catalogue
