#include "siemens_cycles.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "cycles.hpp"
#include "expression.hpp"
#include "siemens_statements.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::review {
namespace {

using Kind = toolpath::Move::Kind;

constexpr double kSetBack_mm = 0.6;  // before the depth reached, of holes up to 30 mm
constexpr double kDeep_mm = 30;
constexpr double kDeepShare = 1.0 / 50;  // of the depth of deeper ones
constexpr double kMostBack_mm = 7;
constexpr double kBreak_mm = 1;  // back to break chips
constexpr double kOut_mm = 1;    // from a thread
constexpr double kMostThreadCuts = 200;

// The values of a call, from 1 as manuals count them.
class Call {
 public:
  Call(const Parameters& parameters, std::string_view bracketed)
      : parameters_(parameters), texts_(texts_of_arguments(bracketed)) {}

  bool given(std::size_t i) const { return i <= texts_.size() && !texts_[i - 1].empty(); }
  double at(std::size_t i) const {
    return given(i) ? value_of(texts_[i - 1], parameters_).value_or(0) : 0;
  }
  std::string_view text(std::size_t i) const {
    return given(i) ? std::string_view(texts_[i - 1]) : std::string_view();
  }

 private:
  const Parameters& parameters_;
  std::vector<std::string> texts_;
};

// Back to, from, bottom: of RTP, RFP, SDIS, DP, DPR.
DrillCycle hole(const ModalState& s, const Call& c) {
  DrillCycle d;
  d.away_z_mm = s.mm(c.at(1));
  const double surface = s.mm(c.at(2));
  const double bottom = c.given(4) ? s.mm(c.at(4)) : surface - s.mm(std::abs(c.at(5)));
  d.from_z_mm = surface + std::copysign(s.mm(c.at(3)), surface - bottom);
  d.strokes_z_mm = {bottom};
  return d;
}

double minutes(double seconds) { return seconds / 60; }

void deep_hole(ModalState& s, const Call& c) {
  auto d = hole(s, c);
  const double bottom = d.strokes_z_mm.front(), surface = s.mm(c.at(2));
  const double first = c.given(6)   ? std::abs(s.mm(c.at(6)) - d.from_z_mm)
                       : c.given(7) ? s.mm(c.at(7)) + std::abs(d.from_z_mm - surface)
                                    : std::abs(bottom - d.from_z_mm);
  const double less = c.at(8),
               least = c.given(14) ? s.mm(c.at(14)) : s.mm(std::max(less, 0.0));
  const auto next = [&](double before) {
    const double one = less < 0 ? -less * before : before - s.mm(less);
    return less == 0 ? before : std::max(one, least);
  };
  d.strokes_z_mm = strokes(d.from_z_mm, bottom, first, next);
  d.wait_bottom_min = minutes(c.at(9));
  d.wait_top_min = minutes(c.at(10));
  d.first_feed_share = c.at(11) > 0 ? c.at(11) : 1;
  d.clears = c.at(12) == 1;
  d.retract_mm = c.at(15) > 0 ? s.mm(c.at(15)) : kBreak_mm;
  const double depth = std::abs(bottom - surface);
  d.before_mm = c.at(17) > 0        ? s.mm(c.at(17))
                : depth <= kDeep_mm ? kSetBack_mm
                                    : std::min(kMostBack_mm, depth * kDeepShare);
  drill_cycle(s, d);
}

void tap(ModalState& s, const Call& c, double lead, double speed) {
  const auto d = hole(s, c);
  const double S = s.S;
  const auto S_line = s.S_line;
  const bool surface_speed = std::exchange(s.surface_speed, false);
  if (speed > 0) s.S = speed, s.S_line = 0;
  if (s.x_mm && s.z_mm) s.straight(Kind::rapid, s.x_mm, d.from_z_mm);
  tap_cycle(s, d.from_z_mm, d.strokes_z_mm.front(), lead);
  s.S = S;
  s.S_line = S_line;
  s.surface_speed = surface_speed;
  s.straight(Kind::rapid, s.x_mm, d.away_z_mm);
}

void bore_out(ModalState& s, const Call& c) {
  auto d = hole(s, c);
  d.wait_bottom_min = minutes(c.at(6));
  const double F = s.F;
  const auto F_line = s.F_line;
  if (c.at(7) > 0) s.F = s.mm(c.at(7)), s.F_line = 0;
  d.feed_out = c.at(8) > 0 ? s.mm(c.at(8)) : s.F;
  drill_cycle(s, d);
  s.F = F;
  s.F_line = F_line;
}

void drill(ModalState& s, std::string_view name, const Call& c) {
  if (name == "cycle83") return deep_hole(s, c);
  if (name == "cycle85") return bore_out(s, c);
  if (name == "cycle84") return tap(s, c, s.mm(std::abs(c.at(9))), c.at(11));
  if (name == "cycle840") {
    const double of_feed = s.per_revolution ? s.F : s.S > 0 ? s.F / s.S : 0;
    return tap(s, c, c.given(11) ? s.mm(std::abs(c.at(11))) : of_feed, 0);
  }
  auto d = hole(s, c);
  d.wait_bottom_min = name == "cycle82" ? minutes(c.at(6)) : 0;
  drill_cycle(s, d);
}

void stock_removal(ModalState& s, const Call& c,
                   const SiemensCycles::ContourOf& contour_of) {
  auto name = c.text(1);
  if (name.size() > 1 && name.starts_with('"') && name.ends_with('"'))
    name = name.substr(1, name.size() - 2);
  const auto contour = contour_of(name);
  if (!contour) throw NotFollowed(tr("The contour of CYCLE95 is not in the text."));
  const double kind = std::fmod(c.at(9), 100);
  if (!(kind >= 1 && kind <= 12 && kind == std::floor(kind)))
    throw NotFollowed(tr("CYCLE95 has the kinds 1 to 12."));
  const int what = static_cast<int>(kind) - 1;
  StockRemoval r;
  r.depth_mm = s.mm(c.at(2));
  r.left_z_mm = s.mm(c.at(3));
  r.left_x_mm = s.mm(c.at(4));
  r.left_mm = s.mm(c.at(5));
  r.rough_feed = s.mm(c.at(6));
  r.finish_feed = s.mm(c.at(8));
  if (c.at(12) > 0) r.retract_mm = s.mm(c.at(12));
  r.roughs = what < 4 || what >= 8;
  r.finishes = what >= 4;
  r.corners = c.at(9) < 200;
  r.inside = what % 4 >= 2;
  remove_stock(s, *contour, r, what % 2 == 0 ? RoughingAlong::z : RoughingAlong::x);
}

void thread(ModalState& s, const Call& c) {
  const double lead = s.mm(c.at(1)), half = s.diameter ? 0.5 : 1;
  const double kind = c.at(15), cuts = std::floor(c.at(13)), idle = std::floor(c.at(14));
  const double starts = std::max(1.0, std::floor(c.at(16)));
  if (!(lead > 0) ||
      !(cuts >= 0 && idle >= 0 && (cuts + idle + 1) * starts <= kMostThreadCuts) ||
      !(kind >= 1 && kind <= 4))
    throw NotFollowed(
        tr("CYCLE97 is followed with PIT, up to 200 cuts and the kinds 1 to 4."));
  const double begin = s.mm(c.at(3)), end = s.mm(c.at(4));
  const double leftwards = end < begin ? -1 : 1;
  const double z0 = begin - leftwards * s.mm(c.at(7)),
               z1 = end + leftwards * s.mm(c.at(8));
  const double inwards = kind == 1 || kind == 3 ? -1 : 1;
  const double r1 = half * s.mm(c.at(5)), r2 = half * s.mm(c.at(6));
  // The radius of the thread's surface at a place.
  const auto surface = [&](double z) {
    return r1 + (r2 - r1) * (end != begin ? (z - begin) / (end - begin) : 0);
  };
  const double out = c.at(17) > 0 ? s.mm(c.at(17)) : kOut_mm;
  const double away = surface(z0) - inwards * out, away1 = surface(z1) - inwards * out;
  const auto cut = [&](double depth) {
    s.straight(Kind::rapid, surface(z0) + inwards * depth, z0);
    s.thread(surface(z1) + inwards * depth, z1, lead);
    s.straight(Kind::rapid, away1, z1);
    s.straight(Kind::rapid, away, z0);
  };
  const double whole = s.mm(c.at(9)), last = s.mm(c.at(10));
  s.straight(Kind::rapid, away, z0);
  for (double start = 0; start < starts; ++start) {
    for (double k = 1; k <= cuts; ++k)
      cut((whole - last) * (kind >= 3 ? std::sqrt(k / cuts) : k / cuts));
    if (last > 0 || cuts == 0) cut(whole);
    for (double k = 0; k < idle; ++k) cut(whole);
  }
}

}  // namespace

bool SiemensCycles::knows(std::string_view text) {
  constexpr std::string_view kCycles[] = {"cycle81",  "cycle82", "cycle83", "cycle84",
                                          "cycle840", "cycle85", "cycle95", "cycle97"};
  const auto [name, rest] = name_at_front(text);
  const auto close = rest.find_last_of(')');
  return std::ranges::find(kCycles, name) != std::end(kCycles) && rest.starts_with('(') &&
         close != rest.npos && siemens_statement_of(rest.substr(close + 1)).empty();
}

void SiemensCycles::take(ModalState& s, const Parameters& parameters,
                         std::string_view text, const ContourOf& contour_of) {
  const auto [name, rest] = name_at_front(text);
  const Call call(parameters, rest);
  if (name == "cycle95")
    stock_removal(s, call, contour_of);
  else if (name == "cycle97")
    thread(s, call);
  else
    drill(s, name, call);
}

}  // namespace turnwright::review
