#include "feature_optimiser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "exchange.hpp"

namespace turnwright::planning {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kRounds = 40;

struct Candidate {
  std::shared_ptr<RecipeModel> model;
  double root_bound = -kInfinity;
  std::optional<optimise::Solution> local;  // feasible
};

struct Best {
  std::size_t candidate = 0;
  std::vector<double> y;
  double f = kInfinity;
};

std::vector<Candidate> candidates(const FeatureTask& task, const Exchange& exchange) {
  std::vector<Candidate> all;
  for (const auto& recipe : task.recipes) {
    auto chain = task.feature.chain(recipe, task.economy, exchange.stations());
    if (!chain) continue;
    chain->functionals = exchange.functionals();
    Candidate c;
    c.model = std::make_shared<RecipeModel>(recipe, std::move(*chain));
    optimise::Bound f;
    std::vector<optimise::Bound> g;
    const auto piece = c.model->piece();
    piece.bound(piece.box, f, g);
    c.root_bound = std::isfinite(f.v.lo) ? f.v.lo : -kInfinity;
    all.push_back(std::move(c));
  }
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return a.root_bound < b.root_bound;
  });
  return all;
}

// Local minima from a few starts, recipes with the lowest bounds first; a recipe whose
// bound is above the best so far needs none.
Best local_search(std::vector<Candidate>& all) {
  Best best;
  for (std::size_t k = 0; k < all.size(); ++k) {
    auto& c = all[k];
    if (c.root_bound >= best.f) continue;
    for (const auto& [feed, depth] : {std::pair{0.85, 0.15}, {0.4, 0.5}}) {
      const auto s =
          optimise::local_minimum(c.model->problem(), c.model->start(feed, depth));
      if (s.status == optimise::Status::no_feasible_point_met) continue;
      if (!c.local || s.f < c.local->f) c.local = s;
      if (s.f < best.f) best = {k, s.y, s.f};
      break;  // the search that follows finds what this start has missed
    }
  }
  return best;
}

optimise::Solution least_violation(const RecipeModel& m) {
  optimise::Solution best;
  best.f = kInfinity;
  for (const auto& [feed, depth] : {std::pair{0.2, 0.2}, {0.6, 0.5}, {0.05, 0.05}}) {
    auto s = optimise::least_violation(m.problem(), m.start(feed, depth), -1.0);
    if (s.f < best.f) best = std::move(s);
  }
  return best;
}

// What is proved about the best value over all candidates; finds better points on the
// way.
Certificate certify(std::vector<Candidate>& all, Best& best, double gap) {
  Certificate certificate;
  double bound = kInfinity;
  std::vector<optimise::Piece> pieces;
  std::vector<std::size_t> of;
  bool convex_only = true;
  for (std::size_t k = 0; k < all.size(); ++k) {
    auto& c = all[k];
    if (c.local && c.model->convex()) {
      optimise::Values v{0, std::vector<double>(kConditions), {}, {}};
      const auto& p = c.model->problem();
      v.g.resize(p.constraints);
      v.dg.resize(p.constraints * kConditions);
      p.evaluate(c.local->y, v);
      bound = std::min(
          bound, optimise::convex_lower_bound(p, c.local->y, v, c.local->multipliers));
      ++certificate.nodes;
      continue;
    }
    convex_only = false;
    auto piece = c.model->piece();
    if (c.local)
      piece.combinations.push_back(c.model->combination(1, c.local->multipliers));
    else if (c.root_bound < best.f) {
      const auto worst = least_violation(*c.model);
      if (worst.f > 0)
        piece.combinations.push_back(c.model->combination(0, worst.multipliers));
    }
    piece.try_point = [&best, k, model = c.model](const optimise::Box& b) {
      Choice<double> choice{
          {1, 1}, {std::exp(mid(b[0])), std::exp(mid(b[1]))}, std::exp(mid(b[2]))};
      const double f = model->feasible_value(choice);
      if (f < best.f) best = {k, model->point(choice), f};
      return f;
    };
    pieces.push_back(std::move(piece));
    of.push_back(k);
  }
  certificate.kind = CertificateKind::global;
  certificate.engine = convex_only ? "convex" : "branch-and-bound";
  if (!pieces.empty()) {
    const auto r = optimise::branch_and_bound(pieces, best.f, {.gap = gap});
    bound = std::min(bound, r.lower_bound);
    certificate.nodes += r.nodes;
    if (!r.complete) {
      certificate.kind = CertificateKind::local;
      certificate.reason = "the budget of " + std::to_string(r.nodes) +
                           " boxes ended before every box was settled";
    }
  }
  certificate.lower_bound = std::exp(bound);
  return certificate;
}

