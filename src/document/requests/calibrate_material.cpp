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
#include "turnwright/cutting/material_fit.hpp"

namespace turnwright::document {
namespace {

using cutting::Estimate;
using cutting::Evidence;
using nlohmann::json;

constexpr std::size_t kCuts = 2000;
// Usual for turning with carbide (handbook values), where no material gives its own.
constexpr double kUsual_a = 0.35, kUsual_b = 0.15;
const Bounds kForce = above_up_to(0, 1e6, "N");

/// A force component: its column, its constants in the result and in a material.
struct Component {
  const char *column, *group, *k11, *m;
};
constexpr std::array<Component, 3> kComponents{{{"Fc_N", "cutting", "kc11_MPa", "mc"},
                                                {"Ff_N", "feed", "kf11_MPa", "mf"},
                                                {"Fp_N", "passive", "kp11_MPa", "mp"}}};

struct Cut {
  double vc_m_min = 0, f_mm_rev = 0, ap_mm = 0;
  double h_mm = 0, b_mm = 0;
  std::array<std::optional<double>, 3> F_N;
  std::optional<double> T_min;
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
  std::optional<std::string> id, name;
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
  if (!c.T_min &&
      std::ranges::none_of(c.F_N, [](const auto& F) { return F.has_value(); }))
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

  cutting::Cut edge;
  edge.corner = cutting::corner_of(q.tool.re_mm, units::rad_from_deg(q.tool.kapr_deg));
  for (Cut& c : q.cuts) {
    c.b_mm = cutting::engaged_edge_mm(edge, c.ap_mm, c.f_mm_rev);
    c.h_mm = c.ap_mm * c.f_mm_rev / c.b_mm;
  }
  return q;
}

/// A fit and the cuts it was made from.
template <class Fit>
struct Fitted {
  Fit fit;
  std::vector<std::size_t> cuts;  // of the request, in the order of the fit's points

