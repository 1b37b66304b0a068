// A part said as a line of text, as elements.
#include <cstdio>

#include "turnwright/base/errors.hpp"
#include "turnwright/exchange/notation.hpp"

int main() {
  using namespace turnwright;
  const auto outline =
      exchange::read_notation("d50 h7 x 40 Ra1.6; d30 k6 x 32; M24x1.5 x 25");
  for (const auto& element : outline.outer)
    std::printf("%s: %.0f mm in diameter, %.0f mm long, fit %s\n", element.id.c_str(),
                element.left_mm, element.length_mm,
                element.demands.fit.value_or("none").c_str());
  try {
    exchange::read_notation("d50 h7 x; e30 x 10");
  } catch (const InputError& error) {
    std::printf("%zu mistakes:\n%s\n", error.problems().size(), error.what());
  }
}
