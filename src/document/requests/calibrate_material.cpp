#include "turnwright/document/calibrate_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "document/catalogue/catalogue_readers.hpp"
#include "document/json/csv.hpp"
#include "document/json/fields.hpp"
#include "document/json/reference.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/cutting/cut.hpp"
#include "turnwright/cutting/force_fit.hpp"

namespace turnwright::document {
namespace {

using cutting::Estimate;
using cutting::Evidence;
using nlohmann::json;

constexpr std::size_t kCuts = 2000;
// Usual for turning with carbide (handbook values), where no material gives its own.
constexpr double kUsual_a = 0.35, kUsual_b = 0.15;
const Bounds kForce = above_up_to(0, 1e6, "N");

/// A force component: its column, its error in `left_out`, its constants in the result
/// and in a material.
struct Component {
  const char *column, *error, *group, *k11, *m;
};
constexpr std::array<Component, cutting::kComponents> kComponents{
    {{"Fc_N", "Fc_rms_pct", "cutting", "kc11_MPa", "mc"},
     {"Ff_N", "Ff_rms_pct", "feed", "kf11_MPa", "mf"},
     {"Fp_N", "Fp_rms_pct", "passive", "kp11_MPa", "mp"}}};
constexpr std::size_t kCutting = 0, kFeed = 1, kPassive = 2;

struct Cut {
  double vc_m_min = 0, f_mm_rev = 0, ap_mm = 0;
  double h_mm = 0, b_mm = 0;
  std::array<std::optional<double>, cutting::kComponents> F_N;
  std::optional<double> T_min;
  bool has_force() const {
    return std::ranges::any_of(F_N, [](const auto& F) { return F.has_value(); });
  }
};

struct Tool {
  std::string name;
  double re_mm = 0, kapr_deg = 0, rake_deg = 0;
};

struct FitRequest {
  std::string cuts_pointer, source;
  std::vector<Cut> cuts;
  Tool tool;
  std::optional<json> material;  ///< the document to start from
  std::optional<catalogue::Material> base;
  std::optional<std::string> id, name;
  cutting::Cut edge;  ///< the tool in the material as it was given
  double given_a = kUsual_a, given_b = kUsual_b;
  cutting::FitOptions options;
};

Tool read_tool_used(Reader r) {
  Bounds kapr = above_up_to(0, 120, "deg");
  Tool t{.name = r.text("name"),
         .re_mm = r.number("re_mm", within(0, 100, "mm")),
         .kapr_deg = r.number("kapr_deg", kapr),
         .rake_deg = r.number("rake_deg", within(-30, 45, "deg"))};
  r.finish();
  return t;
}

Cut read_cut(Reader r) {
  r = r.as_object();
  Cut c{.vc_m_min = r.number("vc_m_min", above_up_to(0, 5000, "m/min")),
        .f_mm_rev = r.number("f_mm_rev", above_up_to(0, 5, "mm/rev")),
        .ap_mm = r.number("ap_mm", above_up_to(0, 50, "mm")),
        .F_N = {},
        .T_min = {}};
  for (std::size_t k = 0; k < kComponents.size(); ++k)
    c.F_N[k] = r.optional_number(kComponents[k].column, kForce);
  c.T_min = r.optional_number("T_min", above_up_to(0, 1e6, "min"));
  if (!c.T_min && !c.has_force())
    r.problem("a measured Fc_N, Ff_N, Fp_N or T_min", "missing");
  r.finish();
  return c;
}

void read_cuts(Reader& r, FitRequest& q) {
  const bool csv = r.has("csv");
  if (csv && r.has("cuts")) {
    r.problem_at("csv", "either cuts or csv", "conflict");
    return;
  }
  q.cuts_pointer = csv ? "/csv" : "/cuts";
  if (!csv) {
    for (const Reader& item : r.items("cuts", 1, kCuts)) q.cuts.push_back(read_cut(item));
    return;
  }
  const auto optional = [](const char* name) {
    return CsvColumn{.name = name, .required = false};
  };
  const auto rows = csv_rows(r.at("csv"),
                             {{.name = "vc_m_min"},
                              {.name = "f_mm_rev"},
                              {.name = "ap_mm"},
                              optional("Fc_N"),
                              optional("Ff_N"),
                              optional("Fp_N"),
                              optional("T_min")},
                             OtherColumns::refused, kCuts);
  for (const CsvRow& row : rows)
    q.cuts.push_back(read_cut(Reader(row.value, r.problems(), row.pointer)));
}

void read_base(Reader& r, const Catalogue& catalogue, FitRequest& q) {
  const auto value = r.find("material");
  if (!value) return;
  if (value->is_object()) {
    q.material = value->json();
  } else {
    std::vector<std::string> ids;
    for (const auto& entry : catalogue.material_documents) ids.push_back(entry.first);
    const auto id = checked_reference(*value, ids, "a material of the catalogue");
    const auto found = catalogue.material_documents.find(id);
    if (found == catalogue.material_documents.end()) return;
    q.material = found->second;
  }
  const catalogue::Material base =
      read_material(Reader(*q.material, r.problems(), value->pointer()));
  q.given_a = base.taylor.a;
  q.given_b = base.taylor.b;
  q.base = base;
}

FitRequest read_fit_request(const json& document, const Catalogue& catalogue,
                            Problems& problems) {
  Reader r = Reader(document, problems).as_object();
  FitRequest q;
  read_format(r, "turnwright-calibrate-material/1");
  read_base(r, catalogue, q);
  if (r.has("id")) q.id = read_id(r);
  q.name = r.optional_text("name");
  q.source = r.text_or("source", "measured cuts of the own shop", 1000);
  q.tool = read_tool_used(r.object("tool"));
  Bounds confidence = within(0.5, 0.999);
  q.options.confidence = r.number_or("confidence", confidence, q.options.confidence);
  q.options.outlier_p = r.number_or("outlier_p", within(0, 0.5), q.options.outlier_p);
  read_cuts(r, q);
  r.finish();
  problems.throw_if_any();

  catalogue::Tool tool;
  tool.re_mm = q.tool.re_mm;
  tool.kapr_deg = q.tool.kapr_deg;
  tool.gamma_deg = q.tool.rake_deg;
  q.edge = cutting::cut_of(q.base.value_or(catalogue::Material{}), tool);
  for (Cut& c : q.cuts) {
    c.b_mm = cutting::engaged_edge_mm(q.edge, c.ap_mm, c.f_mm_rev);
    c.h_mm = c.ap_mm * c.f_mm_rev / c.b_mm;
  }
  return q;
}

struct Lives {
  cutting::TaylorFit fit;
  std::vector<std::size_t> cuts;  // of the request, in the order of the fit's points
};

struct Fits {
  std::optional<cutting::ForceFit> forces;
  std::optional<Lives> lives;
  std::vector<Problem> undetermined;  // constants that the cuts do not tell
};

std::optional<cutting::ForceFit> forces(const FitRequest& q) {
  std::vector<cutting::MeasuredCut> cuts;
  for (const Cut& c : q.cuts) cuts.push_back({c.ap_mm, c.f_mm_rev, c.F_N});
  if (std::ranges::none_of(q.cuts, &Cut::has_force)) return std::nullopt;
  return cutting::fit_forces(cuts, q.edge, q.options);
}

std::optional<Lives> lives(const FitRequest& q) {
  Lives out;
  std::vector<cutting::LifePoint> points;
  for (std::size_t i = 0; i < q.cuts.size(); ++i)
    if (const Cut& c = q.cuts[i]; c.T_min) {
      points.push_back({c.vc_m_min, c.f_mm_rev, c.ap_mm, *c.T_min});
      out.cuts.push_back(i);
    }
  if (points.empty()) return std::nullopt;
  out.fit = cutting::fit_taylor(points, q.given_a, q.given_b, q.options);
  out.fit.evidence.rename(out.cuts);
  return out;
}

Problem undetermined(const FitRequest& q, std::size_t cuts, const std::string& column,
                     const std::string& constants, const std::string& test) {
  return {
      q.cuts_pointer,
      std::to_string(cuts) + " cuts with " + column + " that cannot tell " + constants,
      test, "identifiability"};
}

std::size_t measured(const FitRequest& q, std::size_t component) {
  return static_cast<std::size_t>(std::ranges::count_if(
      q.cuts, [&](const Cut& c) { return c.F_N[component].has_value(); }));
}

/// All that the cuts determine.  What they do not is listed; it is a refusal only if
/// nothing else is left.
Fits fitted(const FitRequest& q, Problems& problems) {
  Fits all{.forces = forces(q), .lives = lives(q), .undetermined = {}};
  bool some = all.forces && all.forces->law != cutting::ThrustLaw::none;
  for (std::size_t k = 0; all.forces && k < kComponents.size(); ++k) {
    const auto& fit = all.forces->kienzle[k];
    const Component& c = kComponents[k];
    if (fit && !fit->m)
      all.undetermined.push_back(undetermined(q, measured(q, k), c.column,
                                              std::string(c.k11) + " and " + c.m,
                                              fit->missing[0].test));
    some = some || (fit && fit->m);
  }
  if (all.lives && !all.lives->fit.n)
    all.undetermined.push_back(undetermined(q, all.lives->cuts.size(), "T_min", "n and C",
                                            all.lives->fit.missing[0].test));
  some = some || (all.lives && all.lives->fit.n);
  if (!some)
    for (const Problem& p : all.undetermined) problems.add(p);
  problems.throw_if_any();
  return all;
}

json described(const Estimate& e) {
  return {{"value", e.value}, {"lower", e.lower}, {"upper", e.upper}};
}

json described(const Evidence& e) {
  return {{"cuts", e.used.size()},
          {"outliers", e.outliers},
          {"degrees_of_freedom", e.degrees_of_freedom},
          {"s_pct", 100 * e.s}};
}

json described(const cutting::ThrustFit& t) {
  json out = described(t.evidence);
  out["ratio"] = described(*t.ratio);
  out["edge_N_mm"] = described(*t.edge_N_mm);
  out["scaled"] = t.scaled;
  return out;
}

json described(const cutting::LeftOut& l) {
  json out{{"ap_mm", l.ap_mm}};
  for (std::size_t k = 0; k < kComponents.size(); ++k)
    if (l.rms[k]) out[kComponents[k].error] = 100 * *l.rms[k];
  return out;
}

json described(const Lives& t, const FitRequest& q) {
  json out = described(t.fit.evidence);
  out["C"] = described(*t.fit.C);
  out["n"] = described(*t.fit.n);
  const auto exponent = [&](const char* key, const std::optional<Estimate>& e,
                            double given) {
    out[key] = e ? described(*e) : json{{"value", given}, {"given", true}};
  };
  exponent("a", t.fit.a, q.given_a);
  exponent("b", t.fit.b, q.given_b);
  return out;
}

/// [least, largest] of `value` over the cuts used.
template <class Value>
json range(const FitRequest& q, const Evidence& e, const Value& value) {
  double lo = HUGE_VAL, hi = 0;
  for (const std::size_t i : e.used) {
    lo = std::min(lo, value(q.cuts[i]));
    hi = std::max(hi, value(q.cuts[i]));
  }
  return {lo, hi};
}

std::string rounded(double x) { return fmt::format("{:.4g}", x); }
std::string told(const char* key, const Estimate& e) {
  return std::string(key) + ' ' + rounded(e.lower) + " to " + rounded(e.upper);
}
std::string note(const FitRequest& q, const Evidence& e, const std::string& intervals) {
  return std::to_string(e.used.size()) + " cuts, " + rounded(100 * q.options.confidence) +
         " % intervals: " + intervals;
}
double percent(double s) { return 100 * s; }

/// A group of a material's document, from measured cuts.
json group(const FitRequest& q, double uncertainty_pct, json constants) {
  constants["uncertainty_pct"] = std::min(100.0, uncertainty_pct);
  constants["source"] = q.source;
  return constants;
}

json kienzle(const FitRequest& q, const cutting::KienzleFit& c) {
  const Evidence& e = c.evidence;
  return group(
      q, percent(e.s_prediction),
      {{"kc11_MPa", c.k11_MPa->value},
       {"mc", c.m->value},
       {"h_mm", range(q, e, [](const Cut& x) { return x.h_mm; })},
       {"vc_m_min", range(q, e, [](const Cut& x) { return x.vc_m_min; })},
       {"kapr_deg", q.tool.kapr_deg},
       {"rake_deg", q.tool.rake_deg},
       {"note", note(q, e, told("kc11_MPa", *c.k11_MPa) + ", " + told("mc", *c.m))}});
}

/// The scatter of the next cut, or what cuts of another depth were off by, if that is
/// more.
double thrust_uncertainty_pct(const cutting::ForceFit& f, double s_prediction) {
  double most = s_prediction;
  for (const auto& l : f.left_out) most = std::max(most, l.rms[kPassive].value_or(0));
  return percent(most);
}

json thrust(const FitRequest& q, const cutting::ForceFit& f) {
  const auto& t = *f.thrust;
  return group(
      q, thrust_uncertainty_pct(f, t.evidence.s_prediction),
      {{"ratio", t.ratio->value},
       {"edge_N_mm", t.edge_N_mm->value},
       {"land_MPa", catalogue::thrust_of(*q.base).land_MPa},
       {"note", note(q, t.evidence,
                     told("ratio", *t.ratio) + ", " + told("edge_N_mm", *t.edge_N_mm))}});
}

json feed_passive(const FitRequest& q, const cutting::ForceFit& f) {
  const auto &feed = *f.kienzle[kFeed], &passive = *f.kienzle[kPassive];
  return group(q,
               thrust_uncertainty_pct(f, std::max(feed.evidence.s_prediction,
                                                  passive.evidence.s_prediction)),
               {{"kf11_MPa", feed.k11_MPa->value},
                {"mf", feed.m->value},
                {"kp11_MPa", passive.k11_MPa->value},
                {"mp", passive.m->value}});
}

json taylor(const FitRequest& q, const Lives& t) {
  const double n = t.fit.n->value;
  const Evidence& e = t.fit.evidence;
  return group(q, percent(n * e.s_prediction),  // of C, not of T
               {{"C", t.fit.C->value},
                {"n", n},
                {"a", t.fit.a ? t.fit.a->value : q.given_a},
                {"b", t.fit.b ? t.fit.b->value : q.given_b},
                {"tool", q.tool.name},
                {"vc_m_min", range(q, e, [](const Cut& x) { return x.vc_m_min; })},
                {"f_mm_rev", range(q, e, [](const Cut& x) { return x.f_mm_rev; })},
                {"ap_mm", range(q, e, [](const Cut& x) { return x.ap_mm; })},
                {"note", note(q, e, told("C", *t.fit.C) + ", " + told("n", *t.fit.n))}});
}

/// Puts a group into the document; where a material cannot have it, the document stays
/// and a warning says why.
bool put(const char* name, json value, json& m, json& warnings) {
  json changed = m;
  changed[name] = std::move(value);
  Problems problems{.document = "material"};
  read_material(Reader(changed, problems));
  for (const Problem& p : problems.list)
    warnings.push_back(std::string(name) + " is not replaced: " + p.pointer + ": got " +
                       p.got + ", expected " + p.expected);
  if (!problems.list.empty()) return false;
  m = std::move(changed);
  return true;
}

struct Written {
  json material;              ///< with the measured constants; null without one given
  const char* law = nullptr;  ///< of feed and passive force that goes into it, or would
};

Written written(const FitRequest& q, const Fits& fits, json& warnings) {
  using cutting::ThrustLaw;
  const auto& f = fits.forces;
  const auto law = f ? f->law : ThrustLaw::none;
  const bool direction = law == ThrustLaw::direction;
  const char* name = direction ? "thrust" : "feed_passive";
  if (!q.material) {
    warnings.push_back("no material given, whose document the constants could go into");
    return {nullptr, law == ThrustLaw::none ? nullptr : name};
  }
  Written w{*q.material};
  json& m = w.material;
  if (q.id) m["id"] = *q.id;
  if (q.name) m["name"] = *q.name;
  if (f && f->kienzle[kCutting] && f->kienzle[kCutting]->m)
    put("kienzle", kienzle(q, *f->kienzle[kCutting]), m, warnings);
  if (law != ThrustLaw::none &&
      put(name, direction ? thrust(q, *f) : feed_passive(q, *f), m, warnings)) {
    w.law = name;
    if (direction) m.erase("feed_passive");
  }
  if (fits.lives && fits.lives->fit.n) put("taylor", taylor(q, *fits.lives), m, warnings);
  return w;
}

void warn(const FitRequest& q, const Fits& fits, json& warnings) {
  for (const Problem& p : fits.undetermined)
    warnings.push_back("not determined: " + p.got + "; it takes " + p.expected);
  if (fits.forces && fits.forces->law == cutting::ThrustLaw::none &&
      measured(q, kFeed) + measured(q, kPassive) > 0)
    warnings.push_back(
        "not determined: the thrust force; it takes a known kc1.1 and three "
        "cuts with Fp_N that flow at less than 70 deg to the radius, or "
        "with Ff_N that flow at more than 20 deg");
  if (fits.lives && fits.lives->fit.n)
    for (const cutting::Missing& m : fits.lives->fit.missing)
      warnings.push_back(m.parameter + " stays at its given " +
                         rounded(m.parameter == "a" ? q.given_a : q.given_b) +
                         "; it takes " + m.test);
  if (fits.forces && fits.forces->law == cutting::ThrustLaw::direction &&
      fits.forces->thrust->scaled)
    warnings.push_back(
        "the cuts do not tell ratio and edge_N_mm of thrust apart: both "
        "are the given ones times one number; it takes cuts with Fp_N at "
        "feeds further apart");
}

}  // namespace

json calibrate_material(const json& request, const Catalogue& catalogue) {
  Problems problems{.document = "calibrate-material"};
  const FitRequest q = read_fit_request(request, catalogue, problems);
  const Fits fits = fitted(q, problems);
  json result{{"confidence", q.options.confidence}}, warnings = json::array();
  for (std::size_t k = 0; fits.forces && k < kComponents.size(); ++k) {
    const auto& fit = fits.forces->kienzle[k];
    if (!fit || !fit->m) continue;
    const Component& c = kComponents[k];
    json& group = result[c.group] = described(fit->evidence);
    group[c.k11] = described(*fit->k11_MPa);
    group[c.m] = described(*fit->m);
  }
  if (fits.forces) {
    const auto& f = *fits.forces;
    if (f.thrust && f.thrust->ratio) result["thrust"] = described(*f.thrust);
    if (!f.left_out.empty()) {
      json& all = result["left_out"] = json::array();
      for (const auto& l : f.left_out) all.push_back(described(l));
    }
  }
  if (fits.lives && fits.lives->fit.n) result["taylor"] = described(*fits.lives, q);
  warn(q, fits, warnings);
  json chips = json::array();
  for (const Cut& c : q.cuts) chips.push_back({{"h_mm", c.h_mm}, {"b_mm", c.b_mm}});
  result["chips"] = std::move(chips);
  Written w = written(q, fits, warnings);
  if (w.law) result["feed_and_passive_by"] = w.law;
  result["material"] = std::move(w.material);
  result["warnings"] = std::move(warnings);
  return result;
}

}  // namespace turnwright::document
