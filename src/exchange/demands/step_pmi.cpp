#include "step_pmi.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <numbers>
#include <string_view>

#include "base/say.hpp"
#include "pmi_read.hpp"
#include "step_pmi_place.hpp"

namespace turnwright::exchange {
namespace {

constexpr double kRoughest_um = 100;  // Ra, as the part document has it
constexpr double kDeepest_um = 400;   // Rz

bool separates(char c) { return c == ' ' || c == '-' || c == ':' || c == ','; }

// One letter of `letters` at `at`, which is then behind it; "" if there is none.
std::string letter_of(std::string_view letters, std::string_view text, std::size_t& at) {
  if (at >= text.size() || letters.find(text[at]) == std::string_view::npos) return "";
  return std::string(1, text[at++]);
}

// "ISO 2768-mK" out of a note, however it is spaced, "ISO 2768-1 - m" too; "" without.
std::string general_tolerances(std::string_view note) {
  constexpr std::string_view kStandard = "2768";
  auto at = note.find(kStandard);
  if (at == std::string_view::npos) return "";
  at += kStandard.size();
  const auto skip = [&] {
    while (at < note.size() && separates(note[at])) ++at;
  };
  skip();
  if (at < note.size() && (note[at] == '1' || note[at] == '2')) ++at;
  skip();
  const auto sizes = letter_of("fmcv", note, at);
  const auto form = letter_of("HKL", note, at);
  const bool word =
      at < note.size() && std::isalpha(static_cast<unsigned char>(note[at]));
  return word || (sizes + form).empty() ? "" : "ISO 2768-" + sizes + form;
}

void add_product(const Pmi& pmi, Outline& outline) {
  const auto fill = [](std::string& place, const std::string& text) {
    if (place.empty()) place = text;
  };
  // Many systems write the name of the model as its number.
  if (pmi.part_number != pmi.part_name)
    fill(outline.title.drawing_number, pmi.part_number);
  fill(outline.title.revision, pmi.revision);
  fill(outline.name, pmi.part_name);
  fill(outline.material, pmi.material);
  for (const auto& note : pmi.notes) fill(outline.general, general_tolerances(note.text));
}

void leave_texture_out(const SurfaceTexture& t, const std::string& reason,
                       Outline& outline) {
  outline.ignored.push_back({t.at, say("The roughness {} {} um is left out: {}.",
                                       t.parameter, t.value_um, reason)});
}

void add_texture(const SurfaceTexture& t, const Places& places, Outline& outline) {
  const bool Ra = t.parameter == "Ra";
  if (!Ra && t.parameter != "Rz")
    return leave_texture_out(t, tr("a part document has Ra and Rz"), outline);
  if (!(t.value_um > 0 && t.value_um <= (Ra ? kRoughest_um : kDeepest_um)))
    return leave_texture_out(t, tr("no surface has it; is its unit right?"), outline);
  const auto of = places.of(t.of);
  if (of.empty())
    return leave_texture_out(t, tr("its surface is not in the outline"), outline);
  for (const auto& place : of) {
    if (place.kind == PlaceKind::other) {
      leave_texture_out(t, say("{} is {}", place.id, tr(name(place.kind))), outline);
      continue;
    }
    auto& demands = place.is_face() ? outline.faces[place.index].demands
                    : place.inner   ? outline.inner[place.index].demands
                                    : outline.outer[place.index].demands;
    (Ra ? demands.Ra_um : demands.Rz_um) = t.value_um;
  }
}

void leave_out_angles(const Pmi& pmi, Outline& outline) {
  const auto deg = [](double rad) { return rad * 180 / std::numbers::pi; };
  for (const auto& a : pmi.angles) {
    if (!a.lower_rad || !a.upper_rad) continue;
    auto text = a.name.empty() ? tr("angle") : a.name;
    if (a.nominal_rad) text += fmt::format(" {:.9g}", deg(*a.nominal_rad));
    outline.ignored.push_back(
        {a.at, say("The {} {:+.9g}/{:+.9g} deg is left out: a part document has no "
                   "tolerances of angles.",
                   text, deg(*a.upper_rad), deg(*a.lower_rad))});
  }
}

bool has_data(const Pmi& pmi) {
  return !(pmi.dimensions.empty() && pmi.angles.empty() && pmi.tolerances.empty() &&
           pmi.datums.empty() && pmi.textures.empty());
}

void tell_strokes(const Pmi& pmi, Outline& outline) {
  const auto& strokes = pmi.strokes_alone;
  if (strokes.empty()) return;
  if (!has_data(pmi)) {
    outline.ignored.push_back(
        {"", say("Dimensions and tolerances are drawn only: {} annotations are "
                 "strokes without data, of which nothing was read.",
                 pmi.annotations)});
    return;
  }
  constexpr std::size_t kShown = 10;
  const auto shown = std::min(strokes.size(), kShown);
  outline.ignored.push_back(
      {"", say("{} of {} annotations are strokes without data: {}{}.", strokes.size(),
               pmi.annotations,
               fmt::join(strokes.begin(),
                         strokes.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
               shown < strokes.size() ? " .." : "")});
}

}  // namespace

void add_pmi(const Pmi& pmi, Outline& outline) {
  add_product(pmi, outline);
  add_sizes(pmi, Places(outline), outline);
  const Places places(outline);  // some cylinders are threads by now
  add_tolerances(pmi, places, outline);
  for (const auto& texture : pmi.textures) add_texture(texture, places, outline);
  leave_out_angles(pmi, outline);
  tell_strokes(pmi, outline);
  outline.ignored.insert(outline.ignored.end(), pmi.unread.begin(), pmi.unread.end());
}

void add_pmi(const Exchange& file, Outline& outline) { add_pmi(read_pmi(file), outline); }

}  // namespace turnwright::exchange
