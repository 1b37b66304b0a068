#include "conflict_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/say.hpp"
#include "least_relaxation.hpp"
#include "planning/setup/infeasibility_reason.hpp"
#include "planning/values/readable.hpp"
#include "turnwright/planning/limit_words.hpp"
#include "turnwright/planning/prepare.hpp"

namespace turnwright::planning {
namespace {

const SolvedSurface* feature_of(const Attempt& a, const std::string& surface) {
  for (const auto& s : a.setups)
    for (const auto& f : s.chosen.features)
      if (f.task.feature.surface() == surface) return &f;
  return nullptr;
}

// The jaws that hold the part while a surface is cut, if it is.
const JawForces* jaws_of(const PreparedPart& p, const Attempt& a,
                         const std::string& surface) {
  const auto* f = feature_of(a, surface);
  return f ? &p.jaws[f->task.making.setup] : nullptr;
}

// "setup 1, chuck or chuck-tailstock, d2"
std::string where(const PreparedPart& p, const Attempt& a, const std::string& surface) {
  const auto* f = feature_of(a, surface);
  if (!f) return surface.empty() ? tr("the part") : surface;
  const auto setup = f->task.making.setup;
  std::string clampings;
  for (const Clamping c : p.setups[setup].clampings)
    clampings = clampings.empty() ? tr(name(c)) : say("{} or {}", clampings, tr(name(c)));
  return fmt::format("{}, {}, {}", setup_label(setup), clampings, surface);
}

// The place of a limit: its own surface, or the first surface in conflict to which it
// applies.
std::string surface_of(const PreparedPart& p, const RelaxableLimit& l,
                       const std::set<std::string>& troubled) {
  if (!l.surface.empty()) return l.surface;
  for (const auto& surface : troubled)
    if (bears_on(p, l, surface)) return surface;
  return {};
}

std::string joined_names(const PreparedPart& p, const Feasibility& oracle,
                         const LimitSet& set, std::size_t but) {
  std::string out;
  for (const std::size_t i : set) {
    if (i == but) continue;
    const auto& l = oracle.limits()[i];
    const auto name = value_of(p, l).name;
    const auto one = limit_words(l.surface.empty() ? name : name + " of " + l.surface);
    out = out.empty() ? one : say("{} and {}", out, one);
  }
  return out;
}

// The relaxation that one member of a set needs.
struct Need {
  std::optional<double> factor;  // for all other limits to be kept
  double in_set = 0;             // for the rest of its set to be kept
};

class Explanation {
 public:
  Explanation(const PreparedPart& p, const Attempt& a) : p_(p), a_(a), oracle_(p) {
    sets_ = irreducible_conflicts(oracle_);
    for (const auto& set : sets_) members_.insert(members_.end(), set.begin(), set.end());
    oracle_.with(RelaxationFactors(oracle_.limits().size(), 1));
    troubled_ = oracle_.failed();
  }

  void tell(ProcessPlan& result) {
    for (const auto& surface : oracle_.left_out()) tell_not_made(surface, result);
    for (std::size_t k = 0; k < sets_.size(); ++k) needs_.push_back(needs(k));
    make_joint();
    for (std::size_t k = 0; k < sets_.size(); ++k)
      for (std::size_t i = 0; i < sets_[k].size(); ++i) tell(k, i, result);
    if (result.conflicts.empty()) tell_nearest(result);
  }

 private:
  // That no limits but the tools keep a surface from being made; returns whether it is so.
  bool tell_not_made(const std::string& surface, ProcessPlan& result) const {
    const auto* f = feature_of(a_, surface);
    if (!f || f->answer.feasible) return false;
    const auto reason = infeasibility_reason(p_, *f);
    if (std::ranges::find(result.conflicts, reason, &Conflict::sentence) ==
        result.conflicts.end())
      result.conflicts.push_back(
          {"depth of cut", where(p_, a_, surface), 0, 0, "mm", reason});
    return true;
  }

  // The limits that the search violates least, if no set of limits conflicts by itself.
  void tell_nearest(ProcessPlan& result) const {
    for (const auto& s : a_.setups)
      for (const auto& f : s.chosen.features)
        if (!f.answer.feasible)
          result.conflicts.push_back({"", where(p_, a_, f.task.feature.surface()), 0, 0,
                                      "", infeasibility_reason(p_, f)});
  }

  // Without the members of the other sets.
  std::vector<Need> needs(std::size_t k) {
    std::vector<Need> all;
    for (const std::size_t i : sets_[k]) {
      Need need;
      need.factor =
          least_relaxation(oracle_, i, without(oracle_, less(members_, sets_[k])));
      need.in_set =
          need.factor ? *need.factor
                      : least_relaxation(oracle_, i, only(oracle_, sets_[k])).value_or(1);
      all.push_back(need);
    }
    return all;
  }

  static LimitSet less(LimitSet all, const LimitSet& those) {
    std::erase_if(all, [&](std::size_t i) {
      return std::find(those.begin(), those.end(), i) != those.end();
    });
    return all;
  }

  // One of each set is relaxed, all together; if that is not enough, all by one more
  // factor.
  void make_joint() {
    if (sets_.size() < 2) return;
    std::vector<std::size_t> chosen(sets_.size(), 0);
    for (;;) {
      grow_until_kept(chosen);
      std::size_t k = 0;
      while (k < chosen.size() && ++chosen[k] == sets_[k].size()) chosen[k++] = 0;
      if (k == chosen.size()) return;
    }
  }

