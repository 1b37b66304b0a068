// A server that is killed in the middle of a batch, again and again, loses nothing.
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "../service/http/client.hpp"
#include "../temporary_folder.hpp"

namespace turnwright::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using service::body_of;
using service::RawClient;
using service::status_of;

/// `turnwright serve` on a free port, killed at the end of its life.
class Serving {
 public:
  explicit Serving(const fs::path& jobs) {
    int out[2];
    if (::pipe(out) != 0) throw std::runtime_error("no pipe");
    pid_ = ::fork();
    if (pid_ == 0) {
      ::dup2(out[1], STDOUT_FILENO);
      ::freopen("/dev/null", "w", stderr);
      ::execl(TURNWRIGHT_PROGRAM, "turnwright", "--data", TURNWRIGHT_SOURCE_DIR, "serve",
              "--port", "0", "--batch-threads", "2", "--jobs", jobs.c_str(), nullptr);
      ::_exit(127);
    }
    ::close(out[1]);
    std::string line;
    for (char c = 0; ::read(out[0], &c, 1) == 1 && c != '\n';) line += c;
    ::close(out[0]);
    port_ = static_cast<std::uint16_t>(std::stoi(line.substr(line.rfind(':') + 1)));
  }
  Serving(const Serving&) = delete;
  Serving& operator=(const Serving&) = delete;
  ~Serving() {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }

  std::string ask(const std::string& call) const { return RawClient(port_).ask(call); }
  std::string get(const std::string& path) const {
    return body_of(ask("GET " + path + " HTTP/1.1\r\nHost: x\r\n\r\n"));
  }
  json job() const { return json::parse(get("/v1/batches/1")); }

 private:
  pid_t pid_ = -1;
  std::uint16_t port_ = 0;
};

std::string submission(const std::string& lines) {
  return "POST /v1/batches HTTP/1.1\r\nHost: x\r\nContent-Type: application/jsonl\r\n"
         "Content-Length: " +
         std::to_string(lines.size()) + "\r\n\r\n" + lines;
}

/// Pins to plan and multi-pass problems, hardly two alike; between them lines that are
/// wrong.
std::string batch(int count) {
  json part = json::parse(R"({
    "format": "turnwright-part/1", "name": "Pin", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 35, "length_mm": 84, "left_allowance_mm": 2},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 30, "diameter_mm": 32},
              {"id": "d2", "kind": "cylinder", "length_mm": 50, "diameter_mm": 25}],
    "machine": "lathe-small", "tools": ["PCLNL-CNMG120408-PM"],
    "setups": [{"hold": "left", "grip_mm": 20, "clampings": ["chuck"]},
               {"hold": "right", "grip_mm": 40, "clampings": ["chuck"]}]})");
  std::string lines;
  for (int i = 0; i < count; ++i) {
    part["outer"][1]["diameter_mm"] = 20 + 0.01 * (i % 20 == 0 ? 0 : i);
    const json line =
        i % 5 == 0 ? json{{"name", "plan"}, {"document", part}}
                   : json{{"name", "multipass"}, {"document", {{"dt_mm", 4 + 0.02 * i}}}};
    lines += i % 13 == 12 ? "no json\n" : line.dump() + '\n';
  }
  return lines;
}

json wait_until_done(const Serving& server, std::int64_t lines) {
  using namespace std::chrono_literals;
  for (json job = server.job();; std::this_thread::sleep_for(10ms), job = server.job())
    if (job.at("done") >= lines) return job;
}

std::string results(const Serving& server, int count) {
  std::string all;
  for (int next = 1; next <= count;) {
    const auto page = server.get("/v1/batches/1/results?from=" + std::to_string(next));
    if (page.empty()) break;
    all += page;
    const auto last = page.rfind("{\"line\":");
    next = std::stoi(page.substr(last + 8)) + 1;
  }
  return all;
}

using KilledServer = TemporaryFolder;

TEST_F(KilledServer, GoesOnWithItsBatchAndGivesEveryLineOnceAndTheSame) {
  constexpr int kLines = 180;
  const auto lines = batch(kLines);
  std::string undisturbed;
  {
    const Serving server(folder_ / "undisturbed.sqlite");
    ASSERT_EQ(status_of(server.ask(submission(lines))), 202);
    const auto job = wait_until_done(server, kLines);
    EXPECT_EQ(job.at("state"), "done");
    EXPECT_EQ(job.at("errors"), kLines / 13);
    undisturbed = results(server, kLines);
  }
  EXPECT_EQ(std::count(undisturbed.begin(), undisturbed.end(), '\n'), kLines);

  const auto jobs = folder_ / "killed.sqlite";
  {
    const Serving server(jobs);
    ASSERT_EQ(status_of(server.ask(submission(lines))), 202);
  }  // killed as soon as it has promised
  std::mt19937 random(22);
  std::int64_t done = 0;
  for (int kill = 0; kill < 5; ++kill) {
    const Serving server(jobs);
    const auto before = server.job();
    EXPECT_GE(before.at("done"), done) << "lost with the process";
    EXPECT_EQ(before.at("lines"), kLines);
    const auto more = std::uniform_int_distribution<std::int64_t>(0, kLines / 6)(random);
    done = wait_until_done(server, std::min<std::int64_t>(done + more, kLines))
               .at("done")
               .get<std::int64_t>();
  }
  const Serving server(jobs);
  const auto job = wait_until_done(server, kLines);
  EXPECT_EQ(job.at("state"), "done");
  EXPECT_EQ(job.at("errors"), kLines / 13);
  EXPECT_TRUE(results(server, kLines) == undisturbed);
}

}  // namespace
}  // namespace turnwright::app
