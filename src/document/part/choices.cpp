#include "choices.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "base/say.hpp"

namespace turnwright::document {
namespace {

using nlohmann::json;

constexpr std::size_t kListed = 20, kCombinations = 100;
constexpr std::size_t kParted = 2;  // more of automatic setups, see add_parted

std::string written(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? number_text(found->get<double>())
                                                     : "?";
}

std::string machine_name(const json& machine) {
  if (machine.is_string()) return machine.get<std::string>();
  return machine.is_object() ? shown(machine.value("id", json(tr("machine"))))
                             : tr("machine");
}

std::string stock_name(const json& stock) {
  if (!stock.is_object()) return tr("stock");
  const auto kind = stock.value("kind", json());
  if (kind == "casting") return tr("casting");
  if (kind == "forging") return tr("forging");
  const auto length = written(stock, "length_mm");
  if (kind == "tube")
    return say("tube {}/{} x {} mm", written(stock, "outer_mm"),
               written(stock, "inner_mm"), length);
  const auto flats = written(stock, "across_flats_mm");
  if (kind == "hexagon") return say("hexagon bar {} x {} mm", flats, length);
  if (kind == "square") return say("square bar {} x {} mm", flats, length);
  return say("bar {} x {} mm", written(stock, "diameter_mm"), length);
}

// The end that is held first or then.
std::string held(const json& hold, bool first) {
  if (hold == "left") return first ? tr("held left") : tr(", then left");
  if (hold == "right") return first ? tr("held right") : tr(", then right");
  const auto end = hold.is_string() ? hold.get<std::string>() : std::string("?");
  return first ? say("held {}", end) : say(", then {}", end);
}

std::string setups_name(const json& setups) {
  std::string all;
  if (setups.is_array())
    for (const auto& setup : setups)
      all += held(setup.is_object() ? setup.value("hold", json()) : json(), all.empty());
  return all;
}

std::string wear_name(const json& land) {
  return say("edges changed at {}", land.is_number() ? mm_text(land.get<double>()) : "?");
}

// A list of the choice, and the member of the document that it is for.
struct Choosable {
  const char* key;
  const char* pointer;
  std::string (*name)(const json&);
};
constexpr std::array<Choosable, 4> kChoosable{{
    {"machine", "/machine", machine_name},
    {"stock", "/stock", stock_name},
    {"setups", "/setups", setups_name},
    {"edge_wear_mm", "/budget/edge_wear_mm", wear_name},
}};

// Names of a list's members; those of one name are counted.
std::vector<std::string> names_of(const json& list, const Choosable& c) {
  std::vector<std::string> all;
  for (const auto& item : list) all.push_back(c.name(item));
  const auto plain = all;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (std::count(plain.begin(), plain.end(), plain[i]) > 1)
      all[i] += say(", no. {}", i + 1);
  return all;
}

// Both orders of the ends, and a part that is finished in one setup.
json automatic_setups() {
  const json left{{"hold", "left"}}, right{{"hold", "right"}};
  return json::array({json::array({left, right}), json::array({right, left}),
                      json::array({left}), json::array({right})});
}

// The length of the finished part; nothing before its elements are right.
std::optional<double> length_mm(const json& document) {
  double sum = 0;
  const auto outer = document.find("outer");
  if (outer == document.end() || !outer->is_array()) return std::nullopt;
  for (const auto& e : *outer) {
    const auto length = e.is_object() ? e.value("length_mm", json()) : json();
    if (!length.is_number()) return std::nullopt;
    sum += length.get<double>();
  }
  return sum;
}

// Whether the drawing asks for anything at an end that a blade would leave as it is: a
// roughness, a tolerance, a chamfer.
bool asks_at(const json& document, const std::string& end) {
  const auto any = [&](const char* list, const auto& asks) {
    const json members = document.value(list, json::array());
    return std::any_of(members.begin(), members.end(), [&](const json& member) {
      return !member.is_object() || asks(member);
    });
  };
  const auto names = [&](const json& member, const char* key) {
    return member.value(key, json()) == end;
  };
  const auto between = [&](const json& tolerance) {
    const json faces = tolerance.value("between", json::array());
    return std::find(faces.begin(), faces.end(), json(end)) != faces.end();
  };
  return any("faces", [&](const json& f) { return names(f, "id"); }) ||
         any("edges", [&](const json& e) { return names(e, "at"); }) ||
         any("tolerances", [&](const json& t) {
           return names(t, "of") || names(t, "datum") || between(t);
         });
}

// The stock as a longer piece of the same bar, from which the part is parted off where it is
// held; nothing if the stock is no bar or says itself that it is parted, or if parting does
// not finish that end.
json bar_to_part(const json& document, const std::string& hold) {
  constexpr double kHeld_mm = 40;  // in the jaws at least
  json bar = document.value("stock", json());
  const auto part_mm = length_mm(document);
  if (!part_mm || !bar.is_object() || bar.value("kind", json()) != "bar" ||
      bar.contains("part_off_allowance_mm") || asks_at(document, hold))
    return nullptr;
  for (const char* key : {"diameter_mm", "length_mm"})
    if (!bar.contains(key) || !bar[key].is_number()) return nullptr;
  const double spare_mm = bar["length_mm"].get<double>() - *part_mm;
  const json left = bar.value("left_allowance_mm", json(spare_mm / 2));
  if (!left.is_number()) return nullptr;
  const bool held_left = hold == "left";
  const double free_mm = held_left ? spare_mm - left.get<double>() : left.get<double>();
  const double held_mm = std::max(kHeld_mm, bar["diameter_mm"].get<double>());
  bar["length_mm"] = *part_mm + held_mm + free_mm;
  bar["left_allowance_mm"] = held_left ? held_mm : free_mm;
  bar["part_off_allowance_mm"] = 0;
  return bar;
}

// With automatic setups also those in which one setup makes all of the part from a bar and
// parts it off.
void add_parted(const Variant& before, std::vector<Variant>& out) {
  for (const std::string hold : {"left", "right"}) {
    const json bar = bar_to_part(before.document, hold);
    if (bar.is_null()) continue;
    Variant v = before;
    v.name +=
        (v.name.empty() ? "" : "; ") + say("{}, parted off a bar", held(hold, true));
    v.document["setups"] = {{{"hold", hold}}};
    v.document["stock"] = bar;
    for (const char* key : {"/setups", "/stock"})
      v.places.emplace_back(key, "/choose/setups");
    out.push_back(std::move(v));
  }
}

bool automatic(Reader& choose, const Choosable& c) {
  return std::string_view(c.key) == "setups" && choose.at(c.key).is_text();
}

json choices_of(Reader& choose, const Choosable& c) {
  if (automatic(choose, c)) {
    if (choose.at(c.key).json() != "auto")
      choose.problem_at(c.key, tr("\"auto\", or a list of lists of setups"), "choice");
    return automatic_setups();
  }
  json list = json::array();
  for (const auto& item : choose.items(c.key, 1, kListed)) list.push_back(item.json());
  return list;
}

// Each variant so far with each member of the list.
std::vector<Variant> combined(const std::vector<Variant>& all, const json& list,
                              const Choosable& c, bool parted) {
  const json::json_pointer pointer(c.pointer);
  const auto names = names_of(list, c);
  std::vector<Variant> out;
  for (const auto& before : all) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      Variant v = before;
      v.name += (v.name.empty() ? "" : "; ") + names[i];
      v.document[pointer] = list[i];
      v.places.emplace_back(c.pointer,
                            std::string("/choose/") + c.key + "/" + std::to_string(i));
      out.push_back(std::move(v));
    }
    if (parted) add_parted(before, out);
  }
  return out;
}

}  // namespace

std::vector<Variant> variants(const json& request, Problems& problems) {
  if (!request.is_object() || !request.contains("choose")) return {{"", request, {}}};
  const auto before = problems.list.size();
  Reader root(request, problems);
  Reader choose = root.object("choose");
  json bare = request;
  bare.erase("choose");
  std::vector<Variant> all{{"", std::move(bare), {}}};
  if (choose.broken()) return {};
  for (const auto& c : kChoosable) {
    if (!choose.has(c.key)) continue;
    if (request.contains(json::json_pointer(c.pointer)))
      choose.problem_at(c.key, say("no choice, for {} is given", c.pointer), "conflict");
    const json list = choices_of(choose, c);
    const bool parted = automatic(choose, c);
    if (all.size() * (list.size() + (parted ? kParted : 0)) > kCombinations)
      choose.problem_at(c.key, tr("at most 100 combinations in all"), "limit");
    else
      all = combined(all, list, c, parted);
  }
  choose.finish();
  if (problems.list.size() > before) return {};
  return all;
}

}  // namespace turnwright::document
