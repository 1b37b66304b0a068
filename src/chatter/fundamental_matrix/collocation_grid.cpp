#include "collocation_grid.hpp"

#include <algorithm>
#include <cmath>

#include "chatter/model/quadrature.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::chatter {
namespace {

constexpr double kIntervalGrowth = 4;  // largest contribution of one interval to ln |Phi|
constexpr std::size_t kFewest = 6, kMost = 20;  // nodes of an interval without roots
constexpr double kStretches = 20000;            // of a period: a bound on time and memory

/// Response of the modes to the cut: under a unit force |q| is at most
/// min(impulse t, push t^2 / 2) after a time t.
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

double largest_factor_MPa(const System& system, double n_rpm, const ArcLoad& load) {
  const Arc& arc = load.arc;
  if (arc.offsets_rad.empty()) return 0;
  constexpr int kSamples = 16;
  double largest = 0;
  for (int i = 0; i <= kSamples; ++i) {
    const double angle =
        arc.begin_rad + (arc.end_rad - arc.begin_rad) * i / double{kSamples};
    const Directional h = load.h_MPa(system, n_rpm, angle);
    largest = std::max(
        {largest, std::abs(h.xx) + std::abs(h.xy), std::abs(h.yx) + std::abs(h.yy)});
  }
  return largest;
}

/// Times of the nodes in an interval, and the Jacobian dt/ds there [s].
struct Nodes {
  std::vector<double> t, jacobian;
};

enum class Grading { none, at_begin, at_end };

// The q of t = l s^q for which gamma q is an integer, if a small q has that property.
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

/// Number of nodes by (1).
std::size_t nodes_for(double phase, double error) {
  double left = 1;
  for (std::size_t p = 1; p < kMost; ++p) {
    const auto n = 2 * static_cast<double>(p);
    left *= phase * phase / 4 / ((n - 1) * n);
    if (left <= error && p >= kFewest) return p;
  }
  return kMost;
}

class Stretcher {
 public:
  Stretcher(const System& system, double n_rpm, double kappa_max,
            const Resolution& resolution)
      : system_(system),
        n_rpm_(n_rpm),
        kappa_max_(kappa_max),
        resolution_(resolution),
        seconds_per_rad_(seconds_per_rad(n_rpm)) {
    for (const Mode& m : system.modes) {
      out_.axis_of.push_back(m.axis == Axis::x ? 0 : 1);
      out_.used[out_.axis_of.back()] = true;
      fastest_ = std::max(fastest_, rate(m));
    }
  }

  void add(const ArcLoad& load) {
    const Arc& arc = load.arc;
    const double length = load.length_s;
    if (arc.offsets_rad.empty()) {
      out_.all.back().flight_s += length;
      return;
    }
    const Receptance r = receptance(system_);
    const double force = kappa_max_ * load.largest_MPa;
    const double by_force =
        kIntervalGrowth / std::min(force * r.impulse, std::sqrt(force * r.push));
    // Phases: Green's function has those of the free modes, the motion faster ones by the
    // force, and the directional factors twice that of the spindle.
    const double turns =
        fastest_ + std::sqrt(fastest_ * fastest_ + force * r.push) + 2 / seconds_per_rad_;
    // s^q raises the degree of the motion, and a root slows convergence in its
    // neighbourhood.
    const bool rooted = arc.root_at_begin || arc.root_at_end;
    const double phase = resolution_.phase_rad / (rooted ? 2 : 1);
    const double longest = std::min(2 * phase / turns, by_force);
    const auto least = arc.root_at_begin && arc.root_at_end ? 2.0 : 1.0;
    const double pieces = std::max(least, std::ceil(length / longest));
    if (!(static_cast<double>(out_.all.size()) + pieces < kStretches))
      throw TooManyVibrations(tr(
          "milling: a tooth period holds too many vibrations to follow; ask for a higher "
          "speed or a smaller depth"));
    const double piece = length / pieces;
    const std::size_t nodes =
        nodes_for((rooted ? 2 : 1) * piece * turns / 2, resolution_.error);
    const Quadrature& rule = quadrature(rooted ? 2 * nodes : nodes);
    auto before = Grading::none;
    for (double i = 0; i < pieces; ++i) {
      const Grading grading = arc.root_at_begin && i == 0          ? Grading::at_begin
                              : arc.root_at_end && i + 1 == pieces ? Grading::at_end
                                                                   : Grading::none;
      if (i == 0 || grading != before)
        out_.kernels.push_back(kernel(rule, piece, grading));
      before = grading;
      const std::vector<double>& t = out_.kernels.back().t_s;
      Stretch stretch{.kernel = out_.kernels.size() - 1,
                      .h = std::vector<Directional>(t.size())};
      for (std::size_t k = 0; k < t.size(); ++k)
        stretch.h[k] = load.h_MPa(system_, n_rpm_,
                                  arc.begin_rad + (i * piece + t[k]) / seconds_per_rad_);
      out_.all.push_back(std::move(stretch));
    }
  }

