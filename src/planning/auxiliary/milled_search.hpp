#pragma once
#include <vector>

#include "turnwright/chatter/lobes.hpp"

/// The cheapest speed and feed of a milled keyway, slot or flat, over all choices of
/// cutter, lanes and passes.
namespace turnwright::planning {

/// An upper limit of the feed per tooth: fz <= c n^e.
struct FeedCap {
  double c = 0, e = 0;
};

/// One choice of cutter, lanes, passes and range of the spindle.  The speed n and the
/// feed per tooth fz are variables:
///
///     t = path/(fz z n),   cost = t (minute + edge/T) + besides                      (1)
///     T = T0 (n0/n)^(1/nT)
///     W = load fz^-mc <= B(u)   for all u in [n (1 - s), n (1 + s)]                  (2)
///
/// B is the first loss of stability, W [N/mm] the depth with its margin times the force
/// coefficient.  Cost and W fall as the feed rises, so fz is the least of its caps.  As
/// functions of ln n its logarithm is concave and that of the cost convex.
struct MilledCase {
  const chatter::Lobes* lobes = nullptr;
  const chatter::Lobes* between = nullptr;  ///< further lobes; B is the lesser of the two
  double n_min_rpm = 0, n_max_rpm = 0;
  std::vector<FeedCap> caps;  ///< at least one
  double fz_min_mm = 0;
  double path_mm = 0;
  int teeth = 1;
  double minute = 0, edge = 0;  ///< weights of a minute in the cut and of a worn cutter
  double besides = 0;           ///< cost that does not depend on n and fz
  double T0_min = 0, n0_rpm = 0, nT = 0;
  double load = 0, mc = 0;  ///< W = load fz^-mc [N/mm]
  double speed_margin = 0;  ///< s, > 0
};

double feed_mm(const MilledCase& c, double n_rpm);  ///< the least of the caps
double time_min(const MilledCase& c, double n_rpm);
double life_min(const MilledCase& c, double n_rpm);
double cost(const MilledCase& c, double n_rpm);
double load_N_mm(const MilledCase& c, double fz_mm);  ///< W

struct MilledOptimum {
  bool found = false;
  std::size_t index = 0;  ///< of the case
  double n_rpm = 0, cost = 0;
  double lower_bound = 0;  ///< of the cost; infinite if there is none
  bool proved = true;      ///< whether the search was completed
  long steps = 0;
};

/// Best-first search over the cases.  A speed u at which (2) fails rules out every n
/// within the margin of u whose W is above B(u).  The speeds that have not been ruled out
/// are a relaxation of (2), convex on each interval, whose optimum is a lower bound and
/// the next point to try.  If (2) holds there, at speeds a 16th of the margin apart and
/// at the ends of the margin, the point is the optimum of the case.  So the bound is as
/// certain as the losses of stability on which it rests.
MilledOptimum cheapest(const std::vector<MilledCase>& cases);

/// B at a speed, and its least value within the margin of that speed; values above
/// `enough` are returned as `enough`.
double stable_to_N_mm(const MilledCase& c, double n_rpm, double enough);
double stable_around_N_mm(const MilledCase& c, double n_rpm, double enough);

}  // namespace turnwright::planning
