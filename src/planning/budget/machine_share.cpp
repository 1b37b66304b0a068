#include "machine_share.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common_datum.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "planning/clamping/positions.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/interval.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/volumetric/lathe_part.hpp"

namespace turnwright::planning {
namespace {

using part::Tolerance;
using part::ToleranceKind;
using volumetric::Axis;
using volumetric::DatumAxis;
using volumetric::Generator;
using volumetric::Kinematics;
using volumetric::Machine;
using volumetric::Surface;

/// Position of a surface in the machine while it is cut.
struct Place {
  std::size_t setup = 0;
  Clamping clamping = Clamping::chuck;
};

bool holds_left(const PreparedPart& p, std::size_t setup) {
  return p.setups[setup].hold == part::End::left;
}

double machine_z_mm(const PreparedPart& p, const Place& at, double z) {
  const double root = root_z_mm(p, at.setup, at.clamping);
  return p.machine.errors->jaws_z_mm + (holds_left(p, at.setup) ? z - root : root - z);
}

// The last operation on the surface says which way it is cut; the request may leave it
// open.
bool from_chuck(const PreparedPart& p, const std::string& surface) {
  bool from = false;
  if (p.operations)
    for (const auto& o : *p.operations)
      if (std::find(o.on.begin(), o.on.end(), surface) != o.on.end())
        from = o.direction == Direction::from_chuck;
  return from;
}

Generator element(const PreparedPart& p, const std::string& id, const part::Extent& e,
                  const Place& at) {
  const double left = machine_z_mm(p, at, e.z0_mm), right = machine_z_mm(p, at, e.z1_mm);
  Generator g{e.left_mm / 2, left, e.right_mm / 2, right};
  if ((g.z_start_mm < g.z_end_mm) != from_chuck(p, id)) {
    std::swap(g.r_start_mm, g.r_end_mm);
    std::swap(g.z_start_mm, g.z_end_mm);
  }
  g.approach_x = e.inner ? 1 : -1;
  return g;
}

Generator face(const PreparedPart& p, const std::string& id, const Place& at) {
  const auto& d = p.drawing;
  const double z = machine_z_mm(p, at, face_z_mm(d, id)), hole = d.stock.inner_mm / 2;
  if (id == "left") return {d.outer.front().left_mm / 2, z, hole, z};
  if (const auto ring = shoulder_ring(d, id)) {
    const double in = ring->small_mm / 2, out = ring->large_mm / 2;
    return ring->inner ? Generator{in, z, out, z} : Generator{out, z, in, z};
  }
  return {d.outer.back().right_mm / 2, z, hole, z};
}

// Enough to see every lobe of the spindle, six places round the shortest wave.
std::size_t places_around(const Machine& m) {
  constexpr std::size_t kLeast = 8, kOfWave = 6, kOfTurn = 48;
  std::size_t around = kLeast;
  for (const Axis& axis : m.axes) {
    if (axis.name != 'C') continue;
    for (const auto& e : axis.errors) {
      if (e.c[1] != 0 || e.c[2] != 0 || e.c[3] != 0) around = std::max(around, kOfTurn);
      for (std::size_t h = 0; h < e.f.size(); ++h)
        if (e.f[h].a != 0 || e.f[h].d != 0) around = std::max(around, kOfWave * (h + 1));
    }
  }
  return around;
}

/// A machine at work on the part.
class Bench {
 public:
  Bench(const PreparedPart& p, const Machine& m)
      : p_(p), kinematics_(m), tool_(m.tool_point_mm), around_(places_around(m)) {}

  Surface surface(const std::string& id, const Place& at) const {
    constexpr std::size_t kAlong = 21;
    leave_if_asked();
    const auto e = part::extent(p_.drawing, id);
    return turned(kinematics_, tool_, e ? element(p_, id, *e, at) : face(p_, id, at),
                  around_, kAlong);
  }

