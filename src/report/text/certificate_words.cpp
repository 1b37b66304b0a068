#include "certificate_words.hpp"

#include <fmt/format.h>

#include <optional>

#include "json_fields.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

std::optional<double> gap_pct(const ordered_json& certificate) {
  const auto gap = number(certificate, "gap");
  if (!gap) return {};
  return 100 * *gap;
}

}  // namespace

std::string gap(const ordered_json& certificate) {
  const auto kind = word(certificate, "kind");
  if (kind == "local" || kind == "none") return kind;
  return kind == "global" ? shown(gap_pct(certificate), 2) + " %" : "-";
}

std::string proof(const ordered_json& certificate) {
  const auto kind = word(certificate, "kind");
  const auto bound = shown(number(certificate, "lower_bound"), 4);
  const auto gap = shown(gap_pct(certificate), 2);
  const auto reason = word(certificate, "reason");
  if (kind == "global") {
    const auto engine = word(certificate, "engine");
    return fmt::format(
        "proven: no feasible choice has an objective below {}; this plan lies within {} "
        "% "
        "of that ({} boxes bounded{})",
        bound, gap, shown(number(certificate, "nodes"), 0),
        engine.empty() ? "" : ", " + engine);
  }
  const std::string why = reason.empty() ? "" : ": " + reason;
  if (kind == "local")
    return fmt::format(
        "not proven, the best of its neighbourhood only{}; bound {}, gap {} %", why,
        bound, gap);
  return reason.empty() ? "not proven" : reason;
}

}  // namespace turnwright::report
