#pragma once
#include <cstddef>
#include <vector>

#include "turnwright/thermal/lag_model.hpp"

namespace turnwright::thermal {

/// A batch of parts that are finished at equal intervals.
struct Batch {
  double first_s = 0;  ///< time of the first part, on the clock of the inputs
  double cycle_s = 0;  ///< time from one part to the next
  std::size_t parts = 0;
  std::size_t offset_every = 0;  ///< parts between two resets of the tool offset; 0: one
                                 ///< reset on the first part alone
};

/// Effect of the drift on the parts, for the error budget of a tolerance.
///
///     range           = max e - min e over all the parts                             (7)
///     between_offsets = the largest of (7) within the parts of one offset            (8)
///
/// e is measured along the direction of the probe: it is the error of a radius, and half
/// the error of a diameter.
struct BatchDrift {
  std::vector<double> time_s, drift_um;
  std::vector<double> since_offset_um;  ///< drift of each part since the last reset
  double range_um = 0;
  double between_offsets_um = 0;
  double largest_step_um = 0;  ///< from one part to the next
};

/// Drift of a batch by a model with `inputs`, which must cover the batch.  A single part
/// has the drift 0.
/// @throws std::domain_error if the batch is empty, its cycle is not positive or it
///   extends beyond the inputs.
BatchDrift batch_drift(const LagModel& model, const Inputs& inputs, const Batch& batch);

}  // namespace turnwright::thermal
