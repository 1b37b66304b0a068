#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "turnwright/chatter/cutter.hpp"
#include "turnwright/chatter/cutter_limits.hpp"
#include "turnwright/chatter/safe_cut.hpp"
#include "turnwright/chatter/stability_limits.hpp"
#include "turnwright/chatter/system.hpp"
#include "turnwright/chatter/uncertain.hpp"

/// A stability chart: limits over the spindle speed, and verdicts on single cuts.
namespace turnwright::chatter {

/// How stability is judged: by limits.hpp or, to check it, by a method of
/// reference_methods.hpp.
enum class Method { fundamental_matrix, tfea, semi_discretisation, simulation };

struct ChartRequest {
  System system;
  std::optional<Cutter> cutter;  ///< helix, pitches, runout and damping, if any
  Method method = Method::fundamental_matrix;
  int resolution = 0;               ///< elements or intervals of a reference method
  std::optional<double> ap_max_mm;  ///< end of the search; required if there are speeds
  std::vector<double> speeds_rpm;
  std::vector<double> depths_mm;  ///< at which multipliers are counted for each speed
  std::optional<Bands> bands;
  std::optional<SpeedRange> machine;   ///< speeds of the machine; absent: all
  Margins margins;                     ///< that `best` and a point's cure keep
  std::optional<SpindleLoad> spindle;  ///< of milling, if the machine's limits are known
  std::vector<OperatingPoint> points;
  double work = kSearchWork;  ///< operations for a speed of a cutter beyond the plain one

  /// Whether depth and delay enter by more than one number kappa, see cutter.hpp.
  bool shaped() const;
  /// Whether limits at speeds beside those of the chart are found soon: of turning, and of
  /// plain cutters with up to six modes, by limits.hpp.
  bool quick() const;
};

/// Result for one speed.
struct ChartSpeed {
  std::size_t index = 0;  ///< in speeds_rpm
  SpeedLimits limits;
  std::optional<UncertainLimit> uncertain;  ///< if there are bands
};

/// Result for one cut.
struct ChartPoint {
  OperatingPoint at;
  std::optional<int> unstable;  ///< unstable multipliers, if the method counts them
  double spectral_radius = 0;
  bool stable = false;
  std::vector<Surface> walls;  ///< for a stable cut by a cutter with a feed
  /// With ap_max, where quick() or at a speed of the chart; see PointMargin.
  std::optional<PointMargin> margin;
};

/// A speed or point outside the method's range.
struct Undecided {
  std::size_t index = 0;  ///< in speeds_rpm or points
  OperatingPoint at;      ///< for a speed with ap_max as depth
  std::string why;        ///< empty if it was not tried
  double harder_rpm = 0;  ///< if not tried: a faster speed that already takes too long
  std::optional<double> stable_to_mm = {};  ///< depth up to which a speed is stable
};

struct StabilityChart {
  std::vector<ChartSpeed> speeds;  ///< the decided ones, in the order of the request
  std::vector<ChartPoint> points;
  std::vector<Undecided> undecided_speeds, undecided_points;
  /// The cut of the highest rate of material removal, n ap, that keeps the margins and the
  /// limits of the machine at a speed of the chart.  None if it has none of the speeds.
  std::optional<SafeCut> best;
  std::vector<OperatingPoint>
      magic;  ///< local maxima of the limit over the speed, rising
};

/// Called with the number of speeds and points that are done.
using ChartProgress = std::function<void(std::size_t done, std::size_t all)>;

/// Computes a chart.  Speeds are searched from the highest down, because slow ones take
/// longest: once a search would take too long, slower ones at the same or greater depths
/// are not tried.  Cutters with helix, pitches, runout or damping are tried at every
/// speed, with a tenth of the work after the first that could not be searched to the end.
/// `speeds` has those that are searched to the end or lose stability below `searched_mm`.
/// @throws Cancelled soon after a stop was requested.
StabilityChart stability_chart(const ChartRequest& request,
                               const std::stop_token& stop = {},
                               const ChartProgress& tell = {});

/// Depth [mm] below which turning with one mode is stable at every speed,
/// 2 k zeta (1 + zeta)/K.  Source: [Tlusty 1963], the least -1/(2 Re G), here of one
/// mode.
/// @param system  with a constant force and one mode.
double absolute_limit_mm(const System& system);

}  // namespace turnwright::chatter
