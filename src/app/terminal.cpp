#include "terminal.hpp"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "report/text/terminal.hpp"
#include "service/output.hpp"

namespace turnwright::app {
namespace {

bool has_colours() {
  const char *term = std::getenv("TERM"), *none = std::getenv("NO_COLOR");
  return ::isatty(STDOUT_FILENO) == 1 && term && *term &&
         std::string_view(term) != "dumb" && (!none || !*none);
}

}  // namespace

void print_report(const std::string& text) {
  service::print(text, has_colours() ? report::styled : nullptr);
}

}  // namespace turnwright::app
