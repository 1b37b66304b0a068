#include "turnwright/report/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "common.hpp"
#include "fields.hpp"
#include "layout.hpp"
#include "proof.hpp"
#include "setups.hpp"
#include "stack.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

std::string header(const ordered_json& result) {
  const auto name = word(result, "name");
  std::string out = name.empty() ? "PROCESS PLAN\n" : paragraph("PROCESS PLAN  ", name);
  if (word(result, "status") == "infeasible") {
    out += paragraph("status  ", "infeasible");
    if (const auto c = result.find("certificate"); c != result.end())
      out += paragraph("proof   ", proof(*c));
  } else {
    out += paragraph("status  ", "every limit is kept");
    out += paragraph("cost    ", shown(number(result, "cost_per_part"), 4) + " per part");
    out += paragraph("time    ",
                     shown(number(result, "time_per_part_min"), 3) + " min per part");
    if (const auto profit = number(result, "profit_per_min"))
      out += paragraph("profit  ", shown(profit, 4) + " per minute");
    if (const auto robust = result.find("robustness"); robust != result.end())
      out += paragraph("robust  ",
                       fmt::format("every tolerance is kept with {} %, for {} per part "
                                   "more than nominally",
                                   shown(100 * *number(*robust, "conformance"), 2),
                                   shown(number(*robust, "price_per_part"), 4)));
    const auto certificate = result.find("certificate");
    if (certificate != result.end()) out += paragraph("proof   ", proof(*certificate));
  }
  return out + made_by(result);
}

// One sentence of each member, in the order of importance.
std::string numbered(const std::vector<std::string>& sentences) {
  std::string out;
  std::size_t i = 0;
  for (const auto& sentence : sentences)
    out += paragraph(fmt::format("{:3}. ", ++i), sentence);
  return out;
}

std::string sentence_of(const ordered_json& member) {
  const auto sentence = word(member, "sentence");
  return sentence.empty() ? word(member, "limit") : sentence;
}

// "set 2: ", where there is more than one.
std::string set_of(const ordered_json& member, const ordered_json& all) {
  const auto set = number(member, "set");
  const bool several = std::any_of(all.begin(), all.end(), [](const ordered_json& other) {
    return number(other, "set").value_or(0) > 1;
  });
  return set && several ? "set " + shown(set, 0) + ": " : "";
}

std::string conflicts(const ordered_json& result) {
  const auto& all = list(result, "conflicts");
  if (all.empty()) return "";
  std::vector<std::string> sentences;
  for (const auto& conflict : all)
    sentences.push_back(set_of(conflict, all) + sentence_of(conflict));
  return "\nCONFLICTS  limits that cannot be kept together\n" + numbered(sentences);
}

// |ln(needed/now)|: how far a limit has to move, whichever way opens it.
double opening(const ordered_json& relaxation) {
  const auto now = number(relaxation, "now"), needed = number(relaxation, "needed");
  if (!now || !needed || !(*now > 0) || !(*needed > 0))
    return std::numeric_limits<double>::infinity();
  return std::abs(std::log(*needed / *now));
}

std::string relaxations(const ordered_json& result) {
  if (word(result, "status") != "infeasible") return "";
  const auto& members = list(result, "relax");
  std::string out = "\nWHAT WOULD HAVE TO GIVE  the smallest opening first";
  const bool several = std::any_of(
      members.begin(), members.end(),
      [&](const ordered_json& member) { return !set_of(member, members).empty(); });
  out += several ? ", one of every set\n" : "\n";
  std::vector<const ordered_json*> all;
  for (const auto& relaxation : members) all.push_back(&relaxation);
  if (all.empty()) return out + "  No limit was found whose opening alone would do.\n";
  std::stable_sort(all.begin(), all.end(), [](const auto* a, const auto* b) {
    return opening(*a) < opening(*b);
  });
  std::vector<std::string> sentences;
  for (const auto* relaxation : all) {
    auto sentence = set_of(*relaxation, members) + sentence_of(*relaxation);
    const double by = opening(*relaxation);
    if (std::isfinite(by)) {
      const double ratio = *number(*relaxation, "needed") / *number(*relaxation, "now");
      sentence += fmt::format(" [{:+.1f} %]", 100 * (ratio - 1));
    }
    sentences.push_back(std::move(sentence));
  }
  return out + numbered(sentences);
}

