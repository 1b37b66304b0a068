#include "surface_optimiser.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "base/say.hpp"
#include "tolerance_points.hpp"
#include "turnwright/base/interval.hpp"

namespace turnwright::planning {
namespace {

constexpr int kRounds = 40;
constexpr int kNearestRounds = 5;
constexpr std::size_t kNearest = 12;   // recipes asked for the nearest conditions
constexpr double kKept = 5e-10;        // the most that a limit may be exceeded by, in ln
constexpr long kScouting = 30;         // boxes for a first bound of a task
constexpr double kScoutingGap = 2e-2;  // and what they may leave open
constexpr double kChatters = 5e-10;    // of the limit, as of a tolerance's
constexpr const char* kNone = to_translate("proved: no conditions keep every limit");

struct Candidate {
  Recipe recipe;
  double bound = -kInfinity;           // of ln(objective); more places only raise it
  std::shared_ptr<RecipeModel> model;  // built when first needed, anew in every round
  std::optional<optimise::Solution> local;
};

// The best point, or only the value that one has to beat.
struct Best {
  double f = kInfinity;
  std::size_t candidate = 0;
  std::vector<double> y;
  bool found() const { return !y.empty(); }
};

// Conditions in the middle of a box; the evaluation sets the speeds.
Choice<double> middle(const optimise::Box& b) {
  return {{1, 1}, {std::exp(mid(b[0])), std::exp(mid(b[1]))}, std::exp(mid(b[2]))};
}

std::shared_ptr<RecipeModel> without_tolerances(const SurfaceTask& task,
                                                const Recipe& recipe) {
  auto chain = task.feature.chain(recipe, task.economy, {});
  return chain ? std::make_shared<RecipeModel>(recipe, std::move(*chain)) : nullptr;
}

// Bound of ln(objective) without tolerances; +infinity where no condition keeps some
// limit.
double root_bound(const SurfaceTask& task, const Recipe& recipe) {
  const auto model = without_tolerances(task, recipe);
  if (!model) return kInfinity;
  std::vector<optimise::Piece> one{model->piece()};
  return optimise::branch_and_bound(one, kInfinity, {.max_nodes = 1}).lower_bound;
}

std::array<std::vector<double>, 2> starts(const RecipeModel& m) {
  return {m.start(0.2, 0.2), m.start(0.6, 0.5)};
}

optimise::Solution least_violation(const RecipeModel& m) {
  optimise::Solution best;
  best.f = kInfinity;
  for (const auto& start : starts(m)) {
    auto s = optimise::least_violation(m.problem(), start, -1.0);
    if (s.f < best.f) best = std::move(s);
  }
  return best;
}

// The answer if no conditions are cheaper than the best known ones.
SurfaceAnswer not_below(const SurfaceAnswer& known) {
  SurfaceAnswer a;
  a.lower_bound = known.lower_bound;
  a.certificate.reason = tr(kNone);
  return a;
}

bool chatters(const SurfaceTask& task, const RecipeModel& m, const Choice<double>& c) {
  return !(task.feature.chatter_share(m.chain(), c) <= 1 + kChatters);
}

bool keeps_demands(const SurfaceTask& task, const SurfaceAnswer& a) {
  return !chatters(task, *a.model, a.choice) &&
         !TolerancePoints(task.feature, task.cut_tolerances)
              .add_violated(a.model->recipe(), task.economy, a.choice);
}

SurfaceAnswer with_profile(const SurfaceTask& task, SurfaceAnswer a) {
  a.profile = task.feature.profile(a.model->recipe(), task.economy, a.choice);
  return a;
}

void set_bound(SurfaceAnswer& a, double bound) {
  a.lower_bound = bound;
  if (!(a.objective > 0)) return;
  a.certificate.lower_bound = std::min(bound, a.objective);
  a.certificate.gap = 1 - a.certificate.lower_bound / a.objective;
}

// One task's search over recipes.  It starts without tolerances and chatter; their
// constraints are imposed only where an optimum violates them, so a surface whose
// tolerances do not bind is proved without deflection in boxes.  Their positions are
// added from round to round.
class FeatureSearch {
 public:
  FeatureSearch(const SurfaceTask& task, double gap, double most)
      : task_(task),
        gap_(gap),
        most_(std::log(most)),
        exchange_(task.feature, task.cut_tolerances) {
    for (const auto& recipe : task.recipes) {
      const double bound = root_bound(task, recipe);
      if (bound < kInfinity) all_.push_back({recipe, bound, nullptr, {}});
    }
    std::stable_sort(
        all_.begin(), all_.end(),
        [](const Candidate& a, const Candidate& b) { return a.bound < b.bound; });
  }

