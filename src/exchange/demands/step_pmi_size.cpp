#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "base/say.hpp"
#include "exchange/text/thread_words.hpp"
#include "step_pmi_place.hpp"

namespace turnwright::exchange {
namespace {

constexpr double kSame_mm = 1e-6;  // sizes that differ by less are one, converters round
constexpr double kLargest_mm = 100;  // a deviation, as the part document has it

std::string described_size(const Dimension& d) {
  auto text = d.name.empty() ? tr("size") : d.name;
  if (d.nominal_mm) text += fmt::format(" {} mm", *d.nominal_mm);
  if (!d.fit.empty())
    text += " " + d.fit;
  else if (d.limits)
    text += fmt::format(" {:+}/{:+} mm", d.limits->upper_mm, d.limits->lower_mm);
  if (!d.notes.empty()) text += fmt::format(" ({})", fmt::join(d.notes, ", "));
  return text;
}

void leave_size_out(const Dimension& d, const std::string& reason, Outline& outline) {
  outline.ignored.push_back(
      {d.at, say("The {} is left out: {}.", described_size(d), reason)});
}

// Basic and reference sizes, and those without a tolerance, say what the shape says.
bool is_plain(const Dimension& d) {
  if (!d.limits && d.fit.empty()) return true;
  for (const auto& note : d.notes)
    if (note == "theoretical" || note == "auxiliary") return true;
  return false;
}

// Limits about the modelled size.  Nothing if the dimension cannot be meant of it.
std::optional<part::Limits> limits_about(double model_mm, const Dimension& d) {
  const double off = d.nominal_mm ? *d.nominal_mm - model_mm : 0;
  if (std::abs(off) <= kSame_mm) return d.limits;
  const part::Limits moved{d.limits->lower_mm + off, d.limits->upper_mm + off};
  if (!(moved.lower_mm <= kSame_mm && moved.upper_mm >= -kSame_mm)) return std::nullopt;
  return moved;
}

// Why limits have no place in a part document; "" if they have.
std::string refusal(const part::Limits& limits) {
  if (!(limits.lower_mm < limits.upper_mm)) return tr("its limits leave no width");
  if (!(limits.lower_mm >= -kLargest_mm && limits.upper_mm <= kLargest_mm))
    return tr("its limits are more than 100 mm off the nominal size");
  return "";
}

std::string other_size(double model_mm, const Dimension& d) {
  return say("the shape has {} mm there, not {} mm", model_mm, *d.nominal_mm);
}

std::optional<part::Limits> checked_limits(double model_mm, const Dimension& d,
                                           Outline& outline) {
  const auto limits = limits_about(model_mm, d);
  const auto reason = limits ? refusal(*limits) : other_size(model_mm, d);
  if (reason.empty()) return limits;
  leave_size_out(d, reason, outline);
  return std::nullopt;
}

void demand_of_diameter(const Dimension& d, const Place& place, Outline& outline) {
  auto& e = (place.inner ? outline.inner : outline.outer)[place.index];
  if (e.shape != Shape::cylinder && e.shape != Shape::groove)
    return leave_size_out(d, say("{} has no single diameter", e.id), outline);
  if (e.demands.fit || e.demands.limits)
    return leave_size_out(d, say("{} has a tolerance already", e.id), outline);
  if (d.fit.empty()) {
    const auto limits = checked_limits(e.left_mm, d, outline);
    if (limits && !(e.left_mm + limits->lower_mm > 0))
      return leave_size_out(d, tr("its limits leave no diameter"), outline);
    e.demands.limits = limits;
    return;
  }
  const bool hole = d.fit[0] >= 'A' && d.fit[0] <= 'Z';
  if (hole != place.inner)
    return leave_size_out(d, tr("a capital letter is of a bore, a small one of a shaft"),
                          outline);
  if (d.nominal_mm && !(std::abs(*d.nominal_mm - e.left_mm) <= kSame_mm))
    return leave_size_out(d, other_size(e.left_mm, d), outline);
  e.demands.fit = d.fit;
}

void demand_of_length(const Dimension& d, Place a, Place b, const Places& places,
                      Outline& outline) {
  if (a.id == b.id) return leave_size_out(d, say("both ends are {}", a.id), outline);
  if (!d.limits) return leave_size_out(d, tr("a fit is of a diameter"), outline);
  if (places.z_mm(b) < places.z_mm(a)) std::swap(a, b);
  const auto limits = checked_limits(places.z_mm(b) - places.z_mm(a), d, outline);
  if (!limits) return;
  outline.tolerances.push_back({.id = fmt::format("t{}", outline.tolerances.size() + 1),
                                .kind = part::ToleranceKind::length,
                                .of = "",
                                .datum = "",
                                .between = {a.id, b.id},
                                .value_mm = limits->upper_mm - limits->lower_mm,
                                .limits = limits});
}

// The planes between which a dimension is: of a location one at each end.
std::vector<Place> ends_of_size(const Dimension& d, const Places& places) {
  auto all = places.of(d.of);
  if (!d.to) return all;
  const auto more = places.of(*d.to);
  if (all.size() != 1 || more.size() != 1) return {};
  all.push_back(more.front());
  return all;
}

// "M24x1.5-6g" or "1/2-13 UNC" as a note of a diameter.
std::optional<notated::Thread> thread_of(const Dimension& d) {
  for (const auto& note : d.notes)
    if (const auto found = notated::thread(note)) return found;
  return std::nullopt;
}

void make_thread(const Dimension& d, const notated::Thread& t, const Places& places,
                 Outline& outline) {
  const auto of = places.of(d.of);
  if (of.size() != 1 || of[0].kind != PlaceKind::cylinder)
    return leave_size_out(d, tr("a thread is of one cylinder"), outline);
  auto& e = (of[0].inner ? outline.inner : outline.outer)[of[0].index];
  if (!(std::abs(e.left_mm - t.d_mm) <= kSame_mm))
    return leave_size_out(d, say("{} has a diameter of {} mm", e.id, e.left_mm), outline);
  e.shape = Shape::thread;
  e.left_mm = e.right_mm = t.d_mm;
  e.pitch_mm = t.pitch_mm;
  if (!t.tolerance_class.empty()) e.demands.fit = t.tolerance_class;
}

bool has_modifier(const Dimension& d) { return !d.notes.empty(); }

void demand_of_size(const Dimension& d, const Places& places, Outline& outline) {
  if (has_modifier(d))
    return leave_size_out(d, tr("a part document has no such modifier"), outline);
  if (!d.to && d.name.find("radius") != std::string::npos)
    return leave_size_out(
        d, tr("a part document has tolerances of diameters, not of radii"), outline);
  const auto between = ends_of_size(d, places);
  if (between.size() == 2 && between[0].is_face() && between[1].is_face())
    return demand_of_length(d, between[0], between[1], places, outline);
  if (d.to)
    return leave_size_out(d, tr("it is not between two faces of the outline"), outline);
  const auto of = places.of(d.of);
  if (of.empty())
    return leave_size_out(d, tr("its feature is not in the outline"), outline);
  for (const auto& place : of)
    if (place.is_element())
      demand_of_diameter(d, place, outline);
    else
      leave_size_out(d, say("{} is {}", place.id, tr(name(place.kind))), outline);
}

void tell_plain(std::size_t count, Outline& outline) {
  if (count == 0) return;
  outline.ignored.push_back(
      {"",
       count == 1
           ? say("{} dimension is without a tolerance: the shape has the size.", count)
           : say("{} dimensions are without a tolerance: the shape has the size.",
                 count)});
}

}  // namespace

void add_sizes(const Pmi& pmi, const Places& places, Outline& outline) {
  std::size_t plain = 0;
  for (const auto& d : pmi.dimensions)
    if (const auto thread = thread_of(d))
      make_thread(d, *thread, places, outline);
    else if (is_plain(d))
      ++plain;
    else
      demand_of_size(d, places, outline);
  tell_plain(plain, outline);
}

}  // namespace turnwright::exchange
