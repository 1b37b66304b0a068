#include "recipe_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace turnwright::planning {
namespace {

using optimise::Bound;
using optimise::Box;
using optimise::excludes;

// g for any scalar type with a logarithm; see violation().
template <class T>
T g_of(Check check, const T& value, const T& limit) {
  using std::log;
  if (either_sign(check)) return value / limit - 1.0;
  return log(value / limit);
}
Bound g_of(Check, const LogDual<optimise::kBoxVariables>& value,
           const LogDual<optimise::kBoxVariables>& limit) {
  return log(value / limit);
}

// The feasible region may be a single point, such as a stock that two cuts of the largest
// depth just remove; it is then reached only up to rounding.
constexpr double kRounding = 1e-10;

struct Span {
  double lower, upper;
};
Span logs(const catalogue::Range& r) {
  // Bounds lie slightly beyond ranges that are also checks, so that the check binds,
  // which has a name.
  const double slack = r.lower < r.upper ? 0.01 : 0.0;
  return {std::log(r.lower) - slack, std::log(r.upper) + slack};
}

}  // namespace

double violation(const RowValue& r) { return g_of(r.row.check, r.value, r.limit); }

RecipeModel::RecipeModel(Recipe recipe, Chain chain)
    : recipe_(recipe), chain_(std::move(chain)) {
  const auto add = [&](std::size_t k, const catalogue::Range& r) {
    const auto s = logs(r);
    problem_.lower[k] = s.lower;
    problem_.upper[k] = s.upper;
  };
  problem_.lower.assign(kConditions, 0);
  problem_.upper.assign(kConditions, 0);
  for (std::size_t i = 0; i < chain_.operations.size(); ++i) {
    add(2 * i, chain_.operations[i].vc);
    add(2 * i + 1, chain_.operations[i].f);
  }
  problem_.lower[4] = std::log(chain_.a.lower);
  problem_.upper[4] = std::log(chain_.a.upper);
  for (const auto& r : values(choice(start(0.5, 0.5)))) rows_.push_back(r.row);
  problem_.constraints = rows_.size();
  for (const auto& r : rows_) reduced_rows_ += !r.speed;
  reduced_rows_ += chain_.operations.size();  // the speed windows
  problem_.evaluate = [this](std::span<const double> y, optimise::Values& out) {
    evaluate(y, out);
  };
}

Choice<double> RecipeModel::choice(const std::vector<double>& y) const {
  return {
      {std::exp(y[0]), std::exp(y[2])}, {std::exp(y[1]), std::exp(y[3])}, std::exp(y[4])};
}

std::vector<double> RecipeModel::point(const Choice<double>& c) const {
  std::vector<double> y(kConditions, 0.0);
  for (std::size_t i = 0; i < chain_.operations.size(); ++i) {
    y[2 * i] = std::log(c.v[i]);
    y[2 * i + 1] = std::log(c.f[i]);
  }
  y[4] = std::log(c.a);
  for (std::size_t j = 0; j < y.size(); ++j)
    y[j] = std::clamp(y[j], problem_.lower[j], problem_.upper[j]);
  return y;
}

std::vector<double> RecipeModel::start(double feed_share, double depth_share) const {
  const auto at = [&](std::size_t j, double share) {
    return problem_.lower[j] + share * (problem_.upper[j] - problem_.lower[j]);
  };
  Choice<double> c{{1, 1},
                   {std::exp(at(1, feed_share)), std::exp(at(3, feed_share))},
                   std::exp(at(4, depth_share))};
  evaluate_at_best_speed(chain_, c, {}, [](auto&&...) {});
  return point(c);
}

std::vector<RowValue> RecipeModel::values(const Choice<double>& c) const {
  std::vector<RowValue> all;
  planning::evaluate(
      chain_, c, [&](std::size_t i, Check check, bool speed, double value, double limit) {
        all.push_back({{i, check, speed}, value, limit});
      });
  return all;
}

double RecipeModel::objective(const Choice<double>& c) const {
  return planning::evaluate(chain_, c, [](auto&&...) {});
}

double RecipeModel::feasible_value(Choice<double>& c) const {
  bool kept = true;
  const auto value = evaluate_at_best_speed(
      chain_, c, {}, [&](std::size_t, Check, bool, double v, double limit) {
        kept = kept && v <= limit + kRounding * std::abs(limit);
      });
  return kept ? std::log(value.objective) : std::numeric_limits<double>::infinity();
}

