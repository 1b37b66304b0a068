#pragma once
#include <array>
#include <vector>

#include "chain.hpp"
#include "speed_window.hpp"

/// Objective of a chain, with every limit.
namespace turnwright::planning {

/// Forces of each operation at full depth.
template <class T>
std::array<cutting::Forces<T>, 2> forces(const Chain& chain, const Choice<T>& c) {
  std::array<cutting::Forces<T>, 2> F{};
  for (std::size_t i = 0; i < chain.operations.size(); ++i)
    F[i] = cutting::forces_N(chain.operations[i].cut, chain.operations[i].depth_mm(c.a),
                             c.f[i]);
  return F;
}

template <class T, class Sink>
auto tagged(const Sink& sink, std::size_t operation, bool speed) {
  return [&sink, operation, speed](Check check, const T& value, const T& limit) {
    sink(operation, check, speed, value, limit);
  };
}

/// Objective of the chain, at chosen speeds; every check goes to
/// sink(operation, check, depends on the speed, value, limit), of a tolerance the
/// functional's number in place of the operation's.
template <class T, class Sink>
T evaluate(const Chain& chain, const Choice<T>& c, const Sink& sink) {
  const auto F = forces(chain, c);
  T sum{};
  for (std::size_t i = 0; i < chain.operations.size(); ++i) {
    const auto& o = chain.operations[i];
    const auto G = o.ring ? limiting_forces(o, c.f[i], c.a) : F[i];
    const T n_cap = spindle_cap(o, G, c.a);
    depth_checks(o, c.f[i], c.a, G, tagged<T>(sink, i, false));
    chatter_checks(o, i, c.f[i], c.a, sink);
    speed_checks(o, c.v[i], c.f[i], c.a, G, n_cap, tagged<T>(sink, i, true));
    const T life = cutting::tool_life_min(o.cut, c.v[i], c.f[i], o.depth_mm(c.a));
    const T cost =
        objective(o, chain.weights, duty(o, c.v[i], c.f[i], c.a, n_cap, life), c.a);
    sum = i == 0 ? cost : sum + cost;
  }
  tolerance_checks(chain, c, F, sink);
  return sum;
}

/// Objective with the best speeds, and a function nowhere above it without the corners
/// that speed limits make where they cross.
template <class T>
struct Reduced {
  T objective{}, smooth{};
};

/// As `evaluate`, with each speed at its best for the feed and depth: the economic one,
/// held in its window.  c.v is set.  The cost falls and then rises with the speed (both
/// terms of the duty are powers of it while unclamped, and stand still where clamped), so
/// the nearest speed of the window is the best one.  Its life follows from how far it is
/// from the economic one, T_e (v/v_e)^(-1/n): over a box that says more than Taylor's law
/// with a speed, feed and depth that each vary.  A wider window cannot cost more, which
/// gives `smooth` from the weights of each operation's speed limits (none: the
/// objective).  The tolerances are checked if `wanted` says so, told the objective.
template <class T, class Sink, class Wanted>
Reduced<T> evaluate_at_best_speed(const Chain& chain, Choice<T>& c,
                                  const std::array<SpeedWeights, 2>& weights,
                                  const Sink& sink, const Wanted& wanted) {
  const auto F = forces(chain, c);
  Reduced<T> sum;
  for (std::size_t i = 0; i < chain.operations.size(); ++i) {
    const auto& o = chain.operations[i];
    const auto G = o.ring ? limiting_forces(o, c.f[i], c.a) : F[i];
    const T n_cap = spindle_cap(o, G, c.a);
    depth_checks(o, c.f[i], c.a, G, tagged<T>(sink, i, false));
    chatter_checks(o, i, c.f[i], c.a, sink);
    const auto w = speed_window(o, c.f[i], c.a, G, n_cap);
    sink(i, Check::speed_window, true, w.lower, w.upper);
    const auto cost = [&](const BestSpeed<T>& best) {
      return objective(o, chain.weights, duty(o, best.v, c.f[i], c.a, n_cap, best.life),
                       c.a);
    };
    const auto best = best_speed(o, c.f[i], c.a, w);
    c.v[i] = best.v;
    const Reduced<T> own{
        cost(best),
        weights[i].empty()
            ? cost(best)
            : cost(best_speed(o, c.f[i], c.a,
                              smooth_window(o, c.f[i], c.a, G, n_cap, weights[i], w)))};
    sum =
        i == 0 ? own : Reduced<T>{sum.objective + own.objective, sum.smooth + own.smooth};
  }
  if (wanted(sum.objective)) tolerance_checks(chain, c, F, sink);
  return sum;
}
template <class T, class Sink>
Reduced<T> evaluate_at_best_speed(const Chain& chain, Choice<T>& c,
                                  const std::array<SpeedWeights, 2>& weights,
                                  const Sink& sink) {
  return evaluate_at_best_speed(chain, c, weights, sink, [](const T&) { return true; });
}

}  // namespace turnwright::planning
