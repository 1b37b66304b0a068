#include "mounted_edge.hpp"

#include <fmt/format.h>

#include "edges.hpp"
#include "turnwright/cutting/fixed.hpp"

namespace turnwright::review {
namespace {

using catalogue::FixedUse;

constexpr double kTouch_mm = 2e-3;  // by which rapids may come too near
constexpr double kAnyPitch_mm = 3;  // of the tooth of a threading tool
constexpr double kWheel_mm = 5;     // of a knurling wheel over its holder

// Length over which a tool on the axis grows to its diameter.
double point_mm(const catalogue::FixedTool& t, double size) {
  if (t.use == FixedUse::centring) return catalogue::tip_depth_mm(t, size);
  return t.use == FixedUse::reaming ? t.lead : cutting::drill_point_mm(size, t.point_deg);
}

Polygon fixed_edge(const catalogue::FixedTool& t, double size) {
  switch (t.use) {
    case FixedUse::centring:
    case FixedUse::drilling:
    case FixedUse::counterboring:
    case FixedUse::countersinking:
    case FixedUse::reaming:
      return pointed_edge(size, point_mm(t, size));
    case FixedUse::grooving:
    case FixedUse::parting:
      return rectangle(0, t.reach, 0, size);
    case FixedUse::knurling:
      return rectangle(0, kWheel_mm, 0, size);
    case FixedUse::threading:
    case FixedUse::tapping:
      return thread_edge(kAnyPitch_mm);
    case FixedUse::profiling:
      break;
  }
  return profiling_edge(t.re_mm);
}

Polygon placed(const Polygon& tool, double side, double sign) {
  Polygon all;
  for (const auto& p : tool) all.push_back({side * p.x, sign * p.z});
  return hull(std::move(all));
}

}  // namespace

MountedEdge mounted_edge(const MountedTool& tool, double sign) {
  MountedEdge m;
  Polygon edge;
  if (tool.turning) {
    m.inner = tool.turning->bar.has_value();
    m.re_mm = tool.turning->re_mm;
    edge = insert_edge(catalogue::outline(*tool.turning));
  } else {
    const auto& t = *tool.fixed;
    m.on_axis = catalogue::on_axis(t.use);
    if (m.on_axis) {
      m.radius_mm = tool.size_mm / 2;
      m.point_mm = point_mm(t, tool.size_mm);
    }
    m.threads = t.use == FixedUse::threading || t.use == FixedUse::tapping;
    m.plunges = t.use == FixedUse::grooving || t.use == FixedUse::parting;
    m.inner = t.inner || m.on_axis;
    m.re_mm = t.re_mm;
    m.width_mm = m.plunges ? tool.size_mm : 0;
    edge = fixed_edge(t, tool.size_mm);
  }
  m.edge = placed(edge, m.inner && !m.on_axis ? -1 : 1, sign);
  m.small = eroded(m.edge, kTouch_mm);
  return m;
}

const std::string& id(const MountedTool& tool) {
  return tool.turning ? tool.turning->id : tool.fixed->id;
}

std::string label(const std::string& id, double size_mm) {
  return size_mm > 0 ? fmt::format("{} {:g} mm", id, size_mm) : id;
}

}  // namespace turnwright::review
