#include "service/http/server.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <thread>

#include "../little_memory.hpp"
#include "client.hpp"
#include "turnwright/document/catalogue.hpp"

namespace turnwright::service::server_test {
namespace {

using namespace std::chrono_literals;

const HttpApi& served_api() {
  static const auto kCatalogue = document::load_catalogue(TURNWRIGHT_SOURCE_DIR);
  static const HttpApi kApi(TURNWRIGHT_SOURCE_DIR, kCatalogue, nullptr);
  return kApi;
}

/// A server on a free port for the time of one test.
class Running {
 public:
  explicit Running(ServerOptions options = {}) {
    options.port = 0;
    server_.emplace(options, served_api());
    thread_ = std::thread([this] { server_->run(); });
  }
  ~Running() {
    stop();
    if (thread_.joinable()) thread_.join();
  }
  void stop() { server_->stop(); }
  void wait() { thread_.join(); }
  RawClient client() const { return RawClient(server_->port()); }

 private:
  std::optional<Server> server_;
  std::thread thread_;
};

std::string get(const std::string& target, const std::string& more = "") {
  return "GET " + target + " HTTP/1.1\r\nHost: x\r\n" + more + "\r\n";
}

std::string post(const std::string& target, const std::string& body,
                 const std::string& more = "") {
  return "POST " + target + " HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n" +
         more + "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

// A part that takes seconds: a plan on every corner of cost against time.
std::string long_plan() {
  std::ifstream file(TURNWRIGHT_SOURCE_DIR "/parts/gearbox-input-shaft.json");
  auto part = nlohmann::json::parse(file);
  part["pareto"] = 5;
  return part.dump();
}

double metric(RawClient& client, const std::string& name) {
  const auto all = body_of(client.ask(get("/metrics")));
  return std::stod(all.substr(all.find('\n' + name + ' ') + name.size() + 2));
}

void wait_for_metric(RawClient& client, const std::string& line) {
  while (body_of(client.ask(get("/metrics"))).find(line) == std::string::npos) {
  }
}

TEST(Server, KeepsAConnectionForManyCalls) {
  const Running server;
  auto client = server.client();
  for (int i = 0; i < 50; ++i) EXPECT_EQ(status_of(client.ask(get("/healthz"))), 200);
  // All at once on one connection: answered in order.
  client.send(get("/healthz") + get("/nowhere") + post("/v1/multipass", "{}") +
              get("/readyz"));
  EXPECT_EQ(status_of(client.answer()), 200);
  EXPECT_EQ(status_of(client.answer()), 404);
  EXPECT_NE(body_of(client.answer()).find("\"UC\""), std::string::npos);
  EXPECT_EQ(body_of(client.answer()), "ready\n");
}

TEST(Server, ClosesWhenAsked) {
  const Running server;
  auto client = server.client();
  client.send(get("/healthz", "Connection: close\r\n"));
  EXPECT_EQ(status_of(client.rest()), 200);
  auto old = server.client();
  old.send("GET /healthz HTTP/1.0\r\nConnection: keep-alive\r\n\r\n");
  EXPECT_EQ(status_of(old.rest()), 200);
}

TEST(Server, HeadHasNoBody) {
  const Running server;
  auto client = server.client();
  client.send("HEAD /healthz HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
  const auto all = client.rest();
  EXPECT_NE(all.find("Content-Length: 3\r\n"), std::string::npos);
  EXPECT_EQ(body_of(all), "");
}

TEST(Server, RefusesWhatIsTooLargeOrNoHttp) {
  const Running server;
  const auto status = [&](const std::string& bytes) {
    const auto client = server.client();
    client.send(bytes);
    return status_of(client.rest());
  };
  EXPECT_EQ(status(get('/' + std::string(100'000, 'a'))), 414);
  EXPECT_EQ(status(get("/healthz", "X: " + std::string(100'000, 'a') + "\r\n")), 431);
  EXPECT_EQ(
      status(
          "POST /v1/plan HTTP/1.1\r\nHost: x\r\nContent-Length: 1000000000000\r\n\r\n"),
      413);
  EXPECT_EQ(status(post("/v1/plan", std::string(2'000'001, ' '))), 413);
  EXPECT_EQ(status("POST /v1/plan HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: "
                   "chunked\r\n\r\nzz\r\n"),
            400);
  std::string chunks =
      "POST /v1/plan HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n";
  for (int i = 0; i < 3; ++i)
    chunks += "f4240\r\n" + std::string(1'000'000, ' ') + "\r\n";
  EXPECT_EQ(status(chunks + "0\r\n\r\n"), 413);
  EXPECT_EQ(
      status("POST /v1/plan HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n1;" +
             std::string(1'000'000, 'a') + "\r\n{\r\n0\r\n\r\n"),
      431);
  EXPECT_EQ(status("POST /v1/plan HTTP/1.1\r\nContent-Length: 5\r\n"
                   "Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n"),
            400);
  EXPECT_EQ(status("POST /v1/plan HTTP/1.1\r\nContent-Length: -5\r\n\r\n"), 400);
  EXPECT_EQ(status("\x16\x03\x01\x02 no http at all\r\n\r\n"), 400);
  EXPECT_EQ(status("GET /healthz HTTP/9.9\r\n\r\n"), 400);
}

TEST(Server, RefusesWhatTwoReadersCouldReadDifferently) {
  const Running server;
  const auto status = [&](const std::string& header, const char* version = "1.1") {
    const auto client = server.client();
    client.send("POST /v1/multipass HTTP/" + std::string(version) +
                "\r\nContent-Type: application/json\r\nConnection: close\r\n" + header +
                "\r\n{}");
    return status_of(client.rest());
  };
  EXPECT_EQ(status("Host: x\r\nContent-Length: 2\r\n"), 200);
  EXPECT_EQ(status("Host: x\r\nContent-Length: 2\r\nContent-Length: 2\r\n"), 200);
  EXPECT_EQ(status("Host: x\r\nContent-Length: 2\r\nContent-Length: 3\r\n"), 400);
  EXPECT_EQ(status("Content-Length: 2\r\n"), 400);
  EXPECT_EQ(status("Content-Length: 2\r\n", "1.0"), 200);
  EXPECT_EQ(status("Host: x\r\nHost: y\r\nContent-Length: 2\r\n"), 400);
  for (const std::string twice :
       {"Content-Type: text/plain",
        "Content-Encoding: identity\r\nContent-Encoding: gzip",
        "Authorization: a\r\nAuthorization: b", "Origin: http://x\r\nOrigin: http://y",
        "Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked"})
    EXPECT_EQ(status("Host: x\r\n" + twice + "\r\n"), 400) << twice;
  EXPECT_EQ(status("Host: x\r\nTransfer-Encoding: xchunked\r\nContent-Length: 2\r\n"),
            501);
  EXPECT_EQ(status("Host: x\r\nTransfer-Encoding: gzip, chunked\r\n"), 501);
  EXPECT_EQ(status("Host: x\r\nTransfer-Encoding: chunked\r\n", "1.0"), 501);
  EXPECT_EQ(status("Host: x\r\nContent-Encoding: gzip\r\nContent-Length: 2\r\n"), 415);
}

// A browser is led here by a page from elsewhere, which may know this machine by a name
// of its own.
TEST(Server, AnswersPagesOfItsOwnAlone) {
  const auto status = [](const Running& server, const std::string& header) {
    const auto client = server.client();
    client.send("GET /healthz HTTP/1.1\r\nConnection: close\r\n" + header + "\r\n");
    return status_of(client.rest());
  };
  const Running open;
  for (const char* host :
       {"localhost:8080", "127.0.0.1", "[::1]:8080", "lathe", "10.0.0.7:1"})
    EXPECT_EQ(status(open, "Host: " + std::string(host) + "\r\n"), 200) << host;
  for (const char* host :
       {"rebound.example:8080", "rebound.example.", "10.0.0.7.example"})
    EXPECT_EQ(status(open, "Host: " + std::string(host) + "\r\n"), 421) << host;
  for (const char* host : {"[::1].rebound.example", "[", "[::1", "[x]", "a, b", "x:80a",
                           "a b", "user@x", "x:1:2", "a/b", "127.0.0.1,x"})
    EXPECT_EQ(status(open, "Host: " + std::string(host) + "\r\n"), 400) << host;
  EXPECT_EQ(status(open, "Host:\r\n"), 200);  // of a client that has none
  EXPECT_EQ(status(open, "Host: localhost:1\r\nOrigin: http://localhost:1\r\n"), 200);
  EXPECT_EQ(status(open, "Host: localhost:1\r\nOrigin: http://localhost:2\r\n"), 403);
  EXPECT_EQ(status(open, "Host: localhost:1\r\nOrigin: null\r\n"), 403);
  ServerOptions options;
  options.keys = {"one-key-of-16-characters"};  // which no browser sends unasked
  const Running locked(options);
  EXPECT_EQ(status(locked, "Host: plans.example\r\nOrigin: https://plans.example\r\n"),
            200);
}

// RFC 9112, 3.2.2: also who speaks to a proxy is answered, and the target's host counts.
TEST(Server, TakesTargetsWithTheirHost) {
  const Running server;
  const auto ask = [&](const std::string& line, const std::string& header = "Host: x") {
    auto client = server.client();
    return client.ask(line + " HTTP/1.1\r\n" + header + "\r\n\r\n");
  };
  EXPECT_EQ(body_of(ask("GET http://localhost:8080/healthz")), "ok\n");
  EXPECT_EQ(body_of(ask("GET HTTPS://10.0.0.7/healthz")), "ok\n");
  EXPECT_EQ(status_of(ask("GET http://localhost")), 200);
  EXPECT_EQ(status_of(ask("GET http://localhost?x=1")), 400);
  EXPECT_EQ(status_of(ask("GET http://localhost/v1/parts/none")), 404);
  EXPECT_EQ(status_of(ask("GET http://rebound.example/healthz", "Host: localhost")), 421);
  EXPECT_EQ(body_of(ask("GET http://localhost/healthz", "Host: rebound.example")),
            "ok\n");
  EXPECT_EQ(status_of(ask("GET http://localhost:1/healthz",
                          "Host: localhost:2\r\nOrigin: http://localhost:2")),
            403);
  EXPECT_EQ(status_of(ask("GET http://localhost/healthz", "X: no host")), 400);
  for (const char* none : {"http:///healthz", "http://", "http://:80/healthz",
                           "http://user@localhost/healthz", "ftp://localhost/healthz",
                           "localhost/healthz", "localhost:80", "*"})
    EXPECT_EQ(status_of(ask("GET " + std::string(none))), 400) << none;
}

TEST(Server, OptionsOfAllAndConnectAreAnswered) {
  const Running server;
  auto client = server.client();
  for (const char* all : {"*", "http://localhost"}) {
    client.send("OPTIONS " + std::string(all) + " HTTP/1.1\r\nHost: x\r\n\r\n");
    const auto answer = client.answer();
    EXPECT_EQ(status_of(answer), 204) << all;
    EXPECT_NE(answer.find("Allow: GET, HEAD, POST, DELETE, OPTIONS\r\n"),
              std::string::npos);
  }
  // What comes behind CONNECT would be meant for somebody else.
  client.send("CONNECT localhost:443 HTTP/1.1\r\nHost: localhost:443\r\n\r\n" +
              get("/healthz"));
  const auto rest = client.rest();
  EXPECT_EQ(status_of(rest), 501);
  EXPECT_EQ(rest.find("HTTP/1.1 200"), std::string::npos);
  auto other = server.client();
  EXPECT_EQ(status_of(other.ask("BREW /healthz HTTP/1.1\r\nHost: x\r\n\r\n")), 501);
  EXPECT_EQ(status_of(other.ask(get("/readyz?x=1"))), 400);
  EXPECT_EQ(status_of(other.ask(get("/metrics?x=1"))), 400);
  other.send("OPTIONS /metrics HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_EQ(status_of(other.answer()), 204);
}

// RFC 9112, 2.2: some clients end a body with a line too many.
TEST(Server, EmptyLinesBeforeACallAreIgnored) {
  ServerOptions options;
  options.idle = 500ms;
  const Running server(options);
  auto client = server.client();
  EXPECT_EQ(status_of(client.ask("\r\n" + get("/healthz"))), 200);
  EXPECT_EQ(status_of(client.ask(post("/v1/multipass", "{}") + "\r\n")), 200);
  EXPECT_EQ(status_of(client.ask(get("/healthz"))), 200);
  client.send("\r");
  std::this_thread::sleep_for(20ms);
  client.send("\n\r\n\r");
  std::this_thread::sleep_for(20ms);
  EXPECT_EQ(status_of(client.ask("\n" + get("/healthz"))), 200);
  // They are no call: a connection with nothing else is idle.
  client.send(std::string(100'000, '\r').replace(1, 1, "\n"));
  EXPECT_EQ(status_of(client.rest()), 400);
  const auto quiet = server.client();
  std::string lines;
  for (int i = 0; i < 100'000; ++i) lines += "\r\n";
  quiet.send(lines);
  EXPECT_EQ(quiet.rest(), "");
}

TEST(Server, TakesChunksAndExpectations) {
  const Running server;
  auto client = server.client();
  const std::string head =
      "POST /v1/multipass HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n";
  EXPECT_EQ(status_of(client.ask(head + "Transfer-Encoding: chunked\r\n\r\n"
                                        "1\r\n{\r\n1\r\n}\r\n0\r\n\r\n")),
            200);
  client.send(head + "Expect: 100-continue\r\nContent-Length: 2\r\n\r\n");
  EXPECT_EQ(status_of(client.answer()), 100);
  EXPECT_EQ(status_of(client.ask("{}")), 200);
  // RFC 9110, 10.1.1: a client of HTTP/1.0 would not understand.
  client.send(
      "POST /v1/multipass HTTP/1.0\r\nContent-Type: application/json\r\n"
      "Expect: 100-continue\r\nContent-Length: 2\r\n\r\n{}");
  EXPECT_EQ(status_of(client.rest()), 200);
}

// Nothing more is sent: who waited for the end of the line would wait for the time-out.
TEST(Server, AChunkThatIsNoneIsRefusedAtOnce) {
  const Running server;
  for (const std::string chunk : {"0x\r\n", "0x", "1\n", "1\r\n{XY", "0 \r\n",
                                  "0\r\nX\r\n", "0\r\n\n", "00000000000000000"}) {
    const auto client = server.client();
    client.send(
        "POST /v1/multipass HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
        "Transfer-Encoding: chunked\r\n\r\n" +
        chunk);
    EXPECT_EQ(status_of(client.rest()), 400) << chunk;
  }
}

TEST(Server, BodiesBeyondTheirMemoryAreRefusedAndSmallOnesAreNot) {
  ServerOptions options;
  options.body_bytes = 4'000'000;
  options.body = 10min;  // the slow one is not cut, however busy the machine is
  const Running server(options);
  const std::string most(1'900'000, ' ');
  auto slow = server.client();
  slow.send(
      "POST /v1/multipass HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
      "Content-Length: 1900002\r\n\r\n" +
      most);
  auto small = server.client();
  while (metric(small, "turnwright_held_bytes") < 1'900'000) {  // until it has arrived
  }
  auto client = server.client();
  client.send(post("/v1/multipass", most + "{}", "Connection: close\r\n"));
  const auto refused = client.rest();
  EXPECT_EQ(status_of(refused), 503);
  EXPECT_NE(refused.find("Retry-After: 1\r\n"), std::string::npos);
  EXPECT_NE(refused.find("--body-memory"), std::string::npos);
  EXPECT_EQ(status_of(small.ask(post("/v1/multipass", "{}"))), 200);
  slow.send("{}");
  EXPECT_EQ(status_of(slow.answer()), 200);
  EXPECT_EQ(status_of(small.ask(post("/v1/multipass", most + "{}"))), 200);
}

// An answer is counted until it has been sent.
TEST(Server, AnswersBeyondTheMemoryAreRefused) {
  ServerOptions options;
  options.body_bytes = 200'000;  // the description has more
  const Running server(options);
  auto client = server.client();
  const auto answer = client.ask(get("/openapi.json"));
  EXPECT_EQ(status_of(answer), 503);
  EXPECT_NE(answer.find("Retry-After: 1\r\n"), std::string::npos);
  EXPECT_EQ(status_of(client.ask(get("/v1/materials"))), 200);
}

TEST(Server, AHeaderOfManyFieldsIsTooLong) {
  const Running server;
  std::string fields;
  for (int i = 0; i < 99; ++i) fields += "a:\r\n";
  auto client = server.client();
  EXPECT_EQ(status_of(client.ask(get("/healthz", fields))), 200);
  EXPECT_EQ(status_of(client.ask(get("/healthz", fields + "b:\r\n"))), 431);
}

TEST(Server, SlowCallersAreCutAndDoNotHoldOthersUp) {
  ServerOptions options;
  options.header = 200ms;
  options.body = 200ms;
  const Running server(options);
  std::vector<std::unique_ptr<RawClient>> slow;
  for (int i = 0; i < 50; ++i) {
    slow.emplace_back(new RawClient(server.client()));
    slow.back()->send(
        i % 2 ? "GET /heal"
              : "POST /v1/plan HTTP/1.1\r\nHost: x\r\nContent-Length: 9\r\n\r\n{");
  }
  auto client = server.client();
  EXPECT_EQ(status_of(client.ask(get("/healthz"))), 200);
  for (const auto& one : slow) EXPECT_EQ(status_of(one->rest()), 408);
}

TEST(Server, IdleConnectionsEndQuietly) {
  ServerOptions options;
  options.idle = 50ms;
  const Running server(options);
  EXPECT_EQ(server.client().rest(), "");
}

TEST(Server, AFullQueueSaysSo) {
  ServerOptions options;
  options.threads = 1;
  options.queue = 0;
  options.deadline = 10min;  // however busy the machine is
  const Running server(options);
  auto first = server.client(), second = server.client();
  first.send(post("/v1/plan", long_plan()));
  wait_for_metric(second, "turnwright_calls_waiting 1");
  EXPECT_EQ(status_of(second.ask(get("/readyz"))), 503);
  const auto answer = second.ask(post("/v1/multipass", "{}"));
  EXPECT_EQ(status_of(answer), 503);
  EXPECT_NE(answer.find("Retry-After: 1\r\n"), std::string::npos);
  EXPECT_EQ(status_of(second.ask(get("/healthz"))), 200);
  EXPECT_EQ(status_of(first.answer()), 200);
}

TEST(Server, ACallWithoutMemoryIsAFaultAndTheNextIsAnswered) {
  std::string large = R"({"dt_mm": [0)";
  for (int i = 0; i < 20'000; ++i) large += ",0";
  const Running server;
  auto client = server.client();
  {
    const LittleMemory little(100'000);
    const auto answer = client.ask(post("/v1/multipass", large + "]}"));
    EXPECT_EQ(status_of(answer), 500);
    EXPECT_NE(body_of(answer).find("urn:turnwright:problem:fault"), std::string::npos);
  }
  EXPECT_EQ(status_of(client.ask(post("/v1/multipass", large + "]}"))), 422);
}

TEST(Server, ADeadlineIsKept) {
  ServerOptions options;
  options.deadline = 1ms;
  const Running server(options);
  auto client = server.client();
  const auto answer = client.ask(post("/v1/plan", long_plan()));
  EXPECT_EQ(status_of(answer), 504);
  EXPECT_NE(body_of(answer).find("urn:turnwright:problem:deadline"), std::string::npos);
}

// The pool's only thread is free again long before the answer would be done.
void expect_left(const std::string& path, const std::string& body) {
  ServerOptions options;
  options.threads = 1;
  options.deadline = 10min;
  const Running server(options);
  auto other = server.client();
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(status_of(other.ask(post(path, body))), 200);
  const auto whole = std::chrono::steady_clock::now() - begin;
  {
    const auto leaving = server.client();
    leaving.send(post(path, body));
    wait_for_metric(other, "turnwright_calls_waiting 1");
  }
  const auto left = std::chrono::steady_clock::now();
  wait_for_metric(other, "turnwright_calls_waiting 0");
  EXPECT_LT(std::chrono::steady_clock::now() - left, whole / 2);
}

TEST(Server, APlanWhoseClientLeavesIsLeft) { expect_left("/v1/plan", long_plan()); }

TEST(Server, ASweepWhoseClientLeavesIsLeft) {
  expect_left("/v1/stability", R"({
    "model": "milling", "teeth": 2, "Kt_MPa": 600, "Kn_MPa": 200, "direction": "slot",
    "modes": [
      {"axis": "x", "frequency_Hz": 922, "damping_ratio": 0.011, "mass_kg": 0.03993},
      {"axis": "y", "frequency_Hz": 922, "damping_ratio": 0.011, "mass_kg": 0.03993}],
    "ap_max_mm": 0.3, "speeds_rpm": {"from": 5000, "to": 25000, "count": 6000}})");
}

// One speed alone that takes a second or more.
TEST(Server, ASpeedWhoseClientLeavesIsLeft) {
  expect_left("/v1/stability", R"({
    "model": "milling", "teeth": 3, "Kt_MPa": 700, "Kn_MPa": 250, "direction": "up",
    "radial_immersion": 0.4, "diameter_mm": 12, "helix_deg": 35,
    "pitch_deg": [110, 121, 129], "modes": [
      {"axis": "x", "frequency_Hz": 900, "damping_ratio": 0.02, "stiffness_N_mm": 9000},
      {"axis": "y", "frequency_Hz": 1100, "damping_ratio": 0.02, "stiffness_N_mm": 9000}],
    "ap_max_mm": 4, "speeds_rpm": [4500]})");
}

TEST(Server, APlanBeyondItsDeadlineIsLeft) {
  ServerOptions options;
  options.threads = 1;
  options.deadline = 20ms;
  const Running server(options);
  auto client = server.client();
  EXPECT_EQ(status_of(client.ask(post("/v1/plan", long_plan()))), 504);
  const auto begin = std::chrono::steady_clock::now();
  wait_for_metric(client, "turnwright_calls_waiting 0");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 2s);
}

TEST(Server, AnswersWhatHasArrivedBeforeItStops) {
  ServerOptions options;
  options.deadline = 10min;
  Running server(options);
  auto busy = server.client();
  const auto idle = server.client();
  busy.send(post("/v1/plan", long_plan()));
  auto other = server.client();
  wait_for_metric(other, "turnwright_calls_waiting 1");
  server.stop();
  EXPECT_EQ(status_of(busy.rest()), 200);
  EXPECT_EQ(idle.rest(), "");
  server.wait();
}

// Between two calls, or just about to be: nobody is waited for.
TEST(Server, StopsAtOnceWhenNothingIsAsked) {
  for (int i = 0; i < 20; ++i) {
    Running server;
    auto kept = server.client();
    const auto fresh = server.client();
    EXPECT_EQ(status_of(kept.ask(get("/healthz"))), 200);
    server.stop();
    EXPECT_EQ(kept.rest(), "");
    EXPECT_EQ(fresh.rest(), "");
    server.wait();
  }
}

// An answer that fills the socket is still being written when the server is told to stop.
TEST(Server, AConnectionEndsAfterTheAnswerThatWasUnderWayAtTheStop) {
  Running server;
  auto client = server.client();
  std::string calls;
  for (int i = 0; i < 100; ++i) calls += get("/openapi.json");
  client.send(calls);
  client.answer();
  server.stop();
  for (int i = 1; i < 100; ++i) EXPECT_EQ(status_of(client.answer()), 200);
  EXPECT_EQ(client.rest(), "");
  server.wait();
}

// The system has taken the connection and the call, the server has not yet looked.
TEST(Server, AnswersWhatTheSystemHasTakenForIt) {
  ServerOptions options;
  options.port = 0;
  Server server(options, served_api());
  const RawClient client(server.port());
  client.send(post("/v1/multipass", "{}") + get("/nowhere"));
  server.stop();
  server.run();
  const auto all = client.rest();
  EXPECT_EQ(status_of(all), 200);
  EXPECT_NE(all.find("HTTP/1.1 404"), std::string::npos);
}

TEST(Server, TooManyConnectionsAreTurnedAway) {
  ServerOptions options;
  options.connections = 2;
  const Running server(options);
  auto first = server.client(), second = server.client();
  EXPECT_EQ(status_of(first.ask(get("/healthz"))), 200);
  EXPECT_EQ(status_of(second.ask(get("/healthz"))), 200);
  EXPECT_EQ(status_of(server.client().rest()), 503);
  EXPECT_EQ(status_of(first.ask(get("/healthz"))), 200);
}

TEST(Server, WantsAKeyWhereThereAreKeys) {
  ServerOptions options;
  options.keys = {"one-key-of-16-characters", "another-key-of-16-characters"};
  const Running server(options);
  auto client = server.client();
  const auto status = [&](const std::string& header) {
    return status_of(client.ask(get("/v1/parts", header)));
  };
  EXPECT_EQ(status(""), 401);
  EXPECT_EQ(status("Authorization: Bearer one-key-of-16-character\r\n"), 401);
  EXPECT_EQ(status("Authorization: Basic one-key-of-16-characters\r\n"), 401);
  EXPECT_EQ(status("Authorization: Bearer another-key-of-16-characters\r\n"), 200);
  EXPECT_EQ(status("Authorization: bearer another-key-of-16-characters\r\n"), 200);
  EXPECT_EQ(status_of(client.ask(get("/healthz"))), 200);
  EXPECT_EQ(status_of(client.ask(get("/metrics"))), 401);
  // The page is no secret: it asks for the key.
  EXPECT_EQ(status_of(client.ask(get("/"))), 200);
}

// Nobody waits for the body of a call that is refused: who has no key sends it in vain.
TEST(Server, WhatIsRefusedByItsHeaderIsNotRead) {
  ServerOptions options;
  options.keys = {"one-key-of-16-characters"};
  const Running server(options);
  const std::string key = "Authorization: Bearer one-key-of-16-characters\r\n";
  const auto status = [&](const std::string& path, const std::string& header) {
    const auto client = server.client();
    client.send("POST " + path + " HTTP/1.1\r\nHost: x\r\n" + header + "\r\n");
    return status_of(client.rest());  // the body never comes
  };
  const std::string large = "Content-Length: 200000000\r\n";
  EXPECT_EQ(status("/v1/batches", large), 401);
  EXPECT_EQ(status("/v1/batches", "Transfer-Encoding: chunked\r\n"), 401);
  EXPECT_EQ(status("/v1/batches?x=1", key + large), 400);
  EXPECT_EQ(status("/v1/plans", key + "Content-Length: 1900000\r\n"), 404);
  EXPECT_EQ(status("/v1/parts", key + "Transfer-Encoding: chunked\r\n"), 405);
  EXPECT_EQ(status("/v1/parts", key + "Expect: 100-continue\r\nContent-Length: 2\r\n"),
            405);
  // Small ones are, and the connection goes on.
  auto client = server.client();
  EXPECT_EQ(status_of(client.ask(post("/v1/plans", "{}", key))), 404);
  EXPECT_EQ(status_of(client.ask(post("/v1/multipass", "{}"))), 401);
  EXPECT_EQ(status_of(client.ask(post("/v1/multipass", "{}", key))), 200);
}

TEST(Server, IsNotOpenToOthersWithoutKeys) {
  ServerOptions options;
  options.port = 0;
  options.address = "0.0.0.0";
  EXPECT_THROW(Server(options, served_api()), InputError);
  options.address = "localhost";
  EXPECT_THROW(Server(options, served_api()), InputError);
  options.address = "::1";
  EXPECT_NO_THROW(Server(options, served_api()));
}

TEST(Server, IdsTellProcessesApart) {
  const auto id = [](const std::string& answer) {
    const auto at = answer.find("X-Request-Id: ") + 14;
    return answer.substr(at, answer.find("\r\n", at) - at);
  };
  std::set<std::string> ids;
  for (int i = 0; i < 3; ++i) {
    const Running server;
    auto client = server.client();
    for (int k = 0; k < 3; ++k) ids.insert(id(client.ask(get("/healthz"))));
  }
  EXPECT_EQ(ids.size(), 9u);
}

TEST(Server, CarriesTheCallersIdBack) {
  const Running server;
  auto client = server.client();
  EXPECT_NE(client.ask(get("/healthz", "X-Request-Id: plan-7.a\r\n"))
                .find("X-Request-Id: plan-7.a\r\n"),
            std::string::npos);
  EXPECT_EQ(client.ask(get("/healthz", "X-Request-Id: a b\r\n")).find("a b"),
            std::string::npos);
}

}  // namespace
}  // namespace turnwright::service::server_test
