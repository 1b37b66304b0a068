#pragma once
#include <optional>
#include <string_view>

/// Designations of ISO metric threads.
namespace turnwright::part {

/// Pitch [mm] of the coarse series of ISO 261, first and second choice, M3 to M64.
std::optional<double> coarse_pitch_mm(double d_mm);

struct MetricThread {
  double d_mm = 0;
  std::optional<double> pitch_mm = {};  ///< as written, else of the coarse series
};

/// "M30x1.5", or "M30" of the coarse series.  Nothing if the text is not that.
std::optional<MetricThread> metric_thread(std::string_view designation);

}  // namespace turnwright::part
