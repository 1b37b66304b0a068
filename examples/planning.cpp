// The certified cheapest plan of a part document.
// Usage: planning PART.json
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "turnwright/base/errors.hpp"
#include "turnwright/document/prepared_part.hpp"
#include "turnwright/planning/plan.hpp"

int main(int argc, char** argv) try {
  using namespace turnwright;
  if (argc != 2) return 2;
  std::ifstream file(argv[1]);
  const auto catalogue = document::load_catalogue(CATALOGUE);
  const auto part =
      document::prepared_part(nlohmann::json::parse(file), catalogue, argv[1]);
  const auto plan = planning::plan(part.part);
  for (const auto& setup : plan.setups)
    for (const auto& operation : setup.operations)
      std::printf("%-16s %-22s %5.2f min\n", operation.id.c_str(), operation.tool.c_str(),
                  operation.time_min);
  std::printf("cost %.4f per part, at most %.1e above the least possible\n",
              plan.cost_per_part, plan.certificate.gap);
} catch (const turnwright::InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
