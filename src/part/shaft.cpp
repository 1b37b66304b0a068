#include "turnwright/part/shaft.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace turnwright::part {

std::vector<double> ends_mm(std::span<const Segment> segments) {
  std::vector<double> z{0.0};
  z.reserve(segments.size() + 1);
  double sum = 0, lost = 0;
  for (const Segment& s : segments) {
    const double next = sum + s.length_mm;
    lost += std::abs(sum) >= std::abs(s.length_mm) ? (sum - next) + s.length_mm
                                                   : (s.length_mm - next) + sum;
    sum = next;
    z.push_back(sum + lost);
  }
  return z;
}

double length_mm(std::span<const Segment> segments) { return ends_mm(segments).back(); }

Halves split(const Segment& segment, double at_mm) {
  if (!(at_mm > 0 && at_mm < segment.length_mm))
    throw std::domain_error("split: the cut must lie inside the segment");
  const double u = at_mm / segment.length_mm;
  Halves halves{segment, segment};
  halves.left.length_mm = at_mm;
  halves.right.length_mm = segment.length_mm - at_mm;
  halves.left.outer_right_mm = halves.right.outer_left_mm =
      std::lerp(segment.outer_left_mm, segment.outer_right_mm, u);
  halves.left.inner_right_mm = halves.right.inner_left_mm =
      std::lerp(segment.inner_left_mm, segment.inner_right_mm, u);
  return halves;
}

std::vector<Segment> uncut(std::span<const Segment> finished, double ap_mm) {
  if (!(ap_mm >= 0 && std::isfinite(ap_mm)))
    throw std::domain_error("uncut: ap must be >= 0 mm");
  std::vector<Segment> segments(finished.begin(), finished.end());
  for (Segment& s : segments) {
    s.outer_left_mm += 2 * ap_mm;
    s.outer_right_mm += 2 * ap_mm;
  }
  return segments;
}

std::vector<Segment> in_process(std::span<const Segment> finished, double a_mm,
                                double ap_mm, FeedTowards towards) {
  const std::vector<double> z = ends_mm(finished);
  if (!(a_mm >= 0 && a_mm <= z.back()))
    throw std::domain_error("in_process: the tool must stand on the shaft");
  const std::vector<Segment> thick = uncut(finished, ap_mm);
  const std::span<const Segment> left = towards == FeedTowards::chuck ? thick : finished;
  const std::span<const Segment> right = towards == FeedTowards::chuck ? finished : thick;
  std::vector<Segment> segments;
  segments.reserve(finished.size() + 1);
  for (std::size_t i = 0; i < finished.size(); ++i) {
    if (z[i + 1] <= a_mm) {
      segments.push_back(left[i]);
    } else if (z[i] >= a_mm) {
      segments.push_back(right[i]);
    } else {
      segments.push_back(split(left[i], a_mm - z[i]).left);
      segments.push_back(split(right[i], a_mm - z[i]).right);
    }
  }
  return segments;
}

}  // namespace turnwright::part
