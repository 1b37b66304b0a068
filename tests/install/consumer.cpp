#include <cstdio>

#include "turnwright/catalogue/tool.hpp"
#include "turnwright/deflection/beam.hpp"

int main() {
  const auto insert = turnwright::catalogue::decode_iso1832("CNMG 120408-PM");
  const turnwright::part::Shaft shaft{210000, 0.3, {{100, 40, 40, 0, 0}}};
  const turnwright::deflection::Beam beam(shaft);
  const auto yields = beam.at(50, {.method = turnwright::deflection::Method::chuck});
  std::printf("corner %.1f mm, %.3g mm/N\n", insert.re_mm, yields.f_ww_mm_N);
  return yields.f_ww_mm_N > 0 ? 0 : 1;
}
