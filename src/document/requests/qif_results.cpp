#include "qif_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <string_view>

#include "base/say.hpp"
#include "document/json/text_lines.hpp"
#include "document/json/utf8.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::document::measured_parts {
namespace {

constexpr std::string_view kNamespace = "http://qifstandards.org/xsd/qif3";
constexpr std::size_t kFileBytes = 50'000'000, kValues = 20'000, kName = 64;
constexpr double kMmOfMetre = 1000, kLargest_mm = 1e6;

constexpr std::array<std::string_view, 16> kSizes{"Diameter",
                                                  "Radius",
                                                  "SphericalDiameter",
                                                  "SphericalRadius",
                                                  "Length",
                                                  "Width",
                                                  "Depth",
                                                  "Height",
                                                  "Thickness",
                                                  "Square",
                                                  "Chord",
                                                  "CurveLength",
                                                  "DistanceBetween",
                                                  "DistanceFrom",
                                                  "LinearCoordinate",
                                                  "UserDefinedLinear"};
constexpr std::array<std::string_view, 17> kForms{
    "Circularity", "Cylindricity",  "Straightness",     "Flatness",   "Sphericity",
    "Conicity",    "Parallelism",   "Perpendicularity", "Angularity", "CircularRunout",
    "TotalRunout", "Coaxiality",    "Concentricity",    "Symmetry",   "Position",
    "LineProfile", "SurfaceProfile"};
constexpr std::array<std::string_view, 4> kNoValues{"SYSERROR", "NOT_ANALYZED",
                                                    "UNDEFINED", "BASIC_OR_TED"};

template <class Names>
bool among(const Names& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

std::string_view name_of(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  return name.substr(name.find(':') + 1);  // npos + 1 is 0
}

pugi::xml_node child(const pugi::xml_node& node, std::string_view name) {
  return node.find_child([&](const auto& c) { return name_of(c) == name; });
}

pugi::xml_node descend(pugi::xml_node node, std::initializer_list<std::string_view> way) {
  for (const auto name : way) node = child(node, name);
  return node;
}

std::string text_of(const pugi::xml_node& node) {
  return std::string(trimmed(node.child_value()));
}

std::string cut(std::string_view text, std::size_t most = kName) {
  return shortened(std::string(text), most);
}

std::optional<double> decimal_of(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double x = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (fault != std::errc() || end != text.data() + text.size() || !std::isfinite(x))
    return std::nullopt;
  return x;
}

// Reads xs:dateTime, "2026-03-02T06:14:05.5+01:00"; without a zone it is UTC.
class DateTime {
 public:
  explicit DateTime(std::string_view text) : text_(text) {}

  /// Since 1970.
  std::optional<double> seconds() {
    const int year = digits(4), month = digits(2, '-'), day = digits(2, '-');
    const int hour = digits(2, 'T'), minute = digits(2, ':'), second = digits(2, ':');
    const double part = fraction(), zone = zone_min();
    const std::chrono::year_month_day date{
        std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
        std::chrono::day(static_cast<unsigned>(day))};
    if (broken_ || at_ != text_.size() || !date.ok() || hour > 24 || minute > 59 ||
        second > 60)
      return std::nullopt;
    const auto days = std::chrono::sys_days(date).time_since_epoch().count();
    return 86400.0 * static_cast<double>(days) + 3600.0 * hour + 60 * (minute - zone) +
           second + part;
  }

 private:
  bool takes(char c) {
    const bool here = at_ < text_.size() && text_[at_] == c;
    at_ += here ? 1 : 0;
    return here;
  }
  int digits(std::size_t n, char before = '\0') {
    broken_ = broken_ || (before != '\0' && !takes(before)) || text_.size() < at_ + n;
    int x = 0;
    for (std::size_t i = 0; i < n && !broken_; ++i, ++at_) {
      broken_ = text_[at_] < '0' || text_[at_] > '9';
      x = 10 * x + text_[at_] - '0';
    }
    return broken_ ? 0 : x;
  }
  double fraction() {
    double sum = 0;
    if (!takes('.')) return sum;
    for (double place = 0.1; at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9';
         place /= 10)
      sum += place * (text_[at_++] - '0');
    return sum;
  }
  double zone_min() {
    if (at_ >= text_.size() || takes('Z')) return 0;
    const bool west = takes('-');
    broken_ = broken_ || (!west && !takes('+'));
    const int hours = digits(2), minutes = digits(2, ':');
    return (west ? -1 : 1) * (60.0 * hours + minutes);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool broken_ = false;
};

// A unit of length as a file defines it.
struct Unit {
  double factor = 1, offset = 0;  // S = (X + offset) factor, in metres
};

using ById = std::map<std::string, pugi::xml_node>;

ById by_id(const pugi::xml_node& list) {
  ById all;
  for (const auto& node : list.children())
    if (const auto id = node.attribute("id")) all.emplace(id.value(), node);
  return all;
}

pugi::xml_node node_of(const ById& all, const std::string& id) {
  const auto found = all.find(id);
  return found == all.end() ? pugi::xml_node() : found->second;
}

// Counts what is not read by its sentence.
using Counts = std::map<std::string, std::size_t>;

class QifFile {
 public:
  QifFile(const Reader& file, std::size_t& components, std::set<std::string>& asked,
          QifResults& out, Counts& counts)
      : file_(file), components_(components), asked_(asked), out_(out), counts_(counts) {}

  void read() {
    text_ = file_.as_text(kFileBytes);
    if (text_.empty()) return;
    for (std::size_t i = 0; i < text_.size(); ++i)
      if (text_[i] == '\n') ends_.push_back(static_cast<std::ptrdiff_t>(i));
    pugi::xml_document document;
    const auto parsed = document.load_buffer(text_.data(), text_.size(),
                                             pugi::parse_default, pugi::encoding_utf8);
    if (!parsed)
      return file_.problems().add({line(parsed.offset), parsed.description(),
                                   tr("XML (1.0), QIF 3.0"), "format"});
    root_ = document.document_element();
    if (!is_qif()) return;
    index();
    const auto results = descend(root_, {"Results", "MeasurementResultsSet"});
    for (const auto& r : results.children())
      if (name_of(r) == "MeasurementResults") read_results(r);
  }

 private:
  bool is_qif() {
    const std::string_view name = root_.name();
    const auto colon = name.find(':');
    const auto declaration =
        colon == name.npos ? "xmlns" : "xmlns:" + std::string(name.substr(0, colon));
    const std::string space = root_.attribute(declaration.c_str()).value();
    if (name_of(root_) == "QIFDocument" && space == kNamespace) return true;
    problem(root_, say("{} of \"{}\"", cut(root_.name()), cut(space)),
            say("QIFDocument of QIF 3.0, namespace {}", kNamespace));
    return false;
  }

  void index() {
    const auto units = child(root_, "FileUnits");
    for (const char* kind : {"PrimaryUnits", "OtherUnits"})
      for (const auto& u : child(units, kind).children())
        if (name_of(u) == "LinearUnit") add_unit(u, kind[0] == 'P');
    const auto characteristics = child(root_, "Characteristics");
    items_ = by_id(child(characteristics, "CharacteristicItems"));
    for (const auto& [id, item] : items_) ++names_[item_name(item, id)];
    nominals_ = by_id(child(characteristics, "CharacteristicNominals"));
    definitions_ = by_id(child(characteristics, "CharacteristicDefinitions"));
    devices_ = by_id(descend(root_, {"MeasurementResources", "MeasurementDevices"}));
    for (const auto& set : descend(root_, {"Results", "ActualComponentSets"}).children())
      components_by_id_.merge(by_id(set));
  }

  void add_unit(const pugi::xml_node& node, bool primary) {
    Unit unit;
    const auto conversion = child(node, "UnitConversion");
    if (const auto factor = child(conversion, "Factor")) {
      const auto x = decimal_of(factor.child_value());
      if (x && *x > 0)
        unit.factor = *x;
      else
        problem(factor, text_of(factor), tr("a number > 0, metres of the unit"));
    }
    if (const auto offset = child(conversion, "Offset"))
      unit.offset = decimal_of(offset.child_value()).value_or(0);
    const auto name = text_of(child(node, "UnitName"));
    if (primary) primary_ = unit;
    units_.emplace(name, unit);
  }

  void read_results(const pugi::xml_node& results) {
    const auto own = text_of(descend(results, {"ActualComponentIds", "Id"}));
    const auto when =
        text_of(descend(results, {"InspectionTraceability", "InspectionStart"}));
    ++components_;
    measured_.clear();
    const auto measured =
        descend(results, {"MeasuredCharacteristics", "CharacteristicMeasurements"});
    for (const auto& m : measured.children()) {
      if (out_.values.size() >= kValues)
        return problem(m, tr("more values"), say("at most {}", kValues));
      if (m.type() == pugi::node_element) read_measurement(m, own, when);
    }
  }

  void read_measurement(const pugi::xml_node& m, const std::string& own_component,
                        const std::string& when) {
    leave_if_asked();  // what it refers to may be long
    constexpr std::string_view kEnding = "CharacteristicMeasurement";
    auto kind = name_of(m);
    if (kind.ends_with(kEnding)) kind.remove_suffix(kEnding.size());
    const bool size = among(kSizes, kind), form = among(kForms, kind);
    if (!size && !form)
      return skip(say("{} is no length that is learned from", cut(kind)));
    const auto status = text_of(descend(m, {"Status", "CharacteristicStatusEnum"}));
    if (among(kNoValues, status))
      return skip(say("values of status {} do not count", status));
    const auto value = child(m, "Value");
    if (!value) return skip(say("{} without a single value", kind));
    QifValue v;
    v.pointer = line(offset_of(m));
    const auto mm = mm_of(value);
    if (!mm) return;
    v.value_mm = *mm;
    const auto item_id = text_of(child(m, "CharacteristicItemId"));
    const auto item = node_of(items_, item_id);
    if (!item)
      return problem(m, say("characteristic item \"{}\"", cut(item_id)),
                     tr("an item of the file's Characteristics"));
    v.characteristic = unique_name(item, item_id);
    if (const auto n = ++measured_[item_id]; n > 1)
      v.characteristic += fmt::format(" #{}", n);
    const auto other = text_of(child(m, "ActualComponentId"));
    set_component(v, node_of(components_by_id_, other.empty() ? own_component : other));
    set_time(v, child(m, "TimeStamp"), when);
    v.device = device(m, item);
    add_limits(v.characteristic, item, form);
    out_.values.push_back(std::move(v));
  }

  // Its name, with its number where others have the same, as one balloon of a drawing may.
  std::string unique_name(const pugi::xml_node& item, const std::string& id) const {
    const auto name = item_name(item, id);
    const auto all = names_.find(name);
    return all != names_.end() && all->second > 1
               ? fmt::format("{} (item {})", name, cut(id))
               : name;
  }
  static std::string item_name(const pugi::xml_node& item, const std::string& id) {
    auto name = text_of(child(item, "Name"));
    if (name.empty())
      name = text_of(descend(item, {"CharacteristicDesignator", "Designator"}));
    return name.empty() ? fmt::format("item {}", id) : cut(name, 200);
  }

  void set_component(QifValue& v, const pugi::xml_node& component) {
    v.part = cut(text_of(child(component, "SerialNumber")));
    if (v.part.empty()) v.part = std::to_string(components_);
    for (const auto& a : child(component, "Attributes").children()) {
      const std::string_view key = a.attribute("name").value();
      const std::string value = a.attribute("value").value();
      const auto number = [&](std::optional<double>& member) {
        member = decimal_of(value);
        if (!member) problem(a, value, say("a number as {}", key));
      };
      if (key == "edge") v.edge = cut(value);
      if (key == "machine") v.machine = cut(value);
      if (key == "parts_on_edge") number(v.parts_on_edge);
      if (key == "offset_mm") number(v.offset_mm);
    }
  }

  void set_time(QifValue& v, const pugi::xml_node& stamp, const std::string& when) {
    const auto text = stamp ? text_of(stamp) : when;
    if (text.empty()) return;
    v.time_s = DateTime(text).seconds();
    if (!v.time_s)
      problem(stamp, cut(text), tr("a date and time, as 2026-03-02T06:14:05Z"));
  }

  std::optional<std::string> device(const pugi::xml_node& m,
                                    const pugi::xml_node& item) const {
    auto id = text_of(descend(m, {"MeasurementDeviceIds", "Id"}));
    if (id.empty()) id = text_of(descend(item, {"MeasurementDeviceIds", "Id"}));
    const auto found = node_of(devices_, id);
    if (!found) return std::nullopt;
    const auto name = text_of(child(found, "Name"));
    return name.empty() ? fmt::format("device {}", cut(id)) : cut(name);
  }

  void add_limits(const std::string& name, const pugi::xml_node& item, bool form) {
    if (!asked_.insert(name).second) return;
    const auto nominal =
        node_of(nominals_, text_of(child(item, "CharacteristicNominalId")));
    const auto definition =
        node_of(definitions_, text_of(child(nominal, "CharacteristicDefinitionId")));
    const auto limits = form ? form_limits(definition) : size_limits(nominal, definition);
    if (limits) out_.limits.emplace_back(name, *limits);
  }

  std::optional<QifLimits> form_limits(const pugi::xml_node& definition) {
    const auto value = child(definition, "ToleranceValue");
    const auto mm = value ? mm_of(value) : std::nullopt;
    if (!mm || !(*mm > 0)) return std::nullopt;
    return QifLimits{0, *mm, {}};
  }

  std::optional<QifLimits> size_limits(const pugi::xml_node& nominal,
                                       const pugi::xml_node& definition) {
    const auto target = child(nominal, "TargetValue");
    const auto tolerance = child(definition, "Tolerance");
    const auto most = child(tolerance, "MaxValue"), least = child(tolerance, "MinValue");
    if (!most || !least) return std::nullopt;
    const auto upper = mm_of(most), lower = mm_of(least);
    if (!upper || !lower || !(*upper > *lower)) return std::nullopt;
    const auto as_limits = text_of(child(tolerance, "DefinedAsLimit"));
    const bool limits = as_limits == "true" || as_limits == "1";
    if (!target && !limits) return std::nullopt;
    if (!target) return QifLimits{(*upper + *lower) / 2, *upper, *lower};
    const auto to_be = mm_of(target);
    if (!to_be) return std::nullopt;
    const double from = limits ? 0 : *to_be;
    return QifLimits{*to_be, from + *upper, from + *lower};
  }

  // A length in its unit.
  std::optional<double> mm_of(const pugi::xml_node& value) {
    const std::string unit = value.attribute("linearUnit").value();
    const auto named = units_.find(unit);
    if (!unit.empty() && named == units_.end()) {
      problem(value, say("unit \"{}\"", cut(unit)),
              tr("a linear unit that FileUnits defines"));
      return std::nullopt;
    }
    const auto& u = unit.empty() ? primary_ : named->second;
    const auto x = decimal_of(value.child_value());
    const double mm = x ? (*x + u.offset) * u.factor * kMmOfMetre : 0;
    if (x && std::abs(mm) <= kLargest_mm) return mm;
    problem(value, cut(text_of(value)), tr("a length of at most 1 km"));
    return std::nullopt;
  }

  void skip(std::string sentence) {
    if (counts_.size() < kName || counts_.contains(sentence)) ++counts_[sentence];
  }

  void problem(const pugi::xml_node& node, std::string got, std::string expected) const {
    file_.problems().add(
        {line(offset_of(node)), std::move(got), std::move(expected), "format"});
  }
  static std::ptrdiff_t offset_of(const pugi::xml_node& node) {
    return node ? node.offset_debug() : 0;
  }
  std::string line(std::ptrdiff_t offset) const {
    const auto before = std::ranges::lower_bound(ends_, offset) - ends_.begin();
    return line_pointer(file_, static_cast<std::size_t>(before) + 1);
  }

  const Reader& file_;
  std::size_t& components_;
  std::set<std::string>& asked_;  // characteristics whose limits were looked for
  QifResults& out_;
  Counts& counts_;
  std::string text_;
  std::vector<std::ptrdiff_t> ends_;  // of its lines
  pugi::xml_node root_;
  Unit primary_;  // metres where a file says nothing
  std::map<std::string, Unit> units_;
  std::map<std::string, std::size_t> names_;  // of items, and how many have each
  std::map<std::string, std::size_t>
      measured_;  // items of the results at hand, how often
  ById items_, nominals_, definitions_, devices_, components_by_id_;
};

}  // namespace

QifResults read_qif(const std::vector<Reader>& files) {
  QifResults out;
  Counts counts;
  std::size_t components = 0;
  std::set<std::string> asked;
  for (const auto& file : files) QifFile(file, components, asked, out, counts).read();
  for (const auto& [sentence, n] : counts)
    out.not_read.push_back(say("QIF: {} ({} left)", sentence, n));
  return out;
}

}  // namespace turnwright::document::measured_parts
