#include "openings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace turnwright::planning {
namespace {

using Kind = Openable::Kind;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Whether a limit opens by scaling rows of a model; tolerances set the jaws' force
// besides.
bool scales_rows(Kind k) {
  return k != Kind::grip && k != Kind::spindle_max && k != Kind::spindle_min;
}

bool is_of(Kind k, Check c) {
  switch (k) {
    case Kind::Ra:
      return c == Check::Ra;
    case Kind::Rz:
      return c == Check::Rz;
    case Kind::power:
      return c == Check::power || c == Check::torque;
    case Kind::feed_force:
      return c == Check::feed_force;
    case Kind::tool_force:
      return c == Check::force;
    case Kind::life_min:
      return c == Check::life_min;
    case Kind::life_max:
      return c == Check::life_max;
    case Kind::chatter:
      return c == Check::chatter;
    default:
      return false;
  }
}

// How far a limit opens: machines and tools no further than kFar.
double farthest(Kind k) {
  return k == Kind::tolerance || k == Kind::Ra || k == Kind::Rz ? 1e9 : kFar;
}

constexpr double kSpare = 1.0002;  // more than a local search needs

// One limit of the plan as it is opened: a tolerance by its place there.
struct Asked {
  Kind kind;
  std::size_t tolerance = 0;

  bool has(const RecipeModel& m, std::size_t row) const {
    const auto& r = m.rows()[row];
    if (kind != Kind::tolerance) return is_of(kind, r.check);
    return r.check == Check::tolerance &&
           m.chain().functionals[r.operation].tolerance == tolerance;
  }

  // What conditions take of it.
  double share(const FeatureTask& task, const RecipeModel& m,
               const Choice<double>& choice) const {
    if (kind == Kind::chatter) return task.feature.chatter_share(m.chain(), choice);
    if (kind == Kind::tolerance) {
      const auto e = task.feature.profile(m.recipe(), task.economy, choice);
      for (const auto& d : task.demands)
        if (d.tolerance == tolerance) return 1 + worst_excess({d}, e);
      return 1;
    }
    double most = 0;
    for (const auto& v : m.values(choice))
      if (is_of(kind, v.row.check)) most = std::max(most, v.value / v.limit);
    return most;
  }
};

// Least share of a limit that conditions which keep every limit take: one variable more,
// t, with g <= t.
double least_share(const FeatureTask& task, const FeatureAnswer& a, const Asked& asked) {
  constexpr double kLeast = -20;  // of ln(share), and of share - 1
  const auto& m = *a.model;
  const auto& full = m.problem();
  const auto n = full.lower.size();
  optimise::Problem p{full.lower, full.upper, full.constraints, {}};
  p.lower.push_back(kLeast);
  p.upper.push_back(0.1);
  p.evaluate = [&](std::span<const double> y, optimise::Values& out) {
    optimise::Values v{0, std::vector<double>(n), std::vector<double>(full.constraints),
                       std::vector<double>(full.constraints * n)};
    full.evaluate(y.first(n), v);
    out.f = y[n];
    std::fill(out.df.begin(), out.df.end(), 0.0);
    out.df[n] = 1;
    for (std::size_t i = 0; i < full.constraints; ++i) {
      const bool mine = asked.has(m, i);
      out.g[i] = v.g[i] - (mine ? y[n] : 0);
      std::copy_n(v.dg.begin() + static_cast<long>(i * n), n,
                  out.dg.begin() + static_cast<long>(i * (n + 1)));
      out.dg[i * (n + 1) + n] = mine ? -1 : 0;
    }
  };
  auto y = m.point(a.choice);
  y.push_back(0.01);
  const auto s = optimise::local_minimum(p, y);
  auto choice = a.choice;
  if (s.status != optimise::Status::no_feasible_point_met)
    choice = m.choice({s.y.begin(), s.y.end() - 1});
  return std::min(1.0, asked.share(task, m, choice));
}

// Where a tolerance stands once those before it are left out.
std::size_t place_of(const Feasibility& part, std::size_t limit, const Openings& times) {
  std::size_t place = 0;
  for (std::size_t i = 0; i < limit; ++i)
    place += part.limits()[i].kind == Kind::tolerance && times[i] != kWithout;
  return place;
}

// Tries an opening; if it suffices, how far it might have been less by what was found.
double reached(Feasibility& part, std::size_t limit, Openings times, double opening) {
  const auto& l = part.limits()[limit];
  times[limit] = opening;
  if (!scales_rows(l.kind)) return part.with(times) ? opening : kInfinity;
  const Asked asked{l.kind, place_of(part, limit, times)};
  const double now = name_of(part.plan(), l).now;
  double least = 0;  // the surface that asks for most
  const auto ask = [&](double opened_share) { least = std::max(least, opened_share); };
  const bool kept = part.with(times, [&](const FeatureTask& t, const FeatureAnswer& a) {
    if (l.kind == Kind::tolerance) {
      for (const auto& d : t.demands)
        if (d.tolerance == asked.tolerance && d.shape != Demand::Shape::none)
          ask((d.taken_mm + (now * opening - d.taken_mm) * least_share(t, a, asked)) /
              now);
    } else if (bears_on(part.plan(), l, t.feature.surface())) {
      ask(opening * least_share(t, a, asked));
    }
  });
  if (!kept) return kInfinity;
  return least > 1 ? std::min(least, opening) : opening;
}

double rounded_up(double x) {
  const double digit = std::pow(10, std::floor(std::log10(x)) - 3);
  return std::ceil(x / digit * (1 - 1e-12)) * digit;
}

}  // namespace

double as_told(const LimitName& limit, double times) {
  if (limit.at_most) return rounded_up(limit.now * times) / limit.now;
  return rounded_up(times);
}

double opened_value(const LimitName& limit, double times) {
  return limit.at_most ? limit.now * times : limit.now / times;
}

std::optional<double> least_opening(Feasibility& part, std::size_t limit,
                                    Openings times) {
  const auto& l = part.limits()[limit];
  times[limit] = kWithout;
  if (!part.with(times)) return {};
  if (is_given(l) || l.kind >= Kind::depth_min) return kWithout;
  double low = 1, enough = farthest(l.kind), might = reached(part, limit, times, enough);
  if (might == kInfinity) return {};
  // Each opening is tried before it counts: what a local search needs, then the least
  // that is worth it; by halving where nothing is known.
  while (enough / low > kOpening + 1e-9) {
    const bool known = low < might && might < enough;
    double next = known ? enough / kOpening : std::sqrt(enough * low);
    if (known && kSpare * might < enough / kSpare) next = kSpare * might;
    const double at = reached(part, limit, times, next);
    if (at < kInfinity) {
      enough = next;
      might = at;
    } else {
      low = next;
    }
  }
  const auto name = name_of(part.plan(), l);
  for (double more = 1; more < kOpening; more += 1e-3) {
    times[limit] = as_told(name, enough * more);
    if (part.with(times)) return times[limit];
  }
  return enough;
}

}  // namespace turnwright::planning
