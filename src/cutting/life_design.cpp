#include "life_design.hpp"

#include <cmath>
#include <stdexcept>

namespace turnwright::cutting {
namespace {

double logarithm(double x) {
  if (!(x > 0 && std::isfinite(x)))
    throw std::domain_error("life_fit: a measurement is not positive");
  return std::log(x);
}

}  // namespace

LifeRows::LifeRows(std::span<const LifePoint> lives) {
  const auto n = static_cast<Eigen::Index>(lives.size());
  v.resize(n), f.resize(n), d.resize(n), y.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const LifePoint& p = lives[static_cast<std::size_t>(i)];
    v[i] = logarithm(p.vc_m_min);
    f[i] = logarithm(p.f_mm_rev);
    d[i] = logarithm(p.ap_mm);
    y[i] = logarithm(p.T_min);
    longer.push_back(p.longer);
    lab.push_back(p.lab);
  }
}

LifeRows LifeRows::rows(const std::vector<std::size_t>& which) const {
  LifeRows some(std::span<const LifePoint>{});
  some.v = v(which), some.f = f(which), some.d = d(which), some.y = y(which);
  for (const std::size_t i : which) {
    some.longer.push_back(longer[i]);
    some.lab.push_back(lab[i]);
  }
  return some;
}

std::vector<std::size_t> LifeRows::ended() const {
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < longer.size(); ++i)
    if (!longer[i]) which.push_back(i);
  return which;
}

Eigen::MatrixXd life_columns(const LifeRows& rows, bool with_a, bool with_b,
                             double given_a, double given_b) {
  Eigen::MatrixXd X(rows.size(), 1 + with_a + with_b);
  X.col(0) = rows.v;
  if (with_a)
    X.col(1) = rows.f;
  else
    X.col(0) += given_a * rows.f;
  if (with_b)
    X.col(1 + with_a) = rows.d;
  else
    X.col(0) += given_b * rows.d;
  return X;
}

}  // namespace turnwright::cutting
