#include "service/http/api.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "document/json/parse.hpp"
#include "service/http/page.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/document/translations.hpp"

namespace turnwright::service::api_test {
namespace {

using nlohmann::json;

const document::Catalogue& catalogue() {
  static const auto kAll = document::load_catalogue(TURNWRIGHT_SOURCE_DIR);
  return kAll;
}

const HttpApi& api() {
  static const HttpApi kApi(TURNWRIGHT_SOURCE_DIR, catalogue(), nullptr);
  return kApi;
}

Call call(const std::string& method, const std::string& target, std::string body = "") {
  return {method, target, "application/json", "", "", "id-1", std::move(body)};
}

Reply reply(const Call& call) { return api().reply(call, {}); }

json problem_of(const Reply& reply) {
  EXPECT_EQ(reply.content_type, "application/problem+json");
  const auto document = json::parse(reply.body);
  EXPECT_EQ(document.at("status"), reply.status);
  EXPECT_EQ(document.at("instance"), "urn:turnwright:call:id-1");
  return document;
}

TEST(HttpApi, EveryRowAnswersItsExampleAsTheCommandLineDoes) {
  for (const auto& row : requests()) {
    const auto given = reply(call("POST", "/v1/" + row.name, row.example));
    EXPECT_EQ(given.status, 200) << row.name << given.body;
    const auto result = answer(row, json::parse(row.example), {catalogue()});
    EXPECT_EQ(given.body, result.dump(2) + '\n') << row.name;
  }
}

TEST(HttpApi, EveryDocumentOfTheCatalogueIsThere) {
  for (const char* what : {"materials", "tools", "machines", "shops", "parts"}) {
    const auto list = json::parse(reply(call("GET", std::string("/v1/") + what)).body);
    ASSERT_FALSE(list.empty()) << what;
    for (const auto& entry : list) {
      const auto one = reply(call(
          "GET", std::string("/v1/") + what + '/' + entry.at("id").get<std::string>()));
      ASSERT_EQ(one.status, 200);
      EXPECT_EQ(json::parse(one.body).at("name"), entry.at("name"));
    }
  }
}

TEST(HttpApi, ToolsOfEveryKindAreListed) {
  for (const auto* id : {"PCLNL-CNMG120408-PM", "PART-3", "KEYWAY-HM-8"})
    EXPECT_EQ(reply(call("GET", std::string("/v1/tools/") + id)).status, 200) << id;
}

TEST(HttpApi, NoPathLeadsToTheFileSystem) {
  for (const char* target :
       {"/v1/parts/../machines/lathe-small", "/v1/parts/..%2f..%2fREADME.md",
        "/v1/parts//etc/passwd", "/v1/parts/pump-shaft.json", "/../README.md", "//",
        "/v1/parts/pump-shaft/"}) {
    const auto given = reply(call("GET", target));
    EXPECT_EQ(given.status, 404) << target;
    problem_of(given);
  }
  for (const char* target : {"xhealthz", "*", "http://127.0.0.1/healthz", ""}) {
    const auto given = problem_of(reply(call("GET", target)));
    EXPECT_EQ(given.at("status"), 400) << target;
    EXPECT_EQ(given.at("detail"), "got '" + std::string(target) + "', expected a path");
  }
}

TEST(HttpApi, TellsWhatIsWrongWithABody) {
  const auto broken = problem_of(reply(call("POST", "/v1/deflection", "{\"a\": [1,")));
  EXPECT_EQ(broken.at("status"), 400);
  EXPECT_EQ(broken.at("errors").at(0).at("code"), "syntax");

  const auto wrong = problem_of(
      reply(call("POST", "/v1/multipass", R"({"dt_mm": -1, "costs": "literal"})")));
  EXPECT_EQ(wrong.at("status"), 422);
  std::set<std::string> pointers;
  for (const auto& error : wrong.at("errors")) pointers.insert(error.at("pointer"));
  EXPECT_EQ(pointers, (std::set<std::string>{"/costs", "/dt_mm"}));

  auto typed = call("POST", "/v1/multipass", "{}");
  typed.content_type = "text/plain";
  EXPECT_EQ(problem_of(reply(typed)).at("status"), 415);
  typed.content_type = "application/json; charset=latin1";
  EXPECT_EQ(problem_of(reply(typed)).at("detail"),
            "got Content-Type 'application/json; charset=latin1', expected "
            "application/json (UTF-8)");
  typed.content_type = "Application/JSON; charset=utf-8";
  EXPECT_EQ(reply(typed).status, 200);
}

TEST(HttpApi, DocumentsAreUtf8) {
  for (const char* yes :
       {"application/json", " application/JSON ", "application/json;charset=UTF-8",
        "application/json; Charset=\"utf-8\"",
        "application/json; profile=x; charset=utf-8", "application/json;"})
    EXPECT_TRUE(is_type(yes, "application/json")) << yes;
  for (const char* no : {"", "application/jsonl", "application/json charset=utf-8",
                         "application/json; charset=utf-16",
                         "application/json; charset=", "application/json; charset",
                         "application/json; charset=\"latin1\"",
                         "application/json; charset=utf-8; charset=latin1",
                         "application/json;a=1; CHARSET = iso-8859-1"})
    EXPECT_FALSE(is_type(no, "application/json")) << no;
}

TEST(HttpApi, AQueryIsWhatThePathTakesOrRefused) {
  const auto wrong =
      problem_of(reply(call("GET", "/v1/batches/1/results?form=2&from=1&from=2&=&from")));
  EXPECT_EQ(wrong.at("status"), 400);
  EXPECT_EQ(wrong.at("type"), "urn:turnwright:problem:query");
  EXPECT_EQ(wrong.at("detail"), "wrong in the query: form, from, , from");
  EXPECT_EQ(wrong.at("errors"), json::parse(R"([
    {"pointer": "form", "got": "\"2\"", "expected": "no such parameter",
     "code": "unknown-key"},
    {"pointer": "from", "got": "\"2\"", "expected": "the parameter once",
     "code": "duplicate"},
    {"pointer": "", "got": "\"\"", "expected": "no such parameter",
     "code": "unknown-key"},
    {"pointer": "from", "got": "\"\"", "expected": "the parameter once",
     "code": "duplicate"}])"));
  for (const char* value :
       {"", "0", "-1", "1.5", "x", "1x", "%31", "99999999999999999999", "+1"}) {
    const auto range = problem_of(
        reply(call("GET", std::string("/v1/batches/1/results?from=") + value)));
    EXPECT_EQ(range.at("status"), 400) << value;
    EXPECT_EQ(range.at("errors")[0].at("expected"), "an integer >= 1") << value;
  }
  // This server takes no batches: the query was right.
  EXPECT_EQ(reply(call("GET", "/v1/batches/1/results?from=2")).status, 404);
  for (const char* target :
       {"/", "/healthz", "/v1/parts", "/v1/parts/pump-shaft", "/openapi.json", "/readyz",
        "/metrics", "/v1/batches", "/v1/batches/1"}) {
    EXPECT_EQ(reply(call("GET", target + std::string("?from=1"))).status, 400) << target;
    EXPECT_EQ(reply(call("GET", target + std::string("?"))).status,
              reply(call("GET", target)).status)
        << target;
  }
  EXPECT_EQ(reply(call("POST", "/v1/multipass?fast=1", "{}")).status, 400);
  EXPECT_EQ(reply(call("OPTIONS", "/v1/multipass?fast=1")).status, 204);
}

TEST(HttpApi, ThePageIsAtTheRoot) {
  const auto page = reply(call("GET", "/"));
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.content_type, "text/html; charset=utf-8");
  EXPECT_EQ(page.body, built_in_page());
  EXPECT_EQ(page.headers.at(0).first, "Content-Security-Policy");
  const HttpApi other(TURNWRIGHT_SOURCE_DIR, catalogue(), nullptr,
                      [] { return std::string("<p>other</p>"); });
  EXPECT_EQ(other.reply(call("GET", "/"), {}).body, "<p>other</p>");
}

TEST(HttpApi, ThePageSpeaksTheLanguageOfTheProgramOrOfItsAddress) {
  const auto begin = [](const char* target) {
    return reply(call("GET", target)).body.substr(0, 40);
  };
  EXPECT_NE(begin("/").find("<html lang=\"en\">"), std::string::npos);
  speak("de", {});
  EXPECT_NE(begin("/").find("<html lang=\"de\">"), std::string::npos);
  speak("en", {});
  const auto known = document::languages(TURNWRIGHT_SOURCE_DIR);
  EXPECT_TRUE(std::ranges::is_permutation(known, kPageLanguages));
  for (const auto& language : kPageLanguages)  // which the page itself reads
    EXPECT_EQ(reply(call("GET", "/?language=" + language)).body, built_in_page());
  const auto wrong = problem_of(reply(call("GET", "/?language=xx&language=de")));
  EXPECT_EQ(wrong.at("errors"), json::parse(R"([
    {"pointer": "language", "got": "\"xx\"", "expected": "en, de", "code": "choice"},
    {"pointer": "language", "got": "\"de\"", "expected": "the parameter once",
     "code": "duplicate"}])"));
}

TEST(HttpApi, GivesAPlanAsAReport) {
  for (const auto& row : requests()) {
    const auto path = "/v1/" + row.name + "/report";
    if (!row.html) {
      EXPECT_EQ(reply(call("POST", path, row.example)).status, 404) << row.name;
      continue;
    }
    const auto report = reply(call("POST", path, row.example));
    ASSERT_EQ(report.status, 200) << report.body;
    EXPECT_EQ(report.content_type, "text/html; charset=utf-8");
    const auto result = answer(row, json::parse(row.example), {catalogue()});
    EXPECT_NE(report.body.find(result.at("request_digest").get<std::string>()),
              std::string::npos);
    EXPECT_EQ(report.headers.at(0).first, "Content-Security-Policy");
    EXPECT_EQ(problem_of(reply(call("POST", path, "{}"))).at("status"), 422);
    EXPECT_EQ(problem_of(reply(call("POST", path, "{"))).at("status"), 400);
  }
}

TEST(HttpApi, AnInfeasiblePlanIsAnAnswer) {
  std::ifstream file(TURNWRIGHT_SOURCE_DIR "/parts/infeasible-as-drawn.json");
  const std::string part{std::istreambuf_iterator<char>(file), {}};
  const auto given = reply(call("POST", "/v1/plan", part));
  EXPECT_EQ(given.status, 200);
  EXPECT_EQ(json::parse(given.body).at("status"), "infeasible");
}

TEST(HttpApi, TellsTheMethodsOfAPath) {
  const auto wrong = reply(call("PUT", "/v1/plan"));
  EXPECT_EQ(problem_of(wrong).at("status"), 405);
  using Headers = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(wrong.headers, (Headers{{"Allow", "POST, OPTIONS"}}));
  const auto options = reply(call("OPTIONS", "/v1/parts"));
  EXPECT_EQ(options.status, 204);
  EXPECT_EQ(options.headers, (Headers{{"Allow", "GET, HEAD, OPTIONS"}}));
  EXPECT_EQ(reply(call("HEAD", "/v1/parts")).body, reply(call("GET", "/v1/parts")).body);
  for (const char* own : {"/readyz", "/metrics"})
    EXPECT_EQ(reply(call("OPTIONS", own)).headers,
              (Headers{{"Allow", "GET, HEAD, OPTIONS"}}));
  // What any path of the description takes is what all paths take.
  std::set<std::string> methods{"HEAD", "OPTIONS"};
  const auto description = json::parse(reply(call("GET", "/openapi.json")).body);
  for (const auto& path : description.at("paths"))
    for (const auto& [method, operation] : path.items()) {
      std::string name;
      for (const char c : method) name += static_cast<char>(std::toupper(c));
      methods.insert(name);
    }
  const auto all = reply(call("OPTIONS", "*"));
  EXPECT_EQ(all.status, 204);
  EXPECT_EQ(all.headers, (Headers{{"Allow", "GET, HEAD, POST, DELETE, OPTIONS"}}));
  EXPECT_EQ(methods, (std::set<std::string>{"DELETE", "GET", "HEAD", "OPTIONS", "POST"}));
  for (const char* unknown : {"BREW", "TRACE", "get", "PROPFIND"})
    EXPECT_EQ(problem_of(reply(call(unknown, "/v1/parts"))).at("status"), 501) << unknown;
}

TEST(HttpApi, RoutesHaveFewNames) {
  EXPECT_EQ(api().route(call("GET", "/v1/parts/pump-shaft?x=1")), "/v1/parts/{id}");
  EXPECT_EQ(api().route(call("GET", "/v1/batches/7/results")),
            "/v1/batches/{id}/results");
  EXPECT_EQ(api().route(call("GET", "/some/where")), "other");
}

TEST(HttpApi, CompressesForThoseWhoAsk) {
  const auto compressed = [](const std::string& codings) {
    Reply long_reply{200, "text/plain", std::string(5000, 'a'), {}};
    auto asked = call("GET", "/");
    asked.accept_encoding = codings;
    compress_for(asked, long_reply);
    return long_reply.body.size() < 100;
  };
  for (const char* yes : {"gzip", "br, gzip", "gzip;q=0.5", "identity;q=0.1,gzip"})
    EXPECT_TRUE(compressed(yes)) << yes;
  for (const char* no : {"", "br", "gzip;q=0", "gzip;q=0.000", "xgzip"})
    EXPECT_FALSE(compressed(no)) << no;
}

// Members of the document one by one: left out, of a wrong type, far out of range.
std::vector<json> spoiled(const json& good) {
  std::vector<json> all;
  const json flat = good.flatten();
  for (const auto& [pointer, value] : flat.items())
    for (const json& slip : {json(nullptr), json(-1e300), json("?"), json::array({1})}) {
      json bad = good;
      bad[json::json_pointer(pointer)] = slip;
      all.push_back(std::move(bad));
    }
  return all;
}

TEST(HttpApi, SpoiledRequestsAreNeverAFaultOfTheServer) {
  for (const auto& row : requests()) {
    int refused = 0;
    const auto all = spoiled(json::parse(row.example));
    const auto step = std::max<std::size_t>(1, all.size() / 200);
    for (std::size_t i = 0; i < all.size(); i += step) {
      const auto given = reply(call("POST", "/v1/" + row.name, all[i].dump()));
      ASSERT_TRUE(given.status == 200 || given.status == 422) << all[i] << given.body;
      if (given.status == 422) {
        ++refused;
        for (const auto& error : problem_of(given).value("errors", json::array()))
          EXPECT_NO_THROW(json::json_pointer(error.at("pointer"))) << error;
      }
    }
    EXPECT_GT(refused, 10) << row.name;
  }
}

TEST(HttpApi, TheDescriptionThatIsKeptIsTheOneServed) {
  std::ifstream file(TURNWRIGHT_SOURCE_DIR "/docs/openapi.json");
  const std::string kept{std::istreambuf_iterator<char>(file), {}};
  EXPECT_TRUE(kept == reply(call("GET", "/openapi.json")).body)
      << "docs/openapi.json is old: curl http://127.0.0.1:8080/openapi.json";
}

TEST(HttpApi, TheDescriptionHasEveryStatusOfEveryCall) {
  const auto document = json::parse(reply(call("GET", "/openapi.json")).body);
  for (const auto& [path, methods] : document.at("paths").items())
    for (const auto& [method, operation] : methods.items())
      for (const char* status : {"400", "401", "403", "405", "408", "413", "414", "415",
                                 "421", "431", "500", "501", "503"})
        EXPECT_TRUE(operation.at("responses").contains(status)) << path << ' ' << status;
}

// Draft 7's words for tuples and for members that need others mean nothing in 2020-12.
void expect_2020_12(const json& schema, const std::string& where) {
  if (schema.is_array())
    for (const auto& one : schema) expect_2020_12(one, where);
  if (!schema.is_object()) return;
  for (const char* word : {"additionalItems", "dependencies", "definitions", "$schema"})
    EXPECT_FALSE(schema.contains(word)) << where << ": " << word;
  EXPECT_FALSE(schema.contains("items") && schema["items"].is_array()) << where;
  for (const auto& [key, value] : schema.items()) {
    if (key == "properties" || key == "dependentSchemas" || key == "patternProperties")
      for (const auto& [name, member] : value.items())
        expect_2020_12(member, where + '/' + name);
    else if (key != "examples" && key != "enum" && key != "const" && key != "default")
      expect_2020_12(value, where + '/' + key);
  }
}

TEST(HttpApi, SchemasAreTheDescriptionsDialect) {
  const auto document = json::parse(reply(call("GET", "/openapi.json")).body);
  const auto& schemas = document.at("components").at("schemas");
  for (const auto& [name, schema] : schemas.items()) expect_2020_12(schema, name);
  EXPECT_NE(schemas.dump().find("\"prefixItems\""), std::string::npos);
}

// Adds what the references inside name.
void add_references(const json& inside, std::set<std::string>& all) {
  if (!inside.is_structured()) return;
  if (inside.contains("$ref") && inside["$ref"].is_string()) all.insert(inside["$ref"]);
  for (const auto& member : inside) add_references(member, all);
}

// Generators of clients know no others.
TEST(HttpApi, EveryReferenceOfTheDescriptionLeadsToAComponent) {
  const auto document = json::parse(reply(call("GET", "/openapi.json")).body);
  std::set<std::string> references, components;
  add_references(document, references);
  for (const auto& [name, schema] : document.at("components").at("schemas").items())
    components.insert("#/components/schemas/" + name);
  EXPECT_GT(references.size(), 100u);
  for (const auto& to : references) EXPECT_TRUE(components.contains(to)) << to;
}

TEST(HttpApi, AReferenceMeansWhatItMeansInTheFiles) {
  const auto document = json::parse(reply(call("GET", "/openapi.json")).body);
  const auto& schemas = document.at("components").at("schemas");
  EXPECT_EQ(schemas.at("listen.request").at("properties").at("stability").at("$ref"),
            "#/components/schemas/stability.request");
  const json& Kn = schemas.at("overhang.request.milling").at("properties").at("Kn_MPa");
  EXPECT_EQ(Kn.at("type"), "number");
  EXPECT_EQ(Kn, schemas.at("stability.request.milling").at("properties").at("Kn_MPa"));
}

}  // namespace
}  // namespace turnwright::service::api_test
