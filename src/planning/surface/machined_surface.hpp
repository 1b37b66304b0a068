#pragma once
#include <optional>
#include <string>
#include <vector>

#include "planning/budget/cut_tolerance.hpp"
#include "planning/clamping/setup_body.hpp"
#include "planning/operation/chain.hpp"
#include "planning/paths/operation_gaps.hpp"
#include "planning/values/economy.hpp"
#include "planning/values/surface_request.hpp"
#include "recipe.hpp"
#include "turnwright/deflection/beam.hpp"
#include "turnwright/planning/process_plan.hpp"
#include "turnwright/tolerance/piecewise.hpp"

/// One surface in one setup and clamping: an outer element, a bore, an end face, a shoulder
/// outside or one between two bores.
namespace turnwright::planning {

/// The properties of a clamping that matter if deflection is not modelled: clampings
/// equal in them have the same chains as long as no positions are imposed.
struct Holding {
  double roughing_N = 0, finishing_N = 0;  ///< jaw force; none between centres
  double d_grip_mm = 0, n_max_rpm = 0;
  auto operator<=>(const Holding&) const = default;
};

class MachinedSurface {
 public:
  enum class Kind { element, bore, end_face, shoulder, inner_shoulder };

  static MachinedSurface element(const PreparedPart& plan, std::size_t setup,
                                 Clamping clamping, const SetupWork& work,
                                 const Finished& before, std::size_t index,
                                 const GivenConditions& fixed);
  static MachinedSurface bore(const PreparedPart& plan, std::size_t setup,
                              Clamping clamping, const SetupWork& work,
                              const Finished& before, std::size_t index,
                              const GivenConditions& fixed);
  static MachinedSurface end_face(const PreparedPart& plan, std::size_t setup,
                                  const Finished& before, const GivenConditions& fixed);
  static MachinedSurface shoulder(const PreparedPart& plan, std::size_t setup,
                                  Clamping clamping, const SetupWork& work,
                                  const Finished& before, std::size_t index,
                                  const GivenConditions& fixed);
  /// The shoulder behind a bore: a boring bar faces it once all bores are finished, from
  /// the edge of the narrower bore outwards to the wider one.  The minor edge then leads
  /// and the major edge trails, so that the angles of the tool from the feed are
  ///
  ///     kappa = 90 deg + kappa',  kappa' = KAPR - 90 deg > 0                         (2)
  ///
  /// Source: geometry of the edges of one corner, derived here.
  static MachinedSurface inner_shoulder(const PreparedPart& plan, std::size_t setup,
                                        Clamping clamping, const SetupWork& work,
                                        const Finished& before, std::size_t wider,
                                        const GivenConditions& fixed);

  /// Whether the forces are those of worn edges.
  bool is_worn() const {
    return plan_->shop.edge_wear_mm > 0 && (due_.rough || due_.finish);
  }
  /// Which edges are due for change, where the plan counts their wear.
  struct DueEdges {
    bool rough = true, finish = true;
  };
  /// The same surface cut by such edges; the others are new.
  MachinedSurface with_edges(DueEdges due) const {
    auto other = *this;
    other.due_ = due;
    return other;
  }

  Kind kind() const { return kind_; }
  /// What its last tool is for: a shoulder behind an undercut is faced by a finishing tool,
  /// which goes on into the undercut.
  catalogue::ToolUse last_use() const;
  bool is_shoulder() const {
    return kind_ == Kind::shoulder || kind_ == Kind::inner_shoulder;
  }
  bool is_face() const { return kind_ == Kind::end_face || is_shoulder(); }
  bool by_bar() const { return kind_ == Kind::bore || kind_ == Kind::inner_shoulder; }
  const std::string& surface() const { return surface_; }
  const GivenConditions& fixed() const { return fixed_; }
  double low_mm() const { return low_; }  ///< least z, or rho of a face
  double high_mm() const { return high_; }
  double stock_mm() const {
    return stock_;
  }  ///< to take off: on the radius, or of the face
  /// Factor from the errors of the chain to those of the surface's radius: material left
  /// standing makes the radius larger outside (+1) and smaller in a bore (-1).
  double sign() const { return kind_ == Kind::bore ? -1 : 1; }

  Holding holding() const;

  // In surface_edges.cpp.
  /// Whether a finishing tool makes the edges at its end as drawn: the fillet, the undercut,
  /// and a chamfer on the wall that is cut into stock.
  bool makes_edges(const catalogue::Tool& tool) const;
  /// What these ask of a tool, for a sentence; empty if nothing.
  std::string edges_asked() const;
  /// Whether a tool clears the tailstock's centre, if there is one, with its tip in front of
  /// an outer element, where the lowest pass over it begins.
  bool clears_centre(const catalogue::Tool& tool) const;

