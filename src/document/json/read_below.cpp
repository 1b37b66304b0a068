#include "read_below.hpp"

#include <utility>

#include "turnwright/base/errors.hpp"

namespace turnwright::document {

bool read_below(const Reader& member, Problems& problems,
                const std::function<void()>& work) {
  if (member.broken()) return false;
  try {
    work();
    return true;
  } catch (const InputError& e) {
    for (auto problem : e.problems()) {
      problem.pointer = member.pointer() + problem.pointer;
      problems.add(std::move(problem));
    }
    return false;
  }
}

}  // namespace turnwright::document
