#include "turnwright/deflection/shoulder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace turnwright::deflection {
namespace {

struct Extension {
  double from_mm, to_mm;
  double outer_mm, inner_mm;
};

/// Length over which the outer surface continues from the left end of `segments[first]`
/// without a step and above d.
double thick_length(std::span<const part::Segment> segments, std::size_t first,
                    double d) {
  double length = 0;
  for (std::size_t j = first; j < segments.size(); ++j) {
    const part::Segment& s = segments[j];
    if (j > first && s.outer_left_mm != segments[j - 1].outer_right_mm) break;
    if (s.outer_right_mm <= d)
      return length +
             s.length_mm * (s.outer_left_mm - d) / (s.outer_left_mm - s.outer_right_mm);
    length += s.length_mm;
  }
  return length;
}

/// Extensions into the thick section on the right of a step; the mirror gives the others.
std::vector<Extension> to_the_right(std::span<const part::Segment> segments) {
  const std::vector<double> z = part::ends_mm(segments);
  std::vector<Extension> all;
  for (std::size_t i = 1; i < segments.size(); ++i) {
    const double d = segments[i - 1].outer_right_mm, D = segments[i].outer_left_mm;
    if (d < D)
      all.push_back(
          {z[i],
           z[i] + std::min(shoulder_lambda(d / D) * d, thick_length(segments, i, d)), d,
           segments[i - 1].inner_right_mm});
  }
  return all;
}

part::Segment mirrored(const part::Segment& s) {
  return {s.length_mm, s.outer_right_mm, s.outer_left_mm, s.inner_right_mm,
          s.inner_left_mm};
}

part::Segment slice(const part::Segment& s, double x0, double x1) {
  const double u0 = x0 / s.length_mm, u1 = x1 / s.length_mm;
  return {x1 - x0, std::lerp(s.outer_left_mm, s.outer_right_mm, u0),
          std::lerp(s.outer_left_mm, s.outer_right_mm, u1),
          std::lerp(s.inner_left_mm, s.inner_right_mm, u0),
          std::lerp(s.inner_left_mm, s.inner_right_mm, u1)};
}

}  // namespace

double shoulder_lambda(double d_over_D) {
  if (!(d_over_D > 0 && d_over_D <= 1))
    throw std::domain_error("shoulder_lambda: d/D must be in (0, 1]");
  constexpr std::array<std::array<double, 2>, 6> kTable = {{{0.3, 0.205},
                                                            {0.4, 0.19},
                                                            {0.5, 0.17},
                                                            {0.6, 0.145},
                                                            {0.7, 0.105},
                                                            {0.85, 0.035}}};
  if (d_over_D == 1) return 0;
  if (d_over_D <= kTable.front()[0]) return kTable.front()[1];
  if (d_over_D >= kTable.back()[0]) return kTable.back()[1];
  std::size_t k = 0;
  while (d_over_D > kTable[k + 1][0]) ++k;
  const auto [x0, y0] = kTable[k];
  const auto [x1, y1] = kTable[k + 1];
  return y0 + (y1 - y0) * (d_over_D - x0) / (x1 - x0);
}

std::vector<part::Segment> shoulder_corrected(std::span<const part::Segment> segments) {
  const std::vector<double> z = part::ends_mm(segments);
  const double L = z.back();
  std::vector<Extension> extensions = to_the_right(segments);
  std::vector<part::Segment> image;
  for (auto s = segments.rbegin(); s != segments.rend(); ++s)
    image.push_back(mirrored(*s));
  for (const Extension& e : to_the_right(image))
    extensions.push_back({L - e.to_mm, L - e.from_mm, e.outer_mm, e.inner_mm});
  std::sort(extensions.begin(), extensions.end(),
            [](const auto& x, const auto& y) { return x.from_mm < y.from_mm; });

  std::vector<double> cuts = z;
  for (const Extension& e : extensions) cuts.insert(cuts.end(), {e.from_mm, e.to_mm});
  std::sort(cuts.begin(), cuts.end());
  // z and L - (L - z) differ by rounding: segments below 1e-12 L are left out
  const auto same = [L](double x, double y) { return y - x <= 1e-12 * L; };
  cuts.erase(std::unique(cuts.begin(), cuts.end(), same), cuts.end());

  std::vector<part::Segment> out;
  std::vector<Extension> active;
  std::size_t next = 0, i = 0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const double x0 = cuts[k], x1 = cuts[k + 1], middle = x0 + (x1 - x0) / 2;
    while (z[i + 1] < middle) ++i;
    while (next < extensions.size() && extensions[next].from_mm < middle)
      active.push_back(extensions[next++]);
    std::erase_if(active, [&](const Extension& e) { return e.to_mm < middle; });
    if (active.empty()) {
      out.push_back(slice(segments[i], std::max(0.0, x0 - z[i]),
                          std::min(x1 - z[i], segments[i].length_mm)));
      continue;
    }
    const auto e = std::min_element(
        active.begin(), active.end(),
        [](const auto& x, const auto& y) { return x.outer_mm < y.outer_mm; });
    out.push_back({x1 - x0, e->outer_mm, e->outer_mm, e->inner_mm, e->inner_mm});
  }
  return out;
}

}  // namespace turnwright::deflection
