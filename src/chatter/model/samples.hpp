#pragma once
#include <vector>

#include "turnwright/chatter/system.hpp"

namespace turnwright::chatter {

/// The directional factors at a time of the period, with its weight [s] in an integral.
struct Sample {
  double t_s = 0, weight_s = 0;
  Directional h;
};

/// Nodes for integrals of h times smooth functions over [from, to] of a period whose time
/// 0 is the start of the first arc: Gauss-Legendre nodes on each part of an arc, graded
/// towards an end where h is a fractional power.  Where no tooth cuts there are no nodes.
std::vector<Sample> samples(const System& system, double n_rpm,
                            const std::vector<Arc>& arcs, double from_s, double to_s);

}  // namespace turnwright::chatter
