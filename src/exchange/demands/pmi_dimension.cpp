#include <algorithm>
#include <cctype>
#include <map>

#include "exchange/records/step_unit.hpp"
#include "pmi_read.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::exchange {
namespace {

constexpr std::size_t kMostItems = 50;  // of a dimension, which has a dozen
constexpr std::size_t kMostQualifiers = 10;

// What a dimension has, in mm or rad until it is known which.
struct Sized {
  Quantity quantity = Quantity::length;
  std::optional<double> nominal, lower, upper;  // the latter less the nominal value
  std::string fit;
  std::vector<std::string> notes;
};

using ByDimension = std::multimap<std::size_t, Instance>;  // by the dimension's index

// Instances of a relation by the dimension that its parameter n refers to.
ByDimension by_dimension(const Exchange& file, std::string_view relation, std::size_t n,
                         Pmi& pmi) {
  ByDimension all;
  for (const auto& r : file.all(relation))
    read_or_tell(r, pmi.unread, [&](const Instance& i) {
      all.emplace(i.as(relation)[n].instance().index(), i);
    });
  return all;
}

double measured_value(const Instance& measure, Sized& sized) {
  const auto found = step_measure(measure);
  if (!found)
    measure.record(0).refuse(tr("no length or angle"), tr("a measure with its unit"));
  sized.quantity = found->quantity;
  return found->quantity == Quantity::length ? length_mm(measure) : found->value;
}

// The letter of the deviation as ISO 286 has it, a capital for a hole; some writers put the
// grade into the first parameter too, or IT before it.
std::string fit_class(const Record& fit) {
  auto letters = short_text(fit[0]);
  const auto zone = lower_case(short_text(fit[1]));
  auto grade = short_text(fit[2]);
  if (grade.starts_with("IT") || grade.starts_with("it")) grade.erase(0, 2);
  if (zone.starts_with("shaft")) letters = lower_case(letters);
  if (zone.starts_with("hole"))
    for (char& c : letters)
      c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  const bool has_grade = std::any_of(letters.begin(), letters.end(),
                                     [](char c) { return c >= '0' && c <= '9'; });
  return has_grade ? letters : letters + grade;
}

void read_range(const Instance& plus_minus, Sized& sized) {
  const auto range = plus_minus.as("PLUS_MINUS_TOLERANCE")[0].instance();
  if (const auto fit = range.find("LIMITS_AND_FITS")) {
    sized.fit = fit_class(*fit);
    return;
  }
  const auto bounds = range.as("TOLERANCE_VALUE");
  sized.lower = measured_value(bounds[0].instance(), sized);
  sized.upper = measured_value(bounds[1].instance(), sized);
}

void read_item(const Instance& item, Sized& sized, std::optional<double>& least,
               std::optional<double>& most) {
  if (const auto note = item.find("DESCRIPTIVE_REPRESENTATION_ITEM")) {
    if (auto text = short_text((*note)[1]); !text.empty())
      sized.notes.push_back(std::move(text));
    return;
  }
  const auto measure = step_measure(item);
  if (!measure) return;
  const auto name = lower_case(measure_name(item));
  auto& place = name == "lower limit"   ? least
                : name == "upper limit" ? most
                                        : sized.nominal;
  place = measured_value(item, sized);
  const auto qualified = item.find("QUALIFIED_REPRESENTATION_ITEM");
  if (!qualified) return;
  for (const auto& q : references(of_last(*qualified, 1, 0), kMostQualifiers))
    if (const auto type = q.find("TYPE_QUALIFIER"))
      sized.notes.push_back(short_text((*type)[0]));
}

void read_representation(const Instance& relation, Sized& sized) {
  const auto shown =
      relation.as("DIMENSIONAL_CHARACTERISTIC_REPRESENTATION")[1].instance();
  std::optional<double> least, most;
  for (const auto& item : representation_items(shown, kMostItems))
    read_item(item, sized, least, most);
  if (!least || !most) return;
  if (!sized.nominal) sized.nominal = rounded_mm((*least + *most) / 2);
  sized.lower = rounded_mm(*least - *sized.nominal);
  sized.upper = rounded_mm(*most - *sized.nominal);
}

// The two ends of a location; the dimension itself is the relation.
struct LocationEnds {
  Parameter name, from, to;
};

std::optional<LocationEnds> ends_of_location(const Instance& location) {
  if (const auto r = location.find("SHAPE_ASPECT_RELATIONSHIP"); r && r->size() >= 4)
    return LocationEnds{(*r)[0], (*r)[2], (*r)[3]};
  if (const auto r = location.find("DIMENSIONAL_LOCATION_WITH_DATUM_FEATURE");
      r && r->size() >= 8)
    return LocationEnds{(*r)[4], (*r)[6], (*r)[7]};
  for (const auto name :
       {"DIMENSIONAL_LOCATION", "ANGULAR_LOCATION", "DIMENSIONAL_LOCATION_WITH_PATH",
        "DIRECTED_DIMENSIONAL_LOCATION"})
    if (const auto r = location.find(name); r && r->size() >= 4)
      return LocationEnds{(*r)[0], (*r)[2], (*r)[3]};
  return std::nullopt;
}

Sized sized(const Instance& dimension, const ByDimension& shown,
            const ByDimension& ranges) {
  Sized all;
  const auto each = [&](const ByDimension& relations, auto&& read) {
    const auto [first, last] = relations.equal_range(dimension.index());
    for (auto r = first; r != last; ++r) read(r->second, all);
  };
  each(shown, read_representation);
  each(ranges, read_range);
  if (all.lower && all.upper && !(*all.lower <= *all.upper))
    dimension.record(0).refuse(tr("a lower limit above the upper one"),
                               tr("lower <= upper"));
  return all;
}

struct NamedDimension {
  std::string name;
  Feature of = {};
  std::optional<Feature> to = {};
};

NamedDimension named_dimension(const Instance& dimension, Features& features) {
  if (const auto size = size_of(dimension))
    return {.name = short_text(size->name), .of = features.of(size->of.instance())};
  const auto both = ends_of_location(dimension);
  if (!both)
    dimension.record(0).refuse(tr("too few parameters"),
                               tr("the features it is between"));
  return {.name = short_text(both->name),
          .of = features.of(both->from.instance()),
          .to = features.of(both->to.instance())};
}

void add_dimension(const Instance& dimension, NamedDimension named, Sized sized,
                   Pmi& pmi) {
  const auto at = name_of(dimension.id());
  const bool angular = dimension.is("ANGULAR_SIZE") || dimension.is("ANGULAR_LOCATION");
  if (angular || sized.quantity == Quantity::angle) {
    pmi.angles.push_back({at, std::move(named.name), sized.nominal, sized.lower,
                          sized.upper, std::move(sized.notes), std::move(named.of),
                          std::move(named.to)});
    return;
  }
  std::optional<part::Limits> limits;
  if (sized.lower && sized.upper) limits = part::Limits{*sized.lower, *sized.upper};
  pmi.dimensions.push_back({at, std::move(named.name), sized.nominal, limits,
                            std::move(sized.fit), std::move(sized.notes),
                            std::move(named.of), std::move(named.to)});
}

}  // namespace

void read_dimensions(const Exchange& file, Features& features, Pmi& pmi) {
  const auto shown =
      by_dimension(file, "DIMENSIONAL_CHARACTERISTIC_REPRESENTATION", 0, pmi);
  const auto ranges = by_dimension(file, "PLUS_MINUS_TOLERANCE", 1, pmi);
  const auto all = instances_of(
      file, {"DIMENSIONAL_SIZE", "DIMENSIONAL_SIZE_WITH_DATUM_FEATURE",
             "DIMENSIONAL_SIZE_WITH_PATH", "ANGULAR_SIZE", "DIMENSIONAL_LOCATION",
             "DIMENSIONAL_LOCATION_WITH_DATUM_FEATURE", "DIMENSIONAL_LOCATION_WITH_PATH",
             "DIRECTED_DIMENSIONAL_LOCATION", "ANGULAR_LOCATION"});
  for (const auto& dimension : all)
    read_or_tell(dimension, pmi.unread, [&](const Instance& i) {
      add_dimension(i, named_dimension(i, features), sized(i, shown, ranges), pmi);
    });
}

}  // namespace turnwright::exchange
