#pragma once
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "turnwright/service/http_api.hpp"

namespace turnwright::service {

struct ServerOptions {
  std::string address = "127.0.0.1";  ///< numeric, IPv4 or IPv6
  std::uint16_t port = 8080;          ///< 0: any that is free
  unsigned threads = 0;            ///< that compute; 0: as many as the machine has cores
  std::size_t queue = 256;         ///< calls that may wait for a thread; more get 503
  std::size_t connections = 4096;  ///< open at once; more get 503 and are closed
  std::size_t header_bytes = 16'384;           ///< of request line and header together
  std::chrono::milliseconds idle{60'000};      ///< between two calls of a connection
  std::chrono::milliseconds header{10'000};    ///< from the first byte to the last header
  std::chrono::milliseconds body{60'000};      ///< from there to the last byte
  std::chrono::milliseconds writing{60'000};   ///< for the client to take the answer
  std::chrono::milliseconds deadline{60'000};  ///< to compute the answer
  std::chrono::milliseconds drain{120'000};    ///< for open calls after stop()
  std::vector<std::string> keys;  ///< bearer keys; empty: every caller is served
};

/// The keys in a file: one a line, of 16 to 200 visible characters; blank lines and lines
/// that begin with # are skipped.
/// @throws InputError if it cannot be read, holds none or a wrong one.
std::vector<std::string> read_keys(const std::filesystem::path& file);

struct ServerState;

/// HTTP/1.1 on one address.  One thread reads and writes, `threads` compute.
class Server {
 public:
  /// Binds, so that clients can connect from here on.  `api` must outlive the server.
  /// @throws InputError if the address is none, if it is not of this machine alone and
  ///   there is no key, or if it cannot be bound.
  Server(const ServerOptions& options, const HttpApi& api);
  ~Server();

  std::uint16_t port() const;

  /// Serves until stop(), SIGTERM or SIGINT; then refuses new connections, answers every
  /// call that has arrived, and returns.
  void run();
  void stop();  ///< from any thread

 private:
  std::unique_ptr<ServerState> state_;
};

}  // namespace turnwright::service
