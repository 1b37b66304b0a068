#include "global_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <tuple>

#include "planning/auxiliary/catalogue_operations.hpp"
#include "surface_search.hpp"

namespace turnwright::reference {
namespace {

using catalogue::Tool;
using catalogue::ToolUse;
using planning::Clamping;
using planning::CutTolerance;
using planning::MachinedSurface;
using planning::Offset;
using planning::PreparedPart;
using planning::Recipe;

constexpr double kFeasible = 0x1p-36;  // of a limit: rounding
constexpr int kFinePlaces = 1601;      // parabolas through them are exact to 1e-10

std::vector<const Tool*> tools_for(const PreparedPart& p, ToolUse use) {
  std::vector<const Tool*> all;
  for (const auto& t : p.tools)
    if (std::count(t.uses.begin(), t.uses.end(), use) > 0 &&
        std::count(t.groups.begin(), t.groups.end(), p.material.group) > 0)
      all.push_back(&t);
  return all;
}

// As many passes as the least depth allows; SurfaceSearch refuses what is too deep.
int most_passes(double stock, const Tool& t) {
  const double least = std::max(t.ap_mm.lower, 2.0 / 3.0 * t.re_mm);
  return std::max(1, static_cast<int>(stock / least + 1e-9));
}

std::vector<Recipe> recipes(const PreparedPart& p, const MachinedSurface& f,
                            const Tool* rough, const Tool* finish) {
  std::vector<Recipe> all;
  const auto ranges = cutting::speed_ranges(p.machine).size();
  const auto add = [&](const Tool* r, int nr, int nf) {
    for (std::size_t i = 0; i < (r ? ranges : 1); ++i)
      for (std::size_t j = 0; j < ranges; ++j) all.push_back({r, finish, nr, nf, i, j});
  };
  // At most two finishing passes make an element or a bore; a face may take more.
  const int finishing = f.is_face() ? most_passes(f.stock_mm(), *finish) : 2;
  for (int n = 1; n <= finishing; ++n) add(nullptr, 0, n);
  if (rough)
    for (int nf = 1; nf <= finishing; ++nf)
      for (int n = 1; n <= most_passes(f.stock_mm(), *rough); ++n) add(rough, n, nf);
  return all;
}

// The surfaces of one setup in one clamping: what each costs with each pair of tools.
class SetupSearch {
 public:
  SetupSearch(const PreparedPart& p, std::size_t setup, Clamping clamping,
              const planning::SetupWork& work, const planning::Finished& done,
              const planning::Economy& economy, const Effort& effort)
      : p_(p),
        setup_(setup),
        clamping_(clamping),
        economy_(economy),
        effort_(effort),
        fixed_(planning::auxiliary_work(p, setup, clamping, work, economy)),
        front_mm_(planning::front_mm(p, setup, work)) {
    if (work.end_face) features_.push_back(MachinedSurface::end_face(p, setup, done, {}));
    for (const std::size_t i : work.elements) {
      auto f = MachinedSurface::element(p, setup, clamping, work, done, i, {});
      if (f.stock_mm() > 1e-9) features_.push_back(std::move(f));
    }
    for (const std::size_t k : work.shoulders)
      features_.push_back(
          MachinedSurface::shoulder(p, setup, clamping, work, done, k, {}));
    for (const std::size_t i : work.bores) {
      auto f = MachinedSurface::bore(p, setup, clamping, work, done, i, {});
      if (f.stock_mm() > 1e-9) features_.push_back(std::move(f));
    }
  }

  /// With `Offset::path` the path of the tool may follow the error of a surface that the
  /// tools tried cannot make otherwise.
  SetupFound best(Offset offset) {
    SetupFound best{clamping_, {}, 0, kInfinity};
    if (!fixed_.conflicts.empty()) return best;  // a place cannot be milled, or drilled
    for (const auto& c : choices()) {
      if (c.bound >= best.objective) break;
      SetupFound s{clamping_, {}, 0, c.bound};
      for (std::size_t k = 0; k < features_.size() && s.objective < best.objective; ++k) {
        const auto t = tools(k, c);
        s.surfaces.push_back(solved(k, t, offset));
        s.objective += s.surfaces.back().objective - bounds(k, t).least;
      }
      if (s.surfaces.size() < features_.size() || !std::isfinite(s.objective)) continue;
      const auto lies = between(s);
      s.indexings = lies.indexings;
      s.objective += economy_.minute * (minutes(lies) - minutes({}));
      if (s.objective < best.objective) best = std::move(s);
    }
    return best;
  }

