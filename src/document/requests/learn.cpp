#include "turnwright/document/learn.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/say.hpp"
#include "document/json/reader.hpp"
#include "learn_factors.hpp"
#include "turnwright/learning/advice.hpp"
#include "turnwright/learning/capability.hpp"
#include "turnwright/learning/mixups.hpp"
#include "turnwright/learning/normality.hpp"

namespace turnwright::document {
namespace measured_parts {
namespace {

using learning::Estimate;
using learning::MixUp;
using nlohmann::ordered_json;

struct Meaning {
  MixUp kind;
  const char *name, *sentence;  ///< behind "part 7: 0.9843 mm"
};
constexpr Meaning kMeanings[] = {
    {MixUp::outlier, "outlier", to_translate("does not belong to the other parts")},
    {MixUp::swapped, "swapped", to_translate("belongs to")},
    {MixUp::inch, "inch", to_translate("belongs if it is in inches")},
    {MixUp::inch_twice, "inch-twice", to_translate("belongs if it was taken for inches")},
    {MixUp::micrometre, "micrometre", to_translate("belongs if it is in micrometres")},
    {MixUp::metre, "metre", to_translate("belongs if it is in metres")},
    {MixUp::radius, "radius", to_translate("belongs if it is the radius")},
    {MixUp::diameter, "diameter", to_translate("belongs if it is the diameter")},
    {MixUp::sign, "sign", to_translate("belongs with the other sign")},
    {MixUp::deviation, "deviation",
     to_translate("belongs if it is the deviation from the nominal size")},
    {MixUp::deviation_sign, "deviation-sign",
     to_translate(
         "belongs if it is the deviation from the nominal size with the other sign")}};

const Meaning& meaning(MixUp kind) {
  return *std::ranges::find(kMeanings, kind, &Meaning::kind);
}

ordered_json described(const Estimate& e) {
  return {{"value", e.value}, {"u", e.u}, {"lower", e.lower}, {"upper", e.upper}};
}

// What is expected of a characteristic, by the moments of the values kept.
learning::Expected expected(const Characteristic& of, const learning::Series& kept) {
  learning::Expected e{.nominal_mm = of.nominal_mm};
  const auto n = static_cast<double>(kept.size());
  for (const auto& o : kept) e.mean_mm += o.y_mm / n;
  for (const auto& o : kept)
    e.s_mm += (o.y_mm - e.mean_mm) * (o.y_mm - e.mean_mm) / std::max(1.0, n - 1);
  e.s_mm = std::sqrt(e.s_mm);
  return e;
}

ordered_json left_out_row(const Request& q, std::size_t row, MixUp kind,
                          const std::string& with) {
  const auto& r = q.rows[row];
  const auto& of = q.characteristics[r.characteristic].id;
  const Meaning& m = meaning(kind);
  ordered_json out{{"at", r.pointer},
                   {"part", r.part},
                   {"characteristic", of},
                   {"value_mm", r.value_mm},
                   {"kind", m.name}};
  if (!with.empty()) out["with"] = with;
  out["sentence"] =
      say("part {}, {}: {} {}{}", r.part, of, mm_text(r.value_mm), tr(m.sentence),
          with.empty() ? "" : say(" {}, and vice versa", with));
  return out;
}

// Every value that was left out, by characteristic, with its explanation.
ordered_json left_out(const Request& q, const std::vector<Learned>& all) {
  std::vector<learning::Suspect> suspects;
  std::vector<learning::Expected> moments;
  std::vector<std::size_t> rows;
  std::map<std::string, std::size_t> parts;
  for (std::size_t c = 0; c < all.size(); ++c) {
    moments.push_back(expected(q.characteristics[c], all[c].kept));
    for (const std::size_t i : all[c].left_out) {
      const auto& row = q.rows[all[c].made.rows[i]];
      const auto part = parts.emplace(row.part, parts.size()).first->second;
      suspects.push_back({c, part, row.value_mm});
      rows.push_back(all[c].made.rows[i]);
    }
  }
  const auto named = learning::mix_ups(suspects, moments);
  ordered_json out = ordered_json::array();
  for (std::size_t i = 0; i < named.size(); ++i) {
    const auto& whole = all[suspects[i].characteristic].all;
    const auto& with = named[i].with;
    out.push_back(left_out_row(q, rows[i], whole ? *whole : named[i].kind,
                               with ? q.characteristics[*with].id : ""));
  }
  return out;
}

ordered_json described(const learning::Indices& i, const char* p, const char* pk) {
  ordered_json out{{"s_mm", described(i.s_mm)}};
  if (i.p) out[p] = described(*i.p);
  out[pk] = described(i.pk);
  return out;
}

ordered_json edges(const Learned& l) {
  const auto& t = *l.trend;
  ordered_json out{{"count", l.made.edges.size()}};
  if (t.edges) {
    out["scatter_mm"] = std::sqrt(std::max(0.0, t.edges->variance_mm2));
    out["alike_p"] = t.edges->p;
  }
  ordered_json jumps = ordered_json::array();
  for (const auto& j : t.jumps) {
    ordered_json jump{{"to", l.made.edges[j.to]}};
    jump.update(described(j.step_mm));
    jumps.push_back(std::move(jump));
  }
  out["jumps"] = std::move(jumps);
  return out;
}

ordered_json advice(const Characteristic& of, const Learned& l, double confidence) {
  const auto next = learning::next_part(l.made.series);
  const auto a = learning::advice(*l.trend, next.part, next.step, of.limits, confidence);
  ordered_json out{{"target_mm", of.limits.target_mm},
                   {"expected_mm", described(a.expected_mm)},
                   {"correction_mm", described(a.correction_mm)},
                   {"worthwhile", a.worthwhile},
                   {"per_part_mm", a.per_part_mm},
                   {"room_mm", a.room_mm}};
  if (a.due_in) out["due_in_parts"] = *a.due_in;
  if (of.parts_per_edge)
    out["edge_due_in_parts"] =
        std::max(0L, *of.parts_per_edge - static_cast<long>(next.part.age));
  return out;
}

// Sentences on what the data do not tell.
ordered_json not_identified(const Learned& l) {
  const auto& t = *l.trend;
  ordered_json out = ordered_json::array();
  if (t.drift_in_wear)
    out.push_back(
        tr("drift and wear run alike: wear has the drift in it; pauses, or more edges, "
           "would tell them apart"));
  else if (!t.drift)
    out.push_back(tr("drift: all parts have one time"));
  if (!t.wear) out.push_back(tr("wear: it takes the column edge or parts_on_edge"));
  if (t.edges_ignored)
    out.push_back(tr("edges have too few parts each to be told apart and count as one"));
  else if (l.made.edges.size() > 1 && !t.edges)
    out.push_back(tr("how edges scatter: there are too few of them"));
  if (!l.made.timed)
    out.push_back(tr("drift counts from part to part, for there are no times"));
  return out;
}

// The values as they were made, for a picture.
ordered_json values(const Request& q, const Learned& l) {
  ordered_json out = ordered_json::array();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < l.made.series.size(); ++i) {
    const auto& row = q.rows[l.made.rows[i]];
    ordered_json value{{"part", row.part},
                       {"value_mm", row.value_mm},
                       {"edge", l.made.edges[l.made.series[i].edge]}};
    if (!std::ranges::binary_search(l.left_out, i)) {
      if (l.trend) value["fitted_mm"] = l.trend->fitted_mm[kept];
      ++kept;
    }
    out.push_back(std::move(value));
  }
  return out;
}

void put_trend(const Learned& l, ordered_json& out) {
  const auto& t = *l.trend;
  out["mean_mm"] = described(t.mean_mm);
  if (t.drift) out[l.made.timed ? "drift_mm_h" : "drift_mm_part"] = described(*t.drift);
  if (t.wear) out["wear_mm_part"] = described(*t.wear);
  if (l.made.edges.size() > 1) out["edges"] = edges(l);
  if (const auto n = learning::normality(t.standardised))
    out["normality"] = {{"A2", n->A2}, {"p", n->p}};
}

ordered_json described(const Request& q, const Characteristic& of, const Learned& l) {
  ordered_json out{{"id", of.id}, {"nominal_mm", of.nominal_mm}};
  if (!of.device.empty()) out["device"] = of.device;
  if (of.limits.lower_mm) out["lower_mm"] = *of.limits.lower_mm;
  out["upper_mm"] = of.limits.upper_mm;
  out["n"] = l.kept.size();
  out["left_out"] = l.left_out.size();
  if (l.trend) {
    put_trend(l, out);
    if (const auto c = learning::capability(l.kept, *l.trend, of.limits, q.confidence)) {
      out["within"] = described(c->within, "Cp", "Cpk");
      out["overall"] = described(c->overall, "Pp", "Ppk");
    }
    if (of.limits.lower_mm) out["advice"] = advice(of, l, q.confidence);
    out["not_identified"] = not_identified(l);
  }
  out["values"] = values(q, l);
  return out;
}

void warn(const Characteristic& of, const Learned& l, ordered_json& warnings) {
  constexpr double kUnlikely = 0.01;
  if (l.all)
    warnings.push_back(
        say("{}: every value {}; none counts", of.id, tr(meaning(*l.all).sentence)));
  else if (!l.trend)
    warnings.push_back(
        say("{}: {} values are too few: it takes five of one edge, and two more for each "
            "other edge",
            of.id, l.kept.size()));
  else if (!(l.trend->s_mm > 0))
    warnings.push_back(
        say("{}: the values do not scatter, so that no index is told", of.id));
  if (!l.trend) return;
  const auto n = learning::normality(l.trend->standardised);
  if (n && n->p < kUnlikely)
    warnings.push_back(
        say("{}: the scatter is not normal (p {:.2g}); indices and intervals presume "
            "that it is",
            of.id, n->p));
}

ordered_json answered(const Request& q, const Catalogue& catalogue) {
  std::vector<Learned> all;
  for (std::size_t c = 0; c < q.characteristics.size(); ++c) all.push_back(learned(q, c));
  ordered_json characteristics = ordered_json::array(), warnings = q.warnings;
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (all[c].made.rows.empty()) continue;
    const auto& of = q.characteristics[c];
    characteristics.push_back(described(q, of, all[c]));
    warn(of, all[c], warnings);
  }
  ordered_json out{{"confidence", q.confidence},
                   {"characteristics", std::move(characteristics)},
                   {"left_out", left_out(q, all)}};
  if (q.update) {
    auto factors = updated(q, all, catalogue);
    out["factors"] = std::move(factors.factors);
    out["documents"] = std::move(factors.documents);
    for (auto& w : factors.warnings) warnings.push_back(std::move(w));
  }
  out["warnings"] = std::move(warnings);
  return out;
}

}  // namespace
}  // namespace measured_parts

nlohmann::ordered_json learn(const nlohmann::json& request, const Catalogue& catalogue) {
  return measured_parts::answered(measured_parts::read(request, catalogue), catalogue);
}

}  // namespace turnwright::document
