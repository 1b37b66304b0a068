#include "made_surfaces.hpp"

#include <algorithm>

#include "positions.hpp"

namespace turnwright::planning {

Finished nothing_finished(const part::Drawing& d) {
  Finished none{std::vector<bool>(d.outer.size()), std::vector<bool>(d.inner.size())};
  for (std::size_t i = 0; i < d.outer.size(); ++i) none.outer[i] = d.outer[i].as_stock;
  return none;
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

bool made_with_undercut(const part::Drawing& d, std::size_t k) {
  const auto id = shoulder_id(d, k);
  const auto& before = d.outer[k - 1];
  const auto& after = d.outer[k];
  const bool undercut = before.right_mm < after.left_mm
                            ? before.right_undercut.has_value()
                            : after.left_undercut.has_value();
  return undercut && std::ranges::none_of(d.tolerances, [&](const part::Tolerance& t) {
           return t.of == id || t.datum == id || t.common_datum == id ||
                  t.between[0] == id || t.between[1] == id;
         });
}

double face_stock_after_mm(const PreparedPart& p, std::size_t setup, part::End end) {
  const auto faced = setup_of(p, end == part::End::left ? "left" : "right");
  return faced && *faced <= setup ? 0 : face_stock_mm(p, end);
}

double face_z_mm(const part::Drawing& d, const std::string& face) {
  if (face == "left") return 0;
  for (const auto& s : part::inner_shoulders(d))
    if (s.id == face) return s.z_mm;
  for (std::size_t k = 1; k < d.outer.size(); ++k)
    if (shoulder_id(d, k) == face) return part::left_z_mm(d, k);
  return part::length_mm(d);
}

std::optional<Ring> shoulder_ring(const part::Drawing& d, const std::string& face) {
  const auto ring = [](double a, double b, bool inner) {
    const auto [small, large] = std::minmax(a, b);
    return Ring{small, large, inner};
  };
  for (std::size_t k = 1; k < d.outer.size(); ++k)
    if (shoulder_id(d, k) == face)
      return ring(d.outer[k - 1].right_mm, d.outer[k].left_mm, false);
  const auto s = part::inner_shoulder(d, face);
  if (!s) return std::nullopt;
  const auto &w = d.inner[s->wider], &n = d.inner[s->narrower];
  const bool wider_left = part::inner_left_z_mm(d, s->wider) + w.length_mm / 2 < s->z_mm;
  return wider_left ? ring(w.right_mm, n.left_mm, true)
                    : ring(n.right_mm, w.left_mm, true);
}

bool faces(const SetupWork& work, const part::InnerShoulder& shoulder) {
  return std::ranges::find(work.inner_shoulders, shoulder.wider) !=
         work.inner_shoulders.end();
}

std::string cut_with(const part::Drawing& d, const std::string& surface) {
  for (const auto& s : part::inner_shoulders(d))
    if (s.id == surface && !part::has_tolerance(d, s.id)) return d.inner[s.wider].id;
  return surface;
}

std::optional<std::size_t> setup_of(const PreparedPart& p, const std::string& of) {
  const auto& d = p.drawing;
  const auto surface = cut_with(d, of);
  for (std::size_t s = 0; s < p.work.setups.size(); ++s) {
    const SetupWork& w = p.work.setups[s];
    const auto any = [&](const std::vector<std::size_t>& indices, const auto& id) {
      return std::any_of(indices.begin(), indices.end(),
                         [&](std::size_t i) { return id(i) == surface; });
    };
    if (any(w.elements, [&](std::size_t i) { return d.outer[i].id; }) ||
        any(w.bores, [&](std::size_t i) { return d.inner[i].id; }) ||
        any(w.shoulders, [&](std::size_t k) { return shoulder_id(d, k); }) ||
        any(w.inner_shoulders,
            [&](std::size_t i) { return part::shoulder_behind(d, i)->id; }) ||
        (w.end_face && surface == free_face(p, s)))
      return s;
  }
  return {};
}

double hole_mm(const PreparedPart& p, std::size_t i) {
  return std::max(p.drawing.stock.inner_mm, p.drilled_mm.at(i));
}

}  // namespace turnwright::planning
