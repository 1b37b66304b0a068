#include "operating_window.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>
#include <utility>

#include "planning/limits/limit_table.hpp"
#include "tolerance_points.hpp"
#include "turnwright/base/interval.hpp"

namespace turnwright::planning {
namespace {

constexpr double kLimitKept = 8e-10;  // beyond a limit: what the optimum's places leave
constexpr int kLooks = 24;            // feeds looked at to each side of the optimum
constexpr int kBisections = 20;       // of a feed
constexpr int kPositionRounds = 20;   // of adding positions of tolerances
constexpr int kStretches = 8;         // of a curve to begin with
constexpr int kHalvings = 8;          // of one of them
constexpr double kChord = 1e-4;       // ln: how far a chord may be from its curve
constexpr double kMeets = 1e-9;       // of the feed: where one limit takes over
constexpr std::size_t kCost = 1000;   // in place of a limit's number

std::string cost_name(double percent) { return fmt::format("cost +{:g} %", percent); }

// The limits that end the speeds of one feed.
struct End {
  double v = 0;
  std::size_t by = kCost;  // number among the speed limits
};
struct Speeds {
  End lower, upper;
};

// One operation at its depth, with the others as chosen.
struct Slice {
  const PreparedPart& plan;
  const Chain& chain;
  Choice<double> at;
  std::size_t i;

  const OperationModel& o() const { return chain.operations[i]; }
  Choice<double> with(double f) const {
    auto c = at;
    c.f[i] = f;
    return c;
  }
  cutting::Forces<double> force(double f) const { return limiting_forces(o(), f, at.a); }
  double cost(double v, double f, double n_cap) const {
    const double life = cutting::tool_life_min(o().cut, v, f, o().depth_mm(at.a));
    return objective(o(), chain.weights, duty(o(), v, f, at.a, n_cap, life), at.a);
  }
  double cost(double v, double f) const {
    return cost(v, f, spindle_cap(o(), force(f), at.a));
  }

  // The first limit of the feed alone that is not kept.
  std::optional<Row> broken(double f) const {
    const auto c = with(f);
    std::optional<Row> row;
    const auto sink = [&](std::size_t k, Check check, bool, double v, double limit) {
      if (!row && !(v <= limit + kLimitKept * std::abs(limit)))
        row = Row{k, check, false};
    };
    depth_checks(o(), f, at.a, force(f), tagged<double>(sink, i, false));
    chatter_checks(o(), i, f, at.a, sink);
    if (!row) tolerance_checks(chain, c, forces(chain, c), sink);
    return row;
  }

  // The speeds that every limit leaves, and those that cost no more than `most`.
  std::optional<Speeds> speeds(double f, double most) const {
    const auto F = force(f);
    const double n_cap = spindle_cap(o(), F, at.a);
    Speeds s{{o().vc.lower}, {o().vc.upper}};
    std::size_t k = 0;
    s.lower.by = s.upper.by = kCost + 1;
    speed_limits(o(), f, at.a, F, n_cap, [&](bool upper, double v) {
      if (upper ? v < s.upper.v || (v == s.upper.v && s.upper.by > kCost)
                : v > s.lower.v || (v == s.lower.v && s.lower.by > kCost))
        (upper ? s.upper : s.lower) = {v, k};
      ++k;
    });
    if (!(s.lower.v <= s.upper.v * (1 + kLimitKept))) return {};
    s.upper.v = std::max(s.lower.v, s.upper.v);
    const double best = best_speed(o(), f, at.a, Window<double>{s.lower.v, s.upper.v}).v;
    if (!(cost(best, f, n_cap) <= most)) return {};
    const auto end = [&](End& e) {
      if (cost(e.v, f, n_cap) <= most) return;
      e = {speed_at(f, n_cap, most, best, e.v), kCost};
    };
    end(s.lower);
    end(s.upper);
    return s;
  }