  /// An operation on it, for the order of the setup.
  InOrder in_order(const catalogue::Tool& tool, bool rough) const;

  /// The chain of a recipe without functionals; stations at the given places.  Over an
  /// open finishing depth the laws are polynomials in it that follow them to rounding
  /// (chebyshev.hpp).  Nothing if the recipe leaves no depth to choose.
  std::optional<Chain> chain(const Recipe& recipe, const Economy& economy,
                             const std::vector<double>& stations,
                             std::optional<double> a_mm = {}) const;

  /// Largest stiffness K_ww of chatter [N/mm] allowed in each operation at a finishing
  /// depth, were the edge rigid along the feed: 1/C_ww of
  ///
  ///     K_ww C_ww + max(0, 2 K_wz C_wz) + K_zz C_zz <= 1,                            (1)
  ///     C_ww = f_b/(2 zeta (1 + zeta)) + (f_s + c_rr)/(2 zeta_m (1 + zeta_m))
  ///            + y_w/(2 zeta_t (1 + zeta_t)),   f_s + f_b = f_ww
  ///     C_zz = (c_zz + c_ax)/(2 zeta_m (1 + zeta_m)) + y_z/(2 zeta_t (1 + zeta_t))
  ///     C_wz = -+y_p/(2 zeta_t (1 + zeta_t))
  ///
  /// with K by (7) of cutting/cut.hpp, at the worst of 33 places of the last pass, the most
  /// slender.  Letters as in (1) and (3) of yielding.hpp, y_z of bar_tip.hpp; on faces f_pp
  /// rho^2 and c_ax in place of f_ww and c_rr, and c_rr in place of c_zz + c_ax.  c_zz is
  /// the machine's tool_zz_mm_N; without it the compliances of machine and chuck along the
  /// feed do not count.  On a shoulder between bores y_z + y_a comes in place of y_w, y_w in
  /// place of y_z, and C_wz is that of -y_p.  f_s is what an all but rigid part yields in its supports, f_b the
  /// bending on top of that, never negative because a stiffer body yields less everywhere;
  /// zeta is the damping ratio of the bending part, zeta_m of the machine, zeta_t of a
  /// boring bar.  The compliances are static.  For modes of any frequencies and at any
  /// spindle speed the limit from the sum of their compliances is at most that of the modes
  /// together (docs/planning-chatter.md).
  std::vector<double> chatter_limits_N_mm(const Chain& chain, double a_mm) const;

  /// The largest of the operations' gains, the left side of (1).
  double chatter_share(const Chain& chain, const Choice<double>& choice) const;

  /// Imposes (1) on the operations of a chain that can reach it within their ranges; if
  /// the depth is open, at every position that is the worst, or nearly so, for some
  /// depth.
  void limit_chatter(Chain& chain, std::optional<double> a_mm = {}) const;
  /// Imposes (1) at one depth, at the positions where it is imposed on another chain.
  void limit_chatter_alike(const Chain& other, double a_mm, Chain& chain) const;

  /// The error over the whole surface at chosen conditions, as a piecewise polynomial
  /// through exact values: 8 pieces of degree 8 along an element (interpolation error
  /// below 1e-10 of the largest), degree 2 on a face, where it is exact.
  tolerance::PiecewisePolynomial profile(const Recipe& recipe, const Economy& economy,
                                         const Choice<double>& choice) const;

  /// Exact error at given places.
  std::vector<double> errors(const Recipe& recipe, const Economy& economy,
                             const Choice<double>& choice,
                             const std::vector<double>& places) const;

  /// Correction table (z or rho, dr): with dr added to the radius (of a face: the length)
  /// of the last pass no error remains at these positions; linear between them.
  Compensation::Table corrections(const Recipe& recipe, const Economy& economy,
                                  const Choice<double>& choice) const;
  /// As `profile`, with the path of the last pass corrected.
  tolerance::PiecewisePolynomial corrected_profile(
      const Recipe& recipe, const Economy& economy, const Choice<double>& choice,
      const Compensation::Table& table) const;

  /// The same at given positions.
  std::vector<double> corrected(const Recipe& recipe, const Economy& economy,
                                const Choice<double>& choice,
                                const std::vector<double>& places,
                                const Compensation::Table& table) const;

