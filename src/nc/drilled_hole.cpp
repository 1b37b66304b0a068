#include "drilled_hole.hpp"

#include <algorithm>
#include <cmath>

namespace turnwright::nc {
namespace {

constexpr double kAlike_mm = 1e-6;

bool alike(double a_mm, double b_mm) { return std::abs(a_mm - b_mm) < kAlike_mm; }

bool goes_on_axis(const Move& m, Move::Kind kind) {
  return m.kind == kind && m.x_mm == 0;
}

}  // namespace

double DrilledHole::step_mm() const {
  return places_mm.size() > 1 ? places_mm[0] - places_mm[1] : 0;
}

bool DrilledHole::pecked_as(gcode::PeckLaw law) const {
  if (places_mm.size() == 1) return true;
  for (std::size_t i = 1; i < places_mm.size(); ++i)
    if (!alike(places_mm[i - 1] - places_mm[i], step_mm())) return false;
  switch (law) {
    case gcode::PeckLaw::none:
      return false;
    case gcode::PeckLaw::equal:
      return alike(first_mm(), step_mm());
    case gcode::PeckLaw::reduced:
      return step_mm() <= first_mm();
  }
  return false;
}

std::vector<Move> DrilledHole::moves() const {
  std::vector<Move> all;
  for (std::size_t i = 0; i < places_mm.size(); ++i) {
    if (i > 0) all.push_back({Move::Kind::rapid, 0, places_mm[i - 1] + back_mm});
    all.push_back({Move::Kind::feed, 0, places_mm[i]});
    all.push_back({Move::Kind::rapid, 0, from_mm});
  }
  return all;
}

std::optional<DrilledHole> drilled_hole(const std::vector<Move>& moves, std::size_t k) {
  if (k == 0 || moves[k - 1].x_mm != 0) return std::nullopt;
  DrilledHole hole{.from_mm = moves[k - 1].z_mm};
  const auto drills_at = [&](std::size_t i) {
    return i + 1 < moves.size() && goes_on_axis(moves[i], Move::Kind::feed) &&
           goes_on_axis(moves[i + 1], Move::Kind::rapid) &&
           moves[i].z_mm < hole.from_mm && moves[i + 1].z_mm == hole.from_mm;
  };
  if (!drills_at(k)) return std::nullopt;
  hole.places_mm = {moves[k].z_mm};
  for (k += 2; k < moves.size() && goes_on_axis(moves[k], Move::Kind::rapid); k += 3) {
    const double back = moves[k].z_mm - hole.bottom_mm();
    const bool in = back > 0 && moves[k].z_mm < hole.from_mm;
    const bool as_before =
        hole.places_mm.size() == 1 || std::abs(back - hole.back_mm) < kAlike_mm;
    if (!in || !as_before || !drills_at(k + 1)) break;
    hole.back_mm = back;
    hole.places_mm.push_back(moves[k + 1].z_mm);
  }
  return hole;
}

DrilledHole with_equal_pecks(const DrilledHole& hole, const Pecks& pecks,
                             double back_mm) {
  const double whole = hole.from_mm - hole.bottom_mm();
  const double longest = std::min(pecks.first_mm, pecks.step_mm);
  const auto n = std::max(1L, std::lround(std::ceil(whole / longest - kAlike_mm)));
  DrilledHole equal{.from_mm = hole.from_mm, .back_mm = back_mm};
  for (long i = 1; i <= n; ++i)
    equal.places_mm.push_back(hole.from_mm -
                              whole * static_cast<double>(i) / static_cast<double>(n));
  equal.places_mm.back() = hole.bottom_mm();
  return equal;
}

}  // namespace turnwright::nc
