// The drift of a spindle over the morning, and what it leaves of a batch.
#include <cstdio>

#include "turnwright/thermal/batch.hpp"

int main() {
  using namespace turnwright::thermal;
  const LagModel model{.lags = {{.tau_s = 600, .K_um = 4}, {.tau_s = 5400, .K_um = 9}},
                       .n_max_rpm = 4000,
                       .tau_amb_s = 3600,
                       .b_um_K = 1.5};
  const Inputs morning{{0, 14400}, {4000, 4000}, {20, 20}};
  const auto batch = batch_drift(
      model, morning, {.first_s = 300, .cycle_s = 240, .parts = 50, .offset_every = 5});
  std::printf("first part %.2f um, last part %.2f um\n", batch.drift_um.front(),
              batch.drift_um.back());
  std::printf("with the offset set every 5 parts: %.2f um\n", batch.between_offsets_um);
}
