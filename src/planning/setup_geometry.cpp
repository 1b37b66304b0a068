#include "turnwright/planning/setup_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "air.hpp"
#include "recipes.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::planning {
namespace {

using part::End;

const part::Drawing& drawing(const PreparedPart& p) { return p.drawing; }
bool holds_left(const PreparedPart& p, std::size_t s) {
  return p.setups[s].hold == End::left;
}

// z at which the jaws end.  The first setup grips stock, the later ones the part.
double jaw_z(const PreparedPart& p, std::size_t s) {
  const auto& d = drawing(p);
  const double grip = p.grips_mm.at(s), L = part::length_mm(d);
  if (holds_left(p, s)) return grip - (s == 0 ? d.stock.left_allowance_mm : 0);
  return L - grip + (s == 0 ? part::right_allowance_mm(d) : 0);
}

double largest(const part::OuterElement& e) { return std::max(e.left_mm, e.right_mm); }

// Whether a tool can reach outer element i from the free end.
bool reachable(const PreparedPart& p, std::size_t s, std::size_t i) {
  const auto& e = drawing(p).outer;
  const double z0 = part::left_z_mm(drawing(p), i), z1 = z0 + e[i].length_mm;
  const bool left = holds_left(p, s);
  if (left ? z0 < jaw_z(p, s) - 1e-9 : z1 > jaw_z(p, s) + 1e-9) return false;
  // A cone must widen towards the jaws, and nothing nearer the free end may be larger.
  const double outward = left ? e[i].right_mm : e[i].left_mm;
  const double inward = left ? e[i].left_mm : e[i].right_mm;
  if (outward > inward) return false;
  for (std::size_t k = left ? i + 1 : 0; k < (left ? e.size() : i); ++k)
    if (largest(e[k]) > outward + 1e-9) return false;
  return true;
}

// Length [mm] that the corner of a finishing tool needs beyond the end of an element, and
// the length that the jaws leave free.
struct BeforeJaws {
  double needed_mm = 0, left_mm = 0;
  bool enough() const { return left_mm >= needed_mm - 1e-5; }
};
BeforeJaws before_jaws(const PreparedPart& p, std::size_t s, std::size_t i) {
  const auto& e = drawing(p).outer[i];
  const auto& clampings = p.setups[s].clampings;
  const auto tools = tools_for(p, catalogue::ToolUse::finishing);
  const bool centres = std::find(clampings.begin(), clampings.end(),
                                 Clamping::between_centres) != clampings.end();
  if (e.cut || centres || tools.empty()) return {};
  const auto around = surroundings(p, s, Clamping::chuck, {}, {false, i});
  if (const auto level = around.level_behind) {
    bool made_before = false;
    for (std::size_t t = 0; t < s; ++t) made_before |= reachable(p, t, *level);
    if (!made_before) return {};
  }
  double corner = tools.front()->re_mm;
  for (const auto* t : tools) corner = std::min(corner, t->re_mm);
  return {needed_beyond_mm(around, corner), around.z1 - around.root_z};
}

// A bore opens to the free end and narrows inwards, itself and with all before it.
bool bore_reachable(const PreparedPart& p, std::size_t s, std::size_t i) {
  const auto& inner = drawing(p).inner;
  const auto& e = inner[i];
  const bool right = e.from == End::right;
  if (holds_left(p, s) != right) return false;
  const double opening = right ? e.right_mm : e.left_mm;
  const double deep = right ? e.left_mm : e.right_mm;
  if (deep > opening) return false;
  for (std::size_t k = 0; k < i; ++k)
    if (inner[k].from == e.from &&
        std::min(inner[k].left_mm, inner[k].right_mm) < opening - 1e-9)
      return false;
  return true;
}

bool face_named(const part::Drawing& d, const std::string& id) {
  const auto names = [&](const part::Tolerance& t) {
    return t.of == id || t.between[0] == id || t.between[1] == id;
  };
  return std::any_of(d.faces.begin(), d.faces.end(),
                     [&](const part::Face& f) { return f.id == id; }) ||
         std::any_of(d.tolerances.begin(), d.tolerances.end(), names);
}

// Whether a surface may be made in this setup: the request leaves that to the planner, or
// has an operation for it there.
bool wanted_in(const PreparedPart& p, std::size_t s, const std::string& surface) {
  if (!p.operations) return true;
  return std::any_of(p.operations->begin(), p.operations->end(), [&](const auto& o) {
    return o.setup == s && o.kind != OperationKind::fixed &&
           std::find(o.on.begin(), o.on.end(), surface) != o.on.end();
  });
}

// The first setup that may and can make a surface; if there is none, adds the reason.
template <class Can>
std::optional<std::size_t> place(const PreparedPart& p, const std::string& surface,
                                 const std::string& why, const Can& can, Assignment& a) {
  bool asked = false;
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    if (!wanted_in(p, s, surface)) continue;
    asked = true;
    if (can(s)) return s;
  }
  if (!asked)
    a.unreachable.push_back(surface + " has no operation: it would stay as the stock is");
  else
    a.unreachable.push_back(
        surface + " cannot be cut in " +
        (p.operations ? "the setup of its operations: " : "any setup: ") + why);
  return {};
}

