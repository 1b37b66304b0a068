#include "milled_shaft.hpp"

#include <cmath>

#include "shaft_fields.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::document {
namespace {

using deflection::Slot;

constexpr std::size_t kSlots = 12;

// Half the angle of a slot at the rim.
double half_opening_rad(const Slot& slot, double outer_mm) {
  return std::asin(slot.width_mm / outer_mm);
}

// Whether the line through one side of slot a separates it from slot b.  In the
// cross-section both are rectangles from their floor to the outer diameter.
bool parts(const Slot& a, const Slot& b, double between_rad, double outer_mm) {
  const auto rim = [&](const Slot& s) {
    return std::sqrt(outer_mm * outer_mm - s.width_mm * s.width_mm) / 2;
  };
  const double cos = std::abs(std::cos(between_rad)), sin = std::sin(between_rad);
  const double middle_a = (rim(a) + a.floor_mm) / 2, deep_a = rim(a) - middle_a;
  const double middle_b = (rim(b) + b.floor_mm) / 2, deep_b = rim(b) - middle_b;
  const double along = std::abs(middle_b * std::cos(between_rad) - middle_a);
  return along >= deep_a + deep_b * cos + b.width_mm / 2 * sin ||
         std::abs(middle_b) * sin >= a.width_mm / 2 + deep_b * sin + b.width_mm / 2 * cos;
}

// Without a width the slot is a flat, as wide as the chord at its floor.
Slot read_slot(Reader r, const part::Segment& s) {
  r = r.as_object();
  const double R = s.outer_left_mm / 2, bore = s.inner_left_mm / 2;
  Slot slot;
  slot.angle_rad =
      units::rad_from_deg(r.number_or("angle_deg", within(-360, 360, "deg"), 0));
  const auto width = r.optional_number("width_mm", above_up_to(0, 2 * R, "mm"));
  const double rim =
      width && *width <= 2 * R ? std::sqrt(R * R - *width * *width / 4) : R;
  slot.floor_mm = r.number("floor_mm", at_least_below(bore, std::max(rim, bore), "mm"));
  slot.width_mm = width.value_or(2 * std::sqrt(R * R - slot.floor_mm * slot.floor_mm));
  r.finish();
  return slot;
}

// Subtracts the slots of a cylinder with a wall from its section.
void read_slots(Reader& r, const part::Segment& s, deflection::Section& section) {
  std::vector<Slot> slots;
  for (const Reader& item : r.items("slots", 1, kSlots)) {
    const auto before = item.problems().list.size();
    const Slot slot = read_slot(item, s);
    if (item.problems().list.size() > before) continue;
    for (const Slot& other : slots)
      if (meet(slot, other, s.outer_left_mm))
        item.problem(tr("a slot that does not meet another"), "conflict");
    slots.push_back(slot);
    section = deflection::without_slot(section, s.outer_left_mm, slot);
  }
}

}  // namespace

bool meet(const Slot& a, const Slot& b, double outer_mm) {
  const double between =
      std::abs(std::remainder(a.angle_rad - b.angle_rad, 2 * units::kPi));
  return between <= half_opening_rad(a, outer_mm) + half_opening_rad(b, outer_mm) ||
         !(parts(a, b, between, outer_mm) || parts(b, a, between, outer_mm));
}

ReadShaft read_milled_shaft(Reader r) {
  ReadShaft out;
  MilledShaft milled;
  bool any = false, cones = false;
  out.shaft = read_shaft(r, [&](Reader& segment, const part::Segment& s) {
    const bool cylinder =
        s.outer_left_mm == s.outer_right_mm && s.inner_left_mm == s.inner_right_mm;
    const bool wall =
        s.outer_left_mm > s.inner_left_mm;  // read_shaft reports a missing wall
    deflection::Stretch stretch{s.length_mm, {}};
    if (wall)
      stretch.section = deflection::round_section(s.outer_left_mm, s.inner_left_mm);
    if (segment.has("slots")) {
      any = true;
      if (!cylinder)
        segment.problem_at("slots", tr("slots in a cylinder"), "conflict");
      else if (wall)
        read_slots(segment, s, stretch.section);
    } else {
      cones = cones || !cylinder;
    }
    milled.push_back(stretch);
  });
  if (!any) return out;
  if (cones)
    r.problem_at("segments",
                 tr("cylinders alone: slots are read on a shaft without cones"),
                 "conflict");
  out.milled = std::move(milled);
  return out;
}

}  // namespace turnwright::document
