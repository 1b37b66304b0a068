#include "demand.hpp"

#include <algorithm>
#include <cmath>

#include "turnwright/planning/setup_geometry.hpp"

namespace turnwright::planning {
namespace {

using part::Tolerance;
using part::ToleranceKind;

double middle_mm(const Tolerance& t) {
  return t.limits ? (t.limits->upper_mm + t.limits->lower_mm) / 2 : 0;
}

Demand demand(const PreparedPart& p, std::size_t index, std::optional<double> half_angle,
              Offset offset, const Making& making) {
  const Tolerance& t = p.drawing.tolerances[index];
  const auto others = allowance(p, index, making);
  const double cosine = std::cos(half_angle.value_or(0));
  using Shape = Demand::Shape;
  Demand d{.tolerance = index, .middle_mm = middle_mm(t)};
  const auto leave = [&](Cut cut) {
    d.upper = left_mm(p, index, others, cut);
    d.taken_mm =
        d.upper > 0 ? width_mm(t) - d.upper : std::max(width_mm(t), taken_mm(others));
  };
  leave(Cut::error);
  const auto size = [&](double factor, double share) {
    d.factor = factor;
    const bool known = offset == Offset::constant || p.shop.first_part_gauged;
    const bool centred = offset != Offset::none && (known || !p.robust);
    d.shape = centred ? Shape::centred : Shape::size;
    if (offset == Offset::path) d.upper = left_mm(p, index, others, Cut::corrected);
    d.upper *= share / 2;
    d.lower = -d.upper;
  };
  switch (t.kind) {
    case ToleranceKind::diameter:
      size(2, 1);
      break;
    case ToleranceKind::profile:
      size(cosine, 1);
      break;
    case ToleranceKind::length:
      size(1, 1 / std::max(1.0, faces_cut(p, t)));
      break;
    case ToleranceKind::profile_without_datum:
      d.factor = cosine;
      d.shape = Shape::range;
      break;
    case ToleranceKind::straightness:
      d.shape = Shape::straightness;
      break;
    case ToleranceKind::cylindricity:
    case ToleranceKind::total_radial_runout:
    case ToleranceKind::flatness:
    case ToleranceKind::parallelism:
    case ToleranceKind::total_axial_runout:
      d.shape = Shape::range;
      break;
    case ToleranceKind::perpendicularity:
      d.shape = half_angle ? Shape::none : Shape::range;
      break;
    default:
      break;
  }
  if (d.shape == Shape::none) leave(Cut::none);
  return d;
}

}  // namespace

std::optional<double> half_angle_rad(const part::Drawing& d, const std::string& surface) {
  const auto at = part::extent(d, surface);
  if (!at) return {};
  return std::atan2(std::abs(at->right_mm - at->left_mm) / 2, at->z1_mm - at->z0_mm);
}

bool face_is_cut(const PreparedPart& p, const std::string& face) {
  if (face == "left") return face_stock_mm(p, part::End::left) > 1e-9;
  if (face == "right") return face_stock_mm(p, part::End::right) > 1e-9;
  return true;
}

Offset free_offset(const PreparedPart& p) {
  return p.shop.first_part_gauged ? Offset::constant : Offset::none;
}

std::vector<Demand> demands(const PreparedPart& p, const std::string& surface,
                            Offset offset, const Making& making) {
  std::vector<Demand> all;
  const auto half_angle = half_angle_rad(p.drawing, surface);
  const auto& tolerances = p.drawing.tolerances;
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    const auto& t = tolerances[i];
    if (t.of == surface || (t.kind == ToleranceKind::length &&
                            (t.between[0] == surface || t.between[1] == surface)))
      all.push_back(demand(p, i, half_angle, offset, making));
  }
  return all;
}

const Demand* used_up(const std::vector<Demand>& demands) {
  for (const auto& d : demands)
    if (!(d.upper > 0)) return &d;
  return nullptr;
}

}  // namespace turnwright::planning