 private:
  MachinedSurface(const PreparedPart& plan, std::size_t setup, Clamping clamping,
                  Kind kind, std::string surface, const GivenConditions& fixed);
  template <class OuterOrInner>
  void take(const OuterOrInner& element, std::size_t index, double left_z_mm);
  void take_shoulder(const SetupWork& work, const Element& front, const Element& behind,
                     double z_mm, bool in_stock, double stock_mm);
  const part::Face* own_wall() const;
  void take_wall();
  std::optional<part::Undercut> undercut_of_last() const;
  OperationModel operation(const Recipe& recipe, bool finishing,
                           const Economy& economy) const;
  // In surface_edges.cpp.
  bool cuts_ring() const;
  bool ring_may_be_faced() const;
  double ring_mm(const catalogue::Tool& tool, double on_wall_mm) const;
  double ring_asked_mm(const catalogue::Tool& tool) const;
  std::optional<EdgeRing> ring(const Recipe& recipe,
                               const OperationModel& operation) const;
  // In surface_paths.cpp.
  struct Lengths {  // of a pass in the cut, of a pass at feed; rapids of all
    double path_mm = 0, fed_mm = 0, rapid_min = 0;
  };
  Lengths lengths(const Recipe& recipe, const OperationModel& operation, double stock_mm,
                  double a_mm) const;
  void add_lengths(const Recipe& recipe, double stock_mm, Chain& chain) const;
  Beside ways(const OperationModel& operation, const Strokes& strokes) const;
  Beside facing(const OperationModel& operation, const Strokes& strokes) const;
  Beside facing_inside(const OperationModel& operation, const Strokes& strokes) const;
  void add_laws(Chain& chain, std::optional<double> a_mm) const;
  // Values of p, q, s, r at one finishing depth: [station][pass].
  struct Values {
    double p, q, s, r;
  };
  std::vector<std::vector<Values>> laws_at(const Chain& chain, double a_mm) const;
  // In surface_chatter.cpp.
  std::vector<double> chatter_yields(const OperationModel& o, double left_mm,
                                     double uncut_mm,
                                     const std::vector<double>& places) const;
  std::vector<double> last_yields(const OperationModel& o, double a_mm,
                                  const std::vector<double>& places) const;
  std::vector<double> chatter_places() const;
  void yield_along_feed(OperationModel& o) const;
  double of_bar(const OperationModel& o) const;
  bool cut_to_chuck(const OperationModel& o) const;
  double feed_sign(const OperationModel& o) const;  // of what the feed force bends
  double axial_mm_N() const;                        // of what holds the part
  double x_mm(const OperationModel& o, double at_mm) const;  // from the root
  // Compliances while a pass leaves left_mm of uncut_mm, at distances from the root.
  void yields(const OperationModel& o, double left_mm, double uncut_mm,
              const std::vector<double>& x, std::vector<deflection::Flexibility>& radial,
              std::vector<deflection::Flexibility>& tangential, bool rigid = false) const;
  static part::Shaft stiffer(part::Shaft shaft);
  // Compliances from the bodies left and right of the tool.
  void yields(const part::Shaft& chuck_side, const part::Shaft& tail_side,
              const SetupBody& body, const std::vector<double>& x,
              std::vector<deflection::Flexibility>& radial,
              std::vector<deflection::Flexibility>& tangential) const;
  deflection::Flexibility at_the_tool(const deflection::Flexibility& f,
                                      double rest_mm_N) const;
  std::vector<std::vector<Values>> face_laws(const Chain& chain) const;
  bool enters(const catalogue::Tool& tool) const;
  bool ends_before_jaws(const catalogue::Tool& tool) const;

  const PreparedPart* plan_;
  std::size_t setup_;
  Clamping clamping_;
  Kind kind_;
  std::string surface_;
  GivenConditions fixed_;
  std::size_t index_ = 0;  // outer or inner element
  double low_ = 0, high_ = 0, stock_ = 0;
  /// By which given depths may miss the stock: they lead to the drawn size or into its
  /// limits, and the last pass to their middle.
  double depth_slack_mm_ = 0;
  /// Thickness that a casting or forging has at least all over the element: the passes that
  /// finish take no more, so that they cut everywhere.
  std::optional<double> everywhere_mm_ = {};
  double D_small_ = 0, D_large_ = 0;
  double face_x_ = 0;                  // of a face, from the root
  double left_mm_ = 0, right_mm_ = 0;  // of an element, its diameters
  double hole_mm_ = 0;                 // of a bore, the hole it starts from
  double depth_mm_ = 0;                // of a bar's surface, from the free end
  double Ra_um_ = 0, Rz_um_ = 0;
  Surroundings around_;  // of an element; of a face only the largest corner
  double face_z_ = 0;    // of a face, in the program's coordinates
  DueEdges due_ = {};
  bool goes_on_ = false;           // into an equally high surface that another setup cuts
  double top_mm_ = 0;              // of a shoulder, radius at which its facing begins
  double amplification_ = 1;       // by the tailstock's thrust
  std::vector<SetupBody> bodies_;  // while roughing, while finishing
};

}  // namespace turnwright::planning
