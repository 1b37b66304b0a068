#include "setup_planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

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
      auxiliary_min_(auxiliary_.minutes()),
      auxiliary_edges_(auxiliary_.edges_cost()),
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
  choices_ = every_choice();
  share_tools_ = may_share_tools();
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

// Tools that the request wants on a surface, whatever is chosen.
std::set<const Tool*> SetupPlanner::requested_tools() const {
  std::set<const Tool*> all;
  for (const auto& job : jobs_)
    for (const Tool* t : {job.wanted.rough_tool, job.wanted.finish_tool})
      if (t) all.insert(t);
  return all;
}

// Counts the stations that the other operations of the setup leave; a conflict if they are
// too few for any choice of tools.  Milled places have each the cutter that is best there:
// choices that would fit if one did for all of them are not tried, but count in the lower
// bound.
void SetupPlanner::fit_turret() {
  std::set<std::string> others, cutters;
  for (const auto& o : auxiliary_.all()) {
    others.insert(tool_label(p_, o.plan));
    if (o.plan.milled) cutters.insert(o.plan.tool);
  }
  stations_ = p_.machine.stations - static_cast<long>(others.size());
  spared_ = std::max(static_cast<long>(cutters.size()), 1L) - 1;
  const auto requested = requested_tools();
  if (static_cast<long>(requested.size() + kToolMembers.size()) <= stations_) return;
  std::set<const Tool*> fewest;
  bool any_fits = false;
  const auto some = few_alike(choices_, requested);
  for (std::size_t i = 0; i < some.size(); ++i) {
    const auto own = used(some[i]);
    if (i == 0 || own.size() < fewest.size()) fewest = own;
    const bool this_fits = static_cast<long>(own.size()) <= stations_;
    any_fits = any_fits || this_fits;
    left_out_ = left_out_ || !this_fits;
  }
  if (any_fits) return;
  for (const auto* tool : fewest) others.insert(tool->id);
  auxiliary_.conflicts.push_back(too_few_stations(p_, setup_, others));
}

// Whether the turret has stations for a choice of tools, were it `spared` larger.
bool SetupPlanner::fits(const Tools& tools, long spared) const {
  return !left_out_ || static_cast<long>(used(tools).size()) <= stations_ + spared;
}

// The first of the choices that fits.
std::optional<Tools> SetupPlanner::first_fitting(const ToolChoices& choices) const {
  const auto some = left_out_ ? few_alike(choices, requested_tools()) : choices;
  for (std::size_t i = 0; i < some.size(); ++i)
    if (const auto tools = some[i]; fits(tools)) return tools;
  return std::nullopt;
}

std::vector<Conflict> SetupPlanner::conflicts() const {
  return conflicts_of(auxiliary_, setup_);
}

double SetupPlanner::least_objective_of(const Tools& tools) {
  double bound = least_besides_cutting(tools);
  for (std::size_t j = 0; j < jobs_.size(); ++j) bound += entry(j, tools).at_least();
  return bound;
}

// The group of tools that decides what a job costs.
std::size_t SetupPlanner::group_of(std::size_t j) const {
  using enum MachinedSurface::Kind;
  const auto kind = jobs_[j].feature.kind();
  return kind == bore || kind == inner_shoulder ? 1 : 0;
}

// What each choice of a group costs at least in the jobs that it decides and between them.
CheapestFirst::AllTerms SetupPlanner::terms() {
  CheapestFirst::AllTerms all;
  for (std::size_t group = 0; group < all.size(); ++group)
    for (std::size_t i = 0; i < choices_.size(group); ++i) {
      const auto tools = choices_.of_group(group, i);
      double sum = least_between(group, tools);
      for (std::size_t j = 0; j < jobs_.size(); ++j)
        if (group_of(j) == group) sum += entry(j, tools).at_least();
      all[group].emplace_back(sum, i);
    }
  return all;
}

CheapestFirst SetupPlanner::cheapest_first(CheapestFirst::AllTerms terms) {
  return {choices_, std::move(terms), besides({}),
          [this](std::size_t choice) -> std::optional<double> {
            const auto tools = choices_[choice];
            if (!fits(tools, spared_)) return std::nullopt;
            const double least = least_objective_of(tools);
            if (fits(tools)) return least;
            nearly_fitting_ = std::min(nearly_fitting_, least);
            return std::nullopt;
          }};
}

std::vector<const MachinedSurface*> SetupPlanner::features() const {
  std::vector<const MachinedSurface*> all;
  for (const auto& job : jobs_) all.push_back(&job.feature);
  return all;
}

