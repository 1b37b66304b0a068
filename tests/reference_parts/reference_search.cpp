#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "document/json/file.hpp"
#include "global_search.hpp"
#include "turnwright/document/catalogue.hpp"
#include "turnwright/document/prepared_part.hpp"

// Writes the costs of the named parts: reference_search [--short] COSTS.json PART...
// where PART is a name in parts/; parts not named keep what COSTS.json says.
int main(int argc, char** argv) {
  using namespace turnwright;
  const std::vector<std::string> words(argv + 1, argv + argc);
  const bool brief = !words.empty() && words[0] == "--short";
  if (words.size() < (brief ? 3U : 2U)) {
    std::cerr << "usage: reference_search [--short] COSTS.json PART...\n";
    return 2;
  }
  const std::string root = TURNWRIGHT_SOURCE_DIR, file = words[brief];
  const auto catalogue = document::load_catalogue(root);
  nlohmann::ordered_json costs = nlohmann::ordered_json::object();
  if (std::ifstream in(file); in) costs = nlohmann::ordered_json::parse(in);
  for (std::size_t k = brief + 1U; k < words.size(); ++k) {
    const auto& name = words[k];
    const auto start = std::chrono::steady_clock::now();
    const auto part = document::prepared_part(
        document::parse_file(root + "/parts/" + name + ".json"), catalogue, name);
    const auto found =
        reference::search(part.part, brief ? reference::kShort : reference::Effort{});
    const std::chrono::duration<double> s = std::chrono::steady_clock::now() - start;
    std::cout.precision(12);
    std::cout << name << ' ' << found.objective << " in " << s.count() << " s\n";
    auto& entry = costs[name] = nlohmann::ordered_json::object();
    if (std::isfinite(found.objective))
      entry["cost_per_part"] = found.objective;
    else
      entry["infeasible"] = true;
    entry["command"] = "reference_search " + std::string(brief ? "--short " : "") +
                       "tests/reference_parts/costs.json " + name;
    for (const auto& setup : found.setups) {
      std::cout << "  " << planning::name(setup.clamping) << ' ' << setup.objective
                << ", " << setup.indexings << " tools brought in\n";
      for (const auto& x : setup.surfaces)
        std::cout << "    " << x.surface << ' ' << x.objective << "  " << x.rough_passes
                  << " x " << x.rough << " v " << x.v_m_min[0] << " f " << x.f_mm_rev[0]
                  << ", " << x.finish_passes << " x " << x.finish << " v " << x.v_m_min[1]
                  << " f " << x.f_mm_rev[1] << ", a " << x.a_mm << ", excess " << x.excess
                  << '\n';
    }
  }
  std::ofstream(file) << costs.dump(2) << '\n';
}
