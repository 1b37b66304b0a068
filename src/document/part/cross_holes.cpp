#include "cross_holes.hpp"

#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "document/json/fields.hpp"
#include "document/json/reference.hpp"
#include "hole_tools.hpp"

namespace turnwright::document {
namespace {

using planning::Milled;
using planning::Through;

constexpr double kSlack_mm = 1e-9;

// The drill that the document names, or those that keep its limits.
void read_drills(Draft& draft, Reader& r, Milled& m) {
  const auto before = r.problems().list.size();
  if (r.has("tool")) {
    std::vector<std::string> known;
    for (const auto& t : draft.plan().fixed_tools)
      if (t.use == catalogue::FixedUse::drilling) known.push_back(t.id);
    m.drills = {checked_reference(r.at("tool"), known, tr("a drill of the tools"))};
  }
  const bool asked = r.has("fit") || r.has("limits_mm");
  const auto limits =
      asked && m.width_mm > 0 ? given_limits(r, m.width_mm) : std::nullopt;
  if (!limits || r.problems().list.size() > before) return;
  std::vector<std::string> keeping;
  std::string made;
  for (const auto* t : known_tools(draft, catalogue::FixedUse::drilling)) {
    if (!has_size(*t, m.width_mm) ||
        (!m.drills.empty() && std::ranges::count(m.drills, t->id) == 0))
      continue;
    if (keeps_size(*t, m.width_mm, *limits)) keeping.push_back(t->id);
    made += (made.empty() ? "" : "; ") + t->id + " " + promise(*t);
  }
  if (keeping.empty())
    r.problem_at(
        r.has("fit") ? "fit" : "limits_mm",
        made.empty()
            ? tr("none: of no drill of this diameter it is known what it leaves")
            : say("no more than a drill leaves ({}): a cross hole is not reamed", made),
        "conflict");
  m.drills = keeping;
}

void read_drilling(Reader& r, Milled& m) {
  if (!r.has("conditions")) return;
  Reader given = r.object("conditions");
  m.drilling.vc_m_min = given.optional_number("vc_m_min", above_up_to(0, 5000, "m/min"));
  m.drilling.f_mm_rev = given.optional_number("f_mm_rev", above_up_to(0, 5, "mm/rev"));
  given.finish();
}

// Radii of the bores over the hole's width; 0 where the part is solid.
struct Behind {
  double least_mm = 0, most_mm = 0;
};
Behind behind_of(const part::Drawing& d, const Milled& m) {
  const double z0 = m.z_mm, z1 = m.z_mm + m.length_mm;
  return {part::least_hole_mm(d, z0, z1) / 2, part::largest_hole_mm(d, z0, z1) / 2};
}

// To where the last corner of the drill has left the wall, Milled::depth_mm.
void open_into_bore(Reader& r, double R, const Behind& behind, Milled& m) {
  if (m.width_mm < 2 * behind.least_mm) {
    m.depth_mm =
        R - std::sqrt(behind.least_mm * behind.least_mm - m.width_mm * m.width_mm / 4);
    return;
  }
  r.problem_at("through",
               behind.least_mm > 0
                   ? say("part, or a hole narrower than the bore behind it, {}",
                         mm_text(2 * behind.least_mm))
                   : tr("part, or a hole with a bore behind all of its width"),
               "conflict");
}

void check_depth(Reader& r, double R, const Behind& behind, const Milled& m) {
  const double wall = behind.most_mm > 0 ? R - behind.most_mm : 2 * R;
  if (m.depth_mm >= wall)
    r.problem_at(
        "depth_mm",
        behind.most_mm > 0
            ? say("less than the wall over the hole, {}, or through in its place",
                  mm_text(wall))
            : say("less than the diameter, {}, or through in its place", mm_text(wall)),
        "conflict");
}

}  // namespace

void read_cross_hole(Draft& draft, Reader& r, const part::OuterElement* on, Milled& m) {
  const double at = r.number("at_mm", within(0, 20000, "mm"));
  m.width_mm = m.length_mm = r.number("diameter_mm", above_up_to(0, 500, "mm"));
  m.z_mm = at - m.length_mm / 2;
  if (r.has("through")) {
    m.through = r.choice<Through>("through", named({Through::wall, Through::part}));
    if (r.has("depth_mm"))
      r.problem_at("through", tr("depth_mm or through, not both"), "conflict");
  }
  if (m.through == Through::no && !r.has("through"))
    m.depth_mm = r.number("depth_mm", above_up_to(0, 500, "mm"));
  if (on && m.through == Through::no) m.depth_mm += draft.ground(on->id) / 2;
  read_drills(draft, r, m);
  read_drilling(r, m);
}

void check_cross_hole(const part::Drawing& d, Reader& r, Milled& m) {
  const auto& e = d.outer[m.element];
  const double R = e.left_mm / 2, D = m.width_mm;
  const double z0 = part::left_z_mm(d, m.element), z1 = z0 + e.length_mm;
  if (D >= 2 * R)
    return r.problem_at("diameter_mm",
                        say("less than the diameter of {}, {}", e.id, mm_text(2 * R)),
                        "conflict");
  if (D > e.length_mm + kSlack_mm)
    return r.problem_at("diameter_mm",
                        say("at most the length of {}, {}", e.id, mm_text(e.length_mm)),
                        "conflict");
  if (m.z_mm < z0 - kSlack_mm || m.z_mm + D > z1 + kSlack_mm)
    return r.problem_at("at_mm",
                        say("a hole that lies on {}, its middle from {} to {}", e.id,
                            mm_text(z0 + D / 2), mm_text(z1 - D / 2)),
                        "conflict");
  const auto behind = behind_of(d, m);
  if (m.through == Through::wall)
    open_into_bore(r, R, behind, m);
  else if (m.through == Through::part)
    m.depth_mm = 2 * R;
  else
    check_depth(r, R, behind, m);
}

}  // namespace turnwright::document
