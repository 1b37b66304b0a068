#include "turnwright/service/requests.hpp"

#include <vector>

namespace turnwright::service {

std::span<const Request> requests() {
  static const std::vector<Request> kTable{};
  return kTable;
}

}  // namespace turnwright::service
