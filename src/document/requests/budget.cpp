#include "budget.hpp"

#include <algorithm>
#include <cmath>

namespace turnwright::document {
namespace {

using tolerance::Decision;
using tolerance::Distribution;
using tolerance::Span;

constexpr std::size_t kSources = 100;
constexpr long kFewestDraws = 1000, kMostDraws = 10'000'000;
constexpr long kLargestSeed =
    9'007'199'254'740'991;  // 2^53 - 1: exact in any JSON reader
constexpr double kLargest_um = 1e6;

const Choices<Distribution>& distributions() {
  using enum Distribution;
  static const Choices<Distribution> kAll{
      {"normal", normal},   {"uniform", uniform}, {"triangular", triangular},
      {"arcsine", arcsine}, {"fixed", fixed},     {"rayleigh", rayleigh}};
  return kAll;
}

tolerance::Source read_source(Reader r) {
  r = r.as_object();
  tolerance::Source s;
  s.name = r.text("name");
  const std::size_t before = r.problems().list.size();
  s.distribution = r.choice("distribution", distributions());
  const bool known = !r.broken() && r.problems().list.size() == before;
  const bool bias = known && s.distribution == Distribution::fixed;
  s.value_um = r.number("value_um", within(bias ? -kLargest_um : 0, kLargest_um, "um"));
  s.sensitivity = r.number_or("sensitivity", within(-1e6, 1e6), s.sensitivity);
  r.finish();
  return s;
}

nlohmann::json to_json(const Span& span) {
  return {std::isfinite(span.down_um) ? nlohmann::json(span.down_um) : nullptr,
          span.up_um};
}

const char* word(Decision d) {
  switch (d) {
    case Decision::conforms:
      return "conforms";
    case Decision::not_proven:
      return "not-proven";
    case Decision::does_not_conform:
      return "does-not-conform";
  }
  throw std::domain_error("budget: not a decision");
}

}  // namespace

tolerance::BudgetDemand read_budget(Reader r) {
  r = r.as_object();
  tolerance::BudgetDemand d;
  for (const Reader& item : r.items("sources", 1, kSources))
    d.sources.push_back(read_source(item));
  d.conformance = r.number_or("conformance", within(0, 1), d.conformance);
  d.measurement_U_um =
      r.number_or("measurement_U_um", within(0, kLargest_um, "um"), d.measurement_U_um);
  d.draws.seed = static_cast<std::uint64_t>(
      r.integer_or("seed", 0, kLargestSeed, static_cast<long>(d.draws.seed)));
  d.draws.count = static_cast<std::size_t>(
      r.integer_or("draws", kFewestDraws, kMostDraws, static_cast<long>(d.draws.count)));
  d.draws.threads = 0;
  r.finish();
  return d;
}

nlohmann::json to_json(const tolerance::Budget& b) {
  auto shares = nlohmann::json::array();
  for (const auto& s : b.shares)
    shares.push_back({{"name", s.name},
                      {"worst_case_um", s.worst_case_um},
                      {"variance_share", s.variance_share}});
  return {{"room_um", to_json(b.room_um)},
          {"worst_case_um", to_json(b.worst_case_um)},
          {"worst_case_fits", b.worst_case_fits},
          {"rss_um", to_json(b.rss_um)},
          {"rss_fits", b.rss_fits},
          {"mean_um", b.mean_um},
          {"sigma_um", b.sigma_um},
          {"shares", std::move(shares)},
          {"P_conform", b.P_conform},
          {"P_interval", {b.P_low, b.P_high}},
          {"P_accept", b.P_accept},
          {"percentiles_um",
           {{"p0_135", b.Q0_135_um}, {"p50", b.Q50_um}, {"p99_865", b.Q99_865_um}}},
          {"index", b.index ? nlohmann::json(*b.index) : nullptr},
          {"decision", word(b.decision)}};
}

}  // namespace turnwright::document
