// The turning programs of a plan, for Haas.
// Usage: nc PART.json
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "turnwright/base/errors.hpp"
#include "turnwright/document/prepared_part.hpp"
#include "turnwright/nc/text.hpp"
#include "turnwright/planning/plan.hpp"

int main(int argc, char** argv) try {
  using namespace turnwright;
  if (argc != 2) return 2;
  std::ifstream file(argv[1]);
  const auto catalogue = document::load_catalogue(CATALOGUE);
  const auto part =
      document::prepared_part(nlohmann::json::parse(file), catalogue, argv[1]);
  auto programs = nc::programs(part.part, planning::plan(part.part));
  const nc::Settings settings{.control = nc::Control::haas};
  nc::number_tools(programs.setups, settings);
  for (const auto& program : programs.setups)
    std::fputs(nc::text(program, settings).c_str(), stdout);
  for (const auto& why : programs.cannot) std::printf("cannot: %s\n", why.c_str());
} catch (const turnwright::InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
