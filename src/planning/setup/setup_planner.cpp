#include "setup_planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/say.hpp"
#include "operation_order.hpp"
#include "planning/auxiliary/catalogue_operations.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/values/surface_request.hpp"
#include "planning/values/tool_label.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/interval.hpp"

namespace turnwright::planning {
namespace {

using catalogue::Tool;
using catalogue::ToolUse;

// Every search has these, even when a setup in one clamping has used up the boxes it
// shares: refuting a far too slender part takes thousands for each pass count and tool.
constexpr long kLeastBoxes = 300;
// Gap at which branch and bound ends, in ln(objective).
constexpr double kGap = 9e-5;

RejectedTool rejection(const Tool& t, const char* use, bool cuts_material,
                       const Considered* least, const Considered& best) {
  if (!cuts_material) return {t.id, use, tr("its grades are not for this material"), {}};
  if (!least) return {t.id, use, tr("the turret has too few stations for it"), {}};
  if (!std::isfinite(least->at_least))
    return {t.id, use, tr("cannot make every surface within its limits"), {}};
  if (!least->solved && least->at_least < best.at_least)
    return {t.id, use,
            say("as good as the chosen: at most {:.4f} below {:.4f} for this setup",
                std::ceil(1e4 * (best.at_least - least->at_least)) / 1e4, best.at_least),
            least->at_least};
  return {t.id, use,
          least->solved ? say("comes to {:.4f} against {:.4f} for this setup",
                              least->at_least, best.at_least)
                        : say("cannot come below {:.4f} against {:.4f} for this setup",
                              least->at_least, best.at_least),
          least->at_least};
}

Conflict too_few_stations(const PreparedPart& p, std::size_t setup,
                          const std::set<std::string>& tools) {
  const auto& m = p.machine;
  return {kStations,
          setup_label(setup),
          static_cast<double>(tools.size()),
          static_cast<double>(m.stations),
          "",
          say("{} needs {} tools at least, {}; the turret of {} has {}. Another setup "
              "for some "
              "of them, a tool that serves two uses, one cutter for several milled "
              "places or a "
              "turret with more stations would do",
              setup_label(setup), tools.size(), fmt::join(tools, ", "), m.name,
              m.stations == 1 ? say("{} station", m.stations)
                              : say("{} stations", m.stations))};
}

}  // namespace

SetupPlanner::SetupPlanner(const PreparedPart& p, std::size_t setup, Clamping clamping,
                           const SetupWork& work, const Finished& before,
                           const Economy& economy, SharedMemory& shared)
    : p_(p),
      setup_(setup),
      clamping_(clamping),
      economy_(economy),
      auxiliary_(auxiliary_work(p, setup, clamping, work, economy)),
      front_mm_(front_mm(p, setup, work)),
      shared_(shared) {
  const auto& d = p.drawing;
  const auto add = [&](const std::string& surface, const auto& make) {
    auto w = surface_request(p, setup, surface);
    jobs_.push_back({make(w.fixed), w});
  };
  if (work.end_face)
    add(free_face(p, setup), [&](const GivenConditions& fixed) {
      return MachinedSurface::end_face(p, setup, before, fixed);
    });
  for (const std::size_t i : work.elements)
    add(d.outer[i].id, [&](const GivenConditions& fixed) {
      return MachinedSurface::element(p, setup, clamping, work, before, i, fixed);
    });
  for (const std::size_t k : work.shoulders)
    add(shoulder_id(d, k), [&](const GivenConditions& fixed) {
      return MachinedSurface::shoulder(p, setup, clamping, work, before, k, fixed);
    });
  for (const std::size_t i : work.bores)
    if (!part::is_hole(d.inner[i]))
      add(d.inner[i].id, [&](const GivenConditions& fixed) {
        return MachinedSurface::bore(p, setup, clamping, work, before, i, fixed);
      });
  for (const std::size_t i : work.inner_shoulders)
    add(part::shoulder_behind(d, i)->id, [&](const GivenConditions& fixed) {
      return MachinedSurface::inner_shoulder(p, setup, clamping, work, before, i, fixed);
    });
  memory_.resize(jobs_.size());
  fit_turret();
}

// The tools of a choice, each once.
std::set<const Tool*> SetupPlanner::used(const Tools& tools) const {
  std::set<const Tool*> all;
  for (std::size_t j = 0; j < jobs_.size(); ++j)
    for (const Tool* t : {tools_of(j, tools).first, tools_of(j, tools).second})
      if (t) all.insert(t);
  return all;
}

// Leaves the choices of tools for which the turret has stations; a conflict if there are
// none.  Milled places have each the cutter that is best there: choices that would fit if
// one did for all of them are not tried, but count in the lower bound.
void SetupPlanner::fit_turret() {
  const auto all = every_choice();
  std::set<std::string> others, cutters;
  for (const auto& o : auxiliary_.all()) {
    others.insert(tool_label(p_, o.plan));
    if (o.plan.milled) cutters.insert(o.plan.tool);
  }
  const auto stations = static_cast<std::size_t>(p_.machine.stations);
  const auto spared = std::max<std::size_t>(cutters.size(), 1) - 1;
  std::set<const Tool*> fewest;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto own = used(all[i]);
    if (i == 0 || own.size() < fewest.size()) fewest = own;
    const auto n = own.size() + others.size();
    if (n <= stations)
      choices_.push_back(all[i]);
    else if (n - spared <= stations)
      nearly_fitting_.push_back(all[i]);
  }
  left_out_ = choices_.size() < all.size();
  if (!choices_.empty()) return;
  for (const auto* tool : fewest) others.insert(tool->id);
  auxiliary_.conflicts.push_back(too_few_stations(p_, setup_, others));
}