FeatureAnswer infeasible(std::vector<Candidate>& all, const Certificate& certificate) {
  FeatureAnswer answer;
  answer.certificate = certificate;
  answer.least_violation = kInfinity;
  for (auto& c : all) {
    const auto s = least_violation(*c.model);
    if (!(s.f < answer.least_violation)) continue;
    answer.least_violation = s.f;
    answer.model = c.model;
    answer.choice = c.model->choice(s.y);
    answer.multipliers = s.multipliers;
  }
  return answer;
}

// d ln(objective)/d y_j that no row explains: what a bound of the box carries.
std::vector<double> slopes(const optimise::Problem& p, const optimise::Solution& s) {
  optimise::Values v{0, std::vector<double>(kConditions),
                     std::vector<double>(p.constraints),
                     std::vector<double>(p.constraints * kConditions)};
  p.evaluate(s.y, v);
  auto r = v.df;
  for (std::size_t i = 0; i < p.constraints; ++i)
    for (std::size_t j = 0; j < r.size(); ++j)
      r[j] += s.multipliers[i] * v.dg[i * r.size() + j];
  return r;
}

}  // namespace

double worst_excess(const std::vector<Demand>& demands,
                    const tolerance::PiecewisePolynomial& e) {
  const auto x = tolerance::extremes(e);
  double worst = -1;
  using enum Demand::Shape;
  for (const auto& d : demands) {
    if (d.shape == none) continue;
    double value = d.factor * (x.max_mm - x.min_mm);
    if (d.shape == size) value = d.factor * std::max(x.max_mm, -x.min_mm);
    if (d.shape == straightness) value = tolerance::minimum_zone(e).width_mm;
    worst = std::max(worst, value / std::max(d.upper, 1e-12) - 1);
  }
  return worst;
}

FeatureAnswer optimise_feature(const FeatureTask& task, double gap) {
  Exchange exchange(task.feature, task.demands);
  for (int round = 0; round < kRounds; ++round) {
    auto all = candidates(task, exchange);
    Best best = local_search(all);
    const auto violated = [&] {
      const auto& model = *all[best.candidate].model;
      return exchange.add_violated(model.recipe(), task.economy, model.choice(best.y));
    };
    if (std::isfinite(best.f) && violated()) continue;
    const double before = best.f;
    Certificate certificate = certify(all, best, gap);
    if (!std::isfinite(best.f)) return infeasible(all, certificate);

    const auto& model = all[best.candidate].model;
    auto s = optimise::local_minimum(model->problem(), best.y);
    if (s.status == optimise::Status::no_feasible_point_met || s.f > best.f) {
      s.y = best.y;  // the search's own point, feasible by its test
      s.f = best.f;
    }
    best.y = s.y;
    best.f = s.f;
    if (best.f < before && violated()) continue;

    FeatureAnswer answer;
    answer.feasible = true;
    answer.model = model;
    answer.choice = model->choice(best.y);
    answer.objective = std::exp(best.f);
    answer.multipliers = s.multipliers;
    answer.slopes = slopes(model->problem(), s);
    answer.profile = task.feature.profile(model->recipe(), task.economy, answer.choice);
    certificate.lower_bound = std::min(certificate.lower_bound, answer.objective);
    certificate.gap = 1 - certificate.lower_bound / answer.objective;
    answer.certificate = certificate;
    return answer;
  }
  throw std::runtime_error("planning " + task.feature.surface() +
                           ": the places of its tolerances keep moving");
}

}  // namespace turnwright::planning
