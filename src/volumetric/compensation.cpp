#include "turnwright/volumetric/compensation.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "turnwright/volumetric/kinematics.hpp"

namespace turnwright::volumetric {
namespace {

Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vec3 operator*(double s, const Vec3& a) { return {s * a[0], s * a[1], s * a[2]}; }
double norm(const Vec3& a) { return std::hypot(a[0], a[1], a[2]); }

/// The machine with each of its tools.
class Field {
 public:
  Field(const Machine& machine, const NcSetup& setup) : axes_(setup.axes) {
    const auto add = [&](int number, const Vec3& vector) {
      Machine m = machine;
      m.tool_point_mm = m.tool_point_mm + vector;
      tools_.emplace(number, Tool{Kinematics(m), m.tool_point_mm});
    };
    add(0, {});
    for (const auto& [number, vector] : setup.tool_offsets_mm) add(number, vector);
  }

  /// Of the tip from `target` when commanded to `at`, along the machine's axes.
  Vec3 error(int tool, const Vec3& at, const Vec3& sign, const Vec3& target) const {
    const Tool& t = tools_.at(tool);
    Position p;
    for (std::size_t k = 0; k < 3; ++k) {
      p.q[k] = at[k] - t.point[k];
      p.sign[k] = sign[k];
    }
    Vec3 e = t.kinematics.actual(p).tip_mm - target;
    for (std::size_t k = 0; k < 3; ++k)
      if (axes_.find(kLetters[k]) == std::string::npos) e[k] = 0;
    return e;
  }

 private:
  struct Tool {
    Kinematics kinematics;
    Vec3 point;
  };
  std::string axes_;
  std::map<int, Tool> tools_;
};

/// A point the tip should reach, with the motion that brings it there.
struct Stop {
  const NcMove* move;
  Vec3 target{}, sign{};
  bool first = true, last = true;  // of its move's
  Vec3 command{};
};

Vec3 signs(const Vec3& from, const Vec3& to, const Vec3& before, AtRest at_rest) {
  Vec3 out{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double way = to[k] - from[k];
    // Ends of arcs in the same coordinate differ by rounding.
    if (std::abs(way) > 1e-9)
      out[k] = way > 0 ? 1 : -1;
    else if (at_rest == AtRest::last)
      out[k] = before[k];
  }
  return out;
}

class Compensator {
 public:
  Compensator(const Field& field, const CompensationOptions& options)
      : field_(field), o_(options) {}

  /// Straight moves, split where the error bends; signs of all.
  std::vector<Stop> stops(const NcProgram& program) {
    std::vector<Stop> out;
    Vec3 from = program.start_mm, sign{};
    for (const NcMove& m : program.moves) {
      if (!m.moves) {
        out.push_back({.move = &m});
        continue;
      }
      const Vec3 next = signs(from, m.target_mm, sign, o_.at_rest);
      const bool whole = m.rapid || o_.method != Method::full_field;
      std::vector<Vec3> ends;
      if (!whole) {
        if (norm(field_.error(m.tool, from, next, from) -
                 field_.error(m.tool, from, sign, from)) > 0 &&
            turned(sign, next))
          ends.push_back(from);
        split(m, from, m.target_mm, next, 0, ends);
      }
      ends.push_back(m.target_mm);
      for (std::size_t i = 0; i < ends.size(); ++i)
        out.push_back({.move = &m,
                       .target = ends[i],
                       .sign = next,
                       .first = i == 0,
                       .last = i + 1 == ends.size()});
      from = m.target_mm;
      sign = next;
    }
    return out;
  }

  void full_field(Stop& s) const {
    s.command = s.target;
    for (int pass = 0; pass < o_.passes; ++pass)  // Eq. (1)
      s.command = s.command - field_.error(s.move->tool, s.command, s.sign, s.target);
  }

 private:
  static bool turned(const Vec3& before, const Vec3& now) {
    for (std::size_t k = 0; k < 3; ++k)
      if (before[k] != now[k]) return true;
    return false;
  }

  void split(const NcMove& m, const Vec3& a, const Vec3& b, const Vec3& sign, int depth,
             std::vector<Vec3>& ends) const {
    constexpr int kDeepest = 12;
    if (depth == kDeepest) return;
    const auto at = [&](double share) { return a + share * (b - a); };
    const auto error = [&](double share) {
      return field_.error(m.tool, at(share), sign, at(share));
    };
    const Vec3 e0 = error(0), e1 = error(1);
    // Quarters as well: an odd bow has none in the middle.
    double bend = 0;
    for (const double share : {0.25, 0.5, 0.75})
      bend = std::max(bend, norm(error(share) - (e0 + share * (e1 - e0))));
    if (!(bend > o_.tolerance_mm)) return;
    split(m, a, at(0.5), sign, depth + 1, ends);
    ends.push_back(at(0.5));
    split(m, at(0.5), b, sign, depth + 1, ends);
  }

