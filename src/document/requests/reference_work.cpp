#include "reference_work.hpp"

#include <cmath>

#include "turnwright/base/language.hpp"
#include "turnwright/chatter/reference_methods.hpp"

namespace turnwright::document::stability_request {
namespace {

using chatter::ChartRequest;
using chatter::Method;

constexpr double kMostOperations = 4e11;  // of one request: about a minute
constexpr double kMostUnknowns = 600;     // of one eigenvalue problem: half a second
constexpr double kDepths = 40;            // that are judged at each speed

double unknowns(const ChartRequest& q) {
  const auto modes = static_cast<double>(q.system.modes.size());
  return q.method == Method::tfea ? 2 * modes * (q.resolution + 1)
                                  : 2 * (modes + q.resolution);
}

/// Of judging one cut, fitted to measured times at 7e9 operations a second: eigenvalues
/// take the cube of the unknowns, simulation 120 periods of so many steps.
double operations(const ChartRequest& q, double n_rpm) {
  if (q.method != Method::simulation) return 20 * std::pow(unknowns(q), 3);
  const auto modes = static_cast<double>(q.system.modes.size());
  return (2.4e5 + 2e4 * modes) * chatter::simulation_steps(q.system, n_rpm);
}

}  // namespace

void limit_reference_work(Reader& r, const chatter::ChartRequest& q) {
  if (q.method == Method::fundamental_matrix) return;
  if (q.method != Method::simulation && unknowns(q) > kMostUnknowns)
    return r.problem_at(
        q.method == Method::tfea ? "elements" : "intervals",
        tr("at most 600 unknowns: 2 modes (elements + 1), or 2 (modes + intervals)"),
        "range");
  double all = 0;
  for (const double n_rpm : q.speeds_rpm) all += kDepths * operations(q, n_rpm);
  for (const auto& point : q.points) all += operations(q, point.n_rpm);
  if (!(all <= kMostOperations))
    r.problem_at("method",
                 tr("at most 4e11 operations (about a minute) over all speeds and "
                    "points; fewer or higher speeds, or coarser steps, need fewer"),
                 "range");
}

}  // namespace turnwright::document::stability_request
