#include "turnwright/volumetric/lathe_part.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "turnwright/base/random.hpp"
#include "turnwright/volumetric/minimum_zone.hpp"

namespace turnwright::volumetric {
namespace {

double range(std::span<const double> v) {
  const auto [low, high] = std::ranges::minmax(v);
  return high - low;
}

/// Row by row over all points of a surface; `row(theta, r, z)` gives the basis there.
template <std::size_t N, class Row>
std::vector<double> basis(const Surface& s, Row row) {
  std::vector<double> out;
  out.reserve(s.e_mm.size() * N);
  for (const double theta : s.theta_rad)
    for (std::size_t j = 0; j < s.r_mm.size(); ++j) {
      const std::array<double, N> values = row(theta, s.r_mm[j], s.z_mm[j]);
      out.insert(out.end(), values.begin(), values.end());
    }
  return out;
}

std::vector<double> cylinder_basis(const Surface& s) {
  return basis<4>(s, [](double t, double, double z) {
    return std::array{std::cos(t), std::sin(t), z * std::cos(t), z * std::sin(t)};
  });
}

std::vector<double> plane_basis(const Surface& s) {
  return basis<2>(s, [](double t, double r, double) {
    return std::array{r * std::cos(t), r * std::sin(t)};
  });
}

Form form(std::span<const double> basis, std::size_t columns, std::span<const double> e) {
  return {least_squares_zone(basis, columns, e).width,
          minimum_zone(basis, columns, e).width};
}

Form worst(const Form& a, const Form& b) {
  return {std::max(a.least_squares_mm, b.least_squares_mm),
          std::max(a.minimum_zone_mm, b.minimum_zone_mm)};
}

/// e less model(theta, r, z), at every point.
template <class Model>
std::vector<double> less(const Surface& s, Model model) {
  std::vector<double> out;
  out.reserve(s.e_mm.size());
  for (std::size_t i = 0; i < s.theta_rad.size(); ++i)
    for (std::size_t j = 0; j < s.r_mm.size(); ++j)
      out.push_back(s.at(i, j) - model(s.theta_rad[i], s.r_mm[j], s.z_mm[j]));
  return out;
}

std::vector<double> about(const Surface& s, const DatumAxis& d) {
  return less(s, [&d](double t, double, double z) {
    return (d.x0_mm + d.ax * z) * std::cos(t) + (d.y0_mm + d.ay * z) * std::sin(t);
  });
}

/// A face's deviations from planes square to the datum, z = -ax x - ay y.
std::vector<double> square_to(const Surface& s, const DatumAxis& d) {
  return less(s, [&d](double t, double r, double) {
    return -r * (d.ax * std::cos(t) + d.ay * std::sin(t));
  });
}

/// The largest range around the axis at any position along the generator.
double worst_circle(const Surface& s, const std::vector<double>& e) {
  const std::size_t m = s.r_mm.size();
  double out = 0;
  for (std::size_t j = 0; j < m; ++j) {
    double low = e[j], high = e[j];
    for (std::size_t i = j; i < e.size(); i += m) {
      low = std::min(low, e[i]);
      high = std::max(high, e[i]);
    }
    out = std::max(out, high - low);
  }
  return out;
}

double mean_of(std::span<const double> v) {
  double sum = 0;
  for (const double x : v) sum += x;
  return sum / static_cast<double>(v.size());
}

}  // namespace

Surface turned(const Kinematics& machine, const Vec3& tool_point_mm, const Generator& g,
               std::size_t around, std::size_t along) {
  const double dr = g.r_end_mm - g.r_start_mm, dz = g.z_end_mm - g.z_start_mm;
  const double length = std::hypot(dr, dz);
  if (!(length > 0) || !(g.r_start_mm >= 0) || !(g.r_end_mm >= 0) || around < 8 ||
      along < 2)
    throw std::domain_error("turned: a generator beside the axis, 8 x 2 points or more");
  // The outward normal; on faces that to +Z.
  const bool face = dz == 0;
  const double nr = face ? 0 : std::abs(dz) / length,
               nz = face ? 1 : -dr / length * (dz > 0 ? 1 : -1);
  Surface s{g, {}, {}, {}, {}};
  for (std::size_t j = 0; j < along; ++j) {
    const double share = static_cast<double>(j) / static_cast<double>(along - 1);
    s.r_mm.push_back(g.r_start_mm + share * dr);
    s.z_mm.push_back(g.z_start_mm + share * dz);
  }
  Position at;
  at.sign = {dr == 0 ? g.approach_x : std::copysign(1, dr),
             0,
             dz == 0 ? g.approach_z : std::copysign(1, dz),
             0,
             0,
             1};
  for (std::size_t i = 0; i < around; ++i) {
    const double theta =
        2 * units::kPi * static_cast<double>(i) / static_cast<double>(around);
    s.theta_rad.push_back(theta);
    for (std::size_t j = 0; j < along; ++j) {
      at.q = {s.r_mm[j] - tool_point_mm[0], 0, s.z_mm[j] - tool_point_mm[2], 0, 0, theta};
      const Vec3 tip = machine.actual_tip_mm(at);
      s.e_mm.push_back(nr * (std::hypot(tip[0], tip[1]) - s.r_mm[j]) +
                       nz * (tip[2] - s.z_mm[j]));
    }
  }
  return s;
}

DatumAxis axis_of(const Surface& cylinder) {
  const auto x =
      least_squares_zone(cylinder_basis(cylinder), 4, cylinder.e_mm).parameters;
  return {.x0_mm = x[1], .y0_mm = x[2], .ax = x[3], .ay = x[4]};
}

DatumAxis normal_of(const Surface& face) {
  const auto x = least_squares_zone(plane_basis(face), 2, face.e_mm).parameters;
  return {.x0_mm = 0, .y0_mm = 0, .ax = -x[1], .ay = -x[2]};
}

double diameter_error_mm(const Surface& cylinder) {
  return 2 * least_squares_zone(cylinder_basis(cylinder), 4, cylinder.e_mm).parameters[0];
}

double taper_mm(const Surface& cylinder) {
  const auto z =
      basis<1>(cylinder, [](double, double, double along) { return std::array{along}; });
  return 2 * least_squares_zone(z, 1, cylinder.e_mm).parameters[1] * range(cylinder.z_mm);
}

Form straightness(const Surface& s) {
  std::vector<double> along;
  for (std::size_t j = 0; j < s.r_mm.size(); ++j)
    along.push_back(std::hypot(s.r_mm[j] - s.r_mm[0], s.z_mm[j] - s.z_mm[0]));
  Form out;
  for (std::size_t i = 0; i < s.theta_rad.size(); ++i)
    out = worst(
        out, form(along, 1, std::span(s.e_mm).subspan(i * along.size(), along.size())));
  return out;
}

Form roundness(const Surface& s) {
  std::vector<double> circle;
  for (const double t : s.theta_rad)
    circle.insert(circle.end(), {std::cos(t), std::sin(t)});
  Form out;
  std::vector<double> section(s.theta_rad.size());
  for (std::size_t j = 0; j < s.r_mm.size(); ++j) {
    for (std::size_t i = 0; i < section.size(); ++i) section[i] = s.at(i, j);
    out = worst(out, form(circle, 2, section));
  }
  return out;
}

Form cylindricity(const Surface& cylinder) {
  return form(cylinder_basis(cylinder), 4, cylinder.e_mm);
}

Form flatness(const Surface& face) { return form(plane_basis(face), 2, face.e_mm); }

double profile_mm(const Surface& s) {
  double most = 0;
  for (const double e : s.e_mm) most = std::max(most, std::abs(e));
  return 2 * most;
}

double circular_radial_runout_mm(const Surface& s, const DatumAxis& datum) {
  return worst_circle(s, about(s, datum));
}

double total_radial_runout_mm(const Surface& s, const DatumAxis& datum) {
  return range(about(s, datum));
}

double coaxiality_mm(const Surface& cylinder, const DatumAxis& datum) {
  const DatumAxis own = axis_of(cylinder);
  double most = 0;
  for (const double z : {cylinder.z_mm.front(), cylinder.z_mm.back()})
    most = std::max(most, std::hypot(own.x0_mm - datum.x0_mm + (own.ax - datum.ax) * z,
                                     own.y0_mm - datum.y0_mm + (own.ay - datum.ay) * z));
  return 2 * most;
}

double circular_axial_runout_mm(const Surface& face, const DatumAxis& datum) {
  return worst_circle(face, square_to(face, datum));
}

double perpendicularity_mm(const Surface& face, const DatumAxis& datum) {
  return range(square_to(face, datum));
}

double parallelism_mm(const Surface& face, const Surface& datum) {
  return perpendicularity_mm(face, normal_of(datum));
}

double length_error_mm(const Surface& left, const Surface& right) {
  return mean_of(right.e_mm) - mean_of(left.e_mm);
}

std::vector<double> cylinder_residual_mm(const Surface& cylinder) {
  const auto x =
      least_squares_zone(cylinder_basis(cylinder), 4, cylinder.e_mm).parameters;
  return less(cylinder, [&x](double t, double, double z) {
    return x[0] + (x[1] + x[3] * z) * std::cos(t) + (x[2] + x[4] * z) * std::sin(t);
  });
}

FormDistribution form_distribution(std::span<const FormSource> sources, std::size_t draws,
                                   std::uint64_t seed) {
  if (draws == 0 || sources.empty())
    throw std::domain_error("form_distribution: a source and a draw");
  const std::size_t n = sources[0].field_mm.size();
  FormDistribution out;
  for (const FormSource& s : sources) {
    if (s.field_mm.size() != n || n == 0)
      throw std::domain_error("form_distribution: fields of one length");
    out.worst_mm += s.bound * range(s.field_mm);
  }
  std::uint64_t k = 0;
  const auto uniform = [&] { return uniform_draw(splitmix64(seed, k++)); };
  std::vector<double> e(n), widths(draws);
  for (double& width : widths) {
    std::ranges::fill(e, 0.0);
    for (const FormSource& s : sources) {
      const double u = uniform(), w = uniform();
      const double x = std::clamp(s.u * normal_draw(u, w), -s.bound, s.bound);
      for (std::size_t i = 0; i < n; ++i) e[i] += x * s.field_mm[i];
    }
    width = range(e);
  }
  const auto quantile = [&](double share) {
    const auto at = widths.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(draws - 1));
    std::ranges::nth_element(widths, at);
    return std::min(*at, out.worst_mm);
  };
  out.median_mm = quantile(0.5);
  out.p95_mm = quantile(0.95);
  return out;
}

}  // namespace turnwright::volumetric
