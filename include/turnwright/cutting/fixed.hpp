#pragma once
#include <vector>

#include "turnwright/catalogue/material.hpp"
#include "turnwright/cutting/spindle.hpp"

/// Forces of the operations whose conditions are not optimised, all from Kienzle's
/// specific force of the material.
namespace turnwright::cutting {

/// Kienzle's constants with K_gamma of a rake, cut.hpp.
catalogue::Kienzle kienzle_at(const catalogue::Material& material, double gamma_deg);

/// What a tool takes: cutting force [N] (all edges), force along the feed [N], torque
/// [Nm].
struct Load {
  double Fc_N = 0, Ff_N = 0, M_Nm = 0;
};

/// Drill of two edges into the solid, D its diameter, sigma the point angle:
///
///     h = (f/2) sin(sigma/2),  kc = kc1.1 h^-mc                                      (1)
///     Fc = kc f D/2,  M = Fc D/4,  Ff = 0.5 kc f (D/2) sin(sigma/2)                  (2)
///
/// Each edge cuts D/2 wide and f/2 deep and its force acts at D/4.  The thrust counts the
/// chisel edge within its 0.5, +-30 %.
/// Source: M follows from Kienzle's law, derived here; Ff is a handbook value.
Load drill(const catalogue::Kienzle& kc, double D_mm, double f_mm_rev, double point_deg);
/// Length [mm] of a drill's point, (D/2)/tan(point/2).
double drill_point_mm(double D_mm, double point_deg);

/// Straight edge of width b fed into the work, at diameter D:
///
///     Fc = kc1.1 b f^(1-mc),  Ff = 0.5 Fc,  M = Fc D/2                               (3)
///
/// Ff is that of cut.hpp (5) for kappa = 90 deg, +-30 %.  For blades (feed to the axis)
/// and profiling passes (b = depth).
Load plunge(const catalogue::Kienzle& kc, double b_mm, double f_mm_rev, double D_mm);

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
/// L_k are both flanks, A/L_k the equivalent chip thickness; the last pass has the most.
/// Ff is radial, 0.5 Fc.  Source: derived here from the vee.
std::vector<Infeed> thread_infeeds(const catalogue::Kienzle& kc, double h_mm, int n,
                                   double D_mm);

/// Power [kW] at the cut that the curves leave at a spindle speed within them, of the
/// power lines or of the torque lines alone; infinite if there are none.
double available_kW(const std::vector<SpeedRange>& ranges, double n_rpm, bool torque);

}  // namespace turnwright::cutting
