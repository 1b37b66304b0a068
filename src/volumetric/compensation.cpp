#include "turnwright/volumetric/compensation.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/say.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/least_squares.hpp"
#include "turnwright/gcode/nc_writer.hpp"
#include "turnwright/volumetric/kinematics.hpp"

namespace turnwright::volumetric {

using gcode::NcWriter;

namespace {

Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vec3 operator*(double s, const Vec3& a) { return {s * a[0], s * a[1], s * a[2]}; }
double norm(const Vec3& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

/// The machine with one of its tools.
struct Tool {
  Kinematics kinematics;
  Vec3 point;
};

/// The machine with each of its tools.
class Field {
 public:
  Field(const Machine& machine, const NcSetup& setup) {
    const auto add = [&](int number, const Vec3& vector) {
      Machine m = machine;
      m.tool_point_mm = m.tool_point_mm + vector;
      if (setup.lathe)  // the spindle turns, so its harmonics have no mean effect
        for (Axis& axis : m.axes)
          for (ErrorFunction& e : axis.errors) e.f.clear();
      tools_.emplace(number, Tool{Kinematics(m), m.tool_point_mm});
    };
    add(0, {});
    for (const auto& [number, vector] : setup.tool_offsets_mm) add(number, vector);
    for (std::size_t k = 0; k < 3; ++k)
      counts_[k] = setup.axes.find(kLetters[k]) == std::string::npos ? 0 : 1;
  }

  const Tool& tool(int number) const { return tools_.at(number); }

  /// Length up to which a straight path between targets within `reach_mm` need not be
  /// split.
  double longest_straight_mm(const Vec3& reach_mm, double tolerance_mm) const {
    double bend = 0;
    for (const auto& [number, tool] : tools_) {
      Vec3 q;
      for (std::size_t k = 0; k < 3; ++k) q[k] = reach_mm[k] + std::abs(tool.point[k]);
      bend = std::max(bend, tool.kinematics.bend_at_most(q));
    }
    // A chord of length h deviates by bend h^2/8; half of the tolerance is reserved for
    // products of errors.
    return std::sqrt(4 * tolerance_mm / bend);
  }

  /// Error of the tip from `target` along the machine's axes when commanded to `at`.
  Vec3 error(const Tool& tool, const Vec3& at, const Vec3& sign,
             const Vec3& target) const {
    Position p;
    for (std::size_t k = 0; k < 3; ++k) {
      p.q[k] = at[k] - tool.point[k];
      p.sign[k] = sign[k];
    }
    const Vec3 e = tool.kinematics.actual_tip_mm(p) - target;
    return {counts_[0] * e[0], counts_[1] * e[1], counts_[2] * e[2]};
  }

 private:
  std::map<int, Tool> tools_;
  Vec3 counts_{};
};

/// A point the tip should reach, with the motion that brings it there.
struct Stop {
  const NcMove* move;
  const Tool* tool = nullptr;
  Vec3 from{}, target{};
  Vec3 sign{};                     // signs of the corrected motion
  Vec3 error{};                    // at the target, uncorrected
  Vec3 error_sign{};               // the signs that it has, at first the source's
  bool first = true, last = true;  // whether it is the first, the last stop of its move
  bool stays = false;              // whether an axis stays, see Run::approach
  bool takes_up = false;           // whether it takes up backlash before a feed move
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

/// Walks a program's moves, split where the error bends.
class Walk {
 public:
  Walk(const Field& field, const CompensationOptions& options)
      : field_(field), o_(options) {}

  /// Calls visit(stop) for each stop of all moves, and each line without any.
  template <class Visit>
  void run(const NcProgram& program, Visit visit) {
    int number = 0;
    tool_ = &field_.tool(number);
    unsplit_mm_ = field_.longest_straight_mm(reach(program), o_.tolerance_mm);
    // Position of the tip, signs of the motion to it, and its error.
    Vec3 from = program.start_mm, sign{},
         at_from = field_.error(*tool_, from, sign, from);
    for (const NcMove& m : program.moves) {
      leave_if_asked();
      if (!m.moves) {
        visit(Stop{.move = &m});
        continue;
      }
      if (m.tool !=
          number) {  // the axes stand still, the position is that of another tip
        const Tool& next = field_.tool(m.tool);
        from = from + next.point - tool_->point;
        number = m.tool;
        tool_ = &next;
        at_from = field_.error(next, from, sign, from);
      }
      const Vec3 before = std::exchange(sign, signs(from, m.target_mm, sign, o_.at_rest));
      Stop s{.move = &m, .tool = tool_, .sign = sign, .error_sign = sign};
      const Vec3 at_end = field_.error(*tool_, m.target_mm, sign, m.target_mm);
      ends_.clear();
      if (!m.rapid && o_.method == Method::full_field &&
          norm(m.target_mm - from) > unsplit_mm_) {
        if (sign != before) at_from = field_.error(*tool_, from, sign, from);
        split({from, at_from}, {m.target_mm, at_end}, sign, 0);
      }
      ends_.push_back({m.target_mm, at_end});
      s.target = from;
      for (const End& end : ends_) {
        s.from = std::exchange(s.target, end.at);
        s.error = end.error;
        s.first = &end == &ends_.front();
        s.last = &end == &ends_.back();
        visit(s);
      }
      from = m.target_mm;
      at_from = at_end;
    }
  }

 private:
  struct End {
    Vec3 at, error;
  };

  static Vec3 reach(const NcProgram& program) {
    Vec3 out{};
    const auto include = [&out](const Vec3& at) {
      for (std::size_t k = 0; k < 3; ++k) out[k] = std::max(out[k], std::abs(at[k]));
    };
    include(program.start_mm);
    for (const NcMove& m : program.moves)
      if (m.moves) include(m.target_mm);
    return out;
  }

  void split(const End& a, const End& b, const Vec3& sign, int depth) {
    constexpr int kDeepest = 12;
    if (depth == kDeepest || norm(b.at - a.at) <= unsplit_mm_) return;
    leave_if_asked();
    const auto inside = [&](double share) -> End {
      const Vec3 at = a.at + share * (b.at - a.at);
      return {at, field_.error(*tool_, at, sign, at)};
    };
    const auto bend = [&](double share, const Vec3& error) {
      return norm(error - (a.error + share * (b.error - a.error)));
    };
    const End middle = inside(0.5);
    // Quarters as well, because an odd bow is zero in the middle.
    if (!(bend(0.5, middle.error) > o_.tolerance_mm ||
          bend(0.25, inside(0.25).error) > o_.tolerance_mm ||
          bend(0.75, inside(0.75).error) > o_.tolerance_mm))
      return;
    split(a, middle, sign, depth + 1);
    ends_.push_back(middle);
    split(middle, b, sign, depth + 1);
  }

  const Field& field_;
  const CompensationOptions& o_;
  const Tool* tool_ = nullptr;
  double unsplit_mm_ = 0;
  std::vector<End> ends_;  // of the current move
};

/// Notes the error at a stop's target with the signs of its motion.
void find_error(const Field& field, Stop& s) {
  s.error = field.error(*s.tool, s.target, s.sign, s.target);
  s.error_sign = s.sign;
}

/// The error at a stop's target, uncorrected.
Vec3 error_at_target(const Field& field, const Stop& s, const Vec3& sign) {
  return sign == s.error_sign ? s.error : field.error(*s.tool, s.target, sign, s.target);
}

/// The command by (1), from the error at the target.
void correct(const Field& field, int passes, const Vec3& error, Stop& s) {
  s.command = s.target - error;
  for (int pass = 1; pass < passes; ++pass)
    s.command = s.command - field.error(*s.tool, s.command, s.sign, s.target);
}

/// Corrections of all moves' ends by a constant or affine map, fitted by least squares to
/// the corrections that the targets need by themselves.
void fitted(Method method, const Field& field, int passes, std::vector<Stop>& stops) {
  std::vector<Stop*> moving;
  for (Stop& s : stops)
    if (s.move->moves) moving.push_back(&s);
  const Eigen::Index columns = method == Method::affine ? 4 : 1;
  const auto n = static_cast<Eigen::Index>(moving.size());
  if (n == 0) return;
  Eigen::MatrixXd A(n, columns), e(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    leave_if_asked();
    Stop& s = *moving[static_cast<std::size_t>(i)];
    correct(field, passes, s.error, s);
    A(i, 0) = 1;
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (columns > 1) A(i, k + 1) = s.target[static_cast<std::size_t>(k)];
      e(i, k) =
          s.command[static_cast<std::size_t>(k)] - s.target[static_cast<std::size_t>(k)];
    }
  }
  // Points in a plane do not determine the slope across it, which has no effect there.
  Eigen::MatrixXd fit(n, 3);
  for (Eigen::Index k = 0; k < 3; ++k) fit.col(k) = A * least_squares(A, e.col(k)).x;
  for (Eigen::Index i = 0; i < n; ++i) {
    Stop& s = *moving[static_cast<std::size_t>(i)];
    s.command = s.target + Vec3{fit(i, 0), fit(i, 1), fit(i, 2)};
  }
}

/// The machine as the corrected program moves it; its backlash follows the corrected
/// motions, not those of the source.
class Run {
 public:
  Run(const Field& field, const NcWriter& writer, const CompensationOptions& options,
      const Vec3& start_mm)
      : field_(field),
        writer_(writer),
        o_(options),
        follows_(options.at_rest == AtRest::last),
        q_(start_mm - field.tool(0).point) {}

  /// The command of a stop by (1), with the signs of the resulting motions.  An axis
  /// whose correction would reverse its motion for either sign stays where it is.
  void approach(Stop& s) const {
    approach(s, signs(s.from, s.target, sign_, o_.at_rest));
  }

  /// The stops that take up backlash before a feed move on which an axis reverses, so
  /// that all axes start on the side on which the feed keeps them.  The command of `s` is
  /// computed again.  Axes approach the start in the feed's own direction.  An axis that
  /// would have to move against it, or not far enough to take up its backlash, overshoots
  /// and comes back; for a distance within rounding it stays.
  std::vector<Stop> take_up(Stop& s) const {
    if (s.move->rapid || (s.sign == sign_ && !s.stays && !slack(*s.move))) return {};
    Stop start = s;
    settle(s, start);
    std::vector<Stop> out;
    Stop beyond = start;
    bool goes = false, beyond_any = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const double step = writer_.step_mm(*s.move, k), at = q_[k] + s.tool->point[k],
                   way = start.command[k] - at, along = way * s.sign[k];
      goes = goes || std::abs(way) > step;
      if (!follows_) continue;
      const bool through = along >= play_to_go_mm(start, start.sign, k) - kWritten * step;
      if (through && along >= -0.5 * step) continue;
      if (!through) {
        goes = beyond_any = true;
        beyond.sign[k] = -s.sign[k];
        beyond.target[k] -= 2 * kRounding * step * s.sign[k];
      } else {
        start.command[k] = at;
        start.stays = s.stays = true;
        if ((s.command[k] - at) * s.sign[k] < 0) s.command[k] = at;
      }
    }
    if (beyond_any) out.push_back(gone_beyond(start, beyond));
    if (goes) out.push_back(start);
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i].first = s.first && i == 0;
      out[i].last = false;
    }
    if (!out.empty()) s.first = false;
    return out;
  }

