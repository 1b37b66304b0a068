#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "turnwright/base/units.hpp"
#include "turnwright/chatter/cutter.hpp"

/// A cutter simulated with its edge cut into slices, each of which looks for itself what
/// surface it meets: nothing is shared with the program but the description.
namespace turnwright::chatter {

class SliceSimulation {
 public:
  SliceSimulation(const Cutter& cutter, double n_rpm, double ap_mm, int steps, int slices)
      : c_(cutter),
        steps_(steps),
        h_(60 / n_rpm / steps),
        spindle_(2 * units::kPi * n_rpm / 60),
        table_(static_cast<std::size_t>(steps)) {
    constexpr int kInstants = 6;
    const double slice = ap_mm / slices;
    for (int i = 0; i < steps; ++i)
      for (int k = 0; k < kInstants; ++k)
        for (int s = 0; s < slices; ++s)
          meet((i + (k + 0.5) / kInstants) * h_ * spindle_, (s + 0.5) * slice,
               slice / kInstants, table_[static_cast<std::size_t>(i)]);
  }

  /// Revolutions from a given start; 0 feed leaves the free motion.
  void run(int revolutions, bool fed) {
    const std::size_t modes = c_.system.modes.size();
    Eigen::VectorXd u(2 * static_cast<Eigen::Index>(modes));
    for (Eigen::Index i = 0; i < u.size(); ++i)
      u(i) = fed ? 0 : 1 + 0.37 * static_cast<double>(i);
    keep(u);
    for (long n = 0; n < static_cast<long>(revolutions) * steps_; ++n) {
      const Step& step = table_[static_cast<std::size_t>(n % steps_)];
      const auto slope = [&](const Eigen::VectorXd& at, double share) {
        const Eigen::Vector4d now = motion(at);
        Eigen::Vector2d force = -step.damping * now.tail<2>();
        if (fed) force += step.fed;
        for (const Delayed& d : step.delayed)
          force -= d.h * (now.head<2>() -
                          past(static_cast<double>(n) + share - d.delay_s / h_));
        Eigen::VectorXd out(at.size());
        for (std::size_t k = 0; k < modes; ++k) {
          const Mode& m = c_.system.modes[k];
          const auto i = static_cast<Eigen::Index>(2 * k);
          const double f = m.axis == Axis::x ? force(0) : force(1);
          out(i) = m.wn_rad_s * at(i + 1);
          out(i + 1) = m.wn_rad_s * (f / m.k_N_mm - at(i) - 2 * m.zeta * at(i + 1));
        }
        return out;
      };
      const Eigen::VectorXd a = slope(u, 0), b = slope(u + h_ / 2 * a, 0.5),
                            c = slope(u + h_ / 2 * b, 0.5), d = slope(u + h_ * c, 1);
      u += h_ / 6 * (a + 2 * b + 2 * c + d);
      keep(u);
    }
  }

  /// |mu| of a revolution: the linear map between the last ones that fits them.
  double growth() const {
    constexpr Eigen::Index kPairs = 8;
    Eigen::MatrixXd x(2 * steps_, kPairs + 1);
    const long last = static_cast<long>(kept_.size()) - 1;
    for (Eigen::Index p = 0; p <= kPairs; ++p)
      for (int i = 0; i < steps_; ++i)
        x.col(p).segment<2>(2 * i) =
            kept_[static_cast<std::size_t>(last - (kPairs - p) * steps_ - i)].head<2>();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(
        x.leftCols(kPairs), Eigen::ComputeThinU | Eigen::ComputeThinV);
    Eigen::Index rank = 1;
    while (rank < kPairs && svd.singularValues()(rank) > 1e-5 * svd.singularValues()(0))
      ++rank;
    const Eigen::MatrixXd map =
        svd.matrixU().leftCols(rank).transpose() * x.rightCols(kPairs) *
        svd.matrixV().leftCols(rank) *
        svd.singularValues().head(rank).cwiseInverse().asDiagonal();
    return map.eigenvalues().cwiseAbs().maxCoeff();
  }

  /// Displacement in the last revolution but one at an angle of the spindle.
  Eigen::Vector2d displacement(double angle_rad) const {
    const double turn = angle_rad / (2 * units::kPi);
    const double step = (turn - std::floor(turn)) * steps_;
    return past(static_cast<double>(kept_.size()) - 1 - 2 * steps_ + step);
  }

