#include <map>

#include "pmi_read.hpp"

namespace turnwright::exchange {
namespace {

bool is_datum_target(const Instance& aspect) {
  return aspect.is("PLACED_DATUM_TARGET_FEATURE") || aspect.is("DATUM_TARGET");
}

}  // namespace

void read_datums(const Exchange& file, Features& features, Pmi& pmi) {
  std::map<Id, std::size_t> place;
  for (const auto& datum : file.all("DATUM"))
    read_or_tell(datum, pmi.unread, [&](const Instance& i) {
      const auto letter = short_text(of_last(i.as("DATUM"), 1, 0));
      place.emplace(i.id(), pmi.datums.size());
      pmi.datums.push_back({name_of(i.id()), letter, features.of(i)});
    });
  // A datum that a target leads to stands on the target's place, not on the whole face.
  for (const auto& relation : file.all("SHAPE_ASPECT_RELATIONSHIP"))
    read_or_tell(relation, pmi.unread, [&](const Instance& i) {
      const auto r = i.as("SHAPE_ASPECT_RELATIONSHIP");
      if (r.size() < 4 || !is_datum_target(r[2].instance())) return;
      if (const auto datum = place.find(r[3].id()); datum != place.end())
        pmi.datums[datum->second].targets = true;
    });
}

}  // namespace turnwright::exchange
