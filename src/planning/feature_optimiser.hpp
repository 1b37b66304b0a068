#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "recipe_model.hpp"
#include "turnwright/planning/process_plan.hpp"

/// The cheapest way to make one surface, with its certificate, or why there is none.
namespace turnwright::planning {

/// What a global certificate may leave open, of the objective.
inline constexpr double kCertified = 1e-4;

struct FeatureAnswer;

/// What is known of a task while neither a tolerance nor chatter is asked; tasks that
/// differ only there, or in a clamping that holds alike, share it.
struct Unasked {
  std::optional<double> least;                ///< see least_objective
  std::shared_ptr<const FeatureAnswer> best;  ///< certified
};

struct FeatureTask {
  Feature feature;
  std::vector<Demand> demands;
  std::vector<Recipe> recipes;
  Economy economy;
  Making making;
  bool explain = false;  ///< if nothing is feasible, compare every recipe to say why
  long boxes = 20'000;   ///< past them the certificate says `local`
  std::shared_ptr<Unasked> unasked = std::make_shared<Unasked>();
};

struct FeatureAnswer {
  bool feasible = false;
  std::shared_ptr<RecipeModel> model;  ///< of the chosen, or least violated, recipe
  Choice<double> choice;
  double objective = 0;
  std::vector<double> multipliers;  ///< of the model's rows
  tolerance::PiecewisePolynomial profile;
  double lower_bound = 0;  ///< proved; +infinity: nothing is feasible
  Certificate certificate;
  double least_violation = 0;  ///< of the best infeasible point, max g
};

/// A lower bound of the objective over all recipes, tolerances left out; +infinity if no
/// recipe keeps its limits.  A brief search, cheap beside optimise_feature, and done once
/// for all tasks that share `unasked`.
double least_objective(const FeatureTask& task);

/// Minimises over discrete choices and conditions.  Tolerances are linear constraints at
/// positions on the surface.  The most violated positions of each optimum are added until
/// none is violated (exchange method, [Blankenship 1976]); a lower bound that is proved
/// with some positions holds with all of them.
///
/// `gap` is what the branch and bound may leave open, in ln(objective).  With a finite
/// `most` the search is for answers cheaper than that: none is an answer too, and a quick
/// one.
/// @throws std::runtime_error if the exchange does not end (40 rounds).
FeatureAnswer optimise_feature(const FeatureTask& task, double gap, double most);

/// The conditions that break the limits least, as an infeasible answer without
/// certificate: a local search, which says how far off the request is and by which limit.
/// Looks at some forty recipes, or at all if `task.explain`, until one keeps every limit.
FeatureAnswer nearest(const FeatureTask& task);

/// Conditions that keep every limit, as an answer without costs; feasible == false where
/// local searches of every recipe find none.
FeatureAnswer any_answer(const FeatureTask& task);

/// Worst value over limit - 1 of the demands on a surface with this error.
double worst_excess(const std::vector<Demand>& demands,
                    const tolerance::PiecewisePolynomial& e);

}  // namespace turnwright::planning
