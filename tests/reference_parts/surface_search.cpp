#include "surface_search.hpp"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <numeric>

#include "planning/operation/evaluate.hpp"

namespace turnwright::reference {
namespace {

using planning::Choice;
using planning::CutTolerance;

constexpr int kPlaces = 41;
constexpr double kRounding = 1e-12;

// value/limit - 1, infinite where it is no number.
double excess(double value, double limit) {
  const double x = limit > 0 ? value / limit - 1 : value <= limit ? 0 : kInfinity;
  return std::isnan(x) ? kInfinity : x;
}

// Largest of equally spaced values, with the parabola through it and its neighbours.
double largest(const std::vector<double>& e) {
  const auto k =
      static_cast<std::size_t>(std::max_element(e.begin(), e.end()) - e.begin());
  if (k == 0 || k + 1 == e.size()) return e[k];
  const double bend = e[k - 1] - 2 * e[k] + e[k + 1], slope = (e[k + 1] - e[k - 1]) / 2;
  return bend < 0 ? e[k] - slope * slope / (2 * bend) : e[k];
}

double span(std::vector<double> e) {
  const double top = largest(e);
  for (double& x : e) x = -x;
  return top + largest(e);
}

// Width of the narrowest strip: the span about a line is convex in its slope.
double strip_width(const std::vector<double>& e) {
  const auto tilted = [&](double rise) {
    auto t = e;
    for (std::size_t k = 0; k < t.size(); ++k)
      t[k] -= rise * static_cast<double>(k) / static_cast<double>(t.size() - 1);
    return span(t);
  };
  const double most = 2 * span(e), golden = (std::sqrt(5.0) - 1) / 2;
  double a = -most, b = most;
  double x = b - golden * (b - a), y = a + golden * (b - a);
  double fx = tilted(x), fy = tilted(y);
  for (int k = 0; k < 60; ++k) {
    if (fx < fy) {
      b = y, y = x, fy = fx;
      x = b - golden * (b - a), fx = tilted(x);
    } else {
      a = x, x = y, fx = fy;
      y = a + golden * (b - a), fy = tilted(y);
    }
  }
  return std::min(fx, fy);
}

std::vector<double> places(const planning::MachinedSurface& f, int count) {
  std::vector<double> z;
  for (int k = 0; k < count; ++k)
    z.push_back(f.low_mm() + (f.high_mm() - f.low_mm()) * k / (count - 1));
  return z;
}

bool asks_nothing(const std::vector<CutTolerance>& cut_tolerances) {
  return std::all_of(
      cut_tolerances.begin(), cut_tolerances.end(),
      [](const CutTolerance& d) { return d.shape == CutTolerance::Shape::none; });
}

bool feasible(const Point& p) { return p.excess <= kRounding; }

}  // namespace

bool better(const Point& a, const Point& b) {
  if (feasible(a) != feasible(b)) return feasible(a);
  return feasible(a) ? a.cost < b.cost : a.excess < b.excess;
}

SurfaceSearch::SurfaceSearch(const planning::MachinedSurface& feature,
                             std::vector<CutTolerance> cut_tolerances,
                             const planning::Recipe& recipe,
                             const planning::Economy& economy, const Effort& effort)
    : feature_(&feature),
      cut_tolerances_(std::move(cut_tolerances)),
      recipe_(recipe),
      economy_(economy),
      effort_(effort) {
  auto chain = feature.chain(recipe, economy, {});
  if (!chain) return;
  double low = chain->a.lower, high = chain->a.upper;
  for (const auto& o : chain->operations) {
    const auto& d = o.depth_mm;
    if (d.c1 == 0) {
      if (d.c0 < o.ap.lower * (1 - kRounding) || d.c0 > o.ap.upper * (1 + kRounding))
        return;
      continue;
    }
    const auto [x, y] =
        std::minmax({(o.ap.lower - d.c0) / d.c1, (o.ap.upper - d.c0) / d.c1});
    low = std::max(low, x);
    high = std::min(high, y);
  }
  if (!(low <= high * (1 + kRounding))) return;
  if (!asks_nothing(cut_tolerances_))
    chain = feature.chain(recipe, economy, places(feature, kPlaces));
  feature.limit_chatter(*chain);
  chain_ = std::move(*chain);
  for (const auto& o : chain_.operations) {
    planning::Chain c;
    c.operations = {o};
    c.weights = chain_.weights;
    single_.push_back(std::move(c));
  }
  high = std::max(high, low);
  axes_.push_back({std::log(low), std::log(high), high > low ? effort.depths : 1});
  for (const auto& o : chain_.operations)
    axes_.push_back({std::log(o.f.lower), std::log(o.f.upper),
                     o.f.lower < o.f.upper ? effort.feeds : 1});
}

Point SurfaceSearch::evaluated(std::size_t i, const Choice<double>& c,
                               double& fixed_excess) const {
  Point p{c, -1, 0};
  fixed_excess = -1;
  p.cost = planning::evaluate(
      single_[i], c,
      [&](std::size_t, planning::Check, bool speed, double value, double limit) {
        const double x = excess(value, limit);
        p.excess = std::max(p.excess, x);
        if (!speed) fixed_excess = std::max(fixed_excess, x);
      });
  if (!std::isfinite(p.cost)) p.excess = kInfinity;
  return p;
}

// Scan of the speed range, then steps that halve about the best.
Point SurfaceSearch::at_best_speed(std::size_t i, double f, double a, bool fine) const {
  const auto& range = single_[i].operations[0].vc;
  const double low = std::log(range.lower), high = std::log(range.upper);
  double fixed = 0;
  const auto at = [&](double y) {
    const double v = y <= low ? range.lower : y >= high ? range.upper : std::exp(y);
    return evaluated(i, {{v, 0}, {f, 0}, a}, fixed);
  };
  Point best = at(low);
  if (fixed > kRounding) return best;  // no speed helps
  const int n = effort_.speeds;
  double y = low, step = (high - low) / (n - 1);
  for (int k = 1; k < n; ++k)
    if (const auto p = at(low + step * k); better(p, best)) best = p, y = low + step * k;
  for (step /= 2; step > (fine ? 1e-2 * effort_.finest : 1e-3);) {
    const double before = y;
    for (const double z : {before - step, before + step})
      if (const auto p = at(std::clamp(z, low, high)); better(p, best))
        best = p, y = std::clamp(z, low, high);
    if (y == before) step /= 2;
  }
  return best;
}

double SurfaceSearch::excess_of(const std::vector<double>& e, double reserve) const {
  double worst = -1;
  using enum CutTolerance::Shape;
  for (const auto& d : cut_tolerances_) {
    if (d.shape == none) continue;
    const double limit = (1 - reserve) * d.upper;
    double value = 0;
    if (d.shape == size) {
      std::vector<double> m = e;
      for (double& x : m) x = -x;
      value = d.factor * std::max(largest(e), largest(m));
    } else {
      value = d.shape == straightness ? strip_width(e) : d.factor * span(e);
      if (d.shape == centred) value /= 2;
    }
    worst = std::max(worst, excess(value, limit));
  }
  return worst;
}

double SurfaceSearch::tolerance_excess(const Choice<double>& c) const {
  if (asks_nothing(cut_tolerances_)) return -1;
  const auto F = planning::forces(chain_, c);
  std::vector<double> e;
  for (const auto& s : chain_.stations) e.push_back(planning::error_mm(chain_, s, c, F));
  return excess_of(e, kReserve);
}

double SurfaceSearch::tolerance_excess(const Choice<double>& c, int count) const {
  if (asks_nothing(cut_tolerances_)) return -1;
  return excess_of(feature_->errors(recipe_, economy_, c, places(*feature_, count)), 0);
}

SurfaceSearch::Lattice SurfaceSearch::whole() const {
  Lattice l;
  for (const auto& axis : axes_) {
    l.x.emplace_back();
    for (int k = 0; k < axis.count; ++k)
      l.x.back().push_back(axis.low +
                           (axis.high - axis.low) * k / std::max(1, axis.count - 1));
  }
  return l;
}

std::vector<double> SurfaceSearch::spacing() const {
  std::vector<double> h;
  for (const auto& axis : axes_)
    h.push_back(axis.count > 1 ? (axis.high - axis.low) / (axis.count - 1) : 0);
  return h;
}

// Speeds depend on their own operation alone, so each (a, f) is solved once; the pairs of
// feeds are then tried cheapest first, and the first that keeps the tolerances is best.
Point SurfaceSearch::lattice_best(const Lattice& l, const Point& incumbent,
                                  bool tolerances, bool fine,
                                  std::vector<Point>* starts) const {
  const std::size_t operations = single_.size();
  const std::vector<double> one{0};
  const auto& second = operations > 1 ? l.x[2] : one;
  std::vector<std::vector<Point>> table[2];
  std::vector<Cell> cells;
  for (std::size_t k = 0; k < l.x[0].size(); ++k) {
    const double a = std::exp(l.x[0][k]);
    for (std::size_t i = 0; i < operations; ++i) {
      table[i].emplace_back();
      for (const double y : l.x[i + 1])
        table[i].back().push_back(at_best_speed(i, std::exp(y), a, fine));
    }
    for (std::size_t m = 0; m < l.x[1].size(); ++m)
      for (std::size_t n = 0; n < second.size(); ++n) {
        Cell c{{k, m, n}, 0, -1};
        for (std::size_t i = 0; i < operations; ++i) {
          const auto& p = table[i][k][i == 0 ? m : n];
          c.cost += p.cost;
          c.excess = std::max(c.excess, p.excess);
        }
        cells.push_back(c);
      }
  }
  std::sort(cells.begin(), cells.end(), [](const Cell& x, const Cell& y) {
    const bool p = x.excess <= kRounding, q = y.excess <= kRounding;
    return p != q ? p : p ? x.cost < y.cost : x.excess < y.excess;
  });
  Point best = incumbent;
  std::vector<std::size_t> depths;  // of the starts: no two at the same
  for (const auto& c : cells) {
    const bool open = c.excess <= kRounding;
    if (feasible(best) && (!open || (c.cost >= best.cost && !starts))) break;
    if (!open && c.excess >= best.excess) break;
    Point p;
    p.cost = c.cost;
    p.excess = c.excess;
    p.choice.a = std::exp(l.x[0][c.k[0]]);
    for (std::size_t i = 0; i < operations; ++i) {
      const auto& o = table[i][c.k[0]][c.k[i + 1]].choice;
      p.choice.v[i] = o.v[0];
      p.choice.f[i] = o.f[0];
    }
    if (tolerances && open) p.excess = std::max(p.excess, tolerance_excess(p.choice));
    if (starts && feasible(p) &&
        std::find(depths.begin(), depths.end(), c.k[0]) == depths.end()) {
      depths.push_back(c.k[0]);
      starts->push_back(p);
    }
    if (better(p, best)) best = p;
    if (starts && starts->size() >= static_cast<std::size_t>(effort_.starts)) break;
  }
  if (starts && starts->empty()) starts->push_back(best);
  return best;
}

// Lattices of five points a side about the best point; half as wide when it stays.
Point SurfaceSearch::refine(Point p, bool tolerances) const {
  auto h = spacing();
  for (int round = 0; round < 200; ++round) {
    if (*std::max_element(h.begin(), h.end()) < effort_.finest) break;
    Lattice l;
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      const double x = std::log(k == 0 ? p.choice.a : p.choice.f[k - 1]);
      std::vector<double> side{x};
      for (const double s : {-1.0, -0.5, 0.5, 1.0})
        if (h[k] > 0)
          side.push_back(std::clamp(x + s * h[k], axes_[k].low, axes_[k].high));
      std::sort(side.begin(), side.end());
      side.erase(std::unique(side.begin(), side.end()), side.end());
      l.x.push_back(std::move(side));
    }
    const auto next = lattice_best(l, p, tolerances, true, nullptr);
    const bool moved = feasible(p) ? next.cost < p.cost * (1 - 1e-9) : better(next, p);
    if (better(next, p)) p = next;
    if (!moved)
      for (double& x : h) x /= 2;
  }
  return p;
}

