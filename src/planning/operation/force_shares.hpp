#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "yielding.hpp"

/// Sums of the errors that one pass leaves at several positions.
namespace turnwright::planning {

/// Weighted sums of errors e_i over a box in shares of P, the passive force at the pass's
/// depth ap.  With x over the forces of law (1), A_x = F_x(ap, f)/P, d_i = ap + e_before,i -
/// e_i the depth really cut, s_i = d_i/ap, eta_x and eta_x,f the elasticities of F_x over
/// depth and feed, (ln d_i)' without the yielding, and m_i = 1/(1 + gain_i):
///
///     e_i/P = sum_x A_x c_x,i s_i^eta_x                                             (4)
///     e_i'/P = m_i sum_x A_x s_i^eta_x
///              (c_x,i' + c_x,i (eta_x (ln d_i)' + eta_x,f (ln f)'))                 (5)
///
/// with eta_x between the depths ap and d_i in (4), at d_i in (5).  The force varies over a
/// box as much as the errors do, its shares hardly; P and A_x are the same at all
/// positions, and s_i is near 1.  So the sum
///
///     sum_i w_i e_i = P sum_x A_x (sum_i w_i c_x,i + sum_i w_i c_x,i (s_i^eta_x - 1)) (6)
///
/// encloses a difference of errors that the enclosures of each could not.
/// Source: derived here; RecipeModel's tests sample boxes.
template <int N>
class ForceShares {
 public:
  using Error = Dual<Interval, N>;

  /// Nothing where the tool does not push all over the box.
  static std::optional<ForceShares> of(const cutting::Cut& cut, const LogDual<N>& ap,
                                       const LogDual<N>& f,
                                       const cutting::Forces<LogDual<N>>& F,
                                       const std::vector<Yielded<N>>& errors) {
    Interval depth = exp(ap.ln);
    for (const auto& y : errors) depth = hull(depth, y.range.depth);
    if (!F.pushing_N || !(depth.lo > 0) || !(depth.hi < kInfinity)) return {};
    const DepthAndFeed over(depth, exp(f.ln));
    const auto G = cutting::forces_N(cut, over.ap, over.f);
    if (!G.pushing_N) return {};
    const Interval Fc = exp((F.Fc_N / *F.pushing_N).ln);
    ForceShares all;
    all.P_N_ = exp(F.pushing_N->ln);
    all.ap_ = ap.d;
    all.f_ = f.d;
    all.forces_ = {Force(Interval(1), *G.pushing_N, 1),
                   Force(exp((F.Ff_N / *F.pushing_N).ln), G.Ff_N, 1),
                   Force(Fc, G.Fc_N, 1), Force(Fc * exp(F.Fc_N.ln), G.Fc_N, 2)};
    for (const auto& y : errors)
      if (!all.add(y, exp(ap.ln))) return {};
    return all;
  }

  /// Of pairs of a position and its weight.
  Error sum(const std::vector<std::pair<std::size_t, double>>& terms) const {
    Error all(0.0);
    for (std::size_t x = 0; x < forces_.size(); ++x) {
      const Error s = sum_of(x, terms);
      all.v = all.v + P_N_ * forces_[x].at_full * s.v;
      for (std::size_t j = 0; j < N; ++j)
        all.d[j] = all.d[j] + P_N_ * forces_[x].at_full * s.d[j];
    }
    return all;
  }

 private:
  // A_x, eta_x and eta_x,f, of a power of a force.
  struct Force {
    Interval at_full, depth, feed;
    Force() = default;
    Force(const Interval& share, const LogDual<2>& force, double power)
        : at_full(share),
          depth(force.d[0] * Interval(power)),
          feed(force.d[1] * Interval(power)) {}
  };
  struct Position {
    std::array<Error, 4> c;              // c_x,i
    std::array<Interval, 4> cut_less{};  // s_i^eta_x - 1
    Interval m, cut_share;
    std::array<Interval, N> before;  // (ln d_i)' by the pass before
  };

  bool add(const Yielded<N>& y, const Interval& full) {
    Position p;
    p.c = {y.law.p, y.law.q, y.law.s, y.law.r};
    p.cut_share = Interval(1) + (y.e_before.v - y.e.v) / full;
    if (!(p.cut_share.lo > 0)) return false;
    const Interval ln_share = log(p.cut_share);
    for (std::size_t x = 0; x < forces_.size(); ++x)
      p.cut_less[x] = exp(forces_[x].depth * ln_share) - Interval(1);
    p.m = Interval(1) / (Interval(1) + y.range.gain);
    for (std::size_t j = 0; j < N; ++j) p.before[j] = y.e_before.d[j] / y.range.depth;
    positions_.push_back(p);
    return true;
  }

  // The part of one force in (4), by (6), and in (5), without A_x.
  Error sum_of(std::size_t x,
               const std::vector<std::pair<std::size_t, double>>& terms) const {
    const Force& F = forces_[x];
    Interval at_full(0);
    Error sum(0.0);
    for (const auto& [position, weight] : terms) {
      const Position& p = positions_[position];
      const Error wc = p.c[x] * weight;
      at_full = at_full + wc.v;
      sum.v = sum.v + wc.v * p.cut_less[x];
      const Interval k = p.m * (Interval(1) + p.cut_less[x]);
      for (std::size_t j = 0; j < N; ++j)
        sum.d[j] = sum.d[j] +
                   k * (wc.d[j] + wc.v * (F.depth * (ap_[j] / p.cut_share + p.before[j]) +
                                          F.feed * f_[j]));
    }
    sum.v = sum.v + at_full;
    return sum;
  }

  Interval P_N_;
  std::array<Interval, N> ap_{}, f_{};  // gradients of ln ap and ln f
  std::array<Force, 4> forces_;
  std::vector<Position> positions_;
};

}  // namespace turnwright::planning
