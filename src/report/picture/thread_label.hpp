#pragma once
#include <string>

#include "turnwright/part/cut.hpp"

namespace turnwright::report {

/// "M24×1.5", "1/2-13 UN".
std::string thread_label(const part::Cut& thread);

}  // namespace turnwright::report
