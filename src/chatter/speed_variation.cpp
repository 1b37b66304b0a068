#include "turnwright/chatter/speed_variation.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "chatter/model/free_vibration.hpp"
#include "chatter/model/map_spectrum.hpp"
#include "chatter/model/quadrature.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::chatter {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kMostSpans = 20'000;  // of a period
constexpr double kTurn = 2;            // [rad] of the fastest mode in a piece

/// Time over the angle s of (1), both 0 at the beginning of a period.
class Clock {
 public:
  Clock(double n_rpm, const SpeedVariation& v)
      : n0_(n_rpm / 60), rva_(v.rva), w_(2 * units::kPi * v.rvf * n0_) {}

  double revolutions_per_s(double t) const { return n0_ * (1 + rva_ * std::sin(w_ * t)); }

  double time_s(double s) const {
    constexpr int kMost = 200;
    double hi = s / n0_, lo = hi - 2 * rva_ / w_;  // of the time
    double t = hi;
    for (int i = 0; i < kMost && lo < hi; ++i) {
      const double angle = n0_ * t + rva_ * n0_ / w_ * (1 - std::cos(w_ * t));
      (angle > s ? hi : lo) = t;
      const double newton = t - (angle - s) / revolutions_per_s(t);
      const double next = newton > lo && newton < hi ? newton : std::midpoint(lo, hi);
      if (next == t) break;
      t = next;
    }
    return t;
  }

 private:
  double n0_, rva_, w_;
};

/// One piece of a period at one depth: its motion from the state at its begin and the
/// delayed motion, both at its nodes.
struct SpanOfTurn {
  MatrixXd from_state, from_delayed;  // x at the nodes
  MatrixXd state, push;               // state at the end, of the state and of x - delayed
};

/// Polynomials through the nodes of one rule at a place in [0, 1].
VectorXd lagrange(const Quadrature& rule, double at) {
  VectorXd out(static_cast<Index>(rule.size));
  for (std::size_t j = 0; j < rule.size; ++j) {
    double value = 1;
    for (std::size_t i = 0; i < rule.size; ++i)
      if (i != j) value *= (at - rule.nodes[i]) / (rule.nodes[j] - rule.nodes[i]);
    out(static_cast<Index>(j)) = value;
  }
  return out;
}

/// The map of (2) from one period to the next, on vectors of the state at the end and x at
/// the nodes of the last revolution.
class VariedMap {
 public:
  VariedMap(const System& system, double n_rpm, const SpeedVariation& v, double ap_mm,
            std::size_t nodes)
      : system_(system),
        clock_(n_rpm, v),
        rule_(quadrature(nodes)),
        force_N_mm_(ap_mm * std::get<ConstantForce>(system.force).K_MPa),
        states_(static_cast<Index>(2 * system.modes.size())),
        period_(1 / v.rvf) {
    cut_revolution(n_rpm, v.rva);
    for (double turn = 0; begin(turn, 0) < period_; ++turn)
      for (std::size_t j = 0; j + 1 < breaks_.size() && begin(turn, j) < period_; ++j) {
        leave_if_asked();
        pieces_.push_back(piece(turn + breaks_[j], turn + breaks_[j + 1]));
      }
    close();
  }

  Index size() const { return states_ + nodes() * per_turn(); }

