#include "turnwright/deflection/ovality.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "turnwright/base/units.hpp"

namespace turnwright::deflection {
namespace {

/// A symmetric matrix of two rows.
struct Matrix {
  double xx = 0, yy = 0, xy = 0;
};

Matrix operator+(const Matrix& a, const Matrix& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.xy + b.xy};
}
Matrix operator*(double f, const Matrix& a) { return {f * a.xx, f * a.yy, f * a.xy}; }

Matrix inverse(const Matrix& a) {
  const double det = a.xx * a.yy - a.xy * a.xy;
  return {a.yy / det, a.xx / det, -a.xy / det};
}

/// a b a, symmetric as a and b are.
Matrix around(const Matrix& a, const Matrix& b) {
  const double c00 = a.xx * b.xx + a.xy * b.xy, c01 = a.xx * b.xy + a.xy * b.yy;
  const double c10 = a.xy * b.xx + a.yy * b.xy, c11 = a.xy * b.xy + a.yy * b.yy;
  return {c00 * a.xx + c01 * a.xy, c10 * a.xy + c11 * a.yy, c00 * a.xy + c01 * a.yy};
}

/// T of Eq. (3) about the centroid.
Matrix about_centroid(const Section& s, const char* caller) {
  const double A = s.area_mm2;
  if (!(A > 0)) throw std::domain_error(std::string(caller) + ": a section has no area");
  return {s.xx_mm4 - s.sx_mm3 * s.sx_mm3 / A, s.yy_mm4 - s.sy_mm3 * s.sy_mm3 / A,
          s.xy_mm4 - s.sx_mm3 * s.sy_mm3 / A};
}

/// T^-1/E about the centroid, Eq. (3).
Matrix bending(const Section& s, double E) {
  const Matrix T = about_centroid(s, "oval_flexibility");
  if (!(T.xx * T.yy - T.xy * T.xy > 0))
    throw std::domain_error("oval_flexibility: a section does not resist bending");
  return 1 / E * inverse(T);
}

/// int (p - z)(q - z) dz from z0 to z1.
double arms(double p, double q, double z0, double z1) {
  const double h = z1 - z0, P = p - z0, Q = q - z0;
  return h * (P * Q - h * (P + Q) / 2 + h * h / 3);
}

}  // namespace

Section round_section(double outer_mm, double inner_mm) {
  if (!(outer_mm > inner_mm && inner_mm >= 0 && std::isfinite(outer_mm)))
    throw std::domain_error("round_section: outer must be > inner >= 0 mm");
  const double D2 = outer_mm * outer_mm, d2 = inner_mm * inner_mm;
  const double I = units::kPi * (D2 * D2 - d2 * d2) / 64;
  return {units::kPi * (D2 - d2) / 4, 0, 0, I, I, 0};
}

Section without_slot(const Section& section, double outer_mm, const Slot& slot) {
  const double R = outer_mm / 2, c = slot.width_mm / 2, r = slot.floor_mm;
  const double X = std::sqrt((R - c) * (R + c));
  if (!(R > 0 && c > 0 && c <= R && r >= 0 && r * r <= X * X + 1e-14 * R * R))
    throw std::domain_error("without_slot: the slot does not lie in the rim");
  const double W = c * X + R * R * std::asin(c / R);  // Eq. (1)
  const double A = W - 2 * c * r, s = c * (R * R - r * r) - c * c * c / 3;
  const double xx = c * X * X * X / 6 + R * R * W / 4 - 2 * c * r * r * r / 3;
  const double yy = -c * X * X * X / 2 + R * R * W / 4 - 2 * c * c * c * r / 3;
  const double cos = std::cos(slot.angle_rad), sin = std::sin(slot.angle_rad);
  return {.area_mm2 = section.area_mm2 - A,
          .sx_mm3 = section.sx_mm3 - s * cos,
          .sy_mm3 = section.sy_mm3 - s * sin,
          .xx_mm4 = section.xx_mm4 - xx * cos * cos - yy * sin * sin,
          .yy_mm4 = section.yy_mm4 - xx * sin * sin - yy * cos * cos,
          .xy_mm4 = section.xy_mm4 - (xx - yy) * sin * cos};
}

Section without_flat(const Section& section, double outer_mm, double floor_mm,
                     double angle_rad) {
  const double R = outer_mm / 2;
  return without_slot(
      section, outer_mm,
      {2 * std::sqrt((R - floor_mm) * (R + floor_mm)), floor_mm, angle_rad});
}

double least_second_moment_mm4(const Section& section) {
  const auto [xx, yy, xy] = about_centroid(section, "least_second_moment_mm4");
  return (xx + yy) / 2 - std::hypot((xx - yy) / 2, xy);
}

OvalFlexibility oval_flexibility(std::span<const Stretch> stretches, double E_MPa,
                                 const Supports& supports, double a_mm) {
  double L = 0;
  for (const Stretch& s : stretches) {
    if (!(s.length_mm > 0)) throw std::domain_error("oval_flexibility: lengths > 0 mm");
    L += s.length_mm;
  }
  const double a = a_mm, b = L - a;
  if (!(E_MPa > 0 && a >= 0 && a <= L))
    throw std::domain_error("oval_flexibility: E must be > 0 MPa, a in [0, L]");
  if (!elastic(supports.root) || !(supports.head_mm_N >= 0 && supports.tail_mm_N >= 0))
    throw std::domain_error("oval_flexibility: the supports are no elastic body");

  const auto [c0, c1, c2] = supports.root;
  const auto round = [](double c) { return Matrix{c, c, 0}; };
  Matrix aa = round(c0 + 2 * c1 * a + c2 * a * a),
         aL = round(c0 + c1 * (a + L) + c2 * a * L),
         LL = round(c0 + 2 * c1 * L + c2 * L * L + supports.tail_mm_N);
  Matrix head = round(supports.head_mm_N), tail = round(supports.tail_mm_N);
  double z = 0;
  for (const Stretch& s : stretches) {
    const Matrix bend = bending(s.section, E_MPa);
    const double end = z + s.length_mm, cut = std::clamp(a, z, end);
    aa = aa + arms(a, a, z, cut) * bend;
    aL = aL + arms(a, L, z, cut) * bend;
    LL = LL + arms(L, L, z, end) * bend;
    head = head + arms(0, 0, z, cut) * bend;
    tail = tail + arms(L, L, cut, end) * bend;
    z = end;
  }
  Matrix C = aa;
  if (supports.method == Method::between_centres)
    C = b * b / (L * L) * head + a * a / (L * L) * tail;
  if (supports.method == Method::chuck_tailstock)
    C = aa + -1.0 * around(aL, inverse(LL));  // Eq. (4)

  const double x = (C.xx - C.yy) / 2;
  const double softest = std::atan2(C.xy, x) / 2;
  return {(C.xx + C.yy) / 2, std::hypot(x, C.xy),
          softest < 0 ? softest + units::kPi : softest};
}

OvalError oval_error(const OvalFlexibility& f, double Fr_N, double Ft_N) {
  return {f.mean_mm_N * Fr_N, f.lobe_mm_N * std::hypot(Fr_N, Ft_N)};  // Eq. (5)
}

}  // namespace turnwright::deflection
