#include "tolerance_allocation.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "common_datum.hpp"
#include "jaw_squeeze.hpp"
#include "machine_share.hpp"
#include "planning/clamping/jaws.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/paths/programmed_faces.hpp"
#include "planning/values/surface_request.hpp"
#include "turnwright/base/interval.hpp"
#include "turnwright/deflection/shop_errors.hpp"
#include "uncertain_limits.hpp"

namespace turnwright::planning {
namespace {

using part::Tolerance;
using part::ToleranceKind;
using tolerance::Distribution;

constexpr double kRemainder = 0.005;  // share of h that a corrected path may leave

// Factor from an error of the radius to a size, or of a face to a length.
double sensitivity(const PreparedPart& p, const Tolerance& t) {
  if (t.kind == ToleranceKind::diameter) return 2;
  if (t.kind == ToleranceKind::length) return 1;
  return std::cos(half_angle_rad(p.drawing, t.of).value_or(0));
}

// Half of the amount by which a warm part is too small once it is cold, on one side of a
// size.
double heat_um(const PreparedPart& p, const Tolerance& t) {
  const auto& d = p.drawing;
  const double alpha = p.material.expansion_1_K, dT = p.shop.part_warm_K;
  if (t.kind == ToleranceKind::length) {
    const double L = std::abs(face_z_mm(d, t.between[0]) - face_z_mm(d, t.between[1]));
    return units::um_from_mm(alpha * dT * L / 2 / std::max(1.0, faces_cut(p, t)));
  }
  const auto at = *part::extent(d, t.of);  // a size that is no length is an element's
  const double D = std::max(at.left_mm, at.right_mm);
  return units::um_from_mm(-deflection::heat_error_mm(alpha, dT, D) / 2);
}

double face_diameter_mm(const part::Drawing& d, const std::string& face) {
  if (face == "left") return d.outer.front().left_mm;
  if (face == "right") return d.outer.back().right_mm;
  const auto ring = shoulder_ring(d, face);
  return ring ? ring->large_mm : 0;
}

bool cuts_face(const PreparedPart& p, std::size_t setup, const SetupWork& work,
               const std::string& face) {
  if (work.end_face && face == free_face(p, setup)) return true;
  if (const auto s = part::inner_shoulder(p.drawing, face)) return faces(work, *s);
  return std::any_of(work.shoulders.begin(), work.shoulders.end(),
                     [&](std::size_t k) { return shoulder_id(p.drawing, k) == face; });
}

// Which of a setup's tools faces: a bar between bores, the finishing tool behind an
// undercut.
catalogue::ToolUse faced_by(const part::Drawing& d, const std::string& face) {
  if (part::inner_shoulder(d, face)) return catalogue::ToolUse::boring;
  for (std::size_t k = 1; k < d.outer.size(); ++k)
    if (shoulder_id(d, k) == face &&
        (d.outer[k - 1].right_undercut || d.outer[k].left_undercut))
      return catalogue::ToolUse::finishing;
  return catalogue::ToolUse::facing;
}

// Errors that two faces of a length have in common, cut in one setup minutes apart and
// both facing the free end, shift both alike and do not change the length.
struct Together {
  bool setup = false;  ///< both: the same drift
  bool tool = false;   ///< the same wear too
};
Together together(const PreparedPart& p, const Tolerance& t, std::size_t setup) {
  if (t.kind != ToleranceKind::length) return {};
  const auto& work = p.work.setups[setup];
  Together both;
  both.setup =
      cuts_face(p, setup, work, t.between[0]) && cuts_face(p, setup, work, t.between[1]);
  both.tool = both.setup &&
              faced_by(p.drawing, t.between[0]) == faced_by(p.drawing, t.between[1]) &&
              surface_request(p, setup, t.between[0]).finish_tool ==
                  surface_request(p, setup, t.between[1]).finish_tool;
  return both;
}

// Half of what an edge recedes by between two corrections.
double wear_um(const PreparedPart& p, const catalogue::Tool& tool) {
  return units::um_from_mm(recession_mm(p, tool, p.shop.life_between_offsets)) / 2;
}

double rechucking_um(const PreparedPart& p, std::size_t setup, Clamping clamping) {
  const auto& by = p.shop.rechucking;
  if (clamping == Clamping::between_centres) return by.centres_um;
  switch (p.setups[setup].jaws) {
    case Jaws::hard:
      return by.hard_jaws_um;
    case Jaws::soft:
      return by.soft_jaws_um;
    case Jaws::collet:
      return by.collet_um;
  }
  return by.hard_jaws_um;
}

// Diameter of a toleranced face, length of a toleranced axis.
double across_mm(const part::Drawing& d, const std::string& of) {
  const auto at = part::extent(d, of);
  return at ? at->z1_mm - at->z0_mm : face_diameter_mm(d, of);
}

// Factor from an eccentricity of the part in its jaws to a tolerance: e is 2 e of
// run-out.  Jaws or centres that err by e at each of two positions l apart tilt the part
// by sqrt(2) e/l; a face of diameter D, or an axis of that length, is off by D times
// that.
double sees_rechucking(const PreparedPart& p, const Tolerance& t, std::size_t held,
                       Clamping clamping) {
  const double apart = clamping == Clamping::between_centres ? part::length_mm(p.drawing)
                                                             : p.grips_mm[held];
  switch (part::facts(t.kind).rechucked) {
    case part::Rechucked::unseen:
      return 0;
    case part::Rechucked::run_out:
      return 2;
    case part::Rechucked::displaced:
      return sensitivity(p, t);
    case part::Rechucked::tilted:
      return std::sqrt(2.0) * across_mm(p.drawing, t.of) / apart;
  }
  return 0;
}

tolerance::Source rechucking(double um, double sensitivity) {
  return {to_translate("rechucking"), Distribution::rayleigh, um, sensitivity};
}

// An eccentricity of the part as a setup holds it anew, with what `sees` makes of it in a
// clamping.  If the setup is not the one of the making, its worst clamping counts.
template <class Sees>
tolerance::Source held_anew(const PreparedPart& p, std::size_t setup,
                            const Making& making, const Sees& sees) {
  auto worst = rechucking(0, 0);
  const auto held = [&](Clamping c) {
    const auto one = rechucking(rechucking_um(p, setup, c), sees(c));
    if (one.value_um * one.sensitivity > worst.value_um * worst.sensitivity) worst = one;
  };
  if (setup == making.setup)
    held(making.clamping);
  else
    std::ranges::for_each(p.setups[setup].clampings, held);
  return worst;
}

// The setups that cut the datum's elements; what none cuts counts as cut with the
// toleranced surface.
struct DatumSetups {
  std::size_t a = 0, b = 0;
};

// The part is held anew in the later of two setups.  Both elements of a common datum that
// one setup cut are off together and lean as that setup does; of two setups the one leans
// against the other, (2) of common_datum.hpp.
tolerance::Source rechucked_slope(const PreparedPart& p, const Tolerance& t,
                                  const Making& making, const DatumSetups& datum) {
  if (datum.a == datum.b) {
    const auto later = std::max(datum.a, making.setup);
    if (datum.a == making.setup) return rechucking(0, 0);
    return held_anew(p, later, making,
                     [&](Clamping c) { return sees_rechucking(p, t, later, c); });
  }
  const double apart =
      std::abs(middle_z_mm(p.drawing, t.common_datum) - middle_z_mm(p.drawing, t.datum));
  return held_anew(p, std::max(datum.a, datum.b), making,
                   [&](Clamping) { return across_mm(p.drawing, t.of) / apart; });
}

// Eq. (1) of common_datum.hpp at the worse end of the surface.  What one setup holds anew
// shifts both elements alike; two setups err independently of each other, and the sum of
// two such vectors is again one.
tolerance::Source rechucked_place(const PreparedPart& p, const Tolerance& t,
                                  const Making& making, const DatumSetups& datum) {
  const double sees = sees_rechucking(p, t, making.setup, making.clamping);
  const auto um = [&](std::size_t setup) {
    return held_anew(p, setup, making, [](Clamping) { return 1.0; }).value_um;
  };
  const auto at = *part::extent(p.drawing, t.of);  // a place is an element's
  double worst_um = 0;
  for (const double z : {at.z0_mm, at.z1_mm}) {
    const auto w = datum_weights(p.drawing, t, z);
    std::map<std::size_t, double> weights;  // by the setup that holds anew
    if (datum.a != making.setup) weights[std::max(datum.a, making.setup)] += w.a;
    if (datum.b != making.setup) weights[std::max(datum.b, making.setup)] += w.b;
    double length_um = 0;
    for (const auto& [setup, weight] : weights)
      length_um = std::hypot(length_um, weight * um(setup));
    worst_um = std::max(worst_um, length_um);
  }
  return rechucking(worst_um, sees);
}

// Adds the share of re-chucking if the datum is cut in another setup.
void add_rechucking(const PreparedPart& p, const Tolerance& t, const Making& making,
                    ToleranceAllocation& a) {
  const auto seen = part::facts(t.kind).rechucked;
  if (t.datum.empty() || seen == part::Rechucked::unseen) return;
  DatumSetups datum;
  datum.a = setup_of(p, t.datum).value_or(making.setup);
  datum.b = t.common_datum.empty() ? datum.a
                                   : setup_of(p, t.common_datum).value_or(making.setup);
  auto source = seen == part::Rechucked::tilted ? rechucked_slope(p, t, making, datum)
                                                : rechucked_place(p, t, making, datum);
  if (source.value_um > 0) a.spread.push_back(std::move(source));
}

// Eq. (4), of the land where ln T spreads by this.
double land_spread(double ln_T) {
  constexpr double kReach = 3;
  return std::expm1(kReach * ln_T) / kReach;
}

// The largest E in [0, most] that meets a condition which fails from some E on.
template <class Suffices>
double largest(double most, const Suffices& suffices) {
  constexpr int kHalvings = 40;
  double low = 0, high = most;
  if (suffices(high)) return high;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (low + high) / 2;
    (suffices(middle) ? low : high) = middle;
  }
  return low;
}

// h of (1) to (3).
double reach_um(const PreparedPart& p, std::size_t tolerance,
                const ToleranceAllocation& a) {
  const double width = width_mm(p.drawing.tolerances[tolerance]);
  return (units::um_from_mm(width) - fixed_in_parts_um(a)) / a.ends;
}

// (1) to (3), where this share of the parts may fail.
double robust_left_mm(const PreparedPart& p, std::size_t tolerance,
                      const ToleranceAllocation& a, Cut cut, double may_fail) {
  const bool corrected = cut == Cut::corrected;
  const double reach = reach_um(p, tolerance, a);
  if (!(reach > 0)) return 0;
  const double h = corrected ? (1 - kRemainder) * reach : reach;
  const double wanted = 1 - may_fail * std::min(1.0, 2 / a.ends);
  const double r = cut == Cut::none ? 0 : error_spread(p);
  const tolerance::Spread spread(a.spread);
  const double E = largest(corrected ? h / std::max(r, 1e-3) : h, [&](double e) {
    const double up = corrected ? h : h - e;
    return spread.within({a.ends == 1 ? -kInfinity : -up, up}, r * e) >= wanted;
  });
  return units::mm_from_um(a.ends * E);
}

}  // namespace

