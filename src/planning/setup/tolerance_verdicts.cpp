#include "tolerance_verdicts.hpp"

#include <algorithm>
#include <cmath>

#include "planning/budget/uncertain_limits.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::planning {
namespace {

using part::Tolerance;
using part::ToleranceKind;

// Share of a tolerance by which an optimum may exceed its limit: 1e-9 mm of 10 um.
constexpr double kOver = 1e-7;

Compensation::Table correction(const SolvedSurface& f) {
  return f.task.feature.corrections(f.answer.model->recipe(), f.task.economy,
                                    f.answer.choice);
}

// The state for which the plan was made, that of all new edges, and those where one of them
// has been changed before the other.  All are one where the plan's forces are those of new
// edges.
enum class Edges { changed, fresh, new_rougher, new_finisher };

MachinedSurface cut_by(Edges edges, const MachinedSurface& surface) {
  switch (edges) {
    case Edges::changed:
      break;
    case Edges::fresh:
      return surface.with_edges({.rough = false, .finish = false});
    case Edges::new_rougher:
      return surface.with_edges({.rough = false});
    case Edges::new_finisher:
      return surface.with_edges({.finish = false});
  }
  return surface;
}

struct Found {
  const SolvedSurface* feature = nullptr;
  const CutTolerance* cut_tolerance = nullptr;
  Edges edges = Edges::changed;
};

tolerance::PiecewisePolynomial error_of(const SolvedSurface& f, Edges edges) {
  const auto& a = f.answer;
  if (edges == Edges::changed || !a.model || !f.task.feature.is_worn()) return a.profile;
  return cut_by(edges, f.task.feature)
      .profile(a.model->recipe(), f.task.economy, a.choice);
}

Found find(const std::vector<SolvedSetup>& setups, const std::string& surface,
           std::size_t tolerance) {
  for (const auto& s : setups)
    for (const auto& f : s.features) {
      if (f.task.feature.surface() != surface) continue;
      for (const auto& d : f.task.cut_tolerances)
        if (d.tolerance == tolerance) return {&f, &d};
    }
  return {};
}

tolerance::Profile profile(const Found& f) {
  if (!f.feature) return tolerance::Samples{};
  return error_of(*f.feature, f.edges);
}

// Offset that centres an error about zero.
double to_middle_mm(const tolerance::PiecewisePolynomial& e) {
  const auto x = tolerance::extremes(e);
  return -(x.min_mm + x.max_mm) / 2;
}

tolerance::PiecewisePolynomial moved(tolerance::PiecewisePolynomial e, double by_mm) {
  for (auto& piece : e.coefficients) piece[0] += by_mm;
  return e;
}

// 0 if every size keeps its limits without an offset.
double offset_mm(const SolvedSurface& f, Edges edges) {
  if (f.task.offset != Offset::constant || !f.answer.model) return 0;
  const auto e = error_of(f, edges);
  const auto x = tolerance::extremes(e);
  const double most = std::max(x.max_mm, -x.min_mm);
  const bool needed =
      std::ranges::any_of(f.task.cut_tolerances, [&](const CutTolerance& d) {
        return d.shape == CutTolerance::Shape::centred &&
               d.factor * most > d.upper * (1 + kOver);
      });
  return needed ? to_middle_mm(e) : 0;
}

// The error as made, with the plan's offset or corrected path.
tolerance::Profile as_made(const Found& f) {
  if (!f.feature) return profile(f);
  if (f.feature->task.offset != Offset::path)
    return moved(error_of(*f.feature, f.edges), offset_mm(*f.feature, f.edges));
  const auto& a = f.feature->answer;
  const auto& task = f.feature->task;
  return task.feature.corrected_profile(a.model->recipe(), task.economy, a.choice,
                                        correction(*f.feature));
}

// The tolerance reduced by the shares of the other sources, for tolerance/ to judge;
// sizes about the programmed middle.
tolerance::Case judged(const Tolerance& t, const Found& at, double taken_mm,
                       double half_angle) {
  tolerance::Case c;
  c.kind = t.kind;
  c.half_angle_rad = half_angle;
  const bool bare =
      !at.cut_tolerance || at.cut_tolerance->shape == CutTolerance::Shape::none;
  if (t.limits) {
    const double half = (t.limits->upper_mm - t.limits->lower_mm - taken_mm) / 2;
    c.limits = part::Limits{-half, half};
  } else if (bare) {
    c.value_mm = t.value_mm;
    c.machine_mm = taken_mm;  // the cut has no term here
    if (part::facts(t.kind).axis_rule) c.controlled = tolerance::Controlled::axis;
  } else {
    c.value_mm = t.value_mm - taken_mm;
  }
  return c;
}

tolerance::Verdict verdict(tolerance::Case c, tolerance::Profile e,
                           tolerance::Profile other) {
  c.e_mm = std::move(e);
  c.other_mm = std::move(other);
  if (c.limits && tolerance::empty(c.e_mm)) std::swap(c.e_mm, c.other_mm);
  return tolerance::verdict(c);
}

// Shares of all sources other than the cut, over the surfaces that are made.
struct Taken {
  ToleranceAllocation by;
  double mm = 0;        // of the width; of a length the faces' own, each half
  double fixed_mm = 0;  // of it what parts have, not their measurement
};

// Adds the sources that spread at one more face.  A part that is warm, or cut by a
// machine that is not well known, is too long once, however many of its faces are cut.
void add(const std::vector<tolerance::Source>& of_face,
         std::vector<tolerance::Source>& all) {
  for (const auto& s : of_face) {
    const auto once = std::find_if(all.begin(), all.end(), [&](const auto& other) {
      return s.name == other.name && (s.name == kHeat || s.name == kMachine);
    });
    if (once != all.end())
      once->value_um += s.value_um;
    else
      all.push_back(s);
  }
}

Taken taken(const PreparedPart& p, std::size_t tolerance, const Found& at,
            const Found& other) {
  Taken all{.by = {.fixed = {{kMachine, p.machine_share_um}}, .spread = {}}};
  double made = 0;
  for (const auto* found : {&at, &other}) {
    if (!found->feature) continue;
    const auto own = tolerance_allocation(p, tolerance, found->feature->task.making);
    all.by.fixed = own.fixed;
    all.by.ends = std::min(own.ends, 2.0);  // of a length, not of each face
    add(own.spread, all.by.spread);
    all.mm += found->cut_tolerance->taken_mm;
    ++made;
  }
  all.mm = made > 0 ? all.mm / made : units::mm_from_um(p.machine_share_um);
  all.fixed_mm = units::mm_from_um(fixed_in_parts_um(all.by));
  return all;
}

// The error that uncertain forces and stiffness scale: for a size the largest deviation
// from the middle of its limits.
double scaled_mm(const tolerance::Case& c, const tolerance::Verdict& v) {
  const double factor = c.kind == ToleranceKind::diameter ? 2 : 1;
  if (c.limits) return factor * std::max(v.extremes_mm.max_mm, -v.extremes_mm.min_mm);
  const double zone = std::max(0.0, v.measured_mm - c.machine_mm);
  return c.kind == ToleranceKind::profile ? zone / 2 : zone;
}

// The error profile that uncertain forces and stiffness scale: for a corrected path the
// whole uncorrected error, without its middle if the first part is gauged.
tolerance::Profile scaled_with_forces(const PreparedPart& p, const Found& f) {
  if (!f.feature || f.feature->task.offset != Offset::path) return as_made(f);
  const auto& e = f.feature->answer.profile;
  return p.shop.first_part_gauged ? moved(e, to_middle_mm(e)) : e;
}

// The error that they scale, as a size or form.
double scaled_um(const PreparedPart& p, const tolerance::Case& c, const Found& at,
                 const Found& other) {
  const auto of = verdict(c, scaled_with_forces(p, at), scaled_with_forces(p, other));
  return units::um_from_mm(scaled_mm(c, of));
}

double stable(const PreparedPart& p, const Found& f) {
  if (!f.feature || !(p.damping_uncertainty_pct > 0)) return 1;
  const auto& a = f.feature->answer;
  if (!a.model) return 1;
  return stable_probability(
      p, f.feature->task.feature.chatter_share(a.model->chain(), a.choice));
}

// How far the offset lags behind a wearing edge: half of what it moves by between two
// corrections, on one side of a size.
double lag_um(const Found& f) {
  if (!f.feature || !(f.cut_tolerance->lag > 0)) return 0;
  return f.cut_tolerance->lag *
         units::um_from_mm(std::abs(offset_mm(*f.feature, Edges::changed) -
                                    offset_mm(*f.feature, Edges::fresh)));
}

double conforming(const PreparedPart& p, const Tolerance& t, const Found& at,
                  const Found& other, const Taken& all) {
  if (!(all.fixed_mm < width_mm(t) && (at.feature || other.feature))) return 0;
  const auto c = judged(t, at, all.fixed_mm, half_angle_rad(p.drawing, t.of).value_or(0));
  auto sources = all.by.spread;
  if (const double lag = lag_um(at) + lag_um(other); lag > 0) {
    sources.push_back({"wear", tolerance::Distribution::uniform, lag, 1});
    sources.push_back({kLife, tolerance::Distribution::normal, lag * life_spread(p), 1});
  }
  const double kept = tolerance::Spread(sources).within(
      tolerance::room_um(verdict(c, as_made(at), as_made(other))),
      error_spread(p) * scaled_um(p, c, at, other));
  return kept * stable(p, at) * stable(p, other);
}

// The sources other than the cut need more than the whole width.
void used_up(const Tolerance& t, double taken_mm, ToleranceResult& r) {
  r.verdict = Verdict::not_met;
  r.published_verdict = false;
  r.predicted_mm = {taken_mm};
  r.allowed_mm = {width_mm(t)};
  r.margin_mm = width_mm(t) - taken_mm;
}

void add_share(const Share& share, std::vector<Share>& all) {
  if (!(share.um > 0)) return;
  const auto same = std::ranges::find(all, share.source, &Share::source);
  if (same != all.end())
    same->um += share.um;
  else
    all.push_back(share);
}

Cut part_of_cut(const Found& f) {
  if (f.cut_tolerance->shape == CutTolerance::Shape::none) return Cut::none;
  return f.feature->task.offset == Offset::path ? Cut::corrected : Cut::error;
}

// What a robust plan keeps for forces, tool life and damping that are not well known.
void add_robust_shares(const PreparedPart& p, const tolerance::Case& c, const Found& at,
                       const Found& other, const Taken& all, ToleranceResult& r) {
  constexpr double kReach = 3;  // standard deviations, as of every normal source
  const double scaled = all.by.ends * kReach * scaled_um(p, c, at, other);
  add_share({to_translate("forces"), force_spread(p) * scaled}, r.shares);
  if (p.shop.edge_wear_mm > 0) add_share({kLife, life_spread(p) * scaled}, r.shares);
  const auto& made = at.feature ? at : other;
  const double damping = damping_share_mm(p, made.cut_tolerance->tolerance,
                                          made.feature->task.making, part_of_cut(made));
  add_share({to_translate("damping"), units::um_from_mm(damping)}, r.shares);
}

void predict(const PreparedPart& p, const Tolerance& t, const Found& at,
             const Found& other, const Taken& all, ToleranceResult& r) {
  const double half_angle = half_angle_rad(p.drawing, t.of).value_or(0);
  const auto c = judged(t, at, all.mm, half_angle);
  const auto cut = verdict(c, profile(at), profile(other));
  const auto made = verdict(c, as_made(at), as_made(other));
  r.published_verdict = cut.published_verdict;
  r.margin_mm = made.margin_mm;
  const double rounding = kOver * width_mm(t);
  r.verdict = made.margin_mm < -rounding  ? Verdict::not_met
              : cut.margin_mm < -rounding ? Verdict::met_with_offset
                                          : Verdict::met;
  r.shares.insert(
      r.shares.begin(),
      {to_translate("deflection"), all.by.ends * units::um_from_mm(scaled_mm(c, made))});
  if (p.robust) add_robust_shares(p, c, at, other, all, r);
  if (t.limits) {
    const double middle = (t.limits->upper_mm + t.limits->lower_mm) / 2;
    const double factor = t.kind == ToleranceKind::diameter ? 2 : 1;
    r.predicted_mm = {middle + factor * made.extremes_mm.min_mm,
                      middle + factor * made.extremes_mm.max_mm};
    r.allowed_mm = {t.limits->lower_mm + all.mm / 2, t.limits->upper_mm - all.mm / 2};
  } else {
    r.predicted_mm = {made.measured_mm};
    r.allowed_mm = {made.allowed_mm};
  }
}

double stock_mm(const part::Drawing& d, const std::string& element) {
  std::size_t i = 0;
  while (d.outer[i].id != element) ++i;
  return part::stock_of(d, i).most_mm;
}

// An element that no operation cuts has the stock's diameter; its form is unknown.
void not_made(const PreparedPart& p, const Tolerance& t, ToleranceResult& r) {
  const auto& d = p.drawing;
  const auto at = *part::extent(d, t.of);
  const double off = at.inner ? d.stock.inner_mm - std::max(at.left_mm, at.right_mm)
                              : stock_mm(d, t.of) - std::min(at.left_mm, at.right_mm);
  r.verdict = Verdict::not_met;
  r.published_verdict = false;
  r.P_conform = 0;
  r.margin_mm = -std::abs(off);
  r.predicted_mm = {std::abs(off)};
  r.allowed_mm = {width_mm(t)};
  if (t.limits) {
    r.predicted_mm = {off, off};
    r.allowed_mm = {t.limits->lower_mm, t.limits->upper_mm};
  }
}

// For surfaces left as stock only the machine's share is predicted.
void left_as_stock(const PreparedPart& p, const Tolerance& t, ToleranceResult& r) {
  if (!t.limits) {
    r.predicted_mm = {units::mm_from_um(p.machine_share_um)};
    r.allowed_mm = {t.value_mm};
    r.margin_mm = r.allowed_mm[0] - r.predicted_mm[0];
    return;
  }
  const double middle = (t.limits->upper_mm + t.limits->lower_mm) / 2;
  const double half = (width_mm(t) - units::mm_from_um(p.machine_share_um)) / 2;
  r.predicted_mm = {middle, middle};
  r.allowed_mm = {middle - half, middle + half};
  r.margin_mm = half;
}

ToleranceResult result(const PreparedPart& p, const std::vector<SolvedSetup>& setups,
                       std::size_t i, Edges edges) {
  const auto& t = p.drawing.tolerances[i];
  const bool length = t.kind == ToleranceKind::length;
  Found at = find(setups, length ? t.between[1] : t.of, i);
  Found other = length ? find(setups, t.between[0], i) : Found{};
  at.edges = other.edges = edges;
  ToleranceResult r;
  r.id = t.id;
  r.kind = t.kind;
  r.of = length ? t.between[0] + " .. " + t.between[1] : t.of;
  r.width_mm = width_mm(t);
  const auto all = taken(p, i, at, other);
  r.shares = shares(all.by);
  const bool none_left = width_mm(t) <= all.mm;
  if (none_left || at.feature || other.feature)
    r.P_conform = conforming(p, t, at, other, all);
  if (none_left)
    used_up(t, all.mm, r);
  else if (!at.feature && half_angle_rad(p.drawing, t.of))
    not_made(p, t, r);
  else if (!at.feature && !other.feature)
    left_as_stock(p, t, r);
  else
    predict(p, t, at, other, all, r);
  return r;
}

// What holds in two states of the edges.
ToleranceResult both(const ToleranceResult& a, const ToleranceResult& b) {
  ToleranceResult r = a.margin_mm < b.margin_mm ? a : b;
  r.verdict = std::max(a.verdict, b.verdict);
  r.published_verdict = a.published_verdict && b.published_verdict;
  r.P_conform = std::min(a.P_conform, b.P_conform);
  if (r.predicted_mm.size() == 2)
    r.predicted_mm = {std::min(a.predicted_mm[0], b.predicted_mm[0]),
                      std::max(a.predicted_mm[1], b.predicted_mm[1])};
  return r;
}

using Table = std::vector<std::pair<double, double>>;

Table deviation(const SolvedSurface& f, const std::vector<double>& places, Edges edges) {
  const auto& feature = f.task.feature;
  const auto& recipe = f.answer.model->recipe();
  const bool follows = f.task.offset == Offset::path;
  const auto made = cut_by(edges, feature);
  const auto e = follows ? made.corrected(recipe, f.task.economy, f.answer.choice, places,
                                          correction(f))
                         : made.errors(recipe, f.task.economy, f.answer.choice, places);
  const double by = offset_mm(f, edges);
  Table table;
  for (std::size_t k = 0; k < places.size(); ++k)
    table.emplace_back(places[k], e[k] + by);
  return table;
}

}  // namespace

