#include "rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace turnwright::multipass {
namespace {

// Least depth of a pass as a share of dt/n where no limit gives one, because the search
// for conflicts omits limits.
constexpr double kLeastShare = 1e-3;

Affine monomial(Variable first, double factor, double V, double f, double d) {
  Affine x;
  x.a[first] = V;
  x.a[first + 1] = f;
  x.a[first + 2] = d;
  x.c = std::log(factor);
  return x;
}

class Table {
 public:
  std::vector<Row> rows;

  void at_most(std::string name, const Affine& value, double limit) {
    rows.push_back({std::move(name), value + -std::log(limit), limit, true});
  }
  void at_least(std::string name, const Affine& value, double limit) {
    if (limit > 0)
      rows.push_back({std::move(name), -1.0 * value + std::log(limit), limit, false});
  }
  void within(const std::string& name, const Affine& value, const Range& range) {
    at_least(name + "_min", value, range.lower);
    at_most(name + "_max", value, range.upper);
  }
};

}  // namespace

Affine operator+(Affine x, const Affine& y) {
  x.a += y.a;
  x.c += y.c;
  return x;
}
Affine operator*(double s, Affine x) {
  x.a *= s;
  x.c *= s;
  return x;
}
Affine operator-(const Affine& x, const Affine& y) { return x + -1.0 * y; }
Affine operator+(Affine x, double ln_factor) {
  x.c += ln_factor;
  return x;
}

Affine life(const Problem& m, Variable first) {
  return monomial(first, m.C0, -m.p, -m.q, -m.r);  // (4)
}

Affine roughing_time(const Problem& m, int n) {
  return finishing_time(m) + std::log(n) + monomial(kVs, 1, 1, 1, 0) -
         monomial(kVr, 1, 1, 1, 0);
}

Affine finishing_time(const Problem& m) {
  return monomial(kVs, std::numbers::pi * m.D_mm * m.L_mm / 1000, -1, -1, 0);  // (2)
}

std::vector<Row> rows(const Problem& m) {
  Table t;
  for (const Variable x : {kVr, kVs}) {
    const std::string pass = x == kVr ? "rough:" : "finish:";
    const Affine force = monomial(x, m.kf, 0, m.mu, m.nu);
    t.within(pass + "V", monomial(x, 1, 1, 0, 0), m.V);
    t.within(pass + "f", monomial(x, 1, 0, 1, 0), m.f);
    t.within(pass + "d", monomial(x, 1, 0, 0, 1), m.d);
    t.within(pass + "T", life(m, x), m.T);
    t.at_most(pass + "FU", force, m.FU);  // (5)
    t.at_most(pass + "PU", force + monomial(x, 1 / (6120 * m.eta), 1, 0, 0), m.PU);
    t.at_least(pass + "SC", monomial(x, 1, m.lambda, 1, m.nu2), m.SC);  // (6)
    t.at_most(pass + "QU", monomial(x, m.kq, m.tau, m.phi, m.delta), m.QU);
  }
  if (m.VrU) t.at_most("rough:VrU", monomial(kVr, 1, 1, 0, 0), *m.VrU);
  t.at_most("finish:SRu_um", monomial(kVs, 1000 / (8 * m.R_mm), 0, 2, 0),
            m.SRu_um);  // (7)
  const auto ratio = [](Variable a, Variable b) {
    Affine x;
    x.a[a] = 1;
    x.a[b] = -1;
    return x;
  };
  t.at_least("k3", ratio(kVs, kVr), m.k3);  // (8)
  t.at_least("k4", ratio(kFr, kFs), m.k4);
  t.at_least("k5", ratio(kDr, kDs), m.k5);
  return t.rows;
}

double Depths::finishing(double ln_dr) const {
  return std::log(dt_mm - n * std::exp(ln_dr));
}

double Depths::slope(double ln_dr) const {
  const double all = n * std::exp(ln_dr);
  return -all / (dt_mm - all);
}

std::optional<Interval> roughing_depths(const std::vector<Row>& rows,
                                        const Depths& depths) {
  const double dt = depths.dt_mm, most = dt / depths.n;
  double lo = 0, hi = most;
  for (const Row& row : rows) {
    Log rest = row.g.a;
    const double r = rest[kDr], s = rest[kDs];
    rest[kDr] = rest[kDs] = 0;
    if (!rest.isZero() || (r == 0 && s == 0)) continue;
    if (r != 0 && s != 0) {  // dr >= k5 ds
      const double k5 = std::exp(row.g.c);
      lo = std::max(lo, k5 * dt / (1 + depths.n * k5));
      continue;
    }
    const double limit = std::exp(-row.g.c / (r + s));
    const double roughing = r != 0 ? limit : (dt - limit) / depths.n;
    if ((r > 0) || (s < 0))
      hi = std::min(hi, roughing);
    else
      lo = std::max(lo, roughing);
  }
  if (!(hi > 0 && lo <= hi * (1 + kFeasibility))) return std::nullopt;
  if (!(lo > 0)) lo = kLeastShare * most;
  if (!(hi < most)) hi = (1 - kLeastShare) * most;
  lo = std::min(lo, hi);
  return Interval(std::log(lo), std::log(hi));
}

}  // namespace turnwright::multipass
