#include "thread_cuts.hpp"

#include <algorithm>
#include <cmath>

namespace turnwright::nc {

bool returns(const std::vector<Move>& moves, std::size_t k) {
  if (k == 0 || k + 3 >= moves.size()) return false;
  const Move *from = &moves[k - 1], *m = &moves[k];
  const auto same = [](const Move& a, const Move& b) {
    return a.x_mm == b.x_mm && a.z_mm == b.z_mm;
  };
  return m[1].kind == Move::Kind::thread && m[0].z_mm == from->z_mm &&
         m[1].x_mm == m[0].x_mm && m[2].x_mm == from->x_mm && m[2].z_mm == m[1].z_mm &&
         same(m[3], *from);
}

bool taps(const std::vector<Move>& moves, std::size_t k) {
  if (k == 0 || k + 1 >= moves.size()) return false;
  const Move *from = &moves[k - 1], *m = &moves[k];
  return m[0].kind == Move::Kind::thread && m[1].kind == Move::Kind::thread &&
         from->x_mm == 0 && m[0].x_mm == 0 && m[1].x_mm == 0 && m[1].z_mm == from->z_mm;
}

double ThreadCuts::outside_mm() const {
  return to.h_mm + std::copysign(depth_mm, from.h_mm - to.h_mm);
}
double ThreadCuts::first_mm() const { return depth_mm / std::sqrt(cuts); }
double ThreadCuts::least_mm() const { return depth_mm * (1 - std::sqrt(1 - 1.0 / cuts)); }

std::optional<ThreadCuts> thread_cuts(const std::vector<Move>& moves, std::size_t k) {
  std::vector<double> radii;
  for (auto i = k; returns(moves, i) && moves[i + 1].z_mm == moves[k + 1].z_mm; i += 4)
    radii.push_back(moves[i + 1].x_mm);
  const auto all = std::count_if(moves.begin(), moves.end(), [](const Move& m) {
    return m.kind == Move::Kind::thread;
  });
  if (radii.size() < 2 || radii.size() != static_cast<std::size_t>(all))
    return std::nullopt;
  const auto n = static_cast<double>(radii.size());
  const ThreadCuts t{
      .from = {moves[k - 1].x_mm, moves[k - 1].z_mm},
      .to = {radii.back(), moves[k + 1].z_mm},
      .depth_mm = std::abs(radii.front() - radii.back()) / (1 - std::sqrt(1 / n)),
      .cuts = static_cast<int>(radii.size())};
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double deep = t.first_mm() * std::sqrt(static_cast<double>(i + 1));
    if (!(std::abs(std::abs(t.outside_mm() - radii[i]) - deep) < 1e-6))
      return std::nullopt;
  }
  return t;
}

}  // namespace turnwright::nc
