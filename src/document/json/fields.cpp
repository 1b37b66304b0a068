#include "fields.hpp"

#include "turnwright/base/language.hpp"

namespace turnwright::document {
namespace {

constexpr std::size_t kIdBytes = 64;

bool is_letter_or_digit(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
}

bool is_id(std::string_view text) {
  if (text.empty() || text.size() > kIdBytes || !is_letter_or_digit(text[0]))
    return false;
  for (const char c : text)
    if (!is_letter_or_digit(c) && std::string_view("_.+-").find(c) == text.npos)
      return false;
  return true;
}

}  // namespace

std::string read_id(Reader& r, std::string_view key) {
  const std::string expected =
      tr("an id of 1 to 64 letters, digits or _.+-, a letter or digit first");
  const Reader value = r.at(key, expected);
  if (value.broken()) return "";
  if (!value.is_text()) {
    value.problem(expected, "type");
    return "";
  }
  auto id = value.json().get<std::string>();
  if (!is_id(id)) {
    value.problem(expected, "range");
    return "";
  }
  return id;
}

void read_format(Reader& r, const std::string& format) {
  r.optional_text("$schema", 2000);
  if (const auto value = r.find("format"))
    if (!value->is_text() || value->json() != format)
      value->problem('"' + format + '"', "format");
}

void read_required_format(Reader& r, const std::string& format) {
  if (r.at("format", '"' + format + '"').broken()) return;
  read_format(r, format);
}

catalogue::Range read_range(Reader& r, std::string_view key, const Bounds& bounds) {
  const auto ends = r.numbers(key, bounds, 2, 2);
  if (ends.size() != 2) return {};
  if (ends[0] > ends[1])
    r.problem_at(key, tr("[lower, upper] with lower <= upper"), "order");
  return {.lower = ends[0], .upper = ends[1]};
}

double finish_group(Reader& group) {
  const double uncertainty_pct = group.number("uncertainty_pct", within(0, 100, "%"));
  group.text("source", 1000);
  group.optional_text("note", 2000);
  group.finish();
  return uncertainty_pct;
}

std::string read_currency(Reader& r) {
  constexpr std::size_t kMost = 10;
  return r.has("currency") ? r.text("currency", kMost) : "";
}

catalogue::Rechucking read_rechucking_by_jaws(Reader r) {
  const auto error = within(0, 1000, "um");
  r = r.as_object();
  const catalogue::Rechucking by{.hard_jaws_um = r.number("hard_jaws", error),
                                 .soft_jaws_um = r.number("soft_jaws", error),
                                 .collet_um = r.number("collet", error),
                                 .centres_um = r.number("centres", error)};
  r.finish();
  return by;
}

const Choices<catalogue::IsoGroup>& iso_groups() {
  using enum catalogue::IsoGroup;
  static const Choices<catalogue::IsoGroup> kGroups{{"P", P}, {"M", M}, {"K", K},
                                                    {"N", N}, {"S", S}, {"H", H}};
  return kGroups;
}

catalogue::RootCompliance read_compliance(Reader r) {
  const catalogue::RootCompliance c{
      .c0_mm_N = r.number("c0_mm_N", within(0, 0.1, "mm/N")),
      .c1_rad_N = r.number("c1_rad_N", within(-0.01, 0.01, "rad/N")),
      .c2_rad_Nmm = r.number("c2_rad_Nmm", within(0, 1e-3, "rad/(N mm)"))};
  r.finish();
  // The work of a force and a couple is never negative, up to rounding.
  const double product = c.c0_mm_N * c.c2_rad_Nmm;
  if (c.c1_rad_N * c.c1_rad_N > product * (1 + 1e-12))
    r.problem(tr("c0_mm_N times c2_rad_Nmm at least c1_rad_N squared"), "conflict");
  return c;
}

std::vector<catalogue::TipMode> read_tip_modes(Reader& r) {
  std::vector<catalogue::TipMode> modes;
  for (Reader item : r.items("modes", 1, 10)) {
    item = item.as_object();
    auto& m = modes.emplace_back();
    m.along_feed = item.choice<bool>("axis", {{"x", true}, {"y", false}});
    m.frequency_Hz = item.number("frequency_Hz", above_up_to(0, 1e5, "Hz"));
    m.damping_ratio = item.number("damping_ratio", kDamping);
    m.stiffness_N_mm = item.number("stiffness_N_mm", above_up_to(0, 1e9, "N/mm"));
    item.finish();
  }
  return modes;
}

}  // namespace turnwright::document
