#pragma once
#include "auxiliary_work.hpp"
#include "milled_paths.hpp"
#include "milled_search.hpp"
#include "planning/values/economy.hpp"
#include "turnwright/cutting/spindle.hpp"

/// One choice for a milled place: a way and a number of passes, with its limits and cost.
namespace turnwright::planning {

/// A milled place in the setup that makes it.
struct MilledSite {
  const PreparedPart& p;
  const MilledPlace& m;
  std::size_t setup;
  Clamping clamping;
  const Economy& economy;
  double part_mm_N = 0;  ///< the part's compliance across the feed
};

/// Limits and cost, in the symbols of cutting/milled.hpp and milled_search.hpp, for r
/// passes of ap = depth/r:
///
///     t = r layer + plunge depth/kPlungeFeed, over fz z n                          (1)
///     fz <= hex/(hex/fz), feed_max/(z n), and by power, torque, strength and grip
///     P <= c n^s:  fz^(1-mc) <= 60e6 c n^(s-1)/(kc1.1 sum' ae ap z)                (2)
///     F <= F_max:  fz^(1-mc) <= F_max/(kc1.1 ap S)                                 (3)
///     W = ap (1 + margin) (1 + rho) kc1.1 (hm/fz)^-mc fz^-mc                       (4)
///
/// sum' ae is the largest of ae (hm/fz)^-mc.  rho, at most 1, is the ratio of the part's
/// compliance across the feed at the place to that of the tool point, whose frequencies
/// the part is assumed to have.  The grip is that of cutting/spindle.hpp with the spindle
/// at rest, under sqrt(1 + (Kn/Kt)^2) F both along the part and around it.
struct MilledChoice {
  const MilledWay* way;
  const catalogue::MillingCutter* cutter;
  const catalogue::MillingConditions* grade;
  int passes;
  RunOut out;
  catalogue::Kienzle kc;
  double hm_over_fz, hex_over_fz, ae_mm;  ///< of the widest cut
  double ae_sum;                          ///< sum' ae
  double teeth;                           ///< S
  double rho;
  double grip_N;  ///< largest F that the jaws hold; infinite between centres
  double ap_mm(const Milled& m) const { return m.depth_mm / passes; }
};
MilledChoice milled_choice(const MilledSite& site, const MilledWay& way, int passes);

/// Largest compliance across the feed of the part after the setup, at three positions of
/// the milled place.
double part_mm_N(const PreparedPart& plan, const Milled& place, std::size_t setup,
                 Clamping clamping);
/// Compliance of a tool point across the feed.
double tip_mm_N(const std::vector<catalogue::TipMode>& modes);

/// Speeds allowed by cutter and driven spindle; none if lower > upper.
catalogue::Range speeds_rpm(const PreparedPart& plan,
                            const catalogue::MillingCutter& cutter);

/// The optimisation problem (1) to (4) in one range of the spindle.
MilledCase milled_case(const MilledSite& site, const MilledChoice& choice,
                       const cutting::SpeedRange& range);

/// Names an operation after the place that it mills or drills.
void name_after(const Milled& place, std::size_t setup, OperationPlan& operation);

/// What decides the way of a driven tool to the middle of a place and back.
InOrder milled_order(const PreparedPart& plan, const Milled& place, std::size_t setup,
                     std::string tool);

/// The choice at a speed and feed, with its limits evaluated again.
AuxiliaryOperation milled_operation(const MilledSite& site, const MilledChoice& choice,
                                    const MilledCase& c, double n_rpm, double fz_mm);

}  // namespace turnwright::planning
