#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "turnwright/cutting/cut.hpp"
#include "turnwright/cutting/material_fit.hpp"

/// The laws of cut.hpp for all three forces, from measured cuts of one tool.
namespace turnwright::cutting {

enum class Component { cutting, feed, passive };
constexpr std::size_t kComponents = 3;

struct MeasuredCut {
  double ap_mm = 0, f_mm_rev = 0;
  std::array<std::optional<double>, kComponents> F_N;  ///< by Component
  std::size_t lab = 0;
  std::optional<std::size_t> replica =
      {};  ///< the run of the plan of tests it belongs to
};

/// Root mean square of the relative errors with which some cuts are predicted by the law
/// that the others give; of Ff and Fp where they are at least a third of the thrust force.
using PredictionErrors = std::array<std::optional<double>, kComponents>;

/// Errors at one depth by the law of the other depths.
struct LeftOut {
  double ap_mm = 0;
  PredictionErrors rms;
};

/// Errors of one replica by the law of all other cuts.
struct LeftOutReplica {
  std::size_t replica = 0;
  PredictionErrors rms;
};

/// Which law feed and passive force follow.
enum class ThrustLaw {
  none,       ///< too few cuts: what the material had
  direction,  ///< thrust force in the direction of chip flow, (5) and (6) of cut.hpp
  components  ///< kf1.1 and kp1.1
};

struct ForceFit {
  std::array<std::optional<KienzleFit>, kComponents> kienzle;  ///< where measured
  std::optional<ThrustFit> thrust;                             ///< where Ff or Fp is
  ThrustLaw law = ThrustLaw::none;
  /// Of `law`, one for each depth; none of one depth, of more than 50, or where the others
  /// do not determine the law.
  std::vector<LeftOut> left_out;
  std::vector<LeftOutReplica> left_out_replicas;  ///< likewise, one for each replica
  Cut cut;  ///< the tool with every constant that was determined
};

/// Kienzle's law for each component and the thrust force, with all evidence by the index
/// of the cut.
///
/// Each lab has its own factor on a component's constant, as fit_kienzle says, and Fc in
/// (5) of cut.hpp is that of the cut's own lab; errors of cuts left out are those of the
/// pooled constants.
///
/// The thrust force follows from the passive force, which makes the error of a diameter:
/// F_D = Fp/cos(kappa_eff).  Fp says little where the chip flows along the axis; there,
/// beyond 70 deg, and where only Ff was measured, F_D is that of Ff.  Fc in (5) is that of
/// the law, so that the constants give the measured forces together.
///
/// Feed and passive force keep a power law each only where that predicts Ff and Fp of
/// depths that were left out better than the thrust force does, and its exponents lie in
/// [0, 1), or where Fc is not known: a power law cannot follow a force that turns with
/// ap/r.
/// @param base  the tool's corner, and the constants that stay where cuts say nothing.
/// @throws std::domain_error if a number is not positive and finite.
ForceFit fit_forces(std::span<const MeasuredCut> cuts, const Cut& base,
                    const FitOptions& options = {});

}  // namespace turnwright::cutting
