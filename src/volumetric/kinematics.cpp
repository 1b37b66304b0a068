// Tip and direction of the tool are carried joint by joint, from the tool to the bed and
// on to the workpiece, so that no matrix is multiplied by another.
#include "turnwright/volumetric/kinematics.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "turnwright/base/language.hpp"

namespace turnwright::volumetric {

double sense(std::string_view chain, char axis) {
  return chain.find(axis) < chain.find('f') ? -1 : 1;
}

std::string chain_fault(std::string_view chain) {
  if (chain.size() < 3 || chain.front() != 'w' || chain.back() != 't')
    return tr("it runs from w to t");
  const auto inner = chain.substr(1, chain.size() - 2);
  if (std::ranges::count(inner, 'f') != 1) return tr("it has one bed f between w and t");
  for (const char c : inner) {
    if (c == 'f') continue;
    if (letter_index(c) == std::string_view::npos)
      return tr("its axes are of X Y Z A B C");
    if (std::ranges::count(inner, c) > 1) return tr("each axis comes once");
  }
  return "";
}

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Errors = Eigen::Array<double, 6, 1>;

Eigen::Map<const Vector3d> vector(const Vec3& v) {
  return Eigen::Map<const Vector3d>(v.data());
}
Eigen::Map<const Errors> array(const std::array<double, kDirections>& v) {
  return Eigen::Map<const Errors>(v.data());
}
Vec3 values(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Below 0.01 rad by series, whose neglected terms a^7/5040 and a^8/40320 are below
/// rounding.  In line, as are rotations, because a pose is made of some ten of each.
[[gnu::always_inline]] inline Turn turn(double a) {
  const double x = a * a;
  if (x < 1e-4)
    return {1 - x * (1.0 / 2 - x * (1.0 / 24 - x * (1.0 / 720))),
            a - a * x * (1.0 / 6 - x * (1.0 / 120))};
  return {std::cos(a), std::sin(a)};
}

Turn back(const Turn& t) { return {t.cos, -t.sin}; }

/// Rotates a vector about one of the axes.
[[gnu::always_inline]] inline void rotate(Vector3d& v, std::size_t axis, const Turn& t) {
  const auto j = static_cast<Eigen::Index>((axis + 1) % 3),
             k = static_cast<Eigen::Index>((axis + 2) % 3);
  const double y = v[j];
  v[j] = t.cos * y - t.sin * v[k];
  v[k] = t.sin * y + t.cos * v[k];
}

Matrix3d matrix(std::size_t axis, const Turn& t) {
  Matrix3d R = Matrix3d::Identity();
  for (Eigen::Index i = 0; i < 3; ++i) {
    Vector3d column = R.col(i);
    rotate(column, axis, t);
    R.col(i) = column;
  }
  return R;
}

/// Rz(C) Ry(B) Rx(A) v, by the three rotations about x, y, z.
[[gnu::always_inline]] inline void tilt(Vector3d& v, const std::array<Turn, 3>& t) {
  rotate(v, 0, t[0]);
  rotate(v, 1, t[1]);
  rotate(v, 2, t[2]);
}
[[gnu::always_inline]] inline void untilt(Vector3d& v, const std::array<Turn, 3>& t) {
  rotate(v, 2, back(t[2]));
  rotate(v, 1, back(t[1]));
  rotate(v, 0, back(t[0]));
}

/// Eq. (3), not yet of unit length; `s` is EA0, EB0, EC0.
Vector3d direction(std::size_t axis, const Vector3d& s) {
  const Vector3d e = Vector3d::Unit(static_cast<Eigen::Index>(axis));
  return e + s.cross(e);
}

const Axis& axis_of(const Machine& machine, char name) {
  const auto same = [name](const Axis& a) { return a.name == name; };
  const auto found = std::ranges::find_if(machine.axes, same);
  if (found == machine.axes.end())
    throw std::domain_error(std::string("Kinematics: no axis ") + name);
  return *found;
}

void check(const Axis& axis) {
  const std::string who = std::string("Kinematics: axis ") + axis.name;
  if (!(axis.Q > 0)) throw std::domain_error(who + ": Q > 0");
  if (is_rotary(axis.name)) return;
  for (const ErrorFunction& e : axis.errors)
    if (!e.f.empty()) throw std::domain_error(who + ": harmonics of a linear axis");
  const std::size_t along = letter_index(axis.name) + 3;
  for (std::size_t k = 0; k < kDirections; ++k)
    if ((k < 3 || k == along) && axis.location[k] != 0)
      throw std::domain_error(who + ": location of a linear axis");
}

}  // namespace

Kinematics::Kinematics(const Machine& machine) : tool_point_(machine.tool_point_mm) {
  const std::string fault = chain_fault(machine.chain);
  if (!fault.empty())
    throw std::domain_error("Kinematics: chain " + machine.chain + ": " + fault);
  if (machine.axes.size() != machine.chain.size() - 3)
    throw std::domain_error("Kinematics: one axis for each letter of the chain");
  const auto joint = [&machine](char name, double sigma) {
    const Axis& axis = axis_of(machine, name);
    check(axis);
    Joint j{.axis = letter_index(name),
            .sigma = sigma,
            .inverse_Q = 1 / axis.Q,
            .p = axis.p_mm,
            .location = {axis.location[0], axis.location[1], axis.location[2]}};
    const Vector3d s(axis.location[3], axis.location[4], axis.location[5]);
    for (std::size_t k = 0; k < kDirections; ++k) {
      const ErrorFunction& e = axis.errors[k];
      for (std::size_t n = 0; n < 4; ++n) j.errors.c[n][k] = e.c[n];
      j.errors.b[k] = e.b;
      if (j.errors.f.size() < e.f.size()) j.errors.f.resize(e.f.size());
      for (std::size_t h = 0; h < e.f.size(); ++h) {
        j.errors.f[h][0][k] = e.f[h].a;
        j.errors.f[h][1][k] = e.f[h].d;
      }
    }
    j.small = j.errors;
    if (is_rotary(name)) {
      for (std::size_t k = 0; k < 3; ++k)
        j.tilt[k] = turn(s[static_cast<Eigen::Index>(k)]);
      for (std::size_t k = 0; k < kDirections; ++k) j.small.c[0][k] += axis.location[k];
    } else {
      j.travel = values(direction(j.axis, s).normalized());
      for (std::size_t k = 0; k < 3; ++k)
        j.small.c[1][k] += sigma * axis.Q * (j.travel[k] - (k == j.axis ? 1 : 0));
    }
    return j;
  };
  const std::size_t bed = machine.chain.find('f');
  for (std::size_t i = bed + 1; i + 1 < machine.chain.size(); ++i)
    tool_.push_back(joint(machine.chain[i], 1));
  for (std::size_t i = bed - 1; i > 0; --i) work_.push_back(joint(machine.chain[i], -1));
}

/// At t = q/Q.
inline std::array<double, kDirections> Kinematics::Polynomial::at(double q, double t,
                                                                  double sign) const {
  std::array<double, kDirections> out;
  Eigen::Map<Errors> E(out.data());
  // machine.hpp (1)
  E = array(c[0]) + t * (array(c[1]) + t * (array(c[2]) + t * array(c[3]))) +
      sign * array(b);
  for (std::size_t h = 0; h < f.size(); ++h) {
    const double hq = static_cast<double>(h + 1) * q;
    E += std::cos(hq) * array(f[h][0]) + std::sin(hq) * array(f[h][1]);
  }
  return out;
}

ToolPose Kinematics::nominal(const Position& at) const {
  Vector3d tip = vector(tool_point_), n = Vector3d::UnitZ();
  const auto carry = [&](const Joint& j, double direction) {
    const double q = direction * j.sigma * at.q[j.axis];
    if (j.axis < 3) {
      tip[static_cast<Eigen::Index>(j.axis)] += q;
      return;
    }
    const Turn angle = turn(q);
    tip -= vector(j.p);
    rotate(tip, j.axis - 3, angle);
    tip += vector(j.p);
    rotate(n, j.axis - 3, angle);
  };
  for (auto j = tool_.rbegin(); j != tool_.rend(); ++j) carry(*j, 1);
  for (const Joint& j : work_) carry(j, -1);
  return {values(tip), values(n)};
}

template <bool kDirection>
ToolPose Kinematics::pose(const Position& at) const {
  Vector3d tip = vector(tool_point_), n = Vector3d::UnitZ();
  const auto both = [&](auto rotation) {
    rotation(tip);
    if constexpr (kDirection) rotation(n);
  };
  for (auto j = tool_.rbegin(); j != tool_.rend(); ++j) {
    const double q = at.q[j->axis];
    const auto E = j->errors.at(q, q * j->inverse_Q, at.sign[j->axis]);
    const std::array<Turn, 3> small = {turn(E[3]), turn(E[4]), turn(E[5])};
    const Vector3d shift(E[0], E[1], E[2]);
    tip -= vector(j->p);
    if (j->axis < 3) {  // Eq. (1)
      both([&](Vector3d& v) { tilt(v, small); });
      tip += q * vector(j->travel) + vector(j->p) + shift;
    } else {  // Eq. (2)
      const Turn angle = turn(q);
      both([&](Vector3d& v) {
        rotate(v, j->axis - 3, angle);
        tilt(v, small);
      });
      tip += shift;
      both([&](Vector3d& v) { tilt(v, j->tilt); });
      tip += vector(j->p) + vector(j->location);
    }
  }
  for (const Joint& j : work_) {  // inverse of (1) and (2) with sigma = -1
    const double q = at.q[j.axis];
    const auto E = j.errors.at(q, q * j.inverse_Q, at.sign[j.axis]);
    const std::array<Turn, 3> small = {turn(E[3]), turn(E[4]), turn(E[5])};
    const Vector3d shift(E[0], E[1], E[2]);
    tip -= vector(j.p);
    if (j.axis < 3) {
      tip += q * vector(j.travel) - shift;
      both([&](Vector3d& v) { untilt(v, small); });
    } else {
      tip -= vector(j.location);
      both([&](Vector3d& v) { untilt(v, j.tilt); });
      tip -= shift;
      const Turn angle = turn(q);  // the inverse of -q
      both([&](Vector3d& v) {
        untilt(v, small);
        rotate(v, j.axis - 3, angle);
      });
    }
    tip += vector(j.p);
  }
  return {values(tip), values(n)};
}

ToolPose Kinematics::actual(const Position& at) const { return pose<true>(at); }

Vec3 Kinematics::actual_tip_mm(const Position& at) const {
  return pose<false>(at).tip_mm;
}

Vec3 Kinematics::tip_error_mm(const Position& at) const {
  return values(vector(actual_tip_mm(at)) - vector(nominal(at).tip_mm));
}

// The nominal tip and its error are carried together, joint by joint; their rotation
// gives R_i^T (P - p_i) and R_fw^T R_i of (4).
Vec3 Kinematics::tip_error_first_order_mm(const Position& at) const {
  Vector3d tip = vector(tool_point_), e = Vector3d::Zero();
  const auto added = [&](const Joint& j) -> Vector3d {
    const double q = at.q[j.axis];
    const auto E = j.small.at(q, q * j.inverse_Q, at.sign[j.axis]);
    const Vector3d d(E[0], E[1], E[2]), r(E[3], E[4], E[5]);
    return d + r.cross(tip - vector(j.p));  // Eq. (4)
  };
  const auto turned = [&](const Joint& j) {
    const Turn angle = turn(at.q[j.axis]);
    tip -= vector(j.p);
    rotate(tip, j.axis - 3, angle);
    tip += vector(j.p);
    rotate(e, j.axis - 3, angle);
  };
  for (auto j = tool_.rbegin(); j != tool_.rend(); ++j) {
    if (j->axis > 2) turned(*j);
    e += added(*j);
    // The travel of a linear joint moves tip and reference point by the same amount.
    if (j->axis < 3) tip[static_cast<Eigen::Index>(j->axis)] += at.q[j->axis];
  }
  for (const Joint& j : work_) {
    if (j.axis < 3) tip[static_cast<Eigen::Index>(j.axis)] += at.q[j.axis];
    e -= added(j);
    if (j.axis > 2) turned(j);
  }
  return values(e);
}

double Kinematics::bend_at_most(const Vec3& reach_mm) const {
  const double far = vector(reach_mm).norm() + vector(tool_point_).norm();
  double sum = 0;
  for (const auto* joints : {&tool_, &work_})
    for (const Joint& j : *joints) {
      if (j.axis > 2) continue;  // at rest: its lever changes linearly
      const double t = reach_mm[j.axis] * j.inverse_Q;
      const auto& c = j.errors.c;
      const Errors slope = j.inverse_Q * (array(c[1]).abs() + 2 * t * array(c[2]).abs() +
                                          3 * t * t * array(c[3]).abs());
      const Errors bend =
          j.inverse_Q * j.inverse_Q * (2 * array(c[2]).abs() + 6 * t * array(c[3]).abs());
      sum += bend.matrix().head<3>().norm() + 2 * slope.matrix().tail<3>().norm() +
             bend.matrix().tail<3>().norm() * (far + vector(j.p).norm());  // Eq. (5)
    }
  return sum;
}

std::vector<AxisEffect> Kinematics::effects(const Position& at) const {
  std::vector<AxisEffect> out;
  // R: R_fw^T R_i of (4) with the sign of its side; lever: R_i^T (P - p_i).
  const auto add = [&](const Joint& j, const Matrix3d& R, const Vector3d& lever) {
    AxisEffect effect{.axis = kLetters[j.axis]};
    const Vector3d travel =
        j.sigma * at.q[j.axis] * Vector3d::Unit(static_cast<Eigen::Index>(j.axis % 3));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d axis = Vector3d::Unit(static_cast<Eigen::Index>(k));
      effect.error[k] = values(R * axis);
      effect.error[k + 3] = values(R * axis.cross(lever));
      if (j.axis < 3) effect.squareness[k] = values(R * axis.cross(travel));
    }
    out.push_back(effect);
  };
  Matrix3d to_work = Matrix3d::Identity();
  for (const Joint& j : work_)
    if (j.axis > 2) to_work = matrix(j.axis - 3, turn(at.q[j.axis])) * to_work;
  std::array<Vector3d, kDirections> levers;
  Vector3d tip = vector(tool_point_);
  const auto carry = [&](const Joint& j) {
    const double q = at.q[j.axis];
    if (j.axis < 3) {
      tip[static_cast<Eigen::Index>(j.axis)] += q;
    } else {
      tip -= vector(j.p);
      rotate(tip, j.axis - 3, turn(q));
      tip += vector(j.p);
    }
  };
  for (std::size_t i = tool_.size(); i-- > 0;) {
    if (tool_[i].axis > 2) carry(tool_[i]);
    levers[i] = tip - vector(tool_[i].p);
    if (tool_[i].axis < 3) carry(tool_[i]);
  }
  Matrix3d R = to_work;
  for (std::size_t i = 0; i < tool_.size(); ++i) {
    add(tool_[i], R, levers[i]);
    if (tool_[i].axis > 2) R = R * matrix(tool_[i].axis - 3, turn(at.q[tool_[i].axis]));
  }
  R = -to_work;
  for (const Joint& j : work_) {
    if (j.axis < 3) carry(j);
    add(j, R, tip - vector(j.p));
    if (j.axis > 2) {
      carry(j);
      R = R * matrix(j.axis - 3, back(turn(at.q[j.axis])));
    }
  }
  return out;
}

}  // namespace turnwright::volumetric