  std::vector<std::size_t> named(const std::vector<std::size_t>& points) const {
    std::vector<std::size_t> out;
    for (const std::size_t i : points) out.push_back(cuts[i]);
    return out;
  }
};
using Kienzle = Fitted<cutting::KienzleFit>;
using Taylor = Fitted<cutting::TaylorFit>;

struct Fits {
  std::array<std::optional<Kienzle>, 3> forces;
  std::optional<Taylor> lives;
};

std::optional<Kienzle> forces(const FitRequest& q, std::size_t component) {
  Kienzle out;
  std::vector<cutting::ForcePoint> points;
  for (std::size_t i = 0; i < q.cuts.size(); ++i)
    if (const auto& F = q.cuts[i].F_N[component]) {
      points.push_back({q.cuts[i].h_mm, q.cuts[i].b_mm, *F});
      out.cuts.push_back(i);
    }
  if (points.empty()) return std::nullopt;
  out.fit = cutting::fit_kienzle(points, q.options);
  return out;
}

std::optional<Taylor> lives(const FitRequest& q) {
  Taylor out;
  std::vector<cutting::LifePoint> points;
  for (std::size_t i = 0; i < q.cuts.size(); ++i)
    if (const Cut& c = q.cuts[i]; c.T_min) {
      points.push_back({c.vc_m_min, c.f_mm_rev, c.ap_mm, *c.T_min});
      out.cuts.push_back(i);
    }
  if (points.empty()) return std::nullopt;
  out.fit = cutting::fit_taylor(points, q.given_a, q.given_b, q.options);
  return out;
}

/// Reports the constants that the cuts with a measured `column` do not determine.
void refuse(const FitRequest& q, std::size_t cuts, const std::string& column,
            const std::string& constants, const std::string& test, Problems& problems) {
  problems.add(
      {q.cuts_pointer,
       std::to_string(cuts) + " cuts with " + column + " that cannot tell " + constants,
       test, "identifiability"});
}

Fits fitted(const FitRequest& q, Problems& problems) {
  Fits all;
  for (std::size_t k = 0; k < kComponents.size(); ++k) {
    all.forces[k] = forces(q, k);
    const Component& c = kComponents[k];
    if (all.forces[k] && !all.forces[k]->fit.m)
      refuse(q, all.forces[k]->cuts.size(), c.column, std::string(c.k11) + " and " + c.m,
             all.forces[k]->fit.missing[0].test, problems);
  }
  all.lives = lives(q);
  if (all.lives && !all.lives->fit.n)
    refuse(q, all.lives->cuts.size(), "T_min", "n and C", all.lives->fit.missing[0].test,
           problems);
  problems.throw_if_any();
  return all;
}

json described(const Estimate& e) {
  return {{"value", e.value}, {"lower", e.lower}, {"upper", e.upper}};
}

template <class Fit>
json described(const Fitted<Fit>& f) {
  const Evidence& e = f.fit.evidence;
  return {{"cuts", e.used.size()},
          {"outliers", f.named(e.outliers)},
          {"degrees_of_freedom", e.degrees_of_freedom},
          {"s_pct", 100 * e.s}};
}

json described(const Taylor& t, const FitRequest& q) {
  json out = described<cutting::TaylorFit>(t);
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
template <class Fit, class Value>
json range(const FitRequest& q, const Fitted<Fit>& f, const Value& value) {
  double lo = HUGE_VAL, hi = 0;
  for (const std::size_t i : f.named(f.fit.evidence.used)) {
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

void put_forces(const FitRequest& q, const Fits& fits, json& m) {
  if (const auto& c = fits.forces[0]) {
    m["kienzle"] = {
        {"kc11_MPa", c->fit.k11_MPa->value},
        {"mc", c->fit.m->value},
        {"h_mm", range(q, *c, [](const Cut& x) { return x.h_mm; })},
        {"vc_m_min", range(q, *c, [](const Cut& x) { return x.vc_m_min; })},
        {"kapr_deg", q.tool.kapr_deg},
        {"rake_deg", q.tool.rake_deg},
        {"uncertainty_pct", percent(c->fit.evidence.s_prediction)},
        {"source", q.source},
        {"note", note(q, c->fit.evidence,
                      told("kc11_MPa", *c->fit.k11_MPa) + ", " + told("mc", *c->fit.m))}};
  }
  if (const auto& f = fits.forces[1], &p = fits.forces[2]; f && p)
    m["feed_passive"] = {
        {"kf11_MPa", f->fit.k11_MPa->value},
        {"mf", f->fit.m->value},
        {"kp11_MPa", p->fit.k11_MPa->value},
        {"mp", p->fit.m->value},
        {"uncertainty_pct",
         percent(std::max(f->fit.evidence.s_prediction, p->fit.evidence.s_prediction))},
        {"source", q.source}};
}

void put_life(const FitRequest& q, const Taylor& t, json& m) {
  const double n = t.fit.n->value;
  m["taylor"] = {
      {"C", t.fit.C->value},
      {"n", n},
      {"a", t.fit.a ? t.fit.a->value : q.given_a},
      {"b", t.fit.b ? t.fit.b->value : q.given_b},
      {"tool", q.tool.name},
      {"vc_m_min", range(q, t, [](const Cut& x) { return x.vc_m_min; })},
      {"f_mm_rev", range(q, t, [](const Cut& x) { return x.f_mm_rev; })},
      {"ap_mm", range(q, t, [](const Cut& x) { return x.ap_mm; })},
      {"uncertainty_pct", percent(n * t.fit.evidence.s_prediction)},  // of C, not of T
      {"source", q.source},
      {"note",
       note(q, t.fit.evidence, told("C", *t.fit.C) + ", " + told("n", *t.fit.n))}};
}

/// The material's document with the measured constants; null, with the reason, if they
/// are impossible for a material.
json material(const FitRequest& q, const Fits& fits, json& warnings) {
  if (!q.material) {
    warnings.push_back("no material given, whose document the constants could go into");
    return nullptr;
  }
  json m = *q.material;
  if (q.id) m["id"] = *q.id;
  if (q.name) m["name"] = *q.name;
  put_forces(q, fits, m);
  if (fits.lives) put_life(q, *fits.lives, m);
  Problems problems{.document = "material"};
  read_material(Reader(m, problems));
  for (const Problem& p : problems.list)
    warnings.push_back("no material document: " + p.pointer + ": got " + p.got +
                       ", expected " + p.expected);
  return problems.list.empty() ? m : json();
}

void warn(const FitRequest& q, const Fits& fits, json& warnings) {
  if (fits.lives)
    for (const cutting::Missing& m : fits.lives->fit.missing)
      warnings.push_back(m.parameter + " stays at its given " +
                         rounded(m.parameter == "a" ? q.given_a : q.given_b) +
                         "; it takes " + m.test);
  if (fits.forces[1].has_value() != fits.forces[2].has_value())
    warnings.push_back(
        "feed_passive is not replaced: it takes both Ff_N and Fp_N of measured cuts");
}

}  // namespace

json calibrate_material(const json& request, const Catalogue& catalogue) {
  Problems problems{.document = "calibrate-material"};
  const FitRequest q = read_fit_request(request, catalogue, problems);
  const Fits fits = fitted(q, problems);
  json result{{"confidence", q.options.confidence}}, warnings = json::array();
  for (std::size_t k = 0; k < kComponents.size(); ++k) {
    if (!fits.forces[k]) continue;
    const Component& c = kComponents[k];
    json& group = result[c.group] = described(*fits.forces[k]);
    group[c.k11] = described(*fits.forces[k]->fit.k11_MPa);
    group[c.m] = described(*fits.forces[k]->fit.m);
  }
  if (fits.lives) result["taylor"] = described(*fits.lives, q);
  warn(q, fits, warnings);
  json chips = json::array();
  for (const Cut& c : q.cuts) chips.push_back({{"h_mm", c.h_mm}, {"b_mm", c.b_mm}});
  result["chips"] = std::move(chips);
  result["material"] = material(q, fits, warnings);
  result["warnings"] = std::move(warnings);
  return result;
}

}  // namespace turnwright::document