  const Field& field_;
  const CompensationOptions& o_;
};

/// Of all moves' ends by a map of least squares: constant, or affine in the target.
void fitted(const Field& field, Method method, std::vector<Stop>& stops) {
  std::vector<Stop*> moving;
  for (Stop& s : stops)
    if (s.move->moves) moving.push_back(&s);
  const Eigen::Index columns = method == Method::affine ? 4 : 1;
  const auto n = static_cast<Eigen::Index>(moving.size());
  if (n == 0) return;
  Eigen::MatrixXd A(n, columns), e(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Stop& s = *moving[static_cast<std::size_t>(i)];
    const Vec3 error = field.error(s.move->tool, s.target, s.sign, s.target);
    A(i, 0) = 1;
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (columns > 1) A(i, k + 1) = s.target[static_cast<std::size_t>(k)];
      e(i, k) = error[static_cast<std::size_t>(k)];
    }
  }
  // Complete: points in a plane leave the slope across it open, here zero.
  const Eigen::MatrixXd fit =
      A * Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(A).solve(e);
  for (Eigen::Index i = 0; i < n; ++i) {
    Stop& s = *moving[static_cast<std::size_t>(i)];
    s.command = s.target - Vec3{fit(i, 0), fit(i, 1), fit(i, 2)};
  }
}

class Writer {
 public:
  Writer(const NcSetup& setup, int decimals) : setup_(setup), decimals_(decimals) {}

  /// The line of a stop; its command becomes what is written.
  std::string line(Stop& s) {
    const NcMove& m = *s.move;
    std::string out = s.first ? m.before : "";
    if (!out.empty()) out += ' ';
    out += m.rapid ? "G0" : "G1";
    if (!absolute_) out += " G90";
    absolute_ = true;
    const int decimals = decimals_ + (m.inch ? 2 : 0);
    const double unit = m.inch ? 25.4 : 1;
    for (std::size_t k = 0; k < 3; ++k) {
      if (setup_.axes.find(kLetters[k]) == std::string::npos) continue;
      const double factor = (k == 0 && m.diameter ? 2 : 1) / unit;
      std::array<char, 40> text;
      const double value = (s.command[k] - m.origin_mm[k]) * factor;
      const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                     std::chars_format::fixed, decimals)
                           .ptr;
      double written = 0;
      std::from_chars(text.data(), end, written, std::chars_format::fixed);
      s.command[k] = written / factor + m.origin_mm[k];
      out += ' ';
      out += kLetters[k];
      out.append(text.data(), end);
    }
    if (s.last && !m.after.empty()) out += ' ' + m.after;
    return out;
  }

 private:
  const NcSetup& setup_;
  int decimals_;
  bool absolute_ = false;
};

Deviation deviation(const std::vector<double>& distance) {
  Deviation d;
  for (const double x : distance) {
    d.max_mm = std::max(d.max_mm, x);
    d.rms_mm += x * x;
  }
  if (!distance.empty())
    d.rms_mm = std::sqrt(d.rms_mm / static_cast<double>(distance.size()));
  return d;
}

}  // namespace

Compensated compensate(const NcProgram& program, const Machine& machine,
                       const NcSetup& setup, const CompensationOptions& options) {
  const Field field(machine, setup);
  Compensator compensator(field, options);
  std::vector<Stop> stops = compensator.stops(program);
  if (options.method != Method::full_field) fitted(field, options.method, stops);
  Compensated out;
  Writer writer(setup, options.decimals);
  std::vector<double> before, after;
  for (Stop& s : stops) {
    if (!s.move->moves) {
      out.lines.push_back(s.move->before);
      continue;
    }
    if (options.method == Method::full_field) compensator.full_field(s);
    out.lines.push_back(writer.line(s));
    out.largest_correction_mm =
        std::max(out.largest_correction_mm, norm(s.command - s.target));
    before.push_back(norm(field.error(s.move->tool, s.target, s.sign, s.target)));
    after.push_back(norm(field.error(s.move->tool, s.command, s.sign, s.target)));
    if (!s.last) ++out.added;
  }
  out.points = before.size();
  out.before = deviation(before);
  out.after = deviation(after);
  return out;
}

}  // namespace turnwright::volumetric
