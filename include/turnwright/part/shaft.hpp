#pragma once
#include <span>
#include <vector>

/// The bare body of revolution that a clamping holds.
namespace turnwright::part {

/// One segment; diameters are linear between its ends, inner 0 = solid.
struct Segment {
  double length_mm = 0;
  double outer_left_mm = 0, outer_right_mm = 0;
  double inner_left_mm = 0, inner_right_mm = 0;
};

/// Body of a material; the first segment is at the jaws or the headstock centre.
struct Shaft {
  double E_MPa = 0, nu = 0;
  std::vector<Segment> segments;
};

double length_mm(std::span<const Segment> segments);

/// z [mm] of the ends of the segments: 0 first, the length last, one more than segments.
/// Summed with compensation (Neumaier), so every z is the rounded true sum.
std::vector<double> ends_mm(std::span<const Segment> segments);

/// Two shafts' worth of one segment: what lies left and right of a cut at distance
/// `at_mm` from its left end.
/// @throws std::domain_error unless 0 < at_mm < length.
struct Halves {
  Segment left, right;
};
Halves split(const Segment& segment, double at_mm);

/// The segments with every outer diameter larger by 2 ap [mm]: not yet cut.
/// @throws std::domain_error if ap is negative or not finite.
std::vector<Segment> uncut(std::span<const Segment> finished, double ap_mm);

enum class FeedTowards { chuck, tail };

/// The shaft while the tool stands at `a_mm` [mm] in a cut of depth `ap_mm`: the finished
/// segments with outer diameters + 2 ap on the uncut side (chuck: z < a, tail: z > a).
/// @throws std::domain_error if a is not in [0, L] or ap is negative or not finite.
std::vector<Segment> in_process(std::span<const Segment> finished, double a_mm,
                                double ap_mm, FeedTowards towards);

}  // namespace turnwright::part
