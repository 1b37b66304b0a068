#pragma once
#include <memory>

#include "state.hpp"

namespace turnwright::service {

/// Cancels the socket's operation after a time.  (Beast's own timeouts close the socket,
/// so that no answer can be sent to the client.)
class Alarm {
 public:
  Alarm(tcp::socket& socket, std::chrono::milliseconds after)
      : timer_(socket.get_executor(), after) {
    timer_.async_wait([state = state_, &socket](beast::error_code) {
      if (*state != State::set) return;
      *state = State::rang;
      socket.cancel();
    });
  }
  Alarm(const Alarm&) = delete;
  Alarm& operator=(const Alarm&) = delete;
  ~Alarm() {
    if (!rang()) *state_ = State::off;
  }
  bool rang() const { return *state_ == State::rang; }

 private:
  enum class State { set, rang, off };
  std::shared_ptr<State> state_ = std::make_shared<State>(State::set);
  asio::steady_timer timer_;
};

/// How a coroutine waits for an operation: its error is stored, not thrown.
inline auto into(beast::error_code& ec) {
  return asio::redirect_error(asio::use_awaitable, ec);
}

}  // namespace turnwright::service