  VectorXd operator()(const VectorXd& before) const {
    const Index p = nodes(), history = per_turn() * p;
    VectorXd x(history + static_cast<Index>(pieces_.size()) * p);
    x.head(history) = before.tail(history);
    VectorXd u = before.head(states_);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const Index at = static_cast<Index>(i) * p;
      const auto delayed = x.segment(at, p);
      auto now = x.segment(at + history, p);
      now = pieces_[i].from_state * u + pieces_[i].from_delayed * delayed;
      u = pieces_[i].state * u + pieces_[i].push * (now - delayed);
    }
    VectorXd after(size());
    after.head(states_) = u;
    for (Index i = 0; i < history; ++i) {
      const auto& [from, weights] = closing_[static_cast<std::size_t>(i)];
      after(states_ + i) = weights.dot(x.segment(from, p));
    }
    return after;
  }

 private:
  Index nodes() const { return static_cast<Index>(rule_.size); }
  Index per_turn() const { return static_cast<Index>(breaks_.size()) - 1; }
  double begin(double turn, std::size_t j) const { return turn + breaks_[j] + 1e-12; }

  /// Breaks a revolution into pieces of at most kTurn, and where a period ends.
  void cut_revolution(double n_rpm, double rva) {
    double fastest = 0;
    for (const Mode& m : system_.modes) fastest = std::max(fastest, rate(m));
    const double slowest_turn_s = 60 / (n_rpm * (1 - rva));
    const double count = std::ceil(fastest * slowest_turn_s / kTurn);
    if (count * period_ > kMostSpans)
      throw TooManyVibrations(tr(
          "turning: a period of the speed's variation holds too many vibrations; ask for "
          "a "
          "higher speed or frequency of variation"));
    for (double i = 0; i <= count; ++i) breaks_.push_back(i / count);
    const double end = period_ - std::floor(period_);
    const auto near = [&](double b) { return std::abs(b - end) < 1e-9; };
    if (std::ranges::none_of(breaks_, near)) breaks_.push_back(end);
    std::ranges::sort(breaks_);
  }

  /// x = free + A F and F = -K w (x - delayed) at the nodes, A of the modes' Green's
  /// functions over the time of the piece.
  SpanOfTurn piece(double from, double to) const {
    const Index p = nodes();
    const double length = to - from, t0 = clock_.time_s(from), t1 = clock_.time_s(to);
    std::vector<double> t, per_speed;
    for (const double node : rule_.nodes) {
      t.push_back(clock_.time_s(from + length * node));
      per_speed.push_back(length / clock_.revolutions_per_s(t.back()));
    }
    MatrixXd green = MatrixXd::Zero(p, p), free(p, states_);
    SpanOfTurn out{.from_state = {},
                   .from_delayed = {},
                   .state = MatrixXd::Zero(states_, states_),
                   .push = MatrixXd::Zero(states_, p)};
    for (std::size_t k = 0; k < system_.modes.size(); ++k) {
      const Mode& m = system_.modes[k];
      const double kick = m.wn_rad_s / m.k_N_mm;  // of the velocity over wn, per N s
      const auto column = static_cast<Index>(2 * k);
      for (Index i = 0; i < p; ++i) {
        const auto a = static_cast<std::size_t>(i);
        const Transition begin = transition(m, t[a] - t0);
        free(i, column) = begin.xx;
        free(i, column + 1) = begin.xv;
        for (Index j = 0; j < p; ++j) {
          const auto b = static_cast<std::size_t>(j);
          green(i, j) += kick * rule_.to_node[a * rule_.size + b] * per_speed[b] *
                         transition(m, t[a] - t[b]).xv;
        }
        const Transition rest = transition(m, t1 - t[a]);
        const double weight = kick * rule_.weights[a] * per_speed[a];
        out.push(column, i) = -force_N_mm_ * weight * rest.xv;
        out.push(column + 1, i) = -force_N_mm_ * weight * rest.vv;
      }
      const Transition whole = transition(m, t1 - t0);
      out.state.block<2, 2>(column, column) << whole.xx, whole.xv, whole.vx, whole.vv;
    }
    const MatrixXd returned = force_N_mm_ * green;
    const auto solver = (MatrixXd::Identity(p, p) + returned).partialPivLu();
    out.from_state = solver.solve(free);
    out.from_delayed = solver.solve(returned);
    return out;
  }

  /// Where the nodes of the first revolution lie a period later, and the polynomials there.
  void close() {
    for (std::size_t j = 0; j + 1 < breaks_.size(); ++j)
      for (const double node : rule_.nodes) {
        const double s = period_ + breaks_[j] +
                         (breaks_[j + 1] - breaks_[j]) * node;  // less 1, plus 1
        const double turn = std::floor(s), in_turn = s - turn;
        const auto next = std::ranges::upper_bound(breaks_, in_turn);
        const auto i = static_cast<std::size_t>(next - breaks_.begin()) - 1;
        const double at = (in_turn - breaks_[i]) / (breaks_[i + 1] - breaks_[i]);
        const auto before = static_cast<Index>(turn) * per_turn() + static_cast<Index>(i);
        closing_.emplace_back(before * nodes(), lagrange(rule_, at));
      }
  }

  const System& system_;
  Clock clock_;
  const Quadrature& rule_;
  double force_N_mm_;
  Index states_;
  double period_;  // in revolutions
  std::vector<double> breaks_;
  std::vector<SpanOfTurn> pieces_;
  std::vector<std::pair<Index, VectorXd>> closing_;  // first of the values, weights
};

/// The depth of (4).
double stable_anyway_mm(const System& system, const SpeedVariation& v) {
  double compliance = 0;
  for (const Mode& m : system.modes)
    compliance += 1 / (2 * m.k_N_mm * m.zeta * std::sqrt(1 - m.zeta * m.zeta));
  const double K = std::get<ConstantForce>(system.force).K_MPa;
  return 1 / (K * compliance * (1 + std::sqrt((1 + v.rva) / (1 - v.rva))));
}

double crossing(const System& system, double n_rpm, const SpeedVariation& v, double lo,
                double hi, std::size_t nodes) {
  constexpr int kBits = 34;  // 1e-10
  std::uintmax_t steps = 60;
  const auto [a, b] = boost::math::tools::toms748_solve(
      [&](double w) { return growth_per_revolution(system, n_rpm, v, w, nodes); }, lo, hi,
      boost::math::tools::eps_tolerance<double>(kBits), steps);
  return (a + b) / 2;
}

}  // namespace

double growth_per_revolution(const System& system, double n_rpm, const SpeedVariation& v,
                             double ap_mm, std::size_t nodes) {
  const VariedMap map(system, n_rpm, v, ap_mm, nodes);
  const Spectrum all =
      spectrum_of(map.size(), [&](const VectorXd& before) { return map(before); });
  return std::log(all.radius) * v.rvf;
}

VariedLimit varied_limit(const System& system, double n_rpm, const SpeedVariation& v,
                         double ap_max_mm) {
  constexpr double kStep = 1.05, kSafety = 3, kLeastError = 1e-9;
  constexpr std::size_t kCoarseNodes = 10, kFineNodes = 14;
  double stable = stable_anyway_mm(system, v);
  while (stable < ap_max_mm) {
    const double next = std::min(stable * kStep, ap_max_mm);
    if (growth_per_revolution(system, n_rpm, v, next, kCoarseNodes) > 0) {
      const double coarse = crossing(system, n_rpm, v, stable, next, kCoarseNodes),
                   fine = crossing(system, n_rpm, v, stable, next, kFineNodes);
      return {fine, std::max(kLeastError, kSafety * std::abs(fine - coarse) / fine)};
    }
    stable = next;
  }
  return {};
}

}  // namespace turnwright::chatter
