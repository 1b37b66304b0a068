#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "yielding.hpp"

/// Errors that one pass leaves at several positions, in shares of its passive force.
namespace turnwright::planning {

/// e_i/P of errors e_i over a box, P the passive force at the pass's depth ap:
///
///     e_i/P = sum_x c_x,i phi_x,i,   phi_x,i = F_x(ap, f)/P (d_i/ap)^eta_x            (4)
///     e_i'/P = m_i sum_x phi_x,i (c_x,i' + c_x,i (eta_x (ln d_i)' + eta_x,f (ln f)')) (5)
///
/// with x over the forces of law (1), d_i = ap + e_before,i - e_i the depth really cut,
/// eta_x and eta_x,f the elasticities of F_x over depth and feed, (ln d_i)' without the
/// yielding, and m_i = 1/(1 + gain_i).  The force varies over a box as much as the errors
/// do, its shares hardly; so
///
///     sum w_i e_i = P sum w_i e_i/P                                                  (6)
///
/// encloses a difference of errors that the enclosures of each could not.  Nothing where
/// the tool does not push all over the box.
/// Source: derived here; RecipeModel's tests sample boxes.
template <int N>
std::optional<std::vector<Dual<Interval, N>>> force_shares(
    const cutting::Cut& cut, const LogDual<N>& ap, const LogDual<N>& f,
    const cutting::Forces<LogDual<N>>& F, const std::vector<Yielded<N>>& errors) {
  const Interval full = exp(ap.ln);
  Interval depth = full;
  for (const auto& y : errors) depth = hull(depth, y.range.depth);
  if (!F.pushing_N || !(depth.lo > 0) || !(depth.hi < kInfinity)) return {};
  const DepthAndFeed over(depth, exp(f.ln));
  const auto G = cutting::forces_N(cut, over.ap, over.f);
  if (!G.pushing_N) return {};
  const Interval Ff = exp((F.Ff_N / *F.pushing_N).ln),
                 Fc = exp((F.Fc_N / *F.pushing_N).ln), Fc_N = exp(F.Fc_N.ln);
  std::vector<Dual<Interval, N>> all;
  for (const auto& y : errors) {
    const Interval cut_share = Interval(1) + (y.e_before.v - y.e.v) / full;
    if (!(cut_share.lo > 0)) return {};
    const Interval ln_share = log(cut_share);
    const Interval m = Interval(1) / (Interval(1) + y.range.gain);
    Dual<Interval, N> sum(0.0);
    const auto add = [&](const Dual<Interval, N>& c, const Interval& at_full,
                         const LogDual<2>& force, double power) {
      const Interval depth_power = force.d[0] * Interval(power),
                     feed_power = force.d[1] * Interval(power);
      const Interval phi = at_full * exp(depth_power * ln_share);
      sum.v = sum.v + c.v * phi;
      for (std::size_t j = 0; j < N; ++j) {
        const Interval ln_depth = ap.d[j] / cut_share + y.e_before.d[j] / y.range.depth;
        sum.d[j] =
            sum.d[j] +
            m * phi * (c.d[j] + c.v * (depth_power * ln_depth + feed_power * f.d[j]));
      }
    };
    add(y.law.p, Interval(1), *G.pushing_N, 1);
    add(y.law.q, Ff, G.Ff_N, 1);
    add(y.law.s, Fc, G.Fc_N, 1);
    add(y.law.r, Fc * Fc_N, G.Fc_N, 2);
    all.push_back(sum);
  }
  return all;
}

}  // namespace turnwright::planning
