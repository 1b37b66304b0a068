#include <algorithm>
#include <array>
#include <cmath>

#include "base/say.hpp"
#include "exchange/contour/thread_undercut.hpp"
#include "exchange/demands/step_pmi.hpp"
#include "step_milled.hpp"
#include "turnwright/exchange/profile.hpp"
#include "turnwright/exchange/step.hpp"

namespace turnwright::exchange {
namespace {

// First choice of ISO 261 for general use, coarse pitches, from M3 on.
constexpr std::array kThreads_mm{3.,  4.,  5.,  6.,  8.,  10., 12., 16.,
                                 20., 24., 30., 36., 42., 48., 56., 64.};

// At an end of the part or beside a groove, without a fit or limits.
bool may_be_thread(const std::vector<Element>& all, std::size_t i) {
  const auto ends_at = [&](std::size_t k) {
    return k >= all.size() || all[k].shape == Shape::groove;
  };
  const Element& e = all[i];
  return e.shape == Shape::cylinder && !e.demands.fit && !e.demands.limits &&
         (i == 0 || ends_at(i - 1) || ends_at(i + 1));
}

// A cosmetic thread is a cylinder in the file.
void offer_threads(Outline& outline) {
  constexpr double kDiameter_mm = 1e-6;
  for (std::size_t i = 0; i < outline.outer.size(); ++i) {
    const Element& e = outline.outer[i];
    const auto size =
        std::find_if(kThreads_mm.begin(), kThreads_mm.end(),
                     [&e](double d) { return std::abs(e.left_mm - d) < kDiameter_mm; });
    if (may_be_thread(outline.outer, i) && size != kThreads_mm.end())
      outline.assumed.push_back(
          {e.id, say("{} is a cylinder with the diameter of M{:g}; if it is a "
                     "thread, say so.",
                     e.id, *size)});
  }
}

}  // namespace

Outline read_step(std::string_view text, const StepOptions& options) {
  const Exchange file = read_part21(text);
  auto body = step_body(file, options);
  const auto faces = step_faces(file, body);
  const auto axis = turning_axis(faces);
  const auto contour = step_contour(faces, axis);
  auto outline = outline_of(contour.profile);
  outline.name = std::move(body.name);
  outline.assumed.insert(outline.assumed.begin(), body.assumed.begin(),
                         body.assumed.end());
  add_milled(faces, contour, axis, outline);
  add_pmi(file, outline);
  settle_thread_undercuts(outline);
  offer_threads(outline);
  return outline;
}

}  // namespace turnwright::exchange
