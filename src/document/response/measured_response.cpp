#include "measured_response.hpp"

#include <array>
#include <utility>

#include "base/say.hpp"

namespace turnwright::document {
namespace {

constexpr std::array<std::string_view, 14> kResponseUnits{
    "mm/N", "um/N", "m/N",    "mm/s/N",  "m/s/N",    "mm/s2/N",   "m/s2/N",
    "g/N",  "nm/N", "in/lbf", "mil/lbf", "in/s/lbf", "in/s2/lbf", "g/lbf"};

}  // namespace

std::size_t problems_of(const Reader& r) {
  return r.problems().list.size() + r.problems().more;
}

std::optional<WrittenUnit> read_response_unit(Reader& r) {
  Choices<std::string_view> choices;
  for (const std::string_view unit : kResponseUnits) choices.emplace_back(unit, unit);
  const auto text = r.optional_choice<std::string_view>("unit", choices);
  if (!text) return std::nullopt;
  return WrittenUnit{std::string(*text), response_unit(*text).value_or(ResponseUnit{})};
}

std::optional<WrittenUnit> agreed_unit(Reader& r, const std::optional<WrittenUnit>& given,
                                       const std::optional<WrittenUnit>& stated,
                                       const std::string& where) {
  if (given && stated && given->unit != stated->unit) {
    r.problem_at("unit", say("none or {}, as {}", shown(stated->text), where),
                 "conflict");
    return std::nullopt;
  }
  if (!given && !stated)
    r.problem_at("unit", say("a unit of motion per force here or {}", where), "missing");
  return stated ? stated : given;
}

}  // namespace turnwright::document