void RecipeModel::evaluate(std::span<const double> y, optimise::Values& out) const {
  using D = Dual<double, kConditions>;
  std::array<D, kConditions> x;
  for (int j = 0; j < kConditions; ++j)
    x[static_cast<std::size_t>(j)] =
        exp(variable<double, kConditions>(y[static_cast<std::size_t>(j)], j));
  const Choice<D> c{{x[0], x[2]}, {x[1], x[3]}, x[4]};
  std::size_t row = 0;
  const D f = log(planning::evaluate(
      chain_, c, [&](std::size_t, Check check, bool, const D& value, const D& limit) {
        const D g = g_of(check, value, limit);
        out.g[row] = g.v;
        std::copy(g.d.begin(), g.d.end(),
                  out.dg.begin() + static_cast<std::ptrdiff_t>(row * kConditions));
        ++row;
      }));
  out.f = f.v;
  std::copy(f.d.begin(), f.d.end(), out.df.begin());
}

Box RecipeModel::box() const {
  Box b;
  for (std::size_t k = 0; k < 2; ++k)
    b[k] = Interval(problem_.lower[2 * k + 1], problem_.upper[2 * k + 1]);
  b[2] = Interval(problem_.lower[4], problem_.upper[4]);
  return b;
}

bool RecipeModel::bound(const Box& box, double cut, const SpeedWeightsOfAll& weights,
                        Bound& f, std::vector<Bound>& g) const {
  using L = LogDual<optimise::kBoxVariables>;
  L::Half half;
  for (std::size_t k = 0; k < half.size(); ++k) half[k] = width(box[k]) / 2;
  Choice<L> c;
  for (int k = 0; k < 2; ++k)
    c.f[static_cast<std::size_t>(k)] =
        L::variable(box[static_cast<std::size_t>(k)], k, half);
  c.a = L::variable(box[2], 2, half);
  g.clear();
  // The tolerances take most of the time, so a box is dropped without them if it can be.
  bool left = true;
  const auto cost = evaluate_at_best_speed(
      chain_, c, weights,
      [&](std::size_t, Check check, bool, const auto& v, const auto& limit) {
        g.push_back(g_of(check, v, limit));
      },
      [&](const L& objective) {
        f = log(objective);
        left = !excludes(f, cut) &&
               std::ranges::none_of(g, [](const Bound& b) { return excludes(b, 0); });
        return left;
      });
  g.push_back(log(cost.smooth));
  return left;
}

void RecipeModel::value(const optimise::Point& y, const SpeedWeightsOfAll& weights,
                        double& f, std::vector<double>& g) const {
  Choice<double> c{{1, 1}, {std::exp(y[0]), std::exp(y[1])}, std::exp(y[2])};
  g.clear();
  const auto cost = evaluate_at_best_speed(
      chain_, c, weights, [&](std::size_t, Check check, bool, double v, double limit) {
        g.push_back(g_of(check, v, limit));
      });
  f = std::log(cost.objective);
  g.push_back(std::log(cost.smooth));
}

optimise::Piece RecipeModel::piece() const { return piece(SpeedWeightsOfAll{}); }

optimise::Piece RecipeModel::piece(const SpeedWeightsOfAll& weights) const {
  optimise::Piece p;
  p.box = box();
  p.constraints = reduced_rows_;
  p.bound = [this, weights](const Box& b, double cut, Bound& f, std::vector<Bound>& g) {
    return bound(b, cut, weights, f, g);
  };
  p.value = [this, weights](const optimise::Point& y, double& f, std::vector<double>& g) {
    value(y, weights, f, g);
  };
  return p;
}

optimise::Piece RecipeModel::piece(double weight, const optimise::Solution& at) const {
  optimise::Combination c{weight, {}};
  SpeedWeightsOfAll speeds;
  const std::size_t n = at.y.size();
  optimise::Values v{0, std::vector<double>(n), std::vector<double>(rows_.size()),
                     std::vector<double>(rows_.size() * n)};
  evaluate(at.y, v);
  // Reduced rows come in the same order, each operation's speed rows as one window.  Where
  // limits from both sides pinch the speed, the window holds what both hold.
  std::array<double, 2> held{};  // from below, from above
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const bool last = i + 1 == rows_.size() ||
                      rows_[i + 1].operation != rows_[i].operation ||
                      rows_[i + 1].check == Check::tolerance;
    if (!rows_[i].speed) {
      c.multipliers.push_back(at.multipliers[i]);
      continue;
    }
    const double slope = v.dg[i * n + 2 * rows_[i].operation];  // in ln v
    const double hold = at.multipliers[i] * std::abs(slope);
    speeds[rows_[i].operation].push_back(hold);
    held[slope > 0] += hold;
    if (last) c.multipliers.push_back(std::ranges::min(std::exchange(held, {})));
  }
  auto p = piece(speeds);
  p.combinations.push_back(std::move(c));
  return p;
}

}  // namespace turnwright::planning
