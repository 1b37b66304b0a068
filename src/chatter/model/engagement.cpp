#include "engagement.hpp"

#include <algorithm>
#include <cmath>

#include "periodic.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::chatter {
namespace {

using units::kPi;

constexpr double kSame = 1e-11;  // rad: rounding of angles

double sinc(double x) { return std::abs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x; }

void sort_unique(std::vector<double>& values, double apart = kSame) {
  std::ranges::sort(values);
  const auto same = [apart](double a, double b) { return b - a < apart; };
  values.erase(std::unique(values.begin(), values.end(), same), values.end());
}

/// Integrals over the height of a part of an edge: 1, cos phi, sin phi and their squares.
struct Heights {
  double one, c, s, cc, sc, ss;
};

Heights heights(double depth, double middle, double width) {
  const double twice = depth * sinc(width), once = depth * sinc(width / 2);
  const double c2 = twice * std::cos(2 * middle), s2 = twice * std::sin(2 * middle);
  return {depth,  once * std::cos(middle), once * std::sin(middle), (depth + c2) / 2,
          s2 / 2, (depth - c2) / 2};
}

/// (4) of system.hpp.
void add(Directional& to, const LinearForce& k, const Heights& h) {
  to.xx += k.Kt_MPa * h.sc + k.Kn_MPa * h.ss;
  to.xy += k.Kt_MPa * h.cc + k.Kn_MPa * h.sc;
  to.yx += -k.Kt_MPa * h.ss + k.Kn_MPa * h.sc;
  to.yy += -k.Kt_MPa * h.sc + k.Kn_MPa * h.cc;
}

}  // namespace

double lag_rad_mm(const Cutter& cutter) {
  if (!(cutter.helix_rad > 0)) return 0;
  return 2 * std::tan(cutter.helix_rad) / cutter.diameter_mm;
}

double flank_damping_N_s_mm2(const Cutter& cutter, double n_rpm) {
  if (!(cutter.indentation_N_mm > 0)) return 0;
  return cutter.indentation_N_mm / (kPi * cutter.diameter_mm * n_rpm / 60);
}

CutterEngagement::CutterEngagement(const Cutter& cutter, double n_rpm, double ap_mm)
    : cutter_(cutter),
      ap_(ap_mm),
      lag_(lag_rad_mm(cutter)),
      period_(cutter.by_revolution() ? 2 * kPi : 2 * kPi / cutter.system.teeth) {
  const auto teeth = static_cast<std::size_t>(cutter.system.teeth);
  pitch_ = cutter.pitch_rad;
  if (pitch_.empty()) pitch_.assign(teeth, 2 * kPi / cutter.system.teeth);
  place_.assign(teeth, 0);
  for (std::size_t j = 1; j < teeth; ++j) place_[j] = place_[j - 1] - pitch_[j];
  const double normal = flank_damping_N_s_mm2(cutter, n_rpm);
  damping_ = {.Kt_MPa = cutter.friction * normal, .Kn_MPa = normal};
  for (std::size_t j = 0; j < teeth; ++j) enter_segments(j);
}

std::size_t CutterEngagement::delay_of(double angle) {
  for (std::size_t i = 0; i < delays_.size(); ++i)
    if (std::abs(delays_[i] - angle) < kSame) return i;
  delays_.push_back(angle);
  return delays_.size() - 1;
}

void CutterEngagement::enter_segments(std::size_t tooth) {
  const System& system = cutter_.system;
  const std::size_t teeth = pitch_.size();
  const double by_angle = cutter_.feed_mm * system.teeth / (2 * kPi);
  if (cutter_.offset_mm.empty()) {
    segments_.push_back({.tooth = tooth,
                         .begin = system.entry_rad,
                         .end = system.exit_rad,
                         .delay = delay_of(pitch_[tooth]),
                         .feed_mm = by_angle * pitch_[tooth],
                         .gap_mm = 0});
    return;
  }
  std::vector<Segment> met;  // one for every l of (3)
  std::vector<double> turned;
  double angle = 0;
  for (std::size_t l = 1; l <= teeth; ++l) {
    angle += pitch_[(tooth + teeth - (l - 1)) % teeth];
    const double gap = cutter_.offset_mm[tooth] -
                       (l == teeth ? cutter_.offset_mm[tooth]
                                   : cutter_.offset_mm[(tooth + teeth - l) % teeth]);
    turned.push_back(angle);
    met.push_back({tooth, 0, 0, 0, by_angle * angle, gap});
  }
  std::vector<double> borders{system.entry_rad, system.exit_rad};
  const auto border = [&](double feed, double gap) {
    const double s = -gap / feed;
    if (!(s >= 0 && s <= 1)) return;
    for (const double phi : {std::asin(s), kPi - std::asin(s)})
      if (phi > system.entry_rad && phi < system.exit_rad) borders.push_back(phi);
  };
  for (std::size_t i = 0; i < teeth; ++i) {
    leave_if_asked();
    border(met[i].feed_mm, met[i].gap_mm);
    for (std::size_t k = 0; k < i; ++k)
      border(met[i].feed_mm - met[k].feed_mm, met[i].gap_mm - met[k].gap_mm);
  }
  sort_unique(borders);
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    const double s = std::sin((borders[i] + borders[i + 1]) / 2);
    const auto chip = [&](const Segment& m) { return m.feed_mm * s + m.gap_mm; };
    const auto least = std::ranges::min_element(met, {}, chip);
    if (!(chip(*least) > 0)) continue;
    Segment segment = *least;
    segment.begin = borders[i];
    segment.end = borders[i + 1];
    segment.delay = delay_of(turned[static_cast<std::size_t>(least - met.begin())]);
    segments_.push_back(segment);
  }
}