  void grow_until_kept(const std::vector<std::size_t>& chosen) {
    constexpr int kRounds = 200;
    RelaxationFactors factors(oracle_.limits().size(), 1);
    for (int round = 0; round < kRounds; ++round) {
      for (std::size_t k = 0; k < sets_.size(); ++k) {
        const auto& t = needs_[k][chosen[k]].factor;
        if (!t) return;
        factors[sets_[k][chosen[k]]] = *t;
      }
      if (oracle_.with(factors)) return;
      for (std::size_t k = 0; k < sets_.size(); ++k) {
        auto& t = *needs_[k][chosen[k]].factor;
        const auto& l = oracle_.limits()[sets_[k][chosen[k]]];
        if (t < kWithout) t = reported_factor(value_of(p_, l), t * kRelaxationStep);
      }
    }
    for (std::size_t k = 0; k < sets_.size(); ++k) needs_[k][chosen[k]].factor.reset();
  }

  void tell(std::size_t k, std::size_t i, ProcessPlan& result) const {
    const std::size_t limit = sets_[k][i];
    const auto& l = oracle_.limits()[limit];
    const auto surface = surface_of(p_, l, troubled_);
    const auto n = value_there(l, surface);
    const Need& need = needs_[k][i];
    // A shoulder between bores that no tool faces is in the way of its tolerances.
    if (!need.factor && need.in_set == 1 && !l.row->given() &&
        tell_not_made(surface, result))
      return;
    Conflict c{
        n.name, where(p_, a_, surface), value_at(l, n, need.in_set), n.now, n.unit, {},
        k + 1};
    c.sentence = sentence(c, k, limit);
    if (const auto used = used_up_by_all_else(l)) {
      c.value = used->value;
      c.sentence = used->sentence;
    }
    if (need.factor)
      result.relax.push_back(relaxation(l, n, surface, value_at(l, n, *need.factor), k));
    result.conflicts.push_back(std::move(c));
  }

  // The grip is that of the setup's jaws, which may close with less than the chuck could.
  LimitValue value_there(const RelaxableLimit& l, const std::string& surface) const {
    auto n = value_of(p_, l);
    if (const auto* jaws = jaws_of(p_, a_, surface); jaws && l.row->check == Check::grip)
      n.now = jaws->roughing_N;
    return n;
  }

  double value_at(const RelaxableLimit& l, const LimitValue& n, double factor) const {
    if (l.row->given()) return n.now;
    if (factor == kWithout)
      return value_of(prepare(relaxed(p_, {l}, {kWithout}), p_), l).now;
    return relaxed_value(n, factor);
  }

  std::optional<Conflict> used_up_by_all_else(const RelaxableLimit& l) const {
    if (!l.row->is_width) return {};
    for (const auto& s : a_.setups)
      for (const auto& f : s.chosen.features)
        for (const auto& d : f.task.cut_tolerances)
          if (d.tolerance == l.owner && !(d.upper > 0)) return used_up_conflict(p_, f, d);
    return {};
  }

  std::string sentence(const Conflict& c, std::size_t k, std::size_t limit) const {
    const auto others = joined_names(p_, oracle_, sets_[k], limit);
    const auto name = limit_words(c.limit);
    if (oracle_.limits()[limit].row->given())
      return say("{}: {}, given as {}{}{}, leaves no way to keep {}", c.where, name,
                 readable(c.allowed), c.unit.empty() ? "" : " ", c.unit,
                 others.empty() ? tr("what the tools can cut") : others);
    const auto [value, allowed] = readable_apart(c.value, c.allowed);
    const auto kept = others.empty() ? "" : say(" that keep {}", others);
    if (oracle_.limits()[limit].row->check == Check::chatter)
      return say(
          "{}: {} would come to {} times what is stable at best, with any clamping, "
          "tools and conditions allowed{}",
          c.where, name, value, kept);
    return say(
        "{}: {} would come to {} {} at best, with any clamping, tools and conditions "
        "allowed{}; its limit is {} {}",
        c.where, name, value, c.unit, kept, allowed, c.unit);
  }

  Relaxation relaxation(const RelaxableLimit& l, const LimitValue& n,
                        const std::string& surface, double needed, std::size_t k) const {
    Relaxation r{n.name, n.now, needed, n.unit, {}, k + 1};
    if (l.row->is_width || !l.surface.empty()) r.limit += " of " + surface;
    const auto name = limit_words(r.limit);
    if (l.row->given()) {
      r.sentence = say("{} would have to be left to the planner", name);
      return r;
    }
    const auto [from, to] = readable_apart(r.now, needed);
    if (l.row->check == Check::chatter) {
      r.sentence =
          say("to keep {}, stiffness or damping would have to be {} times as large", name,
              to);
      return r;
    }
    r.sentence =
        l.row->is_width
            ? say("{} would have to open from {} to {} {}", name, from, to, n.unit)
            : say("{} would have to go from {} to {} {}", name, from, to, n.unit);
    if (l.row->is_width && p_.drawing.tolerances[l.owner].limits)
      r.sentence += tr(" about the middle of its limits");
    if (const auto* jaws = jaws_of(p_, a_, surface);
        jaws && jaws->spares_tube && l.row->check == Check::grip)
      r.sentence +=
          tr(", which strains the hollow part to more than two thirds of its yield "
             "strength");
    return r;
  }

  const PreparedPart& p_;
  const Attempt& a_;
  Feasibility oracle_;
  std::vector<LimitSet> sets_;
  LimitSet members_;
  std::set<std::string> troubled_;
  std::vector<std::vector<Need>> needs_;
};

}  // namespace

void explain(const PreparedPart& plan, const Attempt& attempt, ProcessPlan& result) {
  Explanation(plan, attempt).tell(result);
}

}  // namespace turnwright::planning
