#include "turnwright/deflection/rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace turnwright::deflection {
namespace {

using Side = Body;
constexpr double kFree = std::numeric_limits<double>::infinity();

bool turns_freely(const Side& s) { return std::isinf(s.M_rad_Nmm); }
bool is_nothing(const Side& s) { return std::isinf(s.X_mm_N); }

/// A side seen from a position farther on, also where the side is missing or turns
/// freely.
Side through(const Side& s, double length_mm, const Body& stretch) {
  if (is_nothing(s)) return s;
  if (!turns_freely(s)) return joined(s, length_mm, stretch);
  const double d = length_mm + s.d_mm, apart = d - stretch.d_mm;
  return {s.M_rad_Nmm, d, s.X_mm_N + stretch.X_mm_N + stretch.M_rad_Nmm * apart * apart};
}

/// One side of the shaft and an elastic support of compliance c at its end, taken
/// together, Eq. (2).
Side beside(const Side& s, double c) {
  if (is_nothing(s)) return {kFree, 0, c};
  const double X = s.X_mm_N, M = s.M_rad_Nmm, d = s.d_mm;
  return {turns_freely(s) ? (c + X) / (d * d) : M * (c + X) / (c + X + M * d * d),
          d * c / (c + X), c * X / (c + X)};
}

/// The support's share of a force R and of a couple m, which is positive where it presses
/// the support down.
double share(const Side& s, double c, double R, double m) {
  if (is_nothing(s)) return R;
  const double X = s.X_mm_N, M = s.M_rad_Nmm, d = s.d_mm;
  if (turns_freely(s)) return R + m / d;
  return ((X + M * d * d) * R + M * d * m) / (c + X + M * d * d);
}

/// Response to a force (w) and a couple (p) at the tool: flexibilities, and the forces
/// and couples that the left and the right side carry at the tool.
struct Joined {
  double f_ww, f_wp, f_pp;
  double V_w, m_w, V_p, m_p;  // left
  double R_w, n_w, R_p, n_p;  // right
};

/// Eqs. (3), (4), multiplied by q_l p_r + q_r p_l where M = p/q, so that neither an end
/// that turns freely (q = 0) nor one that cannot turn (p = 0) divides by zero.
Joined sharing(const Side& l, const Side& r) {
  const double X_l = l.X_mm_N, X_r = r.X_mm_N, d_l = l.d_mm, d_r = r.d_mm;
  if (is_nothing(r))
    return {X_l + l.M_rad_Nmm * d_l * d_l,
            l.M_rad_Nmm * d_l,
            l.M_rad_Nmm,
            1,
            0,
            0,
            1,
            0,
            0,
            0,
            0};
  const double p_l = turns_freely(l) ? 1 : l.M_rad_Nmm, q_l = turns_freely(l) ? 0 : 1;
  const double p_r = turns_freely(r) ? 1 : r.M_rad_Nmm, q_r = turns_freely(r) ? 0 : 1;
  const double P = p_l * p_r, N = q_l * p_r + q_r * p_l, D = d_l + d_r, X = X_l + X_r;
  const double inverse = 1 / (X * N + P * D * D);
  const double V_w = (X_r * N + P * D * d_r) * inverse;
  const double R_w = (X_l * N + P * D * d_l) * inverse, V_p = -P * D * inverse;
  const double B_w = (d_l * X_r - d_r * X_l) * inverse, B_p = X * inverse;
  return {.f_ww = X_l * V_w * V_w + X_r * R_w * R_w + P * N * B_w * B_w,
          .f_wp = V_p * (X_l * V_w - X_r * R_w) + P * N * B_w * B_p,
          .f_pp = X * V_p * V_p + P * N * B_p * B_p,
          .V_w = V_w,
          .m_w = p_r * q_l * B_w - d_l * V_w,
          .V_p = V_p,
          .m_p = p_r * q_l * B_p - d_l * V_p,
          .R_w = R_w,
          .n_w = p_l * q_r * B_w + d_r * R_w,
          .R_p = -V_p,
          .n_p = p_l * q_r * B_p - d_r * V_p};
}

struct Cut {
  part::Shaft before, after;
};

Cut cut(const part::Shaft& shaft, double z_mm) {
  Cut out{{shaft.E_MPa, shaft.nu, {}}, {shaft.E_MPa, shaft.nu, {}}};
  const std::vector<double> z = part::ends_mm(shaft.segments);
  for (std::size_t i = 0; i < shaft.segments.size(); ++i) {
    const part::Segment& s = shaft.segments[i];
    if (z[i + 1] <= z_mm) {
      out.before.segments.push_back(s);
    } else if (z[i] >= z_mm) {
      out.after.segments.push_back(s);
    } else {
      const auto [left, right] = part::split(s, z_mm - z[i]);
      out.before.segments.push_back(left);
      out.after.segments.push_back(right);
    }
  }
  return out;
}

part::Shaft mirrored(part::Shaft shaft) {
  std::reverse(shaft.segments.begin(), shaft.segments.end());
  for (part::Segment& s : shaft.segments) {
    std::swap(s.outer_left_mm, s.outer_right_mm);
    std::swap(s.inner_left_mm, s.inner_right_mm);
  }
  return shaft;
}

Side root_side(const Supports& s) {
  if (s.method == Method::between_centres) return {kFree, 0, s.head_mm_N};
  return body(s.root);
}

Side tail_side(const Supports& s) {
  if (s.method == Method::chuck) return {0, 0, kFree};
  return {kFree, 0, s.tail_mm_N};
}

double inside(const part::Shaft& shaft, const Supports& supports,
              const SteadyRest& rest) {
  if (!elastic(supports.root) || !(supports.head_mm_N >= 0) || !(supports.tail_mm_N >= 0))
    throw std::domain_error("RestedBeam: the supports are no elastic body");
  if (!(rest.z_mm > 0 && rest.z_mm < part::length_mm(shaft.segments)))
    throw std::domain_error("RestedBeam: the rest must stand within (0, L)");
  if (!(rest.compliance_mm_N >= 0 && std::isfinite(rest.compliance_mm_N)))
    throw std::domain_error("RestedBeam: the rest's compliance must be >= 0 mm/N");
  return rest.z_mm;
}

}  // namespace

