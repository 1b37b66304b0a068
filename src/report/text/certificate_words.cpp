#include "certificate_words.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/say.hpp"
#include "json_fields.hpp"
#include "result_words.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

std::optional<double> gap_pct(const ordered_json& certificate) {
  const auto gap = number(certificate, "gap");
  if (!gap) return {};
  return 100 * *gap;
}

// The least percentage of so many decimals that the gap is not above.
std::string at_most(const ordered_json& certificate, int decimals) {
  const auto gap = gap_pct(certificate);
  if (!gap) return "-";
  const double scale = std::pow(10, decimals);
  return shown(std::max(1.0, std::ceil(*gap * scale - 1e-9)) / scale, decimals) + " %";
}

}  // namespace

std::string perhaps(const ordered_json& certificate) {
  constexpr double kAll_pct = 99.95;  // nothing is known
  const auto gap = gap_pct(certificate);
  if (!gap || !(*gap < kAll_pct)) return tr("a better plan may exist");
  // cost (1 - gap) is the least that the best may cost
  ordered_json dearer{{"gap", 1 / (1 - *gap / 100) - 1}};
  return say("may be up to {} dearer than the best", at_most(dearer, 1));
}

std::string gap(const ordered_json& certificate) {
  const auto kind = word(certificate, "kind");
  if (kind == "local" || kind == "none") return spoken(kind);
  return kind == "global" ? shown(gap_pct(certificate), 2) + " %" : "-";
}

std::string proof(const ordered_json& certificate) {
  const auto kind = word(certificate, "kind");
  const auto reason = word(certificate, "reason");
  if (kind == "global")
    return say(
        "proven: no choice of clamping, tools and conditions is better by more than {}",
        at_most(certificate, 2));
  if (kind == "local") return say("not proven: {}", perhaps(certificate));
  return reason.empty() ? tr("not proven") : reason;
}

}  // namespace turnwright::report
