#include "thread_label.hpp"

#include "svg.hpp"
#include "turnwright/part/inch_thread.hpp"

namespace turnwright::report {

std::string thread_label(const part::Cut& thread) {
  const double d = thread.drawn.left_mm, P = thread.pitch_mm;
  const auto inch = part::inch_designation(d, P);
  return inch ? *inch : 'M' + plain(d) + "\u00d7" + plain(P);
}

}  // namespace turnwright::report
