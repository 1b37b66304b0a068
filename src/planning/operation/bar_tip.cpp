#include "bar_tip.hpp"

#include <numbers>

#include "turnwright/deflection/beam.hpp"

namespace turnwright::planning {

BarTip tip_of(const catalogue::BoringBar& bar) {
  part::Shaft shaft{bar.E_MPa, bar.nu, {}};
  double shortens_mm_N = 0;
  for (const auto& s : bar.segments) {
    shaft.segments.push_back(
        {s.length_mm, s.diameter_mm, s.diameter_mm, s.bore_mm, s.bore_mm});
    const double section_mm2 =
        std::numbers::pi / 4 * (s.diameter_mm * s.diameter_mm - s.bore_mm * s.bore_mm);
    shortens_mm_N += s.length_mm / (bar.E_MPa * section_mm2);
  }
  const deflection::Beam beam(shaft);
  const auto& h = bar.holder;
  const auto f = beam.at(beam.length_mm(), {deflection::Method::chuck,
                                            {h.c0_mm_N, h.c1_rad_N, h.c2_rad_Nmm}});
  const double offset = bar.tip_offset_mm;
  const double w = bar.tip_mm_N.value_or(f.f_ww_mm_N);
  return {w, f.f_wp_rad_N * offset, w + offset * offset * beam.twist_rad_Nmm(),
          f.f_pp_rad_Nmm * offset * offset, shortens_mm_N};
}

}  // namespace turnwright::planning
