#pragma once
#include <string>
#include <vector>

#include "section.hpp"
#include "turnwright/planning/prepared_part.hpp"

/// The part while programs cut it, in its own coordinates.
namespace turnwright::review {

class Workpiece {
 public:
  explicit Workpiece(const planning::PreparedPart& part);

  Section section;
  double pitch_mm = 0;  ///< of the section's lines

  /// The surfaces that a setup makes, as drawn, where nothing is known of its cuts.
  void make_as_drawn(std::size_t setup);

  /// The element next to a place along the axis; empty if the part has no inner ones.
  std::string element_at(double z_mm, bool inner) const;
  /// The face next to a place: an end, the shoulder between two elements, or one between two
  /// bores that is faced; of none within `within_mm` the element there.
  std::string face_at(double z_mm, double within_mm, bool inner) const;

  /// The surface radius on a column, the bore's for an inner one; nothing without material.
  std::optional<double> surface_mm(std::size_t column, bool inner) const;

 private:
  struct Wall {
    std::string id;
    double z_mm;
  };

  const planning::PreparedPart& part_;
  std::vector<double> outer_left_mm_, inner_left_mm_;  // of each element
  std::vector<Wall> faced_walls_;                      // shoulders between bores
};

}  // namespace turnwright::review
