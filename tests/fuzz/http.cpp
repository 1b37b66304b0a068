// libFuzzer target of the HTTP server: bytes as a client sends them.  Whatever they are,
// the server closes, and answers the next.
#include <thread>

#include "../service/http_client.hpp"
#include "answered.hpp"
#include "turnwright/service/server.hpp"

namespace turnwright::fuzz {
namespace {

service::ServerOptions options() {
  using std::chrono::milliseconds;
  service::ServerOptions o;
  o.port = 0;
  o.threads = 1;
  o.idle = o.header = o.body = milliseconds(20);
  o.deadline = milliseconds(200);
  return o;
}

/// Of one input: what it left at work is over before the next, and before the end.
class Running {
 public:
  explicit Running(service::HttpApi& api)
      : server_(options(), api), thread_([this] { server_.run(); }) {}
  ~Running() { server_.stop(); }
  std::uint16_t port() const { return server_.port(); }

 private:
  service::Server server_;
  std::jthread thread_;
};

}  // namespace
}  // namespace turnwright::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace turnwright;
  static service::HttpApi api(TURNWRIGHT_SOURCE_DIR, fuzz::catalogue(), nullptr);
  const fuzz::Running server(api);
  const service::RawClient client(server.port());
  client.send({reinterpret_cast<const char*>(data), size});
  (void)client.rest();
  return 0;
}
