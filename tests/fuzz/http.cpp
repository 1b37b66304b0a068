// libFuzzer target of the HTTP server: bytes as a client sends them.  Whatever they are,
// the server closes, and answers the next.
#include <thread>

#include "../service/http_client.hpp"
#include "answered.hpp"
#include "turnwright/service/server.hpp"

namespace turnwright::fuzz {
namespace {

class Running {
 public:
  Running()
      : api_(TURNWRIGHT_SOURCE_DIR, catalogue(), nullptr),
        server_(options(), api_),
        thread_([this] { server_.run(); }) {}
  ~Running() { server_.stop(); }
  std::uint16_t port() const { return server_.port(); }

 private:
  static service::ServerOptions options() {
    using std::chrono::milliseconds;
    return {.port = 0,
            .threads = 1,
            .idle = milliseconds(20),
            .header = milliseconds(20),
            .body = milliseconds(20),
            .deadline = milliseconds(200)};
  }
  service::HttpApi api_;
  service::Server server_;
  std::jthread thread_;
};

}  // namespace
}  // namespace turnwright::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static turnwright::fuzz::Running server;
  const turnwright::service::RawClient client(server.port());
  client.send({reinterpret_cast<const char*>(data), size});
  (void)client.rest();
  return 0;
}
