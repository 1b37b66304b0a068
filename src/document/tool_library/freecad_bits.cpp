#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/say.hpp"
#include "hole_tool_draft.hpp"
#include "library_readers.hpp"
#include "turnwright/catalogue/tool_codes.hpp"

namespace turnwright::document {
namespace {

using nlohmann::json;

// Parameters of a bit, "6.35 mm" or "45.00 °"; those that cannot be read are collected.
class Parameters {
 public:
  explicit Parameters(const json& bit) : values_(member_of(bit, "parameter")) {}
  bool has(const char* key) const { return values_.contains(key); }
  double length_mm(const char* key) { return read(key, "mm"); }
  double angle_deg(const char* key) { return read(key, "deg"); }
  const std::string& wrong() const { return wrong_; }

 private:
  static std::optional<double> factor(std::string_view unit, std::string_view wanted) {
    if (unit.empty()) return 1;
    if (wanted == "mm") return unit_mm(unit);
    return unit == "°" || unit == "deg" ? std::optional(1.0) : std::nullopt;
  }
  double read(const char* key, const char* wanted) {
    const json& value = member_of(values_, key);
    std::optional<double> number;
    if (value.is_number()) number = value.get<double>();
    if (value.is_string()) {
      const auto& text = value.get_ref<const std::string&>();
      const auto given = quantity(text);
      const auto times = given ? factor(given->unit, wanted) : std::nullopt;
      if (times) number = given->value * *times;
    }
    if (number && *number > 0) return *number;
    wrong_ += say("{}parameter/{}: got {}, expected a number > 0 {}",
                  wrong_.empty() ? "" : "; ", key, shown(value), wanted);
    return 0;
  }
  const json& values_;
  std::string wrong_;
};

std::optional<char> shape_by_angle(double tip_deg) {
  constexpr double kTyped_deg = 0.5;
  for (const char shape : {'C', 'D', 'V', 'T', 'S', 'E', 'M', 'P', 'H', 'O'})
    if (std::abs(*catalogue::included_angle_deg(shape) - tip_deg) < kTyped_deg)
      return shape;
  return std::nullopt;
}

// A tap, a reamer or a countersink: what its shape's file is called.
std::optional<LibraryTool> read_hole_bit(const json& bit, Parameters& parameters,
                                         LibraryTool t, std::string& why) {
  const auto given = [&](const char* key) {
    return parameters.has(key) ? std::optional(parameters.length_mm(key)) : std::nullopt;
  };
  t.DC_mm = given("Diameter");
  t.TP_mm = given("Pitch");
  t.LU_mm = given("CuttingEdgeLength");
  if (parameters.has("CuttingEdgeAngle"))
    t.SIG_deg = parameters.angle_deg("CuttingEdgeAngle");
  const json& attribute = member_of(bit, "attribute");
  if (!parameters.wrong().empty())
    why = say("It cannot be read: {}.", parameters.wrong());
  else if (member_of(attribute, "SpindleDirection") == "Reverse")
    why = tr("It turns to the left: part documents have right-hand threads.");
  return why.empty() ? std::optional(t) : std::nullopt;
}

std::optional<LibraryTool> read_bit(const json& bit, std::string& why) {
  Parameters parameters(bit);
  if (const json& shape = member_of(bit, "shape"); shape.is_string()) {
    const auto& file = shape.get_ref<const std::string&>();
    LibraryTool hole;
    hole.use = hole_use(file.substr(0, file.find('.')));
    const json& called = member_of(bit, "name");
    if (called.is_string()) hole.name = called.get<std::string>();
    hole.texts = {hole.name};
    if (!hole.use.empty()) return read_hole_bit(bit, parameters, std::move(hole), why);
  }
  if (!parameters.has("TipAngle") || !parameters.has("EdgeLength")) {
    why = tr(
        "It is no turning bit, which has TipAngle, EdgeLength, TipRadius and Rotation.");
    return std::nullopt;
  }
  LibraryTool t;
  const json& name = member_of(bit, "name");
  if (name.is_string()) t.name = name.get<std::string>();
  t.texts = {t.name};
  const double tip_deg = parameters.angle_deg("TipAngle");
  t.IC_mm = parameters.length_mm("EdgeLength");
  t.RE_mm = parameters.length_mm("TipRadius");
  t.KAPR_deg = 180 - parameters.angle_deg("Rotation") - tip_deg / 2;  // Eq. (1)
  t.SC = shape_by_angle(tip_deg);
  // A trigon has the corner of a rhombus of 80 deg.
  if (t.SC == 'C' && t.name.starts_with('W')) t.SC = 'W';
  if (!parameters.wrong().empty())
    why = say("It cannot be read: {}.", parameters.wrong());
  else if (!t.SC)
    why = say("No insert of ISO 1832 has a corner of {:g} deg.", tip_deg);
  return why.empty() ? std::optional(t) : std::nullopt;
}

// Numbers and paths of the bits that a library names.
std::vector<std::pair<long, std::string>> paths_of(const json& library) {
  std::vector<std::pair<long, std::string>> all;
  if (!library.is_object()) return all;
  for (const auto& tool : member_of(library, "tools")) {
    if (!tool.is_object() || all.size() >= kMostTools) continue;
    const json& path = member_of(tool, "path");
    const json& number = member_of(tool, "nr");
    if (path.is_string())
      all.emplace_back(number.is_number_integer() ? number.get<long>() : 0,
                       path.get<std::string>());
  }
  return all;
}

// Files by their paths, and by the ends of these, where the first of each counts.
class Files {
 public:
  explicit Files(const std::vector<NamedJson>& all) {
    for (const auto& file : all) {
      by_path_.emplace(file.name, &file);
      by_end_.emplace(end_of(file.name), &file);
    }
  }
  const NamedJson* find(const std::string& path) const {
    if (const auto whole = by_path_.find(path); whole != by_path_.end())
      return whole->second;
    const auto end = by_end_.find(end_of(path));
    return end == by_end_.end() ? nullptr : end->second;
  }