template <class F>
void CutterEngagement::for_each_met(double angle, F visit) const {
  for (const Segment& segment : segments_) {
    const double phi = angle + place_[segment.tooth], low = phi - lag_ * ap_;
    // The edge spans the angles from `low` to `phi`; k are the numbers of whole turns that,
    // subtracted, bring a part of it into the segment.
    const auto turns = [](double span) { return span / (2 * kPi); };
    const double first = std::ceil(turns(low - segment.end)),
                 last = std::floor(turns(phi - segment.begin));
    const auto meet = [&](double k) {
      const double turn = 2 * kPi * k;
      if (lag_ == 0) return visit(segment, Met{ap_, phi - turn, 0});
      const double from = std::max(segment.begin, low - turn),
                   to = std::min(segment.end, phi - turn);
      if (to > from) visit(segment, Met{(to - from) / lag_, (from + to) / 2, to - from});
    };
    // Those that fill the segment are alike.
    double whole = std::ceil(turns(low - segment.begin)),
           beyond = std::floor(turns(phi - segment.end)) + 1;
    if (lag_ == 0 || beyond - whole <= 1) whole = beyond = last + 1;
    for (double k = first; k < whole; ++k) meet(k);
    const double width = segment.end - segment.begin;
    if (beyond > whole)
      visit(segment, Met{(beyond - whole) * width / lag_,
                         (segment.begin + segment.end) / 2, width});
    for (double k = beyond; k <= last; ++k) meet(k);
  }
}

Load CutterEngagement::load(double angle_rad) const {
  Load out{.regenerative = std::vector<Directional>(delays_.size()), .damping = {}};
  if (const auto* constant = std::get_if<ConstantForce>(&cutter_.system.force)) {
    out.regenerative[0].xx = ap_ * constant->K_MPa;
    out.damping.xx = ap_ * damping_.Kn_MPa;
    return out;
  }
  const auto& k = std::get<LinearForce>(cutter_.system.force);
  for_each_met(angle_rad, [&](const Segment& segment, const Met& met) {
    const Heights h = heights(met.depth_mm, met.middle_rad, met.width_rad);
    add(out.regenerative[segment.delay], k, h);
    add(out.damping, damping_, h);
    const double f = segment.feed_mm, gap = segment.gap_mm;
    out.fed_x_N -=
        f * (k.Kt_MPa * h.sc + k.Kn_MPa * h.ss) + gap * (k.Kt_MPa * h.c + k.Kn_MPa * h.s);
    out.fed_y_N -= f * (-k.Kt_MPa * h.ss + k.Kn_MPa * h.sc) +
                   gap * (-k.Kt_MPa * h.s + k.Kn_MPa * h.c);
  });
  return out;
}

bool CutterEngagement::cuts(double angle_rad) const {
  if (std::holds_alternative<ConstantForce>(cutter_.system.force)) return true;
  bool any = false;
  for_each_met(angle_rad, [&](const Segment&, const Met&) { any = true; });
  return any;
}

std::vector<Passage> CutterEngagement::passages(double phi_rad, double z_mm) const {
  std::vector<Passage> out;
  for (std::size_t j = 0; j < place_.size(); ++j)
    out.push_back({phi_rad - place_[j] + lag_ * z_mm,
                   cutter_.offset_mm.empty() ? 0 : cutter_.offset_mm[j]});
  return out;
}

std::vector<double> CutterEngagement::ends() const {
  std::vector<double> out;
  if (std::holds_alternative<ConstantForce>(cutter_.system.force)) return out;
  for (const Segment& segment : segments_)
    for (const double end : {segment.begin, segment.end})
      out.push_back(remainder_of(end - place_[segment.tooth], period_));
  sort_unique(out);
  return out;
}

std::vector<double> CutterEngagement::breaks() const {
  std::vector<double> out = ends();
  const std::size_t n = out.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (lag_ > 0) {
      out.push_back(remainder_of(out[i] + lag_ * ap_, period_));
      continue;
    }
    for (const double delay : delays_)
      out.push_back(remainder_of(out[i] + delay, period_));
  }
  out.insert(out.end(), {0.0, period_});
  sort_unique(out);
  return out;
}

std::vector<double> kinks_mm(const Cutter& cutter, double n_rpm, double ap_max_mm) {
  if (!(cutter.helix_rad > 0)) return {};
  constexpr std::size_t kMost = 40;  // with more the depths are too close to each other
  constexpr std::size_t kKept = 4096;
  std::vector<double> out;
  const auto too_many = [&] {
    sort_unique(out, 1e-9 * ap_max_mm);
    return out.size() > kMost;
  };
  const double lag = lag_rad_mm(cutter);
  const CutterEngagement contact(cutter, n_rpm, ap_max_mm);
  const std::vector<double> ends = contact.ends();
  for (const double a : ends) {
    leave_if_asked();
    for (const double b : ends) {
      double apart = remainder_of(a - b, contact.period_rad());
      if (apart < kSame) apart = contact.period_rad();
      for (; apart < lag * ap_max_mm; apart += contact.period_rad()) {
        out.push_back(apart / lag);
        if (out.size() > kKept && too_many()) return {};
      }
    }
  }
  if (too_many()) return {};
  return out;
}

}  // namespace turnwright::chatter
