#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "outcome.hpp"

namespace turnwright::planning {
namespace {

using catalogue::Tool;
using catalogue::ToolUse;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kGap = 9e-5;        // what engine 2 may leave open, in ln(objective)
constexpr double kCertified = 1e-4;  // what a global certificate may leave open
constexpr int kMostPasses = 40;
constexpr double kBeyondRounding = 1e-6;

bool fits(const Tool& t, ToolUse use, catalogue::IsoGroup group) {
  return std::find(t.uses.begin(), t.uses.end(), use) != t.uses.end() &&
         std::find(t.groups.begin(), t.groups.end(), group) != t.groups.end();
}

std::vector<const Tool*> tools_for(const PartPlan& p, ToolUse use) {
  std::vector<const Tool*> all;
  for (const auto& t : p.tools)
    if (fits(t, use, p.material.group)) all.push_back(&t);
  return all;
}

// What the request says about one surface: which operations, which tools.
struct Wanted {
  bool rough = true, finish = true;  // allowed
  bool given = false;                // by `operations`
  const Tool *rough_tool = nullptr, *finish_tool = nullptr;
  Fixed fixed;
  std::vector<std::string> ids;
};

const Tool* tool_named(const PartPlan& p, const std::optional<std::string>& id) {
  if (!id) return nullptr;
  for (const auto& t : p.tools)
    if (t.id == *id) return &t;
  return nullptr;
}

Wanted wanted(const PartPlan& p, std::size_t setup, const std::string& surface) {
  Wanted w;
  if (!p.operations) return w;
  w.given = true;
  w.rough = w.finish = false;
  for (const auto& o : *p.operations) {
    if (o.setup != setup || std::find(o.on.begin(), o.on.end(), surface) == o.on.end())
      continue;
    const bool rough = o.kind == OperationKind::rough;
    (rough ? w.rough : w.finish) = true;
    (rough ? w.rough_tool : w.finish_tool) = tool_named(p, o.tool);
    (rough ? w.fixed.rough : w.fixed.finish) = o.conditions;
    (rough ? w.fixed.rough_direction : w.fixed.finish_direction) = o.direction;
    const std::string id = o.on.size() > 1 ? o.id + ":" + surface : o.id;
    w.ids.insert(rough ? w.ids.begin() : w.ids.end(), id);
  }
  return w;
}

// Pass counts worth asking: as given, or all that the depths of the tools allow.
std::pair<int, int> pass_counts(const Conditions& c, double stock, double least,
                                double most) {
  if (c.passes) return {*c.passes, *c.passes};
  if (!(stock > 0)) return {1, 1};
  const int low = std::max(1, static_cast<int>(std::ceil(stock / most - 1e-9)));
  const int high = std::max(low, static_cast<int>(std::floor(stock / least + 1e-9)));
  return {low, std::min(high, low + kMostPasses)};
}

double least_depth(const Tool& t) { return std::max(t.ap_mm.lower, 2.0 / 3.0 * t.re_mm); }

std::vector<Recipe> recipes(const PartPlan& p, const Feature& f, const Wanted& w,
                            const Tool* rough, const Tool* finish) {
  const auto ranges = cutting::speed_ranges(p.machine).size();
  std::vector<Recipe> all;
  if (w.given && ((w.rough && !rough) || (w.finish && !finish))) return all;
  const auto add = [&](Recipe r) {
    for (std::size_t i = 0; i < (r.rough ? ranges : 1); ++i)
      for (std::size_t j = 0; j < (r.finish ? ranges : 1); ++j) {
        r.rough_range = i;
        r.finish_range = j;
        all.push_back(r);
      }
  };
  const double stock =
      f.kind() == Feature::Kind::shoulder && finish ? least_depth(*finish) : f.stock_mm();
  if (finish && (!w.given || !w.rough)) {  // without roughing
    const auto [low, high] =
        pass_counts(w.fixed.finish, stock, least_depth(*finish), finish->ap_mm.upper);
    // `auto` finishes in one pass; a face may take several.
    const int most =
        w.given || f.kind() != Feature::Kind::element ? high : std::min(high, 1);
    for (int n = low; n <= most; ++n) add({nullptr, finish, 0, n, 0, 0});
  }
  if (rough && finish) {
    const int nf = w.fixed.finish.passes.value_or(1);
    const auto [low, high] = pass_counts(w.fixed.rough, stock - nf * least_depth(*finish),
                                         least_depth(*rough), rough->ap_mm.upper);
    // A deeper finishing cut may save a roughing pass.
    const int first = w.fixed.rough.passes ? low : std::max(1, low - 1);
    for (int n = first; n <= high; ++n) add({rough, finish, n, nf, 0, 0});
  }
  if (rough && !finish && w.given) {
    const auto [low, high] =
        pass_counts(w.fixed.rough, stock, least_depth(*rough), rough->ap_mm.upper);
    for (int n = low; n <= high; ++n) add({rough, nullptr, n, 0, 0, 0});
  }
  return all;
}

struct Tools {
  const Tool *face = nullptr, *rough = nullptr, *finish = nullptr;
  bool operator<(const Tools& o) const {
    return std::tie(face, rough, finish) < std::tie(o.face, o.rough, o.finish);
  }
};

// One surface to be made in a setup and what the request says of it.
struct Job {
  Feature feature;
  Wanted wanted;
};

// A job with its tools: what the best recipe cannot beat, and its answer once asked for.
struct Entry {
  double bound = 0;
  double most = 0;           // what the answer had to beat
  bool compensated = false;  // asked for with compensation too
  std::optional<SolvedFeature> solved;
};
// End faces are cut in the chuck alone: their entries hold for every clamping of a setup.
using FaceMemory = std::map<const Tool*, Entry>;

// Solves the features of one setup in one clamping, remembering what depends only on part
// of the tools.
class SetupPlanner {
 public:
  SetupPlanner(const PartPlan& p, std::size_t setup, Clamping clamping,
               const SetupWork& work, const std::vector<bool>& done, Economy economy,
               FaceMemory& faces)
      : p_(p), setup_(setup), clamping_(clamping), economy_(economy), faces_(faces) {
    const auto& e = p.drawing.outer;
    if (work.end_face) {
      const auto w =
          wanted(p, setup, p.setups[setup].hold == part::End::left ? "right" : "left");
      if (w.finish) jobs_.push_back({Feature::end_face(p, setup, done, w.fixed), w});
    }
    for (const std::size_t i : work.elements) {
      const auto w = wanted(p, setup, e[i].id);
      auto f = Feature::element(p, setup, clamping, work, done, i, w.fixed);
      if ((w.rough || w.finish) && f.stock_mm() > 1e-9)
        jobs_.push_back({std::move(f), w});
    }
    for (const std::size_t k : work.shoulders) {
      const auto w = wanted(p, setup, e[k - 1].id + "|" + e[k].id);
      if (w.finish)
        jobs_.push_back(
            {Feature::shoulder(p, setup, clamping, work, done, k, w.fixed), w});
    }
    memory_.resize(jobs_.size());
  }