std::vector<Conflict> SetupPlanner::conflicts() const {
  return conflicts_of(auxiliary_, setup_);
}

double SetupPlanner::least_objective_of(const Tools& tools) {
  double bound = least_besides_cutting(tools);
  for (std::size_t j = 0; j < jobs_.size(); ++j) bound += entry(j, tools).bound;
  return bound;
}

std::vector<const MachinedSurface*> SetupPlanner::features() const {
  std::vector<const MachinedSurface*> all;
  for (const auto& job : jobs_) all.push_back(&job.feature);
  return all;
}

SolvedSetup SetupPlanner::best(double most) {
  std::vector<std::pair<double, Tools>> all;
  for (const auto& tools : choices_) all.emplace_back(least_objective_of(tools), tools);
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  SolvedSetup best{setup_, clamping_, {}, {}, 0, kInfinity};
  bool any = false;
  double bound = kInfinity;
  std::size_t chosen = 0;
  std::vector<Considered> considered;
  for (const auto& [least, tools] : all) {
    if (least >= most && any) {
      bound = std::min(bound, least);
      considered.push_back({tools, least});
      continue;
    }
    auto s = solve(tools, least, most);
    bound = std::min(bound, s.lower_bound);
    considered.push_back(
        {tools, s.feasible() ? s.objective : s.lower_bound, s.feasible()});
    const bool better =
        s.feasible() != best.feasible() ? s.feasible() : s.objective < best.objective;
    if (!any || better) {
      best = std::move(s);
      nearest_ = tools;
      chosen = considered.size() - 1;
    }
    any = true;
    if (best.feasible()) most = std::min(most, best.objective);
  }
  for (const auto& tools : nearly_fitting_)
    bound = std::min(bound, least_objective_of(tools));
  best.lower_bound = bound;
  if (best.feasible()) best.rejected_tools = rejected(considered, considered[chosen]);
  return best;
}

