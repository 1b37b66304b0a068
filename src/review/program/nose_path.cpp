#include "nose_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "modal_state.hpp"
#include "plane.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::review {
namespace {

using toolpath::Move;
using toolpath::Point;
using Kind = Move::Kind;

constexpr double kPi = std::numbers::pi;
constexpr double kSame_mm = 1e-6;

// A piece of the centre's way.
struct Piece {
  ReadMove move;        ///< that it comes from
  std::size_t run = 0;  ///< in which it is
  bool arc = false, clockwise = false;
  Point from = {}, to = {}, centre = {};
  Point begins = {}, ends = {};  ///< directions of the contour at both ends
  Point corner = {};             ///< the contour's end
  bool lost = false;             ///< an inner arc smaller than the nose

  double radius() const { return length(between(centre, from)); }
  // Whether a point of its line or circle lies on it.
  bool has(const Point& p) const {
    if (!arc) {
      const auto d = between(from, to), v = between(from, p);
      const double l = length(d);
      return dot(v, d) >= -kSame_mm * l && dot(v, d) <= l * (l + kSame_mm);
    }
    const double whole = turned(to), part = turned(p), slack = kSame_mm / radius();
    return part <= whole + slack || part >= 2 * kPi - slack;
  }

 private:
  // Angle from its beginning to a point in its own sense, 0 to 2 pi.
  double turned(const Point& p) const {
    const auto a = between(centre, from), b = between(centre, p);
    const double angle = std::atan2(cross(a, b), dot(a, b)) * (clockwise ? -1 : 1);
    return angle < 0 ? angle + 2 * kPi : angle;
  }
};

using Meetings = std::vector<Point>;

Meetings of_lines(const Piece& a, const Piece& b) {
  const auto d = between(a.from, a.to), e = between(b.from, b.to);
  const double c = cross(d, e);
  if (!(std::abs(c) > 1e-12 * length(d) * length(e))) return {};
  return {plus(a.from, d, cross(between(a.from, b.from), e) / c)};
}

Meetings of_line_and_arc(const Piece& line, const Piece& arc) {
  const auto d = unit(between(line.from, line.to)), v = between(line.from, arc.centre);
  const double along = dot(v, d), off = cross(d, v), R = arc.radius();
  const double half = R * R - off * off;
  if (!(half >= -kSame_mm * R)) return {};
  const double h = std::sqrt(std::max(0.0, half));
  return {plus(line.from, d, along - h), plus(line.from, d, along + h)};
}

Meetings of_arcs(const Piece& a, const Piece& b) {
  const auto v = between(a.centre, b.centre);
  const double D = length(v), R = a.radius(), r = b.radius();
  if (!(D > 0)) return {};
  const double along = (D * D + R * R - r * r) / (2 * D);
  const double half = R * R - along * along;
  if (!(half >= -kSame_mm * R)) return {};
  const double h = std::sqrt(std::max(0.0, half));
  const auto d = unit(v), foot = plus(a.centre, d, along);
  return {plus(foot, to_the_right(d), h), plus(foot, to_the_right(d), -h)};
}

// Where two pieces meet, next to the end of the first.
std::optional<Point> meeting(const Piece& a, const Piece& b) {
  const auto all = a.arc && b.arc ? of_arcs(a, b)
                   : a.arc        ? of_line_and_arc(b, a)
                   : b.arc        ? of_line_and_arc(a, b)
                                  : of_lines(a, b);
  std::optional<Point> nearest;
  for (const auto& p : all) {
    if (!a.has(p) || !b.has(p)) continue;
    if (!nearest || length(between(a.to, p)) < length(between(a.to, *nearest)))
      nearest = p;
  }
  return nearest;
}

// The moves of one contour.
class Contoured {
 public:
  Contoured(const Nose& nose, NoseSide side, TurningProgram& out)
      : nose_(nose), right_(side == NoseSide::right ? 1 : -1), out_(out) {}

  void add(const ReadMove& m, std::size_t run) {
    Piece p{.move = m, .run = run};
    const Point from = *m.from, to{m.to.x_mm, m.to.z_mm};
    p.corner = to;
    if (pieces_.empty()) {
      p.from = from;
      p.ends = unit(between(from, to));
      p.to = beside(to, p.ends);
      if (m.to.kind == Kind::arc)
        tell(m, tr("Compensation begins with an arc, which is taken as straight."));
      pieces_.push_back(p);
      return;
    }
    p.arc = m.to.kind == Kind::arc;
    if (p.arc) {
      p.clockwise = m.to.clockwise;
      p.centre = m.to.centre;
      p.begins = tangent(p, from);
      p.ends = tangent(p, to);
    } else {
      p.begins = p.ends = unit(between(from, to));
      if (!(length(between(from, to)) > 0)) return;  // nothing moves
    }
    p.from = beside(from, p.begins);
    p.to = beside(to, p.ends);
    if (p.arc && right_ * (p.clockwise ? 1 : -1) > 0 &&
        length(between(p.centre, from)) < nose_.radius_mm - kSame_mm) {
      p.lost = true;
      tell(m, tr("An arc is smaller than the tool's nose; it is left out."));
    }
    join(p);
    pieces_.push_back(p);
  }

