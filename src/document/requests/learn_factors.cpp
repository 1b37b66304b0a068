#include "learn_factors.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/say.hpp"
#include "document/catalogue/catalogue_readers.hpp"
#include "document/json/utf8.hpp"
#include "planning/budget/tolerance_allocation.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "turnwright/base/dual.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/learning/advice.hpp"
#include "turnwright/learning/factors.hpp"
#include "turnwright/planning/factor_effects.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::document::measured_parts {
namespace {

using learning::Estimate;
using learning::Evidence;
using learning::Posterior;
using learning::Prior;
using nlohmann::json;
using nlohmann::ordered_json;

// A measured diameter that the plan finishes.
struct Size {
  const planning::FactorEffect* effect = nullptr;
  const Learned* learned = nullptr;
  const Characteristic* of = nullptr;
};

struct Plan {
  const planning::PreparedPart& part;
  planning::ProcessPlan plan;
  std::vector<planning::FactorEffect> effects;
  std::vector<Size> sizes;
  std::vector<std::string> tools;  ///< that finish them
  double cycle_h() const { return plan.time_per_part_min / 60; }
};

std::vector<Size> measured_sizes(const Request& q, const std::vector<Learned>& all,
                                 const std::vector<planning::FactorEffect>& effects) {
  std::vector<Size> sizes;
  const auto& tolerances = q.part->part.drawing.tolerances;
  for (std::size_t c = 0; c < all.size(); ++c) {
    const auto& of = q.characteristics[c];
    const auto t = std::ranges::find(tolerances, of.id, &part::Tolerance::id);
    if (!all[c].trend || t == tolerances.end() ||
        t->kind != part::ToleranceKind::diameter)
      continue;
    const auto effect =
        std::ranges::find(effects, t->of, &planning::FactorEffect::surface);
    if (effect != effects.end()) sizes.push_back({&*effect, &all[c], &of});
  }
  return sizes;
}

// The size with the most values of each tool.
std::vector<Size> one_of_each_tool(const Plan& p) {
  std::vector<Size> chosen;
  for (const auto& tool : p.tools) {
    const Size* best = nullptr;
    for (const Size& s : p.sizes)
      if (s.effect->tool == tool &&
          (!best || s.learned->kept.size() > best->learned->kept.size()))
        best = &s;
    chosen.push_back(*best);
  }
  return chosen;
}

/// One line of `factors`.
struct Factor {
  const char *name, *unit;
  double prior = 0, prior_u = 0;
  Posterior posterior;
  const char* takes;  ///< what would tell it, if this did not
};

ordered_json described(const Factor& f) {
  const auto& e = f.posterior.factor;
  ordered_json out{{"name", f.name},
                   {"unit", f.unit},
                   {"prior", {{"value", f.prior}, {"u", f.prior_u}}},
                   {"identified", f.posterior.identified}};
  if (f.posterior.identified)
    out["posterior"] = {
        {"value", e.value}, {"u", e.u}, {"lower", e.lower}, {"upper", e.upper}};
  else
    out["not_identified"] = say("stays at its prior; it takes {}", tr(f.takes));
  return out;
}

// exp of a factor's logarithm.
Posterior exponential(Posterior p) {
  auto& e = p.factor;
  const double value = std::exp(e.value);
  e = {value, value * e.u, std::exp(e.lower), std::exp(e.upper)};
  return p;
}

// Forces and compliance, by how differently the sizes of one tool come out.
std::vector<Factor> of_errors(const Plan& p, double confidence) {
  constexpr double kSetting_mm = 1;  // wider than any, so that it says nothing
  const double force = planning::passive_spread(p.part),
               compliance = p.part.machine.stiffness_uncertainty_pct / 100;
  if (!(force > 0) || !(compliance > 0)) return {};
  std::vector<Prior> prior{{0, force}, {0, compliance}};
  prior.resize(2 + p.tools.size(), {0, kSetting_mm});
  std::vector<Evidence> means;
  for (const Size& s : p.sizes) {
    const auto& trend = *s.learned->trend;
    if (!(trend.mean_mm.u > 0)) continue;
    Evidence e{std::vector<double>(prior.size(), 0), 0, trend.mean_mm.u};
    e.effects[0] = s.effect->by_force_mm;
    e.effects[1] = s.effect->by_compliance_mm;
    const auto tool = std::ranges::find(p.tools, s.effect->tool) - p.tools.begin();
    e.effects[2 + static_cast<std::size_t>(tool)] = 1;
    double offset = 0;
    for (const auto& o : s.learned->kept)
      offset += o.offset_mm / static_cast<double>(s.learned->kept.size());
    const double middle = (s.of->limits.upper_mm + *s.of->limits.lower_mm) / 2;
    e.value = trend.mean_mm.value - offset - middle - s.effect->made_mm;
    means.push_back(std::move(e));
  }
  const auto all = learning::posterior(prior, means, confidence);
  constexpr const char* kTakes =
      to_translate("two diameters of one tool, at places that yield differently");
  return {{"passive_force", "-", 1, force, exponential(all[0]), kTakes},
          {"compliance", "-", 1, compliance, exponential(all[1]), kTakes}};
}

double hours_between_corrections(const Plan& p) {
  double parts = HUGE_VAL;
  for (const Size& s : p.sizes)
    if (s.effect->edges_per_part > 0)
      parts =
          std::min(parts, p.part.shop.life_between_offsets / s.effect->edges_per_part);
  return p.cycle_h() * (std::isfinite(parts) ? std::max(1.0, std::floor(parts)) : 1);
}

void add_slopes(const Plan& p, const Size& s, std::vector<Evidence>& slopes) {
  const auto& t = *s.learned->trend;
  const double per_at = s.learned->made.timed ? 1 : p.cycle_h();  // hours
  const double step_h = learning::next_part(s.learned->kept).step * per_at;
  const double w0 = s.effect->wear_mm_part;
  if (t.drift && t.wear && t.drift->u > 0 && t.wear->u > 0) {
    const double rho = t.covariance[1][2] / (t.drift->u * t.wear->u);
    for (auto& e : learning::uncorrelated({{2 * per_at, 0}, t.drift->value, t.drift->u},
                                          {{0, w0}, t.wear->value, t.wear->u}, rho))
      slopes.push_back(std::move(e));
  } else if (t.wear && t.wear->u > 0) {
    slopes.push_back({{2 * step_h, w0}, t.wear->value, t.wear->u});
  } else if (t.drift && t.drift->u > 0 && step_h > 0) {
    slopes.push_back({{2 * per_at, w0 * per_at / step_h}, t.drift->value, t.drift->u});
  }
}

// Drift of the edge against the spindle [mm/h], and wear as a factor.
std::vector<Factor> of_slopes(const Plan& p, double confidence) {
  const auto& m = p.part.material;
  const double tau = hours_between_corrections(p);
  const double drift = 2 * units::mm_from_um(p.part.shop.drift_um) / tau;
  const double wear =
      std::min(1.0, m.taylor_uncertainty_pct / 100 / std::max(m.taylor.n, 0.01));
  if (!(drift > 0) || !(wear > 0)) return {};
  const std::vector<Prior> prior{{0, drift}, {1, wear}};
  std::vector<Evidence> slopes;
  for (const Size& s : one_of_each_tool(p)) add_slopes(p, s, slopes);
  const auto all = learning::posterior(prior, slopes, confidence);
  return {{"drift", "mm/h", 0, drift, all[0], to_translate("parts over more hours")},
          {"wear", "-", 1, wear, all[1],
           to_translate("the column edge, and edges used for more of their life")}};
}

double budget_u(const json& machine) {
  constexpr double kEstimate = 0.5, kLeast = 0.05;
  if (!machine.contains("budget")) return kEstimate;
  return std::max(kLeast, machine["budget"]["uncertainty_pct"].get<double>() / 100);
}

std::vector<Factor> of_scatter(const Plan& p, double relative_u, double confidence) {
  const double prior = p.part.shop.repeatability_um;
  if (!(prior > 0)) return {};
  double squares = 0, degrees = 0;
  for (const Size& s : one_of_each_tool(p)) {
    const auto& t = *s.learned->trend;
    squares += t.degrees * sqr(units::um_from_mm(t.s_mm) / 2);
    degrees += t.degrees;
  }
  return {{"repeatability", "um", prior, prior * relative_u,
           learning::posterior(learning::scatter_prior(prior, relative_u), squares,
                               degrees, confidence),
           to_translate("more values of a size")}};
}

// The member of the budget's re-chucking by which the setup holds the part.
const char* held_by(const Plan& p, std::size_t setup) {
  if (p.plan.setups[setup].clamping == planning::Clamping::between_centres)
    return "centres";
  switch (p.part.setups[setup].jaws) {
    case planning::Jaws::hard:
      return "hard_jaws";
    case planning::Jaws::soft:
      return "soft_jaws";
    case planning::Jaws::collet:
      return "collet";
  }
  return "hard_jaws";
}

double prior_um(const catalogue::Rechucking& r, const std::string& by) {
  if (by == "centres") return r.centres_um;
  if (by == "collet") return r.collet_um;
  return by == "soft_jaws" ? r.soft_jaws_um : r.hard_jaws_um;
}

/// Re-chucking by the member of the budget that it is.
using Rechucked = std::map<std::string, Factor>;

// Of run-outs to a single datum that another setup cuts, the one with the most values.
Rechucked of_run_outs(const Request& q, const Plan& p, const std::vector<Learned>& all,
                      double relative_u, double confidence) {
  std::map<std::string, const learning::Series*> most;
  const auto& tolerances = p.part.drawing.tolerances;
  for (std::size_t c = 0; c < all.size(); ++c) {
    const auto t =
        std::ranges::find(tolerances, q.characteristics[c].id, &part::Tolerance::id);
    if (t == tolerances.end() || all[c].kept.empty() || t->datum.empty() ||
        !t->common_datum.empty() ||
        part::facts(t->kind).rechucked != part::Rechucked::run_out)
      continue;
    const auto a = planning::setup_of(p.part, t->of),
               b = planning::setup_of(p.part, t->datum);
    if (!a || !b || *a == *b) continue;
    auto& series = most[held_by(p, std::max(*a, *b))];
    if (!series || series->size() < all[c].kept.size()) series = &all[c].kept;
  }
  Rechucked out;
  for (const auto& [by, series] : most) {
    const double prior = prior_um(p.part.shop.rechucking, by);
    if (!(prior > 0)) continue;
    double squares = 0;
    for (const auto& o : *series) squares += sqr(units::um_from_mm(o.y_mm) / 2);
    out.emplace(by, Factor{"rechucking", "um", prior, prior * relative_u,
                           learning::posterior(
                               learning::scatter_prior(prior, relative_u), squares,
                               2 * static_cast<double>(series->size()), confidence),
                           to_translate("more parts")});
  }
  return out;
}

/// Documents as the plan used them, with what was learned.
class Documents {
 public:
  Documents(const Request& q, const Plan& p, const Catalogue& catalogue,
            std::size_t parts)
      : source_(say("learned from {} parts of {}", parts, p.part.drawing.name)),
        material_(
            document(q, "material", catalogue.material_documents, p.part.material.id)),
        machine_(document(q, "machine", catalogue.machine_documents, p.part.machine.id)) {
  }

