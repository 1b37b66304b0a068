#pragma once
#include "fixed.hpp"
#include "milled_geometry.hpp"
#include "milled_search.hpp"
#include "turnwright/cutting/spindle.hpp"

/// One choice for a milled place: a way with so many passes, its limits and its cost.
namespace turnwright::planning {

/// A place in the setup that is to make it.
struct MilledSite {
  const PreparedPart& p;
  const MilledPlace& m;
  std::size_t setup;
  Clamping clamping;
  const Economy& economy;
  double part_mm_N = 0;  ///< the part's compliance across the feed
};

/// With letters of cutting/milled.hpp and of milled_search.hpp, r passes of ap = depth/r:
///
///     t = r layer + plunge depth/kPlungeFeed, over fz z n                          (1)
///     fz <= hex/(hex/fz), feed_max/(z n), and by power, torque, strength and grip
///     P <= c n^s:  fz^(1-mc) <= 60e6 c n^(s-1)/(kc1.1 sum' ae ap z)                (2)
///     F <= F_max:  fz^(1-mc) <= F_max/(kc1.1 ap S)                                 (3)
///     W = ap (1 + margin) (1 + rho) kc1.1 (hm/fz)^-mc fz^-mc                       (4)
///
/// sum' ae is the largest of ae (hm/fz)^-mc; rho the part's compliance across the feed
/// at the place over the tool point's, which is taken to share its frequencies, at
/// most 1. Grip: cutting/spindle.hpp with the whole of sqrt(1 + (Kn/Kt)^2) F along the
/// part and around it, the spindle at rest.
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

/// Largest compliance across the feed of the part as the setup leaves it, of three
/// places.
double part_mm_N(const PreparedPart& plan, const Milled& place, std::size_t setup,
                 Clamping clamping);
/// Of a tool point, across the feed.
double tip_mm_N(const std::vector<catalogue::TipMode>& modes);

/// Speeds that cutter and driven spindle have in common; none if lower > upper.
catalogue::Range speeds_rpm(const PreparedPart& plan,
                            const catalogue::MillingCutter& cutter);

/// (1) to (4) in one range of the spindle.
MilledCase milled_case(const MilledSite& site, const MilledChoice& choice,
                       const cutting::SpeedRange& range);

/// The choice at a speed and feed, its limits evaluated anew.
FixedOperation milled_operation(const MilledSite& site, const MilledChoice& choice,
                                const MilledCase& c, double n_rpm, double fz_mm);

}  // namespace turnwright::planning
