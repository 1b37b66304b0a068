#include "milling_words.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

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

}  // namespace turnwright::review
