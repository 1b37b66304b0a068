#include "turnwright/cutting/force_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace turnwright::cutting {
namespace {

constexpr double kLeastShare = 0.34;  // cos(70 deg)
constexpr double kSameDepth = 1e-6;   // relative
constexpr std::size_t kLeftOut = 50;  // depths or replicas, at most

std::size_t number(Component c) { return static_cast<std::size_t>(c); }
const std::optional<double>& force_of(const MeasuredCut& m, Component c) {
  return m.F_N[number(c)];
}

std::optional<KienzleFit> component(std::span<const MeasuredCut> all, Component which,
                                    const Cut& edge, const FitOptions& options) {
  std::vector<ForcePoint> points;
  std::vector<std::size_t> cuts;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (const auto& F = force_of(all[i], which)) {
      const double b = engaged_edge_mm(edge, all[i].ap_mm, all[i].f_mm_rev);
      points.push_back({all[i].ap_mm * all[i].f_mm_rev / b, b, *F, all[i].lab});
      cuts.push_back(i);
    }
  if (points.empty()) return std::nullopt;
  KienzleFit fit = fit_kienzle(points, options);
  fit.evidence.rename(cuts);
  return fit;
}

// Share of a component in the thrust force.
double share(const MeasuredCut& m, Component which, const Cut& edge) {
  const double u = flow_cotangent(edge, m.ap_mm, m.f_mm_rev), sine = 1 / std::hypot(1, u);
  return which == Component::feed ? sine : u * sine;
}

// The part of the thrust force that it is to be judged by, and its share of it.
std::optional<std::pair<double, double>> part_of_thrust(const MeasuredCut& m,
                                                        const Cut& edge) {
  for (const auto c : {Component::passive, Component::feed})
    if (const double part = share(m, c, edge); force_of(m, c) && part >= kLeastShare)
      return std::pair{*force_of(m, c), part};
  return std::nullopt;
}

// Factor of a lab on kc1.1; 1 where none is known.
double lab_factor(const std::optional<KienzleFit>& Fc, std::size_t lab) {
  if (Fc && Fc->labs)
    for (const Lab& l : Fc->labs->each)
      if (l.lab == lab) return l.factor.value;
  return 1;
}

std::optional<ThrustFit> thrust(std::span<const MeasuredCut> all, const Cut& cut,
                                const std::optional<KienzleFit>& Fc,
                                const FitOptions& options) {
  if (!(cut.kc.k11_MPa > 0)) return std::nullopt;  // Fc is not known
  std::vector<ThrustPoint> points;
  std::vector<std::size_t> cuts;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (const auto part = part_of_thrust(all[i], cut)) {
      const double L = engaged_edge_mm(cut, all[i].ap_mm, all[i].f_mm_rev);
      const double Fc_N = kienzle_N(cut.kc, L, all[i].ap_mm, all[i].f_mm_rev);
      points.push_back({Fc_N * lab_factor(Fc, all[i].lab), L, part->second, part->first});
      cuts.push_back(i);
    }
  if (points.empty()) return std::nullopt;
  ThrustFit fit = fit_thrust(points, cut.thrust, options);
  fit.evidence.rename(cuts);
  return fit;
}

// A law that a material may have.
std::optional<Kienzle> constants(const std::optional<KienzleFit>& fit) {
  if (!fit || !fit->m || !(fit->m->value >= 0 && fit->m->value < 1)) return std::nullopt;
  return Kienzle{fit->k11_MPa->value, fit->m->value};
}

// The fits to some cuts; feed and passive force by `law`, or `none` if that cannot be.
ForceFit fitted(std::span<const MeasuredCut> cuts, const Cut& base, ThrustLaw law,
                const FitOptions& options) {
  ForceFit fit;
  fit.cut = base;
  for (const auto c : {Component::cutting, Component::feed, Component::passive})
    fit.kienzle[number(c)] = component(cuts, c, base, options);
  if (const auto kc = constants(fit.kienzle[number(Component::cutting)]))
    fit.cut.kc = *kc;
  fit.thrust = thrust(cuts, fit.cut, fit.kienzle[number(Component::cutting)], options);
  const auto kf = constants(fit.kienzle[number(Component::feed)]),
             kp = constants(fit.kienzle[number(Component::passive)]);
  if (law == ThrustLaw::components && kf && kp) {
    fit.law = law;
    fit.cut.kf = kf, fit.cut.kp = kp;
  }
  if (law == ThrustLaw::direction && fit.thrust && fit.thrust->ratio) {
    fit.law = law;
    fit.cut.kf = fit.cut.kp = std::nullopt;
    fit.cut.thrust.ratio = fit.thrust->ratio->value;
    fit.cut.thrust.edge_N_mm = fit.thrust->edge_N_mm->value;
  }
  return fit;
}

std::vector<double> depths(std::span<const MeasuredCut> cuts) {
  std::vector<double> all;
  for (const auto& m : cuts) all.push_back(m.ap_mm);
  std::ranges::sort(all);
  const auto same = [](double a, double b) { return b - a <= kSameDepth * b; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  return all;
}

// Of feed and passive force where they are a good part of the thrust force.
PredictionErrors errors(std::span<const MeasuredCut> cuts, const Cut& law) {
  PredictionErrors rms;
  for (const auto c : {Component::cutting, Component::feed, Component::passive}) {
    const std::size_t k = number(c);
    double sum = 0;
    int n = 0;
    for (const auto& m : cuts) {
      if (!m.F_N[k] || (c != Component::cutting && share(m, c, law) < kLeastShare))
        continue;
      const auto F = forces_N(law, m.ap_mm, m.f_mm_rev);
      const std::array<double, kComponents> said{F.Fc_N, F.Ff_N, F.Fp_N};
      sum += sqr(said[k] / *m.F_N[k] - 1);
      ++n;
    }
    if (n > 0) rms[k] = std::sqrt(sum / n);
  }
  return rms;
}

// Errors of the cuts with each value of a key by the law of the others; none if some value
// cannot be left out because the others do not determine the law, or if there are too many.
template <class Key, class Same>
std::vector<PredictionErrors> left_out(std::span<const MeasuredCut> cuts,
                                       const std::vector<Key>& each, const Same& same,
                                       const Cut& base, ThrustLaw law,
                                       const FitOptions& options) {
  std::vector<PredictionErrors> all;
  if (each.size() < 2 || each.size() > kLeftOut) return all;
  for (const Key& key : each) {
    std::vector<MeasuredCut> kept, left;
    for (const auto& m : cuts) (same(m, key) ? left : kept).push_back(m);
    const ForceFit fit = fitted(kept, base, law, options);
    const auto& Fc = fit.kienzle[number(Component::cutting)];
    if (fit.law != law || (Fc && !constants(Fc))) return {};
    all.push_back(errors(left, fit.cut));
    if (law == ThrustLaw::none)  // says nothing of these
      for (const auto c : {Component::feed, Component::passive})
        all.back()[number(c)].reset();
  }
  return all;
}

std::vector<LeftOut> left_out_depths(std::span<const MeasuredCut> cuts, const Cut& base,
                                     ThrustLaw law, const FitOptions& options) {
  const auto each = depths(cuts);
  const auto same = [](const MeasuredCut& m, double ap) {
    return std::abs(m.ap_mm - ap) <= kSameDepth * ap;
  };
  const auto rms = left_out(cuts, each, same, base, law, options);
  std::vector<LeftOut> all;
  for (std::size_t i = 0; i < rms.size(); ++i) all.push_back({each[i], rms[i]});
  return all;
}

std::vector<LeftOutReplica> left_out_replicas(std::span<const MeasuredCut> cuts,
                                              const Cut& base, ThrustLaw law,
                                              const FitOptions& options) {
  std::set<std::size_t> names;
  for (const auto& m : cuts)
    if (m.replica) names.insert(*m.replica);
  const std::vector<std::size_t> each(names.begin(), names.end());
  const auto same = [](const MeasuredCut& m, std::size_t name) {
    return m.replica == name;
  };
  const auto rms = left_out(cuts, each, same, base, law, options);
  std::vector<LeftOutReplica> all;
  for (std::size_t i = 0; i < rms.size(); ++i) all.push_back({each[i], rms[i]});
  return all;
}

// Sum of squares over feed and passive force; infinite where nothing was validated.
double thrust_error(const std::vector<LeftOut>& all) {
  if (all.empty()) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (const auto& l : all)
    for (const auto c : {Component::feed, Component::passive})
      sum += sqr(l.rms[number(c)].value_or(0));
  return sum;
}

}  // namespace

ForceFit fit_forces(std::span<const MeasuredCut> cuts, const Cut& base,
                    const FitOptions& options) {
  ForceFit direction = fitted(cuts, base, ThrustLaw::direction, options);
  direction.left_out = left_out_depths(cuts, base, direction.law, options);
  ForceFit components = fitted(cuts, base, ThrustLaw::components, options);
  if (components.law != ThrustLaw::none)
    components.left_out = left_out_depths(cuts, base, components.law, options);
  const bool better =
      components.law != ThrustLaw::none &&
      (direction.law == ThrustLaw::none ||
       thrust_error(components.left_out) < thrust_error(direction.left_out));
  ForceFit& chosen = better ? components : direction;
  chosen.left_out_replicas = left_out_replicas(cuts, base, chosen.law, options);
  return chosen;
}

}  // namespace turnwright::cutting
