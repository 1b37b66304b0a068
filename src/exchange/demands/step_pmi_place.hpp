#pragma once
#include <map>
#include <string>
#include <vector>

#include "pmi.hpp"

namespace turnwright::exchange {

/// What a face of the file has become in the outline.
enum class PlaceKind {
  cylinder,
  cone,
  cut,  ///< an arc, a groove, a thread: made at fixed conditions, without tolerances
  face,
  other  ///< an edge, a milled place
};

struct Place {
  PlaceKind kind = PlaceKind::other;
  std::string id;
  std::size_t index = 0;  ///< of an element or a face, in its list
  bool inner = false;     ///< of an element

  bool is_face() const { return kind == PlaceKind::face; }
  bool is_element() const { return !is_face() && kind != PlaceKind::other; }
};

/// "a cylinder", "a face" ..
const char* name(PlaceKind kind);

/// Places of an outline by the faces they were read from.
class Places {
 public:
  explicit Places(const Outline& outline);
  /// Each place once; a feature that was split into several faces of one element has one.
  std::vector<Place> of(const Feature& feature) const;
  /// Position [mm] along the axis of a face, by its place.
  double z_mm(const Place& face) const { return z_mm_.at(face.id); }

 private:
  void add(const Place& place, const std::vector<std::string>& sources);
  std::vector<Place> places_;
  std::map<std::string, std::vector<std::size_t>, std::less<>> by_source_;
  std::map<std::string, double> z_mm_;
};

/// "d1, d2".
std::string ids(const std::vector<Place>& places);

// The parts of add_pmi.
void add_sizes(const Pmi& pmi, const Places& places, Outline& outline);
void add_tolerances(const Pmi& pmi, const Places& places, Outline& outline);

}  // namespace turnwright::exchange