SolvedSetup SetupPlanner::best(double most) {
  considered_.clear();
  nearly_fitting_ = kInfinity;
  SolvedSetup best{setup_, clamping_, {}, {}, 0, kInfinity};
  double bound = kInfinity;
  std::size_t chosen = 0;
  auto choices = cheapest_first(terms());
  for (auto next = choices.next(); next; next = choices.next()) {
    const auto [least, choice] = *next;
    if (least >= most && !considered_.empty()) {
      bound = std::min(bound, least);
      break;
    }
    auto s = solve(choices_[choice], least, most);
    bound = std::min(bound, s.lower_bound);
    considered_.push_back(
        {choice, s.feasible() ? s.objective : s.lower_bound, s.feasible()});
    const bool better =
        s.feasible() != best.feasible() ? s.feasible() : s.objective < best.objective;
    if (considered_.size() == 1 || better) {
      best = std::move(s);
      nearest_ = choices_[choice];
      chosen = considered_.size() - 1;
    }
    if (best.feasible()) most = std::min(most, best.objective);
  }
  if (considered_.empty()) {  // every choice is refuted
    nearest_ = first_fitting(choices_).value_or(Tools{});
    best = solve(nearest_, kInfinity, most);
    best.lower_bound = nearly_fitting_;
    return best;
  }
  best.lower_bound = std::min(bound, nearly_fitting_);
  if (best.feasible()) best.rejected_tools = rejected(considered_[chosen]);
  return best;
}

// The least objective of the choices with this tool in a list; none if the turret has no
// stations for any.
std::optional<Considered> SetupPlanner::least_with(CheapestFirst::AllTerms terms,
                                                   std::size_t list, const Tool* tool) {
  const auto has = [&](const Tools& tools) { return tools.*kToolMembers[list] == tool; };
  std::optional<Considered> least;
  for (const auto& c : considered_)
    if (has(choices_[c.choice]) && (!least || c.at_least < least->at_least)) least = c;
  const auto group = ToolChoices::group_of(list);
  std::erase_if(terms[group], [&](const auto& term) {
    return !has(choices_.of_group(group, term.second));
  });
  auto choices = cheapest_first(std::move(terms));
  for (auto next = choices.next(); next; next = choices.next()) {
    if (least && next->first >= least->at_least) break;
    const auto solved = std::ranges::find(considered_, next->second, &Considered::choice);
    if (solved == considered_.end()) return Considered{next->second, next->first};
  }
  if (!least && first_fitting(with_only(choices_, list, tool)))
    least = Considered{.at_least = kInfinity};
  return least;
}

// Every tool of the request in every use of this setup for which it was not chosen.
std::vector<RejectedTool> SetupPlanner::rejected(const Considered& best) {
  struct Use {
    ToolUse use;
    const char* name;
  };
  constexpr std::array<Use, kToolMembers.size()> kUses{
      {{ToolUse::facing, to_translate("facing")},
       {ToolUse::roughing, to_translate("roughing")},
       {ToolUse::finishing, to_translate("finishing")},
       {ToolUse::boring, to_translate("boring, rough")},
       {ToolUse::boring, to_translate("boring, finish")}}};
  const auto all = terms();
  std::vector<RejectedTool> out;
  for (std::size_t list = 0; list < kUses.size(); ++list) {
    const auto& u = kUses[list];
    const auto& wanted = choices_.lists()[list];
    const bool needed = std::ranges::any_of(wanted, [](const Tool* t) { return t; });
    for (const Tool& t : p_.tools) {
      if (!needed || choices_[best.choice].*kToolMembers[list] == &t ||
          std::ranges::find(t.uses, u.use) == t.uses.end())
        continue;
      const bool cuts = std::ranges::find(t.groups, p_.material.group) != t.groups.end();
      const auto least = cuts ? least_with(all, list, &t) : std::nullopt;
      out.push_back(rejection(t, u.name, cuts, least ? &*least : nullptr, best));
    }
  }
  return out;
}

void SetupPlanner::allow_compensation() {
  compensate_ = !(p_.shop.edge_wear_mm > 0);
  for (auto& of_job : memory_)
    for (auto& [tools, e] : of_job) e.proved = 0;
}