// Why no setup can cut an outer element.
std::string why_not(const PreparedPart& p, std::size_t i) {
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    if (!wanted_in(p, s, drawing(p).outer[i].id) || !reachable(p, s, i)) continue;
    if (!cleared(p, s, i))
      return fmt::format(
          "towards the chuck it falls by more than the {:.4g} deg that profiling tools "
          "are taken to clear",
          units::deg_from_rad(part::kProfilingClears_rad));
    const auto room = before_jaws(p, s, i);
    return fmt::format(
        "in setup {} it ends {:.3g} mm before the jaws, its tool's corner needs {:.3g} "
        "mm: grip less",
        s, room.left_mm, room.needed_mm);
  }
  return "it lies in the jaws, or behind a larger diameter";
}

void assign_faces(const PreparedPart& p, Assignment& a) {
  const auto& d = drawing(p);
  for (const End end : {End::left, End::right}) {
    if (!(face_stock_mm(p, end) > 1e-9)) continue;
    const std::string id = end == End::left ? "left" : "right";
    const auto free = [&](std::size_t s) { return p.setups[s].hold != end; };
    bool open = face_named(d, id);  // else it may stay as it is
    for (std::size_t s = 0; s < p.setups.size(); ++s)
      open = open || (free(s) && wanted_in(p, s, id));
    if (!open) continue;
    if (const auto s = place(p, id, "its end is held", free, a))
      a.setups[*s].end_face = true;
  }
  for (std::size_t k = 1; k < d.outer.size(); ++k) {
    const auto id = shoulder_id(d, k);
    const auto &before = d.outer[k - 1], &after = d.outer[k];
    if (!face_named(d, id) || before.right_mm == after.left_mm) continue;
    const std::size_t smaller = before.right_mm > after.left_mm ? k : k - 1;
    const auto s = place(
        p, id, "it is made with its smaller element",
        [&](std::size_t i) {
          const auto& e = a.setups[i].elements;
          return std::find(e.begin(), e.end(), smaller) != e.end();
        },
        a);
    if (s) a.setups[*s].shoulders.push_back(k);
  }
}

}  // namespace

Finished nothing_finished(const part::Drawing& d) {
  return {std::vector<bool>(d.outer.size()), std::vector<bool>(d.inner.size())};
}

void finish(Finished& finished, const SetupWork& work) {
  for (const std::size_t i : work.elements) finished.outer[i] = true;
  for (const std::size_t i : work.bores) finished.inner[i] = true;
}

Finished finished_after(const PreparedPart& p, std::size_t setup) {
  auto done = nothing_finished(p.drawing);
  for (std::size_t s = 0; s <= setup; ++s) finish(done, p.work.setups[s]);
  return done;
}

std::string shoulder_id(const part::Drawing& d, std::size_t k) {
  return d.outer[k - 1].id + "|" + d.outer[k].id;
}

double face_stock_mm(const PreparedPart& p, part::End end) {
  const auto& stock = drawing(p).stock;
  if (stock.parted_mm && p.setups.front().hold == end) return *stock.parted_mm;
  return end == End::left ? stock.left_allowance_mm
                          : part::right_allowance_mm(drawing(p));
}

double face_stock_after_mm(const PreparedPart& p, std::size_t setup, part::End end) {
  const auto faced = setup_of(p, end == part::End::left ? "left" : "right");
  return faced && *faced <= setup ? 0 : face_stock_mm(p, end);
}

bool cleared(const PreparedPart& p, std::size_t s, std::size_t i) {
  const auto& cut = drawing(p).outer[i].cut;
  if (!cut) return true;
  return (holds_left(p, s) ? cut->falls_to_left_rad : cut->falls_to_right_rad) <=
         part::kProfilingClears_rad;
}

const char* free_face(const PreparedPart& p, std::size_t s) {
  return holds_left(p, s) ? "right" : "left";
}

