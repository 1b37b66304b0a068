#include "milled_paths.hpp"

#include <algorithm>

#include "planning/clamping/made_surfaces.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/clamping/supports.hpp"

namespace turnwright::planning {
namespace {

Engagement engagement(double ae_mm, double dc_mm) {
  const double immersion = std::min(1.0, ae_mm / dc_mm);
  return {ae_mm, immersion, cutting::milled_chip(immersion)};
}

// Largest radius of the part between two positions once a setup is done.
double highest_mm(const PreparedPart& p, std::size_t setup, double z0, double z1) {
  const auto done = finished_after(p, setup);
  const double L = part::length_mm(p.drawing);
  const bool stock =
      std::max(z0, -face_stock_after_mm(p, setup, part::End::left)) < -kSlack_mm ||
      std::min(z1, L + face_stock_after_mm(p, setup, part::End::right)) > L + kSlack_mm;
  double most = stock ? part::stock_between(p.drawing.stock, z0, z1).most_mm / 2 : 0;
  for (std::size_t i = 0; i < p.drawing.outer.size(); ++i) {
    const auto& e = p.drawing.outer[i];
    const double low = part::left_z_mm(p.drawing, i), high = low + e.length_mm;
    if (high <= z0 + kSlack_mm || low >= z1 - kSlack_mm) continue;
    const double D = done.outer[i] ? std::max(e.left_mm, e.right_mm)
                                   : part::stock_of(p.drawing, i).most_mm;
    most = std::max(most, D / 2);
  }
  return most;
}

}  // namespace

std::vector<Engagement> engagements(const Milled& m, const catalogue::MillingCutter& c,
                                    int lanes) {
  const double D = c.dc_mm, w = m.width_mm;
  if (m.kind == MilledKind::flat) return {engagement(w / lanes, D)};
  if (w - D <= kSlack_mm) return {engagement(D, D)};
  return {engagement(D, D), engagement((w - D) / 2, D)};
}

std::vector<Engagement> engagements_between(const Milled& m,
                                            const catalogue::MillingCutter& c,
                                            int lanes) {
  const auto all = engagements(m, c, lanes);
  const bool flat = m.kind == MilledKind::flat;
  if (!flat && all.size() == 1) return {};
  const double most = all.front().ae_mm, least = flat ? 0 : all.back().ae_mm;
  std::vector<Engagement> between;
  for (const double share : {0.75, 0.5, 0.25})
    between.push_back(engagement(least + share * (most - least), c.dc_mm));
  return between;
}

double depth_beside_mm(const PreparedPart& p, std::size_t setup, const Milled& m,
                       double D, RunOut out) {
  const auto beyond = [&](bool open) {
    return kHolder_mm + (open ? D / 2 + kApproach_mm : -D / 2);
  };
  const double floor = p.drawing.outer[m.element].left_mm / 2 - m.depth_mm;
  return highest_mm(p, setup, m.z_mm - beyond(out.left),
                    m.z_mm + m.length_mm + beyond(out.right)) -
         floor;
}

RunOut run_out(const PreparedPart& p, std::size_t setup, Clamping clamping,
               const Milled& m, double D) {
  const double L = part::length_mm(p.drawing), way = D + kApproach_mm;
  const double floor = p.drawing.outer[m.element].left_mm / 2 - m.depth_mm;
  const bool holds_left = p.setups[setup].hold == part::End::left;
  const double root = root_z_mm(p, setup, clamping);
  const auto open = [&](double z0, double z1, bool held_side) {
    if (held_side && (holds_left ? z0 < root : z1 > root)) return false;
    if (!held_side && has_tailstock(clamping) && (z0 < 0 || z1 > L)) return false;
    return highest_mm(p, setup, z0, z1) <= floor + kSlack_mm;
  };
  const double left = m.z_mm, right = m.z_mm + m.length_mm;
  return {open(left - way, left, holds_left), open(right, right + way, !holds_left)};
}

double layer_mm(const Milled& m, double D, int lanes, RunOut out) {
  const int open = (out.left ? 1 : 0) + (out.right ? 1 : 0);
  const double lane =
      m.length_mm + (open - 1) * D + (open > 0 ? kApproach_mm : 0);  // Eq. (1)
  if (m.kind != MilledKind::flat)
    return m.width_mm - D <= kSlack_mm ? lane
                                       : lane + 2 * (lane + m.width_mm - D);  // Eq. (2)
  return lanes * (lane + (open == 0 ? D / 2 + kApproach_mm : 0));             // Eq. (3)
}

}  // namespace turnwright::planning
