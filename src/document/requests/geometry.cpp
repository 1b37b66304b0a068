#include "turnwright/document/geometry.hpp"

#include "document/catalogue/machine_fields.hpp"
#include "document/json/fields.hpp"
#include "turned.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::document {
namespace {

using namespace volumetric;
using nlohmann::json;

constexpr std::size_t kGeometryPoints = 100000;

Vec3 difference(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

struct GeometryRequest {
  Machine machine;
  std::vector<Position> points;
  std::vector<TurnedSurface> surfaces;
};

GeometryRequest read_geometry_request(const json& request) {
  Problems problems{.document = "geometry"};
  Reader r = Reader(request, problems).as_object();
  read_format(r, "turnwright-geometry/1");
  GeometryRequest q{.machine = read_chain(r), .points = {}, .surfaces = {}};
  q.machine.tool_point_mm = read_vec3(r, "tool_point_mm", within(-1e6, 1e6, "mm"));
  q.surfaces = read_turned(r, q.machine.chain);
  const auto items = r.has("turned") ? r.optional_items("points", 1, kGeometryPoints)
                                     : r.items("points", 1, kGeometryPoints);
  for (const Reader& point : items) q.points.push_back(read_position(point, q.machine));
  r.finish();
  problems.throw_if_any();
  return q;
}

}  // namespace

Machine geometry_machine(const json& request) {
  return read_geometry_request(request).machine;
}

json geometry(const json& request) {
  const auto [machine, points, surfaces] = read_geometry_request(request);
  const Kinematics kinematics(machine);
  json out = json::array();
  for (const Position& at : points) {
    leave_if_asked();
    const ToolPose nominal = kinematics.nominal(at), actual = kinematics.actual(at);
    out.push_back(
        {{"tip_nominal_mm", nominal.tip_mm},
         {"tip_error_mm", difference(actual.tip_mm, nominal.tip_mm)},
         {"tip_error_first_order_mm", kinematics.tip_error_first_order_mm(at)},
         {"direction_error_rad", difference(actual.direction, nominal.direction)}});
  }
  json result{{"points", out}};
  if (!surfaces.empty())
    result["turned"] = turned_json(surfaces, kinematics, machine.tool_point_mm);
  return result;
}

}  // namespace turnwright::document