std::vector<ToleranceResult> tolerance_results(const PreparedPart& p,
                                               const std::vector<SolvedSetup>& setups) {
  std::vector<ToleranceResult> results;
  for (std::size_t i = 0; i < p.drawing.tolerances.size(); ++i) {
    results.push_back(result(p, setups, i, Edges::changed));
    if (!(p.shop.edge_wear_mm > 0)) continue;
    for (const auto edges : {Edges::fresh, Edges::new_rougher, Edges::new_finisher})
      results.back() = both(result(p, setups, i, edges), results.back());
  }
  return results;
}

std::vector<Deviation> deviations(const PreparedPart& p,
                                  const std::vector<SolvedSetup>& setups) {
  constexpr int kSections = 21;
  std::vector<Deviation> all;
  for (const auto& s : setups)
    for (const auto& f : s.features) {
      if (!f.answer.model) continue;
      const auto& feature = f.task.feature;
      if (part::has_cut(p.drawing, feature.surface())) continue;
      std::vector<double> places;
      for (int k = 0; k < kSections; ++k)
        places.push_back(feature.low_mm() +
                         (feature.high_mm() - feature.low_mm()) * k / (kSections - 1));
      Deviation d{feature.surface(), s.setup, deviation(f, places, Edges::fresh)};
      if (p.shop.edge_wear_mm > 0) d.at_change_mm = deviation(f, places, Edges::changed);
      all.push_back(std::move(d));
    }
  return all;
}

