#pragma once
#include <utility>  // Boost 1.74's awaitable.hpp uses std::exchange without it
//
#include <atomic>
#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <set>

#include "api.hpp"
#include "budget.hpp"
#include "metrics.hpp"
#include "server_options.hpp"

namespace turnwright::service {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;

struct Connection {
  explicit Connection(tcp::socket accepted) : socket(std::move(accepted)) {}
  tcp::socket socket;
  beast::flat_buffer buffer{65'536};  ///< largest amount of bytes that is not yet parsed
  bool idle = false;  ///< between two calls, so that it may be closed without losing one
};

/// Eight random hexadecimal digits, by which ids of calls identify the process.
std::string process_name();

/// State of a server.  Only the thread that runs `io` accesses it, apart from the work of
/// `pool`.
struct ServerState {
  ServerState(const ServerOptions& given, const HttpApi& api_)
      : options(given), api(api_), pool(given.threads) {}

  ServerOptions options;
  const HttpApi& api;
  Metrics metrics;
  Budget memory{options.body_bytes}, disk{options.spool_bytes};
  asio::io_context io{1};
  asio::thread_pool pool;
  tcp::acceptor acceptor{io};
  asio::signal_set signals{io, SIGINT, SIGTERM};
  asio::steady_timer drain{io};
  std::set<Connection*> connections;
  std::size_t waiting = 0;                  ///< calls in `pool`
  const std::string name = process_name();  ///< of this process, in the ids of calls
  std::uint64_t calls = 0;
  bool draining = false;

  bool full() const { return waiting >= options.queue + options.threads; }
};

/// Answers the calls of one connection until it ends.
asio::awaitable<void> serve(ServerState& state, tcp::socket socket);

/// Refuses a client because there are too many, and closes the connection.
asio::awaitable<void> turn_away(ServerState& state, tcp::socket socket);

}  // namespace turnwright::service
