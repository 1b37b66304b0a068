#pragma once
#include "document/json/reader.hpp"
#include "turnwright/chatter/chart.hpp"

namespace turnwright::document::stability_request {

/// Refuses a request of a reference method that would take too long, before it is begun.
void limit_reference_work(Reader& r, const chatter::ChartRequest& q);

}  // namespace turnwright::document::stability_request
