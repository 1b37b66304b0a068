#include "programmed_faces.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace turnwright::planning {
namespace {

using part::Tolerance;

bool is_end(const std::string& face) { return face == "left" || face == "right"; }

bool between_ends(const Tolerance& t) {
  return is_end(t.between[0]) && is_end(t.between[1]);
}

bool is_size(const Tolerance& t) {
  return t.kind == part::ToleranceKind::diameter && t.limits;
}

double radius_to_middle_mm(const part::Limits& size) {
  return (size.lower_mm + size.upper_mm) / 4;
}

// Of the blank that a thread or a groove is cut into; none of other elements.
template <class Element>
const part::Limits* limits_of_blank(const Element& e) {
  return e.cut && e.limits ? &*e.limits : nullptr;
}

// The faces of a length from left to right.
struct Length {
  std::string a, b;
  double middle_mm = 0, width_mm = 0;
};
Length length_of(const part::Drawing& d, const Tolerance& t) {
  Length l{t.between[0], t.between[1], (t.limits->lower_mm + t.limits->upper_mm) / 2,
           part::width_mm(t)};
  if (face_z_mm(d, l.a) > face_z_mm(d, l.b)) std::swap(l.a, l.b);
  return l;
}

double moved_mm(const MovedFaces& moved, const std::string& face) {
  const auto found = moved.find(face);
  return found == moved.end() ? 0 : found->second;
}

// Numbers of the shoulders of lengths, from left to right; -1 of one that stands because no
// end is connected with it, and of the ends.
std::map<std::string, int> unknowns(const part::Drawing& d,
                                    const std::vector<Length>& lengths) {
  std::map<std::string, std::string> group;  // by its leftmost face, or an end
  for (const auto& l : lengths) group.insert({{l.a, l.a}, {l.b, l.b}});
  const auto before = [&](const std::string& a, const std::string& b) {
    if (is_end(a) != is_end(b)) return is_end(a);
    return face_z_mm(d, a) < face_z_mm(d, b);
  };
  for (std::size_t round = 0; round < lengths.size(); ++round)
    for (const auto& l : lengths) {
      auto &a = group[l.a], &b = group[l.b];
      a = b = before(a, b) ? a : b;
    }
  std::map<std::string, int> all;
  int count = 0;
  for (const auto& [face, root] : group)
    all[face] = is_end(face) || face == root ? -1 : count++;
  return all;
}

}  // namespace

MovedFaces faces_moved_mm(const part::Drawing& d) {
  std::vector<Length> lengths;
  bool off = false;
  for (const auto& t : d.tolerances)
    if (t.kind == part::ToleranceKind::length && !between_ends(t)) {
      lengths.push_back(length_of(d, t));
      off = off || lengths.back().middle_mm != 0;
    }
  if (!off) return {};
  const auto number = unknowns(d, lengths);
  const auto rows = static_cast<Eigen::Index>(lengths.size());
  const auto columns =
      std::ranges::count_if(number, [](const auto& face) { return face.second >= 0; });
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows, columns);
  Eigen::VectorXd m(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto& l = lengths[static_cast<std::size_t>(i)];
    m(i) = l.middle_mm / l.width_mm;
    if (const int k = number.at(l.a); k >= 0) A(i, k) -= 1 / l.width_mm;
    if (const int k = number.at(l.b); k >= 0) A(i, k) += 1 / l.width_mm;
  }
  if (columns == 0) return {};
  const Eigen::VectorXd moved = A.colPivHouseholderQr().solve(m);  // Eq. (1)
  MovedFaces all;
  for (const auto& [face, k] : number)
    if (k >= 0) all[face] = moved(k);
  return all;
}

double end_moved_mm(const MovedFaces& moved, const part::Drawing& d, const Element& e,
                    part::End end) {
  if (moved.empty()) return 0;
  const std::size_t k = end == part::End::left ? e.index : e.index + 1;
  if (!e.inner)
    return k > 0 && k < d.outer.size() ? moved_mm(moved, shoulder_id(d, k)) : 0;
  const auto& bore = d.inner[e.index];
  const double middle = part::inner_left_z_mm(d, e.index) + bore.length_mm / 2;
  for (const auto& s : part::inner_shoulders(d))
    if ((s.wider == e.index || s.narrower == e.index) &&
        (s.z_mm < middle) == (end == part::End::left))
      return moved_mm(moved, s.id);
  return 0;
}

double off_middle_mm(const part::Drawing& d, const part::Tolerance& t) {
  if (between_ends(t)) return 0;
  const auto moved = faces_moved_mm(d);
  const auto l = length_of(d, t);
  return moved_mm(moved, l.b) - moved_mm(moved, l.a) - l.middle_mm;
}

std::unordered_map<std::string_view, double> to_middles_mm(const part::Drawing& d) {
  std::unordered_map<std::string_view, double> all;
  for (const auto& t : d.tolerances)
    if (is_size(t)) all.try_emplace(t.of, radius_to_middle_mm(*t.limits));
  const auto of_cuts = [&](const auto& elements) {
    for (const auto& e : elements) {
      if (e.cut) all.erase(e.id);
      if (const auto* blank = limits_of_blank(e))
        all.emplace(e.id, radius_to_middle_mm(*blank));
    }
  };
  of_cuts(d.outer);
  of_cuts(d.inner);
  return all;
}

const part::Limits* turned_to_limits(const part::Drawing& d, const std::string& element) {
  const auto of_cut = [&](const auto& elements) -> const part::Limits* {
    for (const auto& e : elements)
      if (e.id == element) return limits_of_blank(e);
    return nullptr;
  };
  if (const auto* outside = of_cut(d.outer)) return outside;
  if (const auto* inside = of_cut(d.inner)) return inside;
  if (part::has_cut(d, element)) return nullptr;
  for (const auto& t : d.tolerances)
    if (is_size(t) && t.of == element) return &*t.limits;
  return nullptr;
}

double to_middle_mm(const part::Drawing& d, const std::string& element) {
  const auto* limits = turned_to_limits(d, element);
  return limits ? radius_to_middle_mm(*limits) : 0;
}

}  // namespace turnwright::planning