  SurfaceAnswer run() {
    for (int round = 0; round < kRounds; ++round) {
      const Best before_places = best_;
      best_ = {most_, 0, {}};
      for (auto& c : all_) {
        c.model.reset();
        c.local.reset();
      }
      // The optimum before the new positions is the best start, its own recipe first.
      if (before_places.found())
        local_search(before_places.candidate, {before_places.y});
      else if (!all_.empty() && all_[0].bound < cut())
        local_search(0, {model(0)->start(0.85, 0.15)});
      if (best_.found() && violated()) continue;
      search_recipes();
      if (best_.found() && violated()) continue;
      const double before = best_.f;
      certify();
      if (!best_.found()) return none();
      auto s = polished();
      if (best_.f < before && violated()) continue;
      return answer(std::move(s));
    }
    throw std::runtime_error(
        say("planning {}: the search for the positions at which its tolerances bind did "
            "not converge",
            task_.feature.surface()));
  }

 private:
  double cut() const { return best_.f - gap_; }

  const std::shared_ptr<RecipeModel>& model(std::size_t k) {
    auto& c = all_[k];
    if (!c.model) {
      auto chain = task_.feature.chain(c.recipe, task_.economy, exchange_.stations());
      chain->functionals = exchange_.functionals();
      if (chatter_) task_.feature.limit_chatter(*chain);
      c.model = std::make_shared<RecipeModel>(c.recipe, std::move(*chain));
    }
    return c.model;
  }

  optimise::Piece with_points(std::size_t k, optimise::Piece p) {
    p.try_point = [this, k](const optimise::Box& b) {
      auto choice = middle(b);
      const double f = all_[k].model->feasible_value(choice);
      if (f < best_.f) best_ = {f, k, all_[k].model->point(choice)};
      return f;
    };
    return p;
  }

  // Cheapest-looking recipes first: a few boxes settle most of those that cannot win, and
  // a local minimum of the others brings the value down that they have to beat.
  void search_recipes() {
    for (std::size_t k = 0; k < all_.size(); ++k) {
      auto& c = all_[k];
      if (c.bound >= cut() || c.local) continue;
      const double known = best_.f;
      std::vector<optimise::Piece> one{with_points(k, model(k)->piece())};
      const auto r =
          optimise::branch_and_bound(one, known, {.gap = gap_, .max_nodes = kFirstBoxes});
      nodes_ += r.nodes;
      c.bound = std::max(c.bound, r.lower_bound);
      if (best_.f < known)
        local_search(k, {best_.y});
      else if (!r.complete)
        local_search(k, {model(k)->start(0.85, 0.15), model(k)->start(0.4, 0.5)});
    }
  }

  // A local minimum from the first start that leads to one; the search over boxes finds
  // any better one.
  void local_search(std::size_t k, const std::vector<std::vector<double>>& starts,
                    const optimise::Options& options = {.insist = false}) {
    auto& c = all_[k];
    for (const auto& start : starts) {
      const auto s = optimise::local_minimum(model(k)->problem(), start, options);
      if (s.status == optimise::Status::no_feasible_point_met) continue;
      c.local = s;
      if (s.f < best_.f) best_ = {s.f, k, s.y};
      return;
    }
  }

