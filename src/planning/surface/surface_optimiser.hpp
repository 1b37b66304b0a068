#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "machined_surface.hpp"
#include "recipe_model.hpp"
#include "turnwright/planning/process_plan.hpp"

/// The cheapest way to make one surface with its certificate, or the reason why none
/// exists.
namespace turnwright::planning {

/// Largest gap of a global certificate, as a share of the objective.
inline constexpr double kCertified = 1e-4;

struct SurfaceAnswer;

/// Results of a task without tolerances and chatter.  They are shared by tasks that
/// differ only in these, or in a clamping with the same Holding.
struct Unasked {
  std::optional<double> least;                ///< see least_objective
  std::shared_ptr<const SurfaceAnswer> best;  ///< certified
};

struct SurfaceTask {
  MachinedSurface feature;
  std::vector<CutTolerance> cut_tolerances;
  std::vector<Recipe> recipes;
  Economy economy;
  Making making;
  Offset offset = Offset::none;  ///< with which its sizes are constrained
  bool explain = false;  ///< if no recipe is feasible, compare all of them for the reason
  long boxes = 20'000;   ///< after which the search ends and the certificate is `local`
  std::shared_ptr<Unasked> unasked = std::make_shared<Unasked>();
};

struct SurfaceAnswer {
  bool feasible = false;
  std::shared_ptr<RecipeModel> model;  ///< of the chosen, or least violated, recipe
  Choice<double> choice;
  double objective = 0;
  std::vector<double> multipliers;  ///< of the model's rows
  tolerance::PiecewisePolynomial profile;
  double lower_bound = 0;  ///< proved; +infinity: no recipe is feasible
  Certificate certificate;
  double least_violation = 0;  ///< of the best infeasible point, max g
};

/// A lower bound of the objective over all recipes without tolerances; +infinity if no
/// recipe keeps its limits.  The search is brief compared with optimise_surface, and is
/// made once for all tasks that share `unasked`.
double least_objective(const SurfaceTask& task);

/// Minimises over discrete choices and conditions.  Tolerances are linear constraints at
/// positions on the surface.  The most violated positions of each optimum are added until
/// none is violated (exchange method, [Blankenship 1976]); a lower bound that is proved
/// with some positions holds with all of them.
///
/// A corrected path is interpolated between its places; where its remaining error would be
/// more than a size has room for, the sizes are tightened until it is not.
///
/// `gap` is the gap at which branch and bound ends, in ln(objective).  With a finite
/// `most` only answers cheaper than that are searched for; that there is none is then
/// often proved quickly.
/// @throws std::runtime_error if the exchange does not end (40 rounds).
SurfaceAnswer optimise_surface(const SurfaceTask& task, double gap, double most);

/// The conditions that violate the limits least, as an infeasible answer without
/// certificate.  A local search finds them; it shows by how much the request is
/// infeasible, and by which limit.  It tries some forty recipes, or all of them if
/// `task.explain`, until one keeps every limit.
SurfaceAnswer nearest(const SurfaceTask& task);

/// Conditions that keep every limit, as an answer without costs; feasible == false where
/// local searches of every recipe find none.
SurfaceAnswer any_answer(const SurfaceTask& task);

/// Largest value/limit - 1 of the cut tolerances of a surface with this error.
double worst_excess(const std::vector<CutTolerance>& cut_tolerances,
                    const tolerance::PiecewisePolynomial& e);

}  // namespace turnwright::planning
