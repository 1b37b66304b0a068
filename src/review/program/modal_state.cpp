#include "modal_state.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/say.hpp"
#include "plane.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::review {
namespace {

using toolpath::Move;
using toolpath::Point;
using toolpath::Step;

constexpr std::size_t kUnknowns = 200;  // listed; more are counted by their reader
constexpr double kFarthest_mm = 1e5;
constexpr double kLongestDwell_min = 1e4;
constexpr double kLeastFeed = 1e-6, kLeastSpeed = 1e-3;  // less is none

bool same_conditions(const Step& a, const Step& b) {
  return a.stop == b.stop && a.tool == b.tool && a.S == b.S &&
         a.constant_surface_speed == b.constant_surface_speed &&
         a.n_max_rpm == b.n_max_rpm && a.f_mm_rev == b.f_mm_rev &&
         a.milling.has_value() == b.milling.has_value() &&
         (!a.milling || a.milling->f_mm_min == b.milling->f_mm_min);
}

}  // namespace

ModalState::ModalState(const ReadOptions& options)
    : limit_rpm(options.n_max_rpm), moves_max_(options.moves_max) {}

void list(std::vector<Unknown>& all, Unknown unknown) {
  const auto line = unknown.line;
  if (all.size() < kUnknowns) all.push_back(std::move(unknown));
  if (all.size() == kUnknowns)
    all.back() = {line, tr("more of this kind"), tr("Only the first 200 are listed.")};
}

void ModalState::unknown(std::string what, std::string why) {
  // A line of a loop is told once.
  for (const auto& u : program.unknown)
    if (u.line == line && u.what == what && u.why == why) return;
  list(program.unknown, {line, std::move(what), std::move(why)});
}

void ModalState::assume(const std::string& sentence) {
  auto& all = program.assumed;
  if (std::ranges::find(all, sentence) == all.end()) all.push_back(sentence);
}

Step ModalState::conditions(const Move& move, double lead_mm) {
  Step s;
  s.tool = tool;
  s.constant_surface_speed = surface_speed;
  s.S = S;
  s.n_max_rpm = surface_speed ? limit_rpm : 0;
  s.f_mm_rev = lead_mm > 0 ? lead_mm : F;
  if (per_revolution || lead_mm > 0) return s;
  double n = S;
  if (surface_speed) {
    assume(
        tr("A feed per minute at constant surface speed is taken at the spindle speed at "
           "the end of its move."));
    n = std::min(limit_rpm,
                 units::spindle_rpm(S, std::max(2 * std::abs(move.x_mm), 1e-3)));
  }
  s.f_mm_rev = n > 0 ? F / n : 0;
  return s;
}

// The feed of a driven tool; rapids belong to the cuts beside them.
void ModalState::mill(const Move& move) {
  Step step;
  step.tool = tool;
  toolpath::Milling m;
  m.n_rpm = milling.n_rpm;
  m.f_mm_min = per_revolution ? F * milling.n_rpm : F;
  auto& runs = program.runs;
  if (move.kind == Move::Kind::rapid)
    m.f_mm_min = !runs.empty() && runs.back().step.milling
                     ? runs.back().step.milling->f_mm_min
                     : std::max(m.f_mm_min, kLeastFeed);
  step.milling = m;
  if (!(m.f_mm_min >= kLeastFeed))
    return unknown(tr("a cut"), tr("No feed of the driven tool is given."));
  if (milled_by_.insert(tool).second)
    unknown(
        tool > 0 ? say("milling by T{}", tool) : tr("milling"),
        tr("Driven tools are not reviewed: their time counts, and the stock stays as it "
           "is."));
  std::optional<Point> from;
  if (x_mm && z_mm) from = Point{*x_mm, *z_mm};
  if (runs.empty() || !same_conditions(runs.back().step, step)) runs.push_back({step});
  runs.back().moves.push_back(
      {.from = from, .to = move, .line = line, .from_y_mm = milling.y_mm});
}

void ModalState::end_milling() {
  if (milling.c == MillingMode::C::plane && x_mm) x_mm = std::hypot(*x_mm, milling.y_mm);
  milling = {};
}

void ModalState::append(const Move& move, double lead_mm) {
  auto& runs = program.runs;
  std::optional<toolpath::Point> from;
  if (x_mm && z_mm) from = toolpath::Point{*x_mm, *z_mm};
  auto step = conditions(move, lead_mm);
  // A rapid belongs to the cuts that it leads to or from, whatever their feed.
  if (move.kind == Move::Kind::rapid && !runs.empty() && !runs.back().step.stop)
    step.f_mm_rev = runs.back().step.f_mm_rev;
  if (runs.empty() || !same_conditions(runs.back().step, step)) runs.push_back({step});
  runs.back().moves.push_back(
      {from, move, line, {F_line, S_line, !per_revolution}, nose});
}

