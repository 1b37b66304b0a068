#include "propagator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "free_vibration.hpp"
#include "quadrature.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::milling {
namespace {

constexpr double kGrowth = 4;       // most of ln |Phi| that one stretch may add
constexpr double kDropped = 1e-17;  // terms of the series relative to Phi
constexpr std::size_t kDegree = 60;
constexpr std::size_t kFewest = 6, kMost = 20;  // nodes of a stretch without roots
constexpr double kStretches = 20000;            // of a period: a bound on time and memory

/// Response of the modes to the cut: |q| after unit force for a time t is at most
/// min(impulse t, push t^2 / 2).
struct Receptance {
  double impulse = 0, push = 0;
};

Receptance receptance(const System& system) {
  Receptance r;
  for (const Mode& m : system.modes) {
    r.impulse += m.wn_rad_s / m.k_N_mm;
    r.push += m.wn_rad_s * m.wn_rad_s / m.k_N_mm;
  }
  return r;
}

double seconds_per_rad(double n_rpm) { return 60 / (2 * units::kPi * n_rpm); }

double largest_factor_MPa(const System& system, double n_rpm, const Arc& arc) {
  if (arc.offsets_rad.empty()) return 0;
  constexpr int kSamples = 16;
  double largest = 0;
  for (int i = 0; i <= kSamples; ++i) {
    const double angle =
        arc.begin_rad + (arc.end_rad - arc.begin_rad) * i / double{kSamples};
    const Directional h = directional_MPa(system, n_rpm, arc, angle);
    largest = std::max(
        {largest, std::abs(h.xx) + std::abs(h.xy), std::abs(h.yx) + std::abs(h.yy)});
  }
  return largest;
}

/// Times of the nodes in a stretch and the Jacobian dt/ds there [s].
struct Nodes {
  std::vector<double> t, jacobian;
};

enum class Grading { none, at_begin, at_end };

// q of t = l s^q such that gamma q is whole if a small q can do it.
double grading_power(const System& system) {
  const double gamma = std::get<PowerLawForce>(system.force).gamma;
  for (int q = 2; q <= 8; ++q)
    if (std::abs(gamma * q - std::round(gamma * q)) < 1e-9) return q;
  return 8;
}

Nodes graded_nodes(const Quadrature& rule, double length, Grading grading, double power) {
  Nodes nodes;
  for (const double s : rule.nodes) {
    const double from_root = grading == Grading::at_end ? 1 - s : s;
    const double share = grading == Grading::none ? s : std::pow(from_root, power);
    nodes.t.push_back(length * (grading == Grading::at_end ? 1 - share : share));
    nodes.jacobian.push_back(grading == Grading::none
                                 ? length
                                 : length * power * std::pow(from_root, power - 1));
  }
  return nodes;
}

/// Nodes of (3).
std::size_t nodes_for(double phase, double error) {
  double left = 1;
  for (std::size_t p = 1; p < kMost; ++p) {
    const auto n = 2 * static_cast<double>(p);
    left *= phase * phase / 4 / ((n - 1) * n);
    if (left <= error && p >= kFewest) return p;
  }
  return kMost;
}

/// q = kernel f, row by row with `columns` columns; kColumns the same if not 0.
template <std::size_t kColumns = 0>
void apply(const std::vector<double>& kernel, std::size_t columns,
           const std::vector<double>& f, std::vector<double>& q) {
  if constexpr (kColumns == 0) {
    if (columns == 2) return apply<2>(kernel, columns, f, q);
    if (columns == 4) return apply<4>(kernel, columns, f, q);
  }
  const std::size_t m = kColumns ? kColumns : columns, p = f.size() / m;
  std::fill(q.begin(), q.end(), 0.0);
  for (std::size_t i = 0; i < p; ++i) {
    const double* row = &kernel[i * p];
    double* sum = &q[i * m];
    for (std::size_t j = 0; j < p; ++j)
      for (std::size_t c = 0; c < m; ++c) sum[c] += row[j] * f[j * m + c];
  }
}

class Stretcher {
 public:
  Stretcher(const System& system, double n_rpm, double kappa_max,
            const Resolution& resolution)
      : system_(system),
        n_rpm_(n_rpm),
        kappa_max_(kappa_max),
        resolution_(resolution),
        states_(2 * system.modes.size()),
        seconds_per_rad_(seconds_per_rad(n_rpm)) {
    for (const Mode& m : system.modes) {
      axis_of_.push_back(axis_index(m.axis));
      used_[axis_of_.back()] = true;
      fastest_ = std::max(fastest_, rate(m));
    }
  }

