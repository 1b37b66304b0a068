#include "turnwright/document/quote.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/say.hpp"
#include "document/json/fields.hpp"
#include "document/json/read_below.hpp"
#include "routing.hpp"

namespace turnwright::document {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using planning::Offer;
using planning::PlanStatus;
using planning::ProcessPlan;

constexpr std::size_t kQuotedParts = 50, kBatches = 20;
constexpr long kLargestBatch = 1'000'000;
constexpr double kMostMoney = 1e9;

std::vector<double> read_batches(Reader& r) {
  if (!r.has("batches")) return {1, 10, 100, 1000};
  std::vector<double> all;
  std::set<double> once;
  for (const auto& item : r.items("batches", 1, kBatches)) {
    const auto batch = static_cast<double>(item.as_integer(1, kLargestBatch));
    if (!once.insert(batch).second) item.problem(tr("each batch once"), "duplicate");
    all.push_back(batch);
  }
  return all;
}

void read_charges(Reader group, planning::Charges& c) {
  c.setter_per_min = group.optional_number("setter_per_min", within(0, 1e4));
  c.overhead = group.number_or("overhead_pct", within(0, 1000, "%"), 0) / 100;
  c.margin = group.number_or("margin_pct", within(0, 95, "%"), 0) / 100;
  c.scrap = group.boolean_or("scrap", c.scrap);
  group.finish();
}

planning::StockPrice read_stock(Reader group) {
  const auto length = above_up_to(0, 1e5, "mm");
  planning::StockPrice s;
  s.per_kg = group.optional_number("price_per_kg", within(0, kMostMoney));
  s.per_bar = group.optional_number("price_per_bar", within(0, kMostMoney));
  if (s.per_kg.has_value() == s.per_bar.has_value())
    group.problem(tr("either price_per_kg or price_per_bar"), "conflict");
  if (s.per_bar) s.bar_length_mm = group.number("bar_length_mm", length);
  s.kerf_mm = group.number_or("kerf_mm", within(0, 100, "mm"), 0);
  if (s.per_bar) s.remnant_mm = group.number_or("remnant_mm", within(0, 1e5, "mm"), 0);
  group.finish();
  return s;
}

void read_energy(Reader group, QuoteRequest& q) {
  q.idle_kW = group.number_or("idle_kW", within(0, 1000, "kW"), 0);
  q.kg_CO2_per_kWh = group.number_or("kg_CO2_per_kWh", within(0, 10, "kg"), 0);
  group.finish();
}

void read_part(const Reader& item, const Catalogue& catalogue, bool priced,
               QuoteRequest& q, Problems& problems) {
  if (!read_below(item, problems, [&] {
        q.parts.push_back(prepared_candidates(item.json(), catalogue, "quote"));
      }))
    return;
  auto& usable = q.parts.back().usable;
  for (auto& c : usable) c.document.what_if.clear();  // a quote does not answer these
  if (usable.front().document.part.objective != planning::Objective::cost)
    item.problem_at("objective", tr("\"cost\": a quote is of the cheapest plan"),
                    "conflict");
  else if (priced && std::ranges::any_of(usable, [](const auto& c) {
             return c.document.part.stock_price > 0;
           }))
    item.problem_at("stock", tr("no price of its own beside the quote's stock"),
                    "conflict");
}

// Nothing is converted; what names no currency counts as in that of the others.
void check_currency(Reader& r, QuoteRequest& q) {
  std::set<std::string> all;
  for (const auto& candidates : q.parts) all.merge(currencies(candidates));
  if (q.currency.empty() && all.size() == 1) q.currency = *all.begin();
  all.insert(q.currency);
  all.erase("");
  if (all.size() > 1)
    r.problem_at(
        "currency",
        say("one currency of all rates and prices, not {}", fmt::join(all, ", ")),
        "conflict");
}

// A candidate that can be offered, with its place among the plans; or why it cannot.
struct Considered {
  std::string name;
  std::optional<Offer> offer = {};
  std::string why = {};
};

Considered considered(const QuoteRequest& q, const Candidates::Usable& c,
                      const ProcessPlan& plan) {
  const auto& part = c.document.part;
  if (plan.status != PlanStatus::ok)
    return {c.name,
            {},
            plan.conflicts.empty() ? plan.certificate.reason
                                   : plan.conflicts.front().sentence};
  if (q.charges.scrap && !(planning::all_conform(plan) > 0))
    return {c.name, {}, tr("no share of the parts is sure to conform")};
  if (q.stock.per_bar && !part.drawing.stock.outline.empty())
    return {c.name, {}, tr("a casting or forging is not cut from a bar")};
  if (q.stock.per_bar && planning::pieces_of_bar(part, q.stock) < 1)
    return {c.name,
            {},
            say("a bar of {:g} mm less its remnant of {:g} mm is too short for a piece "
                "of {:g} mm and its kerf of {:g} mm",
                q.stock.bar_length_mm, q.stock.remnant_mm, part.drawing.stock.length_mm,
                q.stock.kerf_mm)};
  return {c.name, Offer{&part, &plan, planning::piece_price(part, q.stock)}};
}

ordered_json price_json(const planning::UnitPrice& u, const std::string& made_by) {
  const double cost = u.stock + u.run + u.setting_up;
  ordered_json out{{"batch", std::lround(u.batch)}, {"price", u.price}};
  if (!made_by.empty()) out["made_by"] = made_by;
  out.update({{"stock", u.stock},
              {"run", u.run},
              {"setting_up", u.setting_up},
              {"scrap", u.scrap},
              {"overhead", u.overhead},
              {"margin", u.margin},
              {"time_min", u.time_min},
              {"lower_bound", u.lower_bound},
              {"gap", cost > 0 ? std::max(0.0, (cost - u.lower_bound) / cost) : 0}});
  return out;
}

ordered_json alternatives_json(const std::vector<Considered>& all,
                               const Candidates& candidates) {
  auto out = ordered_json::array();
  for (const auto& c : all)
    out.push_back(
        c.offer ? ordered_json{{"name", c.name}, {"feasible", true}}
                : ordered_json{{"name", c.name}, {"feasible", false}, {"why", c.why}});
  for (const auto& c : candidates.refused)
    out.push_back({{"name", c.name}, {"feasible", false}, {"why", c.why}});
  return out;
}

ordered_json energy_json(const QuoteRequest& q, const Offer& offer) {
  const double kWh = planning::energy_kWh(*offer.part, *offer.plan, q.idle_kW);
  return {{"kWh", kWh}, {"kg_CO2", kWh * q.kg_CO2_per_kWh}};
}

// The quote of one part; rows of its routing are added to those of the parts before.
ordered_json part_json(const QuoteRequest& q, const Candidates& candidates,
                       const std::vector<ProcessPlan>& plans, ordered_json& routing) {
  std::vector<Considered> all;
  for (std::size_t i = 0; i < plans.size(); ++i)
    all.push_back(considered(q, candidates.usable[i], plans[i]));
  std::vector<Offer> offers;
  std::vector<const Considered*> of;
  for (const auto& c : all)
    if (c.offer) {
      offers.push_back(*c.offer);
      of.push_back(&c);
    }
  const auto& name = candidates.usable.front().document.part.drawing.name;
  const auto prices = planning::unit_prices(offers, q.batches, q.charges);
  ordered_json out{{"name", name}, {"status", prices.empty() ? "infeasible" : "ok"}};
  out["prices"] = ordered_json::array();
  std::set<std::size_t> made;
  for (const auto& u : prices) {
    out["prices"].push_back(price_json(u, of[u.offer]->name));
    made.insert(u.offer);
  }
  out["ways"] = ordered_json::array();
  for (const auto i : made) {
    const auto& offer = offers[i];
    out["ways"].push_back(
        {{"made_by", of[i]->name},
         {"proved", offer.plan->certificate.kind == planning::CertificateKind::global},
         {"stock_kg", planning::stock_mass_kg(*offer.part)},
         {"conforming", planning::all_conform(*offer.plan)},
         {"energy", energy_json(q, offer)}});
    for (auto& row : routing_rows(name, of[i]->name, offer))
      routing.push_back(std::move(row));
  }
  out["alternatives"] = alternatives_json(all, candidates);
  return out;
}

}  // namespace