  /// Moves to a command as written.  The signs of the stop become those of the motion,
  /// or, where backlash is taken up, those of the feed that follows.
  void go(Stop& s) {
    const Vec3 to = s.command - s.tool->point;
    if (follows_) {
      const Vec3 sign = made(s);
      for (std::size_t k = 0; k < 3; ++k)
        slack_mm_[k] = std::max(play_to_go_mm(s, sign, k) - std::abs(to[k] - q_[k]), 0.0);
      sign_ = sign;
    } else {
      sign_ = s.sign;
    }
    if (!s.takes_up) s.sign = sign_;
    q_ = to;
  }

 private:
  // Steps of the last decimal: the rounding of a motion's ends, and the least motion that
  // is made.
  static constexpr double kWritten = 1.01, kRounding = 1.5;

  /// Whether backlash remains to be taken up after the last motions.
  bool slack(const NcMove& move) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (slack_mm_[k] > kWritten * writer_.step_mm(move, k)) return true;
    return false;
  }

  /// Travel of an axis in a direction until the tip follows, after a motion with the sign
  /// `from`.  An axis with a negative lost motion has no backlash.
  double play_mm(const Stop& s, const Vec3& sign, std::size_t k, double from) const {
    Vec3 before = sign;
    before[k] = from;
    const Vec3 turn =
        error_at_target(field_, s, before) - error_at_target(field_, s, sign);
    return std::max(turn[k] * sign[k], 0.0);
  }

  /// The part of it that remains after the last motions.
  double play_to_go_mm(const Stop& s, const Vec3& sign, std::size_t k) const {
    return sign[k] == sign_[k] ? slack_mm_[k] : play_mm(s, sign, k, sign_[k]);
  }

  /// The stop before `start` at which axes turn back.  Axes whose sign in `s` differs from
  /// that in `start` go to the target of `s`, or farther if the way back to `start` would
  /// not take up their backlash; the others go to their command of `start`.
  Stop gone_beyond(const Stop& start, Stop s) const {
    find_error(field_, s);
    correct(field_, o_.passes, s.error, s);
    for (std::size_t k = 0; k < 3; ++k) {
      if (s.sign[k] == start.sign[k]) {
        s.command[k] = start.command[k];
        continue;
      }
      const double least = play_mm(start, start.sign, k, s.sign[k]) +
                           kRounding * writer_.step_mm(*s.move, k),
                   ahead = (start.command[k] - s.command[k]) * start.sign[k];
      if (ahead < least) s.command[k] = start.command[k] - least * start.sign[k];
    }
    return s;
  }

  Vec3 made(const Stop& s) const {
    return motion(s, s.command - s.tool->point - q_, sign_);
  }

  /// The signs of a motion, and for axes at rest their last signs.
  Vec3 motion(const Stop& s, const Vec3& way, const Vec3& at_rest) const {
    Vec3 out = at_rest;
    for (std::size_t k = 0; k < 3; ++k)
      if (std::abs(way[k]) > 0.500001 * writer_.step_mm(*s.move, k))
        out[k] = way[k] > 0 ? 1 : -1;
    return out;
  }

  /// The commands of a feed move's two ends with the signs of the motion between them.
  void settle(Stop& s, Stop& start) const {
    constexpr int kRounds = 4;
    start.target = s.from;
    start.takes_up = true;
    s.stays = false;
    s.sign = signs(s.from, s.target, sign_, o_.at_rest);
    for (int round = 0; round < kRounds; ++round) {
      start.sign = s.sign;
      find_error(field_, start);
      correct(field_, o_.passes, start.error, start);
      correct(field_, o_.passes, error_at_target(field_, s, s.sign), s);
      if (!follows_) return;
      start.command = writer_.written(*s.move, start.command);
      s.command = writer_.written(*s.move, s.command);
      const Vec3 is = motion(s, s.command - start.command, s.sign);
      if (is == s.sign || round + 1 == kRounds) return;
      s.sign = is;
    }
  }

  void approach(Stop& s, Vec3 sign) const {
    constexpr int kStays = 2;
    std::array<int, 3> turned{};
    for (bool settled = false; !settled;) {
      s.sign = sign;
      correct(field_, o_.passes, error_at_target(field_, s, sign), s);
      if (!follows_) return;
      for (std::size_t k = 0; k < 3; ++k)
        if (turned[k] == kStays) s.command[k] = q_[k] + s.tool->point[k];
      const Vec3 is = made(s);
      settled = true;
      for (std::size_t k = 0; k < 3; ++k) {
        if (is[k] == sign[k] || turned[k] == kStays) continue;
        settled = false;
        const bool stays = ++turned[k] == kStays;
        sign[k] = stays ? sign_[k] : is[k];
        s.stays = s.stays || stays;
      }
    }
  }

  const Field& field_;
  const NcWriter& writer_;
  const CompensationOptions& o_;
  const bool follows_;  // whether backlash is followed; otherwise signs are the source's
  Vec3 q_, sign_{};
  Vec3 slack_mm_{};  // backlash that remains in the direction of the last motion
};

