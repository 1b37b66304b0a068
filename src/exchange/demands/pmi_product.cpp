#include <algorithm>
#include <array>
#include <set>

#include "exchange/records/given_name.hpp"
#include "pmi_read.hpp"

namespace turnwright::exchange {
namespace {

// Keys of attributes that authors and CAD systems give their parts.
constexpr std::array<std::string_view, 5> kPartNumber{
    "part number", "part_number", "partnumber", "part no", "drawing number"};
constexpr std::array<std::string_view, 3> kRevision{"revision", "rev",
                                                    "drawing revision"};
constexpr std::array<std::string_view, 3> kMaterial{"material", "material name",
                                                    "material designation"};

constexpr std::size_t kMostProperties = 1000;  // in one representation

template <std::size_t N>
bool is_one(const std::string& key, const std::array<std::string_view, N>& keys) {
  return std::find(keys.begin(), keys.end(), lower_case(key)) != keys.end();
}

// PRODUCT_DEFINITION_SHAPE -> PRODUCT_DEFINITION -> its formation -> PRODUCT.
void read_identity(const Instance& shape, Pmi& pmi) {
  const auto definition = shape.as("PRODUCT_DEFINITION_SHAPE")[2].instance();
  const auto of_product = definition.find("PRODUCT_DEFINITION");
  if (!of_product) return;
  const auto formation = (*of_product)[2].instance();
  const auto f = formation.record(0);
  const auto product = f[2].instance().as("PRODUCT");
  pmi.part_number = given_name(product[0].text_or_empty());
  pmi.part_name = given_name(product[1].text_or_empty());
  pmi.revision = f[0].text_or_empty();
}

void take_attribute(const Note& note, Pmi& pmi) {
  if (is_one(note.name, kPartNumber)) pmi.part_number = note.text;
  if (is_one(note.name, kRevision)) pmi.revision = note.text;
  if (is_one(note.name, kMaterial) && pmi.material.empty()) pmi.material = note.text;
}

// Counts and checksums by which an importer compares itself with the exporter.
bool is_validation(const std::string& property) {
  return property.ends_with("validation property");
}

// What Open CASCADE writes: the material's name is the name of the text's item.
void read_material(const Instance& item, Pmi& pmi) {
  const auto r = item.as("DESCRIPTIVE_REPRESENTATION_ITEM");
  const auto name = r[0].text_or_empty(), text = r[1].text_or_empty();
  if (pmi.material.empty())
    pmi.material = name.empty() || is_one(name, kMaterial) ? text : name;
}

void read_property(const Instance& relation, std::set<Id>& told, Pmi& pmi) {
  const auto r = relation.as("PROPERTY_DEFINITION_REPRESENTATION");
  const auto definition = r[0].instance();
  const auto property = definition.find("PROPERTY_DEFINITION");
  if (!property) return;
  const auto name = (*property)[0].short_text().value_or("");
  if (is_validation(name)) return;
  const auto representation = r[1].instance();
  if (!representation.is("REPRESENTATION") || !told.insert(representation.id()).second)
    return;
  for (const auto& item : representation_items(representation, kMostProperties)) {
    const auto text = item.find("DESCRIPTIVE_REPRESENTATION_ITEM");
    if (!text || !told.insert(item.id()).second) continue;
    const auto key = lower_case(name);
    if (key == "material property") read_material(item, pmi);
    Note note{name_of(definition.id()), name, (*text)[1].text_or_empty()};
    take_attribute(note, pmi);
    pmi.notes.push_back(std::move(note));
  }
}

}  // namespace

void read_product(const Exchange& file, Pmi& pmi) {
  for (const auto& shape : file.all("PRODUCT_DEFINITION_SHAPE")) {
    read_or_tell(shape, pmi.unread, [&](const Instance& i) { read_identity(i, pmi); });
    if (!pmi.part_number.empty()) break;
  }
  for (const auto& material : file.all("MATERIAL_DESIGNATION"))
    read_or_tell(material, pmi.unread, [&](const Instance& i) {
      if (pmi.material.empty())
        pmi.material = i.as("MATERIAL_DESIGNATION")[0].text_or_empty();
    });
  std::set<Id> told;  // what several properties share is one note
  for (const auto& relation : file.all("PROPERTY_DEFINITION_REPRESENTATION"))
    read_or_tell(relation, pmi.unread,
                 [&](const Instance& i) { read_property(i, told, pmi); });
}

}  // namespace turnwright::exchange
