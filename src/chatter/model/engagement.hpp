#pragma once
#include <cstddef>
#include <vector>

#include "turnwright/chatter/cutter.hpp"

namespace turnwright::chatter {

/// Force on the tool at one angle of the spindle by (1) of cutter.hpp:
/// F = fed - sum_l regenerative_l (q(t) - q(t - tau_l)) - damping q'(t).
struct Load {
  std::vector<Directional> regenerative;  ///< for each delay [N/mm]
  Directional damping;                    ///< [N s/mm]
  double fed_x_N = 0, fed_y_N = 0;        ///< force by the nominal chip of the feed
};

/// A point of a tooth's edge at an angle of the work.
struct Passage {
  double angle_rad = 0;  ///< angle of the spindle at that moment
  double offset_mm = 0;  ///< of the tooth's radius
};

/// Lag angle of an edge behind its tip, per height [rad/mm].
double lag_rad_mm(const Cutter& cutter);

/// C/v of cutter.hpp (1), per depth of cut [N s/mm2]; 0 without indentation.
double flank_damping_N_s_mm2(const Cutter& cutter, double n_rpm);

/// Engagement of the edges of a cutter with the work at one depth of cut.  Angles are
/// those of the spindle, from 0 to `period_rad`; all integrals over the height are closed
/// forms.
class CutterEngagement {
 public:
  CutterEngagement(const Cutter& cutter, double n_rpm, double ap_mm);

  double period_rad() const { return period_; }
  /// The different delays as angles, each at most a period.
  const std::vector<double>& delays_rad() const { return delays_; }
  /// Angles between which the load is smooth, from 0 to the period.  For straight edges
  /// also the angles one delay later, at which the motion is not smooth.
  std::vector<double> breaks() const;
  /// Angles at which the tip of an edge begins or ceases to cut, rising.
  std::vector<double> ends() const;
  Load load(double angle_rad) const;
  bool cuts(double angle_rad) const;
  /// Passages of the teeth at the height z.
  std::vector<Passage> passages(double phi_rad, double z_mm) const;

 private:
  /// Angles between which a point of an edge cuts a surface that is one certain delay
  /// old.
  struct Segment {
    std::size_t tooth = 0;
    double begin = 0, end = 0;
    std::size_t delay = 0;
    double feed_mm = 0, gap_mm = 0;  // f_l and the difference of radii of (3)
  };
  /// The part of an edge inside a segment.
  struct Met {
    double depth_mm = 0, middle_rad = 0, width_rad = 0;
  };

  void enter_segments(std::size_t tooth);
  std::size_t delay_of(double angle);
  template <class F>
  void for_each_met(double angle, F visit) const;

  const Cutter& cutter_;
  double ap_, lag_, period_;
  LinearForce damping_;                // C/v [N s/mm per mm]
  std::vector<double> place_, pitch_;  // of the teeth
  std::vector<double> delays_;
  std::vector<Segment> segments_;
};

/// Depths at which the order of the ends of engagement changes, so that the load is not a
/// smooth function of the depth.
std::vector<double> kinks_mm(const Cutter& cutter, double n_rpm, double ap_max_mm);

}  // namespace turnwright::chatter