// Every tool of the request in every use of this setup for which it was not chosen.
std::vector<RejectedTool> SetupPlanner::rejected(const std::vector<Considered>& all,
                                                 const Considered& best) const {
  struct Use {
    ToolUse use;
    const char* name;
    const Tool* Tools::*tool;
  };
  constexpr std::array kUses{
      Use{ToolUse::facing, to_translate("facing"), &Tools::face},
      Use{ToolUse::roughing, to_translate("roughing"), &Tools::rough},
      Use{ToolUse::finishing, to_translate("finishing"), &Tools::finish},
      Use{ToolUse::boring, to_translate("boring, rough"), &Tools::bore_rough},
      Use{ToolUse::boring, to_translate("boring, finish"), &Tools::bore_finish}};
  std::vector<RejectedTool> out;
  for (const Use& u : kUses) {
    const bool needed = std::any_of(all.begin(), all.end(), [&](const Considered& c) {
      return c.tools.*u.tool != nullptr;
    });
    for (const Tool& t : p_.tools) {
      if (!needed || best.tools.*u.tool == &t ||
          std::find(t.uses.begin(), t.uses.end(), u.use) == t.uses.end())
        continue;
      const Considered* least = nullptr;
      for (const auto& c : all)
        if (c.tools.*u.tool == &t && (!least || c.at_least < least->at_least)) least = &c;
      const bool cuts = std::ranges::find(t.groups, p_.material.group) != t.groups.end();
      out.push_back(rejection(t, u.name, cuts, least, best));
    }
  }
  return out;
}

bool SetupPlanner::can_be_made(const std::function<bool(const SurfaceTask&)>& makes) {
  const auto offset = compensate_ ? Offset::path : free_offset(p_);
  std::map<std::pair<std::size_t, ToolPair>, bool> known;
  const auto made = [&](std::size_t j, const Tools& tools) {
    const auto [it, fresh] = known.try_emplace({j, tools_of(j, tools)});
    if (fresh) it->second = makes(task(j, tools, offset));
    return it->second;
  };
  std::vector<std::size_t> every(jobs_.size());
  std::iota(every.begin(), every.end(), 0);
  return std::all_of(every.begin(), every.end(),
                     [&](std::size_t j) {
                       return std::any_of(choices_.begin(), choices_.end(),
                                          [&](const Tools& t) { return made(j, t); });
                     }) &&
         std::any_of(choices_.begin(), choices_.end(), [&](const Tools& t) {
           return std::all_of(every.begin(), every.end(),
                              [&](std::size_t j) { return made(j, t); });
         });
}

SolvedSetup SetupPlanner::as_given(SurfaceAnswer (*answer)(const SurfaceTask&),
                                   const std::set<std::string>& corrected) {
  SolvedSetup s{setup_, clamping_, {}, {}, 0, 0};
  for (std::size_t j = 0; j < jobs_.size(); ++j) {
    const bool follows = corrected.contains(jobs_[j].feature.surface());
    const auto offset = follows ? Offset::path : free_offset(p_);
    auto t = task(j, {}, offset);
    auto a = answer(t);
    s.features.push_back({std::move(t), std::move(a), jobs_[j].wanted.ids});
  }
  s.auxiliary = auxiliary_;
  s.between = between(s);
  return s;
}

SolvedSetup SetupPlanner::explained() {
  explain_ = true;
  return solve(nearest_, 0, kInfinity);
}

bool SetupPlanner::any(MachinedSurface::Kind kind) const {
  return std::any_of(jobs_.begin(), jobs_.end(),
                     [&](const Job& j) { return j.feature.kind() == kind; });
}

// Every combination of one tool for each use that the setup has; roughing, and what the
// request leaves out, may do without.
std::vector<Tools> SetupPlanner::every_choice() const {
  using List = std::vector<const Tool*>;
  const auto list = [&](bool wanted, ToolUse use, bool or_none) {
    List tools = wanted ? tools_for(p_, use) : List{};
    if (tools.empty() || or_none) tools.push_back(nullptr);
    return tools;
  };
  const bool given = p_.operations.has_value();
  const bool elements = any(MachinedSurface::Kind::element),
             bores = any(MachinedSurface::Kind::bore);
  const bool faces = std::ranges::any_of(
      jobs_, [](const Job& j) { return j.feature.last_use() == ToolUse::facing; });
  const auto face = list(faces, ToolUse::facing, false);
  const auto rough = list(elements, ToolUse::roughing, elements);
  const auto finish = list(elements, ToolUse::finishing, elements && given);
  const auto bore_rough = list(bores, ToolUse::boring, bores);
  const auto bore_finish = list(bores, ToolUse::boring, bores && given);
  std::vector<Tools> all;
  for (const auto* x : face)
    for (const auto* r : rough)
      for (const auto* f : finish)
        for (const auto* br : bore_rough)
          for (const auto* bf : bore_finish) all.push_back({x, r, f, br, bf});
  return all;
}

