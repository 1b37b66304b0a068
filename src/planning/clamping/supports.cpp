#include "supports.hpp"

namespace turnwright::planning {

Planes planes(const catalogue::Lathe& m, Clamping clamping) {
  const auto root = [](const catalogue::RootCompliance& c) {
    return deflection::Root{c.c0_mm_N, c.c1_rad_N, c.c2_rad_Nmm};
  };
  Planes p;
  p.radial = {deflection::Method::chuck, root(m.chuck.radial), m.head_centre.radial_mm_N,
              m.tail_centre.radial_mm_N};
  p.tangential = {deflection::Method::chuck, root(m.chuck.tangential),
                  m.head_centre.tangential_mm_N, m.tail_centre.tangential_mm_N};
  if (clamping == Clamping::chuck_tailstock || clamping == Clamping::tailstock_follow)
    p.radial.method = p.tangential.method = deflection::Method::chuck_tailstock;
  if (clamping == Clamping::between_centres)
    p.radial.method = p.tangential.method = deflection::Method::between_centres;
  return p;
}

double clamping_min(const catalogue::Lathe& m, Clamping clamping) {
  switch (clamping) {
    case Clamping::chuck:
      break;
    case Clamping::chuck_tailstock:
      return m.tailstock_min;
    case Clamping::between_centres:
      return m.centres_min;
    case Clamping::chuck_steady:
      return m.steady_min;
    case Clamping::tailstock_follow:
      return m.tailstock_min + m.follow_min;
  }
  return 0;
}

bool has_tailstock(Clamping clamping) {
  return clamping == Clamping::chuck_tailstock || clamping == Clamping::between_centres ||
         clamping == Clamping::tailstock_follow;
}

}  // namespace turnwright::planning
