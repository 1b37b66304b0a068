#include <set>

#include "pmi_read.hpp"

namespace turnwright::exchange {
namespace {

bool means_something(const Instance& definition) {
  static constexpr std::string_view kMeaning[] = {"DIMENSION", "ANGULAR_", "TOLERANCE",
                                                  "DATUM", "PROPERTY_DEFINITION"};
  for (std::size_t n = 0; n < definition.records(); ++n)
    for (const auto word : kMeaning)
      if (definition.record(n).name().find(word) != std::string_view::npos) return true;
  return false;
}

// DRAUGHTING_MODEL_ITEM_ASSOCIATION(name, text, #meaning, #model, #annotation ..)
void read_link(const Instance& link, std::set<Id>& meant) {
  const auto r = link.record(link.records() - 1);
  if (r.size() < 5 || !r[2].is(ValueKind::reference)) return;
  if (!means_something(r[2].instance())) return;
  for (const auto& annotation : references(r[4])) meant.insert(annotation.id());
}

}  // namespace

void read_annotations(const Exchange& file, Pmi& pmi) {
  std::set<Id> meant;
  for (const auto& link :
       instances_of(file, {"DRAUGHTING_MODEL_ITEM_ASSOCIATION",
                           "DRAUGHTING_MODEL_ITEM_ASSOCIATION_WITH_PLACEHOLDER"}))
    read_or_tell(link, pmi.unread, [&](const Instance& i) { read_link(i, meant); });
  auto drawn = file.all("DRAUGHTING_CALLOUT");
  if (drawn.empty())
    drawn = instances_of(
        file, {"ANNOTATION_OCCURRENCE", "ANNOTATION_CURVE_OCCURRENCE",
               "ANNOTATION_FILL_AREA_OCCURRENCE", "ANNOTATION_SYMBOL_OCCURRENCE",
               "ANNOTATION_TEXT_OCCURRENCE", "DRAUGHTING_ANNOTATION_OCCURRENCE",
               "TESSELLATED_ANNOTATION_OCCURRENCE"});
  pmi.annotations = drawn.size();
  for (const auto& annotation : drawn) {
    if (meant.contains(annotation.id())) continue;
    const auto named = annotation.find("REPRESENTATION_ITEM");
    const auto r = named && named->size() > 0 ? *named : annotation.record(0);
    const bool has_name = r.size() > 0 && r[0].is(ValueKind::text);
    const auto name = has_name ? r[0].text() : std::string();
    pmi.strokes_alone.push_back(name.empty() ? name_of(annotation.id()) : name);
  }
}

}  // namespace turnwright::exchange