  // Settles the remaining recipes by boxes; it may find better points.
  void certify() {
    std::vector<optimise::Piece> pieces;
    bound_ = kInfinity;
    for (std::size_t k = 0; k < all_.size(); ++k) {
      auto& c = all_[k];
      if (c.bound >= cut()) {
        bound_ = std::min(bound_, c.bound);
        continue;
      }
      pieces.push_back(with_points(k, with_multipliers(k)));
    }
    if (!pieces.empty()) {
      const auto r = optimise::branch_and_bound(pieces, best_.f,
                                                {.gap = gap_, .max_nodes = task_.boxes});
      bound_ = std::min(bound_, r.lower_bound);
      nodes_ += r.nodes;
      if (!r.complete)
        unfinished_ =
            say("the budget of {} boxes ended before every box was settled", r.nodes);
    }
  }

  // With the Lagrangian of a local minimum, or with the refutation of one.
  optimise::Piece with_multipliers(std::size_t k) {
    auto& c = all_[k];
    const auto& m = model(k);
    if (c.local) return m->piece(1, *c.local);
    const auto nearest = least_violation(*m);
    if (nearest.f > 0) return m->piece(0, nearest);
    local_search(k, {nearest.y}, {.insist = true});
    return c.local ? m->piece(1, *c.local) : m->piece();
  }

  static optimise::Values values_at(const optimise::Problem& p,
                                    const std::vector<double>& y) {
    optimise::Values v{0, std::vector<double>(y.size()),
                       std::vector<double>(p.constraints),
                       std::vector<double>(p.constraints * y.size())};
    p.evaluate(y, v);
    return v;
  }

  bool violated() {
    const auto& m = *model(best_.candidate);
    const auto choice = m.choice(best_.y);
    const bool chatter = !chatter_ && chatters(task_, m, choice);
    chatter_ = chatter_ || chatter;
    return exchange_.add_violated(m.recipe(), task_.economy, choice) || chatter;
  }

  optimise::Solution polished() {
    const auto& problem = model(best_.candidate)->problem();
    auto s = optimise::local_minimum(problem, best_.y);
    if (s.status == optimise::Status::no_feasible_point_met || s.f > best_.f) {
      s.y = best_.y;  // the search's own point, feasible by its test
      s.f = best_.f;
      s.multipliers = optimise::multipliers_at(problem, s.y, values_at(problem, s.y));
    }
    best_.y = s.y;
    best_.f = s.f;
    return s;
  }

  Certificate certificate() const {
    Certificate c;
    c.kind = unfinished_.empty() ? CertificateKind::global : CertificateKind::local;
    c.reason = unfinished_;
    c.nodes = nodes_;
    c.engine = "branch-and-bound";
    return c;
  }

  SurfaceAnswer answer(optimise::Solution s) {
    SurfaceAnswer a;
    a.feasible = true;
    a.model = model(best_.candidate);
    a.choice = a.model->choice(best_.y);
    a.objective = std::exp(best_.f);
    a.multipliers = std::move(s.multipliers);
    a.certificate = certificate();
    set_bound(a, std::exp(bound_));
    if (a.certificate.gap <= kCertified) {  // whatever was left open is as good
      a.certificate.kind = CertificateKind::global;
      a.certificate.reason.clear();
    }
    if (!chatter_ && exchange_.functionals().empty() && a.certificate.gap <= kCertified)
      task_.unasked->best = std::make_shared<SurfaceAnswer>(a);
    return with_profile(task_, std::move(a));
  }

  SurfaceAnswer none() {
    SurfaceAnswer a;
    if (most_ == kInfinity) a = nearest(task_);
    a.lower_bound = std::exp(bound_);
    a.certificate = certificate();
    a.certificate.kind = CertificateKind::none;
    if (unfinished_.empty()) a.certificate.reason = tr(kNone);
    return a;
  }

