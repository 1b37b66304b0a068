#pragma once
#include <span>
#include <vector>

/// The body of revolution that a clamping holds, as a beam sees it.
namespace turnwright::part {

/// One segment; diameters are linear between its ends, inner 0 = solid.
struct Segment {
  double length_mm = 0;
  double outer_left_mm = 0, outer_right_mm = 0;
  double inner_left_mm = 0, inner_right_mm = 0;
};

/// A body of one material; its first segment is at the jaws or the headstock centre.
struct Shaft {
  double E_MPa = 0, nu = 0;
  std::vector<Segment> segments;
};

double length_mm(std::span<const Segment> segments);

/// z [mm] of the ends of the segments, from 0 to the length; one more value than
/// segments.  Compensated (Neumaier) summation makes every z the rounded true sum.
std::vector<double> ends_mm(std::span<const Segment> segments);

/// The two parts into which a plane at the distance `at_mm` from its left end divides a
/// segment.
/// @throws std::domain_error unless 0 < at_mm < length.
struct Halves {
  Segment left, right;
};
Halves split(const Segment& segment, double at_mm);

/// The segments before a cut of depth ap: every outer diameter is larger by 2 ap [mm].
/// @throws std::domain_error if ap is negative or not finite.
std::vector<Segment> uncut(std::span<const Segment> finished, double ap_mm);

enum class FeedTowards { chuck, tail };

/// The shaft while the tool stands at `a_mm` [mm] in a cut of depth `ap_mm`: the finished
/// segments with outer diameters + 2 ap on the uncut side (chuck: z < a, tail: z > a).
/// @throws std::domain_error if a is not in [0, L] or ap is negative or not finite.
std::vector<Segment> in_process(std::span<const Segment> finished, double a_mm,
                                double ap_mm, FeedTowards towards);

}  // namespace turnwright::part
