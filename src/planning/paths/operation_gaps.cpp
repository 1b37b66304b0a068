#include "operation_gaps.hpp"

#include <cmath>

#include "planning/clamping/supports.hpp"

namespace turnwright::planning {

Order::Order(const PreparedPart& p, std::size_t setup, Clamping clamping, double front,
             Stage before)
    : p_(p),
      setup_(setup),
      clamping_(clamping),
      home_(home_of(p, front)),
      force_N_(jaw_force_N(p, setup, clamping, before)) {}

double Order::home_mm(bool inner) const { return inner ? home_.x_mm : home_.z_mm; }

// Along the other axis to where the tool goes along the part.
constexpr double kAside_mm = kChange_mm - kClear_mm;

void Order::leave() {
  if (out_) sum_.rapid_mm += kAside_mm + home_mm(last_.inner) - last_.to_mm;
  out_ = false;
}

void Order::add(const InOrder& o) {
  bool stops = o.milled;
  if (!clamped_ && !o.chuck_alone) {
    clamped_ = true;
    stops = stops || clamping_ != Clamping::chuck;
  }
  const double force_N = jaw_force_N(p_, setup_, clamping_, o.stage);
  if (force_N != force_N_) {
    force_N_ = force_N;
    ++sum_.eased;
    stops = true;
  }
  const bool changes = o.tool != last_.tool;
  if (changes) ++sum_.indexings;
  if (changes || stops) leave();
  if (out_)
    sum_.rapid_mm += std::abs(last_.to_mm - o.from_mm);
  else if (!o.milled)
    sum_.rapid_mm += kAside_mm + home_mm(o.inner) - o.from_mm;
  if (o.milled)
    sum_.rapid_mm += 2 * (home_.x_mm - o.over_mm + home_.z_mm) - o.from_mm - o.to_mm;
  out_ = !o.milled;
  last_ = o;
}

Between Order::done() {
  leave();
  return sum_;
}

Breakdown besides_cutting(const PreparedPart& p, Clamping clamping,
                          const Between& between) {
  const auto& m = p.machine;
  Breakdown b;
  b.air.time_min = between.rapid_mm / m.rapid_mm_min;
  b.tool_changes.time_min = between.indexings * m.index_min;
  b.operator_stops.time_min = clamping_min(m, clamping) + between.eased * m.jaws_min;
  b.loading.time_min = m.load_min;
  if (p.batch) b.setup_share.time_min = m.setup_min / *p.batch;
  return b;
}

}  // namespace turnwright::planning
