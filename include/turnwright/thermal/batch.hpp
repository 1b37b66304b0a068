#pragma once
#include <cstddef>
#include <vector>

#include "turnwright/thermal/lag_model.hpp"

namespace turnwright::thermal {

/// Parts measured, or finished, one each cycle.
struct Batch {
  double first_s = 0;  ///< the first part, on the clock of the inputs
  double cycle_s = 0;  ///< from one part to the next
  std::size_t parts = 0;
  std::size_t offset_every = 0;  ///< the tool is reset on the 1st of so many; 0: once
};

/// What the drift leaves on the parts, for the budget of a tolerance.
///
///     range           = max e - min e over all the parts                             (7)
///     between_offsets = the largest of (7) within one offset's parts                 (8)
///
/// e is along the direction of the probe: of a radius its own measure, of a diameter
/// half.
struct BatchDrift {
  std::vector<double> time_s, drift_um;
  std::vector<double> since_offset_um;  ///< of each part, against the part reset on
  double range_um = 0;
  double between_offsets_um = 0;
  double largest_step_um = 0;  ///< from one part to the next
};

/// Of a model driven by `inputs`, which must cover the batch.  One part drifts by 0.
/// @throws std::domain_error if the batch is empty, its cycle is not positive or it
///   leaves the inputs.
BatchDrift batch_drift(const LagModel& model, const Inputs& inputs, const Batch& batch);

}  // namespace turnwright::thermal