 private:
  static std::string end_of(const std::string& path) {
    return path.substr(path.find_last_of("/\\") + 1);
  }
  std::map<std::string, const NamedJson*> by_path_, by_end_;
};

}  // namespace

ToolLibrary read_freecad_bits(const std::vector<NamedJson>& bits) {
  ToolLibrary out;
  for (const auto& [name, value] : bits) {
    std::string why;
    auto tool =
        member_of(*value, "parameter").is_object() ? read_bit(*value, why) : std::nullopt;
    if (tool) {
      tool->at = name;
      out.tools.push_back(std::move(*tool));
    } else {
      out.ignored.push_back(
          {name,
           why.empty() ? tr("It is no bit of FreeCAD, {\"parameter\": {..}}.") : why});
    }
  }
  return out;
}

ToolLibrary read_freecad_libraries(const std::vector<NamedJson>& libraries,
                                   const std::vector<NamedJson>& bits) {
  const Files files(bits);
  std::vector<NamedJson> named;
  std::vector<PlacedRemark> missing;
  std::set<std::string> taken;
  for (const auto& [library, value] : libraries)
    for (const auto& [number, path] : paths_of(*value)) {
      if (missing.size() >= kMostTools) break;
      const auto* bit = files.find(path);
      if (!bit)
        missing.push_back({readable(shortened(fmt::format("T{} {}", number, path), 200)),
                           say("{} names it, and it is not among the files.", library)});
      else if (taken.insert(bit->name).second)
        named.push_back({fmt::format("T{} {}", number, bit->name), bit->value});
    }
  for (const auto& bit : bits)
    if (!taken.contains(bit.name)) named.push_back(bit);
  auto out = read_freecad_bits(named);
  out.ignored.insert(out.ignored.begin(), missing.begin(), missing.end());
  return out;
}

}  // namespace turnwright::document