 private:
  const PreparedPart& p_;
  Kinematics kinematics_;
  volumetric::Vec3 tool_;
  std::size_t around_;
};

Interval extremes(const std::vector<double>& v) {
  const auto [low, high] = std::minmax_element(v.begin(), v.end());
  return {*low, *high};
}

double mean(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x;
  return sum / static_cast<double>(v.size());
}

Interval diameters(const Surface& s) {
  std::vector<double> d;
  const std::size_t half = s.theta_rad.size() / 2;
  for (std::size_t i = 0; i < half; ++i)
    for (std::size_t j = 0; j < s.r_mm.size(); ++j)
      d.push_back(s.at(i, j) + s.at(i + half, j));
  return extremes(d);
}

double of_size(const PreparedPart& p, const Interval& d) {
  return p.shop.first_part_gauged ? d.hi - d.lo
                                  : 2 * std::max(std::abs(d.lo), std::abs(d.hi));
}

double shift_mm(const DatumAxis& d, const Surface& s) {
  double most = 0;
  for (const double z : {s.z_mm.front(), s.z_mm.back()})
    most = std::max(most, std::hypot(d.x0_mm + d.ax * z, d.y0_mm + d.ay * z));
  return most;
}

double tilt_rad(const DatumAxis& d) { return std::hypot(d.ax, d.ay); }

double largest_r_mm(const Surface& s) { return std::max(s.r_mm.front(), s.r_mm.back()); }

double length_mm(const Surface& s) { return std::abs(s.z_mm.back() - s.z_mm.front()); }

bool is_face(const Surface& s) { return s.z_mm.front() == s.z_mm.back(); }

/// A datum as seen from the spindle of the setup that uses it: known if it was cut there,
/// otherwise displaced by the same amount at an unknown angle.
struct Datum {
  DatumAxis axis;                     ///< of the same setup
  double shift_mm = 0, tilt_rad = 0;  ///< of another
};

// Angle between an element's axis and a datum, increased by the datum's tilt.
double angle_rad(const Surface& s, const Datum& d) {
  const DatumAxis own = axis_of(s);
  return std::hypot(own.ax - d.axis.ax, own.ay - d.axis.ay) + d.tilt_rad;
}

double zone_mm(const PreparedPart& p, ToleranceKind kind, const Surface& s,
               const Datum& d) {
  const double off = 2 * d.shift_mm, tipped = 2 * largest_r_mm(s) * d.tilt_rad;
  switch (kind) {
    case ToleranceKind::diameter:
      return of_size(p, diameters(s));
    case ToleranceKind::straightness:
      return straightness(s).minimum_zone_mm;
    case ToleranceKind::circularity:
      return roundness(s).minimum_zone_mm;
    case ToleranceKind::cylindricity:
    case ToleranceKind::profile_without_datum:
      return cylindricity(s).minimum_zone_mm;
    case ToleranceKind::flatness:
      return flatness(s).minimum_zone_mm;
    case ToleranceKind::profile:
      return of_size(p, extremes(s.e_mm)) + 2 * shift_mm(d.axis, s) + off;
    case ToleranceKind::circular_radial_runout:
      return circular_radial_runout_mm(s, d.axis) + off;
    case ToleranceKind::total_radial_runout:
      return total_radial_runout_mm(s, d.axis) + off;
    case ToleranceKind::coaxiality:
    case ToleranceKind::position:
      return coaxiality_mm(s, d.axis) + off;
    case ToleranceKind::circular_axial_runout:
      return circular_axial_runout_mm(s, d.axis) + tipped;
    case ToleranceKind::angularity:
      if (!is_face(s))
        return cylindricity(s).minimum_zone_mm + angle_rad(s, d) * length_mm(s);
      break;
    case ToleranceKind::perpendicularity:
      if (!is_face(s)) return angle_rad(s, d) * length_mm(s);
      break;
    case ToleranceKind::parallelism:
    case ToleranceKind::total_axial_runout:
      break;
    case ToleranceKind::length:
      throw std::domain_error("zone_mm: a length is between two faces");
  }
  return perpendicularity_mm(s, d.axis) + tipped;  // of faces
}

/// Where what a tolerance refers to is cut: its datum or the other face of a length, and
/// the second element of a common datum; none where no setup cuts it.
struct Others {
  std::optional<Place> first, second;
};

/// Share of a tolerance that one chain of errors takes; the surface is cut at `own`.
class Take {
 public:
  Take(const PreparedPart& p, const Tolerance& t, const Place& own, const Others& others)
      : p_(p), t_(t), own_(own), other_(others.first), second_(others.second) {}

