#include "turnwright/planning/setup_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace turnwright::planning {
namespace {

using part::End;

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

const part::Drawing& drawing(const PartPlan& p) { return p.drawing; }
bool holds_left(const PartPlan& p, std::size_t s) {
  return p.setups[s].hold == End::left;
}

// z at which the jaws end.  The first setup grips stock, the later ones the part.
double jaw_z(const PartPlan& p, std::size_t s) {
  const auto& d = drawing(p);
  const double grip = p.setups[s].grip_mm, L = part::length_mm(d);
  if (holds_left(p, s)) return grip - (s == 0 ? d.stock.left_allowance_mm : 0);
  return L - grip + (s == 0 ? part::right_allowance_mm(d) : 0);
}

double largest(const part::OuterElement& e) { return std::max(e.left_mm, e.right_mm); }

// Diameter of element i at the end that looks towards the free end, and at the other.
bool reachable(const PartPlan& p, std::size_t s, std::size_t i) {
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

bool face_named(const part::Drawing& d, const std::string& id) {
  const auto names = [&](const part::Tolerance& t) {
    return t.of == id || t.between[0] == id || t.between[1] == id;
  };
  return std::any_of(d.faces.begin(), d.faces.end(),
                     [&](const part::Face& f) { return f.id == id; }) ||
         std::any_of(d.tolerances.begin(), d.tolerances.end(), names);
}

void assign_faces(const PartPlan& p, Assignment& a) {
  const auto& d = drawing(p);
  for (const End end : {End::left, End::right}) {
    const double allowance =
        end == End::left ? d.stock.left_allowance_mm : part::right_allowance_mm(d);
    if (!(allowance > 1e-9)) continue;
    const std::string id = end == End::left ? "left" : "right";
    std::size_t s = 0;
    while (s < p.setups.size() && p.setups[s].hold == end) ++s;
    if (s < p.setups.size())
      a.setups[s].end_face = true;
    else if (face_named(d, id))
      a.unreachable.push_back("face " + id + " is held in every setup");
  }
  for (std::size_t k = 1; k < d.outer.size(); ++k) {
    const std::string id = d.outer[k - 1].id + "|" + d.outer[k].id;
    if (!face_named(d, id) || d.outer[k - 1].right_mm == d.outer[k].left_mm) continue;
    const std::size_t larger = d.outer[k - 1].right_mm > d.outer[k].left_mm ? k - 1 : k;
    const std::size_t smaller = larger == k ? k - 1 : k;
    for (auto& work : a.setups)
      if (std::find(work.elements.begin(), work.elements.end(), smaller) !=
          work.elements.end())
        work.shoulders.push_back(k);
  }
}

}  // namespace

Assignment assign(const PartPlan& p) {
  Assignment a;
  a.setups.resize(p.setups.size());
  const auto& outer = drawing(p).outer;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    std::size_t s = 0;
    while (s < p.setups.size() && !reachable(p, s, i)) ++s;
    if (s < p.setups.size())
      a.setups[s].elements.push_back(i);
    else
      a.unreachable.push_back("element " + outer[i].id +
                              " cannot be cut in any setup: it lies in the jaws, or "
                              "behind a larger diameter");
  }
  for (std::size_t s = 0; s < p.setups.size(); ++s)
    if (holds_left(p, s))
      std::reverse(a.setups[s].elements.begin(), a.setups[s].elements.end());
  assign_faces(p, a);
  return a;
}

double root_z_mm(const PartPlan& p, std::size_t s, Clamping clamping) {
  if (clamping != Clamping::between_centres) return jaw_z(p, s);
  const auto& d = drawing(p);
  // The held end is faced once a setup before has held the other one.
  const bool faced =
      std::any_of(p.setups.begin(), p.setups.begin() + static_cast<long>(s),
                  [&](const auto& q) { return q.hold != p.setups[s].hold; });
  if (holds_left(p, s)) return faced ? 0 : -d.stock.left_allowance_mm;
  return part::length_mm(d) + (faced ? 0 : part::right_allowance_mm(d));
}

double free_z_mm(const PartPlan& p, std::size_t s) {
  return holds_left(p, s) ? part::length_mm(drawing(p)) : 0;
}

double grip_diameter_mm(const PartPlan& p, std::size_t s, Clamping clamping) {
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

SetupBody::SetupBody(const PartPlan& p, std::size_t s, Clamping clamping,
                     const std::vector<bool>& finished)
    : plan_(&p),
      root_z_(root_z_mm(p, s, clamping)),
      sign_(holds_left(p, s) ? 1 : -1),
      length_(sign_ * (free_z_mm(p, s) - root_z_)) {
  const auto& d = drawing(p);
  const double stock = d.stock.outer_mm, far = 1e9;
  const double L = part::length_mm(d);
  zones_.push_back({-far, 0, stock, stock, kNone});
  for (std::size_t i = 0; i < d.outer.size(); ++i) {
    const double z0 = part::left_z_mm(d, i);
    const auto& e = d.outer[i];
    zones_.push_back({z0, z0 + e.length_mm, finished[i] ? e.left_mm : stock,
                      finished[i] ? e.right_mm : stock, i});
  }
  zones_.push_back({L, far, stock, stock, kNone});
}

part::Shaft SetupBody::shaft(std::size_t element, double offset_mm) const {
  const double inner = drawing(*plan_).stock.inner_mm;
  const double low = std::min(root_z_, root_z_ + sign_ * length_);
  const double high = low + length_;
  part::Shaft shaft{plan_->material.E_MPa, plan_->material.nu, {}};
  for (const auto& zone : zones_) {
    const double z0 = std::max(zone.z0, low), z1 = std::min(zone.z1, high);
    if (!(z1 - z0 > 1e-9)) continue;
    double d0 = zone.d0, d1 = zone.d1;
    if (zone.element != kNone && zone.element == element) {
      const auto& e = drawing(*plan_).outer[element];
      d0 = e.left_mm + 2 * offset_mm;
      d1 = e.right_mm + 2 * offset_mm;
    }
    const auto at = [&](double z) {
      return d0 + (d1 - d0) * (z - zone.z0) / (zone.z1 - zone.z0);
    };
    part::Segment segment{z1 - z0, at(z0), at(z1), inner, inner};
    if (sign_ < 0) std::swap(segment.outer_left_mm, segment.outer_right_mm);
    shaft.segments.push_back(segment);
  }
  if (sign_ < 0) std::reverse(shaft.segments.begin(), shaft.segments.end());
  return shaft;
}

part::Shaft SetupBody::shaft() const { return shaft(kNone, 0); }

Planes planes(const catalogue::Lathe& m, Clamping clamping) {
  const auto root = [](const catalogue::RootCompliance& c) {
    return deflection::Root{c.c0_mm_N, c.c1_rad_N, c.c2_rad_Nmm};
  };
  Planes p;
  p.radial = {deflection::Method::chuck, root(m.chuck.radial), m.head_centre.radial_mm_N,
              m.tail_centre.radial_mm_N};
  p.tangential = {deflection::Method::chuck, root(m.chuck.tangential),
                  m.head_centre.tangential_mm_N, m.tail_centre.tangential_mm_N};
  if (clamping == Clamping::chuck_tailstock)
    p.radial.method = p.tangential.method = deflection::Method::chuck_tailstock;
  if (clamping == Clamping::between_centres)
    p.radial.method = p.tangential.method = deflection::Method::between_centres;
  return p;
}

}  // namespace turnwright::planning
