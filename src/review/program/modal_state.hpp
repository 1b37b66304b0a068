#pragma once
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "turnwright/review/program.hpp"

/// A control between two blocks, and the moves that it has made.
namespace turnwright::review {

/// Adds one to the list, which ends with the 200th.
void list(std::vector<Unknown>& all, Unknown unknown);

/// A chamfer or rounding between the last move and the next one.
struct Corner {
  enum class Form {
    rounded,         ///< by a radius
    chamfer,         ///< of a length of each leg
    chamfer_across,  ///< of a length across
    chamfer_rounded  ///< with the legs that a rounding of a radius has
  };
  Form form = Form::chamfer;
  double size_mm = 0;  ///< 0: none
};

/// A driven tool at work, with the main spindle as an axis.
struct MillingMode {
  bool on = false;
  double n_rpm = 0;  ///< of the tool; 0: not known
  double y_mm = 0;   ///< beside the axis, by Y or by C as a length
  double C_deg = 0;  ///< of the spindle
  /// How C is meant: as an angle, as a coordinate of a plane with X, around the part.
  enum class C { angle, plane, cylinder };
  C c = C::angle;
};

/// What a control holds until a block changes it.
class ModalState {
 public:
  explicit ModalState(const ReadOptions& options);

  // Conditions.
  double F = 0, S = 0, limit_rpm = 0;
  std::size_t F_line = 0, S_line = 0;  ///< that gave them
  bool surface_speed = false, per_revolution = true, turning = false;
  int tool = 0, chosen_tool = 0;
  // Coordinates.
  bool inch = false, diameter = true, incremental = false;
  int plane = 18;           ///< G17 to G19
  bool to_plane_R = false;  ///< G99 of drilling cycles
  /// Why moves are not followed at present: a shifted zero, say.
  std::string suspended = {};

  double mm(double value) const { return inch ? 25.4 * value : value; }
  /// Of a length which counts steps of the control, 1 um or 0.0001 inch, without a point.
  double steps_mm(double value, bool point) const {
    return mm(value) * (point ? 1 : inch ? 1e-4 : 1e-3);
  }
  std::optional<double> x_mm, z_mm;  ///< of the tip; none: not known
  MillingMode milling;
  /// Ends it; of a plane of X and C the tool stands at the radius of its place.
  void end_milling();
  NoseCompensation nose;
  Corner corner;
  void lose_place() { x_mm.reset(), z_mm.reset(); }

  /// Moves the tip and appends the move to the runs.
  void to(toolpath::Move move);
  /// A straight move, to coordinates or staying where they are not given.
  void straight(toolpath::Move::Kind kind, std::optional<double> x,
                std::optional<double> z);
  /// A cut of a thread with a lead [mm].
  void thread(double x, double z, double lead_mm);
  void stop();
  /// Waits at the place, minutes or turns of the spindle.
  void dwell(double min);
  void dwell_turns(double turns);

  std::size_t line = 0;
  void unknown(std::string what, std::string why);
  void assume(const std::string& sentence);
  bool full() const { return moves_ >= moves_max_; }

  TurningProgram program;

 private:
  toolpath::Step conditions(const toolpath::Move& move, double lead_mm);
  void append(const toolpath::Move& move, double lead_mm);
  void mill(const toolpath::Move& move);
  void break_corner(const toolpath::Move& next);

  std::size_t moves_ = 0, moves_max_;
  std::set<int> milled_by_;  // tools
};

}  // namespace turnwright::review