  static constexpr long kFirstBoxes = 120;  // of one recipe, before a local solve
  const SurfaceTask& task_;
  double gap_, most_;
  TolerancePoints exchange_;
  bool chatter_ = false;  // asked
  std::vector<Candidate> all_;
  Best best_;
  double bound_ = kInfinity;
  long nodes_ = 0;
  std::string unfinished_;
};

// What a cut tolerance limits of an error.
double value_mm(const CutTolerance& d, const tolerance::PiecewisePolynomial& e) {
  using enum CutTolerance::Shape;
  if (d.shape == straightness) return tolerance::minimum_zone(e).width_mm;
  const auto x = tolerance::extremes(e);
  if (d.shape == size) return d.factor * std::max(x.max_mm, -x.min_mm);
  return d.factor * (x.max_mm - x.min_mm) / (d.shape == centred ? 2 : 1);
}

bool is_size(const CutTolerance& d) {
  return d.shape == CutTolerance::Shape::size || d.shape == CutTolerance::Shape::centred;
}

// Largest share of a size's room that the corrected path's remaining error takes.
double used_on_corrected_path(const SurfaceTask& task, const SurfaceAnswer& a) {
  if (task.offset != Offset::path || std::ranges::none_of(task.cut_tolerances, is_size))
    return 0;
  const auto& recipe = a.model->recipe();
  const auto x = tolerance::extremes(task.feature.corrected_profile(
      recipe, task.economy, a.choice,
      task.feature.corrections(recipe, task.economy, a.choice)));
  double used = 0;
  for (const auto& d : task.cut_tolerances)
    if (is_size(d))
      used = std::max(used, d.factor * std::max(x.max_mm, -x.min_mm) / d.remainder);
  return used;
}

// An answer whose corrected path keeps the sizes.  Its remaining error is a share of the
// error that is corrected: until it is small enough, that error is limited further.
template <class Solve>
SurfaceAnswer kept_on_corrected_path(const SurfaceTask& task, Solve solve) {
  constexpr int kTimes = 10;
  constexpr double kSpared = 0.998;
  auto a = solve(task);
  const double bound = a.lower_bound;
  SurfaceTask tightened = task;
  for (int time = 0; a.feasible; ++time) {
    const double used = used_on_corrected_path(task, a);
    if (!(used > 1)) break;
    const auto e = task.feature.profile(a.model->recipe(), task.economy, a.choice);
    for (auto& d : tightened.cut_tolerances)
      if (is_size(d)) {
        d.upper = value_mm(d, e) * kSpared / used;
        d.lower = -d.upper;
      }
    a = time < kTimes ? solve(tightened) : SurfaceAnswer{};
    set_bound(a, bound);
    if (a.feasible && a.certificate.gap > kCertified) {
      a.certificate.kind = CertificateKind::local;
      a.certificate.reason =
          tr("the sizes were tightened until the corrected path keeps them");
    }
  }
  return a;
}

// Conditions that keep every limit of a recipe; with `spare` those nearby have to keep
// them too.
std::optional<std::vector<double>> kept_conditions(const RecipeModel& m, bool spare) {
  if (!spare)
    for (const auto& start : starts(m)) {
      auto choice = m.choice(start);
      if (m.feasible_value(choice) < kInfinity) return m.point(choice);
    }
  for (const auto& start : starts(m)) {
    auto s = optimise::least_violation(m.problem(), start, -1.0);
    if (s.f <= kKept) return std::move(s.y);
  }
  return {};
}

// Conditions that keep every limit but those of the corrected path.
SurfaceAnswer any_kept(const SurfaceTask& task) {
  SurfaceAnswer a;
  if (used_up(task.cut_tolerances)) return a;
  TolerancePoints exchange(task.feature, task.cut_tolerances);
  for (const auto& recipe : task.recipes)
    for (int round = 0; round < kRounds; ++round) {
      auto chain = task.feature.chain(recipe, task.economy, exchange.stations());
      if (!chain) break;
      chain->functionals = exchange.functionals();
      task.feature.limit_chatter(*chain);
      a.model = std::make_shared<RecipeModel>(recipe, std::move(*chain));
      const auto y = kept_conditions(*a.model, round > 0);
      if (!y) break;
      a.choice = a.model->choice(*y);
      a.feasible = !exchange.add_violated(recipe, task.economy, a.choice);
      if (a.feasible) return a;
    }
  return a;
}

// The optimum without those.
SurfaceAnswer best_answer(const SurfaceTask& task, double gap, double most) {
  if (used_up(task.cut_tolerances)) {
    SurfaceAnswer none;
    none.lower_bound = kInfinity;
    return none;
  }
  if (const auto& known = task.unasked->best) {
    if (known->objective >= most) return not_below(*known);
    if (keeps_demands(task, *known)) return with_profile(task, *known);
  }
  return FeatureSearch(task, gap, most).run();
}

}  // namespace

double least_objective(const SurfaceTask& task) {
  if (task.unasked->least) return *task.unasked->least;
  std::vector<std::shared_ptr<RecipeModel>> models;
  std::vector<optimise::Piece> pieces;
  for (const auto& recipe : task.recipes)
    if (auto m = without_tolerances(task, recipe)) {
      pieces.push_back(m->piece());
      pieces.back().try_point = [m = m.get()](const optimise::Box& b) {
        auto c = middle(b);
        return m->feasible_value(c);
      };
      models.push_back(std::move(m));
    }
  const optimise::SearchOptions brief{.gap = kScoutingGap, .max_nodes = kScouting};
  const double bound =
      std::exp(optimise::branch_and_bound(pieces, kInfinity, brief).lower_bound);
  task.unasked->least = bound;
  return bound;
}

double worst_excess(const std::vector<CutTolerance>& cut_tolerances,
                    const tolerance::PiecewisePolynomial& e) {
  double worst = -1;
  for (const auto& d : cut_tolerances)
    if (d.shape != CutTolerance::Shape::none)
      worst = std::max(worst, value_mm(d, e) / std::max(d.upper, 1e-12) - 1);
  return worst;
}

SurfaceAnswer nearest(const SurfaceTask& task) {
  if (used_up(task.cut_tolerances)) return {};
  TolerancePoints exchange(task.feature, task.cut_tolerances);
  exchange.add_all();
  SurfaceAnswer a;
  const auto n = task.recipes.size();
  const std::size_t stride = task.explain ? 1 : (n + kNearest - 1) / kNearest;
  std::vector<std::size_t> asked;
  for (std::size_t k = 0; k < n; k += std::max<std::size_t>(stride, 1))
    asked.push_back(k);
  for (int round = 0; round < kNearestRounds; ++round) {
    a.least_violation = kInfinity;
    for (const std::size_t k : std::exchange(asked, {})) {
      auto chain = task.feature.chain(task.recipes[k], task.economy, exchange.stations());
      if (!chain) continue;
      chain->functionals = exchange.functionals();
      task.feature.limit_chatter(*chain);
      auto m = std::make_shared<RecipeModel>(task.recipes[k], std::move(*chain));
      const auto s = least_violation(*m);
      if (!(s.f < a.least_violation)) continue;
      a.least_violation = s.f;
      a.choice = m->choice(s.y);
      a.multipliers = s.multipliers;
      a.model = std::move(m);
      asked.assign(1, k);
      if (s.f <= 0 && keeps_demands(task, a)) return with_profile(task, std::move(a));
    }
    if (!a.model || !exchange.add_violated(a.model->recipe(), task.economy, a.choice))
      break;
  }
  return a.model ? with_profile(task, std::move(a)) : a;
}

SurfaceAnswer any_answer(const SurfaceTask& task) {
  return kept_on_corrected_path(task, any_kept);
}

SurfaceAnswer optimise_surface(const SurfaceTask& task, double gap, double most) {
  return kept_on_corrected_path(
      task, [&](const SurfaceTask& t) { return best_answer(t, gap, most); });
}

}  // namespace turnwright::planning
