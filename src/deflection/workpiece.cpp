#include "turnwright/deflection/workpiece.hpp"

#include <algorithm>
#include <cmath>

#include "turnwright/deflection/shoulder.hpp"

namespace turnwright::deflection {
namespace {

/// The side of the tool on which the part is still uncut, for the given direction of
/// feed.
part::Shaft side(const part::Shaft& finished, const Workpiece::Options& options,
                 part::FeedTowards uncut_when) {
  part::Shaft body = finished;
  if (const auto& cut = options.in_process; cut && cut->towards == uncut_when)
    body.segments = part::uncut(finished.segments, cut->ap_mm);
  if (options.shoulder_correction) body.segments = shoulder_corrected(body.segments);
  return body;
}

}  // namespace

Workpiece::Workpiece(const part::Shaft& finished, const Options& options)
    : finished_(finished.segments),
      ends_mm_(part::ends_mm(finished.segments)),
      left_body_(side(finished, options, part::FeedTowards::chuck)),
      right_body_(side(finished, options, part::FeedTowards::tail)),
      left_(left_body_) {
  if (options.in_process) right_ = Beam(right_body_);
}

RestedBeam Workpiece::rested(const Supports& supports, const SteadyRest& rest) const {
  return RestedBeam(left_body_, right_body_, supports, rest);
}

std::size_t Workpiece::segment_at(double a_mm) const {
  const auto end = std::lower_bound(ends_mm_.begin() + 1, ends_mm_.end() - 1, a_mm);
  return static_cast<std::size_t>(end - ends_mm_.begin()) - 1;
}

double Workpiece::diameter_mm(std::size_t segment, double a_mm) const {
  const part::Segment& s = finished_[segment];
  const double u = (a_mm - ends_mm_[segment]) / s.length_mm;
  return std::lerp(s.outer_left_mm, s.outer_right_mm, std::clamp(u, 0.0, 1.0));
}

void Workpiece::at(std::span<const double> a_mm, const Supports& supports,
                   std::span<Flexibility> out) const {
  flexibilities(left_, right_ ? *right_ : left_, a_mm, supports, out);
}

std::vector<std::size_t> thin_walls(std::span<const part::Segment> segments) {
  constexpr double kWallPerRadius = 0.2;
  std::vector<std::size_t> thin;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const part::Segment& s = segments[i];
    if (s.outer_left_mm - s.inner_left_mm < kWallPerRadius * s.outer_left_mm ||
        s.outer_right_mm - s.inner_right_mm < kWallPerRadius * s.outer_right_mm)
      thin.push_back(i);
  }
  return thin;
}

}  // namespace turnwright::deflection
