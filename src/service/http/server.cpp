#include "server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <thread>

#include "state.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::service {
namespace {

ServerOptions complete(ServerOptions options) {
  if (options.threads == 0)
    options.threads = std::max(1U, std::thread::hardware_concurrency());
  return options;
}

[[noreturn]] void refuse(const char* option, const std::string& got,
                         const std::string& expected, const std::string& code) {
  throw InputError(tr("command line"), {{option, got, expected, code}});
}

asio::ip::address address_of(const ServerOptions& options) {
  boost::system::error_code ec;
  const auto address = asio::ip::make_address(options.address, ec);
  if (ec) refuse("--address", options.address, tr("a numeric IP address"), "address");
  if (!address.is_loopback() && options.keys.empty())
    refuse("--address", options.address,
           tr("a loopback address, or keys for the callers (--keys)"), "keys");
  return address;
}

/// Starts to listen.
void bind(tcp::acceptor& acceptor, const ServerOptions& options) {
  const tcp::endpoint endpoint(address_of(options), options.port);
  try {
    acceptor.open(endpoint.protocol());
    acceptor.set_option(tcp::acceptor::reuse_address(true));
    acceptor.bind(endpoint);
    acceptor.listen();
  } catch (const boost::system::system_error& error) {
    const auto why = ": " + error.code().message();
    if (error.code() == boost::system::errc::address_in_use ||
        error.code() == boost::system::errc::permission_denied)
      refuse("--port", std::to_string(options.port) + why,
             tr("a port that is free and that this user may listen on"), "port");
    refuse("--address", options.address + why, tr("an address of this machine"),
           "address");
  }
}

void admit(ServerState& state, tcp::socket socket) {
  const bool room = state.connections.size() < state.options.connections;
  try {
    asio::co_spawn(state.io, (room ? serve : turn_away)(state, std::move(socket)),
                   asio::detached);
  } catch (const std::bad_alloc&) {  // this connection is closed, the next may succeed
  }
}

asio::awaitable<void> accept(ServerState& state) {
  asio::steady_timer pause(state.io);
  while (state.acceptor.is_open()) {
    boost::system::error_code ec;
    auto socket = co_await state.acceptor.async_accept(
        asio::redirect_error(asio::use_awaitable, ec));
    if (!ec) {
      admit(state, std::move(socket));
    } else {  // out of file descriptors, or the client has gone; others may succeed
      pause.expires_after(std::chrono::milliseconds(20));
      co_await pause.async_wait(asio::redirect_error(asio::use_awaitable, ec));
    }
  }
}

/// Runs until there is nothing to do.  A handler that throws has no memory; what it was
/// for ends with it, a connection or less.
void run_on(asio::io_context& io) {
  for (;;) try {
      io.run();
      return;
    } catch (const std::bad_alloc&) {
    }
}

/// Accepts connections that the system has already queued, because they may carry calls.
void admit_waiting(ServerState& state) {
  boost::system::error_code ec;
  state.acceptor.non_blocking(true, ec);
  for (int left = tcp::acceptor::max_listen_connections; left > 0 && !ec; --left) {
    auto socket = state.acceptor.accept(ec);
    if (!ec) admit(state, std::move(socket));
  }
}

/// Closes idle connections; the others have time until the end of the drain.
void drain_connections(ServerState& state) {
  boost::system::error_code ec;
  for (auto* connection : state.connections)
    if (connection->idle) connection->socket.cancel(ec);
  if (state.connections.empty()) return;
  state.drain.expires_after(state.options.drain);
  state.drain.async_wait([&state](boost::system::error_code cancelled) {
    boost::system::error_code ignored;
    if (!cancelled)
      for (auto* connection : state.connections) connection->socket.close(ignored);
  });
}

void begin_drain(ServerState& state) {
  if (state.draining) return;
  state.draining = true;
  boost::system::error_code ec;
  admit_waiting(state);
  state.acceptor.close(ec);
  state.signals.cancel(ec);
  // By then every admitted client is among the connections.
  asio::post(state.io, [&state] { drain_connections(state); });
}

}  // namespace

std::string process_name() { return fmt::format("{:08x}", std::random_device()()); }

Server::Server(const ServerOptions& options, const HttpApi& api)
    : state_(std::make_unique<ServerState>(complete(options), api)) {
  bind(state_->acceptor, options);
}

Server::~Server() { state_->pool.join(); }

std::uint16_t Server::port() const { return state_->acceptor.local_endpoint().port(); }

void Server::run() {
  auto& state = *state_;
  state.signals.async_wait([&state](boost::system::error_code ec, int) {
    if (!ec) begin_drain(state);
  });
  asio::co_spawn(state.io, accept(state), asio::detached);
  run_on(state.io);
}

void Server::stop() {
  asio::post(state_->io, [this] { begin_drain(*state_); });
}

}  // namespace turnwright::service
