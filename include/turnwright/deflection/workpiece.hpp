#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "turnwright/deflection/beam.hpp"
#include "turnwright/deflection/rest.hpp"

namespace turnwright::deflection {

/// A pass under way: what it has not reached yet is thicker by 2 ap.
struct Cut {
  double ap_mm = 0;
  part::FeedTowards towards = part::FeedTowards::chuck;
};

/// How the part is seen by the tool: its own shape, the shape while being cut, and the
/// stiffness that shoulders leave.
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

  /// The segment of a position; a step belongs to its left one.
  std::size_t segment_at(double a_mm) const;
  /// Finished diameter of a segment at a position within it [mm].
  double diameter_mm(std::size_t segment, double a_mm) const;

  /// As Beam::at, O(1) per position also while the part is being cut.
  void at(std::span<const double> a_mm, const Supports& supports,
          std::span<Flexibility> out) const;

  /// The same with a steady rest in this plane.
  RestedBeam rested(const Supports& supports, const SteadyRest& rest) const;

 private:
  std::vector<part::Segment> finished_;
  std::vector<double> ends_mm_;
  part::Shaft left_body_, right_body_;  // of the tool, as stiff as they are
  Beam left_;
  std::optional<Beam> right_;  // where it is another body than left_
};

/// Segments whose wall is thinner than a fifth of the outer radius at either end: they
/// ovalise, and the beam model is void.
std::vector<std::size_t> thin_walls(std::span<const part::Segment> segments);

}  // namespace turnwright::deflection