ToleranceAllocation tolerance_allocation(const PreparedPart& p, std::size_t tolerance,
                                         const Making& making) {
  const Tolerance& t = p.drawing.tolerances[tolerance];
  const auto& shop = p.shop;
  ToleranceAllocation a;
  const bool size = part::has_two_ends(t.kind);
  if (size) a.ends = t.kind == ToleranceKind::length ? 2 * faces_cut(p, t) : 2;
  const MachineTake machine = machine_take(p, tolerance, making.setup, making.clamping);
  a.fixed.push_back({kMachine, p.machine_share_um + machine.fixed_um});
  const auto fixed = [&](const char* source, double um) {
    if (um > 1e-3) a.fixed.push_back({source, um});
  };
  const auto spread = [&](const char* source, Distribution d, double um, double s) {
    if (um > 0) a.spread.push_back({source, d, um, s});
  };
  spread(kMachine, Distribution::normal, machine.u_um / a.ends, 1);
  fixed(to_translate("jaw-squeeze"),
        squeeze_um(p, t, making.setup, making.clamping,
                   jaw_force_N(p, making.setup, making.clamping, Stage::finishing)));
  fixed(kMeasurement, (size ? 2 : 1) * shop.measurement_U_um);
  if (t.kind == ToleranceKind::length)
    fixed(to_translate("chain"),
          2 * units::um_from_mm(std::abs(off_middle_mm(p.drawing, t))));
  if (size) {
    const double s = sensitivity(p, t);
    const auto both = together(p, t, making.setup);
    const double drift =
        t.kind == ToleranceKind::length ? shop.drift_axial_um : shop.drift_um;
    if (!both.setup) spread(to_translate("drift"), Distribution::uniform, drift, s);
    spread(to_translate("repeatability"), Distribution::normal, shop.repeatability_um, s);
    if (making.last && !both.tool) {
      const double wear = wear_um(p, *making.last);
      spread(to_translate("wear"), Distribution::uniform, wear, s);
      spread(kLife, Distribution::normal, wear * life_spread(p), s);
    }
    spread(kHeat, Distribution::uniform, heat_um(p, t), s);
  }
  add_rechucking(p, t, making, a);
  return a;
}