 private:
  struct Delayed {
    double delay_s;
    Eigen::Matrix2d h;
  };
  struct Step {
    std::vector<Delayed> delayed;
    Eigen::Matrix2d damping = Eigen::Matrix2d::Zero();
    Eigen::Vector2d fed = Eigen::Vector2d::Zero();
  };

  void meet(double angle, double z, double depth, Step& to) const {
    const auto n = static_cast<std::size_t>(c_.system.teeth);
    const auto pitch = [&](std::size_t j) {
      return c_.pitch_rad.empty() ? 2 * units::kPi / c_.system.teeth : c_.pitch_rad[j];
    };
    const auto offset = [&](std::size_t j) {
      return c_.offset_mm.empty() ? 0 : c_.offset_mm[j];
    };
    double place = 0;
    for (std::size_t j = 0; j < n; ++j) {
      if (j > 0) place -= pitch(j);
      double phi = angle + place;
      if (c_.helix_rad > 0) phi -= 2 * z * std::tan(c_.helix_rad) / c_.diameter_mm;
      phi -= 2 * units::kPi * std::floor(phi / (2 * units::kPi));
      if (!(phi > c_.system.entry_rad && phi < c_.system.exit_rad)) continue;
      double chip = 1e9, delay = 0, back = 0;
      for (std::size_t l = 1; l <= n; ++l) {
        back += pitch((j + n - l + 1) % n);
        const double made =
            c_.feed_mm * c_.system.teeth * back / (2 * units::kPi) * std::sin(phi) +
            offset(j) - offset((j + n - l) % n);
        if (made < chip - 1e-15) {
          chip = made;
          delay = back / spindle_;
        }
        if (c_.offset_mm.empty()) break;
      }
      if (chip < 0) continue;
      const Eigen::Vector2d normal(std::sin(phi), std::cos(phi)),
          along(std::cos(phi), -std::sin(phi));
      const auto& k = std::get<LinearForce>(c_.system.force);
      const Eigen::Vector2d by_chip = depth * (k.Kt_MPa * along + k.Kn_MPa * normal);
      to.fed -= by_chip * chip;
      const Eigen::Matrix2d h = by_chip * normal.transpose();
      const auto same = std::ranges::find_if(to.delayed, [&](const Delayed& d) {
        return std::abs(d.delay_s - delay) < 1e-12;
      });
      if (same == to.delayed.end())
        to.delayed.push_back({delay, h});
      else
        same->h += h;
      if (c_.indentation_N_mm > 0)
        to.damping += depth * c_.indentation_N_mm / (spindle_ * c_.diameter_mm / 2) *
                      (normal + c_.friction * along) * normal.transpose();
    }
  }

  Eigen::Vector4d motion(const Eigen::VectorXd& u) const {
    Eigen::Vector4d out = Eigen::Vector4d::Zero();
    for (std::size_t k = 0; k < c_.system.modes.size(); ++k) {
      const Mode& m = c_.system.modes[k];
      const int a = m.axis == Axis::x ? 0 : 1;
      const auto i = static_cast<Eigen::Index>(2 * k);
      out(a) += u(i);
      out(a + 2) += u(i + 1) * m.wn_rad_s;
    }
    return out;
  }

  void keep(const Eigen::VectorXd& u) { kept_.push_back(motion(u)); }

  // At rest before the start; Hermite's cubic between steps.
  Eigen::Vector2d past(double step) const {
    if (step <= 0) return kept_.front().head<2>();
    const auto i = std::min(static_cast<std::size_t>(step), kept_.size() - 2);
    const double x = step - static_cast<double>(i), h1 = x * x * (3 - 2 * x);
    const Eigen::Vector4d &a = kept_[i], &b = kept_[i + 1];
    return (1 - h1) * a.head<2>() + h1 * b.head<2>() +
           h_ * (x * (1 - x) * (1 - x) * a.tail<2>() + x * x * (x - 1) * b.tail<2>());
  }

  Cutter c_;
  int steps_;
  double h_, spindle_;
  std::vector<Step> table_;
  std::vector<Eigen::Vector4d> kept_;
};

}  // namespace turnwright::chatter