std::string remedies(const ordered_json& result) {
  const auto& all = list(result, "remedies");
  if (all.empty()) return "";
  std::vector<std::string> sentences;
  for (const auto& remedy : all) sentences.push_back(sentence_of(remedy));
  return "\nWHAT ELSE WOULD DO  each alone, as planned with it\n" + numbered(sentences);
}

// A number or a pair of mm, in um.
std::string micrometres(const ordered_json& tolerance, const char* key) {
  std::vector<std::string> parts;
  for (const auto& value : list(tolerance, key))
    parts.push_back(value.is_number() ? shown(units::um_from_mm(value.get<double>()), 1)
                                      : "-");
  if (!parts.empty()) return joined(parts, "..");
  const auto value = number(tolerance, key);
  return value ? shown(units::um_from_mm(*value), 1) : "-";
}

std::string verdict(const ordered_json& tolerance) {
  const auto ours = word(tolerance, "verdict");
  if (ours == "met-with-offset") return "offset";
  return ours == "not-met" ? "NOT MET" : ours;
}

// The published equations' verdict, where it is another.
std::string other_verdict(const ordered_json& tolerance) {
  const bool accepted = word(tolerance, "verdict") != "not-met";
  if (!tolerance.contains("seed_verdict") || flag(tolerance, "seed_verdict") == accepted)
    return "";
  return accepted ? "not met" : "met";
}

// A sentence, where the probability does not round to certainty.
std::string conformance(const ordered_json& tolerance) {
  const auto p = number(tolerance, "P_conform");
  if (!p || *p >= 0.99995) return "";
  return fmt::format("conforms with a probability of {} %", shown(100 * *p, 2));
}

std::string tolerances(const ordered_json& result) {
  std::vector<Row> rows;
  for (const auto& t : list(result, "tolerances")) {
    auto kind = word(t, "kind");
    std::replace(kind.begin(), kind.end(), '-', ' ');  // so that it wraps
    rows.push_back({{word(t, "id"), kind, word(t, "of"), micrometres(t, "predicted_mm"),
                     micrometres(t, "allowed_mm"), micrometres(t, "margin_mm"),
                     verdict(t), other_verdict(t)},
                    conformance(t)});
  }
  if (rows.empty()) return "";
  return "\nTOLERANCES\n" +
         paragraph(
             "  ",
             "predicted, allowed and margin in um; offset: met once the tool path is "
             "corrected; paper: the published acceptance equations, where they judge "
             "otherwise") +
         table({{"id", Align::left},
                {"kind", Align::left},
                {"of", Align::left},
                {"predicted"},
                {"allowed"},
                {"margin"},
                {"verdict", Align::left},
                {"paper", Align::left}},
               rows);
}

Stack stack_of(const ordered_json& tolerance) {
  Shares shares;
  for (const auto& s : list(tolerance, "shares"))
    shares.emplace_back(word(s, "source"), number(s, "um").value_or(0));
  const bool size = list(tolerance, "predicted_mm").size() == 2;
  return stack(units::um_from_mm(number(tolerance, "width_mm").value_or(0)),
               units::um_from_mm(number(tolerance, "margin_mm").value_or(0)),
               size ? 2 : 1, shares);
}

