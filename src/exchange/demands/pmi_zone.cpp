#include <map>

#include "base/say.hpp"
#include "pmi_read.hpp"

namespace turnwright::exchange {
namespace {

constexpr std::size_t kMostOfAZone = 24;  // tolerances; as a rule it is one

using ByInstance = std::map<Id, GeometricTolerance*>;

// A zone of which the value is the diameter, as the recommended practices call it and as
// ISO 10303-47 does.
bool is_diametral(const std::string& form) {
  return form == "cylindrical or circular" || form == "cylindrical" ||
         form == "circular" || form == "within a cylinder" || form == "within a circle";
}

// Tolerances that a zone belongs to: those that define it, before its form.
template <class Apply>
void each_tolerance(const Instance& zone, const ByInstance& tolerances, Apply&& apply) {
  for (const auto& t : references(of_last(zone.as("TOLERANCE_ZONE"), 2, 0), kMostOfAZone))
    if (const auto found = tolerances.find(t.id()); found != tolerances.end())
      apply(*found->second);
}

void read_form(const Instance& zone, const ByInstance& tolerances) {
  const auto form = of_last(zone.as("TOLERANCE_ZONE"), 2, 1).instance();
  const auto text = lower_case(short_text(form.as("TOLERANCE_ZONE_FORM")[0]));
  const bool spherical = text == "spherical" || text == "within a sphere";
  each_tolerance(zone, tolerances, [&](GeometricTolerance& t) {
    t.diametral = is_diametral(text);
    if (spherical) t.modifiers.push_back(tr("spherical zone"));
  });
}

// What a definition adds to the zone that it refers to first.
void read_definition(const Instance& definition, const ByInstance& tolerances) {
  std::string text;
  if (const auto r = definition.find("PROJECTED_ZONE_DEFINITION"))
    text = say("projected by {} mm", length_mm(of_last(*r, 1, 0).instance()));
  else if (definition.is("NON_UNIFORM_ZONE_DEFINITION"))
    text = tr("non-uniform zone");
  else
    text = tr("measured at a given angle");
  const auto general = definition.find("TOLERANCE_ZONE_DEFINITION");
  const auto zone =
      (general && general->size() >= 1 ? *general : definition.record(0))[0];
  each_tolerance(zone.instance(), tolerances,
                 [&](GeometricTolerance& t) { t.modifiers.push_back(text); });
}

// The lower segments of a composite tolerance refine the first one and do not locate.
void read_composite(const Instance& relation, const ByInstance& tolerances) {
  const auto r = relation.as("GEOMETRIC_TOLERANCE_RELATIONSHIP");
  if (lower_case(r[0].short_text().value_or("")) != "composite") return;
  const auto lower = tolerances.find(r[3].id());
  if (lower != tolerances.end())
    lower->second->modifiers.push_back(
        say("lower segment of the composite tolerance {}", name_of(r[2].id())));
}

}  // namespace

void read_zones(const Exchange& file, Pmi& pmi) {
  ByInstance tolerances;
  for (auto& tolerance : pmi.tolerances)
    tolerances.emplace(std::stoull(tolerance.at.substr(1)), &tolerance);
  const auto each = [&](std::initializer_list<std::string_view> names, auto&& read) {
    for (const auto& instance : instances_of(file, names))
      read_or_tell(instance, pmi.unread, [&](const Instance& i) { read(i, tolerances); });
  };
  each({"TOLERANCE_ZONE"}, read_form);
  each({"PROJECTED_ZONE_DEFINITION", "NON_UNIFORM_ZONE_DEFINITION",
        "RUNOUT_ZONE_DEFINITION"},
       read_definition);
  each({"GEOMETRIC_TOLERANCE_RELATIONSHIP"}, read_composite);
}

}  // namespace turnwright::exchange
