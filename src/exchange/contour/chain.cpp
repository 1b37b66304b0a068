#include "chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "thread_undercut.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::exchange {
namespace {

// Edges are told from cones and grooves from necks by their sizes: estimates from what
// drawings have.
constexpr double kSteepest_rad = 80 * std::numbers::pi / 180;  // of a chamfer
constexpr double kFlattest_rad = 10 * std::numbers::pi / 180;
constexpr double kEdge_mm = 1, kEdgeShare = 0.12;      // largest edge, of the diameter
constexpr double kGroove_mm = 6, kGrooveShare = 0.15;  // widest groove
constexpr double kLeastWall_mm = 0.05;                 // beside a chamfer
constexpr double kFillet_mm = 1.6;  // the largest that tools' corners leave
constexpr double kTangent_rad = 0.02;
constexpr double kRecess_mm = 6;  // of an undercut along the axis

enum class Kind { wall, straight, arc };

struct Item {
  Kind kind = Kind::straight;
  Side side;
  std::vector<Corner> before = {}, after = {};
};
using Items = std::vector<Item>;

double dx(const Item& i) { return i.side.to.z_mm - i.side.from.z_mm; }
double dy(const Item& i) { return i.side.to.r_mm - i.side.from.r_mm; }
bool level(const Item& i, double join_mm) {
  return i.kind == Kind::straight && std::abs(dy(i)) <= join_mm;
}
bool rises(const Item& i) { return i.kind == Kind::wall && dy(i) > 0; }
bool falls(const Item& i) { return i.kind == Kind::wall && dy(i) < 0; }

double radius_mm(const Side& s) {
  return std::hypot(s.from.z_mm - s.centre->z_mm, s.from.r_mm - s.centre->r_mm);
}

// Direction of travel at a point of a side.
double direction_rad(const Side& s, const Point& at) {
  if (!s.centre) return std::atan2(s.to.r_mm - s.from.r_mm, s.to.z_mm - s.from.z_mm);
  const double x = at.z_mm - s.centre->z_mm, y = at.r_mm - s.centre->r_mm;
  return s.counterclockwise ? std::atan2(x, -y) : std::atan2(-x, y);
}

bool tangent(const Side& before, const Side& after) {
  const double turn = direction_rad(before, before.to) - direction_rad(after, after.from);
  return std::abs(std::remainder(turn, 2 * std::numbers::pi)) <= kTangent_rad;
}

// How large an edge may be at a radius; inside it is negative here.
double largest_edge_mm(double y_mm) { return kEdge_mm + kEdgeShare * 2 * std::abs(y_mm); }

double height_mm(const Item& straight, double x_mm) {
  const Side& s = straight.side;
  return s.from.r_mm + dy(straight) / dx(straight) * (x_mm - s.from.z_mm);
}

// Takes the items first to last - 1 out and lets their neighbours, a wall and a straight
// band, meet in a sharp corner that has the given shape.
void sharpen(Items& items, std::size_t first, std::size_t last, Corner corner) {
  Item &before = items[first - 1], &after = items[last];
  for (std::size_t i = first; i < last; ++i)
    corner.sources.insert(corner.sources.end(), items[i].side.sources.begin(),
                          items[i].side.sources.end());
  const bool wall_first = before.kind == Kind::wall;
  const Item& band = wall_first ? after : before;
  const double x = wall_first ? before.side.to.z_mm : after.side.from.z_mm;
  const Point meet{x, height_mm(band, x)};
  before.side.to = after.side.from = meet;
  (wall_first ? after.before : before.after).push_back(std::move(corner));
  items.erase(items.begin() + static_cast<std::ptrdiff_t>(first),
              items.begin() + static_cast<std::ptrdiff_t>(last));
}

bool wall_and_band(const Item& a, const Item& b) {
  return (a.kind == Kind::wall && b.kind == Kind::straight) ||
         (a.kind == Kind::straight && b.kind == Kind::wall);
}

// A slope between a band and the wall that goes on down from it.
bool take_chamfer(Items& items, std::size_t i) {
  const Item &before = items[i - 1], &edge = items[i], &after = items[i + 1];
  if (edge.kind != Kind::straight || !wall_and_band(before, after)) return false;
  const bool up = rises(before) && dy(edge) > 0, down = falls(after) && dy(edge) < 0;
  const double angle = std::atan2(std::abs(dy(edge)), dx(edge));
  const Item& band = up ? after : before;
  const Item& wall = up ? before : after;
  if (!(up || down) || angle < kFlattest_rad || angle > kSteepest_rad) return false;
  const double most = largest_edge_mm(
      std::max(std::abs(edge.side.from.r_mm), std::abs(edge.side.to.r_mm)));
  if (dx(edge) > most || std::abs(dy(edge)) > most) return false;
  if (dx(band) <= dx(edge) || std::abs(dy(wall)) < kLeastWall_mm) return false;
  sharpen(items, i, i + 1,
          {.kind = Corner::Kind::chamfer, .axial_mm = dx(edge), .angle_rad = angle});
  return true;
}

// A tangent arc between a band and a wall: a fillet at the wall's foot, or a rounded edge
// where the wall falls away.
bool take_radius(Items& items, std::size_t i) {
  const Item &before = items[i - 1], &edge = items[i], &after = items[i + 1];
  if (edge.kind != Kind::arc || !wall_and_band(before, after)) return false;
  if (!tangent(before.side, edge.side) || !tangent(edge.side, after.side)) return false;
  const bool inner_corner = edge.side.counterclockwise;
  const double r = radius_mm(edge.side);
  if (inner_corner && r > kFillet_mm) return false;  // a radius that is turned
  if (r > largest_edge_mm(
              std::max(std::abs(edge.side.from.r_mm), std::abs(edge.side.to.r_mm))))
    return false;
  sharpen(items, i, i + 1,
          {.kind = inner_corner ? Corner::Kind::fillet : Corner::Kind::rounded,
           .radius_mm = r});
  return true;
}

// As the table of DIN 509 gives its sizes.
double tenths(double mm) { return std::round(10 * mm) / 10; }

// An undercut if it falls at an angle.
std::optional<part::Undercut> that_falls(const std::optional<part::Undercut>& u,
                                         double rad) {
  return u && std::abs(part::falls_rad(*u) - rad) <= kTangent_rad ? u : std::nullopt;
}

// Of form E of DIN 509, or of DIN 76 behind an outer thread.
std::optional<part::Undercut> undercut_of(double falls_rad, double radius, double depth,
                                          double width, bool outside) {
  const auto e =
      that_falls(part::undercut('E', tenths(radius), tenths(depth)), falls_rad);
  return e || !outside ? e
                       : that_falls(thread_undercut_of(radius, depth, width), falls_rad);
}

// An undercut: from the cylinder a slope down to a floor, and an arc from there up the wall;
// `first` and `last` enclose them, the arc next to the wall.
bool take_undercut(Items& items, std::size_t first, std::size_t last, double join_mm) {
  const Item &before = items[first - 1], &after = items[last];
  const bool wall_first = before.kind == Kind::wall;
  const Item& cylinder = wall_first ? after : before;
  const Item& arc = wall_first ? items[first] : items[last - 1];
  const Item& slope = wall_first ? items[last - 1] : items[first];
  if (!(wall_first ? falls(before) : rises(after)) || !level(cylinder, join_mm) ||
      arc.kind != Kind::arc || !arc.side.counterclockwise ||
      slope.kind != Kind::straight || (wall_first ? dy(slope) <= 0 : dy(slope) >= 0))
    return false;
  if (last - first == 3 && !level(items[first + 1], join_mm)) return false;
  const double depth = std::abs(dy(slope));
  const double width = items[last - 1].side.to.z_mm - items[first].side.from.z_mm;
  const auto found = undercut_of(std::atan2(depth, dx(slope)), radius_mm(arc.side), depth,
                                 width, cylinder.side.from.r_mm > 0);
  if (!found) return false;
  sharpen(items, first, last,
          {.kind = Corner::Kind::undercut,
           .radius_mm = found->radius_mm,
           .undercut = part::designation(*found),
           .pitch_mm = found->pitch_mm});
  return true;
}

// The forms F, G and H of DIN 509: a slope and a floor, and an arc from which a slope off the
// wall leads back to it.  Those of G and H may be tangent to the arc, without a floor.
// Nothing of other recesses.
std::optional<part::Undercut> into_wall(const Items& items, std::size_t first,
                                        std::size_t last, double join_mm) {
  double radius = 0, depth = 0, slope_rad = 0, back_rad = 0;
  bool floor = false;
  for (std::size_t i = first; i < last; ++i) {
    const Item& item = items[i];
    if (item.kind == Kind::arc) radius = std::max(radius, radius_mm(item.side));
    if (item.kind != Kind::straight) continue;
    const double w = std::abs(dy(item)), l = std::abs(dx(item));
    if (level(item, join_mm)) {
      floor = true;
    } else if (dx(item) < 0) {
      back_rad = std::atan2(l, w);
    } else {
      slope_rad = std::atan2(w, l);
      depth = w;
    }
  }
  if (!floor) depth += radius * (1 - std::cos(slope_rad));
  for (const char form : {'F', 'G', 'H'}) {
    const auto u =
        that_falls(part::undercut(form, tenths(radius), tenths(depth)), slope_rad);
    if (u && std::abs(part::leans_rad(*u) - back_rad) <= kTangent_rad &&
        (floor || form != 'F'))
      return u;
  }
  return std::nullopt;
}

// A recess that reaches behind a wall, as forms F to H of DIN 509 do.
bool take_recess(Items& items, std::size_t back, double join_mm) {
  const auto small = [&](const Item& i) {
    return i.kind != Kind::wall && std::abs(dx(i)) <= kRecess_mm;
  };
  std::size_t first = back, last = back + 1;
  while (first > 0 && small(items[first - 1]) && !level(items[first - 1], join_mm))
    --first;
  while (last < items.size() && small(items[last]) && !level(items[last], join_mm))
    ++last;
  // A floor, next to the arc, is level too; the cylinder lies beyond the slope that leads to
  // it.
  if (first > 1 && items[first].kind == Kind::arc && level(items[first - 1], join_mm) &&
      small(items[first - 2]))
    first -= 2;
  if (last + 2 < items.size() && items[last - 1].kind == Kind::arc &&
      level(items[last], join_mm) && small(items[last + 1]))
    last += 2;
  if (first == 0 || last >= items.size() || !wall_and_band(items[first - 1], items[last]))
    return false;
  if (const auto u = into_wall(items, first, last, join_mm))
    sharpen(items, first, last,
            {.kind = Corner::Kind::undercut,
             .radius_mm = u->radius_mm,
             .undercut = part::designation(*u)});
  else
    sharpen(items, first, last, {.kind = Corner::Kind::recess});
  return true;
}

bool take_edge(Items& items, std::size_t i, double join_mm) {
  for (const std::size_t n : {std::size_t{2}, std::size_t{3}})
    if (i + n < items.size() && take_undercut(items, i, i + n, join_mm)) return true;
  return i + 1 < items.size() && (take_chamfer(items, i) || take_radius(items, i));
}

void take_edges(Items& items, double join_mm) {
  for (std::size_t i = 1; i + 1 < items.size(); ++i)
    if (dx(items[i]) < -join_mm && take_recess(items, i, join_mm)) {
      leave_if_asked();
      i = 0;  // positions have moved
    }
  for (std::size_t i = 1; i + 1 < items.size(); ++i) {
    leave_if_asked();
    if (take_edge(items, i, join_mm)) i = std::max<std::size_t>(i, 2) - 2;
  }
}

Band band_of(const Item& item, double join_mm) {
  Band b{.from = item.side.from,
         .to = item.side.to,
         .sources = item.side.sources,
         .before = item.before,
         .after = item.after};
  if (item.kind == Kind::arc) {
    b.shape = Shape::arc;
    b.radius_mm = radius_mm(item.side);
    b.convex = !item.side.counterclockwise;
  } else if (std::abs(dy(item)) > join_mm) {
    b.shape = Shape::cone;
  }
  return b;
}

// A narrow cylinder between a wall that falls to it and one that rises from it.
void name_grooves(Items& items, Chain& chain, const std::vector<std::size_t>& of_band) {
  for (std::size_t k = 1; k + 1 < chain.bands.size(); ++k) {
    const std::size_t i = of_band[k];
    Band& b = chain.bands[k];
    const double widest = std::max(kGroove_mm, kGrooveShare * 2 * std::abs(b.from.r_mm));
    if (b.shape == Shape::cylinder && falls(items[i - 1]) && rises(items[i + 1]) &&
        b.to.z_mm - b.from.z_mm <= widest)
      b.shape = Shape::groove;
  }
}

}  // namespace

