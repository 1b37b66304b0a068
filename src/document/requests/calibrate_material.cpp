#include "turnwright/document/calibrate_material.hpp"

#include "calibrate_material_groups.hpp"

namespace turnwright::document {
namespace {

using cutting::Estimate;
using cutting::Evidence;
using material_calibration::Component;
using material_calibration::Fits;
using material_calibration::kComponents;
using material_calibration::Lives;
using material_calibration::Request;
using nlohmann::json;

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

void put_errors(json& out, const cutting::PredictionErrors& rms) {
  for (std::size_t k = 0; k < kComponents.size(); ++k)
    if (rms[k]) out[kComponents[k].error] = 100 * *rms[k];
}

json described(const cutting::LeftOut& l) {
  json out{{"ap_mm", l.ap_mm}};
  put_errors(out, l.rms);
  return out;
}

json described_percent(const Estimate& s) {
  return described(Estimate{100 * s.value, 100 * s.lower, 100 * s.upper});
}

json described(const cutting::LifeScatter& s) {
  json out{
      {"distribution",
       s.distribution == cutting::LifeDistribution::weibull ? "weibull" : "lognormal"},
      {"ln_likelihood_ratio", s.ln_likelihood_ratio},
      {"weibull_shape", s.weibull_shape},
      {"T50_min", described(s.T50_min)},
      {"T90_min", described(s.T90_min)},
      {"at", {{"vc_m_min", s.vc_m_min}, {"f_mm_rev", s.f_mm_rev}, {"ap_mm", s.ap_mm}}}};
  if (s.s_between) out["scatter_pct"] = described_percent(*s.s_between);
  if (s.s_lack_of_fit) {
    out["lack_of_fit_pct"] = 100 * *s.s_lack_of_fit;
    out["lack_of_fit_p"] = *s.lack_of_fit_p;
  }
  return out;
}

// What the wear curves say.
json lives_of_curves(const Lives& t, const Request& q) {
  json all = json::array();
  for (const std::size_t i : t.cuts)
    if (const auto& life = *q.cuts[i].life; life.from_wear)
      all.push_back(
          {{"cut", i}, {life.longer ? "T_longer_than_min" : "T_min", life.T_min}});
  return all;
}

json described(const Lives& t, const Request& q) {
  json out = described(t.fit.evidence);
  out["C"] = described(*t.fit.C);
  out["n"] = described(*t.fit.n);
  const auto exponent = [&](const char* key, const std::optional<Estimate>& e,
                            double given) {
    out[key] = e ? described(*e) : json{{"value", given}, {"given", true}};
  };
  exponent("a", t.fit.a, q.given_a);
  exponent("b", t.fit.b, q.given_b);
  if (t.censored > 0) out["censored"] = t.censored;
  if (t.scatter) out["edges"] = described(*t.scatter);
  if (json curves = lives_of_curves(t, q); !curves.empty())
    out["from_wear"] = std::move(curves);
  return out;
}

json described(const cutting::RoughnessFit& fit) {
  json out = described(fit.evidence);
  out["hmin_mm"] = described(*fit.hmin_mm);
  return out;
}

// Factors of the labs on each constant, and how much labs scatter.
void put_labs(const Request& q, const Fits& fits, json& result) {
  json each = json::array(), between = json::object();
  for (const auto& name : q.labs) each.push_back({{"lab", name}});
  const auto put = [&](const std::optional<cutting::Labs>& labs,
                       const std::string& factor, double per_measurement) {
    if (!labs) return;
    for (const auto& l : labs->each) {
      json& of_lab = each[l.lab][factor] = described(l.factor);
      of_lab["cuts"] = l.measurements;
    }
    between[factor + "_pct"] = 100 * per_measurement * labs->s_between;
  };
  for (std::size_t k = 0; fits.forces && k < kComponents.size(); ++k)
    if (const auto& fit = fits.forces->kienzle[k]; fit && fit->m)
      put(fit->labs, kComponents[k].factor, 1);
  if (fits.lives && fits.lives->fit.n)
    put(fits.lives->fit.labs, "C_factor", fits.lives->fit.n->value);
  result["labs"] = std::move(each);
  if (!between.empty()) result["between_labs"] = std::move(between);
}

void put_forces(const cutting::ForceFit& f, const Request& q, json& result) {
  for (std::size_t k = 0; k < kComponents.size(); ++k) {
    const auto& fit = f.kienzle[k];
    if (!fit || !fit->m) continue;
    const Component& c = kComponents[k];
    json& group = result[c.group] = described(fit->evidence);
    group[c.k11] = described(*fit->k11_MPa);
    group[c.m] = described(*fit->m);
  }
  if (f.thrust && f.thrust->ratio) result["thrust"] = described(*f.thrust);
  if (!f.left_out.empty()) {
    json& all = result["left_out"] = json::array();
    for (const auto& l : f.left_out) all.push_back(described(l));
  }
  if (f.left_out_replicas.empty()) return;
  json& all = result["left_out_replicas"] = json::array();
  for (const auto& l : f.left_out_replicas) {
    all.push_back({{"replica", q.replicas[l.replica]}});
    put_errors(all.back(), l.rms);
  }
}

}  // namespace

json calibrate_material(const json& request, const Catalogue& catalogue) {
  const Request q = material_calibration::read(request, catalogue);
  const Fits fits = material_calibration::fitted(q);
  json result{{"confidence", q.options.confidence}};
  if (fits.forces) put_forces(*fits.forces, q, result);
  if (fits.lives && fits.lives->fit.n) result["taylor"] = described(*fits.lives, q);
  if (fits.roughness && fits.roughness->hmin_mm)
    result["roughness"] = described(*fits.roughness);
  if (!q.labs.empty()) put_labs(q, fits, result);
  json warnings = material_calibration::warnings_of(q, fits);
  json chips = json::array();
  for (const auto& c : q.cuts) chips.push_back({{"h_mm", c.h_mm}, {"b_mm", c.b_mm}});
  result["chips"] = std::move(chips);
  auto w = material_calibration::written(q, fits, warnings);
  if (w.law) result["feed_and_passive_by"] = w.law;
  result["material"] = std::move(w.material);
  result["warnings"] = std::move(warnings);
  return result;
}

}  // namespace turnwright::document