QuoteRequest load_quote(const json& request, const Catalogue& catalogue) {
  Problems problems{.document = "quote"};
  Reader r = Reader(request, problems).as_object();
  read_format(r, "turnwright-quote/1");
  QuoteRequest q;
  q.batches = read_batches(r);
  q.currency = read_currency(r);
  if (auto group = r.optional_object("charges")) read_charges(*group, q.charges);
  if (auto group = r.optional_object("stock")) q.stock = read_stock(*group);
  if (auto group = r.optional_object("energy")) read_energy(*group, q);
  const bool priced = q.stock.per_kg || q.stock.per_bar;
  for (const auto& item : r.items("parts", 1, kQuotedParts))
    read_part(item, catalogue, priced, q, problems);
  check_currency(r, q);
  r.finish();
  problems.throw_if_any();
  return q;
}

ordered_json quote_result(const QuoteRequest& q,
                          const std::vector<std::vector<ProcessPlan>>& plans) {
  auto parts = ordered_json::array(), routing = ordered_json::array();
  for (std::size_t i = 0; i < q.parts.size(); ++i)
    parts.push_back(part_json(q, q.parts[i], plans.at(i), routing));
  const bool all_ok =
      std::ranges::all_of(parts, [](const auto& p) { return p["status"] == "ok"; });
  ordered_json out{{"status", all_ok ? "ok" : "infeasible"}};
  if (!q.currency.empty()) out["currency"] = q.currency;
  out["parts"] = std::move(parts);
  out["routing_csv"] = routing_csv(routing);
  out["routing"] = std::move(routing);
  return out;
}

}  // namespace turnwright::document
