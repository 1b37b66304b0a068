#pragma once
#include "turnwright/chatter/system.hpp"

namespace turnwright::chatter {

/// exp(A t) of one mode in the state (eta, eta'/wn), A = wn [0, 1; -1, -2 zeta].
struct Transition {
  double xx = 1, xv = 0, vx = 0, vv = 1;
};

/// The transition for any t, also negative, and zeta below, at and above 1:
///
///     exp(A t) = e^(-zeta wn t) (C + zeta S, S; -S, C - zeta S)
///     C = cos(b wn t), S = sin(b wn t)/b, b^2 = 1 - zeta^2  (cosh, sinh if negative)
Transition transition(const Mode& mode, double t_s);

/// Largest rate of the mode [1/s]: its solutions are sums of e^(r t) with |r| <= rate.
double rate(const Mode& mode);

}  // namespace turnwright::chatter
