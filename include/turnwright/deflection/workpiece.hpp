#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "turnwright/deflection/beam.hpp"
#include "turnwright/deflection/rest.hpp"

namespace turnwright::deflection {

/// A pass in progress: the length that it has not reached yet is thicker by 2 ap.
struct Cut {
  double ap_mm = 0;
  part::FeedTowards towards = part::FeedTowards::chuck;
};

/// The part as the tool meets it: finished, or in the middle of a cut, and with or
/// without the shoulder correction.
class Workpiece {
 public:
  struct Options {
    std::optional<Cut> in_process = std::nullopt;
    bool shoulder_correction = false;
  };

  /// @throws std::domain_error as Beam and part::uncut.
  explicit Workpiece(const part::Shaft& finished) : Workpiece(finished, Options{}) {}
  Workpiece(const part::Shaft& finished, const Options& options);

  double length_mm() const noexcept { return ends_mm_.back(); }
  std::size_t segments() const noexcept { return finished_.size(); }
  /// z of the ends of the segments, one more than segments.
  std::span<const double> ends_mm() const noexcept { return ends_mm_; }

  /// The segment of a position; at a step it is the left one.
  std::size_t segment_at(double a_mm) const;
  /// Finished diameter of a segment at a position within it [mm].
  double diameter_mm(std::size_t segment, double a_mm) const;

  /// As Beam::at, in O(1) per position also for a part in the middle of a cut.
  void at(std::span<const double> a_mm, const Supports& supports,
          std::span<Flexibility> out) const;

  /// The part with a steady rest in this plane.
  RestedBeam rested(const Supports& supports, const SteadyRest& rest) const;

 private:
  std::vector<part::Segment> finished_;
  std::vector<double> ends_mm_;
  part::Shaft left_body_, right_body_;  // shapes on either side of the tool, as beams
  Beam left_;
  std::optional<Beam> right_;  // only where it differs from left_
};

/// Segments whose wall is thinner than a fifth of the outer radius at either end.  They
/// become oval, and the beam model does not apply.
std::vector<std::size_t> thin_walls(std::span<const part::Segment> segments);

}  // namespace turnwright::deflection