// The tools of a job: roughing and finishing (or facing).
ToolPair SetupPlanner::tools_of(std::size_t j, const Tools& tools) const {
  const auto& w = jobs_[j].wanted;
  const auto use = jobs_[j].feature.last_use();
  if (jobs_[j].feature.is_face())
    return {nullptr, w.finish_tool               ? w.finish_tool
                     : use == ToolUse::facing    ? tools.face
                     : use == ToolUse::finishing ? tools.finish
                                                 : tools.bore_finish};
  const bool bore = jobs_[j].feature.kind() == MachinedSurface::Kind::bore;
  const Tool* rough =
      w.rough_tool ? w.rough_tool : (bore ? tools.bore_rough : tools.rough);
  const Tool* finish =
      w.finish_tool ? w.finish_tool : (bore ? tools.bore_finish : tools.finish);
  return {w.rough ? rough : nullptr, w.finish ? finish : nullptr};
}

const std::vector<CutTolerance>& SetupPlanner::cut_tolerances_of(std::size_t j,
                                                                 const Tool* last,
                                                                 Offset offset) {
  const auto [it, fresh] = cut_tolerances_.try_emplace({j, last, offset});
  if (fresh)
    it->second =
        cut_tolerances(p_, jobs_[j].feature.surface(), offset, {setup_, clamping_, last});
  return it->second;
}

SurfaceTask SetupPlanner::task(std::size_t j, const Tools& tools, Offset offset) {
  const auto& f = jobs_[j].feature;
  const auto [rough, finish] = tools_of(j, tools);
  const Making making{setup_, clamping_, finish ? finish : rough};
  auto& unasked = shared_.unasked[{j, {rough, finish}, f.holding()}];
  if (!unasked) unasked = std::make_shared<Unasked>();
  SurfaceTask t{f,
                cut_tolerances_of(j, making.last, offset),
                recipes(p_, f, jobs_[j].wanted, rough, finish),
                economy_,
                making,
                offset,
                explain_};
  t.unasked = unasked;
  return t;
}

Entry& SetupPlanner::entry(std::size_t j, const Tools& tools) {
  leave_if_asked();
  const auto key = tools_of(j, tools);
  auto& memory = memory_[j];
  if (jobs_[j].feature.kind() == MachinedSurface::Kind::end_face) {
    const auto [it, fresh] = shared_.faces.try_emplace(key.second);
    if (fresh) it->second.bound = least_objective(task(j, tools, free_offset(p_)));
    return it->second;
  }
  const auto [it, fresh] = memory.try_emplace(key);
  if (fresh) it->second.bound = least_objective(task(j, tools, Offset::none));
  return it->second;
}

const SolvedSurface& SetupPlanner::solved(std::size_t j, const Tools& tools,
                                          double most) {
  auto& e = entry(j, tools);
  const auto settled = [&] {
    return e.solved && (e.solved->answer.feasible || most <= e.most);
  };
  const auto attempt = [&](Offset offset) {
    auto t = task(j, tools, offset);
    t.boxes = std::max(t.boxes - boxes_, kLeastBoxes);
    auto answer = optimise_surface(t, kGap, most);
    boxes_ += answer.certificate.nodes;
    return SolvedSurface{std::move(t), std::move(answer), jobs_[j].wanted.ids};
  };
  // A surface that can be made without compensation, at any cost, is not compensated.
  if (compensate_) most = kInfinity;
  if (explain_ && !(e.solved && e.solved->answer.feasible)) {
    e.solved = attempt(compensate_ ? Offset::path : free_offset(p_));
    return *e.solved;
  }
  if (!settled()) {
    e.most = most;
    e.solved = attempt(free_offset(p_));
  }
  if (!compensate_ || e.solved->answer.feasible || e.compensated ||
      e.solved->task.cut_tolerances.empty())
    return *e.solved;
  e.compensated = true;
  auto compensated = attempt(Offset::path);
  if (compensated.answer.feasible)
    e.solved = std::move(compensated);
  else
    e.solved->answer.lower_bound = compensated.answer.lower_bound;
  return *e.solved;
}

