#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "turnwright/cutting/cut.hpp"
#include "turnwright/cutting/spindle.hpp"

/// The operations that make one surface - roughing passes and finishing passes of an
/// element, or the passes over a face - as functions of their conditions, over any
/// scalar. Passes and tools are fixed here; speed and feed of each operation, and how the
/// stock is divided between them, are open.
namespace turnwright::planning {

/// c0 + c1 a, a the finishing depth [mm].
struct Affine {
  double c0 = 0, c1 = 0;
  template <class T>
  T operator()(const T& a) const {
    if (c1 == 0) return T(c0);
    if (c0 == 0) return c1 * a;
    return c1 > 0 ? T(T(c0) + c1 * a) : T(T(c0) - T(-c1 * a));
  }
};

/// Polynomial in u = (a - centre)/half, ascending; a constant has one coefficient.
struct Polynomial {
  double centre = 0, half = 1;
  std::vector<double> c{0};
  template <class T>
  T operator()(const T& a) const {
    if (c.size() == 1) return T(c[0]);
    const T u = (a - centre) * (1 / half);
    T sum = T(c.back());
    for (std::size_t k = c.size() - 1; k-- > 0;) sum = sum * u + c[k];
    return sum;
  }
};

/// One pass: the material left on the radius after it, and its path.
struct PassModel {
  Affine left_mm;  ///< radius offset of the surface it leaves
  Affine path_mm;  ///< length in the cut
};

/// The ring of stock on the edge of a wall that an operation takes in one cut.
struct EdgeRing {
  double depth_mm = 0, D_mm = 0;  ///< D at the stock's surface
};

/// One operation of the chain.
struct OperationModel {
  const catalogue::Tool* tool = nullptr;
  cutting::Cut cut;
  cutting::SpeedRange range;
  cutting::Grip grip;
  double n_cap_rpm = 0;        ///< machine, chuck and centrifugal loss
  bool n_cap_of_grip = false;  ///< the centrifugal loss is the lowest of them
  double n_min_rpm = 0;
  double feed_force_max_N = 0;
  double economic_life_min = 0;  ///< tool life of least cost, without feed in the air
  double Ra_um = 0, Rz_um = 0;   ///< 0: not required
  /// 1/limit of the chatter stiffness at the positions where it is imposed, over the
  /// finishing depth (MachinedSurface::limit_chatter).
  std::vector<Polynomial> chatter_mm_N;
  std::vector<double> chatter_at_mm;  ///< these positions
  double chatter_inwards = 1;         ///< limit where K_ww > 0 over that where K_ww < 0
  /// What the edge yields along the feed at every position: C_wz and C_zz of (1) of
  /// MachinedSurface::chatter_limits_N_mm.
  double chatter_wz_mm_N = 0, chatter_zz_mm_N = 0;
  catalogue::Range vc, f;  ///< open ranges: the tool's, or as the request fixes them
  catalogue::Range vc_window, f_window, ap;  ///< allowed by the tool
  std::vector<catalogue::ChipEdge> chip;     ///< and these of its chip breaker
  catalogue::Range T_min;
  Affine depth_mm;
  std::vector<PassModel> passes;
  Affine fed_mm;     ///< at feed by a pass of the program, at least its path in the cut
  Affine rapid_min;  ///< approach and return of all passes
  double D_small_mm = 0, D_large_mm = 0;  ///< of the finished feature
  bool tapered = false, reaches_axis = false, face = false, finishing = false;
  bool inner = false;     ///< a bore: material left makes it narrower
  double least_D_mm = 0;  ///< of a bore: the hole it starts from
  std::optional<EdgeRing> ring;

  /// Sum over all passes.
  Affine left_sum_mm() const {
    Affine sum;
    for (const auto& p : passes) {
      sum.c0 += p.left_mm.c0;
      sum.c1 += p.left_mm.c1;
    }
    return sum;
  }
  /// The pass at the largest and at the smallest diameter.
  const PassModel& widest() const { return inner ? passes.back() : passes.front(); }
  const PassModel& narrowest() const { return inner ? passes.front() : passes.back(); }
};

/// Feed of the program's passes over that in the cut.
template <class T>
T fed(const OperationModel& o, const T& a) {
  const auto &all = o.fed_mm, &cut = o.passes[0].path_mm;
  return all.c1 == 0 && cut.c1 == 0 ? T(all.c0 / cut.c0) : all(a) / cut(a);
}

/// Tool life of least cost: feed in the air costs time, and does not wear the edge.
template <class T>
T economic_life_min(const OperationModel& o, const T& a) {
  return T(o.economic_life_min) / fed(o, a);
}

/// The sweep of one pass.
template <class T>
cutting::Sweep<T> sweep(const OperationModel& o, const PassModel& p, const T& a) {
  const T left = p.left_mm(a);
  const auto D = [&](double finished) -> T {
    if (o.face) return T(finished);
    if (o.inner) return difference(T(finished), T(left * 2.0), o.least_D_mm);
    return left * 2.0 + finished;
  };
  return {p.path_mm(a), D(o.D_small_mm), D(o.D_large_mm), o.tapered, o.reaches_axis};
}

/// The largest depth and the diameters that count in the limits: of a pass, or of the ring
/// that an operation takes with it.
template <class T>
T limiting_depth_mm(const OperationModel& o, const T& a) {
  using std::max;
  const T ap = o.depth_mm(a);
  return o.ring ? max(ap, T(o.ring->depth_mm)) : ap;
}
template <class T>
cutting::Sweep<T> limiting_sweep(const OperationModel& o, const PassModel& p,
                                 const T& a) {
  using std::max;
  using std::min;
  auto s = sweep(o, p, a);
  if (!o.ring) return s;
  s.D_small_mm = min(s.D_small_mm, T(o.ring->D_mm));
  s.D_large_mm = max(s.D_large_mm, T(o.ring->D_mm));
  s.tapered = true;
  return s;
}

/// Forces at that depth.
template <class T>
cutting::Forces<T> limiting_forces(const OperationModel& o, const T& f, const T& a) {
  return cutting::forces_N(o.cut, limiting_depth_mm(o, a), f);
}

/// Force on the tool needed from the jaws [N], the largest of the passes.
template <class T>
T grip_needed(const OperationModel& o, const cutting::Forces<T>& F, const T& a) {
  using std::max;
  T D = sweep(o, o.widest(), a).D_large_mm;
  if (!o.face && !o.inner) D = D + 2.0 * o.depth_mm(a);
  if (o.ring) D = max(D, T(o.ring->D_mm));
  return cutting::grip_needed_N(o.grip, F.Fc_N, F.Ff_N, D);
}

/// The spindle limit [1/min] of an operation: fixed, and where the grip ends.
template <class T>
T spindle_cap(const OperationModel& o, const cutting::Forces<T>& F, const T& a) {
  using std::min;
  if (!(o.grip.force_N > 0) || !o.tapered) return T(o.n_cap_rpm);
  return min(T(o.n_cap_rpm), cutting::grip_rpm(o.grip, grip_needed(o, F, a)));
}

}  // namespace turnwright::planning
