// What a lathe whose X slide is not square to the spindle makes of a face.
#include <cstdio>

#include "turnwright/volumetric/kinematics.hpp"

int main() {
  using namespace turnwright::volumetric;
  Axis c{.name = 'C'}, z{.name = 'Z'}, x{.name = 'X'};
  for (Axis* axis : {&c, &z, &x}) axis->Q = default_Q(axis->name);
  x.location[letter_index('B')] = 50e-6;  // EB0X, 50 urad
  const Kinematics lathe({.chain = "wCfZXt", .axes = {c, z, x}});
  for (const double x_mm : {0.0, 50.0, 100.0}) {
    const Vec3 e_mm = lathe.tip_error_mm({.q = {x_mm, 0, 0, 0, 0, 0}});
    std::printf("X %3.0f mm: %+.2f um along Z\n", x_mm, 1000 * e_mm[2]);
  }
}
