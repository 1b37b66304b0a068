#include "learn_statistics.hpp"

#include "turnwright/learning/outliers.hpp"

namespace turnwright::document::measured_parts {

Learned learned(const Request& q, std::size_t c) {
  Learned out;
  out.made = series_of(q, c);
  const auto& of = q.characteristics[c];
  out.all = learning::mix_up_of_all(out.made.series, of.limits, of.nominal_mm);
  if (out.all) {
    for (std::size_t i = 0; i < out.made.series.size(); ++i) out.left_out.push_back(i);
    return out;
  }
  out.left_out = learning::outliers(out.made.series, q.outlier_p);
  out.kept = learning::without(out.made.series, out.left_out);
  out.trend = learning::fit_trend(out.kept, q.confidence);
  return out;
}

}  // namespace turnwright::document::measured_parts