// Between two straight feeds; what the corner takes of each is cut off.
void ModalState::break_corner(const Move& next) {
  const auto c = std::exchange(corner, {});
  auto* last = program.runs.empty() || program.runs.back().moves.empty()
                   ? nullptr
                   : &program.runs.back().moves.back();
  const auto straight = [](const Move& m) { return m.kind == Move::Kind::feed; };
  const auto refuse = [&] {
    unknown(tr("a chamfer or rounding"), tr("It is followed between straight cuts that "
                                            "are long enough, and left out here."));
  };
  if (!last || !last->from || !x_mm || !z_mm || !straight(last->to) || !straight(next) ||
      last->to.x_mm != *x_mm || last->to.z_mm != *z_mm)
    return refuse();
  const Point corner_at{*x_mm, *z_mm};
  const auto before = between(*last->from, corner_at);
  const auto behind = between(corner_at, {next.x_mm, next.z_mm});
  const double left = cross(before, behind);
  const double turn = std::atan2(std::abs(left), dot(before, behind));
  const double half = std::tan(turn / 2);
  const bool by_radius =
      c.form == Corner::Form::rounded || c.form == Corner::Form::chamfer_rounded;
  const double leg = by_radius ? c.size_mm * half
                     : c.form == Corner::Form::chamfer_across
                         ? c.size_mm / (2 * std::cos(turn / 2))
                         : c.size_mm;
  if (!(turn > 0) || !(leg < length(before) && leg < length(behind))) return refuse();
  const auto begins = plus(corner_at, unit(before), -leg);
  const auto ends = plus(corner_at, unit(behind), leg);
  last->to.x_mm = *x_mm = begins.h_mm;
  last->to.z_mm = *z_mm = begins.z_mm;
  Move m{Move::Kind::feed, ends.h_mm, ends.z_mm};
  if (c.form == Corner::Form::rounded) {
    // The centre lies on the side to which the way turns.
    m.kind = Move::Kind::arc;
    m.clockwise = left < 0;
    m.centre = plus(begins, to_the_right(unit(before)), std::copysign(c.size_mm, -left));
  }
  to(m);
}

void ModalState::to(Move move) {
  const bool feeds = move.kind != Move::Kind::rapid;
  if (corner.size_mm > 0) break_corner(move);
  if (++moves_ > moves_max_) return;
  if (!(std::abs(move.x_mm) <= kFarthest_mm && std::abs(move.z_mm) <= kFarthest_mm)) {
    unknown(tr("coordinates beyond 100 m"), tr("No machine goes there."));
    return lose_place();
  }
  if (!suspended.empty()) {
    if (feeds) unknown(tr("a cut"), suspended);
  } else if (milling.on) {
    mill(move);
    milling.y_mm = move.y_mm;
  } else if (feeds && !turning) {
    unknown(tr("a cut with the spindle at rest"), tr("No M3 or M4 is in force."));
  } else if (feeds && !(F >= kLeastFeed && S >= kLeastSpeed)) {
    unknown(tr("a cut"),
            F >= kLeastFeed ? tr("No spindle speed is given.") : tr("No feed is given."));
  } else {
    append(move, 0);
  }
  x_mm = move.x_mm;
  z_mm = move.z_mm;
}

void ModalState::straight(Move::Kind kind, std::optional<double> x,
                          std::optional<double> z) {
  if (!x) x = x_mm;
  if (!z) z = z_mm;
  if (x && z) {
    Move move{kind, *x, *z};
    move.y_mm = milling.y_mm;
    return to(move);
  }
  if (kind != Move::Kind::rapid)
    unknown(tr("a cut from a place that is not known"),
            tr("It is not followed: X or Z was not given before it."));
  x_mm = x;
  z_mm = z;
}

void ModalState::thread(double x, double z, double lead_mm) {
  if (++moves_ > moves_max_) return;
  if (!suspended.empty())
    unknown(tr("a thread"), suspended);
  else if (!(lead_mm >= kLeastFeed && S >= kLeastSpeed) || !turning)
    unknown(tr("a thread"), tr("Its lead or the spindle speed is not given."));
  else
    append({Move::Kind::thread, x, z}, lead_mm);
  x_mm = x;
  z_mm = z;
}

void ModalState::dwell(double min) {
  if (min > 0 && min <= kLongestDwell_min && !program.runs.empty())
    program.runs.back().wait_min += min;
}

void ModalState::dwell_turns(double turns) {
  double n = S;
  if (surface_speed && x_mm)
    n = std::min(limit_rpm, units::spindle_rpm(S, std::max(2 * std::abs(*x_mm), 1e-3)));
  if (n > 0) dwell(turns / n);
}

void ModalState::stop() {
  Run run;
  run.step.stop = true;
  program.runs.push_back(std::move(run));
}

}  // namespace turnwright::review
