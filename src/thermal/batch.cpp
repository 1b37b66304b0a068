#include "turnwright/thermal/batch.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

namespace turnwright::thermal {
namespace {

double range(std::span<const double> e) {
  const auto [low, high] = std::ranges::minmax(e);
  return high - low;
}

}  // namespace

BatchDrift batch_drift(const LagModel& model, const Inputs& inputs, const Batch& batch) {
  BatchDrift out;
  for (std::size_t i = 0; i < batch.parts; ++i)
    out.time_s.push_back(batch.first_s + static_cast<double>(i) * batch.cycle_s);
  if (out.time_s.empty() || !(batch.cycle_s > 0) || inputs.time_s.empty() ||
      !(batch.first_s >= inputs.time_s.front()) ||
      !(out.time_s.back() <= inputs.time_s.back()))
    throw std::domain_error(
        "batch_drift: batch must have parts, cycle_s > 0 and lie within inputs.time_s");

  const Inputs rows = with_rows_at(inputs, out.time_s);
  const auto e = drift_um(model, rows);
  for (const double t : out.time_s) {
    const auto row = std::ranges::lower_bound(rows.time_s, t);
    out.drift_um.push_back(e[static_cast<std::size_t>(row - rows.time_s.begin())]);
  }
  const std::size_t group = batch.offset_every ? batch.offset_every : batch.parts;
  const std::span<const double> all(out.drift_um);
  for (std::size_t first = 0; first < batch.parts; first += group) {
    const auto parts = all.subspan(first, std::min(group, batch.parts - first));
    for (const double d : parts) out.since_offset_um.push_back(d - parts.front());
    out.between_offsets_um = std::max(out.between_offsets_um, range(parts));  // Eq. (8)
  }
  out.range_um = range(all);  // Eq. (7)
  for (std::size_t i = 1; i < batch.parts; ++i)
    out.largest_step_um = std::max(out.largest_step_um, std::abs(all[i] - all[i - 1]));
  return out;
}

}  // namespace turnwright::thermal