double taken_mm(const ToleranceAllocation& a) {
  double um = a.ends * tolerance::rss_um(a.spread).up_um;
  for (const auto& f : a.fixed) um += f.um;
  return units::mm_from_um(um);
}

double recession_mm(const PreparedPart& p, const catalogue::Tool& tool,
                    double life_used) {
  const deflection::Edge edge{units::rad_from_deg(tool.alpha_deg),
                              units::rad_from_deg(tool.gamma_deg)};
  const double land = p.shop.edge_wear_mm > 0 ? p.shop.edge_wear_mm : p.shop.wear_land_mm;
  return deflection::wear_error_mm(land, edge, life_used);
}

double passive_spread(const PreparedPart& p) {
  const auto& m = p.material;
  constexpr double kLand_pct = 20;  // the pressure on the wear land is an estimate
  const auto thrust = catalogue::thrust_of(m);
  double passive = m.kp ? m.feed_passive_uncertainty_pct
                        : thrust.total_uncertainty_pct.value_or(
                              std::hypot(m.kc_uncertainty_pct, thrust.uncertainty_pct));
  if (p.shop.edge_wear_mm > 0) passive = std::max(passive, kLand_pct);
  return passive / 100;
}

double force_spread(const PreparedPart& p) {
  return std::hypot(passive_spread(p), p.machine.stiffness_uncertainty_pct / 100);
}

