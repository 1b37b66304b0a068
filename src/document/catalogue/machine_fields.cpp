#include "machine_fields.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "base/say.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/volumetric/axis_table.hpp"

namespace turnwright::document {
namespace {

using namespace volumetric;
using nlohmann::json;

constexpr std::size_t kHarmonics = 64, kReadings = 10000;
const Bounds kShift = within(-1e3, 1e3, "mm"), kTurn = within(-10, 10, "rad"),
             kShiftU = within(0, 1e3, "mm"), kTurnU = within(0, 10, "rad"),
             kPlace = within(-1e6, 1e6, "mm"), kAngle = within(-1e6, 1e6, "rad");

/// Meaning of the numbers of an axis' errors; `side` is -1 for axes between bed and
/// workpiece.
struct Meaning {
  bool uncertainty = false;
  double side = 1;
  std::vector<Axis>* fitted_u = nullptr;  ///< where uncertainties of fitted tables go
  const Bounds& bounds(std::size_t direction) const {
    if (uncertainty) return direction < 3 ? kShiftU : kTurnU;
    return direction < 3 ? kShift : kTurn;
  }
};

Axis& axis_named(std::vector<Axis>& axes, char name) {
  const auto found = std::ranges::find(axes, name, &Axis::name);
  if (found != axes.end()) return *found;
  axes.push_back({.name = name, .Q = default_Q(name)});
  return axes.back();
}

/// "EYX", "EY0X".
std::string error_name(std::size_t direction, const char* of, char axis) {
  return std::string("E") + kLetters[direction] + of + axis;
}

/// Whether `axis` has the location key of `direction`: all directions for a rotary axis,
/// the rotations across it for a linear one.
bool has_location(char axis, std::size_t direction) {
  return is_rotary(axis) || (direction > 2 && direction != letter_index(axis) + 3);
}

bool fits(const AxisFit& fit, const Bounds& bounds) {
  const auto within_bounds = [&](double x) { return contains(bounds, x); };
  return std::ranges::all_of(fit.error.c, within_bounds) &&
         std::ranges::all_of(fit.u, within_bounds) && within_bounds(fit.error.b);
}

/// {"q", "plus", "minus", "unit", "sign", "degree"} fitted.
AxisFit read_error_table(Reader r, const Bounds& travel, bool turns, double Q,
                         double side, const Bounds& bounds) {
  AxisTable t;
  const std::size_t problems = r.problems().list.size();
  t.q = r.numbers("q", travel, 1, kReadings);
  const Choices<double> shifts = {{"mm", 1}, {"um", units::mm_from_um(1)}},
                        angles = {{"rad", 1}, {"urad", 1e-6}};
  const double unit = r.choice<double>("unit", turns ? angles : shifts);
  const double sign =
      r.choice<double>("sign", {{"physical", 1}, {"tool-minus-workpiece", side}});
  const int degree = static_cast<int>(r.integer_or("degree", 0, 3, 3));
  const auto column = [&](const char* key, std::vector<double>& out) {
    if (!r.has(key)) return;
    out = r.numbers(key, within(-1e6, 1e6), 1, kReadings);
    if (!out.empty() && !t.q.empty() && out.size() != t.q.size())
      r.problem_at(key, tr("as many readings as q has positions"), "count");
    for (double& x : out) x *= sign * unit;
  };
  column("plus", t.plus);
  column("minus", t.minus);
  r.finish();
  if (r.problems().list.size() != problems) return {};
  const std::set<double> places(t.q.begin(), t.q.end());
  if (t.plus.empty() && t.minus.empty())
    r.problem(tr("neither"), tr("plus, minus or both: readings by direction of approach"),
              "missing");
  else if (places.size() < static_cast<std::size_t>(degree) + 1)
    r.problem_at("q", say("{} positions or more", degree + 1), "count");
  else if (const AxisFit fit = fit_axis(t, Q, degree); fits(fit, bounds))
    return fit;
  else
    r.problem(tr("a fit out of bounds"),
              say("positions so far apart that each coefficient is {}",
                  expected_number(bounds)),
              "range");
  return {};
}

ErrorFunction read_error(Reader r, const Axis& of, std::size_t direction,
                         const Meaning& meaning) {
  r = r.as_object();
  const char axis = of.name;
  const Bounds& bounds = meaning.bounds(direction);
  ErrorFunction e;
  if (!meaning.uncertainty)
    if (auto table = r.optional_object("table")) {
      const AxisFit fit = read_error_table(*table, is_rotary(axis) ? kAngle : kPlace,
                                           direction > 2, of.Q, meaning.side, bounds);
      r.finish();
      if (meaning.fitted_u) {
        ErrorFunction& u = axis_named(*meaning.fitted_u, axis).errors[direction];
        std::copy_n(fit.u.begin(), u.c.size(), u.c.begin());
        u.b = fit.u.back();
      }
      return fit.error;
    }
  if (r.has("c")) {
    const auto c = r.numbers("c", bounds, 4, 4);
    std::ranges::copy(c, e.c.begin());
  }
  e.b = r.number_or("b", bounds, 0);
  for (const Reader& pair : r.optional_items("f", 0, is_rotary(axis) ? kHarmonics : 0)) {
    const auto ad = pair.as_numbers(bounds, 2, 2);
    if (ad.size() == 2) e.f.push_back({ad[0], ad[1]});
  }
  r.finish();
  return e;
}

Axis read_axis(Reader r, char name, const Meaning& meaning) {
  Axis axis{.name = name, .Q = default_Q(name)};
  if (!meaning.uncertainty) {
    if (r.has("p_mm")) axis.p_mm = read_vec3(r, "p_mm", kPlace);
    axis.Q =
        r.number_or("Q", above_up_to(0, 1e6, is_rotary(name) ? "rad" : "mm"), axis.Q);
  }
  if (auto err = r.optional_object("err")) {
    for (std::size_t k = 0; k < kDirections; ++k)
      if (const auto e = err->find(error_name(k, "", name)))
        axis.errors[k] = read_error(*e, axis, k, meaning);
    err->finish();
  }
  for (const char* group : {"loc", "sq"}) {
    auto location = r.optional_object(group);
    if (!location) continue;
    if (is_rotary(name) == (group[0] == 'l'))
      for (std::size_t k = 0; k < kDirections; ++k)
        if (has_location(name, k))
          axis.location[k] =
              location->number_or(error_name(k, "0", name), meaning.bounds(k), 0);
    location->finish();
  }
  r.finish();
  return axis;
}

/// Axes of a chain, each at most once; of an unknown chain "" any.
std::vector<Axis> read_axes(const std::vector<Reader>& items, const std::string& chain,
                            Meaning meaning) {
  static const std::vector<std::string> kNames = {"X", "Y", "Z", "A", "B", "C"};
  std::vector<Axis> axes;
  for (Reader item : items) {
    const std::size_t problems = item.problems().list.size();
    item = item.as_object();
    const char name =
        kLetters[item.at("name", tr("an axis of the chain")).as_choice(kNames)];
    if (item.problems().list.size() != problems) continue;
    if (!chain.empty() && chain.find(name) == std::string::npos)
      item.problem_at("name", say("an axis of the chain {}", chain), "reference");
    if (std::ranges::find(axes, name, &Axis::name) != axes.end())
      item.problem_at("name", tr("each axis once"), "duplicate");
    meaning.side = chain.empty() ? 1 : sense(chain, name);
    axes.push_back(read_axis(item, name, meaning));
  }
  return axes;
}

}  // namespace

Vec3 read_vec3(Reader& r, std::string_view key, const Bounds& bounds) {
  Vec3 out{};
  std::ranges::copy(r.numbers(key, bounds, 3, 3), out.begin());
  return out;
}

Machine read_chain(Reader& r, std::vector<Axis>* fitted_u) {
  Machine m;
  m.chain = r.text("chain", 9);
  const std::string fault = chain_fault(m.chain);
  const bool known = fault.empty();
  if (!m.chain.empty() && !known)
    r.problem_at("chain", say("a chain such as wCfZXt: {}", fault), "chain");
  m.axes = read_axes(r.items("axes", 0, kDirections), known ? m.chain : "",
                     {.fitted_u = fitted_u});
  if (known && r.json().contains("axes") && r.json()["axes"].is_array())
    for (const char c : m.chain)
      if (letter_index(c) != std::string_view::npos &&
          std::ranges::find(m.axes, c, &Axis::name) == m.axes.end())
        r.problems().add({r.pointer_of("axes"), say("no axis {}", c),
                          say("an entry for each axis of the chain {}", m.chain),
                          "missing"});
  return m;
}

std::vector<Axis> read_uncertainties(Reader& r, const Machine& m,
                                     const std::vector<Axis>& fitted) {
  const bool known = chain_fault(m.chain).empty();
  auto given = read_axes(r.optional_items("u", 0, kDirections), known ? m.chain : "",
                         {.uncertainty = true});
  for (const Axis& axis : fitted)
    for (std::size_t k = 0; k < kDirections; ++k) {
      ErrorFunction& u = axis_named(given, axis.name).errors[k];
      if (u.c == std::array<double, 4>{} && u.b == 0) u = axis.errors[k];
    }
  return given;
}

Position read_position(Reader r, const Machine& m) {
  r = r.as_object();
  Position at;
  const auto each = [&](const char* key, auto read) {
    auto group = r.optional_object(key);
    if (!group) return;
    for (const char c : m.chain) {
      const std::size_t k = letter_index(c);
      if (k != std::string_view::npos) read(*group, c, k);
    }
    group->finish();
  };
  each("q", [&](Reader& group, char c, std::size_t k) {
    at.q[k] = group.number_or(std::string(1, c), is_rotary(c) ? kAngle : kPlace, 0);
  });
  each("sign", [&](Reader& group, char c, std::size_t k) {
    at.sign[k] = group.number_or(std::string(1, c), within(-1, 1), 0);
    if (at.sign[k] != -1 && at.sign[k] != 0 && at.sign[k] == at.sign[k] &&
        at.sign[k] != 1)
      group.problem_at(std::string(1, c), tr("-1, 0 or 1"), "range");
  });
  r.finish();
  return at;
}

namespace {

json axis_json(const Axis& axis) {
  json one{{"name", std::string(1, axis.name)}};
  for (std::size_t k = 0; k < kDirections; ++k) {
    const ErrorFunction& e = axis.errors[k];
    const char* group = is_rotary(axis.name) ? "loc" : "sq";
    if (axis.location[k] != 0)
      one[group][error_name(k, "0", axis.name)] = axis.location[k];
    json f = json::array();
    for (const Harmonic& h : e.f) f.push_back({h.a, h.d});
    if (e.c == std::array<double, 4>{} && e.b == 0 && f.empty()) continue;
    json& error = one["err"][error_name(k, "", axis.name)];
    error = {{"c", e.c}, {"b", e.b}};
    if (!f.empty()) error["f"] = f;
  }
  return one;
}

/// The number of an error's name: "EXX1" its c1 at Q = 100 mm or pi, "EXXb" its b, "EB0Z"
/// a place.
double& number_of(Axis& axis, const std::string& name) {
  const std::size_t k = letter_index(name[1]);
  if (name[2] == '0') return axis.location[k];
  ErrorFunction& e = axis.errors[k];
  return name[3] == 'b' ? e.b : e.c[static_cast<std::size_t>(name[3] - '0')];
}

}  // namespace

json chain_json(const Machine& m) {
  json axes = json::array();
  for (const Axis& axis : m.axes) {
    axes.push_back(axis_json(axis));
    axes.back()["p_mm"] = axis.p_mm;
    axes.back()["Q"] = axis.Q;
  }
  return {{"chain", m.chain}, {"axes", axes}};
}

catalogue::GeometricErrors blank_errors(const std::string& chain) {
  catalogue::GeometricErrors g;
  g.chain.chain = chain;
  for (const char c : chain)
    if (letter_index(c) != std::string_view::npos) axis_named(g.chain.axes, c);
  return g;
}

void put(const Calibrated& found, catalogue::GeometricErrors& g) {
  const char name = found.name[found.name[2] == '0' ? 3 : 2];
  Axis& axis = axis_named(g.chain.axes, name);
  const bool power = found.name[2] != '0' && found.name[3] != 'b';
  const double travel =
      power ? std::pow(axis.Q / default_Q(name), found.name[3] - '0') : 1;
  number_of(axis, found.name) = travel * found.value;
  number_of(axis_named(g.u, name), found.name) = travel * found.u;
}

json errors_json(const catalogue::GeometricErrors& g) {
  json out = chain_json(g.chain);
  out["tool_point_mm"] = g.chain.tool_point_mm;
  out["jaws_z_mm"] = g.jaws_z_mm;
  json u = json::array();
  for (const Axis& axis : g.u) u.push_back(axis_json(axis));
  out["u"] = u;
  out["uncertainty_pct"] = 100 * g.relative_u;
  return out;
}

}  // namespace turnwright::document
