#include "running_ids.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace turnwright::exchange::notated {
namespace {

using Names = std::map<std::string, std::string>;

void rename(std::vector<Element>& elements, char letter, Names& names) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto running = letter + std::to_string(i + 1);
    names[elements[i].id] = running;
    elements[i].id = running;
  }
}

// Of an element, or of two with '|' between.
void refer(std::string& id, const Names& names) {
  std::string out;
  for (std::size_t begin = 0; begin <= id.size();) {
    const auto end = std::min(id.find('|', begin), id.size());
    const auto one = id.substr(begin, end - begin);
    const auto found = names.find(one);
    out += (begin > 0 ? "|" : "") + (found == names.end() ? one : found->second);
    begin = end + 1;
  }
  id = out;
}

}  // namespace

Outline with_running_ids(Outline o) {
  Names names;
  rename(o.outer, 'd', names);
  rename(o.inner, 'b', names);
  for (auto& e : o.edges) refer(e.at, names);
  for (auto& f : o.faces) refer(f.id, names);
  for (auto& t : o.tolerances) {
    refer(t.of, names);
    refer(t.datum, names);
    refer(t.common_datum, names);
    for (auto& face : t.between) refer(face, names);
  }
  for (auto& m : o.milled) refer(m.on, names);
  return o;
}

}  // namespace turnwright::exchange::notated
