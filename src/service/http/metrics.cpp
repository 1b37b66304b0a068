#include "metrics.hpp"

#include <prometheus/text_serializer.h>

namespace turnwright::service {
namespace {

const prometheus::Histogram::BucketBoundaries kSeconds{0.0001, 0.001, 0.01, 0.1, 0.3,
                                                       1,      3,     10,   60};

}  // namespace

Metrics::Metrics()
    : calls_(prometheus::BuildCounter()
                 .Name("turnwright_calls_total")
                 .Help("calls answered")
                 .Register(registry_)),
      seconds_(prometheus::BuildHistogram()
                   .Name("turnwright_call_seconds")
                   .Help("from the last byte of the call to the answer")
                   .Register(registry_)),
      connections(prometheus::BuildGauge()
                      .Name("turnwright_connections")
                      .Help("open connections")
                      .Register(registry_)
                      .Add({})),
      waiting(prometheus::BuildGauge()
                  .Name("turnwright_calls_waiting")
                  .Help("calls that wait for a thread or are computed")
                  .Register(registry_)
                  .Add({})),
      held_bytes(prometheus::BuildGauge()
                     .Name("turnwright_held_bytes")
                     .Help("bytes of bodies and answers on their way, of --body-memory")
                     .Register(registry_)
                     .Add({})) {}

void Metrics::answered(const std::string& route, int status, double seconds) {
  calls_.Add({{"route", route}, {"status", std::to_string(status)}}).Increment();
  seconds_.Add({{"route", route}}, kSeconds).Observe(seconds);
}

std::string Metrics::text() const {
  return prometheus::TextSerializer().Serialize(registry_.Collect());
}

}  // namespace turnwright::service
