#include "cut_tolerance.hpp"

#include <algorithm>
#include <cmath>

#include "planning/clamping/positions.hpp"

namespace turnwright::planning {
namespace {

using part::Tolerance;
using part::ToleranceKind;
using Rule = part::ToleranceRule;

double middle_mm(const Tolerance& t) {
  return t.limits ? (t.limits->upper_mm + t.limits->lower_mm) / 2 : 0;
}

CutTolerance cut_tolerance(const PreparedPart& p, std::size_t index,
                           std::optional<double> half_angle, Offset offset,
                           const Making& making) {
  const Tolerance& t = p.drawing.tolerances[index];
  const auto others = tolerance_allocation(p, index, making);
  const double cosine = std::cos(half_angle.value_or(0));
  using Shape = CutTolerance::Shape;
  CutTolerance d{.tolerance = index, .middle_mm = middle_mm(t)};
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
    if (centred && p.shop.edge_wear_mm > 0)
      d.lag = d.factor * p.shop.life_between_offsets / 2;
    if (offset == Offset::path) {
      d.remainder = remainder_mm(p, index, others) * share / 2;
      d.upper = left_mm(p, index, others, Cut::corrected);
    }
    d.upper *= share / 2;
    d.lower = -d.upper;
  };
  const auto& facts = part::facts(t.kind);
  switch (half_angle ? facts.rule_of_axis() : facts.rule) {
    case Rule::size:
      if (t.kind == ToleranceKind::length)
        size(1, 1 / std::max(1.0, faces_cut(p, t)));
      else
        size(2, 1);
      break;
    case Rule::profile:
      size(cosine, 1);
      break;
    case Rule::floating_profile:
      d.factor = cosine;
      d.shape = Shape::range;
      break;
    case Rule::straightness:
      d.shape = Shape::straightness;
      break;
    case Rule::range:
    case Rule::runout:
      d.shape = Shape::range;
      break;
    case Rule::machine:
      break;
  }
  if (d.shape == Shape::none) leave(Cut::none);
  return d;
}

}  // namespace

Offset free_offset(const PreparedPart& p) {
  return p.shop.first_part_gauged ? Offset::constant : Offset::none;
}

std::vector<CutTolerance> cut_tolerances(const PreparedPart& p,
                                         const std::string& surface, Offset offset,
                                         const Making& making) {
  std::vector<CutTolerance> all;
  const auto half_angle = half_angle_rad(p.drawing, surface);
  const auto& tolerances = p.drawing.tolerances;
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    const auto& t = tolerances[i];
    if (t.of == surface || (t.kind == ToleranceKind::length &&
                            (t.between[0] == surface || t.between[1] == surface)))
      all.push_back(cut_tolerance(p, i, half_angle, offset, making));
  }
  return all;
}

const CutTolerance* used_up(const std::vector<CutTolerance>& cut_tolerances) {
  for (const auto& d : cut_tolerances)
    if (!(d.upper > 0)) return &d;
  return nullptr;
}

}  // namespace turnwright::planning
