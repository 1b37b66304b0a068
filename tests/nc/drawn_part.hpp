#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "review/cut/section.hpp"
#include "sizes.hpp"

/// The half section that a plan's programs have to make of its stock: the drawing with
/// the middle of its limits and the plan's corrections.
namespace turnwright::nc::test {

using namespace review;

/// Straight pieces, to measure distances from.
class Pieces {
 public:
  struct Piece {
    Spot a, b;
    std::size_t of = 0;  ///< what it belongs to
  };
  void add(const Piece& piece);
  struct Nearest {
    double mm = 0;
    std::size_t of = 0;
  };
  /// Of no pieces infinite.
  Nearest nearest(const Spot& p) const;

 private:
  std::vector<Piece> all_;
  std::map<long, std::vector<std::size_t>> near_;  // by their places along the axis
};

/// A face across the axis.
struct Wall {
  std::string name;
  double z = 0, low_x = 0, high_x = 0;
  bool material_right = true;  ///< the material is at larger z
  /// Range of radii clear of the fillet at its foot.
  double from_x = 0, to_x = 0;
};

class DrawnPart {
 public:
  explicit DrawnPart(const Planned& p);

  /// What has to remain: threads to their root, chamfers that threads run into too.
  const Polygon& least() const { return least_.polygon; }
  /// What may remain, fillets apart: threads are their blanks.
  const Polygon& full() const { return full_.polygon; }
  const std::vector<Wall>& walls() const { return walls_; }

  double depth_mm(const Spot& inside) const { return least_.pieces.nearest(inside).mm; }
  /// How far a point outside lies beyond what the largest corner that finishes the surface
  /// next to it leaves in inner corners: where it rolls over the contour, or touches the
  /// lines of a corner's two sides, however short they are.
  double beyond_mm(const Spot& outside) const;
  /// How far the rounded edge that begins beside a point lies within a distance of the face
  /// that it is tangent to, sqrt(2 R d); 0 where none begins.
  double along_face_mm(const Spot& beside, double within_mm) const;
  /// The surface next to a point.
  const std::string& surface_at(const Spot& p) const;

 private:
  struct Run {
    bool outer = true;
    std::vector<Spot> points;         // z rises
    std::vector<std::size_t> before;  // surface of the piece that ends at each point
  };
  struct Body {
    Polygon polygon;
    std::vector<std::size_t> of;  // surface of the piece that begins at each point
    Pieces pieces;
  };
  enum class Threads { blank, root };

  Run run(bool outer, Threads threads);
  template <class Element>
  void append(Run& run, const std::vector<Element>& all, std::size_t k, Threads threads);
  void append(Run& run, const std::string& id, const Polygon& line);
  Body body(Threads threads);
  struct Fillet {
    Spot centre, corner;
    double reach = 0;  // of its sides from the corner
  };
  /// Where the centre of a corner of a radius is while it touches the contour.
  struct Rolled {
    Pieces centres;
    std::vector<Fillet> fillets;
  };
  Rolled rolled(double r) const;
  void roll(Rolled& rolled, double r, std::size_t piece) const;
  template <class Centre>
  void keep_clear(Rolled& rolled, double r, double steps, const Centre& centre) const;
  void add_walls(const Run& run);
  std::size_t surface(const std::string& id);
  double corner_mm(const std::string& surface) const;

  Sizes sizes_;
  const Planned& p_;
  std::vector<std::pair<Spot, double>> roundings_;  // where they begin, and their radii
  std::map<std::string, double> corners_mm_;
  std::vector<std::string> surfaces_;
  Body least_, full_;
  std::map<double, Rolled> rolled_;  // of each corner
  std::vector<Wall> walls_;
};

}  // namespace turnwright::nc::test
