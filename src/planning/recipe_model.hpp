#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "feature.hpp"
#include "turnwright/optimise/branch_and_bound.hpp"
#include "turnwright/optimise/local.hpp"

/// A recipe as a problem of optimise/: the one place where physics becomes f, g and
/// boxes.
namespace turnwright::planning {

/// What a constraint of the problem stands for.
struct Row {
  std::size_t operation = 0;  ///< or the functional, for Check::tolerance
  Check check = Check::force;
  bool speed = false;
};

/// Value and limit of a row at a point.
struct RowValue {
  Row row;
  double value = 0, limit = 0;
};

/// g of a row: ln(value/limit), and value/limit - 1 for tolerances and chatter, whose
/// values have either sign; the two agree to first order where they bind.
double violation(const RowValue& r);

/// Variables of the full problem: ln v, ln f of both operations, ln a.
inline constexpr int kConditions = 5;

class RecipeModel {
 public:
  RecipeModel(Recipe recipe, Chain chain);
  RecipeModel(const RecipeModel&) = delete;  // the problem's functions point here
  RecipeModel& operator=(const RecipeModel&) = delete;

  const Recipe& recipe() const { return recipe_; }
  const Chain& chain() const { return chain_; }
  const std::vector<Row>& rows() const { return rows_; }

  /// The full problem: speeds, feeds and the finishing depth, every check.
  const optimise::Problem& problem() const { return problem_; }
  /// The same with the speeds at their best, over (ln f, ln f, ln a).
  optimise::Piece piece() const;
  /// With the Lagrangian (weight 1) or refutation (weight 0) that multipliers of the full
  /// problem make.
  optimise::Piece piece(double weight, const std::vector<double>& multipliers) const;

  /// Conditions at a point of the full problem, and back.
  Choice<double> choice(const std::vector<double>& y) const;
  std::vector<double> point(const Choice<double>& c) const;
  /// Start with feeds and depth at the given shares of their log ranges, best speeds.
  std::vector<double> start(double feed_share, double depth_share) const;

  std::vector<RowValue> values(const Choice<double>& c) const;
  double objective(const Choice<double>& c) const;
  /// ln(objective) with best speeds if every check is kept, else +infinity.
  double feasible_value(Choice<double>& c) const;

 private:
  optimise::Box box() const;
  void evaluate(std::span<const double> y, optimise::Values& out) const;
  using SpeedWeightsOfAll = std::array<SpeedWeights, 2>;
  void bound(const optimise::Box& box, const SpeedWeightsOfAll& weights,
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
