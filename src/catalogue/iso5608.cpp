#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/say.hpp"
#include "designation.hpp"
#include "turnwright/catalogue/tool_codes.hpp"

namespace turnwright::catalogue {
namespace {

constexpr std::string_view kStyles = "ABCDEFGHJKLMNRSTUVWY";
constexpr std::array kStyleKapr_deg{90.0,  75.0, 90.0, 45.0, 60.0, 90.0, 90.0,
                                    107.5, 93.0, 75.0, 95.0, 50.0, 63.0, 75.0,
                                    45.0,  60.0, 93.0, 72.5, 60.0, 85.0};
static_assert(kStyles.size() == kStyleKapr_deg.size());

constexpr std::string_view kLengths = "ABCDEFGHJKLMNPQRSTUVWY";
constexpr std::array kLengths_mm{32.0,  40.0,  50.0,  60.0,  70.0,  80.0,  90.0,  100.0,
                                 110.0, 125.0, 140.0, 150.0, 160.0, 170.0, 180.0, 200.0,
                                 250.0, 300.0, 350.0, 400.0, 450.0, 500.0};
static_assert(kLengths.size() == kLengths_mm.size());

constexpr std::string_view kClampings = "CDMPSW", kShapes = "CDEHMOPRSTVW",
                           kHands = "RLN";

double take_kapr_deg(Designation& reader) {
  return kStyleKapr_deg[kStyles.find(reader.take_one_of(kStyles))];
}

double take_clearance_deg(Designation& reader) {
  const auto clearance = clearance_of_letter_deg(reader.take(1).front());
  if (!clearance) reader.fail(say("must be one of {}", "ABCDEFGNP"));
  return *clearance;
}

std::optional<double> take_length_mm(Designation& reader, const std::string& uncoded) {
  const auto at = kLengths.find(reader.take_one_of(std::string(kLengths) + uncoded));
  return at == std::string_view::npos ? std::nullopt : std::optional(kLengths_mm[at]);
}

char length_letter(const std::optional<double>& length_mm) {
  const auto at = length_mm
                      ? std::find(kLengths_mm.begin(), kLengths_mm.end(), *length_mm)
                      : kLengths_mm.end();
  if (at == kLengths_mm.end()) return 'X';
  return kLengths[static_cast<std::size_t>(at - kLengths_mm.begin())];
}

// How the insert is clamped, its shape, the style, the clearance and the hand: alike of
// holders and of bars.
template <class Shank>
void take_head(Designation& reader, Shank& shank) {
  reader.take_one_of(kClampings);
  shank.insert_shape = reader.take_one_of(kShapes);
  shank.kapr_deg = take_kapr_deg(reader);
  shank.clearance_deg = take_clearance_deg(reader);
  shank.hand = reader.take_one_of(kHands);
}

}  // namespace

Holder5608 decode_iso5608(const std::string& designation) {
  Designation reader("decode_iso5608", designation);
  Holder5608 holder;
  take_head(reader, holder);
  holder.h_mm = reader.take_two_digits();
  holder.b_mm = reader.take_two_digits();
  holder.lf_mm = take_length_mm(reader, "X-");
  holder.edge_code = reader.take_two_digits();
  return holder;
}

std::optional<double> style_kapr_deg(char style) {
  const auto at = kStyles.find(style);
  return at == std::string_view::npos ? std::nullopt : std::optional(kStyleKapr_deg[at]);
}

std::string encode_iso5608(char clamping, char style, const Holder5608& holder) {
  const auto clearance = clearance_letter(holder.clearance_deg);
  const auto text =
      fmt::format("{}{}{}{}{} {:02}{:02}{} {:02}", clamping, holder.insert_shape, style,
                  clearance.value_or('?'), holder.hand, holder.h_mm, holder.b_mm,
                  length_letter(holder.lf_mm), holder.edge_code);
  const auto again = decode_iso5608(text);
  if (again.h_mm != holder.h_mm || again.b_mm != holder.b_mm ||
      again.edge_code != holder.edge_code)
    throw std::domain_error("encode_iso5608: \"" + text +
                            "\": shank and edge must have two digits");
  return text;
}

Bar5609 decode_iso5609(const std::string& designation) {
  Designation reader("decode_iso5609", designation);
  Bar5609 bar;
  bar.shank = reader.take_one_of("ASE");
  bar.diameter_mm = reader.take_two_digits();
  if (!(bar.diameter_mm > 0)) reader.fail(tr("must be a diameter above 0 mm"));
  bar.length_mm = take_length_mm(reader, "X");
  take_head(reader, bar);
  bar.edge_code = reader.take_two_digits();
  return bar;
}

}  // namespace turnwright::catalogue
