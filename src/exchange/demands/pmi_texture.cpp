#include "exchange/records/step_unit.hpp"
#include "pmi_read.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::exchange {
namespace {

constexpr double kUmPerMm = 1000;
constexpr std::size_t kMostTextureItems = 50;

void read_texture(const Instance& relation, Features& features, Pmi& pmi) {
  const auto r = relation.as("PROPERTY_DEFINITION_REPRESENTATION");
  const auto representation = r[1].instance();
  if (!representation.is("SURFACE_TEXTURE_REPRESENTATION")) return;
  const auto property = r[0].instance().as("PROPERTY_DEFINITION");
  SurfaceTexture texture{.at = name_of(r[0].id())};
  std::optional<double> value_mm;
  for (const auto& item : representation_items(representation, kMostTextureItems)) {
    if (const auto text = item.find("DESCRIPTIVE_REPRESENTATION_ITEM"))
      texture.parameter = short_text((*text)[1]);
    else if (const auto measure = step_measure(item);
             measure && measure->quantity == Quantity::length) {
      value_mm = measure->value;
      if (texture.parameter.empty()) texture.parameter = measure_name(item);
    }
  }
  if (!value_mm)
    representation.record(0).refuse(tr("no length"), tr("the roughness with its unit"));
  texture.value_um = rounded_mm(*value_mm) * kUmPerMm;
  texture.of = features.of(property[2].instance());
  pmi.textures.push_back(std::move(texture));
}

}  // namespace

void read_textures(const Exchange& file, Features& features, Pmi& pmi) {
  if (file.all("SURFACE_TEXTURE_REPRESENTATION").empty()) return;
  for (const auto& relation : file.all("PROPERTY_DEFINITION_REPRESENTATION"))
    read_or_tell(relation, pmi.unread,
                 [&](const Instance& i) { read_texture(i, features, pmi); });
}

}  // namespace turnwright::exchange
