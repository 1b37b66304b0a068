#include "local_problem.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace turnwright::multipass {
Pass roughing(const Log& y) {
  return {std::exp(y[kVr]), std::exp(y[kFr]), std::exp(y[kDr])};
}

Pass finishing(const Log& y, const Depths& depths) {
  return {std::exp(y[kVs]), std::exp(y[kFs]), depths.dt_mm - depths.n * std::exp(y[kDr])};
}

Log logarithms(const Pass& rough, const Pass& finish) {
  Log y;
  y << std::log(rough.V), std::log(rough.f), std::log(rough.d), std::log(finish.V),
      std::log(finish.f), std::log(finish.d);
  return y;
}

double ln_cost(const Problem& m, const Depths& depths, const Log& y) {
  return std::log(unit_cost(m, depths.n, roughing(y), finishing(y, depths)));
}

LocalProblem::LocalProblem(const Problem& problem, const std::vector<Row>& rows,
                           const Depths& depths)
    : m_(problem), rows_(rows), depths_(depths) {
  problem_.lower.assign(kFree, -kFar);
  problem_.upper.assign(kFree, kFar);
  problem_.upper[kDr] = std::log(depths.dt_mm / depths.n) - 1e-9;  // leaves a ds
  problem_.constraints = rows.size();
  problem_.evaluate = [this](std::span<const double> x, optimise::Values& out) {
    evaluate(x, out);
  };
}

Best LocalProblem::from(const Log& start) const {
  const std::vector<double> x(start.begin(), start.begin() + kFree);
  const auto s = optimise::local_minimum(problem_, x);
  if (s.status == optimise::Status::no_feasible_point_met) return {};
  return {s.f, whole(s.y)};
}

std::vector<double> LocalProblem::multipliers(const Log& y) const {
  const std::vector<double> x(y.begin(), y.begin() + kFree);
  optimise::Values at;
  at.df.resize(kFree);
  at.g.resize(rows_.size());
  at.dg.resize(rows_.size() * kFree);
  evaluate(x, at);
  return optimise::multipliers_at(problem_, x, at);
}

Log LocalProblem::whole(std::span<const double> x) const {
  Log y;
  std::copy(x.begin(), x.end(), y.begin());
  y[kDs] = depths_.finishing(x[kDr]);
  return y;
}

void LocalProblem::evaluate(std::span<const double> x, optimise::Values& out) const {
  const Log y = whole(x);
  const double slope = depths_.slope(x[kDr]);
  const auto reduce = [&](const Log& a, double* to) {
    std::copy(a.begin(), a.begin() + kFree, to);
    to[kDr] += a[kDs] * slope;
  };
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    out.g[i] = rows_[i].g.at(y);
    reduce(rows_[i].g.a, &out.dg[i * kFree]);
  }
  out.f = ln_cost(m_, depths_, y);
  reduce(gradient(y), out.df.data());
}

Log LocalProblem::gradient(const Log& y) const {
  const auto value = [&](const Affine& ln) { return std::exp(ln.at(y)); };
  const Affine tr = roughing_time(m_, depths_.n), ts = finishing_time(m_);
  const Affine Tr = life(m_, kVr), Ts = life(m_, kVs);
  const double tool = m_.k0 * m_.te + m_.kt;
  const Log dt = value(tr) * tr.a + value(ts) * ts.a;
  Log dN;  // (3)
  if (m_.cost == Cost::literal) {
    const double Tp = m_.theta * value(Tr) + (1 - m_.theta) * value(Ts);
    const Log dTp = m_.theta * value(Tr) * Tr.a + (1 - m_.theta) * value(Ts) * Ts.a;
    dN = dt / Tp - (value(tr) + value(ts)) / (Tp * Tp) * dTp;
  } else {
    dN = value(tr - Tr) * (tr - Tr).a + value(ts - Ts) * (ts - Ts).a;
  }
  return (m_.k0 * dt + tool * dN) / std::exp(ln_cost(m_, depths_, y));  // (1)
}

}  // namespace turnwright::multipass
