#include "turnwright/part/cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "turnwright/base/language.hpp"
#include "turnwright/base/pattern.hpp"

namespace turnwright::part {
namespace {

constexpr double kRounding = 1e-9;  // of the radius: a quarter circle ends upright

struct KnurlName {
  const char* name;
  KnurlType type;
  double below_pitches;  // the blank's diameter under the nominal one, Eq. (5)
};
constexpr std::array<KnurlName, 7> kKnurls{{{"RAA", KnurlType::RAA, 1.0 / 2},
                                            {"RBL", KnurlType::RBL, 1.0 / 2},
                                            {"RBR", KnurlType::RBR, 1.0 / 2},
                                            {"RGE", KnurlType::RGE, 2.0 / 3},
                                            {"RGV", KnurlType::RGV, 1.0 / 3},
                                            {"RKE", KnurlType::RKE, 2.0 / 3},
                                            {"RKV", KnurlType::RKV, 1.0 / 3}}};
constexpr std::array kKnurlPitches_mm{0.5, 0.6, 0.8, 1.0, 1.2, 1.6};

const KnurlName& named(KnurlType type) {
  return *std::ranges::find(kKnurls, type, &KnurlName::type);
}

}  // namespace

Shaped groove(double blank_mm, double drawn_mm, double floor_mm) {
  return {{blank_mm, blank_mm},
          {.kind = CutKind::groove,
           .drawn = {drawn_mm, drawn_mm},
           .core = {floor_mm, floor_mm},
           .depth_mm = std::abs(blank_mm - floor_mm) / 2}};
}

Shaped hole(double diameter_mm) {
  const Ends ends{diameter_mm, diameter_mm};
  return {
      ends,
      {.kind = CutKind::hole, .drawn = ends, .core = ends, .drilled_mm = diameter_mm}};
}

Shaped reamed(double diameter_mm, double drilled_mm, double lead_mm) {
  auto s = hole(diameter_mm);
  s.cut.depth_mm = (diameter_mm - drilled_mm) / 2;
  s.cut.drilled_mm = drilled_mm;
  s.cut.lead_mm = lead_mm;
  return s;
}

Shaped counterbored(double diameter_mm, double drilled_mm) {
  auto s = reamed(diameter_mm, drilled_mm, 0);
  s.cut.flat = true;
  return s;
}

std::optional<Knurl> knurl(const std::string& text) {
  static const Pattern kForm(
      R"(\s*(?:DIN\s*82)?[\s-]*(R[A-Z]{2})\s*(\d+(?:[.,]\d+)?)\s*)");
  const auto m = kForm.match(text);
  if (!m) return std::nullopt;
  auto digits = (*m)[2];
  std::ranges::replace(digits, ',', '.');
  const double pitch = std::stod(digits);
  const auto is = [&](const KnurlName& k) { return k.name == (*m)[1]; };
  const auto type = std::ranges::find_if(kKnurls, is);
  if (type == kKnurls.end() || !std::ranges::count(kKnurlPitches_mm, pitch))
    return std::nullopt;
  return Knurl{type->type, pitch};
}

std::string designation(const Knurl& k) {
  return fmt::format("{}{:g}", named(k.type).name, k.pitch_mm);
}

Shaped knurled(double d1, const Knurl& k) {
  const double t = k.pitch_mm, blank = d1 - named(k.type).below_pitches * t,
               root = d1 - t;  // Eq. (5)
  return {{blank, blank},
          {.kind = CutKind::knurl,
           .drawn = {d1, d1},
           .core = {root, root},
           .depth_mm = (blank - root) / 2,
           .pitch_mm = t,
           .knurl = k.type}};
}

Shaped arc(double length_mm, Ends ends, double radius_mm, bool convex) {
  const double R = radius_mm, l = length_mm;
  const double rl = ends.left_mm / 2, rr = ends.right_mm / 2;
  const double c = std::hypot(l, rr - rl);
  if (!(R >= c / 2 * (1 - kRounding)))
    throw std::domain_error(tr("a radius of at least half the chord between the ends"));
  const double d = std::sqrt(std::max(0.0, R * R - c * c / 4));
  const double inwards = convex ? -1 : 1;  // from the chord's middle to the centre
  const double zc = l / 2 - inwards * d * (rr - rl) / c;
  const double rc = (rl + rr) / 2 + inwards * d * l / c;
  const double slack = kRounding * R;
  if (convex ? std::min(rl, rr) < rc - slack : std::max(rl, rr) > rc + slack)
    throw std::domain_error(tr("an arc that stays between its ends along the axis"));
  const bool turns = zc > 0 && zc < l;  // it has a point parallel to the axis
  const double most = convex && turns ? rc + R : std::max(rl, rr);
  const double least = !convex && turns ? rc - R : std::min(rl, rr);
  if (!(least > 0)) throw std::domain_error(tr("an arc that does not meet the axis"));
  const auto slope = [R](double dz) {  // Eq. (4)
    return dz > 0 ? std::asin(std::min(1.0, dz / R)) : 0;
  };
  Shaped s{{2 * most, 2 * most},
           {.kind = CutKind::arc,
            .drawn = ends,
            .core = ends,
            .depth_mm = most - std::min(rl, rr),  // Eq. (1)
            .radius_mm = R,
            .convex = convex,
            .path_mm = 2 * R * std::asin(std::min(1.0, c / (2 * R))),  // Eq. (3)
            .falls_to_left_rad = slope(convex ? zc : l - zc),
            .falls_to_right_rad = slope(convex ? l - zc : zc)}};
  if (convex) return s;
  s.blank = ends;
  s.cut.core = {2 * least, 2 * least};
  s.cut.depth_mm = (R - d) * c / l;  // Eq. (2)
  return s;
}

}  // namespace turnwright::part
