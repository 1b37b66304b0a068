#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "turnwright/deflection/beam.hpp"
#include "turnwright/part/shaft.hpp"
#include "turnwright/planning/prepared_part.hpp"

/// Assignment of surfaces to setups, and the body that a setup holds while it cuts.
namespace turnwright::planning {

/// Which elements have their final diameters; the others are stock.
struct Finished {
  std::vector<bool> outer, inner;
};
Finished nothing_finished(const part::Drawing& drawing);
/// Adds all surfaces that a setup cuts.
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
/// Given operations decide the setup; a surface that none of them makes is unreachable.
/// Needs `grips_mm` of the part.
Assignment assign(const PreparedPart& part);

/// "d1|d2": the face between outer elements k-1 and k.
std::string shoulder_id(const part::Drawing& drawing, std::size_t k);
/// The setup that makes an element or face; none if it stays as it is in the stock.
std::optional<std::size_t> setup_of(const PreparedPart& part, const std::string& surface);
/// z [mm] of the face "left", "right" or of a shoulder.
double face_z_mm(const part::Drawing& drawing, const std::string& face);
/// Whether a profiling tool that comes from the end a setup leaves free clears an outer
/// element: false only for arcs that fall more than `part::kProfilingClears_rad`.
bool cleared(const PreparedPart& part, std::size_t setup, std::size_t element);
/// "left" or "right": the end that a setup leaves free.
const char* free_face(const PreparedPart& part, std::size_t setup);

/// Elements with their final diameters once a setup is done.
Finished finished_after(const PreparedPart& part, std::size_t setup);

/// Material [mm] before the finished face of an end once it is free: the parting-off
/// allowance at the end that the first setup holds, else the stock's allowance.
double face_stock_mm(const PreparedPart& part, part::End end);
/// The same once a setup is done: none if the end was faced by then.
double face_stock_after_mm(const PreparedPart& part, std::size_t setup, part::End end);

/// Diameter [mm] drilled from an end of a bar before its bores are bored: the largest of
/// the plan's drills that leaves 0.5 mm on the radius of the narrowest bore, reaches
/// their end, and whose point cuts neither a narrower bore nor a wall behind; 0 if
/// nothing is drilled.
double drilled_mm(const PlanRequest& request, part::End end);

/// z of the jaws' end (between centres: of the held end) in part coordinates.
double root_z_mm(const PreparedPart& part, std::size_t setup, Clamping clamping);
/// z of the free end once this setup has faced it.
double free_z_mm(const PreparedPart& part, std::size_t setup);

/// Diameter [mm] the jaws close on, 0 between centres.
double grip_diameter_mm(const PreparedPart& part, std::size_t setup, Clamping clamping);

/// Largest bore [mm] between the jaws once the setup is done, 0 of a solid part.
double gripped_bore_mm(const PreparedPart& plan, std::size_t setup);

/// Force of all jaws at rest [N], 0 between centres; they may be eased when the roughing
/// of a setup is done.
enum class Stage { roughing, finishing };
double jaw_force_N(const PreparedPart& plan, std::size_t setup, Clamping clamping,
                   Stage stage);

/// The jaws' forces of every setup.  Where the request gives none for finishing it is the
/// largest, not above roughing's, whose three-jaw lobing of a tube uses at most a quarter
/// of each affected tolerance, and at least a twentieth of roughing's.  Needs `work`
/// and `drilled_mm` of the part.
std::vector<JawForces> jaw_forces(const PreparedPart& part);

/// The body from the root to the free end; the held end is as the setups before have left
/// it.
class SetupBody {
 public:
  SetupBody(const PreparedPart& plan, std::size_t setup, Clamping clamping,
            const Finished& finished);

  /// Distance from the root [mm], of a z of the part.
  double x_mm(double z_mm) const { return sign_ * (z_mm - root_z_); }
  double length_mm() const { return length_; }

  /// The body with material of this thickness [mm] on one whole element, as a pass leaves
  /// it.  A hole is never narrower than that of the stock.
  part::Shaft shaft(const Element& element, double left_mm) const;
  /// The body with the elements of `finished`; one with a groove, thread or arc counts as
  /// its core, a hole that will be drilled as drilled.
  part::Shaft shaft() const;

 private:
  struct Zone {
    double z0, z1, d0, d1;  // left and right end and the diameters there
  };
  part::Shaft shaft(const std::vector<Zone>& outer, const std::vector<Zone>& inner) const;

  const PreparedPart* part_;
  double root_z_, sign_, length_;
  std::vector<Zone> outer_, inner_;  // one per element, then the stock beside them
};

/// Supports of the radial and the tangential plane of a clamping on a lathe.  A steady
/// rest has its place from the plan, its compliance from the machine.
struct Planes {
  deflection::Supports radial, tangential;
};
Planes planes(const catalogue::Lathe& machine, Clamping clamping);

/// Minutes to bring in centres and rests of a clamping.
double clamping_min(const catalogue::Lathe& machine, Clamping clamping);

/// Whether a tailstock presses on the part.
bool has_tailstock(Clamping clamping);

/// Bores nearer to each other than this [mm] are one through hole; no thinner wall is
/// left standing.
inline constexpr double kNoWall_mm = 0.01;

/// Width of a steady rest along the axis [mm]; the surface below it is not cut.
inline constexpr double kSteadyWidth_mm = 20;

}  // namespace turnwright::planning
