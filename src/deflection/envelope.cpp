#include "turnwright/deflection/envelope.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::deflection {
namespace {

constexpr std::size_t kPoints = 17;     // every second one belongs to the coarse grid
constexpr double kResolved = 1e-6;      // parts of the largest |e|
constexpr double kBetweenPoints = 1.5;  // above 1/cos(8 pi/(2 16)) = 1.42
constexpr int kDeepest = 30;  // halvings; only a jump inside a segment gets there
constexpr std::size_t kPanels = 10'000;

struct Panel {
  std::size_t segment;
  std::array<double, kPoints> a, e;
};

std::array<double, kPoints> chebyshev(double left, double right) {
  std::array<double, kPoints> a;
  for (std::size_t k = 0; k < kPoints; ++k) {
    const double phase = units::kPi * static_cast<double>(k) / (kPoints - 1);
    a[k] = left + (right - left) * (1 - std::cos(phase)) / 2;
  }
  a.back() = right;
  return a;
}

/// Largest difference between e and the polynomial through every second point
/// (barycentric form; the weights of these points are +-1, halved at the ends).
double unresolved(const Panel& p) {
  double worst = 0;
  for (std::size_t k = 1; k < kPoints; k += 2) {
    double above = 0, below = 0;
    for (std::size_t j = 0; j < kPoints; j += 2) {
      const double end = j == 0 || j + 1 == kPoints ? 0.5 : 1;
      const double w = (j % 4 == 0 ? end : -end) / (p.a[k] - p.a[j]);
      above += w * p.e[j];
      below += w;
    }
    worst = std::max(worst, std::abs(above / below - p.e[k]));
  }
  return worst;
}

double largest(const Panel& p) {
  double largest = 0;
  for (const double e : p.e) largest = std::max(largest, std::abs(e));
  return largest;
}

}  // namespace

Envelope envelope(std::span<const double> ends_mm, const ErrorOnSegment& error) {
  const auto panel = [&](std::size_t segment, double left, double right) {
    Panel p{segment, chebyshev(left, right), {}};
    error(segment, p.a, p.e);
    return p;
  };
  std::vector<Panel> panels;
  double sampled = 0;
  for (std::size_t i = 0; i + 1 < ends_mm.size(); ++i) {
    panels.push_back(panel(i, ends_mm[i], ends_mm[i + 1]));
    sampled = std::max(sampled, largest(panels.back()));
  }
  for (int depth = 0; depth < kDeepest; ++depth) {
    std::vector<Panel> finer;
    bool halved = false;
    for (const Panel& p : panels) {
      if (unresolved(p) <= kResolved * sampled) {
        finer.push_back(p);
        continue;
      }
      const double middle = p.a[kPoints / 2];
      finer.push_back(panel(p.segment, p.a.front(), middle));
      finer.push_back(panel(p.segment, middle, p.a.back()));
      halved = true;
    }
    panels.swap(finer);
    if (!halved) break;
    if (panels.size() > kPanels + ends_mm.size())
      throw ModelRangeError(
          tr("the error changes too quickly along the part for its largest value to be "
             "found"));
    for (const Panel& p : panels) sampled = std::max(sampled, largest(p));
  }

  Envelope best{0, ends_mm.front()};
  const auto offer = [&best](double at, double e) {
    if (std::abs(e) > best.max_mm) best = {std::abs(e), at};
  };
  for (const Panel& p : panels)
    for (std::size_t k = 0; k < kPoints; ++k) offer(p.a[k], p.e[k]);
  const double worth_a_look = best.max_mm / kBetweenPoints;
  for (const Panel& p : panels)
    for (std::size_t k = 0; k < kPoints; ++k) {
      const std::size_t left = k == 0 ? 0 : k - 1, right = std::min(k + 1, kPoints - 1);
      const double peak = std::abs(p.e[k]);
      if (peak < worth_a_look || peak < std::abs(p.e[left]) ||
          peak < std::abs(p.e[right]))
        continue;
      const auto minus_e = [&](double a) {
        double e = 0;
        error(p.segment, {&a, 1}, {&e, 1});
        return -std::abs(e);
      };
      // half the digits of the place give all digits of the value
      constexpr int kBits = 28;
      std::uintmax_t steps = 100;
      const auto [at, value] = boost::math::tools::brent_find_minima(
          minus_e, p.a[left], p.a[right], kBits, steps);
      offer(at, value);
    }
  return best;
}

}  // namespace turnwright::deflection