std::vector<ToolOffset> offsets(const PreparedPart& p,
                                const std::vector<SolvedSetup>& setups) {
  std::vector<ToolOffset> all;
  for (const auto& s : setups)
    for (const auto& f : s.features) {
      ToolOffset o{f.task.feature.surface(), s.setup, offset_mm(f, Edges::fresh)};
      if (p.shop.edge_wear_mm > 0) o.at_change_mm = offset_mm(f, Edges::changed);
      if (o.offset_mm != 0 || o.at_change_mm.value_or(0) != 0) all.push_back(o);
    }
  return all;
}

std::vector<Compensation> compensations(const std::vector<SolvedSetup>& setups) {
  std::vector<Compensation> all;
  for (const auto& s : setups)
    for (const auto& f : s.features)
      if (f.task.offset == Offset::path && f.answer.feasible)
        all.push_back({f.task.feature.surface(), s.setup, correction(f)});
  return all;
}

std::optional<WorstConformance> worst_conformance(
    const PlanRequest& p, const std::vector<ToleranceResult>& all) {
  const auto worst = std::ranges::min_element(all, {}, &ToleranceResult::P_conform);
  if (worst == all.end()) return {};
  return WorstConformance{worst->id, worst->P_conform, p.conformance};
}

}  // namespace turnwright::planning