  // Between a speed that costs no more than `most` and one that does, the former's side.
  double speed_at(double f, double n_cap, double most, double in, double out) const {
    std::uintmax_t steps = 60;
    const auto excess = [&](double y) { return cost(std::exp(y), f, n_cap) / most - 1; };
    const double a = std::log(in), b = std::log(out);
    if (!(excess(a) < 0)) return in;
    const auto [low, high] = boost::math::tools::toms748_solve(
        excess, std::min(a, b), std::max(a, b),
        boost::math::tools::eps_tolerance<double>(46), steps);
    return std::exp(a < b ? low : high);
  }

  bool holds(double f, double most) const {
    if (broken(f)) return false;
    const auto F = force(f);
    const double n_cap = spindle_cap(o(), F, at.a);
    const auto w = speed_window(o(), f, at.a, F, n_cap);
    if (!(w.lower <= w.upper * (1 + kLimitKept))) return false;
    return cost(best_speed(o(), f, at.a, w).v, f, n_cap) <= most;
  }

  // From the optimum's feed towards another: the last that the window holds.
  double furthest(double to, double most) const {
    const double from = at.f[i];
    double in = from;
    for (int k = 1; k <= kLooks; ++k) {
      double out = k == kLooks ? to : from * std::pow(to / from, double(k) / kLooks);
      if (holds(out, most)) {
        in = out;
        continue;
      }
      for (int step = 0; step < kBisections; ++step) {
        const double middle = std::sqrt(in * out);
        (holds(middle, most) ? in : out) = middle;
      }
      break;
    }
    return in;
  }

  std::string limit_name(std::size_t by) const {
    std::vector<Check> checks;
    const auto F = force(at.f[i]);
    speed_checks(o(), at.v[i], at.f[i], at.a, F, spindle_cap(o(), F, at.a),
                 [&](Check c, double, double) { checks.push_back(c); });
    return by < checks.size() ? row_name(plan, chain, {i, checks[by], true})
                              : std::string(limit_row(Check::speed_window).name);
  }
};

struct Vertex {
  double f = 0;
  End end;
  double other = 0;  // the speed at the other end
  double inset = 0;  // ln
  // Moved inwards, to the middle of its speeds at most.
  double speed() const {
    const double half = std::log(other / end.v) / 2;
    return end.v * std::exp(std::clamp(std::copysign(inset, half), -std::abs(half),
                                       std::abs(half)));
  }
};

struct Feeds {
  double low = 0, high = 0;
};

// One of the two curves over the feeds.
class Side {
 public:
  Side(const Slice& slice, double most, const Feeds& feeds, bool upper)
      : slice_(slice), most_(most), feeds_(feeds), upper_(upper) {}

  std::vector<Vertex> vertices() {
    Vertex before = at(0);
    all_ = {before};
    for (int k = 1; k <= kStretches; ++k) {
      const double t0 = double(k - 1) / kStretches, t1 = double(k) / kStretches;
      const Vertex after = at(t1);
      follow(t0, before, t1, after, kHalvings);
      before = after;
    }
    return all_;
  }

 private:
  // Feeds close in on both ends, where the curve may be as steep as a root.
  Vertex at(double t) const {
    const double f = t == 0   ? feeds_.low
                     : t == 1 ? feeds_.high
                              : feeds_.low * std::pow(feeds_.high / feeds_.low,
                                                      (1 - std::cos(units::kPi * t)) / 2);
    const auto s = slice_.speeds(f, most_);
    if (!s) return {f, {slice_.at.v[slice_.i], kCost}, slice_.at.v[slice_.i]};
    if (upper_) return {f, s->upper, s->lower.v};
    return {f, s->lower, s->upper.v};
  }

