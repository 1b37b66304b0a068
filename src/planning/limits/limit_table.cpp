#include "limit_table.hpp"

#include <algorithm>
#include <cmath>

#include "planning/budget/tolerance_allocation.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::planning {
namespace {

using catalogue::CurvePoint;
using catalogue::Lathe;
using catalogue::Range;
using catalogue::Tool;

// A number at one place of the request: a function object that returns a pointer to it, or
// none.
template <class Place>
LimitNumber number(Owner owner, Place, const char* name = nullptr,
                   const char* unit = nullptr) {
  return {owner,
          [](const PreparedPart& p, std::size_t i) -> std::optional<double> {
            const double* x = Place{}(p, i);
            return x ? std::optional(*x) : std::nullopt;
          },
          [](PlanRequest& p, std::size_t i, const Scaling& s) {
            if (double* x = Place{}(p, i)) *x *= s.factor;
          },
          name, unit};
}

template <double Lathe::*Value>
LimitNumber of_machine() {
  return number(Owner::machine, [](auto& p, std::size_t) { return &(p.machine.*Value); });
}

template <double Tool::*Value>
LimitNumber of_tool() {
  return number(Owner::tool, [](auto& p, std::size_t i) { return &(p.tools[i].*Value); });
}

template <Range Tool::*Window, double Range::*End>
LimitNumber of_tool() {
  return number(Owner::tool,
                [](auto& p, std::size_t i) { return &(p.tools[i].*Window.*End); });
}

// ---- The drawing ------------------------------------------------------------------------

// What a function takes from the outer element, inner element or face of this number.
template <class Drawing, class Get>
auto& at_surface(Drawing& d, std::size_t i, const Get& get) {
  if (i < d.outer.size()) return get(d.outer[i]);
  i -= d.outer.size();
  if (i < d.inner.size()) return get(d.inner[i]);
  return get(d.faces[i - d.inner.size()]);
}

struct OfRa {
  auto& operator()(auto& e) const { return e.Ra_um; }
};
struct OfRz {
  auto& operator()(auto& e) const { return e.Rz_um; }
};

template <class Get>
LimitRow roughness(const char* name) {
  return {.name = name,
          .unit = "um",
          .relaxing = Relaxing::rows,
          .numbers = {number(Owner::surface,
                             [](auto& p, std::size_t i) {
                               auto& value = at_surface(p.drawing, i, Get{});
                               return value ? &*value : nullptr;
                             })},
          .take_away = [](PlanRequest& p, std::size_t i) {
            at_surface(p.drawing, i, Get{}).reset();
          }};
}

LimitRow tolerance() {
  return {.name = to_translate("tolerance"),
          .unit = "mm",
          .relaxing = Relaxing::rows,
          .numbers = {{Owner::tolerance,
                       [](const PreparedPart& p, std::size_t i) {
                         return std::optional(width_mm(p.drawing.tolerances[i]));
                       },
                       [](PlanRequest& p, std::size_t i, const Scaling& s) {
                         widen(p.drawing.tolerances[i], s.factor);
                       }}},
          .take_away =
              [](PlanRequest& p, std::size_t i) {
                auto& all = p.drawing.tolerances;
                all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
              },
          .is_width = true};
}

// ---- What the request gives, and the windows that it may leave ----------------------------

template <auto Condition>
LimitRow given(const char* name, const char* unit) {
  return {.name = name,
          .unit = unit,
          .relaxing = Relaxing::released,
          .numbers = {{Owner::operation,
                       [](const PreparedPart& p, std::size_t i) -> std::optional<double> {
                         const auto& x = (*p.operations)[i].conditions.*Condition;
                         return x ? std::optional<double>(*x) : std::nullopt;
                       }}},
          .take_away = [](PlanRequest& p, std::size_t i) {
            ((*p.operations)[i].conditions.*Condition).reset();
          }};
}

using GivenCondition = std::optional<double> Conditions::*;

// Least and largest of a condition that the request gives, if any.
std::optional<Range> range_given(const PlanRequest& p, GivenCondition condition) {
  std::optional<Range> r;
  if (!p.operations) return r;
  for (const auto& o : *p.operations)
    if (const auto& x = o.conditions.*condition)
      r = r ? Range{std::min(r->lower, *x), std::max(r->upper, *x)} : Range{*x, *x};
  return r;
}

// Feeds are at most 0.8 of the corner radius, depths at least 2/3 of it.
template <GivenCondition Condition, Range Tool::*Window>
void lower_to_given(PlanRequest& p, std::size_t) {
  const double least = range_given(p, Condition)->lower;
  for (auto& t : p.tools) {
    (t.*Window).lower = std::min((t.*Window).lower, least);
    if constexpr (Window == &Tool::ap_mm) t.re_mm = std::min(t.re_mm, 1.5 * least);
  }
}
template <GivenCondition Condition, Range Tool::*Window>
void raise_to_given(PlanRequest& p, std::size_t) {
  const double largest = range_given(p, Condition)->upper;
  for (auto& t : p.tools) {
    (t.*Window).upper = std::max((t.*Window).upper, largest);
    if constexpr (Window == &Tool::f_mm_rev) t.re_mm = std::max(t.re_mm, largest / 0.8);
  }
}

template <GivenCondition Condition, Range Tool::*Window>
LimitRow least_of_window(const char* name, const char* unit) {
  return {
      .name = name,
      .unit = unit,
      .side = Side::at_least,
      .relaxing = Relaxing::to_given,
      .numbers = {of_tool<Window, &Range::lower>()},
      .take_away = lower_to_given<Condition, Window>,
      .applies = [](const PlanRequest& p) { return bool(range_given(p, Condition)); }};
}
template <GivenCondition Condition, Range Tool::*Window>
LimitRow largest_of_window(const char* name, const char* unit) {
  return {
      .name = name,
      .unit = unit,
      .relaxing = Relaxing::to_given,
      .numbers = {of_tool<Window, &Range::upper>()},
      .take_away = raise_to_given<Condition, Window>,
      .applies = [](const PlanRequest& p) { return bool(range_given(p, Condition)); }};
}

// ---- Motor, spindle and jaws --------------------------------------------------------------

double largest_power_kW(const Lathe& m) {
  double most = 0;
  for (const auto& point : m.curve) most = std::max(most, point.P_kW);
  return most;
}

LimitRow power() {
  return {.name = to_translate("power"),
          .unit = "kW",
          .relaxing = Relaxing::rows,
          .numbers = {{Owner::machine,
                       [](const PreparedPart& p, std::size_t) {
                         return std::optional(largest_power_kW(p.machine));
                       },
                       [](PlanRequest& p, std::size_t, const Scaling& s) {
                         for (auto& point : p.machine.curve) {
                           point.P_kW *= s.factor;
                           point.M_Nm *= s.factor;
                         }
                       }}}};
}

// Top speed [1/min] of the machine by its spindle and power curve, without the chuck.
double end_rpm(const Lathe& m) { return std::min(m.n_max_rpm, m.curve.back().n_rpm); }

// Extends the power curve to k times its last speed, along the line through its last two
// points in logarithmic scales.
void stretch(std::vector<CurvePoint>& curve, double k) {
  auto& last = curve.back();
  if (curve.size() > 1) {
    const auto& before = curve[curve.size() - 2];
    const double per_n = std::log(k) / std::log(last.n_rpm / before.n_rpm);
    last.P_kW *= std::pow(last.P_kW / before.P_kW, per_n);
    last.M_Nm *= std::pow(last.M_Nm / before.M_Nm, per_n);
  }
  last.n_rpm *= k;
}

// Scales the machine's top speed: the end of the power curve and the limits of spindle
// and chuck, each if it equals that speed.
void raise_end(PlanRequest& p, std::size_t, const Scaling& s) {
  auto& m = p.machine;
  const auto ends_there = [&](double n) { return std::abs(n / s.now - 1) < 1e-9; };
  if (ends_there(m.curve.back().n_rpm)) stretch(m.curve, s.factor);
  for (double* n : {&m.n_max_rpm, &m.chuck.n_max_rpm})
    if (ends_there(*n)) *n *= s.factor;
}

// The power of the curve's last point goes on to the new end.
void add_faster_point(PlanRequest& p, std::size_t, const Scaling& s) {
  auto& m = p.machine;
  m.n_max_rpm *= s.factor;
  m.chuck.n_max_rpm *= s.factor;
  auto last = m.curve.back();
  last.n_rpm *= s.factor;
  last.M_Nm /= s.factor;
  m.curve.push_back(last);
}

LimitRow largest_spindle_speed() {
  return {.name = to_translate("largest spindle speed"),
          .unit = "1/min",
          .relaxing = Relaxing::model,
          .numbers = {{Owner::machine,
                       [](const PreparedPart& p, std::size_t) {
                         return std::optional(end_rpm(p.machine));
                       },
                       raise_end},
                      number(
                          Owner::chuck,
                          [](auto& p, std::size_t) {
                            auto& n = p.machine.chuck.n_max_rpm;
                            return n < end_rpm(p.machine) ? &n : nullptr;
                          },
                          to_translate("largest speed of the chuck"))},
          .with = Check::grip,  // at speed the jaws let go
          .relaxed_by = LimitNumber{Owner::machine,
                                    [](const PreparedPart& p, std::size_t) {
                                      return std::optional(p.machine.n_max_rpm);
                                    },
                                    add_faster_point}};
}

LimitRow grip() {
  const auto rough_N = [](const PreparedPart& p, std::size_t s) -> std::optional<double> {
    if (p.jaws[s].spares_tube) return {};
    return p.jaws[s].roughing_N;
  };
  const auto finish_N = [](const PreparedPart& p,
                           std::size_t s) -> std::optional<double> {
    if (!finishes_with_another_force(p, s)) return {};
    return p.jaws[s].finishing_N;
  };
  return {.name = to_translate("grip of the chuck"),
          .unit = "N",
          .relaxing = Relaxing::model,
          .numbers = {{Owner::jaws, rough_N,
                       [](PlanRequest& p, std::size_t i, const Scaling& s) {
                         p.setups[i].grip_force_N = s.factor * s.now;
                       },
                       to_translate("grip force")},
                      {Owner::finishing_jaws, finish_N,
                       [](PlanRequest& p, std::size_t i, const Scaling& s) {
                         p.setups[i].finishing_grip_force_N = s.factor * s.now;
                       },
                       to_translate("finishing grip force")}},
          // Relaxed by more friction and lighter jaws, because more force would deform
          // tubes.
          .relaxed_by = LimitNumber{Owner::chuck,
                                    [](const PreparedPart& p, std::size_t) {
                                      return std::optional(p.machine.chuck.grip_force_N);
                                    },
                                    [](PlanRequest& p, std::size_t, const Scaling& s) {
                                      p.machine.chuck.friction *= s.factor;
                                      p.machine.chuck.jaw_mass_radius_kg_m /= s.factor;
                                    }}};
}

LimitRow chatter() {
  constexpr const char* kDamping = to_translate("damping ratio");
  return {.name = to_translate("chatter stiffness"),
          .unit = "N/mm",
          .relaxing = Relaxing::rows,
          .numbers = {number(
                          Owner::machine,
                          [](auto& p, std::size_t) { return &p.damping_ratio; }, kDamping,
                          ""),
                      number(
                          Owner::machine,
                          [](auto& p, std::size_t) { return &p.machine_damping_ratio; },
                          to_translate("damping ratio of chuck and toolpost"), ""),
                      number(
                          Owner::tool,
                          [](auto& p, std::size_t i) {
                            auto& bar = p.tools[i].bar;
                            return bar && bar->damping_ratio ? &*bar->damping_ratio
                                                             : nullptr;
                          },
                          kDamping, "")},
          .relaxed_by = number(
              Owner::machine, [](auto& p, std::size_t) { return &p.chatter_times; },
              nullptr, "times")};
}

// ---- Checks that nobody can relax -----------------------------------------------------------

LimitRow no_limit(const char* name, const char* unit, Side side, const char* reason) {
  return {.name = name, .unit = unit, .side = side, .reason = reason};
}

constexpr const char* kOfChipBreaker = to_translate(
    "the insert's maker draws the chip breaker's window as a curve over depth and feed: "
    "it has no number of its own, and another window is another tool");
constexpr const char* kOfMilledPlaces = to_translate(
    "milled places are chosen apart from the turned surfaces, by a search that explains "
    "itself");

// A switch, so that a check without a row does not compile.
LimitRow row_of(Check check) {
  switch (check) {
    case Check::depth_min:
      return least_of_window<&Conditions::ap_mm, &Tool::ap_mm>(
          to_translate("least depth of cut"), "mm");
    case Check::depth_max:
      return largest_of_window<&Conditions::ap_mm, &Tool::ap_mm>(
          to_translate("largest depth of cut"), "mm");
    case Check::feed_min:
      return least_of_window<&Conditions::f_mm_rev, &Tool::f_mm_rev>(
          to_translate("least feed"), "mm/rev");
    case Check::feed_max:
      return largest_of_window<&Conditions::f_mm_rev, &Tool::f_mm_rev>(
          to_translate("largest feed"), "mm/rev");
    case Check::vc_min:
      return least_of_window<&Conditions::vc_m_min, &Tool::vc_m_min>(
          to_translate("least cutting speed"), "m/min");
    case Check::vc_max:
      return largest_of_window<&Conditions::vc_m_min, &Tool::vc_m_min>(
          to_translate("largest cutting speed"), "m/min");
    case Check::tolerance:
      return tolerance();
    case Check::Ra:
      return roughness<OfRa>(to_translate("roughness Ra"));
    case Check::Rz:
      return roughness<OfRz>(to_translate("roughness Rz"));
    case Check::power:
      return power();
    case Check::torque:
      return {.name = to_translate("torque"),
              .unit = "Nm",
              .with = Check::power,
              .reason = to_translate(
                  "power and torque are one motor's curve: the power is relaxed")};
    case Check::feed_force:
      return {.name = to_translate("feed force"),
              .unit = "N",
              .relaxing = Relaxing::rows,
              .numbers = {of_machine<&Lathe::feed_force_max_N>()}};
    case Check::grip:
      return grip();
    case Check::spindle_max:
      return largest_spindle_speed();
    case Check::spindle_min:
      return {.name = to_translate("least spindle speed"),
              .unit = "1/min",
              .side = Side::at_least,
              .relaxing = Relaxing::model,
              .numbers = {of_machine<&Lathe::n_min_rpm>()}};
    case Check::force:
      return {.name = to_translate("cutting force"),
              .unit = "N",
              .relaxing = Relaxing::rows,
              .numbers = {of_tool<&Tool::Fc_max_N>()}};
    case Check::life_min:
      return {.name = to_translate("least tool life"),
              .unit = "min",
              .side = Side::at_least,
              .relaxing = Relaxing::rows,
              .numbers = {of_tool<&Tool::T_min, &Range::lower>()}};
    case Check::life_max:
      return {.name = to_translate("longest tool life"),
              .unit = "min",
              .relaxing = Relaxing::rows,
              .numbers = {of_tool<&Tool::T_min, &Range::upper>()}};
    case Check::chatter:
      return chatter();
    case Check::chip_min:
      return no_limit(to_translate("least feed of the chip breaker"), "mm/rev",
                      Side::at_least, kOfChipBreaker);
    case Check::chip_max:
      return no_limit(to_translate("largest feed of the chip breaker"), "mm/rev",
                      Side::at_most, kOfChipBreaker);
    case Check::speed_window:
      return no_limit(
          to_translate("cutting speed"), "m/min", Side::at_least,
          to_translate("no limit by itself: whether the others leave any cutting speed"));
    case Check::stable_depth:
      return no_limit(to_translate("stable depth with its margin"), "mm", Side::at_most,
                      kOfMilledPlaces);
    case Check::part_compliance:
      return no_limit(to_translate("compliance of the part"), "nm/N", Side::at_most,
                      kOfMilledPlaces);
    case Check::milled_depth_max:
      return no_limit(to_translate("depth of cut"), "mm", Side::at_most, kOfMilledPlaces);
    case Check::chip_thickness_max:
      return no_limit(to_translate("chip thickness"), "mm", Side::at_most,
                      kOfMilledPlaces);
    case Check::chip_thickness_min:
      return no_limit(to_translate("least chip thickness"), "mm", Side::at_least,
                      kOfMilledPlaces);
    case Check::milled_vc_max:
      return no_limit(to_translate("cutting speed"), "m/min", Side::at_most,
                      kOfMilledPlaces);
    case Check::milled_n_max:
      return no_limit(to_translate("spindle speed"), "1/min", Side::at_most,
                      kOfMilledPlaces);
    case Check::milled_feed_max:
      return no_limit(to_translate("feed speed"), "mm/min", Side::at_most,
                      kOfMilledPlaces);
  }
  return {};
}

std::vector<LimitRow> rows() {
  std::vector<LimitRow> all{given<&Conditions::passes>("passes", ""),
                            given<&Conditions::ap_mm>("ap_mm", "mm"),
                            given<&Conditions::f_mm_rev>("f_mm_rev", "mm/rev"),
                            given<&Conditions::vc_m_min>("vc_m_min", "m/min")};
  for (int k = 0;; ++k) {
    auto row = row_of(static_cast<Check>(k));
    if (!row.name) return all;
    row.check = static_cast<Check>(k);
    all.push_back(std::move(row));
  }
}

}  // namespace

