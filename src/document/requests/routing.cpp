#include "routing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <vector>

#include "base/say.hpp"

namespace turnwright::document {
namespace {

using nlohmann::ordered_json;

constexpr int kStep = 10;  // operations of a routing are numbered 10, 20, ..

std::string csv_cell(const ordered_json& value) {
  if (value.is_number()) return value.dump();
  auto text = value.get<std::string>();
  if (!text.empty() && std::string_view("=+-@\t\r").find(text[0]) != text.npos)
    text.insert(0, 1, '\'');
  if (text.find_first_of(",;\"\t\r\n") == text.npos) return text;
  for (auto at = text.find('"'); at != text.npos; at = text.find('"', at + 2))
    text.insert(at, 1, '"');
  return fmt::format("\"{}\"", text);
}

}  // namespace

ordered_json routing_rows(const std::string& part, const std::string& made_by,
                          const planning::Offer& offer) {
  auto rows = ordered_json::array();
  const auto& machine = offer.part->machine;
  int number = 0;
  for (const auto& setup : offer.plan->setups) {
    const auto total = setup.breakdown.total();
    const auto& share = setup.breakdown.setup_share;
    const auto clamping = tr(planning::name(setup.clamping));
    const bool held_by_left = setup.hold == part::End::left;
    rows.push_back(
        {{"part", part},
         {"made_by", made_by},
         {"operation", number += kStep},
         {"machine", machine.id},
         {"description", held_by_left ? say("turn, left end held, {}", clamping)
                                      : say("turn, right end held, {}", clamping)},
         {"setup_min", machine.setup_min},
         {"run_min", total.time_min - share.time_min}});
  }
  return rows;
}

std::string routing_csv(const ordered_json& rows) {
  constexpr const char* kColumns[] = {"part",        "made_by",   "operation", "machine",
                                      "description", "setup_min", "run_min"};
  std::vector<std::string> lines{fmt::format("{}", fmt::join(kColumns, ","))};
  for (const auto& row : rows) {
    std::vector<std::string> cells;
    for (const char* column : kColumns) cells.push_back(csv_cell(row[column]));
    lines.push_back(fmt::format("{}", fmt::join(cells, ",")));
  }
  return fmt::format("{}\r\n", fmt::join(lines, "\r\n"));
}

}  // namespace turnwright::document