Assignment assign(const PreparedPart& p) {
  Assignment a;
  a.setups.resize(p.setups.size());
  const auto& outer = drawing(p).outer;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const auto can = [&](std::size_t s) {
      return reachable(p, s, i) && cleared(p, s, i) && before_jaws(p, s, i).enough();
    };
    if (const auto s = place(p, outer[i].id, why_not(p, i), can, a))
      a.setups[*s].elements.push_back(i);
  }
  const auto& inner = drawing(p).inner;
  for (std::size_t i = 0; i < inner.size(); ++i)
    if (const auto s = place(
            p, inner[i].id, "its end is held, or it lies behind a narrower bore",
            [&](std::size_t k) { return bore_reachable(p, k, i); }, a))
      a.setups[*s].bores.push_back(i);
  for (std::size_t s = 0; s < p.setups.size(); ++s)
    if (holds_left(p, s))
      std::reverse(a.setups[s].elements.begin(), a.setups[s].elements.end());
  assign_faces(p, a);
  return a;
}

double face_z_mm(const part::Drawing& d, const std::string& face) {
  if (face == "left") return 0;
  for (std::size_t k = 1; k < d.outer.size(); ++k)
    if (shoulder_id(d, k) == face) return part::left_z_mm(d, k);
  return part::length_mm(d);
}

std::optional<std::size_t> setup_of(const PreparedPart& p, const std::string& surface) {
  const auto& d = p.drawing;
  for (std::size_t s = 0; s < p.work.setups.size(); ++s) {
    const SetupWork& w = p.work.setups[s];
    const auto any = [&](const std::vector<std::size_t>& indices, const auto& id) {
      return std::any_of(indices.begin(), indices.end(),
                         [&](std::size_t i) { return id(i) == surface; });
    };
    if (any(w.elements, [&](std::size_t i) { return d.outer[i].id; }) ||
        any(w.bores, [&](std::size_t i) { return d.inner[i].id; }) ||
        any(w.shoulders, [&](std::size_t k) { return shoulder_id(d, k); }) ||
        (w.end_face && surface == free_face(p, s)))
      return s;
  }
  return {};
}

double root_z_mm(const PreparedPart& p, std::size_t s, Clamping clamping) {
  if (clamping != Clamping::between_centres) return jaw_z(p, s);
  const auto& d = drawing(p);
  // The held end is faced once a setup before has held the other one.
  const bool faced =
      std::any_of(p.setups.begin(), p.setups.begin() + static_cast<long>(s),
                  [&](const auto& q) { return q.hold != p.setups[s].hold; });
  if (holds_left(p, s)) return faced ? 0 : -d.stock.left_allowance_mm;
  return part::length_mm(d) + (faced ? 0 : part::right_allowance_mm(d));
}

double free_z_mm(const PreparedPart& p, std::size_t s) {
  return holds_left(p, s) ? part::length_mm(drawing(p)) : 0;
}

double grip_diameter_mm(const PreparedPart& p, std::size_t s, Clamping clamping) {
  if (clamping == Clamping::between_centres) return 0;
  if (s == 0) return drawing(p).stock.outer_mm;
  const auto& e = drawing(p).outer;  // the smallest diameter between the jaws
  double d = drawing(p).stock.outer_mm;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double z0 = part::left_z_mm(drawing(p), i), z1 = z0 + e[i].length_mm;
    if (holds_left(p, s) ? z0 < jaw_z(p, s) - 1e-9 : z1 > jaw_z(p, s) + 1e-9)
      d = std::min({d, e[i].left_mm, e[i].right_mm});
  }
  return d;
}

double gripped_bore_mm(const PreparedPart& p, std::size_t s) {
  const auto& d = drawing(p);
  double bore = d.stock.inner_mm;
  for (std::size_t k = 0; k <= s; ++k)
    for (const std::size_t i : p.work.setups[k].bores) {
      const double z0 = part::inner_left_z_mm(d, i), z1 = z0 + d.inner[i].length_mm;
      if (holds_left(p, s) ? z0 < jaw_z(p, s) : z1 > jaw_z(p, s))
        bore = std::max({bore, d.inner[i].left_mm, d.inner[i].right_mm});
    }
  return bore;
}

double jaw_force_N(const PreparedPart& p, std::size_t s, Clamping clamping, Stage stage) {
  if (clamping == Clamping::between_centres) return 0;
  return stage == Stage::roughing ? p.jaws.at(s).roughing_N : p.jaws.at(s).finishing_N;
}

