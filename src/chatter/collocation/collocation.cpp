#include "collocation.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <vector>

#include "chatter/fundamental_matrix/collocation_grid.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::chatter {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kLargest = 60000;  // entries of the map's vectors

/// The map from one period to the next, on vectors of the state at the end of a period
/// and of q at the nodes of each stretch, axis by axis.
class Map {
 public:
  Map(const System& system, double n_rpm, double ap_mm)
      : states_(static_cast<Index>(2 * system.modes.size())), size_(states_) {
    const Stretches cut =
        stretches(system, arc_loads(system, n_rpm), n_rpm, 2 * ap_mm, kFine);
    for (const Stretch& stretch : cut.all) {
      size_ += static_cast<Index>(stretch.h.size()) * (cut.used[0] + cut.used[1]);
      if (size_ > static_cast<Index>(kLargest))
        throw TooManyVibrations(tr(
            "milling: too many vibrations fall into one tooth period for stability to be "
            "computed; ask for a higher speed or a smaller depth"));
      steps_.push_back(step(system, cut, stretch, ap_mm));
    }
  }

  Index size() const { return size_; }

  VectorXd operator()(const VectorXd& before) const {
    VectorXd after(size_);
    VectorXd u = before.head(states_);
    Index at = states_;
    for (const Step& s : steps_) {
      const auto d = before.segment(at, s.from_delayed.rows());
      after.segment(at, d.size()) = s.from_state * u + s.from_delayed * d;
      u = s.state * u + s.push * (after.segment(at, d.size()) - d);
      at += d.size();
    }
    after.head(states_) = u;
    return after;
  }

 private:
  struct Step {
    MatrixXd from_state, from_delayed;  // q of (1)
    MatrixXd state, push;               // u(end) of (2), of u(begin) and of q - d
  };

  Step step(const System& system, const Stretches& cut, const Stretch& stretch,
            double w) const {
    const Kernel& kernel = cut.kernels[stretch.kernel];
    const auto p = static_cast<Index>(stretch.h.size());
    std::array<Index, 2> start{0, cut.used[0] ? p : 0};
    const Index rows = p * (cut.used[0] + cut.used[1]);
    MatrixXd force = MatrixXd::Zero(rows, rows), volterra = force;  // w H and K
    for (std::size_t a = 0; a < 2; ++a) {
      if (!cut.used[a]) continue;
      for (Index i = 0; i < p; ++i) {
        const Directional& h = stretch.h[static_cast<std::size_t>(i)];
        if (cut.used[0]) force(start[a] + i, start[0] + i) = w * (a == 0 ? h.xx : h.yx);
        if (cut.used[1]) force(start[a] + i, start[1] + i) = w * (a == 0 ? h.xy : h.yy);
        for (Index j = 0; j < p; ++j)
          volterra(start[a] + i, start[a] + j) =
              kernel.axis[a][static_cast<std::size_t>(j * p + i)];
      }
    }
    MatrixXd free = MatrixXd::Zero(rows, states_), end = MatrixXd::Zero(states_, rows);
    MatrixXd state = MatrixXd::Zero(states_, states_), flight = state;
    for (std::size_t k = 0; k < system.modes.size(); ++k) {
      const Mode& mode = system.modes[k];
      const auto x = static_cast<Index>(2 * k), row = start[cut.axis_of[k]];
      const auto put = [&](MatrixXd& to, const Transition& t) {
        to.block<2, 2>(x, x) << t.xx, t.xv, t.vx, t.vv;
      };
      put(state, transition(mode, kernel.length_s));
      put(flight, transition(mode, stretch.flight_s));
      for (Index i = 0; i < p; ++i) {
        const auto node = k * static_cast<std::size_t>(p) + static_cast<std::size_t>(i);
        free(row + i, x) = kernel.from_begin[node].xx;
        free(row + i, x + 1) = kernel.from_begin[node].xv;
        const auto column = static_cast<Index>(cut.axis_of[k]) * p + i;
        const double* to_end =
            &kernel.end[static_cast<std::size_t>(column * states_ + x)];
        end(x, row + i) = to_end[0];
        end(x + 1, row + i) = to_end[1];
      }
    }
    const MatrixXd again = volterra * force;
    const auto solver = (MatrixXd::Identity(rows, rows) + again).partialPivLu();
    return {.from_state = solver.solve(free),  // Eq. (1)
            .from_delayed = solver.solve(again),
            .state = flight * state,  // Eq. (2)
            .push = -flight * end * force};
  }

  Index states_, size_;
  std::vector<Step> steps_;
};

}  // namespace

Spectrum spectrum(const System& system, double n_rpm, double ap_mm) {
  const Map map(system, n_rpm, ap_mm);
  return spectrum_of(map.size(), [&](const VectorXd& before) { return map(before); });
}

}  // namespace turnwright::chatter
