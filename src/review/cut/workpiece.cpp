#include "workpiece.hpp"

#include <algorithm>
#include <cmath>

#include "planning/clamping/made_surfaces.hpp"

namespace turnwright::review {
namespace {

constexpr double kBeside_mm = 1;  // of lines beside the stock
constexpr double kLines = 8000;   // along the larger side of the stock, at most

double pitch_of(const part::Stock& stock) {
  return std::max(std::max(stock.length_mm, stock.outer_mm / 2) / kLines, 0.005);
}

}  // namespace

Workpiece::Workpiece(const planning::PreparedPart& part)
    : section({0, -part.drawing.stock.left_allowance_mm - kBeside_mm},
              {part.drawing.stock.outer_mm / 2 + kBeside_mm,
               part.drawing.stock.length_mm - part.drawing.stock.left_allowance_mm +
                   kBeside_mm},
              pitch_of(part.drawing.stock)),
      pitch_mm(pitch_of(part.drawing.stock)),
      part_(part) {
  Polygon stock;
  for (const auto& [x, z] : part::half_section(part.drawing.stock))
    stock.push_back({x, z});
  section.fill(stock);
  const auto& d = part.drawing;
  outer_left_mm_ = part::left_ends_mm(d);
  inner_left_mm_ = part::inner_left_ends_mm(d);
  for (const auto& s : part::inner_shoulders(d))
    if (part::has_tolerance(d, s.id)) faced_walls_.push_back({s.id, s.z_mm});
}

void Workpiece::make_as_drawn(std::size_t setup) {
  const auto& d = part_.drawing;
  const auto& work = part_.work.setups[setup];
  const double far = std::max(d.stock.outer_mm, d.stock.length_mm);
  const double L = part::length_mm(d);
  for (const std::size_t i : work.elements) {
    const auto& e = d.outer[i];
    const double a = part::left_z_mm(d, i), b = a + e.length_mm;
    section.cut(hull({{e.left_mm / 2, a}, {far, a}, {far, b}, {e.right_mm / 2, b}}));
  }
  for (const std::size_t i : work.bores) {
    const auto& e = d.inner[i];
    const double a = part::inner_left_z_mm(d, i), b = a + e.length_mm;
    section.cut(hull({{0, a}, {e.left_mm / 2, a}, {e.right_mm / 2, b}, {0, b}}));
  }
  const auto cut_off = [&](part::End end, double allowance_mm) {
    const double from = end == part::End::left ? -far : L + allowance_mm;
    const double to = end == part::End::left ? -allowance_mm : L + far;
    section.cut(hull({{0, from}, {far, from}, {far, to}, {0, to}}));
  };
  const auto held = part_.setups[setup].hold;
  if (work.end_face) cut_off(part::opposite(held), 0);
  if (setup == 0 && d.stock.parted_mm) cut_off(held, *d.stock.parted_mm);
}

std::string Workpiece::element_at(double z, bool inner) const {
  const auto& d = part_.drawing;
  if (inner) {
    std::string nearest;
    double least = INFINITY;
    for (std::size_t i = 0; i < d.inner.size(); ++i) {
      const double a = inner_left_mm_[i], b = a + d.inner[i].length_mm;
      const double away = std::max({a - z, z - b, 0.0});
      if (away >= least) continue;
      least = away;
      nearest = d.inner[i].id;
    }
    return nearest;
  }
  std::size_t i = 0;
  while (i + 1 < d.outer.size() && z > outer_left_mm_[i + 1]) ++i;
  return d.outer[i].id;
}

std::string Workpiece::face_at(double z, double within, bool inner) const {
  const auto& d = part_.drawing;
  if (inner) {
    for (const auto& wall : faced_walls_)
      if (std::abs(z - wall.z_mm) <= within) return wall.id;
    return element_at(z, true);
  }
  const double L = part::length_mm(d);
  if (z >= L - within) return "right";
  if (z <= within) return "left";
  for (std::size_t k = 1; k < d.outer.size(); ++k)
    if (std::abs(z - outer_left_mm_[k]) <= within) return planning::shoulder_id(d, k);
  return element_at(z, false);
}

std::optional<double> Workpiece::surface_mm(std::size_t column, bool inner) const {
  const auto& on = section.columns.on(column);
  if (on.empty()) return std::nullopt;
  return inner ? on.front().from : on.back().to;
}

}  // namespace turnwright::review