  double width_mm(const Bench& bench) const {
    if (t_.kind == ToleranceKind::length) return of_size(p_, length(bench));
    const Surface s = bench.surface(t_.of, own_);
    return zone_mm(p_, t_.kind, s, datum(bench));
  }

 private:
  bool together() const { return other_ && other_->setup == own_.setup; }

  Datum datum(const Bench& bench) const {
    if (!t_.common_datum.empty()) return common_datum(bench);
    if (t_.datum.empty() || !other_) return {};
    const Surface surface = bench.surface(t_.datum, *other_);
    const DatumAxis axis = is_face(surface) ? normal_of(surface) : axis_of(surface);
    if (together()) return {.axis = axis};
    return {.axis = {},
            .shift_mm = shift_mm(axis, bench.surface(t_.of, *other_)),
            .tilt_rad = tilt_rad(axis)};
  }

  // Where the axis of a datum's element passes its middle, seen from the spindle of the
  // setup that cuts it.
  Across passes(const Bench& bench, const std::string& id,
                const std::optional<Place>& at) const {
    if (!at) return {};
    const DatumAxis axis = axis_of(bench.surface(id, *at));
    const double z = machine_z_mm(p_, *at, middle_z_mm(p_.drawing, id));
    return {axis.x0_mm + axis.ax * z, axis.y0_mm + axis.ay * z};
  }

  // Eqs. (1), (2) of common_datum.hpp.  What each other setup cut of it lies at an unknown
  // angle to the rest.
  Datum common_datum(const Bench& bench) const {
    const auto& d = p_.drawing;
    const double z_a = machine_z_mm(p_, own_, middle_z_mm(d, t_.datum)),
                 z_b = machine_z_mm(p_, own_, middle_z_mm(d, t_.common_datum));
    const Across a = passes(bench, t_.datum, other_),
                 b = passes(bench, t_.common_datum, second_);
    const auto cut_in = [&](std::size_t setup) {
      const auto in = [&](const std::optional<Place>& at) {
        return at && at->setup == setup;
      };
      return axis_through(z_a, in(other_) ? a : Across{}, z_b,
                          in(second_) ? b : Across{});
    };
    const Surface of = bench.surface(t_.of, own_);
    Datum datum{.axis = cut_in(own_.setup)};
    for (std::size_t setup = 0; setup < p_.setups.size(); ++setup) {
      if (setup == own_.setup) continue;
      const DatumAxis axis = cut_in(setup);
      datum.shift_mm += shift_mm(axis, of);
      datum.tilt_rad += tilt_rad(axis);
    }
    return datum;
  }

  // Excess distance of a face, cut at one place, from the plane `from` on which the part
  // stands.
  Interval beyond(const Bench& bench, const std::string& id, const std::string& from,
                  const Place& at) const {
    const Surface s = bench.surface(id, at), stop = bench.surface(from, at);
    const Interval e = extremes(s.e_mm);
    const double zero = mean(stop.e_mm);
    if (id == from) return {e.lo - e.hi, 0};
    const Interval d{e.lo - zero, e.hi - zero};
    if (s.z_mm[0] > stop.z_mm[0]) return d;
    return {-d.hi, -d.lo};
  }

