#include "turnwright/cutting/life_scatter.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "censored_line.hpp"
#include "life_design.hpp"
#include "turnwright/base/distributions.hpp"
#include "turnwright/base/dual.hpp"

namespace turnwright::cutting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Quantile of z in (1) that the share `reached` of the edges exceeds.
double z_reached(double reached, LifeDistribution distribution) {
  return distribution == LifeDistribution::weibull ? std::log(-std::log(reached))
                                                   : normal_quantile(1 - reached);
}

// Life that the share `reached` of the edges exceeds at x.
Estimate life_reached(const CensoredLine& l, LifeDistribution distribution,
                      const VectorXd& x, double reached, double confidence) {
  const double z = z_reached(reached, distribution),
               ln_T = x.dot(l.line.c) + z * l.line.s;
  VectorXd slope(x.size() + 1);
  slope << x, z * l.line.s;
  const double half =
      student(confidence, l.line.degrees) * std::sqrt(slope.dot(l.joint * slope));
  return exponential({ln_T, ln_T - half, ln_T + half});
}

// Rows of each condition that lives repeat, by its first row.
std::vector<std::vector<std::size_t>> repeats(const LifeRows& rows) {
  constexpr std::size_t kConditions = 100;
  constexpr double kSame = 1e-6;  // relative
  const auto key = [&](std::size_t i) {
    const auto k = static_cast<Index>(i);
    const auto cell = [](double ln) { return std::llround(ln / kSame); };
    return std::tuple(rows.lab[i], cell(rows.v[k]), cell(rows.f[k]), cell(rows.d[k]));
  };
  std::map<decltype(key(0)), std::vector<std::size_t>> all;
  for (std::size_t i = 0; i < rows.lab.size(); ++i) all[key(i)].push_back(i);
  std::vector<std::vector<std::size_t>> some;
  for (const auto& [at, which] : all)
    if (which.size() > 1 &&
        std::ranges::any_of(which, [&](std::size_t i) { return !rows.longer[i]; }))
      some.push_back(which);
  std::ranges::sort(some);
  if (some.size() > kConditions) some.resize(kConditions);
  return some;
}

// The mean of each repeated condition in place of the law; none if no condition has two
// lives that ended.
struct Repeated {
  Line line;
  std::size_t ended = 0, conditions = 0;
};
std::optional<Repeated> repeated(const LifeRows& rows) {
  const auto groups = repeats(rows);
  std::vector<std::size_t> which, group;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const std::size_t i : groups[g]) {
      which.push_back(i);
      group.push_back(g);
    }
  const LifeRows some = rows.rows(which);
  const auto ended = some.ended().size();
  if (ended <= groups.size()) return std::nullopt;
  const MatrixXd X = lab_columns(group).X;
  return Repeated{censored_line(X, some.y, some.longer, LifeErrors::normal).line, ended,
                  groups.size()};
}

// Eq. (2).
void lack_of_fit(const Repeated& r, const Line& law, LifeScatter& out) {
  const double nu = law.degrees, nu_e = r.line.degrees;
  if (!(nu > nu_e)) return;
  const double pure = sqr(r.line.s);
  const double MS = std::max(0.0, (nu * sqr(law.s) - nu_e * pure) / (nu - nu_e));
  const double each = static_cast<double>(r.ended) / static_cast<double>(r.conditions);
  out.s_lack_of_fit = std::sqrt(std::max(0.0, MS - pure) / each);
  out.lack_of_fit_p = fisher_exceeds(MS / pure, nu - nu_e, nu_e);
}

void between_edges(const LifeRows& rows, const Line& law, double confidence,
                   LifeScatter& out) {
  const auto r = repeated(rows);
  if (!r) return;
  const auto end = [&](double p) {
    return r->line.s *
           std::sqrt(r->line.degrees / chi_squared_quantile(p, r->line.degrees));
  };
  out.s_between =
      Estimate{r->line.s, end((1 + confidence) / 2), end((1 - confidence) / 2)};
  lack_of_fit(*r, law, out);
}

}  // namespace

LifeScatter scatter_of_lives(std::span<const LifePoint> lives, const TaylorFit& fit,
                             double given_a, double given_b, const FitOptions& options) {
  const LifeRows rows = LifeRows(lives).rows(fit.evidence.used);
  const MatrixXd columns =
      life_columns(rows, fit.a.has_value(), fit.b.has_value(), given_a, given_b);
  const MatrixXd labs = lab_columns(rows.lab).X;
  MatrixXd X(rows.size(), labs.cols() + columns.cols());
  X << labs, columns;
  const CensoredLine normal = censored_line(X, rows.y, rows.longer, LifeErrors::normal),
                     weibull = censored_line(X, rows.y, rows.longer, LifeErrors::weibull);
  LifeScatter out;
  out.ln_likelihood_ratio = normal.ln_likelihood - weibull.ln_likelihood;
  out.weibull_shape = 1 / weibull.s_likely;
  const bool is_weibull = out.ln_likelihood_ratio < 0;
  if (is_weibull) out.distribution = LifeDistribution::weibull;
  const auto& likelier = is_weibull ? weibull : normal;
  const VectorXd x = X.colwise().mean();
  const auto life = [&](double reached) {
    return life_reached(likelier, out.distribution, x, reached, options.confidence);
  };
  out.T50_min = life(0.5);
  out.T90_min = life(0.9);
  out.vc_m_min = std::exp(rows.v.mean());
  out.f_mm_rev = std::exp(rows.f.mean());
  out.ap_mm = std::exp(rows.d.mean());
  between_edges(rows, normal.line, options.confidence, out);
  return out;
}

}  // namespace turnwright::cutting