double life_spread(const PreparedPart& p) {
  const auto& m = p.material;
  const double noticed = (p.shop.wear_noticed_times - 1) / 2;  // at two of them
  const double law =
      std::min(land_spread(m.taylor_uncertainty_pct / 100 / m.taylor.n), noticed);
  return std::hypot(land_spread(m.life_scatter_pct / 100), law);  // Eq. (5)
}

double error_spread(const PreparedPart& p) {
  const double life = p.shop.edge_wear_mm > 0 ? life_spread(p) : 0;
  return life > 0 ? std::hypot(force_spread(p), life) : force_spread(p);
}

double fixed_in_parts_um(const ToleranceAllocation& a) {
  double um = 0;
  for (const auto& f : a.fixed)
    if (f.source != kMeasurement) um += f.um;
  return um;
}

double left_mm(const PreparedPart& p, std::size_t tolerance, const ToleranceAllocation& a,
               Cut cut) {
  if (!p.robust)
    return std::max(0.0, width_mm(p.drawing.tolerances[tolerance]) - taken_mm(a));
  return robust_left_mm(p, tolerance, a, cut, (1 - p.conformance) * left_by_chatter(p));
}

double remainder_mm(const PreparedPart& p, std::size_t tolerance,
                    const ToleranceAllocation& a) {
  if (!p.robust) return left_mm(p, tolerance, a, Cut::corrected);
  return units::mm_from_um(a.ends * kRemainder *
                           std::max(0.0, reach_um(p, tolerance, a)));
}

double damping_share_mm(const PreparedPart& p, std::size_t tolerance,
                        const Making& making, Cut cut) {
  if (!p.robust || !(p.damping_uncertainty_pct > 0)) return 0;
  const auto a = tolerance_allocation(p, tolerance, making);
  return robust_left_mm(p, tolerance, a, cut, 1 - p.conformance) -
         left_mm(p, tolerance, a, cut);
}

std::vector<Share> shares(const ToleranceAllocation& a) {
  auto all = a.fixed;
  for (const auto& s : a.spread) {
    const double um = a.ends * tolerance::rss_um({&s, 1}).up_um;
    const auto other = std::find_if(all.begin(), all.end(), [&](const Share& share) {
      return share.source == s.name;
    });
    if (other != all.end())
      other->um += um;
    else
      all.push_back({s.name, um});
  }
  return all;
}

double faces_cut(const PreparedPart& p, const Tolerance& t) {
  return static_cast<double>(face_is_cut(p, t.between[0])) +
         static_cast<double>(face_is_cut(p, t.between[1]));
}

}  // namespace turnwright::planning