  Interval length(const Bench& bench) const {
    const auto& [of, by] = faces();
    if (together()) {
      const Surface a = bench.surface(of, own_), b = bench.surface(by, own_);
      const Interval d = extremes(a.e_mm) - extremes(b.e_mm);
      return a.z_mm[0] > b.z_mm[0] ? d : Interval{-d.hi, -d.lo};
    }
    const bool own_last = !other_ || own_.setup > other_->setup;
    const Place& last = own_last ? own_ : *other_;
    const std::string& late = own_last ? of : by;
    const std::string& early = own_last ? by : of;
    const std::string held = holds_left(p_, last.setup) ? "left" : "right";
    const Interval d = beyond(bench, late, held, last);
    if (!other_) return d;
    const Interval before = beyond(bench, early, held, own_last ? *other_ : own_);
    const auto& drawing = p_.drawing;
    const double z = face_z_mm(drawing, held);
    const bool further =
        std::abs(face_z_mm(drawing, late) - z) > std::abs(face_z_mm(drawing, early) - z);
    return further ? d - before : before - d;
  }

  // The face cut at own_, then the other.
  std::pair<std::string, std::string> faces() const {
    const bool first = setup_of(p_, t_.between[0]) == own_.setup;
    return {t_.between[first ? 0 : 1], t_.between[first ? 1 : 0]};
  }

  const PreparedPart& p_;
  const Tolerance& t_;
  const Place& own_;
  const std::optional<Place>&other_, &second_;
};

std::vector<double*> parameters(Axis& axis) {
  std::vector<double*> all;
  for (auto& e : axis.errors) {
    for (double& c : e.c) all.push_back(&c);
    all.push_back(&e.b);
    for (auto& h : e.f) all.insert(all.end(), {&h.a, &h.d});
  }
  for (double& l : axis.location) all.push_back(&l);
  return all;
}

/// An axis without errors, with as many harmonics as either of two axes has.
Axis blank(const Axis& like, const Axis& or_like) {
  Axis axis{.name = like.name, .p_mm = like.p_mm, .Q = like.Q};
  for (std::size_t k = 0; k < volumetric::kDirections; ++k)
    axis.errors[k].f.resize(
        std::max(like.errors[k].f.size(), or_like.errors[k].f.size()));
  return axis;
}

Axis widened(const Axis& axis, const Axis& like) {
  Axis out = axis;
  for (std::size_t k = 0; k < volumetric::kDirections; ++k)
    out.errors[k].f.resize(like.errors[k].f.size());
  return out;
}

/// For each uncertain parameter the chain that has this error alone, equal to its
/// standard uncertainty.
std::vector<Machine> uncertain(const catalogue::GeometricErrors& g) {
  std::vector<Machine> all;
  Machine none = g.chain;
  for (Axis& axis : none.axes) axis = {.name = axis.name, .p_mm = axis.p_mm, .Q = axis.Q};
  for (std::size_t i = 0; i < g.chain.axes.size(); ++i) {
    const Axis& axis = g.chain.axes[i];
    const auto given = std::find_if(g.u.begin(), g.u.end(),
                                    [&](const Axis& u) { return u.name == axis.name; });
    const Axis besides = given == g.u.end() ? Axis{} : *given;
    const Axis zero = blank(axis, besides);
    Axis value = widened(axis, zero), u = widened(besides, zero);
    const auto values = parameters(value), us = parameters(u);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double size = std::hypot(g.relative_u * *values[k], *us[k]);
      if (!(size > 0)) continue;
      all.push_back(none);
      all.back().axes[i] = zero;
      *parameters(all.back().axes[i])[k] = size;
    }
  }
  return all;
}

// The clampings of a setup that differ in the position of the part.
std::vector<Place> places(const PreparedPart& p, std::size_t setup) {
  std::vector<Place> all;
  for (const Clamping c : p.setups[setup].clampings)
    if (std::none_of(all.begin(), all.end(), [&](const Place& other) {
          return (other.clamping == Clamping::between_centres) ==
                 (c == Clamping::between_centres);
        }))
      all.push_back({setup, c});
  return all;
}

std::vector<std::optional<Place>> others(const PreparedPart& p,
                                         std::optional<std::size_t> setup,
                                         const Place& own) {
  if (!setup) return {std::nullopt};
  if (setup == own.setup) return {own};
  std::vector<std::optional<Place>> all;
  for (const Place& place : places(p, *setup)) all.emplace_back(place);
  return all;
}

// Every two of them that can be: a setup has one clamping.
std::vector<Others> pairs(const std::vector<std::optional<Place>>& first,
                          const std::vector<std::optional<Place>>& second) {
  std::vector<Others> all;
  for (const auto& a : first)
    for (const auto& b : second)
      if (!a || !b || a->setup != b->setup || a->clamping == b->clamping)
        all.push_back({a, b});
  return all;
}

MachineTake take(const PreparedPart& p, const std::vector<Bench>& benches,
                 const Tolerance& t, const Place& own,
                 const std::vector<Others>& others) {
  MachineTake worst;
  for (const auto& other : others) {
    const Take one(p, t, own, other);
    double squares = 0;
    for (std::size_t k = 1; k < benches.size(); ++k)
      squares += std::pow(one.width_mm(benches[k]), 2);  // Eq. (3)
    worst.fixed_um =
        std::max(worst.fixed_um, units::um_from_mm(one.width_mm(benches[0])));
    worst.u_um = std::max(worst.u_um, units::um_from_mm(std::sqrt(squares)));
  }
  return worst;
}

MachinePlace key(const Tolerance& t, std::size_t setup, Clamping c) {
  return {t.id, setup, c == Clamping::between_centres};
}

}  // namespace

