#include <algorithm>

#include "pmi_feature.hpp"
#include "pmi_read.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::exchange {
namespace {

constexpr std::size_t kStepsPerInstance = 16;
constexpr std::size_t kLongestName = 60;  // of an entity

bool is_datum(const Instance& instance) { return instance.is("DATUM"); }

bool is_target(const Instance& instance) {
  return instance.is("PLACED_DATUM_TARGET_FEATURE") || instance.is("DATUM_TARGET");
}

bool is_location(const Instance& instance) {
  return instance.is("DIMENSIONAL_LOCATION") || instance.is("ANGULAR_LOCATION");
}

// Of the relation's two ends, "relating" and "related": the record that has them.
std::optional<Record> relation_record(const Instance& relation) {
  for (const auto name :
       {"SHAPE_ASPECT_RELATIONSHIP", "SHAPE_ASPECT_DERIVING_RELATIONSHIP",
        "SHAPE_ASPECT_ASSOCIATIVITY", "FEATURE_FOR_DATUM_TARGET_RELATIONSHIP"})
    if (const auto r = relation.find(name); r && r->size() >= 4) return r;
  return std::nullopt;
}

}  // namespace

std::optional<SizeOf> size_of(const Instance& instance) {
  if (const auto r = instance.find("DIMENSIONAL_SIZE"); r && r->size() >= 2)
    return SizeOf{(*r)[0], (*r)[1]};
  if (const auto r = instance.find("DIMENSIONAL_SIZE_WITH_DATUM_FEATURE");
      r && r->size() >= 6)
    return SizeOf{(*r)[4], (*r)[5]};
  for (const auto name : {"ANGULAR_SIZE", "DIMENSIONAL_SIZE_WITH_PATH"})
    if (const auto r = instance.find(name); r && r->size() >= 3)
      return SizeOf{(*r)[0], (*r)[1]};
  return std::nullopt;
}

Features::Features(const Exchange& file, std::vector<Remark>& unread)
    : file_(&file),
      seen_(file.size(), 0),
      left_(kStepsPerInstance * file.size() + kStepsPerInstance) {
  const auto each = [&](std::initializer_list<std::string_view> names, auto&& read) {
    for (const auto& instance : instances_of(file, names))
      read_or_tell(instance, unread, read);
  };
  each({"SHAPE_ASPECT_RELATIONSHIP", "SHAPE_ASPECT_DERIVING_RELATIONSHIP",
        "SHAPE_ASPECT_ASSOCIATIVITY", "FEATURE_FOR_DATUM_TARGET_RELATIONSHIP"},
       [&](const Instance& i) { add_relation(i); });
  each({"DIMENSIONAL_SIZE", "DIMENSIONAL_SIZE_WITH_DATUM_FEATURE", "ANGULAR_SIZE",
        "DIMENSIONAL_SIZE_WITH_PATH"},
       [&](const Instance& i) {
         if (const auto size = size_of(i)) add(i, size->of.instance(), false, false);
       });
  each({"GEOMETRIC_ITEM_SPECIFIC_USAGE", "ITEM_IDENTIFIED_REPRESENTATION_USAGE"},
       [&](const Instance& i) { add_items(i); });
  std::stable_sort(relations_.begin(), relations_.end(),
                   [](const Relation& a, const Relation& b) { return a.from < b.from; });
}

void Features::add(const Instance& from, const Instance& to, bool to_item, bool axis) {
  relations_.push_back({static_cast<std::uint32_t>(from.index()),
                        static_cast<std::uint32_t>(to.index()), to_item, axis});
}

void Features::add_relation(const Instance& relation) {
  const auto r = relation_record(relation);
  if (!r || is_location(relation)) return;
  const auto relating = (*r)[2].instance(), related = (*r)[3].instance();
  const bool backwards = is_datum(related) || is_target(related);
  const bool axis = relating.is("CENTRE_OF_SYMMETRY");
  add(backwards ? related : relating, backwards ? relating : related, false, axis);
}

void Features::add_items(const Instance& usage) {
  for (const auto name :
       {"ITEM_IDENTIFIED_REPRESENTATION_USAGE", "GEOMETRIC_ITEM_SPECIFIC_USAGE"}) {
    const auto r = usage.find(name);
    if (!r || r->size() < 5) continue;
    const auto aspect = (*r)[2].instance();
    for (const auto& item : references((*r)[4])) add(aspect, item, true, false);
    return;
  }
}

void Features::add_item(const Instance& item, Feature& feature) const {
  if (item.is("ADVANCED_FACE") || item.is("FACE_SURFACE"))
    feature.faces.push_back(name_of(item.id()));
  else
    feature.other.push_back(name_of(item.id()) + " " +
                            std::string(item.record(0).name().substr(0, kLongestName)));
}

Feature Features::of(const Instance& aspect) {
  Feature feature{.at = name_of(aspect.id())};
  ++walk_;
  std::vector<std::uint32_t> waiting{static_cast<std::uint32_t>(aspect.index())};
  seen_[aspect.index()] = walk_;
  for (std::size_t n = 0; n < waiting.size(); ++n) {
    const auto at = waiting[n];
    const auto instance = file_->instance(at);
    if (instance.is("ALL_AROUND_SHAPE_ASPECT")) feature.extent = "all around";
    if (instance.is("BETWEEN_SHAPE_ASPECT")) feature.extent = "between";
    auto r = std::lower_bound(relations_.begin(), relations_.end(), at,
                              [](const Relation& x, auto from) { return x.from < from; });
    for (; r != relations_.end() && r->from == at && left_ > 0; ++r, --left_) {
      feature.axis = feature.axis || r->axis;
      if (seen_[r->to] == walk_) continue;
      seen_[r->to] = walk_;
      if (r->to_item)
        add_item(file_->instance(r->to), feature);
      else
        waiting.push_back(r->to);
    }
  }
  return feature;
}

void Features::throw_if_spent() const {
  if (left_ > 0) return;
  throw InputError("", {{"", tr("features that share their faces many times over"),
                         tr("features that a drawing could show"), "range"}});
}

}  // namespace turnwright::exchange
