#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "base/say.hpp"
#include "document/json/pointer.hpp"
#include "hole_tool_draft.hpp"
#include "library_readers.hpp"

namespace turnwright::document {
namespace {

using nlohmann::json;

std::string text_at(const json& object, const char* key) {
  const json& value = member_of(object, key);
  return value.is_string() ? value.get<std::string>() : std::string();
}

std::optional<char> letter_at(const json& object, const char* key) {
  const auto text = text_at(object, key);
  if (text.size() != 1 || text[0] < 'A' || text[0] > 'Z') return std::nullopt;
  return text[0];
}

// "boring bar f" is style F; "custom" is none.
std::optional<char> style_at(const json& holder) {
  constexpr std::string_view kBar = "boring bar ";
  const auto text = text_at(holder, "THSC");
  if (text.starts_with(kBar) && text.size() == kBar.size() + 1)
    return static_cast<char>(std::toupper(static_cast<unsigned char>(text.back())));
  return letter_at(holder, "THSC");
}

// Numbers of one tool; those that are none are collected.
class Numbers {
 public:
  /// Zero is Fusion's "not said".
  std::optional<double> at(const json& object, const char* place, const char* key) {
    const json& value = member_of(object, key);
    if (value.is_null()) return std::nullopt;
    if (!value.is_number() || !(value.get<double>() >= 0)) {
      wrong_ += say("{}{}{}: got {}, expected a number from 0", separator(), place, key,
                    shown(value));
      return std::nullopt;
    }
    const auto number = value.get<double>();
    return number > 0 ? std::optional(number) : std::nullopt;
  }
  std::optional<double> length_mm(const json& object, const char* place, const char* key,
                                  double unit) {
    const auto number = at(object, place, key);
    return number ? std::optional(*number * unit) : std::nullopt;
  }
  /// The unit of `object`, or `otherwise` if it says none.
  double unit(const json& object, const char* place, double otherwise) {
    const json& value = member_of(object, "unit");
    if (value.is_null() && otherwise > 0) return otherwise;
    const auto mm = unit_mm(text_at(object, "unit"));
    if (!mm)
      wrong_ += say("{}{}unit: got {}, expected \"millimeters\" or \"inches\"",
                    separator(), place, shown(value));
    return mm.value_or(1);
  }
  const std::string& wrong() const { return wrong_; }

