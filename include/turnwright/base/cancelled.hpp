#pragma once
#include <exception>
#include <stop_token>

namespace turnwright {

/// Nobody waits for the answer any more.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "cancelled"; }
};

/// To be called between pieces of long work.  @throws Cancelled if `stop` was asked for.
inline void leave_if(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Cancelled();
}

}  // namespace turnwright
