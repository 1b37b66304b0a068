#pragma once
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace turnwright::service {

struct ServerOptions {
  std::string address = "127.0.0.1";  ///< numeric, IPv4 or IPv6
  std::uint16_t port = 8080;          ///< 0: any that is free
  unsigned threads = 0;               ///< computing threads; 0: one per core
  std::size_t queue = 256;         ///< calls that may wait for a thread; others get 503
  std::size_t connections = 4096;  ///< open at once; others get 503 and are closed
  std::size_t body_bytes = 128'000'000;  ///< all bodies and answers on their way together
  std::size_t spool_bytes = 1'000'000'000;  ///< of disk, all batches that arrive together
  std::size_t header_bytes = 16'384;        ///< of request line and header together
  std::chrono::milliseconds idle{60'000};   ///< between two calls of a connection
  std::chrono::milliseconds header{10'000};    ///< from the first byte to the last header
  std::chrono::milliseconds body{60'000};      ///< from there to the last byte
  std::chrono::milliseconds writing{60'000};   ///< for the client to take the answer
  std::chrono::milliseconds deadline{60'000};  ///< to compute the answer
  std::chrono::milliseconds drain{120'000};    ///< for open calls after stop()
  std::vector<std::string> keys;  ///< bearer keys; empty: every caller is served
};

}  // namespace turnwright::service