std::map<MachinePlace, MachineTake> machine_takes(const PreparedPart& p) {
  std::map<MachinePlace, MachineTake> all;
  if (!p.machine.errors) return all;
  std::vector<Bench> benches{{p, p.machine.errors->chain}};
  for (const Machine& m : uncertain(*p.machine.errors)) benches.emplace_back(p, m);
  for (const Tolerance& t : p.drawing.tolerances) {
    const bool length = t.kind == ToleranceKind::length;
    const auto a = setup_of(p, length ? t.between[0] : t.of);
    const auto b = setup_of(p, length ? t.between[1] : t.datum);
    const auto c = setup_of(p, t.common_datum);
    const auto add = [&](std::size_t setup, std::optional<std::size_t> other) {
      for (const Place& own : places(p, setup))
        all[key(t, setup, own.clamping)] =
            take(p, benches, t, own, pairs(others(p, other, own), others(p, c, own)));
    };
    if (a) add(*a, b);
    if (length && b && a != b) add(*b, a);
  }
  return all;
}

MachineTake machine_take(const PreparedPart& p, std::size_t tolerance, std::size_t setup,
                         Clamping clamping) {
  if (!p.machine.errors) return {};
  const auto at = key(p.drawing.tolerances.at(tolerance), setup, clamping);
  const auto found = p.machine_takes.find(at);
  if (found == p.machine_takes.end())
    throw std::domain_error("machine_take: " + at.tolerance + " is not cut in " +
                            setup_label(setup) + " by " + name(clamping));
  return found->second;
}

double least_machine_mm(const PreparedPart& p, std::size_t tolerance) {
  double most = 0;
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    double least = std::numeric_limits<double>::infinity();
    for (const Place& at : places(p, s)) {
      const auto found =
          p.machine_takes.find(key(p.drawing.tolerances[tolerance], s, at.clamping));
      if (found == p.machine_takes.end()) continue;
      const auto& take = found->second;
      least = std::min(least, take.fixed_um + (p.robust ? 0 : 3 * take.u_um));
    }
    if (std::isfinite(least)) most = std::max(most, least);  // else cut elsewhere
  }
  return units::mm_from_um(p.machine_share_um + most);
}

}  // namespace turnwright::planning