  // Between two places of the curve, the first already there.
  void follow(double t0, Vertex a, double t1, const Vertex& b, int halvings) {
    if (a.end.by != b.end.by && std::abs(std::log(b.f / a.f)) > kMeets) {
      double in = t0, out = t1;
      Vertex last = a, first = b;
      while (std::abs(std::log(first.f / last.f)) > kMeets) {
        const double t = (in + out) / 2;
        const Vertex v = at(t);
        (v.end.by == a.end.by ? in : out) = t;
        (v.end.by == a.end.by ? last : first) = v;
      }
      follow(t0, a, in, last, halvings);
      all_.push_back(first);
      follow(out, first, t1, b, halvings);
      return;
    }
    const double t = (t0 + t1) / 2;
    const Vertex m = at(t);
    const double x = std::log(m.f / a.f) / std::log(b.f / a.f);
    const double bent = std::log(a.end.v) + x * std::log(b.end.v / a.end.v);
    const double y = (m.f - a.f) / (b.f - a.f);
    const double flat = std::log(a.end.v + y * (b.end.v - a.end.v));
    const double v = std::log(m.end.v), out = upper_ ? 1 : -1;
    const double off = std::max(std::abs(bent - v), std::abs(flat - v));
    if (off > kChord && halvings > 0 && t0 < t && t < t1) {
      follow(t0, a, t, m, halvings - 1);
      follow(t, m, t1, b, halvings - 1);
      return;
    }
    const double beyond = 1.2 * std::max({0.0, out * (bent - v), out * (flat - v)});
    all_.back().inset = std::max(all_.back().inset, beyond);
    all_.push_back(b);
    all_.back().inset = beyond;
  }

