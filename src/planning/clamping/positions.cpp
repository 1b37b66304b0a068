#include "positions.hpp"

#include <algorithm>

namespace turnwright::planning {

using part::End;

bool holds_left(const PlanRequest& p, std::size_t s) {
  return p.setups[s].hold == End::left;
}

double face_stock_mm(const PreparedPart& p, part::End end) {
  const auto& stock = p.drawing.stock;
  if (stock.parted_mm && p.setups.front().hold == end) return *stock.parted_mm;
  return end == End::left ? stock.left_allowance_mm : part::right_allowance_mm(p.drawing);
}

double jaws_z_mm(const PreparedPart& p, std::size_t s) {
  const auto& d = p.drawing;
  const double grip = p.grips_mm.at(s), L = part::length_mm(d);
  if (holds_left(p, s)) return grip - (s == 0 ? d.stock.left_allowance_mm : 0);
  return L - grip + (s == 0 ? part::right_allowance_mm(d) : 0);
}

const char* free_face(const PreparedPart& p, std::size_t s) {
  return holds_left(p, s) ? "right" : "left";
}

double root_z_mm(const PreparedPart& p, std::size_t s, Clamping clamping) {
  if (clamping != Clamping::between_centres) return jaws_z_mm(p, s);
  const auto& d = p.drawing;
  // The held end is faced once a setup before has held the other one.
  const bool faced =
      std::any_of(p.setups.begin(), p.setups.begin() + static_cast<long>(s),
                  [&](const auto& q) { return q.hold != p.setups[s].hold; });
  if (holds_left(p, s)) return faced ? 0 : -d.stock.left_allowance_mm;
  return part::length_mm(d) + (faced ? 0 : part::right_allowance_mm(d));
}

double free_z_mm(const PreparedPart& p, std::size_t s) {
  return holds_left(p, s) ? part::length_mm(p.drawing) : 0;
}

double end_stock_mm(const PreparedPart& p, std::size_t s) {
  const double L = part::length_mm(p.drawing), far = 1e9;
  return (holds_left(p, s) ? part::stock_between(p.drawing.stock, L, far)
                           : part::stock_between(p.drawing.stock, -far, 0))
      .most_mm;
}

bool cleared(const PreparedPart& p, std::size_t s, std::size_t i) {
  const auto& cut = p.drawing.outer[i].cut;
  if (!cut) return true;
  return (holds_left(p, s) ? cut->falls_to_left_rad : cut->falls_to_right_rad) <=
         part::kProfilingClears_rad;
}

bool face_is_cut(const PreparedPart& p, const std::string& face) {
  if (face == "left") return face_stock_mm(p, part::End::left) > 1e-9;
  if (face == "right") return face_stock_mm(p, part::End::right) > 1e-9;
  return true;
}

}  // namespace turnwright::planning