  const json& machine() const { return machine_; }

  void put_force(const planning::PreparedPart& part, const Estimate& by) {
    changed_material_ = true;
    const auto t = catalogue::thrust_of(part.material);
    const double pct = std::min(100.0, 100 * by.u / by.value);
    json& group = material_["thrust"];
    group = {{"ratio", by.value * t.ratio},
             {"edge_N_mm", by.value * t.edge_N_mm},
             {"land_MPa", by.value * t.land_MPa},
             {"uncertainty_pct", t.uncertainty_pct},
             {"total_uncertainty_pct", pct}};
    tell(group, say("F_D times {:.3f}", by.value));
    if (!material_.contains("feed_passive")) return;
    json& passive = material_["feed_passive"];
    passive["kp11_MPa"] = by.value * passive["kp11_MPa"].get<double>();
    passive["uncertainty_pct"] = pct;
    tell(passive, say("kp1.1 times {:.3f}", by.value));
  }

  void put_compliance(const Estimate& by) {
    changed_machine_ = true;
    json& group = machine_["stiffness"];
    for (auto& [key, value] : group.items()) {
      if (value.is_object())
        for (auto& x : value) x = by.value * x.get<double>();
      else if (key.find("_mm_N") != std::string::npos)
        value = by.value * value.get<double>();
    }
    group["uncertainty_pct"] = std::min(100.0, 100 * by.u / by.value);
    tell(group, say("compliances times {:.3f}", by.value));
  }

