#include "centre_clearance.hpp"

#include <algorithm>

#include "made_surfaces.hpp"
#include "supports.hpp"
#include "turnwright/catalogue/live_centre.hpp"

namespace turnwright::planning {

namespace {

bool left_is_free(const PreparedPart& p, std::size_t setup) {
  return p.setups[setup].hold == part::End::right;
}

}  // namespace

bool has_live_centre(Clamping c) {
  return has_tailstock(c) || c == Clamping::between_centres;
}

double free_bore_mm(const PreparedPart& p, std::size_t setup) {
  const auto& d = p.drawing;
  const bool left = left_is_free(p, setup);
  double bore = d.stock.inner_mm;
  for (std::size_t i = 0; i < d.inner.size(); ++i) {
    const auto& e = d.inner[i];
    const bool opens_here = (e.from == part::End::left) == left;
    const auto made = opens_here ? std::nullopt : setup_of(p, e.id);
    if (opens_here || (part::leaves_part(d, i) && made && *made < setup))
      bore = std::max(bore, left ? e.left_mm : e.right_mm);
  }
  return bore;
}

double countersink_mm(const PreparedPart& p, std::size_t setup) {
  const auto& d = p.drawing;
  if (const double bore = free_bore_mm(p, setup); bore > 0) return bore;
  const auto& drawn =
      part::centre_at(d, left_is_free(p, setup) ? part::End::left : part::End::right);
  if (drawn) return drawn->diameter_mm;
  const double most = kCentreShare * (left_is_free(p, setup) ? d.outer.front().left_mm
                                                             : d.outer.back().right_mm);
  double drilled = 0;
  for (const auto& t : p.fixed_tools)
    if (t.use == catalogue::FixedUse::centring && t.form == 'A')
      for (const double size : t.sizes_mm)
        if (size <= most) drilled = std::max(drilled, size);
  return drilled > 0 ? drilled : most;
}

double clear_of_centre_mm(const PreparedPart& p, std::size_t setup,
                          const catalogue::Tool& tool, double z_mm) {
  return catalogue::clear_radius_mm(tool, p.machine.live_centre, countersink_mm(p, setup),
                                    z_mm);
}

}  // namespace turnwright::planning
