// How far a shaft gives way under the passive force, along its length, in two clampings.
#include <cstdio>

#include "turnwright/deflection/beam.hpp"

int main() {
  using namespace turnwright;
  const part::Shaft shaft{
      .E_MPa = 210000, .nu = 0.3, .segments = {{100, 50, 50, 0, 0}, {150, 30, 30, 0, 0}}};
  const deflection::Beam beam(shaft);
  const double Fp_N = 300;
  for (const double z_mm : {50.0, 150.0, 250.0}) {
    const auto yields_um = [&](deflection::Method method) {
      return 1000 * Fp_N * beam.at(z_mm, {.method = method}).f_ww_mm_N;
    };
    std::printf("z %3.0f mm: %6.2f um in the chuck, %5.2f um with a tailstock\n", z_mm,
                yields_um(deflection::Method::chuck),
                yields_um(deflection::Method::chuck_tailstock));
  }
}