const std::vector<LimitRow>& limit_table() {
  static const auto kTable = rows();
  return kTable;
}

const LimitRow& limit_row(Check check) {
  return *std::ranges::find(limit_table(), std::optional(check), &LimitRow::check);
}

bool sets(const LimitRow& limit, Check check) {
  return limit.check && (limit.check == check || limit_row(check).with == limit.check);
}

bool finishes_with_another_force(const PreparedPart& p, std::size_t setup) {
  return p.setups[setup].finishing_grip_force_N || p.jaws[setup].eased;
}

std::size_t owners(const PlanRequest& p, Owner owner) {
  const auto& d = p.drawing;
  switch (owner) {
    case Owner::operation:
      return p.operations ? p.operations->size() : 0;
    case Owner::tolerance:
      return d.tolerances.size();
    case Owner::surface:
      return d.outer.size() + d.inner.size() + d.faces.size();
    case Owner::machine:
    case Owner::chuck:
      return 1;
    case Owner::jaws:
    case Owner::finishing_jaws:
      return p.setups.size();
    case Owner::tool:
      return p.tools.size();
  }
  return 0;
}

const std::string& surface_id(const PlanRequest& p, std::size_t surface) {
  return at_surface(
      p.drawing, surface, [](auto& e) -> auto& { return e.id; });
}

}  // namespace turnwright::planning
