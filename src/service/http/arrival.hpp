#pragma once
#include <memory>
#include <optional>

#include "intake.hpp"
#include "state.hpp"

namespace turnwright::service {

/// What is known of a call when its header and, unless it is refused, its body have been
/// read.
struct Arrived {
  Call call;  ///< without its body
  std::unique_ptr<Intake> body;
  std::optional<Reply> refused;
  beast::error_code ec;
  bool keep_alive = false;
};

/// Reads a call.
asio::awaitable<Arrived> read_call(ServerState& state, Connection& connection);

/// Whether a byte of another call has arrived.
bool has_arrived(const Connection& connection);

/// Whether a byte of another call is there, or comes in time.
asio::awaitable<bool> next_call(const ServerState& state, Connection& connection);

}  // namespace turnwright::service
