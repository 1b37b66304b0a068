#include "budget.hpp"

namespace turnwright::service {

std::size_t Budget::most_for(std::size_t bytes) const {
  return bytes <= kSmall ? most_ : most_ - most_ / 4;
}

bool Budget::has_room(std::size_t bytes) const {
  const auto most = most_for(bytes);
  const auto used = used_.load();
  return used <= most && bytes <= most - used;
}

bool Budget::Share::resize(std::size_t bytes) {
  if (bytes <= bytes_) {
    budget_.used_ -= bytes_ - bytes;
    bytes_ = bytes;
    return true;
  }
  const auto most = budget_.most_for(bytes), more = bytes - bytes_;
  auto used = budget_.used_.load();
  do
    if (used > most || more > most - used) return false;
  while (!budget_.used_.compare_exchange_weak(used, used + more));
  bytes_ = bytes;
  return true;
}

}  // namespace turnwright::service
