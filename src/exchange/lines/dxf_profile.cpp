#include "dxf_profile.hpp"

#include "base/say.hpp"

namespace turnwright::exchange::dxf {
namespace {

constexpr std::size_t kListedRemarks = 20;

Point point(const Place& p) { return {p.x, p.y}; }

void add_sides(std::vector<Side>& sides, const Half& h, const std::vector<Link>& links,
               const View& view) {
  for (const Link& l : links) {
    Side s{.from = point(h.graph.nodes[l.from]), .to = point(h.graph.nodes[l.to])};
    if (l.centre) s.centre = point(*l.centre);
    s.counterclockwise = l.counterclockwise;
    s.sources = {view.source(l.source)};
    sides.push_back(std::move(s));
  }
}

void tell(const Half& h, const View& view, ProfileRead& out) {
  std::size_t n = 0;
  for (const auto& b : h.graph.bridged)
    if (n++ < kListedRemarks)
      out.assumed.push_back(
          {view.source(b.source),
           say("A gap of {:.3g} mm at {} was closed.", b.gap_mm, view.where(b.at))});
  if (h.doubtful)
    out.assumed.push_back(
        {"", tr("Solid lines that begin at an end face are read as a bore, "
                "though shoulders are drawn as seen from outside; a slot "
                "belongs on a layer of its own.")});
  n = 0;
  for (const auto source : h.unused)
    if (n++ < kListedRemarks)
      out.ignored.push_back(
          {view.source(source), tr("A line inside the contour that is no bore.")});
}

bool has_contour(const std::vector<Stroke>& strokes) {
  return std::any_of(strokes.begin(), strokes.end(),
                     [](const Stroke& s) { return s.role == Role::contour; });
}

// Both halves of a full profile: one outside, and the bores of the half that shows them.
void check_halves(const Half& a, const Half& b, const View& view, double join_mm) {
  const auto same = [&](std::vector<Link> Half::*chain, const char* what) {
    auto at = difference(a, b, chain, 2 * join_mm);
    if (!at) at = difference(b, a, chain, 2 * join_mm);
    if (at)
      refuse("", say("two halves whose {} differ at {}", tr(what), view.where(*at)),
             tr("a full profile that is symmetric to its axis, or one half of it"));
  };
  same(&Half::outside, to_translate("outsides"));
  if (!a.bored() || !b.bored()) return;
  same(&Half::from_right, to_translate("bores"));
  same(&Half::from_left, to_translate("bores"));
}

}  // namespace

ProfileRead profile_of(const Drawn& drawn, double join_mm) {
  ProfileRead out;
  out.view.drawn = &drawn;
  out.view.axis = find_axis(drawn.strokes, join_mm, out.assumed);
  const auto local = along(out.view.axis, drawn.strokes);
  const auto left = half(local, join_mm), right = half(mirrored(local), join_mm);
  View other = out.view;
  other.other_side = true;
  std::optional<Half> taken;
  if (has_contour(left)) {
    taken = read_half(left, join_mm, out.view);
    tell(*taken, out.view, out);
  }
  if (has_contour(right)) {
    Half h = read_half(right, join_mm, other);
    if (taken) check_halves(*taken, h, out.view, join_mm);
    if (!taken) tell(h, other, out);
    if (!taken || (h.bored() && !taken->bored())) {
      out.view = other;
      taken = std::move(h);
    }
  }
  if (!taken)
    refuse("", tr("no contour beside the axis"), tr("the profile of a turned part"));
  auto& sides = out.profile.sides;
  add_sides(sides, *taken, taken->left_face, out.view);
  add_sides(sides, *taken, taken->outside, out.view);
  add_sides(sides, *taken, taken->right_face, out.view);
  add_sides(sides, *taken, taken->from_right, out.view);
  add_sides(sides, *taken, taken->from_left, out.view);
  return out;
}

}  // namespace turnwright::exchange::dxf
