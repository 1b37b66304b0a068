#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "planning/operation/evaluate.hpp"
#include "recipe.hpp"
#include "turnwright/optimise/branch_and_bound.hpp"
#include "turnwright/optimise/local.hpp"

/// A recipe as an optimisation problem: the one place where physics becomes the objective
/// f, the constraints g and the boxes of optimise/.
namespace turnwright::planning {

/// Meaning of a constraint of the problem.
struct Row {
  std::size_t operation = 0;  ///< for Check::tolerance the linear constraint
  Check check = Check::force;
  bool speed = false;
};

/// Value and limit of a row at a point.
struct RowValue {
  Row row;
  double value = 0, limit = 0;
};

/// g of a row: ln(value/limit), but value/limit - 1 for tolerances and chatter, whose
/// values may have either sign.  The two agree to first order where the row binds.
double violation(const RowValue& r);

/// Variables of the full problem: ln v, ln f of both operations, ln a.
inline constexpr int kConditions = 5;

class RecipeModel {
 public:
  RecipeModel(Recipe recipe, Chain chain);
  RecipeModel(const RecipeModel&) =
      delete;  // the problem's functions point to this object
  RecipeModel& operator=(const RecipeModel&) = delete;

  const Recipe& recipe() const { return recipe_; }
  const Chain& chain() const { return chain_; }
  const std::vector<Row>& rows() const { return rows_; }

  /// The full problem: speeds, feeds and the finishing depth, with every check.
  const optimise::Problem& problem() const { return problem_; }
  /// The reduced problem, with the best speeds, over (ln f, ln f, ln a).
  optimise::Piece piece() const;
  /// The reduced problem with the Lagrangian (weight 1) or the refutation (weight 0) by
  /// the multipliers mu of a solution of the full problem.  Of several limits of one speed
  /// each counts by what it holds of it, mu_i |dg_i/d ln v|, so that the gradient of the
  /// Lagrangian is zero there although the best speed has a kink.
  optimise::Piece piece(double weight, const optimise::Solution& at) const;

  /// Conversion between a point of the full problem and conditions.
  Choice<double> choice(const std::vector<double>& y) const;
  std::vector<double> point(const Choice<double>& c) const;
  /// Starting point with feeds and depth at the given fractions of their logarithmic
  /// ranges, and the best speeds.
  std::vector<double> start(double feed_share, double depth_share) const;

  std::vector<RowValue> values(const Choice<double>& c) const;
  double objective(const Choice<double>& c) const;
  /// ln(objective) with the best speeds if every check is kept, otherwise +infinity.
  double feasible_value(Choice<double>& c) const;

 private:
  optimise::Box box() const;
  void evaluate(std::span<const double> y, optimise::Values& out) const;
  using SpeedWeightsOfAll = std::array<SpeedWeights, 2>;
  bool bound(const optimise::Box& box, double cut, const SpeedWeightsOfAll& weights,
             optimise::Bound& f, std::vector<optimise::Bound>& g) const;
  void value(const optimise::Point& y, const SpeedWeightsOfAll& weights, double& f,
             std::vector<double>& g) const;
  optimise::Piece piece(const SpeedWeightsOfAll& weights) const;

  Recipe recipe_;
  Chain chain_;
  std::vector<Row> rows_;
  std::size_t reduced_rows_ = 0;
  optimise::Problem problem_;
};

}  // namespace turnwright::planning