RestedBeam::RestedBeam(const part::Shaft& shaft, const Supports& supports,
                       const SteadyRest& rest)
    : RestedBeam(shaft, shaft, supports, rest) {}

RestedBeam::RestedBeam(const part::Shaft& left_of_tool, const part::Shaft& right_of_tool,
                       const Supports& supports, const SteadyRest& rest)
    : z_mm_(inside(left_of_tool, supports, rest)),
      length_mm_(part::length_mm(left_of_tool.segments)),
      c_(rest.compliance_mm_N),
      has_tail_(supports.method != Method::chuck),
      from_root_(cut(left_of_tool, z_mm_).before),
      to_rest_(mirrored(cut(right_of_tool, z_mm_).before)),
      from_rest_(cut(left_of_tool, z_mm_).after),
      to_tail_(mirrored(cut(right_of_tool, z_mm_).after)),
      root_(root_side(supports)),
      tail_(tail_side(supports)),
      behind_(through(root_, z_mm_, from_root_.body(from_root_.length_mm()))),
      ahead_(through(tail_, length_mm_ - z_mm_, to_tail_.body(to_tail_.length_mm()))),
      held_behind_(beside(behind_, c_)),
      held_ahead_(beside(ahead_, c_)) {
  if (!(std::abs(part::length_mm(right_of_tool.segments) - length_mm_) <=
        1e-12 * length_mm_))
    throw std::domain_error("RestedBeam: the two bodies differ in length");
}

RestedFlexibility RestedBeam::at(double a_mm) const {
  if (!(a_mm >= 0 && a_mm <= length_mm_ * (1 + 1e-12)))
    throw std::domain_error("RestedBeam: positions must be in [0, L]");
  const double a = std::min(a_mm, length_mm_), b = length_mm_ - a;
  const double u = std::abs(a - z_mm_);
  if (a <= z_mm_) {
    const Joined j = sharing(through(root_, a, from_root_.body(a)),
                             through(held_ahead_, u, to_rest_.body(u)));
    const double rest_w = share(ahead_, c_, j.R_w, j.R_w * u - j.n_w);
    const double rest_p = share(ahead_, c_, j.R_p, j.R_p * u - j.n_p);
    return {{j.f_ww, j.f_wp, j.f_pp, has_tail_ ? j.R_w - rest_w : 0,
             has_tail_ ? j.R_p - rest_p : 0},
            rest_w,
            rest_p};
  }
  const Joined j = sharing(through(held_behind_, u, from_rest_.body(u)),
                           through(tail_, b, to_tail_.body(b)));
  return {{j.f_ww, j.f_wp, j.f_pp, j.R_w, j.R_p},
          share(behind_, c_, j.V_w, j.m_w + j.V_w * u),
          share(behind_, c_, j.V_p, j.m_p + j.V_p * u)};
}

Flexibility follow_rest(const Flexibility& f, double compliance_mm_N) {
  const double c = compliance_mm_N, both = f.f_ww_mm_N + c;
  if (!(c >= 0 && std::isfinite(c) && both > 0))
    throw std::domain_error("follow_rest: c must be >= 0 mm/N and f_ww + c > 0");
  const double left = c / both, turned = f.f_wp_rad_N / both;  // Eq. (5)
  return {.f_ww_mm_N = f.f_ww_mm_N * left,
          .f_wp_rad_N = f.f_wp_rad_N * left,
          .f_pp_rad_Nmm = f.f_pp_rad_Nmm - f.f_wp_rad_N * turned,
          .tail_per_N = f.tail_per_N * left,
          .tail_per_Nmm = f.tail_per_Nmm - f.tail_per_N * turned};
}

}  // namespace turnwright::deflection