  void add(const ArcLoad& load, std::vector<SubArc>& out) {
    const Arc& arc = load.arc;
    const double length = load.length_s;
    if (arc.offsets_rad.empty()) {
      add_free_flight(length, out);
      return;
    }
    const Receptance r = receptance(system_);
    const double force = kappa_max_ * load.largest_MPa;
    const double by_force =
        kGrowth / std::min(force * r.impulse, std::sqrt(force * r.push));
    // Green's function turns with the free modes, the motion faster by the force, the
    // directional factors twice with the spindle.
    const double turns =
        fastest_ + std::sqrt(fastest_ * fastest_ + force * r.push) + 2 / seconds_per_rad_;
    // s^q makes the motion of higher degree; and a root slows convergence beside it too.
    const bool rooted = arc.root_at_begin || arc.root_at_end;
    const double phase = resolution_.phase_rad / (rooted ? 2 : 1);
    const double longest = std::min(2 * phase / turns, by_force);
    const auto least = arc.root_at_begin && arc.root_at_end ? 2.0 : 1.0;
    const double pieces = std::max(least, std::ceil(length / longest));
    if (!(static_cast<double>(out.size()) + pieces < kStretches))
      throw ModelRangeError(
          "milling: a tooth period holds too many vibrations to follow; ask for a higher "
          "speed or a smaller depth");
    const double piece = length / pieces;
    const std::size_t nodes =
        nodes_for((rooted ? 2 : 1) * piece * turns / 2, resolution_.error);
    rule_ = &quadrature(rooted ? 2 * nodes : nodes);
    for (double i = 0; i < pieces; ++i) {
      const Grading grading = arc.root_at_begin && i == 0          ? Grading::at_begin
                              : arc.root_at_end && i + 1 == pieces ? Grading::at_end
                                                                   : Grading::none;
      prepare(piece, grading);
      out.push_back(stretch(arc, arc.begin_rad + i * piece / seconds_per_rad_));
    }
  }

 private:
  static std::size_t axis_index(Axis axis) { return axis == Axis::x ? 0 : 1; }

  /// What depends on length and grading alone: free vibration at the nodes and from the
  /// nodes to the end, and the Volterra matrices of the axes.
  void prepare(double length, Grading grading) {
    if (length == length_ && grading == kernel_grading_ && nodes_.t.size() == rule_->size)
      return;
    length_ = length;
    kernel_grading_ = grading;
    const std::size_t p = rule_->size;
    nodes_ = graded_nodes(*rule_, length, grading,
                          grading == Grading::none ? 1 : grading_power(system_));
    from_begin_.clear();
    to_end_.clear();
    for (auto& kernel : kernels_) kernel.assign(p * p, 0);
    std::vector<Transition> back(p);
    for (std::size_t k = 0; k < system_.modes.size(); ++k) {
      const Mode& m = system_.modes[k];
      for (std::size_t i = 0; i < p; ++i) {
        from_begin_.push_back(transition(m, nodes_.t[i]));
        to_end_.push_back(transition(m, length - nodes_.t[i]));
        back[i] = transition(m, -nodes_.t[i]);
      }
      auto& kernel = kernels_[axis_of_[k]];
      const double strength = m.wn_rad_s / m.k_N_mm;
      for (std::size_t i = 0; i < p; ++i) {
        const Transition& there = from_begin_[k * p + i];
        for (std::size_t j = 0; j < p; ++j)
          kernel[i * p + j] += strength * rule_->to_node[i * p + j] * nodes_.jacobian[j] *
                               (there.xx * back[j].xv + there.xv * back[j].vv);
      }
    }
  }

  // Phi_0 = e^(A t), Phi_(j+1) = -int e^(A (t - s)) B Phi_j ds; Eq. (2).
  SubArc stretch(const Arc& arc, double begin_rad) {
    const std::size_t p = rule_->size, m = states_, modes = system_.modes.size();
    std::vector<Directional> h(p);
    for (std::size_t i = 0; i < p; ++i)
      h[i] = directional_MPa(system_, n_rpm_, arc,
                             begin_rad + nodes_.t[i] / seconds_per_rad_);
    SubArc out;
    out.coefficients.assign(m * m, 0);
    std::array<std::vector<double>, 2> q{std::vector<double>(p * m),
                                         std::vector<double>(p * m)};
    std::array<std::vector<double>, 2> force = q;
    for (std::size_t k = 0; k < modes; ++k) {
      const Transition whole = transition(system_.modes[k], length_);
      double* block = &out.coefficients[2 * k * m + 2 * k];
      block[0] = whole.xx;
      block[1] = whole.xv;
      block[m] = whole.vx;
      block[m + 1] = whole.vv;
      for (std::size_t i = 0; i < p; ++i) {
        q[axis_of_[k]][i * m + 2 * k] = from_begin_[k * p + i].xx;
        q[axis_of_[k]][i * m + 2 * k + 1] = from_begin_[k * p + i].xv;
      }
    }
    double scale = 1;
    for (std::size_t degree = 1; degree <= kDegree; ++degree) {
      for (std::size_t i = 0; i < p; ++i)
        for (std::size_t c = 0; c < m; ++c) {
          const double x = q[0][i * m + c], y = q[1][i * m + c];
          force[0][i * m + c] = -(h[i].xx * x + h[i].xy * y);
          force[1][i * m + c] = -(h[i].yx * x + h[i].yy * y);
        }
      const double largest = append_end(force, out);
      out.degree = degree;
      scale *= kappa_max_;
      if (largest * scale < kDropped) break;
      for (std::size_t a = 0; a < 2; ++a)
        if (used_[a]) apply(kernels_[a], m, force[a], q[a]);
    }
    return out;
  }

