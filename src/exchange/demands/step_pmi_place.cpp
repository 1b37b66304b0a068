#include "step_pmi_place.hpp"

#include <set>

#include "turnwright/base/language.hpp"

namespace turnwright::exchange {
namespace {

PlaceKind place_kind(Shape shape) {
  if (shape == Shape::cylinder) return PlaceKind::cylinder;
  return shape == Shape::cone ? PlaceKind::cone : PlaceKind::cut;
}

std::map<std::string, double> face_positions(const Outline& outline) {
  std::map<std::string, double> z_mm{{"left", 0.0}};
  double z = 0;
  for (std::size_t i = 0; i < outline.outer.size(); ++i) {
    if (i > 0) z_mm[outline.outer[i - 1].id + "|" + outline.outer[i].id] = z;
    z += outline.outer[i].length_mm;
  }
  z_mm["right"] = z;
  return z_mm;
}

}  // namespace

const char* name(PlaceKind kind) {
  switch (kind) {
    case PlaceKind::cylinder:
      return to_translate("a cylinder");
    case PlaceKind::cone:
      return to_translate("a cone");
    case PlaceKind::cut:
      return to_translate("an arc, groove or thread");
    case PlaceKind::face:
      return to_translate("a face");
    case PlaceKind::other:
      break;
  }
  return to_translate("an edge or a milled place");
}

Places::Places(const Outline& outline) : z_mm_(face_positions(outline)) {
  const auto elements = [&](const std::vector<Element>& list, bool inner) {
    for (std::size_t i = 0; i < list.size(); ++i)
      add({place_kind(list[i].shape), list[i].id, i, inner}, list[i].sources);
  };
  elements(outline.outer, false);
  elements(outline.inner, true);
  for (std::size_t i = 0; i < outline.faces.size(); ++i)
    if (z_mm_.contains(outline.faces[i].id))
      add({PlaceKind::face, outline.faces[i].id, i, false}, outline.faces[i].sources);
  for (const auto& e : outline.edges) add({PlaceKind::other, e.at, 0, false}, e.sources);
  for (const auto& m : outline.milled) add({PlaceKind::other, m.id, 0, false}, m.sources);
}

void Places::add(const Place& place, const std::vector<std::string>& sources) {
  for (const auto& source : sources) by_source_[source].push_back(places_.size());
  places_.push_back(place);
}

std::vector<Place> Places::of(const Feature& feature) const {
  std::set<std::size_t> found;
  for (const auto& face : feature.faces)
    if (const auto at = by_source_.find(face); at != by_source_.end())
      found.insert(at->second.begin(), at->second.end());
  std::vector<Place> all;
  for (const auto i : found) all.push_back(places_[i]);
  return all;
}

std::string ids(const std::vector<Place>& places) {
  std::string text;
  for (const auto& place : places) text += (text.empty() ? "" : ", ") + place.id;
  return text;
}

}  // namespace turnwright::exchange
