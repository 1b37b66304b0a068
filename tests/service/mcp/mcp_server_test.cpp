#include "service/mcp/mcp_server.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace turnwright::service::mcp::mcp_server_test {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

const document::Catalogue& catalogue() {
  static const auto kAll = document::load_catalogue(TURNWRIGHT_SOURCE_DIR);
  return kAll;
}

/// What a server sends for these lines, when all calls have their answers.
std::vector<ordered_json> sent(const std::vector<std::string>& lines,
                               Limits limits = {}) {
  std::vector<ordered_json> all;
  {
    Server server(
        TURNWRIGHT_SOURCE_DIR, catalogue(), [&all](const auto& m) { all.push_back(m); },
        limits);
    for (const auto& line : lines) server.receive(line);
  }
  return all;
}

std::string request(const json& id, const std::string& method,
                    const json& parameters = json::object()) {
  return json{{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", parameters}}
      .dump();
}

std::string call(int id, const std::string& tool, const json& arguments) {
  return request(id, "tools/call", {{"name", tool}, {"arguments", arguments}});
}

const Request& row(const std::string& name) {
  for (const auto& one : requests())
    if (one.name == name) return one;
  throw std::domain_error("no row " + name);
}

/// Draws that take some seconds.
json long_work() {
  auto work = json::parse(row("acceptance").example);
  json budget{{"draws", 10'000'000}};
  for (int i = 0; i < 90; ++i)
    budget["sources"].push_back(
        {{"name", "a"}, {"distribution", "normal"}, {"value_um", 1}});
  work["cases"].erase(1);
  work["cases"][0]["budget"] = budget;
  return work;
}

int code(const std::vector<ordered_json>& messages) {
  return messages.at(0).at("error").at("code");
}

TEST(Mcp, AToolGivesTheResultOfItsRow) {
  const auto document = json::parse(row("deflection").example);
  const auto answers = sent({call(7, "deflection", document)});
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0]["id"], 7);
  EXPECT_EQ(answers[0]["result"]["structuredContent"],
            answer(row("deflection"), document, {catalogue()}));
}

TEST(Mcp, ARevisionThatIsKnownIsKeptAndAnotherOneIsAnsweredByOurs) {
  for (const auto& [asked, got] : {std::pair{"2025-11-25", "2025-11-25"},
                                   {"2025-06-18", "2025-06-18"},
                                   {"1999-01-01", "2025-06-18"}})
    EXPECT_EQ(
        sent({request("a", "initialize",
                      {{"protocolVersion", asked}})})[0]["result"]["protocolVersion"],
        got);
}

TEST(Mcp, WhatIsNoRequestIsAnErrorWithItsCode) {
  EXPECT_EQ(code(sent({"{\"jsonrpc\": "})), -32700);
  EXPECT_EQ(code(sent({"[]"})), -32600);
  EXPECT_EQ(code(sent({R"({"id": 1, "method": "ping"})"})), -32600);
  EXPECT_EQ(code(sent({R"({"jsonrpc": "2.0", "id": null, "method": "ping"})"})), -32600);
  EXPECT_EQ(code(sent({R"({"jsonrpc": "2.0", "id": 1, "method": "ping", "params": 3})"})),
            -32600);
  EXPECT_EQ(code(sent({request(1, "tools/drop")})), -32601);
  EXPECT_EQ(code(sent({call(1, "no tool", json::object())})), -32602);
  EXPECT_EQ(code(sent({request(1, "resources/read")})), -32602);
  EXPECT_EQ(code(sent({request(1, "resources/read", {{"uri", "turnwright://parts/x"}})})),
            -32002);
}

TEST(Mcp, NotificationsAndAnswersGetNoAnswer) {
  EXPECT_TRUE(sent({R"({"jsonrpc": "2.0", "method": "notifications/initialized"})",
                    R"({"jsonrpc": "2.0", "method": "notifications/unknown"})",
                    R"({"jsonrpc": "2.0", "id": 4, "result": {}})"})
                  .empty());
}

TEST(Mcp, AWrongDocumentIsAFailureOfTheToolThatNamesThePlace) {
  const auto answers = sent({call(1, "plan", {{"batch", -1}})});
  EXPECT_EQ(answers.at(0)["result"]["isError"], true);
  EXPECT_NE(answers[0]["result"]["content"][0]["text"].get<std::string>().find("/batch"),
            std::string::npos);
}

TEST(Mcp, ACallPastItsDeadlineFailsAndTheNextOneIsAnswered) {
  const auto answers =
      sent({call(1, "acceptance", long_work()),
            call(2, "deflection", json::parse(row("deflection").example))},
           {.deadline = std::chrono::milliseconds(100)});
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(answers[0]["result"]["content"][0]["text"], "not done within 100 ms");
  EXPECT_EQ(answers[1]["result"]["isError"], false);
}

TEST(Mcp, ACancelledCallGetsNoAnswer) {
  const auto answers = sent(
      {call(1, "acceptance", long_work()),
       R"({"jsonrpc": "2.0", "method": "notifications/cancelled", "params": {"requestId": 1}})",
       request(2, "ping")});
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0]["id"], 2);
}

TEST(Mcp, CallsBeyondThoseThatMayWaitAreRefused) {
  std::vector<std::string> lines(4, call(1, "acceptance", long_work()));
  const auto answers = sent(lines, {std::chrono::milliseconds(50), 1});
  EXPECT_EQ(
      std::ranges::count_if(answers, [](const auto& m) { return m.contains("error"); }),
      2);
  EXPECT_EQ(answers.size(), 4U);
}

}  // namespace
}  // namespace turnwright::service::mcp::mcp_server_test
