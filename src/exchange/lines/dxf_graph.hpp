#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "dxf_plane.hpp"

/// Lines and arcs joined where they meet, in coordinates of the axis (x along it).
namespace turnwright::exchange::dxf {

using Node = std::uint32_t;

/// A stroke or a piece of one, from node to node.
struct Link {
  Node from = 0, to = 0;
  std::optional<Place> centre = {};
  bool counterclockwise = false;
  Role role = Role::contour;
  std::uint32_t source = 0;

  Link reversed() const {
    Link back = *this;
    std::swap(back.from, back.to);
    back.counterclockwise = !counterclockwise;
    return back;
  }
};

/// Two ends that were not quite at one place.
struct Bridged {
  Place at;
  double gap_mm = 0;
  std::uint32_t source = 0;
};

struct Graph {
  std::vector<Place> nodes;
  std::vector<Link> links;
  std::vector<std::vector<std::uint32_t>> at;  ///< links of a node
  std::vector<Bridged> bridged;

  /// Link k as it leaves a node that it ends on.
  Link leaving(Node node, std::uint32_t k) const {
    return links[k].from == node ? links[k] : links[k].reversed();
  }
  Place tangent(const Link& leaving) const;  ///< unit vector where it begins
  Place arriving(const Link& link) const;    ///< unit vector where it ends
};

/// Joins ends that lie within `join_mm`, divides strokes where another one ends on them, and
/// keeps one of those that are drawn twice.
Graph joined(const std::vector<Stroke>& strokes, double join_mm);

enum class Hand { left, right };

/// The links that leave the node, those that turn most to the hand first; `heading` is the
/// direction of arrival, `allowed` leaves links out.
std::vector<Link> turning(const Graph& g, Node node, const Place& heading, Hand hand,
                          const std::function<bool(std::uint32_t)>& allowed);

}  // namespace turnwright::exchange::dxf
