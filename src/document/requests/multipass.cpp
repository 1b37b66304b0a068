#include "turnwright/document/multipass.hpp"

#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "document/json/fields.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/multipass/problem.hpp"
#include "turnwright/multipass/single_pass.hpp"

namespace turnwright::document {
namespace {

using multipass::Answer;
using multipass::Cost;
using multipass::Pass;
using multipass::PassCount;
using multipass::Range;
using nlohmann::json;

constexpr long kPasses = 100;
constexpr std::size_t kLaws = 20, kLimits = 50;
constexpr double kLargest = 1e6, kExponent = 20;

struct Field {
  const char* key;
  double multipass::Problem::*value;
  Bounds bounds;
};

const std::vector<Field>& fields() {
  using multipass::Problem;
  static const Bounds kLength = above_up_to(0, kLargest, "mm");
  static const Bounds kPower = within(-kExponent, kExponent);
  static const Bounds kFactor = above_up_to(0, 1e30), kRatio = within(0, kLargest);
  static const std::vector<Field> kFields{
      {"D_mm", &Problem::D_mm, kLength},
      {"L_mm", &Problem::L_mm, kLength},
      {"dt_mm", &Problem::dt_mm, kLength},
      {"k0", &Problem::k0, within(0, kLargest, to_translate("per min"))},
      {"kt", &Problem::kt, within(0, kLargest, to_translate("per edge"))},
      {"h1", &Problem::h1, within(0, kLargest, "min/mm")},
      {"h2", &Problem::h2, within(0, kLargest, "min")},
      {"tc", &Problem::tc, within(0, kLargest, "min")},
      {"te", &Problem::te, within(0, kLargest, "min")},
      {"p", &Problem::p, kPower},
      {"q", &Problem::q, kPower},
      {"r", &Problem::r, kPower},
      {"C0", &Problem::C0, kFactor},
      {"kf", &Problem::kf, kFactor},
      {"mu", &Problem::mu, kPower},
      {"nu", &Problem::nu, kPower},
      {"eta", &Problem::eta, above_up_to(0, 1)},
      {"FU", &Problem::FU, above_up_to(0, 1e30, "kgf")},
      {"PU", &Problem::PU, above_up_to(0, 1e30, "kW")},
      {"lambda", &Problem::lambda, kPower},
      {"nu2", &Problem::nu2, kPower},
      {"SC", &Problem::SC, within(0, 1e30)},
      {"kq", &Problem::kq, kFactor},
      {"tau", &Problem::tau, kPower},
      {"phi", &Problem::phi, kPower},
      {"delta", &Problem::delta, kPower},
      {"QU", &Problem::QU, above_up_to(0, 1e30, "degC")},
      {"R_mm", &Problem::R_mm, kLength},
      {"SRu_um", &Problem::SRu_um, above_up_to(0, kLargest, "um")},
      {"k3", &Problem::k3, kRatio},
      {"k4", &Problem::k4, kRatio},
      {"k5", &Problem::k5, kRatio},
      {"theta", &Problem::theta, within(0, 1)}};
  return kFields;
}

Range read_pair(Reader& r, const char* key, const std::string& unit) {
  const auto x = read_range(r, key, above_up_to(0, kLargest, unit));
  return {x.lower, x.upper};
}

multipass::Problem read_problem(Reader& r) {
  multipass::Problem m;
  m.cost = r.choice_or<Cost>(
      "cost", {{"literal", Cost::literal}, {"physical", Cost::physical}}, m.cost);
  for (const Field& f : fields()) m.*f.value = r.number_or(f.key, f.bounds, m.*f.value);
  if (r.has("V")) m.V = read_pair(r, "V", "m/min");
  if (r.has("f")) m.f = read_pair(r, "f", "mm/rev");
  if (r.has("d")) m.d = read_pair(r, "d", "mm");
  if (r.has("T")) m.T = read_pair(r, "T", "min");
  m.VrU = r.optional_number("VrU", above_up_to(0, kLargest, "m/min"));
  m.n_max = static_cast<int>(r.integer_or("n_max", 1, kPasses, m.n_max));
  if (m.k0 + m.kt <= 0) r.problem(tr("k0 or kt above 0"), "range");
  return m;
}

multipass::PowerLaw read_law(Reader& r) {
  const Bounds power = within(-kExponent, kExponent);
  return {.c = r.number("c", above_up_to(0, 1e30)),
          .V = r.number_or("V", power, 0),
          .f = r.number_or("f", power, 0)};
}

multipass::SinglePass read_single_pass(Reader r) {
  multipass::SinglePass m;
  for (Reader item : r.items("cost", 1, kLaws)) {
    item = item.as_object();
    m.cost.push_back(read_law(item));
    item.finish();
  }
  std::set<std::string> names{"V_min", "V_max", "f_min", "f_max"};
  for (Reader item : r.optional_items("limits", 0, kLimits)) {
    item = item.as_object();
    multipass::PowerLimit l;
    l.name = item.text("name", 64);
    if (!l.name.empty() && !names.insert(l.name).second)
      item.problem_at("name", tr("each name once, none of V_min, V_max, f_min, f_max"),
                      "duplicate");
    l.law = read_law(item);
    l.upper = !item.has("at_least");
    if (item.has("at_most") && !l.upper)
      item.problem_at("at_least", tr("either at_most or at_least"), "conflict");
    l.limit = item.number(l.upper ? "at_most" : "at_least", above_up_to(0, 1e30));
    item.finish();
    m.limits.push_back(std::move(l));
  }
  m.V = read_pair(r, "V", "");
  m.f = read_pair(r, "f", "");
  r.finish();
  return m;
}

json described(const multipass::Problem& m, const Pass& x) {
  const multipass::Load l = load(m, x);
  return {{"V", x.V},     {"f", x.f},    {"d", x.d},     {"T", l.T},
          {"F_kgf", l.F}, {"P_kW", l.P}, {"Q_degC", l.Q}};
}

json described(const std::vector<multipass::Limit>& limits) {
  json out = json::array();
  for (const multipass::Limit& l : limits)
    out.push_back({{"name", l.name},
                   {"value", l.value},
                   {"limit", l.limit},
                   {"margin", l.margin},
                   {"binding", l.binding},
                   {"price", l.price}});
  return out;
}

json active(const std::vector<multipass::Limit>& limits) {
  json out = json::array();
  for (const multipass::Limit& l : limits)
    if (l.binding) out.push_back(l.name);
  return out;
}

json certificate(double lower_bound, double gap, long nodes) {
  json out{{"kind", gap <= multipass::kGap ? "global" : "local"},
           {"lower_bound", lower_bound},
           {"gap", gap},
           {"nodes", nodes}};
  if (!(gap <= multipass::kGap))
    out["reason"] = tr("search stopped at its largest number of nodes");
  return out;
}

json described(const PassCount& c) {
  using enum PassCount::Status;
  json out{{"n", c.n},
           {"UC", c.UC ? json(*c.UC) : json()},
           {"status", c.status == optimal      ? "optimal"
                      : c.status == infeasible ? "infeasible"
                                               : "unsettled"}};
  if (c.status != infeasible) out["lower_bound"] = c.lower_bound;
  return out;
}

// As the request takes it: passes are counted.
json limit_value(const std::string& limit, double value) {
  return limit == "n_max" ? json(std::llround(value)) : json(value);
}

json described(const multipass::Problem& m, const Answer& a) {
  json counts = json::array();
  for (const PassCount& c : a.per_count) counts.push_back(described(c));
  if (!a.best) {
    json names = json::array(), relax = json::array();
    for (const multipass::Relief& r : a.conflict) {
      names.push_back(r.limit);
      relax.push_back({{"limit", r.limit},
                       {"now", limit_value(r.limit, r.now)},
                       {"needed", r.needed ? limit_value(r.limit, *r.needed) : json()}});
    }
    return {{"status", a.conflict.empty() ? "unsettled" : "infeasible"},
            {"UC", nullptr},
            {"conflicts", std::move(names)},
            {"relax", std::move(relax)},
            {"per_pass_count", std::move(counts)}};
  }
  return {{"status", "ok"},
          {"UC", *a.best->UC},
          {"n", a.best->n},
          {"rough", described(m, a.best->rough)},
          {"finish", described(m, a.best->finish)},
          {"active", active(a.limits)},
          {"constraints", described(a.limits)},
          {"certificate", certificate(a.lower_bound, a.gap, a.nodes)},
          {"per_pass_count", std::move(counts)}};
}

json described(const multipass::SinglePassAnswer& a) {
  if (!a.UC)
    return {{"status", "infeasible"}, {"UC", nullptr}, {"conflicts", a.conflict}};
  return {{"status", "ok"},
          {"UC", *a.UC},
          {"V", a.V},
          {"f", a.f},
          {"active", active(a.limits)},
          {"constraints", described(a.limits)},
          {"certificate", certificate(a.lower_bound, a.gap, 1)}};
}

}  // namespace

json multipass(const json& request) {
  Problems problems{.document = "multipass"};
  Reader r = Reader(request, problems).as_object();
  read_format(r, "turnwright-multipass/1");
  if (const auto single = r.optional_object("single_pass")) {
    const auto m = read_single_pass(*single);
    r.finish();
    problems.throw_if_any();
    return described(multipass::optimum(m));
  }
  const auto m = read_problem(r);
  r.finish();
  problems.throw_if_any();
  return described(m, multipass::optimum(m));
}

}  // namespace turnwright::document
