#include "thread_undercut.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "turnwright/part/metric_thread.hpp"

namespace turnwright::exchange {
namespace {

constexpr double kSame_mm = 1e-6;  // of pitches
constexpr double kRadius_mm = 0.05, kWidth_mm = 0.1, kReduced_mm = 0.05;

double pitch_mm(const Element& thread) {
  return thread.pitch_mm > 0 ? thread.pitch_mm
                             : part::coarse_pitch_mm(thread.left_mm).value_or(0);
}

// The lower of the two outer elements at an edge "d1|d2", whose corner it is.
const Element* foot(const Outline& o, const std::string& at) {
  for (std::size_t i = 1; i < o.outer.size(); ++i) {
    const Element &a = o.outer[i - 1], &b = o.outer[i];
    if (a.id + '|' + b.id == at) return a.right_mm < b.left_mm ? &a : &b;
  }
  return nullptr;
}

bool fits(const Edge& e, const Element& of) {
  return of.shape == Shape::thread && std::abs(pitch_mm(of) - e.pitch_mm) <= kSame_mm;
}

void leave_out(Outline& o, const Edge& e, const Element& of) {
  const std::string why = of.shape == Shape::thread
                              ? say("{} has a pitch of {:g} mm", of.id, pitch_mm(of))
                              : say("{} is no thread; if it is M{:g}x{:g}, say so", of.id,
                                    of.left_mm, e.pitch_mm);
  o.ignored.push_back(
      {fmt::format("{}", fmt::join(e.sources, ", ")),
       say("The undercut at {} is left out: it is the {} of a thread with a pitch "
           "of {:g} mm, and {}.",
           e.at, *e.undercut, e.pitch_mm, why)});
}

}  // namespace

std::optional<part::Undercut> thread_undercut_of(double radius_mm, double depth_mm,
                                                 double width_mm) {
  constexpr int kFewest = 10, kMost = 120;  // twentieths of a millimetre in pitches
  for (int i = kFewest; i <= kMost; ++i)
    for (const char form : {'A', 'B'}) {
      const auto row = part::thread_undercut(form, i / 20.0);
      if (row && std::abs(row->radius_mm - radius_mm) <= kRadius_mm &&
          std::abs(row->width_mm - width_mm) <= kWidth_mm &&
          2 * std::abs(row->depth_mm - depth_mm) < kReduced_mm)
        return row;
    }
  return std::nullopt;
}

void settle_thread_undercuts(Outline& o) {
  std::erase_if(o.edges, [&o](const Edge& e) {
    if (!(e.pitch_mm > 0)) return false;
    const Element* of = foot(o, e.at);
    if (!of || fits(e, *of)) return false;
    leave_out(o, e, *of);
    return true;
  });
}

}  // namespace turnwright::exchange
