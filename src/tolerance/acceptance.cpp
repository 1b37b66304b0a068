#include "turnwright/tolerance/acceptance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/say.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::tolerance {
namespace {

using Kind = part::ToleranceKind;
using Rule = part::ToleranceRule;

Rule rule_of(const Case& c) {
  const auto& facts = part::facts(c.kind);
  return c.controlled == Controlled::axis ? facts.rule_of_axis() : facts.rule;
}

void require(bool holds, const char* what) {
  if (!holds) throw std::domain_error(fmt::format("acceptance: {}", what));
}

void check_case(const Case& c, Rule rule) {
  if (rule == Rule::size) {
    require(c.limits.has_value(), "a diameter or length needs its limits");
    require(std::isfinite(c.limits->lower_mm) && std::isfinite(c.limits->upper_mm) &&
                c.limits->lower_mm < c.limits->upper_mm,
            "the lower limit must lie below the upper one");
  } else {
    require(std::isfinite(c.value_mm) && c.value_mm > 0, "the zone must be wider than 0");
  }
  require(c.half_angle_rad >= 0 && c.half_angle_rad < units::kPi / 2,
          "the half angle must lie in [0, 90) deg");
  require(std::isfinite(c.machine_mm) && c.machine_mm >= 0,
          "the machine's terms must not be negative");
}

double um(double mm) { return units::um_from_mm(mm); }

/// Last step of a verdict: the sentence that gives the reason, and the verdicts that
/// follow from the margins.
void conclude(Verdict& v, double guard_mm, const std::string& found, bool offset_helps) {
  v.accepted = v.margin_mm >= -guard_mm;
  v.accepted_after_offset = v.accepted || v.margin_after_offset_mm >= -guard_mm;
  v.why = found;
  if (v.accepted)
    v.why += say(": conforms, {:.2f} um to spare", um(std::max(v.margin_mm, 0.0)));
  else if (!offset_helps)
    v.why +=
        say(": {:.2f} um too much, and no constant offset changes it", um(-v.margin_mm));
  else if (v.accepted_after_offset)
    v.why += say(": {:.2f} um outside; an offset of {:+.2f} um brings it inside",
                 um(-v.margin_mm), um(v.offset_into_limits_mm));
  else
    v.why += say(
        ": {:.2f} um outside; the best offset, {:+.2f} um, leaves it {:.2f} um too wide",
        um(-v.margin_mm), um(v.offset_into_limits_mm), um(-v.margin_after_offset_mm));
}

/// Eqs. (1)-(3).
void judge_size(const Case& c, const Extremes& e, double guard_mm, Verdict& v) {
  const bool diameter = c.kind == Kind::diameter;
  const double per = diameter ? 2 : 1;  // size per unit of e
  const auto [l, u] = *c.limits;
  double low = per * e.min_mm, high = per * e.max_mm;
  const double spread = high - low;
  if (diameter && c.envelope == Envelope::shaft) high += c.machine_mm;  // Eq. (3)
  if (diameter && c.envelope == Envelope::bore) low -= c.machine_mm;    // Eq. (3)
  v.measured_mm = high - low;
  v.allowed_mm = u - l;
  v.margin_mm = std::min(u - high, low - l);  // Eqs. (1), (2)
  v.room_mm = {l - low - guard_mm, u - high + guard_mm};
  v.margin_after_offset_mm = v.allowed_mm - v.measured_mm;
  v.offset_into_limits_mm = (u + l - high - low) / (2 * per);
  v.published_verdict =
      spread <= v.allowed_mm + guard_mm;  // [Valino 2008] Eqs. (11), (15)
  conclude(v, guard_mm,
           say("{} deviates by {:+.2f} to {:+.2f} um, limits {:+.2f} to {:+.2f} um",
               c.kind == Kind::length         ? tr("length")
               : c.envelope == Envelope::none ? tr("diameter")
                                              : tr("diameter with envelope"),
               um(low), um(high), um(l), um(u)),
           true);
}

/// Eqs. (4)-(9).
void judge_zone(const Case& c, Rule rule, const Extremes& e, double guard_mm,
                Verdict& v) {
  const double range = e.max_mm - e.min_mm, t = c.value_mm;
  const double cosine = std::cos(c.half_angle_rad);
  const double largest = std::max(std::abs(e.min_mm), std::abs(e.max_mm));
  v.allowed_mm = t;
  std::string found;
  double without_offset = 0, with_offset = 0;
  switch (rule) {
    case Rule::range:  // Eq. (4)
      without_offset = with_offset = range;
      found = tr("peak to valley {:.2f} um of {:.2f} um");
      break;
    case Rule::runout:  // Eq. (5)
      without_offset = with_offset = range + c.machine_mm;
      found = tr("peak to valley and machine {:.2f} um of {:.2f} um");
      break;
    case Rule::straightness:  // Eq. (6)
      without_offset = with_offset = minimum_zone(c.e_mm).width_mm;
      guard_mm += 2e-12 * with_offset;
      found = tr("minimum zone {:.2f} um of {:.2f} um");
      break;
    case Rule::profile:  // Eq. (7)
      without_offset = 2 * largest * cosine;
      with_offset = range * cosine;
      found = tr("zone about the nominal surface {:.2f} um of {:.2f} um");
      break;
    case Rule::floating_profile:  // Eq. (8)
      without_offset = with_offset = range * cosine;
      found = tr("zone normal to the surface {:.2f} um of {:.2f} um");
      break;
    case Rule::size:     // judge_size has it
    case Rule::machine:  // Eq. (9)
      without_offset = with_offset = c.machine_mm;
      found =
          tr("the cut's deflection has no part in it, machine and chucking {:.2f} um of "
             "{:.2f} um");
  }
  v.measured_mm = without_offset;
  v.margin_mm = t - without_offset;
  v.margin_after_offset_mm = t - with_offset;
  v.offset_into_limits_mm = v.offset_mm;
  v.room_mm = rule == Rule::profile ? Extremes{-t / 2 - e.min_mm * cosine - guard_mm,
                                               t / 2 - e.max_mm * cosine + guard_mm}
                                    : Extremes{-std::numeric_limits<double>::infinity(),
                                               v.margin_mm + guard_mm};
  conclude(v, guard_mm, fmt::format(fmt::runtime(found), um(v.measured_mm), um(t)),
           rule == Rule::profile);
  if (rule == Rule::range || rule == Rule::runout)
    v.published_verdict =
        range <= t + guard_mm;  // [Valino 2008] Eqs. (16), (19), (23), (24)
  else if (rule == Rule::profile)
    v.published_verdict = std::abs(e.max_mm) + std::abs(e.min_mm) <=
                          t / cosine + guard_mm;  // [Valino 2008] Eq. (22)
  else
    v.published_verdict = v.accepted;
}

}  // namespace

