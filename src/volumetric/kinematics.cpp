// Tip and direction of the tool are carried joint by joint, from the tool to the bed and
// on to the workpiece, so that no matrix is multiplied by another.
#include "turnwright/volumetric/kinematics.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace turnwright::volumetric {

std::string chain_fault(std::string_view chain) {
  if (chain.size() < 3 || chain.front() != 'w' || chain.back() != 't')
    return "it runs from w to t";
  const auto inner = chain.substr(1, chain.size() - 2);
  if (std::ranges::count(inner, 'f') != 1) return "it has one bed f between w and t";
  for (const char c : inner) {
    if (c == 'f') continue;
    if (letter_index(c) == std::string_view::npos) return "its axes are of X Y Z A B C";
    if (std::ranges::count(inner, c) > 1) return "each axis comes once";
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

Matrix3d turn(std::size_t axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto j = static_cast<Eigen::Index>((axis + 1) % 3),
             k = static_cast<Eigen::Index>((axis + 2) % 3);
  Matrix3d R = Matrix3d::Identity();
  R(j, j) = R(k, k) = c;
  R(j, k) = -s;
  R(k, j) = s;
  return R;
}

/// Rz(C) Ry(B) Rx(A).
Matrix3d tilted(double A, double B, double C) {
  const double ca = std::cos(A), sa = std::sin(A), cb = std::cos(B), sb = std::sin(B),
               cc = std::cos(C), sc = std::sin(C);
  Matrix3d R;
  R << cc * cb, cc * sb * sa - sc * ca, cc * sb * ca + sc * sa,  //
      sc * cb, sc * sb * sa + cc * ca, sc * sb * ca - cc * sa,   //
      -sb, cb * sa, cb * ca;
  return R;
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
            .travel = {},
            .c = {},
            .b = {},
            .f = {},
            .location = axis.location,
            .tilt = {}};
    const Vector3d s(axis.location[3], axis.location[4], axis.location[5]);
    if (!is_rotary(name)) j.travel = values(direction(j.axis, s).normalized());
    Eigen::Map<Matrix3d>(j.tilt.data()) = tilted(s.x(), s.y(), s.z());
    for (std::size_t k = 0; k < kDirections; ++k) {
      const ErrorFunction& e = axis.errors[k];
      for (std::size_t n = 0; n < 4; ++n) j.c[n][k] = e.c[n];
      j.b[k] = e.b;
      if (j.f.size() < e.f.size()) j.f.resize(e.f.size());
      for (std::size_t h = 0; h < e.f.size(); ++h) {
        j.f[h][0][k] = e.f[h].a;
        j.f[h][1][k] = e.f[h].d;
      }
    }
    return j;
  };
  const std::size_t bed = machine.chain.find('f');
  for (std::size_t i = bed + 1; i + 1 < machine.chain.size(); ++i)
    tool_.push_back(joint(machine.chain[i], 1));
  for (std::size_t i = bed - 1; i > 0; --i) work_.push_back(joint(machine.chain[i], -1));
}

std::array<double, kDirections> Kinematics::errors(const Joint& j, const Position& at) {
  const double q = at.q[j.axis], t = q * j.inverse_Q;
  std::array<double, kDirections> out;
  Eigen::Map<Errors> E(out.data());
  // machine.hpp (1)
  E = array(j.c[0]) + t * (array(j.c[1]) + t * (array(j.c[2]) + t * array(j.c[3]))) +
      at.sign[j.axis] * array(j.b);
  for (std::size_t h = 0; h < j.f.size(); ++h) {
    const double hq = static_cast<double>(h + 1) * q;
    E += std::cos(hq) * array(j.f[h][0]) + std::sin(hq) * array(j.f[h][1]);
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
    const Matrix3d R = turn(j.axis - 3, q);
    tip = vector(j.p) + R * (tip - vector(j.p));
    n = R * n;
  };
  for (auto j = tool_.rbegin(); j != tool_.rend(); ++j) carry(*j, 1);
  for (const Joint& j : work_) carry(j, -1);
  return {values(tip), values(n)};
}

