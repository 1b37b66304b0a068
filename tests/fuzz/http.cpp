#include <thread>

#include "../service/http/client.hpp"
#include "answered.hpp"
#include "service/http/server.hpp"
#include "targets.hpp"

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

Target http_target() {
  return [](std::string_view input) {
    static service::HttpApi api(TURNWRIGHT_SOURCE_DIR, catalogue(), nullptr);
    const Running server(api);
    const service::RawClient client(server.port());
    client.send(std::string(input));
    (void)client.rest();
  };
}

}  // namespace turnwright::fuzz