  void allow_compensation() { compensate_ = true; }

  // Tools that look cheapest first; what cannot cost less than `most` is dropped as soon
  // as that is known.
  SolvedSetup best(double most) {
    std::vector<std::pair<double, Tools>> all;
    for (const auto& tools : choices()) {
      double bound = least_besides_cutting(tools);
      for (std::size_t j = 0; j < jobs_.size(); ++j) bound += entry(j, tools).bound;
      all.emplace_back(bound, tools);
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    SolvedSetup best{setup_, clamping_, {}, 0, 0, kInfinity};
    bool any = false;
    double bound = kInfinity;
    for (const auto& [least, tools] : all) {
      if (least >= most && any) {
        bound = std::min(bound, least);
        continue;
      }
      auto s = solve(tools, least, most);
      bound = std::min(bound, s.lower_bound);
      const bool better =
          s.feasible() != best.feasible() ? s.feasible() : s.objective < best.objective;
      if (!any || better) {
        best = std::move(s);
        nearest_ = tools;
      }
      any = true;
      if (best.feasible()) most = std::min(most, best.objective);
    }
    best.lower_bound = bound;
    return best;
  }

  // Every feature with the tools of the best setup, which is not feasible.
  SolvedSetup explained() {
    explain_ = true;
    return solve(nearest_, 0, kInfinity);
  }

 private:
  // Every combination of one facing, one roughing (or none) and one finishing tool.
  std::vector<Tools> choices() const {
    bool faces = false, elements = false;
    for (const auto& j : jobs_)
      (j.feature.kind() == Feature::Kind::element ? elements : faces) = true;
    auto face =
        faces ? tools_for(p_, ToolUse::facing) : std::vector<const Tool*>{nullptr};
    if (face.empty()) face = {nullptr};
    auto rough = tools_for(p_, ToolUse::roughing);
    rough.push_back(nullptr);
    auto finish = tools_for(p_, ToolUse::finishing);
    if (finish.empty() || p_.operations) finish.push_back(nullptr);
    if (!elements) {
      rough = {nullptr};
      finish = {nullptr};
    }
    std::vector<Tools> all;
    for (const auto* x : face)
      for (const auto* r : rough)
        for (const auto* f : finish) all.push_back({x, r, f});
    return all;
  }

  // The tools of a job: roughing and finishing (or facing).
  std::pair<const Tool*, const Tool*> tools_of(std::size_t j, const Tools& tools) const {
    const auto& w = jobs_[j].wanted;
    if (jobs_[j].feature.kind() != Feature::Kind::element)
      return {nullptr, w.finish_tool ? w.finish_tool : tools.face};
    const Tool* rough = w.rough_tool ? w.rough_tool : tools.rough;
    const Tool* finish = w.finish_tool ? w.finish_tool : tools.finish;
    return {w.rough ? rough : nullptr, w.finish ? finish : nullptr};
  }

  FeatureTask task(std::size_t j, const Tools& tools, Offset offset) const {
    const auto& f = jobs_[j].feature;
    const auto [rough, finish] = tools_of(j, tools);
    return {f, demands(p_, f.surface(), offset),
            recipes(p_, f, jobs_[j].wanted, rough, finish), economy_, explain_};
  }

  Entry& entry(std::size_t j, const Tools& tools) {
    const auto key = tools_of(j, tools);
    auto& memory = memory_[j];
    if (jobs_[j].feature.kind() == Feature::Kind::end_face) {
      const auto [it, fresh] = faces_.try_emplace(key.second);
      if (fresh) it->second.bound = least_objective(task(j, tools, Offset::none));
      return it->second;
    }
    const auto [it, fresh] = memory.try_emplace(key);
    if (fresh) it->second.bound = least_objective(task(j, tools, Offset::none));
    return it->second;
  }

  const SolvedFeature& solved(std::size_t j, const Tools& tools, double most) {
    auto& e = entry(j, tools);
    const auto settled = [&] {
      return e.solved && (e.solved->answer.feasible || most <= e.most);
    };
    const auto attempt = [&](Offset offset) {
      auto t = task(j, tools, offset);
      auto answer = optimise_feature(t, kGap, most);
      return SolvedFeature{std::move(t), std::move(answer), offset == Offset::free,
                           jobs_[j].wanted.ids};
    };
    // What can be made without compensation at any cost is not compensated.
    if (compensate_) most = kInfinity;
    if (explain_ && !(e.solved && e.solved->answer.feasible)) {
      e.solved = attempt(compensate_ ? Offset::free : Offset::none);
      return *e.solved;
    }
    if (!settled()) {
      e.most = most;
      e.solved = attempt(Offset::none);
    }
    if (!compensate_ || e.solved->answer.feasible || e.compensated ||
        e.solved->task.demands.empty())
      return *e.solved;
    e.compensated = true;
    auto compensated = attempt(Offset::free);
    if (compensated.answer.feasible) e.solved = std::move(compensated);
    return *e.solved;
  }

  // `least` bounds the setup from below and rises as features are solved; each has what
  // the others leave of `most`.
  SolvedSetup solve(const Tools& tools, double least, double most) {
    SolvedSetup s{setup_, clamping_, {}, 0, 0, 0};
    s.lower_bound = least;
    for (std::size_t j = 0; j < jobs_.size(); ++j) {
      // One feature that cannot be made decides; the others are solved only to explain.
      if (!explain_ && !s.feasible()) break;
      const double alone = entry(j, tools).bound;
      const double left =
          std::isfinite(most) ? most - (s.lower_bound - alone) : kInfinity;
      const auto& f = solved(j, tools, std::max(left, alone));
      s.features.push_back(f);
      if (std::isfinite(alone)) s.lower_bound += f.answer.lower_bound - alone;
      if (f.answer.feasible) s.objective += f.answer.objective;
    }
    s.indexings = indexings(s);
    const double besides = economy_.minute * minutes_besides_cutting(s);
    s.objective += besides;
    if (s.feasible()) {
      s.lower_bound += besides - least_besides_cutting(tools);
    } else {
      s.objective = 0;
      for (const auto& f : s.features)
        if (!f.answer.feasible)
          s.objective =
              std::max(s.objective, f.answer.model ? f.answer.least_violation : 1e6);
    }
    return s;
  }

  // Where the request leaves it open, a roughing tool is brought in: plans that do not
  // use it are those of the choice without one.
  double least_besides_cutting(const Tools& tools) const {
    std::vector<const Tool*> first, rough, finish, last;
    for (std::size_t j = 0; j < jobs_.size(); ++j) {
      const auto [r, f] = tools_of(j, tools);
      const auto kind = jobs_[j].feature.kind();
      if (kind == Feature::Kind::end_face) first.push_back(f);
      if (kind == Feature::Kind::element) finish.push_back(f);
      if (kind == Feature::Kind::element && !p_.operations) rough.push_back(r);
      if (kind == Feature::Kind::shoulder) last.push_back(f);
    }
    SolvedSetup s{setup_, clamping_, {}, 0, 0, 0};
    s.indexings = changes({first, rough, finish, last});
    return economy_.minute * minutes_besides_cutting(s);
  }

  double minutes_besides_cutting(const SolvedSetup& s) const {
    const auto& m = p_.machine;
    double t = s.indexings * m.index_min + m.load_min + m.setup_min / p_.batch;
    if (clamping_ == Clamping::chuck_tailstock) t += m.tailstock_min;
    if (clamping_ == Clamping::between_centres) t += m.centres_min;
    return t;
  }

  // Tools brought in over a sequence of operations.
  static int changes(const std::vector<std::vector<const Tool*>>& groups) {
    int count = 0;
    const Tool* in = nullptr;
    for (const auto& group : groups)
      for (const Tool* t : group)
        if (t && t != in) {
          in = t;
          ++count;
        }
    return count;
  }

  static int indexings(const SolvedSetup& s) {
    // Faces first, then all roughing, all finishing, shoulders last.
    const auto group = [&](Feature::Kind kind, bool rough) {
      std::vector<const Tool*> tools;
      for (const auto& f : s.features) {
        if (f.task.feature.kind() != kind || !f.answer.feasible) continue;
        const auto& r = f.answer.model->recipe();
        tools.push_back(rough ? r.rough : r.finish);
      }
      return tools;
    };
    return changes(
        {group(Feature::Kind::end_face, false), group(Feature::Kind::element, true),
         group(Feature::Kind::element, false), group(Feature::Kind::shoulder, false)});
  }

  const PartPlan& p_;
  std::size_t setup_;
  Clamping clamping_;
  Economy economy_;
  bool compensate_ = false, explain_ = false;
  Tools nearest_;
  FaceMemory& faces_;
  std::vector<Job> jobs_;
  // Per job, by its tools.
  std::vector<std::map<std::pair<const Tool*, const Tool*>, Entry>> memory_;
};

// Why a clamping cannot be used on this machine at all, or nothing.
std::string unusable(const PartPlan& p, std::size_t setup, Clamping c) {
  const auto& m = p.machine;
  const auto& d = p.drawing.stock;
  if (c != Clamping::between_centres) {
    const double grip = grip_diameter_mm(p, setup, c);
    if (grip < m.chuck.diameter_mm.lower || grip > m.chuck.diameter_mm.upper)
      return fmt::format("the chuck holds {:g} to {:g} mm, not {:g} mm",
                         m.chuck.diameter_mm.lower, m.chuck.diameter_mm.upper, grip);
  }
  if (c != Clamping::chuck && d.length_mm > m.between_centres_mm)
    return fmt::format("the machine takes {:g} mm between centres, not {:g} mm",
                       m.between_centres_mm, d.length_mm);
  if (d.outer_mm > m.swing_mm)
    return fmt::format("the stock of {:g} mm does not swing in {:g} mm", d.outer_mm,
                       m.swing_mm);
  return {};
}

struct Comparison {
  SolvedSetup chosen;
  std::vector<RejectedClamping> rejected;
  bool solved = false;
};

// Why a clamping loses to the best one.
RejectedClamping rejection(const PartPlan& p, const SolvedSetup& s,
                           const SolvedSetup& best) {
  if (s.feasible())
    return {s.clamping,
            fmt::format("costs {:.4f} against {:.4f} for this setup", s.objective,
                        best.objective),
            s.objective};
  const auto f = std::find_if(s.features.begin(), s.features.end(),
                              [](const auto& x) { return !x.answer.feasible; });
  SolvedFeature shown = *f;
  if (!shown.answer.model) shown.answer = nearest(shown.task);
  if (!shown.answer.model || shown.answer.least_violation > kBeyondRounding)
    return {s.clamping, obstacle(p, shown), {}};
  return {s.clamping,
          fmt::format("cannot cost less than {:.4f} for this setup", best.objective),
          {}};
}

// The best of some clampings of one setup, each with its planner.
std::vector<SolvedSetup> best_of_each(std::vector<SetupPlanner>& planners) {
  std::vector<SolvedSetup> all;
  double most = kInfinity;
  for (auto& planner : planners) {
    all.push_back(planner.best(most));
    if (all.back().feasible()) most = std::min(most, all.back().objective);
  }
  return all;
}

// The stiffer clampings first: what a slender part could do in the chuck alone then has a
// cost to beat, which is quicker to refute than that it can be made at all.
// Compensation is proposed only where no clamping does without.
Comparison compare_clampings(const PartPlan& p, std::size_t setup, const SetupWork& work,
                             const std::vector<bool>& done, Economy economy) {
  Comparison result;
  FaceMemory faces;
  std::vector<SetupPlanner> planners;
  auto clampings = p.setups[setup].clampings;
  std::stable_partition(clampings.begin(), clampings.end(),
                        [](Clamping c) { return c != Clamping::chuck; });
  for (const Clamping c : clampings) {
    const auto why = unusable(p, setup, c);
    if (!why.empty())
      result.rejected.push_back({c, why, {}});
    else
      planners.emplace_back(p, setup, c, work, done, economy, faces);
  }
  if (planners.empty()) return result;
  auto all = best_of_each(planners);
  if (std::none_of(all.begin(), all.end(), [](const auto& s) { return s.feasible(); })) {
    for (auto& planner : planners) planner.allow_compensation();
    all = best_of_each(planners);
  }
  const auto best = std::min_element(
      all.begin(), all.end(), [](const SolvedSetup& a, const SolvedSetup& b) {
        return a.feasible() != b.feasible() ? a.feasible() : a.objective < b.objective;
      });
  double bound = kInfinity;
  for (const auto& s : all) {
    bound = std::min(bound, s.lower_bound);
    if (&s != &*best) result.rejected.push_back(rejection(p, s, *best));
  }
  result.chosen =
      best->feasible()
          ? *best
          : planners[static_cast<std::size_t>(best - all.begin())].explained();
  result.chosen.lower_bound = bound;
  result.solved = true;
  return result;
}

struct Totals {
  double minutes = 0, cost = 0;
};

Totals totals(const PartPlan& p, const SolvedSetup& s) {
  const auto& m = p.machine;
  Totals t;
  t.minutes = s.indexings * m.index_min + m.load_min + m.setup_min / p.batch;
  if (s.clamping == Clamping::chuck_tailstock) t.minutes += m.tailstock_min;
  if (s.clamping == Clamping::between_centres) t.minutes += m.centres_min;
  for (const auto& f : s.features) {
    if (!f.answer.feasible) continue;
    const auto u = spent(f.answer);
    t.minutes += u.minutes + u.change_min;
    t.cost += u.edges_cost;
  }
  t.cost += p.machine_per_min * t.minutes;
  return t;
}

Economy economy_of(const PartPlan& p, double profit_rate) {
  switch (p.objective) {
    case Objective::cost:
      return {p.machine_per_min, 1};
    case Objective::time:
      return {1, 0};
    case Objective::profit:
      return {p.machine_per_min + profit_rate, 1};
  }
  return {};
}

struct Attempt {
  std::vector<Comparison> setups;
  bool feasible = true;
  Totals total;
  double objective = 0, lower_bound = 0;
};

Attempt attempt(const PartPlan& p, const Assignment& work, Economy economy) {
  Attempt a;
  std::vector<bool> done(p.drawing.outer.size(), false);
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    a.setups.push_back(compare_clampings(p, s, work.setups[s], done, economy));
    const auto& c = a.setups.back();
    a.feasible = a.feasible && c.solved && c.chosen.feasible();
    for (const std::size_t i : work.setups[s].elements) done[i] = true;
    if (!c.solved) a.lower_bound = kInfinity;
    if (!c.solved) continue;
    const auto t = totals(p, c.chosen);
    a.total.minutes += t.minutes;
    a.total.cost += t.cost;
    a.objective += c.chosen.objective;
    a.lower_bound += c.chosen.lower_bound;
  }
  return a;
}

// Dinkelbach: the profit rate R is best when min C + R t equals the price; each step
// takes the R of the plan before, which never falls.
Attempt best_attempt(const PartPlan& p, const Assignment& work, double& rate) {
  rate = 0;
  auto a = attempt(p, work, economy_of(p, rate));
  if (!a.feasible || p.objective != Objective::profit) return a;
  for (int step = 0; step < 20; ++step) {
    const double next = (*p.price - a.total.cost) / a.total.minutes;
    if (std::abs(next - rate) <= 1e-9 * (1 + std::abs(next))) break;
    if (!(p.machine_per_min + next > 0)) break;  // a loss at any speed: cost decides
    rate = next;
    a = attempt(p, work, economy_of(p, rate));
  }
  return a;
}

Certificate total_certificate(const Attempt& a) {
  Certificate c;
  c.kind = CertificateKind::global;
  std::set<std::string> engines;
  for (const auto& s : a.setups)
    for (const auto& f : s.chosen.features) {
      const auto& k = f.answer.certificate;
      c.nodes += k.nodes;
      engines.insert(k.engine);
      if (k.kind != CertificateKind::global) {
        c.kind = k.kind;
        c.reason = f.task.feature.surface() + ": " + k.reason;
      }
    }
  for (const auto& e : engines) c.engine += (c.engine.empty() ? "" : " and ") + e;
  c.lower_bound = std::min(a.lower_bound, a.objective);
  c.gap = a.objective > 0 ? 1 - c.lower_bound / a.objective : 0;
  if (c.kind == CertificateKind::global && c.gap > kCertified) {
    c.kind = CertificateKind::local;
    c.reason =
        "with other tools or another clamping the budget of boxes ended before "
        "every box was settled";
  }
  return c;
}

Certificate no_certificate(const Attempt& a) {
  Certificate c;
  c.reason =
      a.lower_bound < kInfinity
          ? "no plan was found, but the budget of boxes ended before every box was "
            "settled"
          : "proved: no plan keeps every limit";
  for (const auto& s : a.setups)
    for (const auto& f : s.chosen.features) c.nodes += f.answer.certificate.nodes;
  return c;
}

}  // namespace

bool SolvedSetup::feasible() const {
  return std::all_of(features.begin(), features.end(),
                     [](const SolvedFeature& f) { return f.answer.feasible; });
}

ProcessPlan plan(const PartPlan& p) {
  ProcessPlan result;
  const auto work = assign(p);
  for (const auto& sentence : work.unreachable)
    result.conflicts.push_back({"setups", "all setups", 0, 0, "", sentence});

  double rate = 0;
  const auto a = best_attempt(p, work, rate);
  std::vector<SolvedSetup> chosen;
  for (const auto& c : a.setups) {
    SetupPlan s;
    const std::size_t index = static_cast<std::size_t>(&c - a.setups.data());
    s.hold = p.setups[index].hold;
    s.rejected = c.rejected;
    if (!c.solved) {
      for (const auto& r : c.rejected)
        result.conflicts.push_back({"clamping", fmt::format("setup {}", index), 0, 0, "",
                                    std::string(name(r.clamping)) + ": " + r.why});
      result.setups.push_back(std::move(s));
      continue;
    }
    s.clamping = c.chosen.clamping;
    for (const auto& f : c.chosen.features) {
      if (!f.answer.feasible) explain(p, c.chosen, f, result);
      if (!f.answer.model) continue;
      for (auto& o : describe(p, index, f, {p.machine_per_min}))
        s.operations.push_back(std::move(o));
    }
    result.setups.push_back(std::move(s));
    chosen.push_back(c.chosen);
  }
  const bool ok = a.feasible && work.unreachable.empty();
  if (ok) result.tolerances = tolerance_results(p, chosen);
  for (const auto& t : result.tolerances)
    if (t.verdict == Verdict::not_met) {
      result.status = PlanStatus::infeasible;
      result.conflicts.push_back(
          {t.id + " " + part::name(t.kind), t.of, t.predicted_mm.back(),
           t.allowed_mm.back(), "mm",
           fmt::format(
               "{} {} of {}: the machine and chucking alone take {:.4g} mm of {:.4g} mm",
               t.id, part::name(t.kind), t.of, t.predicted_mm.back(),
               t.allowed_mm.back())});
    }
  if (!ok) result.status = PlanStatus::infeasible;
  if (result.status == PlanStatus::infeasible) result.certificate = no_certificate(a);
  if (result.status == PlanStatus::ok) {
    result.cost_per_part = a.total.cost;
    result.time_per_part_min = a.total.minutes;
    if (p.price) result.profit_per_min = (*p.price - a.total.cost) / a.total.minutes;
    result.certificate = total_certificate(a);
    result.compensation = compensations(chosen);
    result.prices = prices(p, chosen);
  }
  return result;
}

}  // namespace turnwright::planning