bool SetupPlanner::can_be_made(const std::function<bool(const SurfaceTask&)>& makes) {
  const auto offset = compensate_ ? Offset::path : free_offset(p_);
  std::map<std::pair<std::size_t, ToolPair>, bool> known;
  const auto made = [&](std::size_t j, const Tools& tools) {
    const auto [it, fresh] = known.try_emplace({j, tools_of(j, tools)});
    if (fresh) it->second = makes(task(j, tools, offset));
    return it->second;
  };
  CheapestFirst::AllTerms makers;  // choices that make every job of a group, at no cost
  for (std::size_t group = 0; group < makers.size(); ++group) {
    const auto of_group = [&](std::size_t i) { return choices_.of_group(group, i); };
    const std::size_t choices = choices_.size(group);
    const auto some_choice_makes = [&](std::size_t j) {
      std::size_t i = 0;
      while (i < choices && !made(j, of_group(i))) ++i;
      return i < choices;
    };
    for (std::size_t j = 0; j < jobs_.size(); ++j)
      if (group_of(j) == group && !some_choice_makes(j)) return false;
    for (std::size_t i = 0; i < choices; ++i) {
      bool all = true;
      for (std::size_t j = 0; all && j < jobs_.size(); ++j)
        all = group_of(j) != group || made(j, of_group(i));
      if (!all) continue;
      makers[group].emplace_back(0, i);
      if (!left_out_) break;
    }
  }
  return CheapestFirst(choices_, std::move(makers), 0,
                       [&](std::size_t choice) -> std::optional<double> {
                         if (fits(choices_[choice])) return 0;
                         return std::nullopt;
                       })
      .next()
      .has_value();
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
ToolChoices SetupPlanner::every_choice() const {
  const auto list = [&](bool wanted, ToolUse use, bool or_none) {
    ToolList tools = wanted ? tools_for(p_, use) : ToolList{};
    if (tools.empty() || or_none) tools.push_back(nullptr);
    return tools;
  };
  const bool given = p_.operations.has_value();
  const bool elements = any(MachinedSurface::Kind::element),
             bores = any(MachinedSurface::Kind::bore);
  const bool faces = std::ranges::any_of(
      jobs_, [](const Job& j) { return j.feature.last_use() == ToolUse::facing; });
  return ToolChoices({list(faces, ToolUse::facing, false),
                      list(elements, ToolUse::roughing, elements),
                      list(elements, ToolUse::finishing, elements && given),
                      list(bores, ToolUse::boring, bores),
                      list(bores, ToolUse::boring, bores && given)});
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
  const auto clears = [&](const Tool* t) { return !t || f.clears_centre(*t); };
  auto& unasked =
      shared_.unasked[{j, {rough, finish}, f.holding(), clears(rough) && clears(finish)}];
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

// What is proved of a surface raises its bound, but for end faces: other clampings share
// them, whose paths may be corrected.
const SolvedSurface& SetupPlanner::solved(std::size_t j, const Tools& tools,
                                          double most) {
  auto& e = entry(j, tools);
  const auto& s = solve_surface(e, j, tools, most);
  if (jobs_[j].feature.kind() != MachinedSurface::Kind::end_face)
    e.proved = std::max(e.proved, s.answer.lower_bound);
  return s;
}

const SolvedSurface& SetupPlanner::solve_surface(Entry& e, std::size_t j,
                                                 const Tools& tools, double most) {
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
    const double alone = entry(j, tools).at_least();
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
SetupPlanner::ToolOrder SetupPlanner::order_of(const Tools& tools) const {
  ToolOrder order(kPlaces, std::vector<const Tool*>(jobs_.size()));
  for (std::size_t j = 0; j < jobs_.size(); ++j) {
    const auto [r, f] = tools_of(j, tools);
    const auto kind = jobs_[j].feature.kind();
    order[place_in_setup(kind, false)][j] = f;
    if (!p_.operations && r) order[place_in_setup(kind, true)][j] = r;
  }
  return order;
}

double SetupPlanner::least_besides_cutting(const Tools& tools) const {
  return besides(between(order_of(tools)));
}

// Whether a tool may be used outside and in bores.
bool SetupPlanner::may_share_tools() const {
  std::array<std::set<std::string>, ToolChoices::kGroups> ids;
  for (std::size_t i = 0; i < kToolMembers.size(); ++i)
    for (const Tool* t : choices_.lists()[i])
      if (t) ids[ToolChoices::group_of(i)].insert(t->id);
  for (std::size_t j = 0; j < jobs_.size(); ++j)
    for (const Tool* t : {jobs_[j].wanted.rough_tool, jobs_[j].wanted.finish_tool})
      if (t) ids[group_of(j)].insert(t->id);
  for (const auto& o : auxiliary_.before) ids[0].insert(o.order.tool);
  for (const auto& o : auxiliary_.after) ids[1].insert(o.order.tool);
  return std::ranges::any_of(ids[0],
                             [&](const std::string& id) { return ids[1].contains(id); });
}

// Adds the operations of a group in their order.  Centre hole and drilling come between the
// faces and the other operations.  A tool that is used at a place of the order goes over all
// surfaces of that place, so that the tools alone decide what lies between the operations.
void SetupPlanner::add_group(std::size_t group, const ToolOrder& order,
                             Order& all) const {
  for (std::size_t place = 0; place < order.size(); ++place) {
    if ((place < kFirstOfBores) != (group == 0)) continue;
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
  if (group == 1)
    for (const auto& o : auxiliary_.after) all.add(o.order);
}

Between SetupPlanner::between(const ToolOrder& order) const {
  Order all(p_, setup_, clamping_, front_mm_);
  for (std::size_t group = 0; group < ToolChoices::kGroups; ++group)
    add_group(group, order, all);
  return all.done();
}

// A group between its own operations, from the tool change position and back.  Those of both
// groups are what lies between all operations, unless one tool goes from the one to the
// other: then nothing is counted.  Bores may begin with either force of the jaws.
double SetupPlanner::least_between(std::size_t group, const Tools& tools) const {
  if (share_tools_) return 0;
  const auto order = order_of(tools);
  const auto with = [&](Stage before) {
    Order own(p_, setup_, clamping_, front_mm_, before);
    add_group(group, order, own);
    return besides(own.done()) - besides({});
  };
  return group == 0 ? with(Stage::roughing)
                    : std::min(with(Stage::roughing), with(Stage::finishing));
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
  return economy_.minute *
             (besides_cutting(p_, clamping_, between).total().time_min + auxiliary_min_) +
         economy_.edge * auxiliary_edges_;
}

}  // namespace turnwright::planning
