#include "step_body.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "base/say.hpp"
#include "exchange/records/given_name.hpp"
#include "exchange/records/step_unit.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::exchange {
namespace {

constexpr std::size_t kShownBodies = 20;

[[noreturn]] void refuse_file(std::string got, std::string expected) {
  throw InputError("STEP file", {{"", std::move(got), std::move(expected), "body"}});
}

std::vector<Instance> solids(const Exchange& file) {
  std::vector<Instance> all;
  for (const auto name : {"MANIFOLD_SOLID_BREP", "BREP_WITH_VOIDS", "FACETED_BREP"}) {
    const auto some = file.all(name);
    all.insert(all.end(), some.begin(), some.end());
  }
  if (all.empty()) all = file.all("SHELL_BASED_SURFACE_MODEL");
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// The representation that an item stands in, by its context.
struct Placed {
  Instance representation, context;
};
std::optional<Placed> placed(const Instance& item) {
  for (const auto& user : item.users())
    for (std::size_t i = 0; i < user.records(); ++i) {
      const auto record = user.record(i);
      if (record.size() < 3 || !record[2].is(ValueKind::reference)) continue;
      const auto context = record[2].instance();
      if (context.is("GLOBAL_UNIT_ASSIGNED_CONTEXT")) return Placed{user, context};
    }
  return std::nullopt;
}

/// The representations that are equal to this one, each once, itself first: a solid's and,
/// where assemblies are written, that of its product.
std::vector<Instance> equal_representations(const Instance& representation) {
  std::vector<Instance> all{representation};
  std::set<Instance> known{representation};
  for (const auto& user : representation.users()) {
    const auto relation = user.find("SHAPE_REPRESENTATION_RELATIONSHIP");
    if (!relation || relation->size() < 4) continue;
    for (const std::size_t side : {2U, 3U})
      if ((*relation)[side].is(ValueKind::reference))
        if (const auto other = (*relation)[side].instance(); known.insert(other).second)
          all.push_back(other);
  }
  return all;
}

/// Attribute n of an instance of this name, where that is a reference.
std::optional<Instance> follow(const Instance& from, std::string_view name,
                               std::size_t n) {
  const auto record = from.find(name);
  if (!record || record->size() <= n || !(*record)[n].is(ValueKind::reference))
    return std::nullopt;
  return (*record)[n].instance();
}

std::optional<Instance> product_of(const Instance& representation) {
  for (const auto& same : equal_representations(representation))
    for (const auto& user : same.users()) {
      const auto shape = follow(user, "SHAPE_DEFINITION_REPRESENTATION", 0);
      const auto definition =
          shape ? follow(*shape, "PRODUCT_DEFINITION_SHAPE", 2) : std::nullopt;
      if (!definition || definition->record(0).size() < 3) continue;
      const auto formation = follow(*definition, definition->record(0).name(), 2);
      if (!formation || formation->record(0).size() < 3) continue;
      const auto product = follow(*formation, formation->record(0).name(), 2);
      if (product && product->is("PRODUCT")) return product;
    }
  return std::nullopt;
}

std::string first_text(const Record& record, std::size_t n) {
  return n < record.size() && record[n].is(ValueKind::text) ? record[n].text() : "";
}

std::string name_of_item(const Instance& item) {
  const auto shared = item.find("REPRESENTATION_ITEM");  // of a complex instance
  auto name = first_text(shared ? *shared : item.record(0), 0);
  return name == "NONE" ? "" : name;
}

std::string name_of_product(const Instance& item) {
  const auto where = placed(item);
  const auto product = where ? product_of(where->representation) : std::nullopt;
  if (!product) return "";
  const auto record = product->as("PRODUCT");
  const auto name = given_name(first_text(record, 1));
  return name.empty() ? given_name(first_text(record, 0)) : name;
}

std::string quoted_names(const std::vector<Instance>& all) {
  std::string text;
  for (std::size_t i = 0; i < std::min(all.size(), kShownBodies); ++i) {
    const auto product = name_of_product(all[i]);
    auto name = name_of_item(all[i]);
    if (name.empty()) name = product;
    text += (i ? ", " : "") + std::to_string(i + 1) + " \"" + name + "\"";
  }
  return all.size() > kShownBodies ? text + " .." : text;
}

Instance chosen(const std::vector<Instance>& all, const std::string& body) {
  if (all.empty())
    refuse_file(tr("no solid and no shell"), tr("the solid of a turned part"));
  if (body.empty() && all.size() == 1) return all[0];
  std::vector<Instance> same;
  for (std::size_t i = 0; i < all.size() && !body.empty(); ++i) {
    leave_if_asked();
    if (name_of_item(all[i]) == body || name_of_product(all[i]) == body)
      same.push_back(all[i]);
  }
  for (std::size_t i = 0; i < all.size() && same.empty(); ++i)
    if (std::to_string(i + 1) == body) return all[i];
  if (same.size() == 1) return same[0];
  refuse_file(body.empty() ? say("{} solids", all.size())
                           : say("{} solids \"{}\"", same.size(), body),
              say("one of these, by name or number: {}", quoted_names(all)));
}

void read_units(const Instance& item, const Exchange& file, Body& body) {
  const auto where = placed(item);
  const auto contexts = file.all("GLOBAL_UNIT_ASSIGNED_CONTEXT");
  if (!where && contexts.empty()) {
    body.assumed.push_back({"", tr("The file names no units; lengths are taken as mm.")});
    return;
  }
  const auto record =
      (where ? where->context : contexts[0]).as("GLOBAL_UNIT_ASSIGNED_CONTEXT");
  const auto units = record[record.size() - 1];
  for (std::size_t i = 0; i < units.size(); ++i)
    if (const auto unit = step_unit(units[i].instance()))
      (unit->quantity == Quantity::length ? body.mm : body.rad) = unit->size;
}

/// Shells whose faces are in the body, with the direction of their normals: a shell may be
/// referred to any number of times.
using Shells = std::set<std::pair<Instance, bool>>;

/// @param outward  whether normals of the shell's faces point out of the material
void add_shell(Instance shell, bool outward, Shells& added, Body& body) {
  leave_if_asked();
  for (const auto name : {"ORIENTED_CLOSED_SHELL", "ORIENTED_OPEN_SHELL"})
    if (const auto turned = shell.find(name)) {
      outward = outward == (*turned)[3].boolean();
      shell = (*turned)[2].instance();
      break;
    }
  if (!added.emplace(shell, outward).second) return;
  const auto record =
      shell.is("OPEN_SHELL") ? shell.as("OPEN_SHELL") : shell.as("CLOSED_SHELL");
  const auto faces = record[record.size() - 1];
  for (std::size_t i = 0; i < faces.size(); ++i) {
    auto face = faces[i].instance();
    const auto turned = face.find("ORIENTED_FACE");
    if (turned) face = (*turned)[2].instance();
    body.faces.push_back({face, turned ? outward == (*turned)[3].boolean() : outward});
  }
}

/// The last parameter, whether the instance is complex or not.
Parameter last(const Record& record) { return record[record.size() - 1]; }

void add_faces(const Instance& item, Body& body) {
  Shells added;
  if (const auto model = item.find("SHELL_BASED_SURFACE_MODEL")) {
    const auto shells = last(*model);
    for (std::size_t i = 0; i < shells.size(); ++i)
      add_shell(shells[i].instance(), true, added, body);
    return;
  }
  const auto hollow = item.find("BREP_WITH_VOIDS");
  if (const auto brep = item.find("MANIFOLD_SOLID_BREP"))
    add_shell(last(*brep).instance(), true, added, body);
  else if (hollow && hollow->size() >= 2)
    add_shell((*hollow)[hollow->size() - 2].instance(), true, added, body);
  else
    item.record(0).refuse(tr("facets"), tr("a solid with exact faces"));
  if (!hollow) return;
  const auto voids = last(*hollow);
  for (std::size_t i = 0; i < voids.size(); ++i)
    add_shell(voids[i].instance(), true, added, body);
}

}  // namespace

Body step_body(const Exchange& file, const StepOptions& options) {
  const auto item = chosen(solids(file), options.body);
  Body body;
  body.name = name_of_product(item);
  if (body.name.empty()) body.name = name_of_item(item);
  read_units(item, file, body);
  add_faces(item, body);
  std::sort(body.faces.begin(), body.faces.end(),
            [](const FaceUse& a, const FaceUse& b) { return a.face < b.face; });
  const auto twice =
      std::unique(body.faces.begin(), body.faces.end(),
                  [](const FaceUse& a, const FaceUse& b) { return a.face == b.face; });
  body.faces.erase(twice, body.faces.end());
  return body;
}

}  // namespace turnwright::exchange