  /// Every surface with the tools and conditions a plan gives it.
  SetupFound as_planned(const planning::SetupPlan& plan,
                        const std::vector<planning::Compensation>& compensation) {
    SetupFound s{clamping_, {}, 0, 0};
    for (std::size_t k = 0; k < features_.size(); ++k) {
      const bool follows =
          std::any_of(compensation.begin(), compensation.end(),
                      [&](const auto& c) { return c.on == features_[k].surface(); });
      s.surfaces.push_back(
          as_planned(k, plan, follows ? Offset::path : planning::free_offset(p_)));
      s.objective += s.surfaces.back().objective;
    }
    const auto lies = between(s);
    s.indexings = lies.indexings;
    s.objective += economy_.minute * minutes(lies) + fixed_edges();
    return s;
  }

 private:
  using Tools = std::pair<const Tool*, const Tool*>;
  using Key = std::tuple<std::size_t, const Tool*, const Tool*, Offset>;
  struct ToolChoice {
    const Tool *face, *rough, *finish, *bore_rough, *bore_finish;
    double bound = 0;  // tolerances and tools brought in left out
  };
  struct Bounds {
    std::vector<std::pair<double, Recipe>>
        recipes;  // cheapest first, tolerances left out
    double least = kInfinity;
  };

  // One facing, one roughing (or none), one finishing tool and as many for bores,
  // cheapest first.
  std::vector<ToolChoice> choices() {
    const auto list = [&](bool wanted, ToolUse use, bool none_too) {
      auto t = wanted ? tools_for(p_, use) : std::vector<const Tool*>{};
      if (t.empty() || none_too) t.push_back(nullptr);
      return t;
    };
    const bool bores = std::any_of(features_.begin(), features_.end(), [](const auto& f) {
      return f.kind() == MachinedSurface::Kind::bore;
    });
    std::vector<ToolChoice> all;
    for (const auto* x : list(true, ToolUse::facing, false))
      for (const auto* r : list(true, ToolUse::roughing, true))
        for (const auto* f : list(true, ToolUse::finishing, false))
          for (const auto* br : list(bores, ToolUse::boring, true))
            for (const auto* bf : list(bores, ToolUse::boring, false)) {
              ToolChoice c{x,  r,  f,
                           br, bf, economy_.minute * minutes({}) + fixed_edges()};
              for (std::size_t k = 0; k < features_.size(); ++k)
                c.bound += bounds(k, tools(k, c)).least;
              if (std::isfinite(c.bound)) all.push_back(c);
            }
    std::sort(all.begin(), all.end(),
              [](const ToolChoice& a, const ToolChoice& b) { return a.bound < b.bound; });
    return all;
  }

  Tools tools(std::size_t k, const ToolChoice& c) const {
    if (features_[k].is_face()) return {nullptr, c.face};
    const bool bore = features_[k].kind() == MachinedSurface::Kind::bore;
    return bore ? Tools{c.bore_rough, c.bore_finish} : Tools{c.rough, c.finish};
  }

  const Bounds& bounds(std::size_t k, Tools t) {
    const auto [it, missing] = bounds_.try_emplace({k, t.first, t.second});
    auto& b = it->second;
    if (!missing || !t.second) return b;
    for (const auto& r : recipes(p_, features_[k], t.first, t.second)) {
      const SurfaceSearch s(features_[k], {}, r, economy_, effort_);
      if (!s.possible()) continue;
      const auto p = s.without_tolerances();
      if (p.excess <= kFeasible) b.recipes.emplace_back(p.cost, r);
    }
    std::sort(b.recipes.begin(), b.recipes.end(),
              [](const auto& x, const auto& y) { return x.first < y.first; });
    if (!b.recipes.empty()) b.least = b.recipes.front().first;
    return b;
  }

  const SurfaceFound& solved(std::size_t k, Tools t, Offset offset) {
    const auto without = planning::free_offset(p_);
    const auto [it, missing] = solved_.try_emplace({k, t.first, t.second, without});
    if (missing) it->second = cheapest(k, t, without);
    if (offset != Offset::path || std::isfinite(it->second.objective)) return it->second;
    const auto [path, first] = solved_.try_emplace({k, t.first, t.second, Offset::path});
    if (first) path->second = cheapest(k, t, Offset::path);
    return path->second;
  }

