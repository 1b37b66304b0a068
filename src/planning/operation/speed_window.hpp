#pragma once
#include <array>
#include <vector>

#include "operation_checks.hpp"
#include "planning/values/economy.hpp"

/// The speeds at which an operation keeps its limits, and the best of them.
namespace turnwright::planning {

/// Weights of an operation's speed limits, in their order: the multipliers of its checks
/// times their slopes in ln v.
using SpeedWeights = std::vector<double>;

/// The speeds that satisfy speed_checks.
template <class T>
struct Window {
  T lower{}, upper{};
};
template <class T>
Window<T> speed_window(const OperationModel& o, const T& f, const T& a,
                       const cutting::Forces<T>& F, const T& n_cap) {
  Window<T> w{T(o.vc.lower), T(o.vc.upper)};
  speed_limits(o, f, a, F, n_cap, [&](bool upper, const T& v) {
    using std::max;
    using std::min;
    if (upper)
      w.upper = min(w.upper, v);
    else
      w.lower = max(w.lower, v);
  });
  return w;
}

/// A window that holds speed_window and has no corners: each end the mean of its limits
/// in the proportions of the weights, v1^w1 v2^w2 ... with w1 + w2 + ... = 1, which lies
/// between them.
template <class T>
Window<T> smooth_window(const OperationModel& o, const T& f, const T& a,
                        const cutting::Forces<T>& F, const T& n_cap,
                        const SpeedWeights& weights, Window<T> w) {
  std::array<double, 2> sum{};
  std::size_t k = 0;
  speed_limits(o, f, a, F, n_cap,
               [&](bool upper, const T&) { sum[upper] += weights[k++]; });
  std::array<T, 2> mean{T(1.0), T(1.0)};
  k = 0;
  speed_limits(o, f, a, F, n_cap, [&](bool upper, const T& v) {
    using std::pow;
    const double weight = weights[k++];
    if (weight > 0) mean[upper] = mean[upper] * pow(v, weight / sum[upper]);
  });
  if (sum[0] > 0) w.lower = mean[0];
  if (sum[1] > 0) w.upper = mean[1];
  return w;
}

/// Minutes and edges of all passes of an operation at a speed and the life it gives.
template <class T>
cutting::Duty<T> duty(const OperationModel& o, const T& v, const T& f, const T& a,
                      const T& n_cap, const T& life) {
  cutting::Duty<T> sum;
  if (!o.tapered && !o.inner) {  // cylinders add up to one
    auto whole = sweep(o, PassModel{o.left_sum_mm(), o.passes[0].path_mm}, a);
    whole.D_large_mm =
        whole.D_large_mm + static_cast<double>(o.passes.size() - 1) * o.D_large_mm;
    return cutting::duty(whole, v, f, life, n_cap, o.cut.taylor.n);
  }
  for (std::size_t k = 0; k < o.passes.size(); ++k) {
    const auto d =
        cutting::duty(sweep(o, o.passes[k], a), v, f, life, n_cap, o.cut.taylor.n);
    sum = k == 0 ? d : cutting::Duty<T>{sum.time_min + d.time_min, sum.edges + d.edges};
  }
  return sum;
}

/// Minutes of an operation in the air: feed beside the surface, approach and return.
template <class T>
T air_min(const OperationModel& o, const cutting::Duty<T>& d, const T& a) {
  return d.time_min * (fed(o, a) - 1) + o.rapid_min(a);
}

/// Contribution of an operation to the objective: minutes in the cut, in the air, and
/// changing edges.
template <class T>
T objective(const OperationModel& o, const Economy& w, const cutting::Duty<T>& d,
            const T& a) {
  return w.minute * (d.time_min * fed(o, a) + o.rapid_min(a)) +
         (w.minute * o.tool->change_min + w.edge * o.tool->edge_cost) * d.edges;
}

/// Speed of least cost in a window, and the life it gives.
template <class T>
struct BestSpeed {
  T v{}, life{};
};
template <class T>
BestSpeed<T> best_speed(const OperationModel& o, const T& f, const T& a,
                        const Window<T>& w) {
  using std::max;
  using std::min;
  using std::pow;
  const T life = economic_life_min(o, a);
  const T economic = cutting::speed_for_life_m_min(o.cut, life, f, o.depth_mm(a));
  const T ratio = min(max(T(1.0), T(w.lower / economic)), T(w.upper / economic));
  return {economic * ratio, life * pow(ratio, -1 / o.cut.taylor.n)};
}

}  // namespace turnwright::planning