/// All conditions at once, with every check and demand a constraint.
struct Cobyla {
  const SurfaceSearch& s;
  Point best;

  Choice<double> choice(const std::vector<double>& y) const {
    Choice<double> c;
    const std::size_t n = s.single_.size();
    for (std::size_t i = 0; i < n; ++i) {
      c.v[i] = std::exp(y[i]);
      c.f[i] = std::exp(y[n + i]);
    }
    c.a = std::exp(y[2 * n]);
    return c;
  }

  std::vector<double> checks(const Choice<double>& c, double& cost) const {
    std::vector<double> g;
    cost = planning::evaluate(
        s.chain_, c, [&](std::size_t, planning::Check, bool, double value, double limit) {
          g.push_back(std::clamp(excess(value, limit), -1.0, 10.0));
        });
    g.push_back(std::min(s.tolerance_excess(c), 10.0));
    return g;
  }

  void keep(const Choice<double>& c, double cost, const std::vector<double>& g) {
    const Point p{c, *std::max_element(g.begin(), g.end()), cost};
    if (std::isfinite(cost) && better(p, best)) best = p;
  }
};

Point SurfaceSearch::polish(Point p) const {
  const std::size_t n = single_.size();
  std::vector<double> y(2 * n + 1), low(y), high(y);
  for (std::size_t i = 0; i < n; ++i) {
    const auto& vc = single_[i].operations[0].vc;
    y[i] = std::log(p.choice.v[i]);
    low[i] = std::log(vc.lower);
    high[i] = std::log(vc.upper);
    y[n + i] = std::log(p.choice.f[i]);
    low[n + i] = axes_[i + 1].low;
    high[n + i] = axes_[i + 1].high;
  }
  y[2 * n] = std::log(p.choice.a);
  low[2 * n] = axes_[0].low;
  high[2 * n] = axes_[0].high;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = std::clamp(y[i], low[i], high[i]);

  Cobyla c{*this, p};
  double cost = 0;
  const auto rows = static_cast<unsigned>(c.checks(p.choice, cost).size());
  nlopt::opt opt(nlopt::LN_COBYLA, static_cast<unsigned>(y.size()));
  opt.set_lower_bounds(low);
  opt.set_upper_bounds(high);
  opt.set_min_objective(
      [](const std::vector<double>& x, std::vector<double>&, void* data) {
        auto& self = *static_cast<Cobyla*>(data);
        double value = 0;
        const auto choice = self.choice(x);
        const auto g = self.checks(choice, value);
        self.keep(choice, value, g);
        return std::log(value);
      },
      &c);
  opt.add_inequality_mconstraint(
      [](unsigned m, double* result, unsigned count, const double* x, double*,
         void* data) {
        const auto& self = *static_cast<Cobyla*>(data);
        double value = 0;
        const auto g = self.checks(self.choice({x, x + count}), value);
        for (unsigned k = 0; k < m; ++k) result[k] = g[k] + 1e-10;
      },
      &c, std::vector<double>(rows, 0));
  opt.set_initial_step(1e-3);
  opt.set_xtol_rel(1e-10);
  opt.set_maxeval(2000);
  try {
    double value = 0;
    opt.optimize(y, value);
  } catch (const std::exception&) {  // rounding ends it: the best point seen stands
  }
  return c.best;
}

Point SurfaceSearch::at(const Choice<double>& c) const {
  Point p{c, -1, 0};
  p.cost = planning::evaluate(
      chain_, c,
      [&](std::size_t, planning::Check check, bool, double value, double limit) {
        if (check != planning::Check::tolerance)
          p.excess = std::max(p.excess, excess(value, limit));
      });
  return p;
}

Point SurfaceSearch::without_tolerances() const {
  std::vector<Point> starts;
  lattice_best(whole(), {}, false, false, &starts);
  return refine(starts.front(), false);
}

Point SurfaceSearch::best() const {
  std::vector<Point> starts;
  Point best = lattice_best(whole(), {}, true, false, &starts);
  for (const auto& s : starts) {
    const auto p = refine(s, true);
    if (better(p, best)) best = p;
  }
  if (feasible(best)) best = polish(best);
  return best;
}

}  // namespace turnwright::reference