SetupBody::SetupBody(const PreparedPart& p, std::size_t s, Clamping clamping,
                     const Finished& finished)
    : part_(&p),
      root_z_(root_z_mm(p, s, clamping)),
      sign_(holds_left(p, s) ? 1 : -1),
      length_(sign_ * (free_z_mm(p, s) - root_z_)) {
  const auto& d = drawing(p);
  const double stock = d.stock.outer_mm, far = 1e9;
  for (std::size_t i = 0; i < d.outer.size(); ++i) {
    const double z0 = part::left_z_mm(d, i);
    const auto& e = d.outer[i];
    const auto made = finished.outer[i] ? part::core(e) : part::Ends{stock, stock};
    outer_.push_back({z0, z0 + e.length_mm, made.left_mm, made.right_mm});
  }
  outer_.push_back({-far, 0, stock, stock});
  outer_.push_back({part::length_mm(d), far, stock, stock});
  const double hole = d.stock.inner_mm;
  for (std::size_t i = 0; i < d.inner.size(); ++i) {
    const double z0 = part::inner_left_z_mm(d, i);
    const auto& e = d.inner[i];
    const double drilled = hole_mm(p, i);  // and from the start: no stiffer
    const auto made = finished.inner[i] ? part::core(e) : part::Ends{drilled, drilled};
    inner_.push_back({z0, z0 + e.length_mm, made.left_mm, made.right_mm});
  }
  inner_.push_back({-far, far, hole, hole});  // where no element is
}

part::Shaft SetupBody::shaft(const std::vector<Zone>& outer,
                             const std::vector<Zone>& inner) const {
  const double low = std::min(root_z_, root_z_ + sign_ * length_);
  std::vector<double> ends{low, low + length_};
  for (const auto* zones : {&outer, &inner})
    for (const auto& zone : *zones)
      for (const double z : {zone.z0, zone.z1})
        if (z > ends[0] && z < ends[1]) ends.push_back(z);
  std::sort(ends.begin(), ends.end());
  // The first zone that contains a position counts; elements come before the stock beside
  // them.
  const auto zone_at = [](const std::vector<Zone>& zones, double z) {
    return *std::find_if(zones.begin(), zones.end(),
                         [&](const Zone& zone) { return zone.z0 <= z && z <= zone.z1; });
  };
  const auto diameter = [](const Zone& zone, double z) {
    return zone.d0 + (zone.d1 - zone.d0) * (z - zone.z0) / (zone.z1 - zone.z0);
  };
  const double hole = drawing(*part_).stock.inner_mm;
  part::Shaft shaft{part_->material.E_MPa, part_->material.nu, {}};
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    double z0 = ends[k], z1 = ends[k + 1];
    if (!(z1 - z0 > 1e-9)) continue;
    const auto o = zone_at(outer, (z0 + z1) / 2), i = zone_at(inner, (z0 + z1) / 2);
    const double length = z1 - z0;
    if (sign_ < 0) std::swap(z0, z1);
    shaft.segments.push_back({length, diameter(o, z0), diameter(o, z1),
                              std::max(hole, diameter(i, z0)),
                              std::max(hole, diameter(i, z1))});
  }
  if (sign_ < 0) std::reverse(shaft.segments.begin(), shaft.segments.end());
  return shaft;
}

part::Shaft SetupBody::shaft(const Element& element, double left_mm) const {
  auto outer = outer_, inner = inner_;
  const auto leave = [&](Zone& zone, const auto& e, double more) {
    zone.d0 = e.left_mm + more;
    zone.d1 = e.right_mm + more;
  };
  const auto& d = drawing(*part_);
  if (element.inner)
    leave(inner[element.index], d.inner[element.index], -2 * left_mm);
  else
    leave(outer[element.index], d.outer[element.index], 2 * left_mm);
  return shaft(outer, inner);
}

part::Shaft SetupBody::shaft() const { return shaft(outer_, inner_); }

Planes planes(const catalogue::Lathe& m, Clamping clamping) {
  const auto root = [](const catalogue::RootCompliance& c) {
    return deflection::Root{c.c0_mm_N, c.c1_rad_N, c.c2_rad_Nmm};
  };
  Planes p;
  p.radial = {deflection::Method::chuck, root(m.chuck.radial), m.head_centre.radial_mm_N,
              m.tail_centre.radial_mm_N};
  p.tangential = {deflection::Method::chuck, root(m.chuck.tangential),
                  m.head_centre.tangential_mm_N, m.tail_centre.tangential_mm_N};
  if (clamping == Clamping::chuck_tailstock || clamping == Clamping::tailstock_follow)
    p.radial.method = p.tangential.method = deflection::Method::chuck_tailstock;
  if (clamping == Clamping::between_centres)
    p.radial.method = p.tangential.method = deflection::Method::between_centres;
  return p;
}

double clamping_min(const catalogue::Lathe& m, Clamping clamping) {
  switch (clamping) {
    case Clamping::chuck:
      break;
    case Clamping::chuck_tailstock:
      return m.tailstock_min;
    case Clamping::between_centres:
      return m.centres_min;
    case Clamping::chuck_steady:
      return m.steady_min;
    case Clamping::tailstock_follow:
      return m.tailstock_min + m.follow_min;
  }
  return 0;
}

bool has_tailstock(Clamping clamping) {
  return clamping == Clamping::chuck_tailstock || clamping == Clamping::between_centres ||
         clamping == Clamping::tailstock_follow;
}

}  // namespace turnwright::planning
