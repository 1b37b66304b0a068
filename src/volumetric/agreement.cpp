#include "turnwright/volumetric/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/distributions.hpp"

namespace turnwright::volumetric {
namespace {

double mean(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
}

double power_of_two_near(double x) { return x > 0 ? std::exp2(std::ilogb(x)) : 1; }

/// Two-sided probability of a value of at least |t|.
double two_sided(double t, double dof) { return 2 * student_exceeds(std::abs(t), dof); }

std::optional<Correlation> correlation(const Runs& a, const Runs& b) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < std::min(a.value.size(), b.value.size()); ++i)
    if (a.value[i] && b.value[i]) {
      x.push_back(*a.value[i]);
      y.push_back(*b.value[i]);
    }
  const std::size_t n = x.size();
  if (n < 3) return std::nullopt;
  const Summary sa = summary(x), sb = summary(y);
  if (!(sa.sd > 0) || !(sb.sd > 0)) return std::nullopt;
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += (x[i] - sa.mean) * (y[i] - sb.mean);
  const auto count = static_cast<double>(n);
  Correlation c;
  c.r = std::clamp(sum / ((count - 1) * sa.sd * sb.sd), -1.0, 1.0);
  const double rest = 1 - c.r * c.r;
  if (!(rest > 0)) {
    c.p = 0;
    return c;
  }
  c.p = two_sided(c.r * std::sqrt((count - 2) / rest), count - 2);
  if (n >= 4) {
    constexpr double kNormal95 = 1.959963984540054;
    const double half = kNormal95 / std::sqrt(count - 3);
    c.lower = std::tanh(std::atanh(c.r) - half);
    c.upper = std::tanh(std::atanh(c.r) + half);
  }
  return c;
}

/// Distance of a run from the others, if it is a jump.
std::optional<double> jump(const Runs& runs, std::size_t run) {
  if (run >= runs.value.size() || !runs.value[run]) return std::nullopt;
  const std::vector<double> others = values(without_run(runs, run));
  if (others.size() < 2) return std::nullopt;
  const Summary s = summary(others);
  const double distance = *runs.value[run] - s.mean;
  if (!(std::abs(distance) > kJump * s.sd)) return std::nullopt;
  return distance;
}

}  // namespace

std::vector<double> values(const Runs& runs) {
  std::vector<double> out;
  for (const auto& value : runs.value)
    if (value) out.push_back(*value);
  return out;
}

Summary summary(const std::vector<double>& values) {
  if (values.size() < 2) throw std::domain_error("summary: at least two runs");
  if (const auto [low, high] = std::ranges::minmax(values); low == high)
    return {.mean = low, .sd = 0};
  Summary s{.mean = mean(values), .sd = 0};
  double square = 0;
  for (const double v : values) square += (v - s.mean) * (v - s.mean);
  s.sd = std::sqrt(square / static_cast<double>(values.size() - 1));
  return s;
}

Agreement agreement(const Runs& a, const Runs& b) {
  const std::vector<double> in_a = values(a), in_b = values(b);
  Agreement out{.name = a.name,
                .a = summary(in_a),
                .b = summary(in_b),
                .difference = 0,
                .overlap = false,
                .t = {},
                .dof = {},
                .p = {},
                .correlation = correlation(a, b)};
  out.difference = out.a.mean - out.b.mean;
  out.overlap = std::abs(out.difference) <= out.a.sd + out.b.sd;
  const auto na = static_cast<double>(in_a.size()), nb = static_cast<double>(in_b.size());
  // In units of a power of two near the larger deviation, so that no square of a variance
  // is too small to be a number.
  const double unit = power_of_two_near(std::max(out.a.sd, out.b.sd)),
               sa = out.a.sd / unit, sb = out.b.sd / unit;
  const double va = sa * sa / na, vb = sb * sb / nb;
  if (va + vb > 0) {  // Welch and Satterthwaite
    out.t = out.difference / unit / std::sqrt(va + vb);
    out.dof = (va + vb) * (va + vb) / (va * va / (na - 1) + vb * vb / (nb - 1));
    out.p = two_sided(*out.t, *out.dof);
  }
  return out;
}

std::vector<CommonJump> common_jumps(const std::vector<Runs>& group) {
  std::size_t runs = 0;
  for (const Runs& r : group) runs = std::max(runs, r.value.size());
  std::vector<CommonJump> out;
  for (std::size_t run = 0; run < runs; ++run) {
    leave_if_asked();
    for (const double sense : {1.0, -1.0}) {
      CommonJump common{.run = run, .parameters = {}, .jump = {}};
      for (const Runs& r : group) {
        const auto distance = jump(r, run);
        if (!distance || *distance * sense <= 0) continue;
        common.parameters.push_back(r.name);
        common.jump.push_back(*distance);
      }
      if (common.jump.size() < 2 || 2 * common.jump.size() < group.size()) continue;
      const auto [low, high] = std::ranges::minmax(common.jump);
      if (high - low < std::abs(mean(common.jump)) / 2) out.push_back(std::move(common));
    }
  }
  return out;
}

Runs without_run(const Runs& runs, std::size_t run) {
  Runs out = runs;
  if (run < out.value.size()) out.value[run].reset();
  return out;
}

}  // namespace turnwright::volumetric
