#include "calibrate_material_groups.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/say.hpp"
#include "document/catalogue/catalogue_readers.hpp"
#include "turnwright/base/distributions.hpp"

namespace turnwright::document::material_calibration {
namespace {

using cutting::Estimate;
using cutting::Evidence;
using nlohmann::json;

/// [least, largest] of `value` over the cuts used.
template <class Value>
json range(const Request& q, const Evidence& e, const Value& value) {
  double lo = HUGE_VAL, hi = 0;
  for (const std::size_t i : e.used) {
    lo = std::min(lo, value(q.cuts[i]));
    hi = std::max(hi, value(q.cuts[i]));
  }
  return {lo, hi};
}

std::string told(const char* key, const Estimate& e) {
  return say("{} {} to {}", std::string(key), rounded(e.lower), rounded(e.upper));
}
std::string note(const Request& q, const Evidence& e, const std::string& intervals) {
  return say("{} cuts, {} % intervals: {}", e.used.size(),
             rounded(100 * q.options.confidence), intervals);
}
double percent(double s) { return 100 * s; }

/// A group of a material's document, from measured cuts.
json group(const Request& q, double uncertainty_pct, json constants) {
  constants["uncertainty_pct"] = std::min(100.0, uncertainty_pct);
  constants["source"] = q.source;
  return constants;
}

json kienzle(const Request& q, const cutting::KienzleFit& c) {
  const Evidence& e = c.evidence;
  return group(
      q, percent(e.s_prediction),
      {{"kc11_MPa", c.k11_MPa->value},
       {"mc", c.m->value},
       {"h_mm", range(q, e, [](const MeasuredCut& x) { return x.h_mm; })},
       {"vc_m_min", range(q, e, [](const MeasuredCut& x) { return x.vc_m_min; })},
       {"kapr_deg", q.tool.kapr_deg},
       {"rake_deg", q.tool.rake_deg},
       {"note", note(q, e, told("kc11_MPa", *c.k11_MPa) + ", " + told("mc", *c.m))}});
}

/// The scatter of the next cut, or what cuts of another depth or replica were off by, if
/// that is more.
double thrust_uncertainty_pct(const cutting::ForceFit& f, double s_prediction) {
  double most = s_prediction;
  for (const auto& l : f.left_out) most = std::max(most, l.rms[kPassive].value_or(0));
  for (const auto& l : f.left_out_replicas)
    most = std::max(most, l.rms[kPassive].value_or(0));
  return percent(most);
}

json thrust(const Request& q, const cutting::ForceFit& f) {
  const auto& t = *f.thrust;
  return group(
      q, thrust_uncertainty_pct(f, t.evidence.s_prediction),
      {{"ratio", t.ratio->value},
       {"edge_N_mm", t.edge_N_mm->value},
       {"land_MPa", catalogue::thrust_of(*q.base).land_MPa},
       {"note", note(q, t.evidence,
                     told("ratio", *t.ratio) + ", " + told("edge_N_mm", *t.edge_N_mm))}});
}

json feed_passive(const Request& q, const cutting::ForceFit& f) {
  const auto &feed = *f.kienzle[kFeed], &passive = *f.kienzle[kPassive];
  return group(q,
               thrust_uncertainty_pct(f, std::max(feed.evidence.s_prediction,
                                                  passive.evidence.s_prediction)),
               {{"kf11_MPa", feed.k11_MPa->value},
                {"mf", feed.m->value},
                {"kp11_MPa", passive.k11_MPa->value},
                {"mp", passive.m->value}});
}

json taylor(const Request& q, const Lives& t) {
  const double n = t.fit.n->value;
  const Evidence& e = t.fit.evidence;
  auto out =
      group(q, percent(n * e.s_prediction),  // of C, not of T
            {{"C", t.fit.C->value},
             {"n", n},
             {"a", t.fit.a ? t.fit.a->value : q.given_a},
             {"b", t.fit.b ? t.fit.b->value : q.given_b},
             {"tool", q.tool.name},
             {"vc_m_min", range(q, e, [](const MeasuredCut& x) { return x.vc_m_min; })},
             {"f_mm_rev", range(q, e, [](const MeasuredCut& x) { return x.f_mm_rev; })},
             {"ap_mm", range(q, e, [](const MeasuredCut& x) { return x.ap_mm; })},
             {"note", note(q, e, told("C", *t.fit.C) + ", " + told("n", *t.fit.n))}});
  if (t.scatter && t.scatter->s_between)
    out["scatter_pct"] = percent(t.scatter->s_between->value);
  return out;
}

/// One standard deviation of hmin, by its interval.
double chip_uncertainty_pct(const cutting::RoughnessFit& fit, double confidence) {
  const Estimate& h = *fit.hmin_mm;
  const double halves =
      2 * student_quantile((1 + confidence) / 2, fit.evidence.degrees_of_freedom);
  return h.value > 0 ? percent((h.upper - h.lower) / halves / h.value) : 100;
}

json chip(const Request& q, const cutting::RoughnessFit& fit) {
  return group(q, chip_uncertainty_pct(fit, q.options.confidence),
               {{"hmin_mm", fit.hmin_mm->value},
                {"note", note(q, fit.evidence, told("hmin_mm", *fit.hmin_mm))}});
}

/// Puts a group into the document; where a material cannot have it, the document stays
/// and a warning says why.
bool put(const char* name, json value, json& m, json& warnings) {
  json changed = m;
  changed[name] = std::move(value);
  Problems problems{.document = "material"};
  read_material(Reader(changed, problems));
  for (const Problem& p : problems.list)
    warnings.push_back(say("{} is not replaced: {}: got {}, expected {}",
                           std::string(name), p.pointer, p.got, p.expected));
  if (!problems.list.empty()) return false;
  m = std::move(changed);
  return true;
}

}  // namespace

Written written(const Request& q, const Fits& fits, json& warnings) {
  using cutting::ThrustLaw;
  const auto& f = fits.forces;
  const auto law = f ? f->law : ThrustLaw::none;
  const bool direction = law == ThrustLaw::direction;
  const char* name = direction ? "thrust" : "feed_passive";
  if (!q.material) {
    warnings.push_back(
        tr("no material given, whose document the constants could go into"));
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
  if (fits.roughness && fits.roughness->hmin_mm)
    put("chip", chip(q, *fits.roughness), m, warnings);
  return w;
}

}  // namespace turnwright::document::material_calibration
