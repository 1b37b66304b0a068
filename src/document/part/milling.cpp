#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "cross_holes.hpp"
#include "document/catalogue/entries.hpp"
#include "document/json/fields.hpp"
#include "document/json/reference.hpp"
#include "milled_shaft.hpp"
#include "part_sections.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::document {
namespace {

using planning::Milled;
using planning::MilledKind;

constexpr std::size_t kPlaces = 100;
constexpr double kDepthMargin = 0.2, kSpeedMargin = 0.02;
constexpr double kSlack = 1e-9;  // mm

// Cylinders without a groove, thread or arc; not what keeps the corners of the stock.
std::vector<std::string> cylinders(const part::Drawing& drawing) {
  const bool corners = part::flats(drawing.stock.kind) > 0;  // depths are from a circle
  std::vector<std::string> out;
  for (const auto& e : drawing.outer)
    if (e.kind == part::ElementKind::cylinder && !e.cut && !(corners && e.as_stock))
      out.push_back(e.id);
  return out;
}

deflection::Slot slot_of(const Milled& m, double diameter_mm) {
  return {m.width_mm, diameter_mm / 2 - m.depth_mm, units::rad_from_deg(m.angle_deg)};
}

// Depth of flats by the width across two that are opposite.
double depth_of_flats(Reader& r, double D_mm, int count) {
  const double across = r.number("across_flats_mm", above_up_to(0, 1000, "mm"));
  if (r.has("depth_mm"))
    r.problem_at("across_flats_mm", tr("depth_mm or across_flats_mm, not both"),
                 "conflict");
  else if (count % 2 != 0)
    r.problem_at("across_flats_mm", tr("an even count: each flat has one opposite"),
                 "conflict");
  else if (across >= D_mm)
    r.problem_at("across_flats_mm", say("less than the diameter, {}", mm_text(D_mm)),
                 "conflict");
  return (D_mm - across) / 2;
}

// Checks that a place lies on its element, below its rim and above its hole.
void check_shape(const part::Drawing& d, Reader& r, Milled& m) {
  const auto& e = d.outer[m.element];
  const double R = e.left_mm / 2, z0 = part::left_z_mm(d, m.element);
  const double z1 = z0 + e.length_mm;
  if (m.z_mm < z0 - kSlack || m.z_mm > z1)
    r.problem_at("z_mm",
                 say("a place on {}, from {} to {}", e.id, mm_text(z0), mm_text(z1)),
                 "conflict");
  else if (m.z_mm + m.length_mm > z1 + kSlack)
    r.problem_at("length_mm",
                 say("at most {}, to the end of {}", mm_text(z1 - m.z_mm), e.id),
                 "conflict");
  if (!(m.depth_mm < R)) {
    if (m.depth_mm >= R)
      r.problem_at("depth_mm", say("less than the radius of {}, {}", e.id, mm_text(R)),
                   "conflict");
    return;
  }
  const double hole = part::largest_hole_mm(d, m.z_mm, m.z_mm + m.length_mm) / 2;
  if (R - m.depth_mm <= hole + kSlack)
    r.problem_at("depth_mm",
                 say("less than the wall over the hole, {}", mm_text(R - hole)),
                 "conflict");
  if (m.kind == MilledKind::flat) {
    m.width_mm = 2 * std::sqrt(R * R - (R - m.depth_mm) * (R - m.depth_mm));
    return;
  }
  if (m.width_mm >= 2 * R)
    r.problem_at("width_mm",
                 say("less than the diameter of {}, {}", e.id, mm_text(2 * R)),
                 "conflict");
  else if (R - m.depth_mm >= std::sqrt(R * R - m.width_mm * m.width_mm / 4))
    r.problem_at("depth_mm",
                 say("a floor below the edges, more than {} at this width",
                     mm_text(R - std::sqrt(R * R - m.width_mm * m.width_mm / 4))),
                 "conflict");
  if (m.kind == MilledKind::keyway && m.length_mm < m.width_mm)
    r.problem_at("length_mm", say("at least its width, {}", mm_text(m.width_mm)),
                 "conflict");
}

// What a place takes of the cross-section: of a hole through the part both halves, which in
// a bore wider than the hole begin where its edges leave the wall.
std::vector<deflection::Slot> slots_of(const part::Drawing& d, const Milled& m) {
  const double D = d.outer[m.element].left_mm;
  if (m.through != planning::Through::part) return {slot_of(m, D)};
  const double bore = part::least_hole_mm(d, m.z_mm, m.z_mm + m.length_mm);
  auto near = slot_of(m, D);
  near.floor_mm = std::sqrt(std::max(0.0, bore * bore - m.width_mm * m.width_mm)) / 2;
  auto far = near;
  far.angle_rad += units::kPi;
  return {near, far};
}

bool places_meet(const part::Drawing& d, const Milled& a, const Milled& b) {
  if (a.element != b.element || b.z_mm >= a.z_mm + a.length_mm ||
      a.z_mm >= b.z_mm + b.length_mm)
    return false;
  // Flats of one entry may meet in an edge, as those of a hexagon do.
  if (a.entry == b.entry && a.kind == MilledKind::flat) return false;
  const auto of_a = slots_of(d, a), of_b = slots_of(d, b);
  return std::ranges::any_of(of_a, [&](const auto& x) {
    return std::ranges::any_of(
        of_b, [&](const auto& y) { return meet(x, y, d.outer[a.element].left_mm); });
  });
}

// Adds the places of an entry, whose problems are told once.
void add_places(Draft& draft, Reader& r, std::vector<Milled> entry) {
  const auto& drawing = draft.loaded.plan.drawing;
  auto& all = draft.plan().milled;
  bool of_feature = false, of_place = false;
  std::vector<std::string> met;
  for (auto& m : entry) {
    const auto has_id = [&](const auto& x) { return !m.id.empty() && x.id == m.id; };
    of_feature = of_feature || std::ranges::any_of(features(drawing), has_id);
    of_place = of_place || std::ranges::any_of(all, has_id);
    for (const auto& other : all)
      if (places_meet(drawing, m, other) && std::ranges::count(met, other.id) == 0)
        met.push_back(other.id);
    all.push_back(std::move(m));
  }
  if (of_feature) r.problem_at("id", tr("an id no element or face has"), "duplicate");
  if (of_place) r.problem_at("id", tr("an id no other milled place has"), "duplicate");
  if (!met.empty())
    r.problem(say("a place that does not meet {}", fmt::join(met, ", ")), "conflict");
}

// Speeds of the driven spindle, if the machine has one.
Bounds speeds(const Draft& draft) {
  const auto& driven = draft.loaded.plan.machine.driven_tools;
  return driven ? within(driven->n_min_rpm, driven->n_max_rpm, "1/min")
                : above_up_to(0, 1e5, "1/min");
}

void read_given(const Draft& draft, Reader& r, Milled& m) {
  const bool whole = draft.purpose == Purpose::predict;
  if (!whole && !r.has("conditions")) return;
  Reader given = r.object("conditions");
  if (const auto n = given.optional_integer("passes", 1, 1000))
    m.passes = static_cast<int>(*n);
  if (m.kind == MilledKind::flat)
    if (const auto n = given.optional_integer("lanes", 1, 1000))
      m.lanes = static_cast<int>(*n);
  m.n_rpm = given.optional_number("n_rpm", speeds(draft));
  m.fz_mm = given.optional_number("fz_mm", above_up_to(0, 5, "mm"));
  given.finish();
  if (!whole || given.broken()) return;
  for (const auto* key : {"passes", "n_rpm", "fz_mm"})
    if (!given.has(key))
      given.problem_at(key, tr("a value: predict chooses none"), "missing");
  if (m.kind == MilledKind::flat && !given.has("lanes"))
    given.problem_at("lanes", tr("a value: predict chooses none"), "missing");
}

double margin(Draft& draft, Reader& r, const char* key, const Bounds& bounds,
              double fallback, std::string why) {
  if (!r.has(key)) draft.assume(r.pointer_of(key), fallback, std::move(why));
  return r.number_or(key, bounds, fallback);
}

// The places of an entry: at equal angles about the axis, "k1-1", "k1-2" .. if they are
// several.
std::vector<Milled> places(const Milled& first, int count) {
  std::vector<Milled> all(static_cast<std::size_t>(count), first);
  for (int i = 0; count > 1 && i < count; ++i) {
    auto& m = all[static_cast<std::size_t>(i)];
    m.id += '-' + std::to_string(i + 1);
    m.angle_deg += 360.0 * i / count;
  }
  return all;
}

// What a keyway, slot or flat on the outer element `on` has of its own; that is null, and the
// kind not known, where they could not be read.
void read_milled_place(Draft& draft, Reader& r, const part::OuterElement* on,
                       bool kind_known, int count, Milled& m) {
  m.z_mm = r.number("z_mm", within(0, 20000, "mm"));
  m.length_mm = r.number("length_mm", above_up_to(0, 20000, "mm"));
  if (kind_known && m.kind != MilledKind::flat)
    m.width_mm = r.number("width_mm", above_up_to(0, 500, "mm"));
  const bool across =
      kind_known && m.kind == MilledKind::flat && r.has("across_flats_mm");
  m.depth_mm = across && on ? depth_of_flats(r, on->left_mm, count)
               : across     ? 0 * r.number("across_flats_mm", kSize)
                            : r.number("depth_mm", above_up_to(0, 500, "mm"));
  if (!across && on) m.depth_mm += draft.ground(on->id) / 2;  // below the ground rim
  m.corner_mm = r.optional_number("corner_mm", within(0, 250, "mm"));
  if (r.has("tool"))
    m.cutters = {cutter_of(draft.catalogue, r.at("tool"))};
  else if (draft.purpose == Purpose::predict)
    r.problem_at("tool", tr("the id of a milling cutter"), "missing");
  else {
    m.cutters = draft.cutters;
    draft.assume(r.pointer_of("tool"), "any",
                 tr("chosen from the milling cutters there are"));
  }
  m.depth_margin = margin(draft, r, "stability_margin", within(0, 10), kDepthMargin,
                          tr("each pass stays stable when it is deeper by this share"));
  m.speed_margin =
      margin(draft, r, "speed_margin", within(0.005, 0.2), kSpeedMargin,
             tr("each pass stays stable at all speeds slower or faster by this share"));
  read_given(draft, r, m);
}

void read_place(Draft& draft, Reader r, std::size_t entry) {
  r = r.as_object();
  Milled m;
  m.entry = entry;
  m.id = read_id(r);
  const auto before = r.problems().list.size();
  m.kind = r.choice("kind", named({MilledKind::flat, MilledKind::keyway, MilledKind::slot,
                                   MilledKind::cross_hole}));
  const bool kind_known = r.problems().list.size() == before;
  const auto& outer = draft.drawing().outer;
  const auto on = checked_reference(r.at("on", tr("the id of an outer cylinder")),
                                    cylinders(draft.drawing()), tr("an outer cylinder"));
  const auto e = std::find_if(outer.begin(), outer.end(),
                              [&](const auto& x) { return !on.empty() && x.id == on; });
  const auto* element = e == outer.end() ? nullptr : &*e;
  const int count = static_cast<int>(r.optional_integer("count", 1, kPlaces).value_or(1));
  m.angle_deg = r.number_or("angle_deg", within(-360, 360, "deg"), 0);
  const auto setups = static_cast<long>(draft.plan().setups.size());
  const auto setup = r.optional_integer("setup", 0, std::max(setups - 1, long{0}));
  const bool hole = kind_known && m.kind == MilledKind::cross_hole;
  if (hole)
    read_cross_hole(draft, r, element, m);
  else
    read_milled_place(draft, r, element, kind_known, count, m);
  if (!kind_known) return;  // the other keys depend on it
  r.finish();
  if (!element || r.problems().list.size() > before) return;
  m.element = static_cast<std::size_t>(e - outer.begin());
  hole ? check_cross_hole(draft.drawing(), r, m) : check_shape(draft.drawing(), r, m);
  if (setup) m.given_setup = static_cast<std::size_t>(*setup);
  add_places(draft, r, places(m, count));
}

// Machines of the catalogue that mill.
std::string that_mill(const Catalogue& catalogue) {
  std::string list;
  for (const auto& m : catalogue.machines)
    if (m.driven_tools) list += (list.empty() ? "" : ", ") + m.id;
  return list;
}

}  // namespace

void read_milling(Draft& draft) {
  const auto items = draft.root.optional_items("milling", 0, kPlaces);
  if (items.empty()) return;
  const auto& machine = draft.plan().machine;
  if (!machine.id.empty() && !machine.driven_tools) {
    const auto others = that_mill(draft.catalogue);
    draft.root.problem_at(
        "milling",
        others.empty()
            ? say("none: {} has no driven_tools, no machine of the catalogue has",
                  machine.id)
            : say("none: {} has no driven_tools, as {} has", machine.id, others),
        "conflict");
  }
  for (std::size_t i = 0; i < items.size(); ++i) read_place(draft, items[i], i);
  if (draft.plan().milled.size() > kPlaces)
    draft.root.problem_at("milling", say("at most {} places in all", kPlaces), "range");
}

}  // namespace turnwright::document