// A column a source, and what is left.
std::string budget(const ordered_json& result) {
  std::vector<const ordered_json*> tolerances;
  std::vector<Stack> stacks;
  for (const auto& t : list(result, "tolerances"))
    if (t.contains("width_mm")) {
      tolerances.push_back(&t);
      stacks.push_back(stack_of(t));
    }
  if (stacks.empty()) return "";
  const auto all = sources(stacks);
  std::vector<Column> columns{{"id", Align::left}, {"width"}};
  for (const auto& source : all) columns.push_back({clipped(source, 11)});
  columns.push_back({"left"});
  std::vector<Row> rows;
  for (std::size_t i = 0; i < stacks.size(); ++i) {
    Row row{{word(*tolerances[i], "id"), micrometres(*tolerances[i], "width_mm")}, ""};
    for (const auto& source : all) {
      double um = 0;
      for (const auto& [name, taken] : stacks[i].slices)
        if (name == source) um += taken;
      row.cells.push_back(um > 0 ? shown(um, 1) : "");
    }
    row.cells.push_back(shown(stacks[i].left_um, 1));
    rows.push_back(std::move(row));
  }
  return "\nBUDGET\n" +
         paragraph("  ",
                   "what takes each tolerance's width, um; independent sources add by "
                   "squares and are reduced in proportion") +
         table(columns, rows);
}

// The rows [z, dr] laid across the page, so many at a time.
std::string across(const ordered_json& rows) {
  constexpr std::size_t kAbreast = 9;
  std::string out;
  for (std::size_t i = 0; i < rows.size(); i += kAbreast) {
    std::vector<Column> columns{{"z mm", Align::left}};
    Row correction{{"dr um"}, ""};
    for (std::size_t k = i; k < std::min(i + kAbreast, rows.size()); ++k) {
      const auto& row = rows[k];
      if (!row.is_array() || row.size() != 2 || !row[0].is_number() ||
          !row[1].is_number())
        continue;
      columns.push_back({shown(row[0].get<double>(), 2)});
      correction.cells.push_back(shown(units::um_from_mm(row[1].get<double>()), 2));
    }
    out += table(columns, {correction});
  }
  return out;
}

std::string compensation(const ordered_json& result) {
  std::string out;
  for (const auto& c : list(result, "compensation"))
    out += paragraph("  ", fmt::format("{} in setup {}", word(c, "on"),
                                       shown(number(c, "setup"), 0))) +
           across(list(c, "table_mm"));
  if (out.empty()) return "";
  return "\nCOMPENSATION  add dr to the radius of the tool path at z\n" + out;
}

std::string prices(const ordered_json& result) {
  constexpr std::size_t kMost = 8;
  const auto& all = list(result, "prices");
  if (all.empty()) return "";
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < std::min(kMost, all.size()); ++i)
    sentences.push_back(sentence_of(all[i]));
  std::string out = "\nPRICES  what 10 % more room would save\n" + numbered(sentences);
  if (all.size() > kMost)
    out += fmt::format("  {} smaller ones are in the result document.\n",
                       all.size() - kMost);
  return out;
}

std::string what_if(const ordered_json& result) {
  const auto& all = list(result, "what_if");
  if (all.empty()) return "";
  std::vector<std::string> sentences;
  for (const auto& answer : all) sentences.push_back(sentence_of(answer));
  return "\nWHAT IF  planned anew with a change\n" + numbered(sentences);
}

// A string bare, anything else as JSON.
std::string plain(const ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

// One line each: a long value gives way to the reason.
std::string assumptions(const ordered_json& result) {
  constexpr std::size_t kWidth = kPageWidth - 2, kLeastValue = 16;
  std::string out;
  for (const auto& a : list(result, "assumed")) {
    const auto found = a.find("value");
    const auto value = found == a.end() ? "-" : plain(*found);
    const std::string lead = word(a, "pointer") + " = ", why = ": " + word(a, "why");
    const auto taken = std::min(characters(lead + why), kWidth - kLeastValue);
    out += "  " + clipped(lead + clipped(value, kWidth - taken) + why, kWidth) + '\n';
  }
  if (out.empty()) return "";
  return "\nASSUMED  what the request left open\n" + out;
}

}  // namespace

std::string text(const ordered_json& plan_result) {
  return header(plan_result) + conflicts(plan_result) + relaxations(plan_result) +
         remedies(plan_result) + setups(plan_result) + tolerances(plan_result) +
         budget(plan_result) + compensation(plan_result) + prices(plan_result) +
         what_if(plan_result) + assumptions(plan_result);
}

}  // namespace turnwright::report
