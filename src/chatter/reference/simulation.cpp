#include <Eigen/Dense>
#include <algorithm>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "base/say.hpp"
#include "chatter/model/eigenvalues.hpp"
#include "chatter/model/free_vibration.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/chatter/reference_methods.hpp"

namespace turnwright::chatter {
namespace {

using State = std::vector<double>;  // (eta_i, eta_i'/wn_i)

struct Vector {
  double x = 0, y = 0;
};

/// A displacement with its velocity, as the history stores them.
struct Kept {
  Vector q, rate;
};

Kept kept(const System& system, const State& u) {
  Kept out;
  for (std::size_t k = 0; k < system.modes.size(); ++k) {
    const Mode& m = system.modes[k];
    double& q = m.axis == Axis::x ? out.q.x : out.q.y;
    double& rate = m.axis == Axis::x ? out.rate.x : out.rate.y;
    q += u[2 * k];
    rate += u[2 * k + 1] * m.wn_rad_s;
  }
  return out;
}

/// Cubic Hermite interpolation at the share x of a step.
Vector between(const Kept& a, const Kept& b, double step, double x) {
  const double h1 = x * x * (3 - 2 * x), h0 = 1 - h1;
  const double g0 = x * (1 - x) * (1 - x) * step, g1 = x * x * (x - 1) * step;
  return {h0 * a.q.x + h1 * b.q.x + g0 * a.rate.x + g1 * b.rate.x,
          h0 * a.q.y + h1 * b.q.y + g0 * a.rate.y + g1 * b.rate.y};
}

/// The period divided into steps, none of which crosses the end of an arc.
struct Grid {
  std::vector<double> step;
  std::vector<Directional> h;  // at begin, middle and end of each step
};

double steps_of(const System& system, const Arc& arc, double n_rpm,
                double steps_per_rad) {
  constexpr double kFewest = 8;
  const double rad_s = 2 * units::kPi * n_rpm / 60;
  double fastest = 0;
  for (const Mode& m : system.modes) fastest = std::max(fastest, rate(m));
  return std::max(kFewest, std::ceil((arc.end_rad - arc.begin_rad) / rad_s * fastest *
                                     steps_per_rad));
}

Grid grid(const System& system, double n_rpm, double steps_per_rad) {
  const double rad_s = 2 * units::kPi * n_rpm / 60;
  Grid out;
  for (const Arc& arc : arcs(system)) {
    const double length = arc.end_rad - arc.begin_rad;
    const double steps = steps_of(system, arc, n_rpm, steps_per_rad);
    for (double i = 0; i < steps; ++i) {
      out.step.push_back(length / steps / rad_s);
      for (const double x : {0.0, 0.5, 1.0})
        out.h.push_back(directional_MPa(system, n_rpm, arc,
                                        arc.begin_rad + length * (i + x) / steps));
    }
  }
  return out;
}

/// The dominant multiplier of the linear map from each state to the next, within the
/// space that the states span.
std::complex<double> largest_multiplier(const std::vector<State>& seen) {
  constexpr double kNegligible = 1e-6;  // of a direction, beside the largest
  const auto pairs = static_cast<Eigen::Index>(seen.size()) - 1;
  const auto rows = static_cast<Eigen::Index>(seen.front().size());
  Eigen::MatrixXd x(rows, pairs + 1);
  for (Eigen::Index i = 0; i <= pairs; ++i)
    x.col(i) =
        Eigen::Map<const Eigen::VectorXd>(seen[static_cast<std::size_t>(i)].data(), rows);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(x.leftCols(pairs),
                                              Eigen::ComputeThinU | Eigen::ComputeThinV);
  const auto& size = svd.singularValues();
  Eigen::Index rank = 1;
  while (rank < pairs && size(rank) > kNegligible * size(0)) ++rank;
  const Eigen::MatrixXd map = svd.matrixU().leftCols(rank).transpose() *
                              x.rightCols(pairs) * svd.matrixV().leftCols(rank) *
                              size.head(rank).cwiseInverse().asDiagonal();
  return dominant(map).multiplier;
}

}  // namespace

double simulation_steps(const System& system, double n_rpm,
                        const SimulationOptions& options) {
  double steps = 0;
  for (const Arc& arc : arcs(system))
    steps += steps_of(system, arc, n_rpm, options.steps_per_rad);
  return steps;
}

Dominant simulation(const System& system, double n_rpm, double ap_mm,
                    const SimulationOptions& options) {
  const double asked = simulation_steps(system, n_rpm, options);
  if (!(asked <= options.most_steps))
    throw ModelRangeError(
        say("a period of the simulation takes {} steps, and at most {} are simulated; a "
            "higher speed has fewer",
            std::llround(asked), std::llround(options.most_steps)));
  const Grid steps = grid(system, n_rpm, options.steps_per_rad);
  const std::size_t size = steps.step.size();
  State u(2 * system.modes.size());
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = 1 + 0.37 * static_cast<double>(i);
  // The history: at rest away from 0, a state in which no mode can remain.
  std::vector<Kept> before(size + 1, {kept(system, u).q, {}}), now(size + 1);
  boost::numeric::odeint::runge_kutta4<State> stepper;
  constexpr int kSeen = 9;
  std::vector<State> seen;
  for (int period = 0; period < options.periods; ++period) {
    leave_if_asked();
    now[0] = kept(system, u);
    for (std::size_t i = 0; i < size; ++i) {
      const double step = steps.step[i];
      const auto slope = [&](const State& at, State& change, double t) {
        const double x = t / step;
        const Directional& h =
            steps.h[3 * i + static_cast<std::size_t>(std::lround(2 * x))];
        const Vector old = between(before[i], before[i + 1], step, x);
        const Vector q = kept(system, at).q;
        const double dx = q.x - old.x, dy = q.y - old.y;
        const Vector force{-ap_mm * (h.xx * dx + h.xy * dy),
                           -ap_mm * (h.yx * dx + h.yy * dy)};
        for (std::size_t k = 0; k < system.modes.size(); ++k) {
          const Mode& m = system.modes[k];
          const double f = (m.axis == Axis::x ? force.x : force.y) / m.k_N_mm;
          change[2 * k] = m.wn_rad_s * at[2 * k + 1];
          change[2 * k + 1] = m.wn_rad_s * (f - at[2 * k] - 2 * m.zeta * at[2 * k + 1]);
        }
      };
      stepper.do_step(slope, u, 0, step);
      now[i + 1] = kept(system, u);
    }
    if (period + kSeen >= options.periods) {
      State all;
      for (const Kept& k : now) all.insert(all.end(), {k.q.x, k.q.y});
      seen.push_back(std::move(all));
    } else {
      double largest = 0;
      for (const Kept& k : now)
        largest = std::max({largest, std::abs(k.q.x), std::abs(k.q.y)});
      for (double& x : u) x /= largest;
      for (Kept& k : now) {
        k = {{k.q.x / largest, k.q.y / largest},
             {k.rate.x / largest, k.rate.y / largest}};
      }
    }
    before.swap(now);
  }
  return {.multiplier = largest_multiplier(seen), .unstable = {}};
}

}  // namespace turnwright::chatter
