#pragma once
#include <optional>
#include <vector>

#include "turnwright/catalogue/fixed_tool.hpp"
#include "turnwright/catalogue/material.hpp"
#include "turnwright/cutting/spindle.hpp"

/// Forces of drilling, reaming, tapping, grooving, parting, profiling and threading, which
/// run at fixed conditions; all follow from the material's specific cutting force by Kienzle's law.
namespace turnwright::cutting {

/// Kienzle's constants of a material, corrected by K_gamma of cut.hpp for a rake.
catalogue::Kienzle kienzle_at(const catalogue::Material& material, double gamma_deg);

/// Load on a tool: cutting force [N] of all edges, force along the feed [N], torque [Nm].
struct Load {
  double Fc_N = 0, Ff_N = 0, M_Nm = 0;
};

/// Load on a drill with two edges in solid material, with its diameter D and point angle
/// sigma:
///
///     h = (f/2) sin(sigma/2),  kc = kc1.1 h^-mc                                      (1)
///     Fc = kc f D/2,  M = Fc D/4,  Ff = 0.5 kc f (D/2) sin(sigma/2)                  (2)
///
/// Each edge cuts D/2 wide and f/2 deep, and its force acts at D/4.  The factor 0.5 of
/// the thrust includes the chisel edge, +-30 %.
/// Source: M follows from Kienzle's law, derived here; Ff is a handbook value.
Load drill(const catalogue::Kienzle& kc, double D_mm, double f_mm_rev, double point_deg);
/// Length [mm] of a drill's point, (D/2)/tan(point/2).
double drill_point_mm(double D_mm, double point_deg);

/// Depths [mm] of a hole from which a drill is drawn out to clear its chips, the depth of
/// the whole hole last.  Beyond the first feed all pecks are equally long:
///
///     pecks = ceil((depth - first D)/(step D))                                       (6)
std::vector<double> peck_depths_mm(const std::optional<catalogue::Pecking>& pecking,
                                   double D_mm, double depth_mm);

/// Load on a reamer of z edges, whose lead stands at kappa = 45 deg, that widens a hole from
/// the diameter d to D:
///
///     h = (f/z) sin kappa,  kc = kc1.1 h^-mc                                         (7)
///     Fc = kc f (D - d)/2,  M = Fc (D + d)/4,  Ff = 0.5 kc f (D - d)/2 sin kappa     (8)
///
/// All edges together cut (D - d)/2 wide and f thick.  The thrust is estimated as a drill's.
/// A countersink is the same when it has reached its diameter D, half its point angle
/// as kappa.
/// Source: derived here from Kienzle's law; what the lands rub is not in it.
Load ream(const catalogue::Kienzle& kc, double D_mm, double drilled_mm, double f_mm_rev,
          int edges, double lead_deg = 45);

/// Load on a tap of z flutes with a lead of n pitches P, for a thread of diameter d and
/// depth t = (d - D1)/2 in a hole D1:
///
///     h = t/(n z),  kc = kc1.1 h^-mc,  M = kc P^2 d/8,  Fc = 2 M/d,  Ff = 0            (9)
///
/// h is what each tooth of the lead takes; P^2/4 is a little more than the section of the
/// thread, 0.237 P^2.  A synchronous spindle feeds the tap.
/// Source: M is a handbook value; friction in the thread may add 30 %.
Load tap(const catalogue::Kienzle& kc, double d_mm, double pitch_mm, double depth_mm,
         double lead_pitches, int edges);

/// Load on a straight edge of width b that is fed into the work at the diameter D:
///
///     Fc = kc1.1 b f^(1-mc),  Ff = lambda Fc + ke b,  M = Fc D/2                     (3)
///
/// Ff is that of cut.hpp (5) for kappa = 90 deg.  Used for blades, which are fed towards
/// the axis, and for profiling passes, where b is the depth.
Load plunge(const catalogue::Kienzle& kc, const catalogue::Thrust& thrust, double b_mm,
            double f_mm_rev, double D_mm);

/// One infeed of a thread.
struct Infeed {
  double depth_mm = 0;  ///< added by this pass
  Load load;
};

/// Infeeds of equal chip area into a 60 deg vee of depth h, in n passes:
///
///     a_k = h sqrt(k/n),  A = tan(30 deg) h^2/n                                      (4)
///     L_k = 2 a_k/cos(30 deg),  Fc_k = kc1.1 L_k^mc A^(1-mc)                         (5)
///
/// One infeed, from a depth a_(k-1) to a_k, has A = tan(30 deg) (a_k^2 - a_(k-1)^2).
/// L_k is the length of both flanks, A/L_k the equivalent chip thickness; the last pass
/// has the largest load.  Ff is radial: lambda Fc by the chips, which both flow towards
/// the middle of the vee, and what ke presses on the two flanks, ke L_k sin(30 deg).
/// Source: derived here from the vee.
Load thread_infeed(const catalogue::Kienzle& kc, const catalogue::Thrust& thrust,
                   double before_mm, double depth_mm, double D_mm);
std::vector<Infeed> thread_infeeds(const catalogue::Kienzle& kc,
                                   const catalogue::Thrust& thrust, double h_mm, int n,
                                   double D_mm);

/// Power [kW] that the curves allow at the cut, at a spindle speed within them, by the
/// torque lines alone or by the power lines alone; infinite if there are none.
double available_kW(const std::vector<SpeedRange>& ranges, double n_rpm, bool torque);

}  // namespace turnwright::cutting