 private:
  const char* separator() const { return wrong_.empty() ? "" : "; "; }
  std::string wrong_;
};

void read_insert(const json& geometry, double unit, Numbers& numbers, LibraryTool& t) {
  constexpr const char* kPlace = "geometry/";
  t.SC = letter_at(geometry, "SC");
  t.TC = letter_at(geometry, "TC");
  t.type = letter_at(geometry, "SCTY");
  const auto size = numbers.length_mm(geometry, kPlace, "INSD", unit);
  (text_at(geometry, "SIZE_SPECIFICATION_MODE") == "CE" ? t.L_mm : t.size_mm) = size;
  t.S_mm = numbers.length_mm(geometry, kPlace, "S", unit);
  t.RE_mm = numbers.length_mm(geometry, kPlace, "RE", unit);
  t.AN_deg = numbers.at(geometry, kPlace, "RA");
  t.EPSR_deg = numbers.at(geometry, kPlace, "EPSR");
}

void read_fusion_holder(const json& holder, double tool_unit, Numbers& numbers,
                        LibraryTool& t) {
  constexpr const char* kPlace = "holder/";
  const double unit = numbers.unit(holder, kPlace, tool_unit);
  const auto length = [&](const char* key) {
    return numbers.length_mm(holder, kPlace, key, unit);
  };
  t.clamping = letter_at(holder, "MTP");
  t.style = style_at(holder);
  t.hand = letter_at(holder, "HAND");
  t.LF_mm = length("OAL");
  t.WF_mm = length("CW");
  t.LH_mm = length("LH");
  t.H_mm = length("H");
  t.B_mm = length("W");
  if (t.boring) t.DCON_mm = t.B_mm;
}

void read_presets(const json& item, double unit, Numbers& numbers, LibraryTool& t) {
  constexpr double kFoot_m = 0.3048;
  const json& presets = member_of(member_of(item, "start-values"), "presets");
  if (!presets.is_array()) return;
  for (const json& preset : presets) {
    const auto speed = numbers.at(preset, "presets/", "v_c");
    const auto feed = numbers.length_mm(preset, "presets/", "f_n", unit);
    if (speed || feed)
      t.presets.push_back(
          {speed.value_or(0) * (unit == 1 ? 1 : kFoot_m), feed.value_or(0)});
  }
}

// What is no turning tool, or none that a document can hold.
std::string other_type(const std::string& type) {
  constexpr std::array kNoCutters{"holder", "tool block", "probe"};
  if (std::ranges::find(kNoCutters, type) != kNoCutters.end())
    return say("\"{}\" is no cutting tool.", type);
  if (type == "tap left hand")
    return tr("\"tap left hand\": part documents have right-hand threads.");
  if (type.starts_with("turning "))
    return say(
        "\"{}\": documents of such tools (schemas/fixed-tool.json) need reach and "
        "conditions for every group of materials, which a library does not say.",
        type);
  return say("{} is no turning tool with an insert.",
             type.empty() ? tr("An entry without a type") : '"' + type + '"');
}

// Numbers of a tap, a reamer or a countersink.
void read_hole_tool(const json& geometry, double unit, Numbers& numbers, LibraryTool& t) {
  constexpr const char* kPlace = "geometry/";
  const auto length = [&](const char* key) {
    return numbers.length_mm(geometry, kPlace, key, unit);
  };
  t.DC_mm = length("DC");
  t.TP_mm = length("TP");
  t.LU_mm = length("LCF");
  t.NOF = numbers.at(geometry, kPlace, "NOF");
  t.SIG_deg = numbers.at(geometry, kPlace, "SIG");
}

bool is_read(const std::string& type) {
  constexpr std::array kTypes{"turning general", "turning boring", "tap right hand",
                              "reamer", "counter sink"};
  return std::ranges::find(kTypes, type) != kTypes.end();
}

LibraryTool read_fusion_tool(const json& item, Numbers& numbers) {
  LibraryTool t;
  t.use = hole_use(text_at(item, "type"));
  t.boring = text_at(item, "type") == "turning boring";
  t.name = text_at(item, "description");
  t.id = text_at(item, "product-id");
  const json& holder = member_of(item, "holder");
  for (const auto& text : {t.name, t.id, text_at(item, "stepFileName"),
                           text_at(holder, "description"), text_at(holder, "product-id"),
                           text_at(member_of(item, "post-process"), "comment")})
    if (!text.empty()) t.texts.push_back(text);
  const double unit = numbers.unit(item, "", 0);
  if (!t.use.empty()) {
    read_hole_tool(member_of(item, "geometry"), unit, numbers, t);
    return t;
  }
  read_insert(member_of(item, "geometry"), unit, numbers, t);
  if (holder.is_object()) read_fusion_holder(holder, unit, numbers, t);
  read_presets(item, unit, numbers, t);
  return t;
}

}  // namespace

ToolLibrary read_fusion_library(const Reader& library) {
  ToolLibrary out;
  const json& root = library.json();
  const char* const key = member_of(root, "data").is_array() ? "data" : "tools";
  const json& list = member_of(root, key);
  if (!list.is_array()) {
    library.problem(tr("a tool library of Fusion, {\"data\": [..]}"), "format");
    return out;
  }
  const auto refuse = [&](const std::string& got) {
    library.problem(got, tr("fewer of them"), "limit");
    return out;
  };
  if (list.size() > kMostEntries)
    return refuse(say("more than {} entries", kMostEntries));
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (out.tools.size() > kMostTools)
      return refuse(say("more than {} turning tools", kMostTools));
    const auto at = fmt::format("/{}/{}", key, i);
    const auto type = text_at(list[i], "type");
    if (!is_read(type)) {
      out.ignored.push_back({at, other_type(shortened(type, 60))});
      continue;
    }
    Numbers numbers;
    auto tool = read_fusion_tool(list[i], numbers);
    tool.at = at;
    if (tool.use.empty() && text_at(list[i], "BMC") == "hss")
      out.ignored.push_back(
          {at,
           tr("A tool of high-speed steel: lives of materials are those of carbide.")});
    else if (!numbers.wrong().empty())
      out.ignored.push_back({at, say("It cannot be read: {}.", numbers.wrong())});
    else
      out.tools.push_back(std::move(tool));
  }
  return out;
}

}  // namespace turnwright::document
