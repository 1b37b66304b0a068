#include "relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace turnwright::multipass {
double MeanLife::at(double s) const {
  // the larger term first, so that exp cannot overflow
  return s > 0 ? s + std::log(theta_ * std::exp(-s) + 1 - theta_)
               : std::log(theta_ + (1 - theta_) * std::exp(s));
}

Line MeanLife::chord(const Interval& s) const {
  if (!(width(s) > 0)) return tangent(s.lo);
  const double beta = (at(s.hi) - at(s.lo)) / width(s);
  return {at(s.lo) - beta * s.lo, beta};
}

Line MeanLife::tangent(double s) const {
  const double beta = (1 - theta_) * std::exp(s - at(s));
  return {at(s) - beta * s, beta};
}

std::vector<Affine> depth_limits(const Depths& depths, const Interval& u) {
  if (!(width(u) > 0)) return {};
  const auto line = [](double value, double slope, double at) {
    Affine x;
    x.a[kDs] = 1;
    x.a[kDr] = -slope;
    x.c = slope * at - value;
    return x;
  };
  const double lo = depths.finishing(u.lo), hi = depths.finishing(u.hi);
  std::vector<Affine> limits{-1.0 * line(lo, (hi - lo) / width(u), u.lo)};
  for (const double at : {u.lo, mid(u), u.hi})
    limits.push_back(line(depths.finishing(at), depths.slope(at), at));
  return limits;
}

optimise::Monomials monomials(const std::vector<Affine>& rows) {
  const auto k = static_cast<Eigen::Index>(rows.size());
  optimise::Monomials m{Eigen::MatrixXd(k, static_cast<Eigen::Index>(kVariables)),
                        Eigen::VectorXd(k)};
  for (Eigen::Index i = 0; i < k; ++i) {
    m.a.row(i) = rows[static_cast<std::size_t>(i)].a;
    m.c[i] = rows[static_cast<std::size_t>(i)].c;
  }
  return m;
}

Relaxation::Relaxation(const Problem& m, const std::vector<Row>& rows,
                       const Depths& depths)
    : depths_(depths),
      literal_(m.cost == Cost::literal),
      mean_life_(m.theta),
      lower_(Log::Constant(-kFar)),
      upper_(Log::Constant(kFar)),
      roughing_life_(life(m, kVr)),
      finishing_life_(life(m, kVs)),
      ratio_(finishing_life_ - roughing_life_),
      roughing_time_(roughing_time(m, depths.n)),
      finishing_time_(finishing_time(m)),
      fixed_cost_(m.k0 * (m.tc + (m.h1 * m.L_mm + m.h2) * (depths.n + 1))),
      k0_(m.k0),
      tool_(m.k0 * m.te + m.kt) {
  for (const Row& row : rows) {
    Eigen::Index j = 0;
    const double a = row.g.a.cwiseAbs().maxCoeff(&j);
    const bool alone = (row.g.a.array() != 0).count() == 1;
    if (!alone)
      limits_.push_back(row.g);
    else if (row.g.a[j] > 0)
      upper_[j] = std::min(upper_[j], -row.g.c / a);
    else
      lower_[j] = std::max(lower_[j], row.g.c / a);
  }
  for (int j = 0; j < kVariables; ++j)
    if (lower_[j] > upper_[j])  // by rounding, or it would not be allowed at all
      lower_[j] = upper_[j] = (lower_[j] + upper_[j]) / 2;
}

optimise::Posynomial Relaxation::program(const Interval& ln_dr, const Interval& s,
                                         const Line& line) const {
  optimise::Posynomial q;
  std::vector<Affine> terms;
  const auto add = [&terms](double factor, const Affine& ln) {
    if (factor > 0) terms.push_back(ln + std::log(factor));
  };
  Affine none;
  add(fixed_cost_, none);
  add(k0_, roughing_time_);
  add(k0_, finishing_time_);
  if (literal_) {  // Tp <= Tr exp(line(s))
    const Affine mean = roughing_life_ + line.beta * ratio_ + line.alpha;
    add(tool_, roughing_time_ - mean);
    add(tool_, finishing_time_ - mean);
  } else {
    add(tool_, roughing_time_ - roughing_life_);
    add(tool_, finishing_time_ - finishing_life_);
  }
  q.terms = monomials(terms);

  std::vector<Affine> limits = depth_limits(depths_, ln_dr);
  limits.insert(limits.end(), limits_.begin(), limits_.end());
  if (literal_) {
    limits.push_back(ratio_ + -s.hi);
    limits.push_back(-1.0 * ratio_ + s.lo);
  }
  q.limits = monomials(limits);
  q.lower = lower_;
  q.upper = upper_;
  q.lower[kDr] = ln_dr.lo;
  q.upper[kDr] = ln_dr.hi;
  q.lower[kDs] = depths_.finishing(ln_dr.hi);
  q.upper[kDs] = depths_.finishing(ln_dr.lo);
  return q;
}

double Relaxation::tool_share(const Log& y) const {
  const double tr = std::exp(roughing_time_.at(y)), ts = std::exp(finishing_time_.at(y));
  const double Tr = std::exp(roughing_life_.at(y)), Ts = std::exp(finishing_life_.at(y));
  const double tool =
      tool_ * (literal_ ? (tr + ts) / (Tr * std::exp(mean_life_.at(ratio_.at(y))))
                        : tr / Tr + ts / Ts);
  return tool / (fixed_cost_ + k0_ * (tr + ts) + tool);
}

}  // namespace turnwright::multipass