  Stretches take() { return std::move(out_); }

 private:
  Kernel kernel(const Quadrature& rule, double length, Grading grading) const {
    const std::size_t p = rule.size;
    const Nodes nodes = graded_nodes(
        rule, length, grading, grading == Grading::none ? 1 : grading_power(system_));
    const std::size_t states = 2 * system_.modes.size();
    Kernel out{.length_s = length,
               .t_s = nodes.t,
               .from_begin = {},
               .axis = {},
               .end = std::vector<double>(2 * p * states)};
    for (std::size_t a = 0; a < 2; ++a)
      if (out_.used[a]) out.axis[a].assign(p * p, 0);
    for (std::size_t k = 0; k < system_.modes.size(); ++k) {
      const Mode& m = system_.modes[k];
      for (std::size_t i = 0; i < p; ++i)
        out.from_begin.push_back(transition(m, nodes.t[i]));
      auto& matrix = out.axis[out_.axis_of[k]];
      const double strength = m.wn_rad_s / m.k_N_mm;
      for (std::size_t j = 0; j < p; ++j) {
        const Transition back = transition(m, -nodes.t[j]),
                         end = transition(m, length - nodes.t[j]);
        const double by_node = strength * nodes.jacobian[j],
                     weight = rule.weights[j] * by_node;
        double* column = &out.end[(out_.axis_of[k] * p + j) * states];
        column[2 * k] = weight * end.xv;
        column[2 * k + 1] = weight * end.vv;
        for (std::size_t i = 0; i < p; ++i) {
          const Transition& there = out.from_begin[k * p + i];
          matrix[j * p + i] += by_node * rule.to_node[i * p + j] *
                               (there.xx * back.xv + there.xv * back.vv);
        }
      }
    }
    return out;
  }

  const System& system_;
  double n_rpm_, kappa_max_;
  Resolution resolution_;
  double seconds_per_rad_;
  double fastest_ = 0;
  Stretches out_;
};

}  // namespace

Directional ArcLoad::h_MPa(const System& system, double n_rpm, double angle_rad) const {
  return helical ? helical->load(angle_rad).regenerative.front()
                 : directional_MPa(system, n_rpm, arc, angle_rad);
}

std::vector<ArcLoad> arc_loads(const System& system, double n_rpm) {
  std::vector<ArcLoad> out;
  for (const Arc& arc : arcs(system)) {
    out.push_back(
        {.arc = arc, .length_s = (arc.end_rad - arc.begin_rad) * seconds_per_rad(n_rpm)});
    out.back().largest_MPa = largest_factor_MPa(system, n_rpm, out.back());
  }
  return out;
}

std::vector<ArcLoad> helical_arc_loads(const Cutter& cutter, double n_rpm, double ap_mm) {
  const auto contact = std::make_shared<const CutterEngagement>(cutter, n_rpm, ap_mm);
  const std::vector<double> breaks = contact->breaks();
  std::vector<ArcLoad> out;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    ArcLoad load{
        .arc = {.begin_rad = breaks[i], .end_rad = breaks[i + 1], .offsets_rad = {}},
        .length_s = (breaks[i + 1] - breaks[i]) * seconds_per_rad(n_rpm),
        .largest_MPa = 0,
        .helical = contact};
    if (contact->cuts((breaks[i] + breaks[i + 1]) / 2)) load.arc.offsets_rad = {0};
    load.largest_MPa = largest_factor_MPa(cutter.system, n_rpm, load);
    out.push_back(std::move(load));
  }
  // Free flight follows a cut.
  const auto first = std::ranges::find_if(
      out, [](const ArcLoad& load) { return !load.arc.offsets_rad.empty(); });
  std::rotate(out.begin(), first, out.end());
  return out;
}

Stretches stretches(const System& system, const std::vector<ArcLoad>& arcs, double n_rpm,
                    double kappa_max_mm, const Resolution& resolution) {
  Stretcher stretcher(system, n_rpm, kappa_max_mm, resolution);
  for (const ArcLoad& arc : arcs) stretcher.add(arc);
  return stretcher.take();
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

}  // namespace turnwright::chatter
