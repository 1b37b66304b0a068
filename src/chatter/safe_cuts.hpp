#pragma once
#include <functional>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "turnwright/chatter/safe_cut.hpp"
#include "turnwright/chatter/stability_limits.hpp"

namespace turnwright::chatter {

/// Limits at a list of speeds, and what a safe cut has to keep.
struct KnownLimits {
  struct Speed {
    double n_rpm = 0;
    const SpeedLimits* limits = nullptr;  ///< null if it is undecided
  };
  std::vector<Speed> speeds;
  double ap_max_mm = 0;  ///< end of their search
  Margins margins;
  std::optional<SpeedRange> machine;
  std::optional<SpindleLoad> spindle;
};

/// The best of these speeds, and cures of cuts that chatter.
class SafeCuts {
 public:
  /// Limits up to a depth at any other speed.
  using Search = std::function<SpeedLimits(double n_rpm, double ap_mm)>;

  /// @param known  whose limits outlive this.
  /// @param search  empty where other speeds take long; it throws ModelRangeError where
  ///   nothing is told.
  SafeCuts(KnownLimits known, Search search, std::stop_token stop);

  /// The safe cut that removes most; none if the machine has none of the speeds.  No
  /// speed of the chart has a better one: speeds are tried from the highest bound down,
  /// until no bound is above the best cut found.
  std::optional<SafeCut> best();

  /// The nearest speed at which a cut is safe.
  std::optional<PointMargin::Cure> cure(const OperatingPoint& cut);

 private:
  /// A speed of the chart, and the least B at the chart's speeds within its band.
  struct Bounded {
    double n_rpm = 0;
    const SpeedLimits* limits = nullptr;
    double bound_mm = 0;                    ///< least B, 0 if one of them is undecided
    std::optional<double> chatter_Hz = {};  ///< there, if it is a loss
    std::size_t beside = 0;                 ///< number of these speeds
  };
  /// The least B by (1) up to ap_max.
  struct Band {
    double depth_mm = 0;
    std::optional<double> chatter_Hz;  ///< there, if it is a loss
    std::size_t judged = 0;
  };

  const Band& band(std::size_t i);
  void judge_between(const Bounded& at, Band& out) const;
  void judge_at(double n_rpm, Band& out) const;
  std::pair<double, DepthEnd> safe(double n_rpm, double least_mm) const;
  SafeCut told(std::size_t i);
  double stable_until(const OperatingPoint& cut, int way) const;
  bool stable_at(double n_rpm, double ap_mm) const;

  KnownLimits q_;
  Search search_;
  std::stop_token stop_;
  std::vector<Bounded> speeds_;  // rising
  std::vector<std::optional<Band>> bands_;
};

}  // namespace turnwright::chatter
