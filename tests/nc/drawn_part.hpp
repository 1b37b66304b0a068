#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "section.hpp"
#include "sizes.hpp"

/// The half section that a plan's programs have to make of its stock: the drawing with
/// the middle of its limits and the plan's corrections.
namespace turnwright::nc::test {

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
  std::map<long, std::vector<std::size_t>> near_;  // by whole millimetres of z
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
  /// How far a point outside lies beyond what the largest corner that finishes its side
  /// leaves in inner corners: where it rolls over the contour, or touches the lines of a
  /// corner's two sides, however short they are.
  double beyond_mm(const Spot& outside) const;
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
  void roll(std::size_t piece);
  template <class Centre>
  void keep_clear(std::size_t piece, double steps, const Centre& centre);
  void add_walls(const Run& run);
  std::size_t surface(const std::string& id);
  bool is_outer(std::size_t surface) const { return outer_[surface]; }

  Sizes sizes_;
  const Planned& p_;
  double corner_mm_[2] = {0, 0};  // inside, outside
  std::vector<std::string> surfaces_;
  std::vector<bool> outer_;
  Body least_, full_;
  Pieces rolled_[2];  // centres of a corner that touches the contour
  struct Fillet {
    Spot centre, corner;
    double reach = 0;  // of its sides from the corner
  };
  std::vector<Fillet> fillets_[2];
  std::vector<Wall> walls_;
};

}  // namespace turnwright::nc::test