std::string place(const std::vector<std::string>& sources, const Point& at) {
  if (sources.empty()) return fmt::format("z = {:g}, r = {:g} mm", at.z_mm, at.r_mm);
  return fmt::format("{}", fmt::join(sources, ", "));
}

Chain chain_of(const std::vector<Side>& sides, double join_mm) {
  Items items;
  for (const Side& s : sides) {
    const bool wall = !s.centre && std::abs(s.to.z_mm - s.from.z_mm) <= join_mm;
    items.push_back({s.centre ? Kind::arc : wall ? Kind::wall : Kind::straight, s});
  }
  take_edges(items, join_mm);
  Chain chain{.bands = {}, .walls = {{}}};
  std::vector<std::size_t> of_band;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const Side& s = items[i].side;
    if (dx(items[i]) < -join_mm)
      throw InputError(
          "profile",
          {{place(s.sources, s.from), tr("a surface that leads back along the axis"),
            tr("a contour that a tool can follow from end to end: grooves in "
               "faces and recesses behind shoulders have no place in a part "
               "document"),
            "geometry"}});
    if (items[i].kind == Kind::wall) {
      auto& of = chain.walls.back();
      of.insert(of.end(), s.sources.begin(), s.sources.end());
    } else {
      chain.bands.push_back(band_of(items[i], join_mm));
      chain.walls.emplace_back();
      of_band.push_back(i);
    }
  }
  name_grooves(items, chain, of_band);
  return chain;
}

}  // namespace turnwright::exchange
