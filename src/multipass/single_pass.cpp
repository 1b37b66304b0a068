#include "turnwright/multipass/single_pass.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "rows.hpp"
#include "turnwright/optimise/posynomial.hpp"

namespace turnwright::multipass {
namespace {

void check(const SinglePass& m) {
  const auto positive = [](double x) { return x > 0 && std::isfinite(x); };
  const auto law = [&](const PowerLaw& x) {
    return positive(x.c) && std::isfinite(x.V) && std::isfinite(x.f);
  };
  const auto range = [&](const Range& r) {
    return positive(r.lower) && r.lower <= r.upper && std::isfinite(r.upper);
  };
  const auto limit = [&](const PowerLimit& l) { return law(l.law) && positive(l.limit); };
  if (!(range(m.V) && range(m.f) && !m.cost.empty() && std::ranges::all_of(m.cost, law) &&
        std::ranges::all_of(m.limits, limit)))
    throw std::domain_error("multipass::optimum: single pass out of range");
}

std::vector<PowerLimit> all_limits(const SinglePass& m) {
  std::vector<PowerLimit> all{{"V_min", {1, 1, 0}, m.V.lower, false},
                              {"V_max", {1, 1, 0}, m.V.upper, true},
                              {"f_min", {1, 0, 1}, m.f.lower, false},
                              {"f_max", {1, 0, 1}, m.f.upper, true}};
  all.insert(all.end(), m.limits.begin(), m.limits.end());
  return all;
}

double sign(const PowerLimit& l) { return l.upper ? 1 : -1; }

optimise::PosynomialOptimum solved(const std::vector<PowerLaw>& cost,
                                   const std::vector<PowerLimit>& limits) {
  const auto k = static_cast<Eigen::Index>(cost.size());
  const auto m = static_cast<Eigen::Index>(limits.size());
  optimise::Posynomial q{.terms = {Eigen::MatrixXd(k, 2), Eigen::VectorXd(k)},
                         .limits = {Eigen::MatrixXd(m, 2), Eigen::VectorXd(m)},
                         .lower = Eigen::Vector2d::Constant(-kFar),
                         .upper = Eigen::Vector2d::Constant(kFar)};
  for (Eigen::Index i = 0; i < k; ++i) {
    const PowerLaw& x = cost[static_cast<std::size_t>(i)];
    q.terms.a.row(i) << x.V, x.f;
    q.terms.c[i] = std::log(x.c);
  }
  for (Eigen::Index i = 0; i < m; ++i) {
    const PowerLimit& l = limits[static_cast<std::size_t>(i)];
    q.limits.a.row(i) << sign(l) * l.law.V, sign(l) * l.law.f;
    q.limits.c[i] = sign(l) * std::log(l.law.c / l.limit);
  }
  return optimise::minimise(q);
}

bool possible(const std::vector<PowerLimit>& limits) {
  return solved({{1, 0, 0}}, limits).violation <= kFeasibility;
}

}  // namespace

SinglePassAnswer optimum(const SinglePass& m) {
  check(m);
  SinglePassAnswer answer;
  std::vector<PowerLimit> limits = all_limits(m);
  if (!possible(limits)) {
    for (const PowerLimit& l : std::vector<PowerLimit>(limits)) {
      auto rest = limits;
      std::erase_if(rest, [&](const PowerLimit& x) { return x.name == l.name; });
      if (!possible(rest)) limits = std::move(rest);
    }
    for (const PowerLimit& l : limits) answer.conflict.push_back(l.name);
    return answer;
  }
  const auto best = solved(m.cost, limits);
  answer.V = std::exp(best.y[0]);
  answer.f = std::exp(best.y[1]);
  answer.UC = std::exp(best.f);
  answer.lower_bound = std::min(*answer.UC, std::exp(best.lower_bound));
  answer.gap = (*answer.UC - answer.lower_bound) / *answer.UC;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const PowerLimit& l = limits[i];
    const double value =
        l.law.c * std::pow(answer.V, l.law.V) * std::pow(answer.f, l.law.f);
    const double margin = sign(l) * std::log(l.limit / value);
    const bool binding = margin < kBinding;
    answer.limits.push_back(
        {l.name, value, l.limit, margin, binding,
         binding ? -sign(l) * best.multipliers[static_cast<Eigen::Index>(i)] : 0});
  }
  return answer;
}

}  // namespace turnwright::multipass
