#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "api.hpp"
#include "server_options.hpp"

namespace turnwright::service {

/// Reads keys from a file: one per line, of 16 to 200 visible characters; blank lines and
/// lines that begin with # are skipped.
/// @throws InputError if it cannot be read, or contains no key or an invalid one.
std::vector<std::string> read_keys(const std::filesystem::path& file);

struct ServerState;

/// HTTP/1.1 on one address.  One thread reads and writes, `threads` compute.
class Server {
 public:
  /// Binds the address, so that clients can connect.  `api` must outlive the server.
  /// @throws InputError if the address is invalid or cannot be bound, or if it can be
  ///   reached from other machines and there is no key.
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