  SurfaceFound cheapest(std::size_t k, Tools t, Offset offset) {
    const auto cut_tolerances = planning::cut_tolerances(
        p_, features_[k].surface(), offset, {setup_, clamping_, t.second});
    SurfaceFound best;
    best.objective = kInfinity;
    if (planning::used_up(cut_tolerances)) return best;
    for (const auto& [bound, r] : bounds(k, t).recipes) {
      if (bound >= best.objective) break;
      const SurfaceSearch s(features_[k], cut_tolerances, r, economy_, effort_);
      const auto p = s.best();
      if (p.excess <= kFeasible && p.cost < best.objective) best = described(k, r, p, s);
    }
    return best;
  }

  SurfaceFound described(std::size_t k, const Recipe& r, const Point& p,
                         const SurfaceSearch& s) const {
    SurfaceFound x;
    x.surface = features_[k].surface();
    x.rough = r.rough ? r.rough->id : "";
    x.finish = r.finish->id;
    x.rough_passes = r.rough_passes;
    x.finish_passes = r.finish_passes;
    for (std::size_t i = 0; i < 2; ++i) {
      x.v_m_min[i] = p.choice.v[i];
      x.f_mm_rev[i] = p.choice.f[i];
    }
    x.a_mm = p.choice.a;
    x.objective = p.cost;
    x.excess = std::max(p.excess, s.tolerance_excess(p.choice, kFinePlaces));
    return x;
  }

  // In the speed ranges that suit the conditions best: a plan does not name them.
  SurfaceFound as_planned(std::size_t k, const planning::SetupPlan& plan, Offset offset) {
    const auto& f = features_[k];
    Recipe r;
    Point p;
    std::size_t i = 0;
    for (const auto& o : plan.operations) {
      if (o.on != std::vector{f.surface()} || o.kind == planning::OperationKind::fixed)
        continue;
      const auto tool = std::find_if(p_.tools.begin(), p_.tools.end(),
                                     [&](const Tool& t) { return t.id == o.tool; });
      const bool rough = o.kind == planning::OperationKind::rough ||
                         o.kind == planning::OperationKind::bore_rough;
      (rough ? r.rough : r.finish) = &*tool;
      (rough ? r.rough_passes : r.finish_passes) = static_cast<int>(o.passes.size());
      p.choice.v[i] = o.passes.front().vc_m_min;
      p.choice.f[i] = o.passes.front().f_mm_rev;
      p.choice.a = o.passes.front().ap_mm;
      ++i;
    }
    const auto cut_tolerances = planning::cut_tolerances(
        p_, f.surface(), offset, {setup_, clamping_, r.finish ? r.finish : r.rough});
    SurfaceFound best;
    best.objective = best.excess = kInfinity;
    const auto ranges = cutting::speed_ranges(p_.machine).size();
    for (r.rough_range = 0; r.rough_range < (r.rough ? ranges : 1); ++r.rough_range)
      for (r.finish_range = 0; r.finish && r.finish_range < ranges; ++r.finish_range) {
        const SurfaceSearch s(f, cut_tolerances, r, economy_, effort_);
        if (!s.possible()) continue;
        const auto x = described(k, r, s.at(p.choice), s);
        if (x.excess < best.excess) best = x;
      }
    return best;
  }

  double minutes(const planning::Between& lies) const {
    const auto& m = p_.machine;
    double t = lies.indexings * m.index_min + lies.rapid_mm / m.rapid_mm_min +
               lies.eased * m.jaws_min + m.load_min +
               (p_.batch ? m.setup_min / *p_.batch : 0);
    if (clamping_ == Clamping::chuck_tailstock) t += m.tailstock_min;
    if (clamping_ == Clamping::between_centres) t += m.centres_min;
    if (clamping_ == Clamping::chuck_steady) t += m.steady_min;
    if (clamping_ == Clamping::tailstock_follow) t += m.tailstock_min + m.follow_min;
    for (const auto& o : fixed_.all()) t += o.minutes();
    return t;
  }

  double fixed_edges() const {
    double cost = 0;
    for (const auto& o : fixed_.all()) cost += economy_.edge * o.edges_cost;
    return cost;
  }

