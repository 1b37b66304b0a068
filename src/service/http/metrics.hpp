#pragma once
#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>

#include <string>

namespace turnwright::service {

/// The server's metrics for Prometheus.
class Metrics {
 public:
  Metrics();
  void answered(const std::string& route, int status, double seconds);
  /// Prometheus' text exposition format.
  std::string text() const;

 private:
  prometheus::Registry registry_;
  prometheus::Family<prometheus::Counter>& calls_;
  prometheus::Family<prometheus::Histogram>& seconds_;

 public:
  prometheus::Gauge& connections;  ///< open now
  prometheus::Gauge& waiting;      ///< calls that wait for a thread or are computed
  prometheus::Gauge& held_bytes;   ///< of bodies and answers on their way
};

}  // namespace turnwright::service
