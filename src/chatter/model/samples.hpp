#pragma once
#include <vector>

#include "turnwright/chatter/system.hpp"

namespace turnwright::chatter {

/// The directional factors at a time of the period, with its weight [s] in an integral.
struct Sample {
  double t_s = 0, weight_s = 0;
  Directional h;
};

/// Nodes by which to integrate h times smooth functions over [from, to] of a period whose
/// time 0 is the start of the first arc: Gauss-Legendre on each part of an arc, with
/// nodes graded towards an end where h is a broken power.  Free flight has none.
std::vector<Sample> samples(const System& system, double n_rpm,
                            const std::vector<Arc>& arcs, double from_s, double to_s);

}  // namespace turnwright::chatter
