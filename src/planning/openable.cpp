#include "openable.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "allowance.hpp"
#include "limits.hpp"

namespace turnwright::planning {
namespace {

using Kind = Openable::Kind;

template <class Plan, class F>
void for_every_roughness(Plan& p, const F& f) {
  for (auto& e : p.drawing.outer) f(e);
  for (auto& e : p.drawing.inner) f(e);
  for (auto& e : p.drawing.faces) f(e);
}

template <class Conditions>
auto& condition(Conditions& c, Kind kind) {
  return kind == Kind::ap ? c.ap_mm : kind == Kind::f ? c.f_mm_rev : c.vc_m_min;
}

// Least and largest of a condition that the request has given, if any.
std::optional<catalogue::Range> given(const PlanRequest& p, Kind kind) {
  std::optional<catalogue::Range> r;
  if (!p.operations) return r;
  for (const auto& o : *p.operations)
    if (const auto& x = condition(o.conditions, kind))
      r = r ? catalogue::Range{std::min(r->lower, *x), std::max(r->upper, *x)}
            : catalogue::Range{*x, *x};
  return r;
}

// What a window's end is for.
Kind given_of(Kind end) {
  if (end == Kind::depth_min || end == Kind::depth_max) return Kind::ap;
  return end == Kind::feed_min || end == Kind::feed_max ? Kind::f : Kind::vc;
}

// Far enough for what is given, the corner with the largest feed (0.8 of it) and the
// least depth (2/3 of it).
void open_window(PlanRequest& p, Kind end) {
  const auto g = given(p, given_of(end));
  for (auto& t : p.tools) {
    auto& window = given_of(end) == Kind::ap  ? t.ap_mm
                   : given_of(end) == Kind::f ? t.f_mm_rev
                                              : t.vc_m_min;
    const bool upper =
        end == Kind::depth_max || end == Kind::feed_max || end == Kind::vc_max;
    if (upper)
      window.upper = std::max(window.upper, g->upper);
    else
      window.lower = std::min(window.lower, g->lower);
    if (end == Kind::feed_max) t.re_mm = std::max(t.re_mm, g->upper / 0.8);
    if (end == Kind::depth_min) t.re_mm = std::min(t.re_mm, 1.5 * g->lower);
  }
}

void open_spindle(catalogue::Lathe& m, double times) {
  m.n_max_rpm *= times;
  m.chuck.n_max_rpm *= times;
  auto last = m.curve.back();
  last.n_rpm *= times;
  last.M_Nm /= times;
  m.curve.push_back(last);
}

void open_given(PlanRequest& p, const Openable& l) {
  auto& c = (*p.operations)[l.index].conditions;
  if (l.kind == Kind::passes)
    c.passes.reset();
  else
    condition(c, l.kind).reset();
}

void open_roughness(PlanRequest& p, const Openable& l, double times) {
  for_every_roughness(p, [&](auto& e) {
    if (e.id != l.surface) return;
    auto& value = l.kind == Kind::Ra ? e.Ra_um : e.Rz_um;
    if (times == kWithout)
      value.reset();
    else if (value)
      *value *= times;
  });
}

// Everything but tolerances that are left out.
void open(PlanRequest& p, const Openable& l, double times) {
  const double far = std::min(times, kFar);
  auto& m = p.machine;
  switch (l.kind) {
    case Kind::tolerance:
      if (times != kWithout) widen(p.drawing.tolerances[l.index], times);
      return;
    case Kind::Ra:
    case Kind::Rz:
      return open_roughness(p, l, times);
    case Kind::power:
      for (auto& c : m.curve) {
        c.P_kW *= far;
        c.M_Nm *= far;
      }
      return;
    case Kind::feed_force:
      m.feed_force_max_N *= far;
      return;
    case Kind::grip:
      m.chuck.friction *= far;
      m.chuck.jaw_mass_radius_kg_m /= far;
      return;
    case Kind::spindle_max:
      return open_spindle(m, far);
    case Kind::spindle_min:
      m.n_min_rpm /= far;
      return;
    case Kind::tool_force:
      for (auto& t : p.tools) t.Fc_max_N *= far;
      return;
    case Kind::life_min:
      for (auto& t : p.tools) t.T_min.lower /= far;
      return;
    case Kind::life_max:
      for (auto& t : p.tools) t.T_min.upper *= far;
      return;
    case Kind::chatter:
      p.chatter_times *= far;
      return;
    case Kind::passes:
    case Kind::ap:
    case Kind::f:
    case Kind::vc:
      return open_given(p, l);
    default:
      return open_window(p, l.kind);
  }
}

LimitName of_tools(const PlanRequest& p, Check check, double catalogue::Tool::*value) {
  const auto n = check_name(check);
  double largest = 0;
  for (const auto& t : p.tools) largest = std::max(largest, t.*value);
  return {n.name, n.unit, largest, n.at_most};
}

LimitName of_windows(const PlanRequest& p, Check check,
                     catalogue::Range catalogue::Tool::*range) {
  const auto n = check_name(check);
  double value = n.at_most ? 0 : std::numeric_limits<double>::infinity();
  for (const auto& t : p.tools)
    value =
        n.at_most ? std::max(value, (t.*range).upper) : std::min(value, (t.*range).lower);
  return {n.name, n.unit, value, n.at_most};
}

LimitName named(Check check, double now) {
  const auto n = check_name(check);
  return {n.name, n.unit, now, n.at_most};
}

LimitName name_of_given(const PlanRequest& p, const Openable& l) {
  const auto& o = (*p.operations)[l.index];
  if (l.kind == Kind::passes)
    return {"passes of " + o.id, "", static_cast<double>(*o.conditions.passes), true};
  const auto [key, unit] = l.kind == Kind::ap  ? std::pair{"ap_mm", "mm"}
                           : l.kind == Kind::f ? std::pair{"f_mm_rev", "mm/rev"}
                                               : std::pair{"vc_m_min", "m/min"};
  return {key + (" of " + o.id), unit, *condition(o.conditions, l.kind), true};
}

double roughness(const PlanRequest& p, const Openable& l) {
  double value = 0;
  for_every_roughness(p, [&](const auto& e) {
    if (e.id == l.surface) value = (l.kind == Kind::Ra ? e.Ra_um : e.Rz_um).value_or(0);
  });
  return value;
}

}  // namespace

bool is_given(const Openable& l) { return l.kind >= Kind::passes && l.kind <= Kind::vc; }

std::vector<Openable> limits_of(const PlanRequest& p) {
  std::vector<Openable> all;
  for (std::size_t i = 0; p.operations && i < p.operations->size(); ++i) {
    const auto& c = (*p.operations)[i].conditions;
    if (c.passes) all.push_back({Kind::passes, i});
    for (const Kind k : {Kind::ap, Kind::f, Kind::vc})
      if (condition(c, k)) all.push_back({k, i});
  }
  for (const Kind k : {Kind::depth_min, Kind::depth_max, Kind::feed_min, Kind::feed_max,
                       Kind::vc_min, Kind::vc_max})
    if (given(p, given_of(k))) all.push_back({k});
  for (std::size_t i = 0; i < p.drawing.tolerances.size(); ++i)
    all.push_back({Kind::tolerance, i, p.drawing.tolerances[i].of});
  for_every_roughness(p, [&](const auto& e) {
    if (e.Ra_um) all.push_back({Kind::Ra, 0, e.id});
    if (e.Rz_um) all.push_back({Kind::Rz, 0, e.id});
  });
  for (const Kind k :
       {Kind::power, Kind::feed_force, Kind::grip, Kind::spindle_max, Kind::spindle_min,
        Kind::tool_force, Kind::life_min, Kind::life_max, Kind::chatter})
    all.push_back({k});
  return all;
}

PlanRequest opened(const PlanRequest& plan, const std::vector<Openable>& limits,
                   const Openings& times) {
  PlanRequest p = plan;
  // Windows first: they open to what is given.
  for (std::size_t i = limits.size(); i-- > 0;)
    if (times[i] != 1) open(p, limits[i], times[i]);
  for (std::size_t i = limits.size(); i-- > 0;)
    if (limits[i].kind == Kind::tolerance && times[i] == kWithout)
      p.drawing.tolerances.erase(p.drawing.tolerances.begin() +
                                 static_cast<long>(limits[i].index));
  return p;
}

bool bears_on(const PlanRequest& p, const Openable& l, const std::string& surface) {
  if (l.kind == Kind::Ra || l.kind == Kind::Rz) return l.surface == surface;
  if (is_given(l)) {
    const auto& on = (*p.operations)[l.index].on;
    return std::find(on.begin(), on.end(), surface) != on.end();
  }
  if (l.kind != Kind::tolerance) return true;
  const auto& t = p.drawing.tolerances[l.index];
  return t.of == surface || t.between[0] == surface || t.between[1] == surface;
}

LimitName name_of(const PlanRequest& p, const Openable& l) {
  const auto& m = p.machine;
  switch (l.kind) {
    case Kind::tolerance: {
      const auto& t = p.drawing.tolerances[l.index];
      return {t.id + " " + part::name(t.kind), "mm", width_mm(t)};
    }
    case Kind::Ra:
      return named(Check::Ra, roughness(p, l));
    case Kind::Rz:
      return named(Check::Rz, roughness(p, l));
    case Kind::power:
      return named(Check::power, most_power_kW(m.curve));
    case Kind::feed_force:
      return named(Check::feed_force, m.feed_force_max_N);
    case Kind::grip:
      return named(Check::grip, m.chuck.grip_force_N);
    case Kind::spindle_max:
      return named(Check::spindle_max, m.n_max_rpm);
    case Kind::spindle_min:
      return named(Check::spindle_min, m.n_min_rpm);
    case Kind::tool_force:
      return of_tools(p, Check::force, &catalogue::Tool::Fc_max_N);
    case Kind::life_min:
      return of_windows(p, Check::life_min, &catalogue::Tool::T_min);
    case Kind::life_max:
      return of_windows(p, Check::life_max, &catalogue::Tool::T_min);
    case Kind::chatter:
      return {"chatter stiffness", "times", p.chatter_times, true};
    case Kind::depth_min:
      return of_windows(p, Check::depth_min, &catalogue::Tool::ap_mm);
    case Kind::depth_max:
      return of_windows(p, Check::depth_max, &catalogue::Tool::ap_mm);
    case Kind::feed_min:
      return of_windows(p, Check::feed_min, &catalogue::Tool::f_mm_rev);
    case Kind::feed_max:
      return of_windows(p, Check::feed_max, &catalogue::Tool::f_mm_rev);
    case Kind::vc_min:
      return of_windows(p, Check::vc_min, &catalogue::Tool::vc_m_min);
    case Kind::vc_max:
      return of_windows(p, Check::vc_max, &catalogue::Tool::vc_m_min);
    default:
      return name_of_given(p, l);
  }
}

}  // namespace turnwright::planning
