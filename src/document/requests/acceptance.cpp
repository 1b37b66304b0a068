#include "turnwright/document/acceptance.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "budget.hpp"
#include "document/json/fields.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/tolerance/acceptance.hpp"

namespace turnwright::document {
namespace {

using Kind = part::ToleranceKind;
using Rule = part::ToleranceRule;
using tolerance::Case;
using tolerance::counts_deflection;
using tolerance::Profile;

constexpr std::size_t kCases = 10000, kSamples = 100000, kPieces = 2000,
                      kCoefficients = 16;
constexpr double kLargest_mm = 1000;
constexpr double kMostWork = 1e9;    // draws times sources of one request: half a minute
constexpr std::size_t kSorting = 3;  // sources whose drawing takes as long as the sorting
const Bounds kDeviation = within(-kLargest_mm, kLargest_mm, "mm");
const Bounds kAlong = within(-1e6, 1e6, "mm");

struct NamedCase {
  std::string id;  ///< empty: the request gave none
  Case value;
  std::optional<tolerance::BudgetDemand> budget;
};

const Choices<Kind>& kinds() {
  static const Choices<Kind> kAll = [] {
    Choices<Kind> all;
    for (const auto& row : part::tolerance_kinds()) all.emplace_back(row.name, row.kind);
    return all;
  }();
  return kAll;
}

tolerance::PiecewisePolynomial read_polynomial(Reader r) {
  tolerance::PiecewisePolynomial f;
  const std::size_t before = r.problems().list.size();
  f.breaks_mm = r.numbers("breaks_mm", kAlong, 2, kPieces + 1);
  for (std::size_t k = 0; k + 1 < f.breaks_mm.size(); ++k)
    if (f.breaks_mm[k + 1] <= f.breaks_mm[k]) {
      r.problem_at("breaks_mm", tr("rising places"), "order");
      break;
    }
  for (const auto& piece : r.items("coefficients", 1, kPieces))
    f.coefficients.push_back(piece.as_numbers(within(-1e12, 1e12), 1, kCoefficients));
  if (!f.breaks_mm.empty() && !f.coefficients.empty() &&
      f.breaks_mm.size() != f.coefficients.size() + 1)
    r.problem_at("coefficients", tr("one list for each piece between two breaks"),
                 "count");
  else if (r.problems().list.size() == before && tolerance::magnitude_mm(f) > kLargest_mm)
    r.problem_at("coefficients", tr("terms that add up to 1000 mm at most"), "range");
  r.finish();
  return f;
}

Profile read_profile(const Reader& r) {
  if (r.is_object()) return read_polynomial(r);
  if (!r.broken() && !r.is_array()) {
    r.problem(tr("a list of samples or an object with breaks_mm and coefficients"),
              "type");
    return {};
  }
  return tolerance::Samples{.e_mm = r.as_numbers(kDeviation, 1, kSamples)};
}

/// A length's e_mm that gives both faces: a list of two lists or objects.
bool is_pair(const Reader& e) {
  return e.is_array() && !e.json().empty() && e.json().front().is_structured();
}

void read_places(Reader& r, Profile& profile) {
  if (!r.has("z_mm")) return;
  auto* samples = std::get_if<tolerance::Samples>(&profile);
  const auto z = r.numbers("z_mm", kAlong, 1, kSamples);
  if (!samples) {
    r.problem_at("z_mm", tr("none beside breaks_mm"), "combination");
    return;
  }
  samples->z_mm = z;
  if (!z.empty() && !samples->e_mm.empty() && z.size() != samples->e_mm.size())
    r.problem_at("z_mm", tr("as many places as e_mm has samples"), "count");
  if (std::ranges::adjacent_find(z, std::greater<>()) != z.end())
    r.problem_at("z_mm", tr("places that do not fall"), "order");
}

void read_error(Reader& r, Case& c) {
  if (!counts_deflection(c) && !r.has("e_mm")) return;
  const Reader e = r.at("e_mm", tr("a list of samples or a piecewise polynomial"));
  if (c.kind == Kind::length && is_pair(e)) {
    if (const auto faces = e.as_items(2, 2); !faces.empty()) {
      c.other_mm = read_profile(faces[0]);
      c.e_mm = read_profile(faces[1]);
    }
    return;
  }
  c.e_mm = read_profile(e);
  if (c.kind == Kind::straightness) read_places(r, c.e_mm);
}

void read_limits(Reader& r, Case& c) {
  const double upper = r.number("upper_mm", kDeviation);
  const double lower = r.number("lower_mm", kDeviation);
  if (lower >= upper) r.problem_at("lower_mm", tr("less than upper_mm"), "order");
  c.limits = {.lower_mm = lower, .upper_mm = upper};
}

/// Nothing if the kind is not known, for then no other key can be judged.
std::optional<Case> read_case(Reader& r) {
  Case c{.e_mm = {}};
  const std::size_t before = r.problems().list.size();
  c.kind = r.choice("tolerance", kinds());
  if (r.broken() || r.problems().list.size() != before) return std::nullopt;
  const auto& facts = part::facts(c.kind);
  const bool size = facts.rule == Rule::size;
  const bool profile =
      facts.rule == Rule::profile || facts.rule == Rule::floating_profile;
  if (facts.axis_rule)
    c.controlled = r.choice_or<tolerance::Controlled>(
        "controlled",
        {{"face", tolerance::Controlled::face}, {"axis", tolerance::Controlled::axis}},
        c.controlled);
  if (c.kind == Kind::diameter)
    c.envelope = r.choice_or<tolerance::Envelope>(
        "envelope",
        {{"shaft", tolerance::Envelope::shaft}, {"bore", tolerance::Envelope::bore}},
        c.envelope);
  read_error(r, c);
  if (size)
    read_limits(r, c);
  else
    c.value_mm = r.number("value_mm", above_up_to(0, 1000, "mm"));
  if (profile)
    c.half_angle_rad = units::rad_from_deg(
        r.number_or("half_angle_deg", at_least_below(0, 90, "deg"), 0));
  if (counts_machine(c))
    c.machine_mm = r.number_or("machine_mm", within(0, 1000, "mm"), 0);
  return c;
}

std::vector<NamedCase> read_request(const nlohmann::json& request) {
  Problems problems{.document = "acceptance"};
  Reader r = Reader(request, problems).as_object();
  read_format(r, "turnwright-acceptance/1");
  std::vector<NamedCase> out;
  for (Reader item : r.items("cases", 1, kCases)) {
    item = item.as_object();
    std::string id = item.text_or("id", "");
    std::optional<tolerance::BudgetDemand> budget;
    if (const auto asked = item.find("budget")) budget = read_budget(*asked);
    if (auto value = read_case(item)) {
      item.finish();
      out.push_back({std::move(id), std::move(*value), std::move(budget)});
    }
  }
  double work = 0;
  for (const NamedCase& c : out)
    if (c.budget)
      work += static_cast<double>(c.budget->draws.count *
                                  (c.budget->sources.size() + kSorting));
  if (work > kMostWork)
    r.problem_at("cases",
                 tr("budgets of 1e9 draws times sources in all, three sources more for "
                    "each budget to sort its draws"),
                 "range");
  r.finish();
  problems.throw_if_any();
  return out;
}

}  // namespace

nlohmann::json acceptance(const nlohmann::json& request) {
  auto cases = nlohmann::json::array();
  for (const auto& [id, value, budget] : read_request(request)) {
    leave_if_asked();
    const tolerance::Verdict v = tolerance::verdict(value);
    nlohmann::json out{{"accepted", v.accepted},
                       {"accepted_after_offset", v.accepted_after_offset},
                       {"offset_mm", v.offset_mm},
                       {"offset_into_limits_mm", v.offset_into_limits_mm},
                       {"published_verdict", v.published_verdict},
                       {"extremes_mm", {v.extremes_mm.min_mm, v.extremes_mm.max_mm}},
                       {"measured_mm", v.measured_mm},
                       {"allowed_mm", v.allowed_mm},
                       {"margin_mm", v.margin_mm},
                       {"margin_after_offset_mm", v.margin_after_offset_mm},
                       {"why", v.why}};
    if (!id.empty()) out["id"] = id;
    if (budget) out["budget"] = to_json(tolerance::budget(*budget, room_um(v)));
    cases.push_back(std::move(out));
  }
  return {{"cases", std::move(cases)}};
}

}  // namespace turnwright::document
