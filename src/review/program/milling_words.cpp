#include "milling_words.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "plane.hpp"

namespace turnwright::review {
namespace {

using gcode::Control;
using What = MillingWord::What;

struct Row {
  Control control;
  std::string_view name;
  double value;
  What what;
};

constexpr Row kRows[] = {{Control::haas, "M", 154, What::begins},
                         {Control::haas, "M", 155, What::ends},
                         {Control::haas, "M", 133, What::begins},
                         {Control::haas, "M", 134, What::begins},
                         {Control::haas, "M", 135, What::stops},
                         {Control::okuma, "M", 110, What::begins},
                         {Control::okuma, "M", 109, What::ends},
                         {Control::okuma, "M", 13, What::begins},
                         {Control::okuma, "M", 14, What::begins},
                         {Control::okuma, "M", 12, What::stops},
                         {Control::okuma, "G", 137, What::plane},
                         {Control::okuma, "G", 136, What::plane_ends},
                         {Control::siemens, "M2", 3, What::begins},
                         {Control::siemens, "M2", 4, What::begins},
                         {Control::siemens, "M2", 5, What::stops},
                         {Control::haas, "G", 112, What::plane},
                         {Control::haas, "G", 113, What::plane_ends},
                         {Control::haas, "G", 107, What::cylinder},
                         {Control::haas, "G", 12.1, What::plane},
                         {Control::haas, "G", 13.1, What::plane_ends},
                         {Control::haas, "G", 7.1, What::cylinder}};

bool like_fanuc(Control c) {
  return c == Control::fanuc || c == Control::fanuc_b || c == Control::siemens_iso;
}

// Beside the axis by Y, or by C as a length.
double beside_mm(const ModalState& s, const Block& block) {
  const bool plane = s.milling.c == MillingMode::C::plane;
  const auto* w = block.find("Y");
  if (!w && plane) w = block.find("C");
  if (!w || !w->value) return s.milling.y_mm;
  const bool adds = w->meant == Word::Meant::incremental ||
                    (w->meant == Word::Meant::by_mode && s.incremental);
  return s.mm(*w->value) + (adds ? s.milling.y_mm : 0);
}

// By how much an arc of a radius is longer than its chord; the longer one for R < 0.
double longer_mm(double R, double chord) {
  const double r = std::abs(R);
  if (!(chord > 0) || !(r >= chord / 2)) return 0;
  const double angle = 2 * std::asin(chord / (2 * r));
  return r * (R < 0 ? 2 * std::numbers::pi - angle : angle) - chord;
}

}  // namespace

std::optional<MillingWord> milling_word(Control control, const Word& word) {
  if (control == Control::okuma && word.name == "SB" && word.value)
    return MillingWord{What::speed, *word.value};
  if (control == Control::siemens) {
    if (word.name == "S2" && word.value) return MillingWord{What::speed, *word.value};
    if (word.name == "TRANSMIT") return MillingWord{What::plane};
    if (word.name == "TRACYL") return MillingWord{What::cylinder};
    if (word.name == "TRAFOOF") return MillingWord{What::plane_ends};
  }
  if (!word.value) return std::nullopt;
  for (const auto& row : kRows) {
    const bool same = row.control == control || (row.control == Control::haas &&
                                                 row.name == "G" && like_fanuc(control));
    if (same && row.name == word.name && std::abs(row.value - *word.value) < 1e-6)
      return MillingWord{row.what, *word.value};
  }
  return std::nullopt;
}

void take_up(ModalState& s, const MillingWord& word) {
  auto& mode = s.milling;
  switch (word.what) {
    case What::ends:
      return s.end_milling();
    case What::stops:
      return;
    case What::plane_ends: {
      const double n = mode.n_rpm;
      s.end_milling();
      mode = {.on = true, .n_rpm = n};
      break;
    }
    case What::speed:
      mode.n_rpm = word.value;
      break;
    case What::plane:
      mode.c = MillingMode::C::plane;
      break;
    case What::cylinder:
      mode.c = MillingMode::C::cylinder;
      break;
    case What::begins:
      break;
  }
  mode.on = true;
  s.turning = false;
}

bool begins_milling(const ModalState& s, Control control, int motion,
                    const Block& block) {
  const bool c =
      block.find("C") ||
      (block.find("H") && (control == Control::fanuc || control == Control::haas));
  const auto* y = block.find("Y");
  if (s.milling.on || (!c && !y)) return false;
  if (motion > 1 || (motion == 1 && s.turning)) return false;
  return c || !s.turning || y->value != 0;
}

bool driven_move(ModalState& s, Control control, int motion, const Block& block,
                 std::optional<double> x_mm, std::optional<double> z_mm) {
  using Kind = toolpath::Move::Kind;
  auto& mode = s.milling;
  const double feed = s.per_revolution ? s.F * mode.n_rpm : s.F;
  const auto* C = block.find("C");
  if (C && C->value && mode.c != MillingMode::C::plane) {
    const double turn = std::abs(*C->value - std::exchange(mode.C_deg, *C->value));
    if (motion != 0 && feed > 0 && !x_mm && !z_mm) s.dwell(turn / feed);
  }
  if (!x_mm) x_mm = s.x_mm;
  if (!z_mm) z_mm = s.z_mm;
  if (!x_mm || !z_mm) return s.straight(Kind::rapid, x_mm, z_mm), true;
  const double y = beside_mm(s, block), dy = y - mode.y_mm;
  if (motion >= 2 && dy == 0 && s.plane == 18) return false;
  const auto R = block.value(control == Control::siemens ? "CR" : "R");
  if (motion >= 2 && R && feed > 0 && s.x_mm && s.z_mm) {
    const auto way = between({*s.x_mm, *s.z_mm}, {*x_mm, *z_mm});
    s.dwell(longer_mm(s.mm(*R), std::hypot(length(way), dy)) / feed);
  }
  toolpath::Move move{motion == 0 ? Kind::rapid : Kind::feed, *x_mm, *z_mm};
  move.y_mm = y;
  s.to(move);
  return true;
}

}  // namespace turnwright::review