  // Wear omega times as fast is a life 1/omega as long.
  void put_wear(const Estimate& by) {
    changed_material_ = true;
    json& group = material_["taylor"];
    const double n = group["n"];
    group["C"] = group["C"].get<double>() * std::pow(by.value, -n);
    group["uncertainty_pct"] = std::min(100.0, 100 * n * by.u / by.value);
    tell(group, say("edges wear {:.3f} times as fast as before", by.value));
  }

  void put_budget(const std::string& key, double um) { budget_[key] = um; }
  void put_rechucking(const std::string& by, double um) { rechucking_[by] = um; }

  ordered_json all(const catalogue::ShopBudget& given) {
    ordered_json out = ordered_json::object();
    if (!budget_.empty() || !rechucking_.empty()) write_budget(given);
    if (changed_material_) out["material"] = material_;
    if (changed_machine_) out["machine"] = machine_;
    if (!budget_.empty()) out["budget"] = budget_;
    return out;
  }

 private:
  static json document(const Request& q, const char* key,
                       const std::map<std::string, json>& known, const std::string& id) {
    const json& part = q.part_document;
    if (part.contains(key) && part[key].is_object()) return part[key];
    return known.at(id);
  }

  void tell(json& group, const std::string& what) const {
    const std::string before = group.value("source", "");
    group["source"] = source_;
    group["note"] =
        shortened(what + (before.empty() ? "" : say("; before: {}", before)), 1900);
  }