  // The end face, centre hole and drilling, all roughing, all finishing, the shoulders,
  // the bores, the rest at fixed conditions; over all surfaces of a kind if over one.
  planning::Between between(const SetupFound& s) const {
    planning::Order order(p_, setup_, clamping_, front_mm_);
    for (const auto kind :
         {MachinedSurface::Kind::end_face, MachinedSurface::Kind::element,
          MachinedSurface::Kind::shoulder, MachinedSurface::Kind::bore}) {
      for (const bool rough : {true, false}) {
        const Tool* used = nullptr;
        for (std::size_t k = 0; k < features_.size(); ++k)
          for (const auto& t : p_.tools)
            if (features_[k].kind() == kind &&
                t.id == (rough ? s.surfaces[k].rough : s.surfaces[k].finish))
              used = &t;
        for (const auto& f : features_)
          if (used && f.kind() == kind) order.add(f.in_order(*used, rough));
      }
      if (kind == MachinedSurface::Kind::end_face)
        for (const auto& o : fixed_.before) order.add(o.order);
    }
    for (const auto& o : fixed_.after) order.add(o.order);
    return order.done();
  }

  const PreparedPart& p_;
  std::size_t setup_;
  Clamping clamping_;
  planning::Economy economy_;
  Effort effort_;
  planning::AuxiliaryWork fixed_;
  double front_mm_;
  std::vector<MachinedSurface> features_;
  std::map<std::tuple<std::size_t, const Tool*, const Tool*>, Bounds> bounds_;
  std::map<Key, SurfaceFound> solved_;
};

// What the chuck and the room between centres can hold.
bool usable(const PreparedPart& p, std::size_t setup, Clamping c,
            const planning::SetupWork& work) {
  const auto& m = p.machine;
  const bool centre = c == Clamping::chuck_tailstock || c == Clamping::between_centres;
  if (centre && !work.bores.empty()) return false;
  if (p.drawing.stock.outer_mm > m.swing_mm) return false;
  if (c != Clamping::chuck && p.drawing.stock.length_mm > m.between_centres_mm)
    return false;
  if (c == Clamping::between_centres) return true;
  const double d = planning::grip_diameter_mm(p, setup, c);
  return m.chuck.diameter_mm.lower <= d && d <= m.chuck.diameter_mm.upper;
}

planning::Economy economy_of(const PreparedPart& p) {
  if (p.operations || p.objective == planning::Objective::profit)
    throw std::invalid_argument("the search chooses all operations, for cost or time");
  const bool cost = p.objective == planning::Objective::cost;
  return {cost ? p.machine_per_min : 1.0, cost ? 1.0 : 0.0};
}

}  // namespace

Found search(const PreparedPart& p, const Effort& effort) {
  const auto economy = economy_of(p);
  const auto& work = p.work;
  Found found;
  auto done = planning::nothing_finished(p.drawing);
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    std::vector<SetupSearch> clampings;
    for (const Clamping c : p.setups[s].clampings)
      if (usable(p, s, c, work.setups[s]))
        clampings.emplace_back(p, s, c, work.setups[s], done, economy, effort);
    SetupFound best;
    best.objective = kInfinity;
    for (const auto offset : {planning::free_offset(p), Offset::path}) {
      if (std::isfinite(best.objective)) break;
      for (auto& clamping : clampings) {
        auto one = clamping.best(offset);
        if (one.objective < best.objective) best = std::move(one);
      }
    }
    planning::finish(done, work.setups[s]);
    found.objective += best.objective;
    found.setups.push_back(std::move(best));
  }
  if (!work.unreachable.empty()) found.objective = kInfinity;
  return found;
}

Found as_planned(const PreparedPart& p, const planning::ProcessPlan& plan) {
  const auto economy = economy_of(p);
  const auto& work = p.work;
  Found found;
  auto done = planning::nothing_finished(p.drawing);
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    auto compensation = plan.compensation;
    std::erase_if(compensation, [&](const auto& c) { return c.setup != s; });
    SetupSearch setup(p, s, plan.setups[s].clamping, work.setups[s], done, economy, {});
    found.setups.push_back(setup.as_planned(plan.setups[s], compensation));
    found.objective += found.setups.back().objective;
    planning::finish(done, work.setups[s]);
  }
  return found;
}

}  // namespace turnwright::reference
