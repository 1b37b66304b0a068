#include "choices.hpp"

#include <array>
#include <string_view>

namespace turnwright::document {
namespace {

using nlohmann::json;

constexpr std::size_t kListed = 20, kCombinations = 100;

std::string written(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? number_text(found->get<double>())
                                                     : "?";
}

std::string machine_name(const json& machine) {
  if (machine.is_string()) return machine.get<std::string>();
  return machine.is_object() ? shown(machine.value("id", json("machine"))) : "machine";
}

std::string stock_name(const json& stock) {
  if (!stock.is_object()) return "stock";
  const bool tube = stock.value("kind", json()) == "tube";
  return (tube ? "tube " + written(stock, "outer_mm") + "/" + written(stock, "inner_mm")
               : "bar " + written(stock, "diameter_mm")) +
         " x " + written(stock, "length_mm") + " mm";
}

std::string setups_name(const json& setups) {
  std::string all;
  if (setups.is_array())
    for (const auto& setup : setups) {
      const auto hold = setup.is_object() ? setup.value("hold", json()) : json();
      all += (all.empty() ? "held " : ", then ") +
             (hold.is_string() ? hold.get<std::string>() : std::string("?"));
    }
  return all;
}

std::string wear_name(const json& land) {
  return "edges changed at " + (land.is_number() ? mm_text(land.get<double>()) : "?");
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

// Both orders of the ends, and a part that is finished in one setup.
json automatic_setups() {
  const json left{{"hold", "left"}}, right{{"hold", "right"}};
  return json::array({json::array({left, right}), json::array({right, left}),
                      json::array({left}), json::array({right})});
}

json choices_of(Reader& choose, const Choosable& c) {
  if (std::string_view(c.key) == "setups" && choose.at(c.key).is_text()) {
    if (choose.at(c.key).json() != "auto")
      choose.problem_at(c.key, "\"auto\", or a list of lists of setups", "choice");
    return automatic_setups();
  }
  json list = json::array();
  for (const auto& item : choose.items(c.key, 1, kListed)) list.push_back(item.json());
  return list;
}

// Each variant so far with each member of the list.
std::vector<Variant> combined(const std::vector<Variant>& all, const json& list,
                              const Choosable& c) {
  const json::json_pointer pointer(c.pointer);
  std::vector<Variant> out;
  for (const auto& before : all)
    for (std::size_t i = 0; i < list.size(); ++i) {
      Variant v = before;
      v.name += (v.name.empty() ? "" : "; ") + c.name(list[i]);
      v.document[pointer] = list[i];
      v.places.emplace_back(c.pointer,
                            std::string("/choose/") + c.key + "/" + std::to_string(i));
      out.push_back(std::move(v));
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
      choose.problem_at(c.key, std::string("no choice, for ") + c.pointer + " is given",
                        "conflict");
    const json list = choices_of(choose, c);
    if (all.size() * list.size() > kCombinations)
      choose.problem_at(c.key, "at most 100 combinations in all", "limit");
    else
      all = combined(all, list, c);
  }
  choose.finish();
  if (problems.list.size() > before) return {};
  return all;
}

}  // namespace turnwright::document
