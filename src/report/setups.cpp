#include "setups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fields.hpp"
#include "layout.hpp"
#include "proof.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

std::string clamped(const std::string& clamping, const std::string& end) {
  const std::string other = end == "left" ? "right" : "left";
  if (clamping == "chuck") return fmt::format("{} end in the chuck", end);
  if (clamping == "chuck-steady")
    return fmt::format("{} end in the chuck, on a steady rest", end);
  if (clamping == "chuck-tailstock")
    return fmt::format("{} end in the chuck, {} end on the tailstock centre", end, other);
  if (clamping == "tailstock-follow")
    return fmt::format(
        "{} end in the chuck, {} end on the tailstock centre, a follow rest at the tool",
        end, other);
  if (clamping == "between-centres")
    return fmt::format("between centres, {} end at the headstock", end);
  return fmt::format("{} end, {}", end, clamping);
}

// A setup that no clamping can hold names one that it also rejects.
bool held(const ordered_json& setup) {
  const auto& rejected = list(setup, "rejected");
  return std::none_of(rejected.begin(), rejected.end(), [&](const ordered_json& r) {
    return word(r, "clamping") == word(setup, "clamping");
  });
}

std::string holding(const ordered_json& setup) {
  std::string text = held(setup) ? clamped(word(setup, "clamping"), word(setup, "hold"))
                                 : word(setup, "hold") + " end, no clamping allowed can";
  if (const auto grip = number(setup, "grip_mm"))
    text += fmt::format(", {} mm gripped", shown(grip, 1));
  if (const auto force = number(setup, "grip_force_N"); force && *force > 0)
    text += fmt::format(", jaws with {} kN", shown(*force / 1000, 1));
  const auto eased = number(setup, "finishing_grip_force_N");
  if (eased && eased < number(setup, "grip_force_N"))
    text += fmt::format(", {} kN to finish", shown(*eased / 1000, 1));
  return text;
}

// Passes that follow each other with the same depth, feed and speed.
struct Run {
  const ordered_json* first = nullptr;
  std::size_t count = 0;
  double n_least = INFINITY, n_most = -INFINITY;
};

bool same_conditions(const ordered_json& a, const ordered_json& b) {
  return std::ranges::all_of(
      std::initializer_list<const char*>{"ap_mm", "f_mm_rev", "vc_m_min"},
      [&](const char* key) { return number(a, key) == number(b, key); });
}

std::vector<Run> runs(const ordered_json& passes) {
  std::vector<Run> all;
  for (const auto& pass : passes) {
    if (all.empty() || !same_conditions(*all.back().first, pass))
      all.push_back({.first = &pass});
    auto& run = all.back();
    ++run.count;
    if (const auto n = number(pass, "n_rpm")) {
      run.n_least = std::min(run.n_least, *n);
      run.n_most = std::max(run.n_most, *n);
    }
  }
  return all;
}

std::string speeds(const Run& run) {
  if (!(run.n_least <= run.n_most)) return "-";
  const auto least = shown(run.n_least, 0), most = shown(run.n_most, 0);
  return least == most ? least : least + "-" + most;
}

std::string note(const ordered_json& operation) {
  std::vector<std::string> on, binding;
  for (const auto& id : list(operation, "on"))
    if (id.is_string()) on.push_back(id.get<std::string>());
  for (const auto& c : list(operation, "constraints"))
    if (flag(c, "binding")) binding.push_back(word(c, "name"));
  const auto direction = word(operation, "direction");
  std::string text = word(operation, "kind") + " " + joined(on);
  if (direction == "to-chuck") text += ", towards the chuck";
  if (direction == "from-chuck") text += ", away from the chuck";
  text += binding.empty() ? "; no limit binds" : "; bound by " + joined(binding);
  const auto certificate = operation.find("certificate");
  const auto reason = certificate == operation.end() ? "" : word(*certificate, "reason");
  if (!reason.empty())
    text += (word(*certificate, "kind") == "local" ? "; not proven: " : "; ") + reason;
  return text;
}

// The operation's first run has its name, time and cost; the others only conditions.
void add_rows(const ordered_json& operation, std::vector<Row>& rows) {
  const auto certificate = operation.find("certificate");
  const auto all = runs(list(operation, "passes"));
  for (std::size_t i = 0; i < std::max<std::size_t>(all.size(), 1); ++i) {
    Row row{std::vector<std::string>(10), ""};
    auto& cells = row.cells;
    if (i == 0) {
      cells[0] = word(operation, "id");
      cells[1] = word(operation, "tool");
      cells[7] = shown(number(operation, "time_min"), 3);
      cells[8] = shown(number(operation, "cost"), 3);
      cells[9] = certificate == operation.end() ? "-" : gap(*certificate);
    }
    if (i < all.size()) {
      const auto& pass = *all[i].first;
      cells[2] = std::to_string(all[i].count);
      cells[3] = shown(number(pass, "ap_mm"), 3);
      cells[4] = shown(number(pass, "f_mm_rev"), 3);
      cells[5] = shown(number(pass, "vc_m_min"), 1);
      cells[6] = speeds(all[i]);
    }
    rows.push_back(std::move(row));
  }
  rows.back().note = note(operation);
}

std::string conditions(const ordered_json& operations) {
  if (operations.empty()) return "  No operations.\n";
  std::vector<Row> rows;
  for (const auto& operation : operations) add_rows(operation, rows);
  return table({{"operation", Align::left},
                {"tool", Align::left},
                {"no."},
                {"ap mm"},
                {"f mm/r"},
                {"vc m/min"},
                {"n 1/min"},
                {"min"},
                {"cost"},
                {"gap"}},
               rows);
}

}  // namespace

std::string setups(const ordered_json& plan_result) {
  std::string out;
  const bool feasible = word(plan_result, "status") != "infeasible";
  std::size_t index = 0;
  for (const auto& setup : list(plan_result, "setups")) {
    out += '\n' + paragraph(fmt::format("SETUP {}  ", index++), "hold " + holding(setup));
    for (const auto& rejected : list(setup, "rejected"))
      out +=
          paragraph("  not ", word(rejected, "clamping") + ": " + word(rejected, "why"));
    if (!feasible && !list(setup, "operations").empty())
      out += "  Conditions that come closest; they break limits, do not cut with them.\n";
    out += conditions(list(setup, "operations"));
  }
  return out;
}

}  // namespace turnwright::report
