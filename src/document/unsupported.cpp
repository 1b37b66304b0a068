#include "turnwright/document/part_plan.hpp"

namespace turnwright::document {

void refuse_unsupported(const Reader& root) {
  Reader r = root;
  if (r.has("milling") && r.json()["milling"].is_array() && !r.json()["milling"].empty())
    r.problem_at("milling", "none: this version plans turning only", "unsupported");
}

}  // namespace turnwright::document