  /// Adds the next coefficient, the integral to the end of the stretch; returns its
  /// largest entry.
  double append_end(const std::array<std::vector<double>, 2>& force, SubArc& out) const {
    const std::size_t p = rule_->size, m = states_, at = out.coefficients.size();
    out.coefficients.resize(at + m * m, 0);
    for (std::size_t k = 0; k < system_.modes.size(); ++k) {
      const Mode& mode = system_.modes[k];
      double* row = &out.coefficients[at + 2 * k * m];
      const auto& f = force[axis_of_[k]];
      for (std::size_t i = 0; i < p; ++i) {
        const double weight =
            rule_->weights[i] * nodes_.jacobian[i] * mode.wn_rad_s / mode.k_N_mm;
        const Transition& end = to_end_[k * p + i];
        for (std::size_t c = 0; c < m; ++c) {
          row[c] += weight * end.xv * f[i * m + c];
          row[m + c] += weight * end.vv * f[i * m + c];
        }
      }
    }
    double largest = 0;
    for (std::size_t e = at; e < out.coefficients.size(); ++e)
      largest = std::max(largest, std::abs(out.coefficients[e]));
    return largest;
  }

  // A free flight in closed form, into the stretch before it.
  void add_free_flight(double length, std::vector<SubArc>& out) const {
    const std::size_t m = states_;
    SubArc& last = out.back();
    for (std::size_t k = 0; k < system_.modes.size(); ++k) {
      const Transition free = transition(system_.modes[k], length);
      for (std::size_t j = 0; j <= last.degree; ++j) {
        double* row = &last.coefficients[j * m * m + 2 * k * m];
        for (std::size_t c = 0; c < m; ++c) {
          const double x = row[c], v = row[m + c];
          row[c] = free.xx * x + free.xv * v;
          row[m + c] = free.vx * x + free.vv * v;
        }
      }
    }
  }

  const System& system_;
  double n_rpm_, kappa_max_;
  Resolution resolution_;
  const Quadrature* rule_ = nullptr;
  std::size_t states_;
  double seconds_per_rad_;
  std::vector<std::size_t> axis_of_;
  std::array<bool, 2> used_{};
  double fastest_ = 0;
  double length_ = 0;
  Grading kernel_grading_ = Grading::none;
  Nodes nodes_;
  std::vector<Transition> from_begin_, to_end_;
  std::array<std::vector<double>, 2> kernels_;
};

}  // namespace

std::vector<ArcLoad> arc_loads(const System& system, double n_rpm) {
  std::vector<ArcLoad> out;
  for (const Arc& arc : arcs(system))
    out.push_back({.arc = arc,
                   .length_s = (arc.end_rad - arc.begin_rad) * seconds_per_rad(n_rpm),
                   .largest_MPa = largest_factor_MPa(system, n_rpm, arc)});
  return out;
}

Propagator propagator(const System& system, const std::vector<ArcLoad>& arcs,
                      double n_rpm, double kappa_max_mm, const Resolution& resolution) {
  Propagator out;
  out.states = 2 * system.modes.size();
  for (const Mode& m : system.modes)
    out.log_det -= 2 * m.zeta * m.wn_rad_s * period_s(system, n_rpm);
  Stretcher stretcher(system, n_rpm, kappa_max_mm, resolution);
  for (const ArcLoad& arc : arcs) stretcher.add(arc, out.stretches);
  return out;
}

double growth(const System& system, const std::vector<ArcLoad>& arcs, double kappa_mm) {
  const Receptance r = receptance(system);
  double sum = 0;
  for (const ArcLoad& arc : arcs) {
    const double force = kappa_mm * arc.largest_MPa;
    sum += arc.length_s * std::min(force * r.impulse / 2, std::sqrt(force * r.push));
  }
  return sum;
}

}  // namespace turnwright::milling
