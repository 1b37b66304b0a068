#include "milled_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <queue>
#include <tuple>

#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/interval.hpp"

namespace turnwright::planning {
namespace {

constexpr double kInside = 1e-6;           // ln n: from an excluded speed
constexpr double kBracket = 1e-7;          // ln n: a loss of stability is known to this
constexpr double kCoarse = 4, kFine = 16;  // speeds per margin
constexpr double kRoundingOfSpeed = 1e-9;
constexpr long kSteps = 4000;  // points tried

struct Span {
  double lo, hi;
};

// A speed at which stability ends at `stable` N/mm.
struct Lost {
  double n_rpm, stable;
};
using Losses = std::map<const chatter::Lobes*, std::vector<Lost>>;

// Speeds at which the largest feed is at least fz: one interval.
std::optional<Span> feedable(const MilledCase& c, double fz) {
  Span s{c.n_min_rpm, c.n_max_rpm};
  for (const auto& cap : c.caps) {
    if (cap.e == 0) {
      if (!(cap.c >= fz * (1 - 1e-12))) return {};
      continue;
    }
    const double n = std::pow(fz / cap.c, 1 / cap.e);
    (cap.e > 0 ? s.lo : s.hi) = cap.e > 0 ? std::max(s.lo, n) : std::min(s.hi, n);
  }
  if (!(s.lo <= s.hi)) return {};
  return s;
}

// The least feed that keeps (2) against a loss.
double least_feed_mm(const MilledCase& c, double stable) {
  if (c.mc == 0) return c.load <= stable ? 0 : kInfinity;
  return std::pow(c.load / stable, 1 / c.mc);
}

// The speeds of a case that the known losses have not ruled out.
std::vector<Span> left_by(const MilledCase& c, const std::vector<Lost>& losses) {
  const auto whole = feedable(c, c.fz_min_mm);
  if (!whole) return {};
  std::vector<Span> out;
  for (const auto& l : losses) {
    const Span about{l.n_rpm / (1 + c.speed_margin), l.n_rpm / (1 - c.speed_margin)};
    const auto kept = feedable(c, least_feed_mm(c, l.stable));
    if (!kept) {
      out.push_back(about);
      continue;
    }
    if (about.lo < kept->lo) out.push_back({about.lo, std::min(about.hi, kept->lo)});
    if (about.hi > kept->hi) out.push_back({std::max(about.lo, kept->hi), about.hi});
  }
  std::sort(out.begin(), out.end(),
            [](const Span& a, const Span& b) { return a.lo < b.lo; });
  std::vector<Span> left;
  double from = whole->lo;
  bool cut = false;  // whether the rest begins at a speed that is itself ruled out
  const auto keep = [&](double to) {
    if (to > from * (1 + kRoundingOfSpeed)) left.push_back({from, to});
  };
  for (const auto& s : out) {
    if (s.hi < whole->lo || s.lo > whole->hi) continue;
    keep(std::min(s.lo, whole->hi));
    from = std::max(from, s.hi);
    cut = true;
  }
  if (cut)
    keep(whole->hi);
  else
    left.push_back(*whole);
  return left;
}

// The minimum of a convex cost over the range of ln n, by golden sections.
double cheapest_speed(const MilledCase& c, const Span& s) {
  constexpr double kGolden = 0.6180339887498949;
  double a = std::log(s.lo), b = std::log(s.hi);
  while (b - a > 1e-9) {
    const double x = b - kGolden * (b - a), y = a + kGolden * (b - a);
    if (cost(c, std::exp(x)) <= cost(c, std::exp(y)))
      b = y;
    else
      a = x;
  }
  return std::clamp(std::exp((a + b) / 2), s.lo, s.hi);
}

// The optimum of the relaxation, and a point of its interval away from excluded ends.
struct Try {
  double bound = kInfinity, n_rpm = 0;
};
Try next_try(const MilledCase& c, const std::vector<Lost>& losses) {
  Try best;
  const auto whole = feedable(c, c.fz_min_mm);
  if (!whole) return best;
  const double free = cheapest_speed(c, *whole);
  for (const auto& s : left_by(c, losses)) {
    const double n = std::clamp(free, s.lo, s.hi), bound = cost(c, n);
    if (!(bound < best.bound)) continue;
    const double lo = s.lo > whole->lo ? s.lo * (1 + kInside) : s.lo;
    const double hi = s.hi < whole->hi ? s.hi * (1 - kInside) : s.hi;
    best = {bound, lo <= hi ? std::clamp(n, lo, hi) : std::sqrt(s.lo * s.hi)};
  }
  return best;
}

// Speeds around one: the ends of its margin, and between them those of a lattice that is
// the same for all speeds.
std::vector<double> speeds_about(double n_rpm, double margin, double parts) {
  const double step = std::log1p(margin / parts);
  const double lo = n_rpm * (1 - margin), hi = n_rpm * (1 + margin);
  std::vector<double> u{lo};
  for (double k = std::floor(std::log(lo) / step) + 1;; ++k) {
    const double next = std::exp(k * step);
    if (!(next < hi)) break;
    if (next > lo) u.push_back(next);
  }
  u.push_back(hi);
  return u;
}

// The losses within the margin of a speed that violate (2) there, each located to within
// kBracket of the speed at which it begins.
std::vector<Lost> losses_at(const MilledCase& c, const chatter::Lobes& lobes,
                            double n_rpm, const std::vector<double>& u) {
  const double W = load_N_mm(c, feed_mm(c, n_rpm));
  std::vector<double> stable;
  for (const double n : u) stable.push_back(lobes.stable_to_N_mm(n, W));
  std::vector<Lost> all;
  for (std::size_t k = 0; k < u.size(); ++k) {
    if (stable[k] < W) all.push_back({u[k], stable[k]});
    if (k == 0 || (stable[k] < W) == (stable[k - 1] < W)) continue;
    Lost bad{u[k], stable[k]};
    double good = u[k - 1];
    if (stable[k - 1] < W) bad = {u[k - 1], stable[k - 1]}, good = u[k];
    while (std::abs(std::log(good / bad.n_rpm)) > kBracket) {
      const double middle = std::sqrt(good * bad.n_rpm);
      const double B = lobes.stable_to_N_mm(middle, W);
      if (B < W)
        bad = {middle, B};
      else
        good = middle;
    }
    all.push_back(bad);
  }
  return all;
}

// The losses of some lobes that exclude a speed: at the ends of its margin, then between.
std::vector<Lost> losses_about(const MilledCase& c, const chatter::Lobes* lobes,
                               double n) {
  if (!lobes) return {};
  const double s = c.speed_margin, low = n * (1 - s), high = n * (1 + s);
  auto found = losses_at(c, *lobes, n, {low, n});
  if (found.empty()) found = losses_at(c, *lobes, n, {n, high});
  for (const double parts : {kCoarse, kFine})
    if (found.empty()) found = losses_at(c, *lobes, n, speeds_about(n, s, parts));
  return found;
}

}  // namespace

double feed_mm(const MilledCase& c, double n) {
  double least = kInfinity;
  for (const auto& cap : c.caps) least = std::min(least, cap.c * std::pow(n, cap.e));
  return least;
}

double time_min(const MilledCase& c, double n) {
  return c.path_mm / (feed_mm(c, n) * c.teeth * n);  // Eq. (1)
}

double life_min(const MilledCase& c, double n) {
  return c.T0_min * std::pow(c.n0_rpm / n, 1 / c.nT);
}

double cost(const MilledCase& c, double n) {
  return time_min(c, n) * (c.minute + c.edge / life_min(c, n)) + c.besides;
}

double load_N_mm(const MilledCase& c, double fz) { return c.load * std::pow(fz, -c.mc); }

double stable_to_N_mm(const MilledCase& c, double n, double enough) {
  const double stable = c.lobes->stable_to_N_mm(n, enough);
  return c.between ? c.between->stable_to_N_mm(n, stable) : stable;
}

double stable_around_N_mm(const MilledCase& c, double n_rpm, double enough) {
  double least = enough;
  for (const double n : speeds_about(n_rpm, c.speed_margin, kFine))
    least = std::min(least, stable_to_N_mm(c, n, least));
  return least;
}

MilledOptimum cheapest(const std::vector<MilledCase>& cases) {
  Losses losses;
  // Lower bounds by the losses known at the time: least first, then by index.
  using Open = std::tuple<double, std::size_t>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  for (std::size_t i = 0; i < cases.size(); ++i)
    open.emplace(next_try(cases[i], {}).bound, i);
  MilledOptimum best;
  best.cost = best.lower_bound = kInfinity;
  while (!open.empty()) {
    const auto [bound, i] = open.top();
    if (!(bound < best.cost)) break;
    if (best.steps == kSteps) {
      best.proved = false;
      break;
    }
    open.pop();
    leave_if_asked();
    const auto& c = cases[i];
    auto& known = losses[c.lobes];
    const auto now = next_try(c, known);
    if (now.bound > bound) {  // losses found meanwhile have raised it
      if (now.bound < kInfinity) open.emplace(now.bound, i);
      continue;
    }
    ++best.steps;
    auto found = losses_about(c, c.lobes, now.n_rpm);
    if (found.empty()) found = losses_about(c, c.between, now.n_rpm);
    known.insert(known.end(), found.begin(), found.end());
    if (!found.empty()) {
      open.emplace(bound, i);
      continue;
    }
    // The optimum of the case, up to the width of kInside.
    best.lower_bound = std::min(best.lower_bound, bound);
    const double at = cost(c, now.n_rpm);
    if (!(at < best.cost)) continue;
    best.found = true;
    best.index = i;
    best.n_rpm = now.n_rpm;
    best.cost = at;
  }
  if (!open.empty())
    best.lower_bound = std::min(best.lower_bound, std::get<0>(open.top()));
  return best;
}

}  // namespace turnwright::planning
