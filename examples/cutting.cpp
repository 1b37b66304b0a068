// Forces, power and roughness of one cut, after Kienzle and Brammertz.
#include <cstdio>

#include "turnwright/base/units.hpp"
#include "turnwright/cutting/cut.hpp"

int main() {
  using namespace turnwright;
  catalogue::Material steel;
  steel.kc = {.k11_MPa = 1800, .m = 0.25};
  steel.gamma0_deg = 6;
  catalogue::Tool tool;
  tool.re_mm = 0.8, tool.kapr_deg = 95, tool.gamma_deg = 6;

  const cutting::Cut cut = cutting::cut_of(steel, tool);
  const double ap_mm = 2, vc_m_min = 200;
  for (const double f_mm_rev : {0.1, 0.2, 0.4}) {
    const auto F = cutting::forces_N(cut, ap_mm, f_mm_rev);
    std::printf("f %.1f mm: Fc %.0f N, Ff %.0f N, Fp %.0f N, %.2f kW, Ra %.2f um\n",
                f_mm_rev, F.Fc_N, F.Ff_N, F.Fp_N, units::power_kW(F.Fc_N, vc_m_min),
                cutting::Ra_um(cut, f_mm_rev));
  }
}