  const Slice& slice_;
  double most_;
  Feeds feeds_;
  bool upper_;
  std::vector<Vertex> all_;
};

// The limit that ends the feeds at f, towards the end of the range.
std::string end_name(const Slice& s, double f, double range_end) {
  if (f == range_end)
    return limit_row(f == s.o().f.upper ? Check::feed_max : Check::feed_min).name;
  const double next = f * std::pow(range_end / f, 1e-6);
  if (const auto row = s.broken(next)) return row_name(s.plan, s.chain, *row);
  return s.speeds(next, kInfinity) ? cost_name(s.plan.window_percent)
                                   : limit_row(Check::speed_window).name;
}

OperatingWindow polygon(const Slice& s, const Feeds& feeds, double percent, double most) {
  OperatingWindow w;
  w.percent = percent;
  const auto name = [&](std::size_t by) {
    return by == kCost ? cost_name(percent) : s.limit_name(by);
  };
  auto up = Side(s, most, feeds, true).vertices();
  auto down = Side(s, most, feeds, false).vertices();
  const auto add = [&](double v, double f, const std::string& limit) {
    w.vc_m_min.push_back(v);
    w.f_mm_rev.push_back(f);
    w.limits.push_back(limit);
  };
  for (std::size_t k = 0; k < up.size(); ++k)
    add(up[k].speed(), up[k].f,
        k + 1 < up.size() ? name(up[k + 1].end.by)
                          : end_name(s, feeds.high, s.o().f.upper));
  for (std::size_t k = down.size(); k-- > 0;)
    add(down[k].speed(), down[k].f,
        k > 0 ? name(down[k - 1].end.by) : end_name(s, feeds.low, s.o().f.lower));
  return w;
}

double area(const OperatingWindow& w) {
  double sum = 0;
  for (std::size_t k = 0; k < w.vc_m_min.size(); ++k) {
    const std::size_t l = (k + 1) % w.vc_m_min.size();
    sum += std::log(w.vc_m_min[k] / w.vc_m_min[0]) * std::log(w.f_mm_rev[l]) -
           std::log(w.vc_m_min[l] / w.vc_m_min[0]) * std::log(w.f_mm_rev[k]);
  }
  return sum / 2;
}

constexpr int kDrawn = 49;                 // feeds of a curve that is drawn
constexpr double kAround = 1.25;           // of the window's speeds and feeds
constexpr double kLevels[] = {0.5, 1, 2};  // of the percentage, drawn

// The lines drawn around a window.
struct Frame {
  double v0, v1, f0, f1;
  double f(int k) const { return f0 * std::pow(f1 / f0, double(k) / (kDrawn - 1)); }
};

Frame frame_of(const OperatingWindow& w) {
  const auto [v0, v1] = std::minmax_element(w.vc_m_min.begin(), w.vc_m_min.end());
  const auto [f0, f1] = std::minmax_element(w.f_mm_rev.begin(), w.f_mm_rev.end());
  return {*v0 / kAround, *v1 * kAround, *f0 / kAround, *f1 * kAround};
}

void add_limit_curves(const Slice& s, const Frame& frame, OperatingWindow& w) {
  std::vector<WindowCurve> curves;
  for (int step = 0; step < kDrawn; ++step) {
    const double f = frame.f(step);
    const auto F = s.force(f);
    std::size_t k = 0;
    speed_limits(s.o(), f, s.at.a, F, spindle_cap(s.o(), F, s.at.a), [&](bool, double v) {
      if (k == curves.size()) curves.push_back({s.limit_name(k), {}, {}});
      if (v >= frame.v0 && v <= frame.v1) {
        curves[k].vc_m_min.push_back(v);
        curves[k].f_mm_rev.push_back(f);
      }
      ++k;
    });
  }
  for (auto& c : curves)
    if (c.f_mm_rev.size() > 1) w.limit_curves.push_back(std::move(c));
}

// To either side of the cheapest speed of each feed.
void add_cost_curves(const Slice& s, const Frame& frame, double optimum,
                     OperatingWindow& w) {
  for (const double level : kLevels) {
    const double percent = level * w.percent, most = optimum * (1 + percent / 100);
    for (const double outer : {frame.v0, frame.v1}) {
      WindowCurve c{cost_name(percent), {}, {}};
      for (int step = 0; step < kDrawn; ++step) {
        const double f = frame.f(step);
        const double n_cap = spindle_cap(s.o(), s.force(f), s.at.a);
        const double best =
            best_speed(s.o(), f, s.at.a, Window<double>{frame.v0, frame.v1}).v;
        if (s.cost(best, f, n_cap) > most || s.cost(outer, f, n_cap) <= most) continue;
        c.vc_m_min.push_back(s.speed_at(f, n_cap, most, best, outer));
        c.f_mm_rev.push_back(f);
      }
      if (c.f_mm_rev.size() > 1) w.cost_curves.push_back(std::move(c));
    }
  }
}

}  // namespace

std::optional<OperatingWindow> operating_window(const PreparedPart& plan,
                                                const SolvedSurface& solved,
                                                std::size_t i) {
  const auto& task = solved.task;
  const auto& answer = solved.answer;
  const auto& recipe = answer.model->recipe();
  TolerancePoints exchange(task.feature, task.cut_tolerances);
  std::optional<Chain> chain;
  Feeds feeds;
  double most = 0;
  bool more = true;
  for (int round = 0; more && round < kPositionRounds; ++round) {
    chain =
        task.feature.chain(recipe, task.economy, exchange.stations(), answer.choice.a);
    if (!chain) return {};
    chain->functionals = exchange.functionals();
    task.feature.limit_chatter(*chain, answer.choice.a);
    const Slice s{plan, *chain, answer.choice, i};
    if (!(s.o().vc.lower < s.o().vc.upper && s.o().f.lower < s.o().f.upper)) return {};
    most =
        s.cost(answer.choice.v[i], answer.choice.f[i]) * (1 + plan.window_percent / 100);
    if (!s.holds(answer.choice.f[i], most)) return {};
    feeds = {s.furthest(s.o().f.lower, most), s.furthest(s.o().f.upper, most)};
    more = false;
    for (const double f : {feeds.low, feeds.high})
      more = exchange.add_violated(recipe, task.economy, s.with(f)) || more;
  }
  if (more || !(feeds.high > feeds.low * (1 + kMeets))) return {};
  const Slice s{plan, *chain, answer.choice, i};
  auto w = polygon(s, feeds, plan.window_percent, most);
  if (!(area(w) > 0)) return {};
  if (plan.window_curves) {
    const auto frame = frame_of(w);
    add_limit_curves(s, frame, w);
    add_cost_curves(s, frame, most / (1 + plan.window_percent / 100), w);
  }
  return w;
}

}  // namespace turnwright::planning