ToolPose Kinematics::actual(const Position& at) const {
  Vector3d tip = vector(tool_point_), n = Vector3d::UnitZ();
  for (auto j = tool_.rbegin(); j != tool_.rend(); ++j) {
    const auto E = errors(*j, at);
    const Vector3d shift(E[0], E[1], E[2]);
    const double q = at.q[j->axis];
    const auto p = vector(j->p);
    Matrix3d R = tilted(E[3], E[4], E[5]);
    if (j->axis < 3) {
      tip = q * vector(j->travel) + p + shift + R * (tip - p);  // Eq. (1)
    } else {
      const Eigen::Map<const Matrix3d> tilt(j->tilt.data());
      R = R * turn(j->axis - 3, q);
      tip = p + vector({j->location[0], j->location[1], j->location[2]}) +
            tilt * (shift + R * (tip - p));  // Eq. (2)
      R = tilt * R;
    }
    n = R * n;
  }
  for (const Joint& j : work_) {  // inverse of (1) and (2) with sigma = -1
    const auto E = errors(j, at);
    const Vector3d shift(E[0], E[1], E[2]);
    const double q = -at.q[j.axis];
    const auto p = vector(j.p);
    Matrix3d R = tilted(E[3], E[4], E[5]);
    if (j.axis < 3) {
      tip = p + R.transpose() * (tip - q * vector(j.travel) - p - shift);
    } else {
      const Eigen::Map<const Matrix3d> tilt(j.tilt.data());
      R = R * turn(j.axis - 3, q);
      const Vector3d moved =
          tip - p - vector({j.location[0], j.location[1], j.location[2]});
      tip = p + R.transpose() * (tilt.transpose() * moved - shift);
      R = tilt * R;
    }
    n = R.transpose() * n;
  }
  return {values(tip), values(n)};
}

Vec3 Kinematics::tip_error_mm(const Position& at) const {
  return values(vector(actual(at).tip_mm) - vector(nominal(at).tip_mm));
}

/// Calls visit(joint, R_fw^T R_i times the sign of its side, R_i^T (P - p_i)).
template <class Visit>
void Kinematics::first_order(const Position& at, Visit visit) const {
  // From outside inwards: the tip as the bodies nearer the bed see it is carried to the
  // bed; what lies between needs only the rotation R_fw^T R_i of all of them.
  Matrix3d to_work = Matrix3d::Identity();
  for (auto j = work_.begin(); j != work_.end(); ++j)
    if (j->axis > 2) to_work = turn(j->axis - 3, at.q[j->axis]) * to_work;
  Matrix3d R = to_work;
  std::array<Vector3d, kDirections> tips;
  Vector3d tip = vector(tool_point_);
  const auto carry = [&](const Joint& j, double q) {
    if (j.axis < 3)
      tip[static_cast<Eigen::Index>(j.axis)] += q;
    else
      tip = vector(j.p) + turn(j.axis - 3, q) * (tip - vector(j.p));
  };
  for (std::size_t i = tool_.size(); i-- > 0;) {
    // A linear joint's own travel moves tip and reference point alike.
    if (tool_[i].axis > 2) carry(tool_[i], at.q[tool_[i].axis]);
    tips[i] = tip - vector(tool_[i].p);
    if (tool_[i].axis < 3) carry(tool_[i], at.q[tool_[i].axis]);
  }
  for (std::size_t i = 0; i < tool_.size(); ++i) {
    visit(tool_[i], R, tips[i]);
    if (tool_[i].axis > 2) R = R * turn(tool_[i].axis - 3, at.q[tool_[i].axis]);
  }
  R = -to_work;
  for (const Joint& j : work_) {
    const double q = at.q[j.axis];
    if (j.axis < 3) carry(j, q);
    visit(j, R, tip - vector(j.p));
    if (j.axis > 2) {
      carry(j, q);
      R = R * turn(j.axis - 3, -q);
    }
  }
}

Vec3 Kinematics::tip_error_first_order_mm(const Position& at) const {
  Vector3d e = Vector3d::Zero();
  first_order(at, [&](const Joint& j, const Matrix3d& R, const Vector3d& lever) {
    const auto E = errors(j, at);
    Vector3d d(E[0], E[1], E[2]), r(E[3], E[4], E[5]);
    if (j.axis < 3) {
      d += j.sigma * at.q[j.axis] *
           (vector(j.travel) - Vector3d::Unit(static_cast<Eigen::Index>(j.axis)));
    } else {
      d += vector({j.location[0], j.location[1], j.location[2]});
      r += vector({j.location[3], j.location[4], j.location[5]});
    }
    e += R * (d + r.cross(lever));  // Eq. (4)
  });
  return values(e);
}

std::vector<AxisEffect> Kinematics::effects(const Position& at) const {
  std::vector<AxisEffect> out;
  first_order(at, [&](const Joint& j, const Matrix3d& R, const Vector3d& lever) {
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
  });
  return out;
}

}  // namespace turnwright::volumetric
