// Reads a part document and says how many surfaces it has to cut.  It is linked without
// planning and tool paths: a reader that computed something of theirs would not link.
#include <cstdio>

#include "document/json/file.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/document/part_plan.hpp"

int main(int count, char** arguments) {
  using namespace turnwright;
  if (count != 3) return 2;
  try {
    const auto catalogue = document::load_catalogue(arguments[1]);
    const auto part =
        document::load_part_plan(document::parse_file(arguments[2]), catalogue, "part");
    std::printf("%zu elements, %zu setups\n", part.plan.drawing.outer.size(),
                part.plan.setups.size());
    return part.plan.setups.empty() ? 1 : 0;
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