  /// Writes the tip's moves; where it then stands.
  Point write() {
    if (pieces_.size() > 1) pieces_.front().to = pieces_[1].from;
    Point at = *pieces_.front().move.from;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const auto& p = pieces_[i];
      if (p.lost || (p.arc && length(between(p.from, p.to)) <= kSame_mm)) continue;
      auto m = p.move;
      m.nose = {};
      m.from = at;
      const auto to = tip(p.to);
      m.to.kind = p.arc || m.to.kind != Kind::arc ? m.to.kind : Kind::feed;
      m.to.clockwise = p.clockwise;
      m.to.x_mm = to.h_mm;
      m.to.z_mm = to.z_mm;
      m.to.centre = tip(p.centre);
      out_.runs[p.run].moves.push_back(m);
      at = to;
    }
    return at;
  }

 private:
  Point beside(const Point& p, const Point& direction) const {
    return plus(p, to_the_right(direction), right_ * nose_.radius_mm);
  }
  static Point tangent(const Piece& arc, const Point& at) {
    const auto radial = unit(between(arc.centre, at));
    const double sense = arc.clockwise ? 1 : -1;
    return {sense * -radial.z_mm, sense * radial.h_mm};
  }
  Point tip(const Point& centre) const {
    const double r = nose_.radius_mm;
    return {centre.h_mm + (nose_.inner ? r : -r), centre.z_mm - r};  // Eq. (1)
  }
  void tell(const ReadMove& m, const std::string& why) {
    list(out_.unknown, {m.line, tr("tool nose radius compensation"), why});
  }

  // Joins a piece to the one before, the first of which only leads to its beginning.
  void join(Piece& next) {
    std::size_t i = pieces_.size() - 1;
    bool meets = next.lost;
    while (i > 0 && pieces_[i].lost) --i, meets = true;
    if (i == 0 || next.lost) return;
    auto& last = pieces_[i];
    if (length(between(last.to, next.from)) <= kSame_mm) return;
    const double turn = cross(last.ends, next.begins);
    if (!meets && right_ * turn >= 0) return around(last, next);
    if (const auto p = meeting(last, next)) {
      last.to = next.from = *p;
      return;
    }
    tell(next.move,
         tr("The tool's nose does not fit a corner; it is cut straight across."));
    link(last, next);
  }
  void around(const Piece& last, const Piece& next) {
    if (next.move.to.kind == Kind::rapid) return link(last, next);
    auto p = link_piece(last, next);
    p.arc = true;
    p.clockwise = right_ < 0;
    p.centre = last.corner;
    p.move.to.kind = Kind::arc;
    pieces_.push_back(p);
  }
  void link(const Piece& last, const Piece& next) {
    auto p = link_piece(last, next);
    if (p.move.to.kind == Kind::arc) p.move.to.kind = Kind::feed;
    pieces_.push_back(p);
  }
  static Piece link_piece(const Piece& last, const Piece& next) {
    Piece p{.move = next.move, .run = next.run};
    p.from = last.to;
    p.to = next.from;
    p.corner = last.corner;
    return p;
  }

  Nose nose_;
  double right_;
  TurningProgram& out_;
  std::vector<Piece> pieces_;
};

class Compensation {
 public:
  Compensation(const TurningProgram& program,
               const std::function<std::optional<Nose>(int)>& nose_of)
      : program_(program), nose_of_(nose_of) {
    out_.named_tools = program.named_tools;
    out_.unknown = program.unknown;
    out_.assumed = program.assumed;
    for (const auto& run : program.runs)
      out_.runs.push_back({.step = run.step, .wait_min = run.wait_min});
  }

  TurningProgram result() {
    for (std::size_t i = 0; i < program_.runs.size(); ++i)
      for (const auto& m : program_.runs[i].moves) move(m, i);
    end();
    return std::move(out_);
  }

 private:
  void move(const ReadMove& m, std::size_t run) {
    const int tool = program_.runs[run].step.tool;
    const bool goes_on = contour_ && m.nose.side == side_ && tool == tool_ && m.from &&
                         m.to.kind != Kind::thread;
    if (!goes_on) end();
    auto from = m;
    if (tip_ && m.from) from.from = tip_;
    tip_.reset();
    if (goes_on) return contour_->add(m, run);
    if (m.nose.side == NoseSide::none || !m.from) return plain(from, run);
    auto nose = nose_of_(tool);
    if (nose && m.nose.radius_mm > 0) nose->radius_mm = m.nose.radius_mm;
    if (!nose || !(nose->radius_mm > 0)) return plain(from, run);
    if (m.to.kind == Kind::thread) {
      list(out_.unknown, {m.line, tr("tool nose radius compensation"),
                          tr("Threads are cut without it.")});
      return plain(from, run);
    }
    side_ = m.nose.side;
    tool_ = tool;
    contour_.emplace(*nose, side_, out_);
    contour_->add(from, run);
  }
  void plain(const ReadMove& m, std::size_t run) { out_.runs[run].moves.push_back(m); }
  void end() {
    if (contour_) tip_ = contour_->write();
    contour_.reset();
  }

  const TurningProgram& program_;
  const std::function<std::optional<Nose>(int)>& nose_of_;
  TurningProgram out_;
  std::optional<Contoured> contour_;
  std::optional<Point> tip_;  ///< where the last contour ended
  NoseSide side_ = NoseSide::none;
  int tool_ = 0;
};

}  // namespace

TurningProgram with_nose_paths(
    const TurningProgram& program,
    const std::function<std::optional<Nose>(int tool)>& nose_of) {
  return Compensation(program, nose_of).result();
}

}  // namespace turnwright::review