// `least` is a lower bound of the setup and rises as surfaces are solved; each surface
// may cost what the others leave of `most`.
SolvedSetup SetupPlanner::solve(const Tools& tools, double least, double most) {
  SolvedSetup s{setup_, clamping_, {}, {}, 0, 0};
  s.lower_bound = least;
  s.short_of_stations = left_out_;
  for (std::size_t j = 0; j < jobs_.size(); ++j) {
    // One surface that cannot be made decides; the others are solved only to explain.
    if (!explain_ && !s.feasible()) break;
    const double alone = entry(j, tools).bound;
    const double left = std::isfinite(most) ? most - (s.lower_bound - alone) : kInfinity;
    const auto& f = solved(j, tools, std::max(left, alone));
    s.features.push_back(f);
    if (std::isfinite(alone)) s.lower_bound += f.answer.lower_bound - alone;
    if (f.answer.feasible) s.objective += f.answer.objective;
  }
  s.auxiliary = auxiliary_;
  s.between = between(s);
  const double besides_features = besides(s.between);
  s.objective += besides_features;
  if (s.feasible()) {
    s.lower_bound += besides_features - least_besides_cutting(tools);
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
double SetupPlanner::least_besides_cutting(const Tools& tools) const {
  ToolOrder order(kPlaces, std::vector<const Tool*>(jobs_.size()));
  for (std::size_t j = 0; j < jobs_.size(); ++j) {
    const auto [r, f] = tools_of(j, tools);
    const auto kind = jobs_[j].feature.kind();
    order[place_in_setup(kind, false)][j] = f;
    if (!p_.operations && r) order[place_in_setup(kind, true)][j] = r;
  }
  return besides(between(order));
}

// Centre hole and drilling come between the faces and the other operations.  A tool that
// is used at a place of the order goes over all surfaces of that place, so that the tools
// alone decide what lies between the operations.
Between SetupPlanner::between(const ToolOrder& order) const {
  Order all(p_, setup_, clamping_, front_mm_);
  for (std::size_t place = 0; place < order.size(); ++place) {
    if (place == 1)
      for (const auto& o : auxiliary_.before) all.add(o.order);
    const auto& tools = order[place];
    const auto used = std::find_if(tools.begin(), tools.end(), [](auto* t) { return t; });
    if (used == tools.end()) continue;
    const bool one_tool = std::all_of(tools.begin(), tools.end(),
                                      [&](auto* t) { return !t || t == *used; });
    for (std::size_t j = 0; j < tools.size(); ++j) {
      const auto& feature = jobs_[j].feature;
      const bool here = place_in_setup(feature.kind(), false) == place ||
                        place_in_setup(feature.kind(), true) == place;
      const Tool* t = tools[j] || !one_tool || !here ? tools[j] : *used;
      if (t) all.add(feature.in_order(*t, place == 1 || place == 4));
    }
  }
  for (const auto& o : auxiliary_.after) all.add(o.order);
  return all.done();
}

Between SetupPlanner::between(const SolvedSetup& s) const {
  ToolOrder order(kPlaces, std::vector<const Tool*>(jobs_.size()));
  for (std::size_t j = 0; j < s.features.size(); ++j) {
    if (!s.features[j].answer.feasible) continue;
    const auto& r = s.features[j].answer.model->recipe();
    const auto kind = jobs_[j].feature.kind();
    if (r.rough) order[place_in_setup(kind, true)][j] = r.rough;
    if (r.finish) order[place_in_setup(kind, false)][j] = r.finish;
  }
  return between(order);
}

// In the terms of the objective, operations at fixed conditions included.
double SetupPlanner::besides(const Between& between) const {
  return economy_.minute * (besides_cutting(p_, clamping_, between).total().time_min +
                            auxiliary_.minutes()) +
         economy_.edge * auxiliary_.edges_cost();
}

}  // namespace turnwright::planning
