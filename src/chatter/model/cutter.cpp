#include "turnwright/chatter/cutter.hpp"

namespace turnwright::chatter {

double period_s(const Cutter& cutter, double n_rpm) {
  return cutter.by_revolution() ? 60 / n_rpm : period_s(cutter.system, n_rpm);
}

}  // namespace turnwright::chatter
