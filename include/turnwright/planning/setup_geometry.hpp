#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "turnwright/deflection/beam.hpp"
#include "turnwright/part/shaft.hpp"
#include "turnwright/planning/prepared_part.hpp"

/// Which setup cuts what, and the body that stands in the machine while it does.
namespace turnwright::planning {

/// Which elements have their final diameters; the others are stock.
struct Finished {
  std::vector<bool> outer, inner;
};
Finished nothing_finished(const part::Drawing& drawing);
/// With all that a setup cuts.
void finish(Finished& finished, const SetupWork& work);

/// One element, outer or inner.
struct Element {
  bool inner = false;
  std::size_t index = 0;
};

/// Gives every element to the first setup that can cut it: it lies outside the jaws and
/// nothing between it and the free end is larger than it.  An end face goes to the first
/// setup whose free end it is, if the stock leaves material there; a shoulder to the
/// setup of its smaller element, if a face, tolerance or roughness of the drawing names
/// it.  A bore goes to the first setup whose free end it opens to, if nothing before it
/// is narrower.
/// With given operations they say in which setup; what none of them makes is unreachable.
Assignment assign(const PlanRequest& plan);

/// "d1|d2": the face between outer elements k-1 and k.
std::string shoulder_id(const part::Drawing& drawing, std::size_t k);
/// The setup that makes an element or face; none of one that stays as the stock has it.
std::optional<std::size_t> setup_of(const PreparedPart& part, const std::string& surface);
/// z [mm] of "left", "right" or a shoulder.
double face_z_mm(const part::Drawing& drawing, const std::string& face);
/// Whether a profiling tool that comes from the end a setup leaves free clears an outer
/// element: true but of arcs that fall more than `part::kProfilingClears_rad`.
bool cleared(const PlanRequest& plan, std::size_t setup, std::size_t element);
/// "left" or "right": the end that a setup leaves free.
const char* free_face(const PlanRequest& plan, std::size_t setup);

/// Elements with their final diameters once a setup is done.
Finished finished_after(const PreparedPart& part, std::size_t setup);

/// Material [mm] before the finished face of an end once it is free: what parting off
/// leaves at the first setup's held end, else the stock's allowance.
double face_stock_mm(const PlanRequest& plan, part::End end);
/// The same once a setup is done: none if the end was faced by then.
double face_stock_after_mm(const PreparedPart& part, std::size_t setup, part::End end);

/// Diameter [mm] drilled from an end of a bar before its bores are bored: the largest of
/// the plan's drills that leaves 0.5 mm on the radius of the narrowest, reaches their end
/// and cuts with its point no narrower bore and no wall behind; 0: nothing is, or none
/// does.
double drilled_mm(const PlanRequest& plan, part::End end);

/// z of the jaws' end (between centres: of the held end) in part coordinates.
double root_z_mm(const PlanRequest& plan, std::size_t setup, Clamping clamping);
/// z of the free end once this setup has faced it.
double free_z_mm(const PlanRequest& plan, std::size_t setup);

/// Diameter [mm] the jaws close on, 0 between centres.
double grip_diameter_mm(const PlanRequest& plan, std::size_t setup, Clamping clamping);

/// Largest bore [mm] between the jaws once the setup is done, 0 of a solid part.
double gripped_bore_mm(const PreparedPart& plan, std::size_t setup);

/// Force of all jaws at rest [N], 0 between centres; they may be eased when the roughing
/// of a setup is done.
enum class Stage { roughing, finishing };
double jaw_force_N(const PreparedPart& plan, std::size_t setup, Clamping clamping,
                   Stage stage);

/// The jaws' forces of every setup.  Where the request gives none for finishing it is the
/// largest, not above roughing's, whose three-jaw lobing of a tube uses at most a quarter
/// of each tolerance that sees it, and at least a twentieth of roughing's.  Needs `work`
/// and `drilled_mm` of the part.
std::vector<JawForces> jaw_forces(const PreparedPart& part);

/// The body from the root to the free end; the end at the root is as the setups before
/// left it.
class SetupBody {
 public:
  SetupBody(const PreparedPart& plan, std::size_t setup, Clamping clamping,
            const Finished& finished);

  /// Distance from the root [mm], of a z of the part.
  double x_mm(double z_mm) const { return sign_ * (z_mm - root_z_); }
  double length_mm() const { return length_; }

  /// The body with material of this thickness [mm] on all of one element: what a pass
  /// leaves.  A hole is never narrower than the stock's.
  part::Shaft shaft(const Element& element, double left_mm) const;
  /// The body as `finished` says; what has a cut counts as its core, what will be drilled
  /// as drilled.
  part::Shaft shaft() const;

 private:
  struct Zone {
    double z0, z1, d0, d1;  // left and right end and the diameters there
  };
  part::Shaft shaft(const std::vector<Zone>& outer, const std::vector<Zone>& inner) const;

  const PreparedPart* part_;
  double root_z_, sign_, length_;
  std::vector<Zone> outer_, inner_;  // one an element, then what is beside them
};

/// Supports of the radial and the tangential plane of a clamping on a lathe.  A steady
/// rest has its place from the plan, its compliance from the machine.
struct Planes {
  deflection::Supports radial, tangential;
};
Planes planes(const catalogue::Lathe& machine, Clamping clamping);

/// Minutes to bring in what a clamping has beside the chuck: centres and rests.
double clamping_min(const catalogue::Lathe& machine, Clamping clamping);

/// Whether a tailstock presses on the part.
bool has_tailstock(Clamping clamping);

/// No wall between bores is as thin [mm]: so far they meet.
inline constexpr double kNoWall_mm = 0.01;

/// Width of a steady rest along the axis [mm]: what it stands on is not cut.
inline constexpr double kSteadyWidth_mm = 20;

}  // namespace turnwright::planning
