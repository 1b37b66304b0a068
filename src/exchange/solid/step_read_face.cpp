#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/say.hpp"
#include "step_face.hpp"
#include "step_geometry.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::exchange {
namespace {

constexpr std::size_t kListedFaces = 100;

/// Reads the faces of one body.  A solid's edge bounds two faces, so that a file whose
/// boundaries are longer than that by far is refused before it costs memory.
class FaceReader {
 public:
  FaceReader(const Exchange& file, const Body& body)
      : geometry_(body.mm, body.rad), left_(16 * (file.size() + 64)) {}

  Face face(const FaceUse& use) {
    const auto name = use.face.is("FACE_SURFACE") ? "FACE_SURFACE" : "ADVANCED_FACE";
    const auto record = use.face.as(name);
    const auto n = record.size();
    if (n < 3) record.refuse(say("{} parameters", n), tr("bounds, surface, sense"));
    Face face;
    face.id = use.face.id();
    face.surface = geometry_.surface(record[n - 2].instance());
    face.sense = record[n - 1].boolean() == face.surface.reversed ? -1 : 1;
    face.outward = use.outward ? face.sense : -face.sense;
    const auto bounds = record[n - 3];
    for (std::size_t i = 0; i < bounds.size(); ++i) bound(bounds[i].instance(), face);
    return face;
  }

  bool spent() const { return left_ == 0; }

 private:
  void bound(const Instance& bound, Face& face) {
    const auto record = bound.is("FACE_OUTER_BOUND") ? bound.as("FACE_OUTER_BOUND")
                                                     : bound.as("FACE_BOUND");
    const auto loop = record[1].instance();
    if (const auto vertex = loop.find("VERTEX_LOOP")) {
      face.points.push_back(vertex_point((*vertex)[1].instance()));
      return;
    }
    const bool forward = record[2].boolean();
    const auto edges = loop.as("EDGE_LOOP")[1];
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (spent()) edges.refuse(tr("edges that each bound two faces"));
      --left_;
      face.boundary.push_back(edge(edges[i].instance(), forward));
    }
  }

  Boundary edge(const Instance& oriented, bool forward) const {
    const auto use = oriented.as("ORIENTED_EDGE");
    const auto instance = use[3].instance();
    const auto record = instance.as("EDGE_CURVE");
    const bool along = use[4].boolean() == forward;
    Boundary b;
    b.edge = instance.index();
    b.from = vertex_point(record[along ? 1 : 2].instance());
    b.to = vertex_point(record[along ? 2 : 1].instance());
    geometry_.curve(record[3].instance(), along == record[4].boolean(), b);
    return b;
  }

  Eigen::Vector3d vertex_point(const Instance& vertex) const {
    return geometry_.point(vertex.as("VERTEX_POINT")[1].instance());
  }

  Geometry geometry_;
  std::size_t left_;
};

}  // namespace

double Boundary::turn_rad() const {
  const Eigen::Vector3d a = from - centre, b = to - centre;
  const double turn = std::atan2(normal.dot(a.cross(b)), a.dot(b));
  constexpr double kClosed = 1e-9;  // rad: from and to are one vertex
  return turn > kClosed ? turn : turn + 2 * std::numbers::pi;
}

std::vector<Face> step_faces(const Exchange& file, const Body& body) {
  FaceReader reader(file, body);
  std::vector<Face> faces;
  std::vector<Problem> problems;
  for (const auto& use : body.faces) {
    leave_if_asked();
    try {
      faces.push_back(reader.face(use));
    } catch (const InputError& e) {
      problems.insert(problems.end(), e.problems().begin(), e.problems().end());
      if (problems.size() >= kListedFaces || reader.spent()) break;
    }
  }
  if (!problems.empty()) throw InputError("STEP file", std::move(problems));
  return faces;
}

}  // namespace turnwright::exchange