/// Greatest and root mean square of distances.
class Distances {
 public:
  void add(double d) {
    max_ = std::max(max_, d);
    square_ += d * d;
    ++count_;
  }
  std::size_t count() const { return count_; }
  Deviation deviation() const {
    return {max_, count_ ? std::sqrt(square_ / static_cast<double>(count_)) : 0};
  }

 private:
  double max_ = 0, square_ = 0;
  std::size_t count_ = 0;
};

}  // namespace

Compensated compensate(const NcProgram& program, const Machine& machine,
                       const NcSetup& setup, const CompensationOptions& options) {
  const Field field(machine, setup);
  const bool full = options.method == Method::full_field;
  Compensated out;
  // Feeds that reverse become two moves; memory that is not used is not touched.
  out.lines.reserve(2 * program.moves.size());
  out.distances_mm.reserve(2 * program.moves.size());
  NcWriter writer(setup, options.decimals);
  Run run(field, writer, options, program.start_mm);
  Distances before, after;
  const auto write = [&](Stop& s) {
    leave_if_asked();
    out.lines.push_back(writer.block(*s.move, s.command, s.first, s.last));
    run.go(s);
    if (out.lines.size() > setup.moves_max)
      throw ModelRangeError(
          say("compensate: line {}: more than {} moves; a wider tolerance makes fewer",
              s.move->line, setup.moves_max));
    const double is = norm(s.error),
                 left = norm(field.error(*s.tool, s.command, s.sign, s.target));
    // The rounding of a coordinate is 0.5e-3 mm at most.
    if (full && !s.stays && !s.takes_up && !(left <= is / 2 + 1e-3))
      throw ModelRangeError(
          say("compensate: line {}: errors too large to be corrected by iteration",
              s.move->line));
    out.largest_correction_mm =
        std::max(out.largest_correction_mm, norm(s.command - s.target));
    before.add(is);
    after.add(left);
    out.distances_mm.push_back({static_cast<float>(is), static_cast<float>(left)});
    if (!s.last) ++out.added;
  };
  std::vector<Stop> stops;  // for the methods that need all stops at once
  Walk(field, options).run(program, [&](Stop s) {
    if (!full) {
      stops.push_back(s);
    } else if (!s.move->moves) {
      out.lines.push_back(s.move->before);
    } else {
      run.approach(s);
      for (Stop& before_it : run.take_up(s)) write(before_it);
      write(s);
    }
  });
  if (!full) fitted(options.method, field, options.passes, stops);
  for (Stop& s : stops) {
    if (s.move->moves)
      write(s);
    else
      out.lines.push_back(s.move->before);
  }
  out.points = before.count();
  out.before = before.deviation();
  out.after = after.deviation();
  return out;
}

}  // namespace turnwright::volumetric
