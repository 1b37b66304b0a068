#include <array>

#include "base/say.hpp"
#include "dxf_strokes.hpp"

namespace turnwright::exchange::dxf {
namespace {

// Words in the names of layers and line types, in English and German.
constexpr std::array<std::string_view, 6> kCentre{"CENTER", "CENTRE", "MITTE",
                                                  "AXIS",   "ACHS",   "STRICHPUNKT"};
constexpr std::array<std::string_view, 4> kHidden{"HIDDEN", "VERDECKT", "DASHED",
                                                  "UNSICHTBAR"};
constexpr std::array<std::string_view, 17> kOther{
    "DIM",       "BEMASS", "MASSE",   "HATCH",   "SCHRAFF", "TEXT",
    "SCHRIFT",   "TITLE",  "FRAME",   "RAHMEN",  "BORDER",  "NOTE",
    "DEFPOINTS", "THREAD", "GEWINDE", "PHANTOM", "VIEWPORT"};
// ISO 128 line types as they are named in drawings: 04, 08, 10 are dash-dot; 02, 03 dashes.
constexpr std::array<std::string_view, 4> kDashDot{"ACAD_ISO04", "ACAD_ISO08",
                                                   "ACAD_ISO10", "DASHDOT"};
constexpr std::array<std::string_view, 2> kDashes{"ACAD_ISO02", "ACAD_ISO03"};

template <class Words>
bool holds(const std::string& name, const Words& words) {
  for (const auto word : words)
    if (name.find(word) != std::string::npos) return true;
  return false;
}

// "CL" as a word of its own, as in "CL" and "PART_CL".
bool has_word(const std::string& name, std::string_view word) {
  const auto letter = [](char c) { return c >= 'A' && c <= 'Z'; };
  for (auto at = name.find(word); at != std::string::npos; at = name.find(word, at + 1)) {
    const auto end = at + word.size();
    if ((at == 0 || !letter(name[at - 1])) && (end == name.size() || !letter(name[end])))
      return true;
  }
  return false;
}

}  // namespace

Role role_of(const std::string& layer, const std::string& linetype) {
  if (holds(linetype, kCentre) || holds(linetype, kDashDot)) return Role::centre;
  if (holds(layer, kCentre) || has_word(layer, "CL")) return Role::centre;
  if (holds(layer, kOther) || holds(linetype, std::array{std::string_view("PHANTOM")}))
    return Role::other;
  if (holds(linetype, kHidden) || holds(linetype, kDashes) || holds(layer, kHidden))
    return Role::hidden;
  return Role::contour;
}

double unit_mm(const File& file, std::vector<Remark>& assumed) {
  // Drawing units of $INSUNITS that a part can be drawn in.
  constexpr std::array<double, 22> kUnits_mm{0,    25.4, 304.8,   1609344, 1,     10,
                                             1000, 1e6,  25.4e-6, 0.0254,  914.4, 1e-7,
                                             1e-6, 1e-3, 100,     1e4,     1e5,   1e12};
  const auto units = file.header.find("$INSUNITS");
  const long n = units == file.header.end() ? 0 : integer(units->second);
  if (n > 0 && n < static_cast<long>(kUnits_mm.size()) &&
      kUnits_mm[static_cast<std::size_t>(n)] > 0)
    return kUnits_mm[static_cast<std::size_t>(n)];
  if (n != 0)
    refuse("$INSUNITS", std::to_string(n),
           tr("a unit of length, like 4 for mm, 1 for inch"));
  const auto system = file.header.find("$MEASUREMENT");
  if (system == file.header.end()) {
    assumed.push_back(
        {"$INSUNITS", tr("The drawing names no unit; it is taken to be in mm.")});
    return 1;
  }
  const bool metric = integer(system->second) != 0;
  assumed.push_back(
      {"$MEASUREMENT", say("The drawing has no $INSUNITS; its $MEASUREMENT {} is "
                           "taken to mean {}.",
                           system->second.value, metric ? "mm" : "inch")});
  return metric ? 1 : 25.4;
}

}  // namespace turnwright::exchange::dxf