bool counts_deflection(const Case& c) { return rule_of(c) != Rule::machine; }

bool counts_machine(const Case& c) {
  const Rule rule = rule_of(c);
  return rule == Rule::machine || rule == Rule::runout ||
         (c.kind == Kind::diameter && c.envelope != Envelope::none);
}

Verdict verdict(const Case& c) {
  const Rule rule = rule_of(c);
  check_case(c, rule);
  if (rule != Rule::machine) require(!empty(c.e_mm), "the feature's error is missing");
  Extremes e;
  double largest = c.machine_mm + c.value_mm;
  if (c.limits) largest += std::abs(c.limits->lower_mm) + std::abs(c.limits->upper_mm);
  const auto add = [&](const Profile& profile) {
    const auto [low, high] = extremes(profile);
    e.min_mm += low;
    e.max_mm += high;
    largest += magnitude_mm(profile);
  };
  if (!empty(c.e_mm)) add(c.e_mm);
  if (c.kind == Kind::length && !empty(c.other_mm)) add(c.other_mm);
  const double guard_mm = 8 * std::numeric_limits<double>::epsilon() * largest;
  // 0 - x, so that no error gives 0 and not -0.
  Verdict v{.offset_mm = 0 - 0.5 * (e.min_mm + e.max_mm), .extremes_mm = e, .why = {}};
  if (rule == Rule::size)
    judge_size(c, e, guard_mm, v);
  else
    judge_zone(c, rule, e, guard_mm, v);
  return v;
}

}  // namespace turnwright::tolerance
