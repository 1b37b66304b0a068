#include "turned.hpp"

#include <algorithm>

#include "turnwright/base/language.hpp"

namespace turnwright::document {
namespace {

using namespace volumetric;
using nlohmann::json;

constexpr std::size_t kSurfaces = 200;

// Radius and z of an end.
std::array<double, 2> read_end(Reader& r, const char* key) {
  std::array<double, 2> at{};
  const auto values = r.numbers(key, within(-1e6, 1e6, "mm"), 2, 2);
  std::ranges::copy(values, at.begin());
  if (values.size() == 2 && !(at[0] >= 0))
    r.problem_at(key, tr("[r, z] with a radius of 0 mm or more"), "range");
  return at;
}

double read_sign(Reader& group, const char* axis) {
  const double sign = group.number_or(axis, within(-1, 1), -1);
  if (sign > -1 && sign < 1) group.problem_at(axis, tr("-1 or 1"), "range");
  return sign;
}

TurnedSurface read_surface(Reader r, const std::vector<TurnedSurface>& before) {
  r = r.as_object();
  TurnedSurface s{r.text("id", 64), {}, {}};
  const auto from = read_end(r, "from_mm"), to = read_end(r, "to_mm");
  s.generator = {from[0], from[1], to[0], to[1]};
  if (r.has("from_mm") && r.has("to_mm") && from == to)
    r.problem_at("to_mm", tr("another place than from_mm"), "conflict");
  if (auto approach = r.optional_object("approach")) {
    s.generator.approach_x = read_sign(*approach, "X");
    s.generator.approach_z = read_sign(*approach, "Z");
    approach->finish();
  }
  const auto place = [&](const std::string& id) {
    return std::ranges::find(before, id, &TurnedSurface::id);
  };
  if (place(s.id) != before.end())
    r.problem_at("id", tr("an id no other has"), "duplicate");
  if (r.has("datum")) {
    const auto datum = place(r.text("datum", 64));
    if (datum == before.end())
      r.problem_at("datum", tr("the id of a surface before"), "reference");
    else
      s.datum = static_cast<std::size_t>(datum - before.begin());
  }
  r.finish();
  return s;
}

bool is_face(const Surface& s) { return s.z_mm.front() == s.z_mm.back(); }

DatumAxis datum_of(const Surface& s) { return is_face(s) ? normal_of(s) : axis_of(s); }

json form_json(const Form& form) {
  return {{"least_squares_mm", form.least_squares_mm},
          {"minimum_zone_mm", form.minimum_zone_mm}};
}

json face_json(const Surface& s, const DatumAxis& datum, const Surface* other) {
  json out{{"flatness", form_json(flatness(s))},
           {"straightness", form_json(straightness(s))},
           {"perpendicularity_mm", perpendicularity_mm(s, datum)},
           {"circular_axial_runout_mm", circular_axial_runout_mm(s, datum)},
           {"total_axial_runout_mm", perpendicularity_mm(s, datum)},
           {"profile_mm", profile_mm(s)}};
  if (!other || !is_face(*other)) return out;
  const bool further = s.z_mm[0] >= other->z_mm[0];
  out["parallelism_mm"] = parallelism_mm(s, *other);
  out["length_mm"] = further ? length_error_mm(*other, s) : length_error_mm(s, *other);
  return out;
}

json round_json(const Surface& s, const DatumAxis& datum) {
  return {{"diameter_mm", diameter_error_mm(s)},
          {"taper_mm", taper_mm(s)},
          {"straightness", form_json(straightness(s))},
          {"roundness", form_json(roundness(s))},
          {"cylindricity", form_json(cylindricity(s))},
          {"circular_radial_runout_mm", circular_radial_runout_mm(s, datum)},
          {"total_radial_runout_mm", total_radial_runout_mm(s, datum)},
          {"coaxiality_mm", coaxiality_mm(s, datum)},
          {"profile_mm", profile_mm(s)}};
}

}  // namespace

std::vector<TurnedSurface> read_turned(Reader& r, const std::string& chain) {
  std::vector<TurnedSurface> all;
  const auto items = r.optional_items("turned", 1, kSurfaces);
  for (const Reader& item : items) all.push_back(read_surface(item, all));
  const bool lathe = std::ranges::all_of(
      std::string("XZC"), [&](char c) { return chain.find(c) != std::string::npos; });
  if (!items.empty() && chain_fault(chain).empty() && !lathe)
    r.problem_at("chain", tr("a chain with X, Z and C for what is turned"), "conflict");
  return all;
}

json turned_json(const std::vector<TurnedSurface>& surfaces, const Kinematics& machine,
                 const Vec3& tool_point_mm) {
  std::vector<Surface> cut;
  for (const TurnedSurface& s : surfaces)
    cut.push_back(turned(machine, tool_point_mm, s.generator));
  json out = json::array();
  for (std::size_t i = 0; i < cut.size(); ++i) {
    const Surface* other = surfaces[i].datum ? &cut[*surfaces[i].datum] : nullptr;
    const DatumAxis datum = other ? datum_of(*other) : DatumAxis{};
    json one =
        is_face(cut[i]) ? face_json(cut[i], datum, other) : round_json(cut[i], datum);
    one["id"] = surfaces[i].id;
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace turnwright::document
