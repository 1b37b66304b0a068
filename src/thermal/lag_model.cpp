#include "turnwright/thermal/lag_model.hpp"

#include <algorithm>

#include "response.hpp"

namespace turnwright::thermal {

std::vector<double> drift_um(const LagModel& model, const Inputs& inputs) {
  check(inputs, "drift_um: inputs");
  const Heat h = heat(inputs.rpm, model.n_max_rpm, model.p);
  std::vector<double> e(inputs.time_s.size());
  Eigen::Map<Eigen::VectorXd> sum(e.data(), static_cast<Eigen::Index>(e.size()));
  // Eq. (1)
  sum = model.b_um_K * ambient(inputs, model.T0_degC, model.tau_amb_s).x +
        model.a_um * decay(inputs.time_s, model.tau_amb_s).x;
  sum.array() += model.c_um;
  for (const Lag& lag : model.lags)
    sum += lag.K_um * spindle(inputs.time_s, h, lag.tau_s).x;
  return e;
}

Inputs with_rows_at(const Inputs& inputs, std::span<const double> times_s) {
  check(inputs, "with_rows_at: inputs");
  std::vector<double> times(inputs.time_s);
  for (const double t : times_s)
    if (t > inputs.time_s.front() && t < inputs.time_s.back()) times.push_back(t);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  Inputs out;
  std::size_t i = 0;
  for (const double t : times) {
    while (i + 1 < inputs.time_s.size() && inputs.time_s[i + 1] <= t) ++i;
    double T = inputs.ambient_degC[i];
    if (t > inputs.time_s[i])
      T += (inputs.ambient_degC[i + 1] - T) * (t - inputs.time_s[i]) /
           (inputs.time_s[i + 1] - inputs.time_s[i]);
    out.time_s.push_back(t);
    out.rpm.push_back(inputs.rpm[i]);
    out.ambient_degC.push_back(T);
  }
  return out;
}

Inputs joined(const Inputs& first, const Inputs& later) {
  check(first, "joined: first");
  check(later, "joined: later");
  Inputs out = first;
  const double end = first.time_s.back(), begin = later.time_s.front();
  out.rpm.back() = later.rpm.front();
  out.ambient_degC.back() = later.ambient_degC.front();
  for (std::size_t i = 1; i < later.time_s.size(); ++i) {
    out.time_s.push_back(end + later.time_s[i] - begin);
    out.rpm.push_back(later.rpm[i]);
    out.ambient_degC.push_back(later.ambient_degC[i]);
  }
  return out;
}

}  // namespace turnwright::thermal