  void write_budget(const catalogue::ShopBudget& b) {
    changed_machine_ = true;
    json& group = machine_["budget"];
    if (group.is_null())
      group = {{"rechucking_um",
                {{"hard_jaws", b.rechucking.hard_jaws_um},
                 {"soft_jaws", b.rechucking.soft_jaws_um},
                 {"collet", b.rechucking.collet_um},
                 {"centres", b.rechucking.centres_um}}},
               {"drift_um", b.drift_um},
               {"drift_axial_um", b.drift_axial_um},
               {"repeatability_um", b.repeatability_um},
               {"part_warm_K", b.part_warm_K},
               {"life_between_offsets", b.life_between_offsets},
               {"uncertainty_pct", 50}};
    std::string names;
    for (const auto& [key, um] : budget_.items()) {
      group[key] = um;
      names += (names.empty() ? "" : ", ") + key;
    }
    for (const auto& [key, um] : rechucking_.items()) {
      group["rechucking_um"][key] = um;
      names += (names.empty() ? "" : ", ") + key;
    }
    tell(group, say("learned: {}", names));
  }

  std::string source_;
  json material_, machine_, budget_ = json::object(), rechucking_ = json::object();
  bool changed_material_ = false, changed_machine_ = false;
};

void write(const Plan& p, const std::vector<Factor>& factors, const Rechucked& rechucked,
           Documents& documents, std::vector<std::string>& warnings) {
  constexpr double kFar = 2, kSlow = 0.1;
  for (const auto& f : factors) {
    if (!f.posterior.identified) continue;
    const Estimate& e = f.posterior.factor;
    const std::string name = f.name;
    if (name == "passive_force" || name == "compliance") {
      if (e.value > kFar || e.value < 1 / kFar)
        warnings.push_back(
            say("{} is {:.2g} times what the documents say: effects are those of small "
                "changes, so learn again with the new documents",
                name, e.value));
      if (name == "compliance")
        documents.put_compliance(e);
      else
        documents.put_force(p.part, e);
    } else if (name == "wear") {
      if (e.value > kSlow)
        documents.put_wear(e);
      else
        warnings.emplace_back(
            tr("wear is not written: the sizes do not move as a worn edge moves them"));
    } else if (name == "drift") {
      const double um = units::um_from_mm(std::hypot(e.value, e.u));
      documents.put_budget("drift_um",
                           std::min(1000.0, um * hours_between_corrections(p) / 2));
    } else {
      documents.put_budget("repeatability_um", std::min(1000.0, e.value));
    }
  }
  for (const auto& [by, f] : rechucked)
    if (f.posterior.identified)
      documents.put_rechucking(by, std::min(1000.0, f.posterior.factor.value));
}

}  // namespace

Updated updated(const Request& q, const std::vector<Learned>& all,
                const Catalogue& catalogue) {
  Updated out{ordered_json::array(), ordered_json::object(), {}};
  Plan p{q.part->part, planning::plan(q.part->part), {}, {}, {}};
  p.effects = planning::factor_effects(p.part, p.plan);
  p.sizes = measured_sizes(q, all, p.effects);
  for (const Size& s : p.sizes)
    if (std::ranges::find(p.tools, s.effect->tool) == p.tools.end())
      p.tools.push_back(s.effect->tool);
  if (p.sizes.empty()) {
    out.warnings.emplace_back(
        tr("no factor is updated: none of the values is a diameter that the part's plan "
           "finishes"));
    return out;
  }
  std::size_t parts = 0;
  for (const Size& s : p.sizes) parts = std::max(parts, s.learned->kept.size());
  Documents documents(q, p, catalogue, parts);
  const double relative_u = budget_u(documents.machine());
  std::vector<Factor> factors;
  for (auto& some : {of_errors(p, q.confidence), of_slopes(p, q.confidence),
                     of_scatter(p, relative_u, q.confidence)})
    factors.insert(factors.end(), some.begin(), some.end());
  const auto rechucked = of_run_outs(q, p, all, relative_u, q.confidence);
  for (const auto& f : factors) out.factors.push_back(described(f));
  for (const auto& [by, f] : rechucked) {
    out.factors.push_back(described(f));
    out.factors.back()["by"] = by;
  }
  write(p, factors, rechucked, documents, out.warnings);
  out.documents = documents.all(p.part.machine.budget);
  return out;
}

}  // namespace turnwright::document::measured_parts
