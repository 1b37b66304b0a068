#include "openapi.hpp"

#include <string_view>
#include <utility>
#include <vector>

#include "document/json/file.hpp"
#include "page.hpp"
#include "service/requests.hpp"

namespace turnwright::service {
namespace {

using nlohmann::ordered_json;

const std::string kSchemas = "#/components/schemas/";

ordered_json reference(const std::string& schema) {
  return {{"$ref", kSchemas + schema}};
}

/// Component names may not hold every character a file name may.
std::string component(std::string file) {
  file.resize(file.rfind(".json"));
  return file;
}

// OpenAPI keeps schemas side by side in one document: "#/definitions/x" of a file becomes
// a component of its own, file.x.  `to` stands in the schema `name`, or names another file.
std::string moved(const std::string& to, const std::string& name) {
  static constexpr std::string_view kDefinitions = "/definitions/";
  const auto mark = to.find('#');
  const auto file = to.substr(0, mark);
  std::string place = mark == std::string::npos ? "" : to.substr(mark + 1);
  if (place.starts_with(kDefinitions)) place.replace(0, kDefinitions.size(), ".");
  return kSchemas + (file.empty() ? name : component(file)) + place;
}

void move_references(ordered_json& schema, const std::string& name) {
  if (schema.is_object() && schema.contains("$ref") && schema["$ref"].is_string())
    schema["$ref"] = moved(schema["$ref"], name);
  if (schema.is_structured())  // a range over a number is the number itself
    for (auto& member : schema) move_references(member, name);
}

// A member's value, taken out; members move when one is added.
ordered_json taken(ordered_json& object, const char* key) {
  auto value = std::move(object.at(key));
  object.erase(key);
  return value;
}

// OpenAPI 3.1 reads schemas as of 2020-12, which says in other words than draft 7 what a
// tuple holds and which members ask for others.
void to_2020_12(ordered_json& schema) {
  if (schema.is_array())
    for (auto& one : schema) to_2020_12(one);
  if (!schema.is_object()) return;
  if (schema.contains("items") && schema["items"].is_array()) {
    schema["prefixItems"] = taken(schema, "items");
    if (schema.contains("additionalItems"))
      schema["items"] = taken(schema, "additionalItems");
  }
  if (schema.contains("dependencies")) {
    const auto all = taken(schema, "dependencies");
    for (const auto& [key, value] : all.items())
      schema[value.is_array() ? "dependentRequired" : "dependentSchemas"][key] = value;
  }
  for (auto& [key, value] : schema.items()) {
    if (key == "properties" || key == "patternProperties" || key == "definitions" ||
        key == "dependentSchemas")
      for (auto& member : value) to_2020_12(member);
    else if (key != "const" && key != "enum" && key != "default" && key != "examples" &&
             key != "dependentRequired")
      to_2020_12(value);
  }
}

void add_schema(ordered_json& schemas, const std::filesystem::path& folder,
                const std::string& file) {
  const std::string name = component(file);
  if (schemas.contains(name)) return;
  ordered_json schema = document::parse_file(folder / "schemas" / file);
  move_references(schema, name);
  to_2020_12(schema);
  if (const auto definitions = schema.find("definitions"); definitions != schema.end())
    for (auto& [key, value] : definitions->items()) schemas[name + '.' + key] = value;
  schema.erase("definitions");
  schema.erase("$schema");
  schemas[name] = std::move(schema);
}

// Generators of clients know references to components, not to a member within one: that
// member is copied to where it is referred to.
void copy_members(ordered_json& schema, const ordered_json& schemas) {
  if (schema.is_object() && schema.contains("$ref") && schema["$ref"].is_string()) {
    const std::string place =
        schema["$ref"].get<std::string>().substr(kSchemas.size() - 1);
    if (place.find('/', 1) == std::string::npos) return;
    schema = schemas.at(ordered_json::json_pointer(place));
  }
  if (schema.is_structured())
    for (auto& member : schema) copy_members(member, schemas);
}

ordered_json json_content(ordered_json schema) {
  return {{"application/json", {{"schema", std::move(schema)}}}};
}

ordered_json problem(const std::string& when) {
  return {
      {"description", when},
      {"content", {{"application/problem+json", {{"schema", reference("problem")}}}}}};
}

/// What every call may be answered with.
ordered_json common_problems() {
  return {
      {"400", problem("no HTTP, or a query that this path does not take")},
      {"401", problem("no key, or a wrong one")},
      {"403", problem("no keys are set, and a page from elsewhere asks (Origin)")},
      {"405", problem("a method this path does not take")},
      {"408", problem("the request did not arrive in time")},
      {"413", problem("a body larger than this path takes")},
      {"414", problem("the request line is too long")},
      {"415", problem("a body with a Content-Encoding")},
      {"421", problem("no keys are set, and the Host is a dotted name, no address")},
      {"431", problem("the header is too long")},
      {"500", problem("a fault of this program")},
      {"501", problem("a method or a transfer coding that this server does not know")},
      {"503", problem("too many calls at once: Retry-After tells when to try again")}};
}

ordered_json responses(ordered_json own) {
  const auto common = common_problems();
  for (const auto& [status, response] : common.items())
    if (!own.contains(status)) own[status] = response;
  return own;
}

ordered_json path_parameter(const std::string& name, ordered_json schema) {
  return {{"name", name}, {"in", "path"}, {"required", true}, {"schema", schema}};
}

/// What a row answers with, as its result or its report.
ordered_json request_path(const Request& row, const std::string& id,
                          const std::string& summary, ordered_json content) {
  return {
      {"post",
       {{"operationId", id},
        {"summary", summary},
        {"requestBody",
         {{"required", true},
          {"content",
           {{"application/json",
             {{"schema", reference(component(request_schema(row)))},
              {"example", ordered_json::parse(row.example)}}}}}}},
        {"responses",
         responses(
             {{"200",
               {{"description", "the result, infeasible ones too"},
                {"content", std::move(content)}}},
              {"400", problem("the body is no JSON, or no HTTP, or there is a query")},
              {"413", problem("the body is larger than 2 MB")},
              {"415", problem("the body is not application/json in UTF-8, or encoded")},
              {"422", problem("wrong input, or outside a model's range")},
              {"504", problem("not done before the deadline")}})}}}};
}

ordered_json get(const std::string& id, const std::string& summary, ordered_json content,
                 ordered_json parameters, ordered_json more = ordered_json::object()) {
  more["200"] = {{"description", summary}, {"content", std::move(content)}};
  ordered_json operation{{"operationId", id}, {"summary", summary}};
  if (!parameters.empty()) operation["parameters"] = std::move(parameters);
  operation["responses"] = responses(std::move(more));
  return {{"get", std::move(operation)}};
}

void add_listing(ordered_json& paths, const std::string& what,
                 const std::vector<std::string>& schemas) {
  const auto none = ordered_json::array();
  auto any = ordered_json::array();
  for (const auto& schema : schemas) any.push_back(reference(schema));
  const auto document = any.size() == 1 ? any[0] : ordered_json{{"anyOf", any}};
  paths["/v1/" + what] =
      get("list-" + what, "ids and names", json_content(reference("entries")), none);
  paths["/v1/" + what + "/{id}"] =
      get("get-" + what, "the document", json_content(document),
          {path_parameter("id", {{"type", "string"}})},
          {{"404", problem("no document of this id")}});
}

ordered_json job_response(const std::string& description) {
  return {{"description", description}, {"content", json_content(reference("job"))}};
}

void add_batches(ordered_json& paths) {
  const auto id = path_parameter("id", {{"type", "integer"}, {"minimum", 1}});
  const ordered_json missing{{"404", problem("no such job")}};
  const ordered_json lines{{"schema", {{"type", "string"}}}};
  paths["/v1/batches"] = get("list-batches", "all jobs", json_content(reference("jobs")),
                             ordered_json::array());
  paths["/v1/batches"]["post"] = {
      {"operationId", "submit-batch"},
      {"summary", "one request per line, {\"name\": .., \"document\": ..} -> a job"},
      {"requestBody", {{"required", true}, {"content", {{"application/jsonl", lines}}}}},
      {"responses",
       responses({{"202", job_response("taken; it survives a restart")},
                  {"413",
                   problem("the body is larger than 256 MB or has over a million lines")},
                  {"415",
                   problem("the body is not application/jsonl in UTF-8, or encoded")}})}};
  paths["/v1/batches/{id}"] = get("get-batch", "state and progress",
                                  json_content(reference("job")), {id}, missing);
  paths["/v1/batches/{id}"]["delete"] = {
      {"operationId", "remove-batch"},
      {"summary", "stops the job and forgets it and its results"},
      {"parameters", {id}},
      {"responses", responses({{"204", {{"description", "removed"}}},
                               {"404", problem("no such job")}})}};
  paths["/v1/batches/{id}/cancel"]["post"] = {
      {"operationId", "cancel-batch"},
      {"summary",
       "ends the batch: lines that have no result yet are not computed, results are "
       "kept"},
      {"parameters", {id}},
      {"responses",
       responses({{"200", job_response("the job")}, {"404", problem("no such job")}})}};
  paths["/v1/batches/{id}/results"] =
      get("get-batch-results",
          "records in the order of lines, up to the first one that is not there yet; the "
          "header Link names the next page",
          {{"application/jsonl", lines}},
          {id,
           {{"name", "from"},
            {"in", "query"},
            {"description", "number of the first line wanted; given once or not at all"},
            {"schema", {{"type", "integer"}, {"minimum", 1}, {"default", 1}}}}},
          missing);
}

ordered_json object(ordered_json properties) {
  auto required = ordered_json::array();
  for (const auto& [key, value] : properties.items()) required.push_back(key);
  return {{"type", "object"}, {"properties", properties}, {"required", required}};
}

void add_own_schemas(ordered_json& schemas) {
  const ordered_json text{{"type", "string"}};
  const ordered_json count{{"type", "integer"}, {"minimum", 0}};
  const auto list = [](ordered_json of) {
    return ordered_json{{"type", "array"}, {"items", std::move(of)}};
  };
  schemas["entries"] = list(object({{"id", text}, {"name", text}}));
  schemas["job"] =
      object({{"id", count},
              {"state", {{"enum", {"running", "cancelled", "done", "outdated"}}}},
              {"lines", count},
              {"done", count},
              {"errors", count}});
  schemas["jobs"] = list(reference("job"));
  schemas["problem"] = object({{"type", text},
                               {"title", text},
                               {"status", count},
                               {"detail", text},
                               {"instance", text}});
  schemas["problem"]["properties"]["errors"] = list(
      object({{"pointer", text}, {"got", text}, {"expected", text}, {"code", text}}));
}

}  // namespace

ordered_json openapi(const std::filesystem::path& folder) {
  ordered_json paths, schemas;
  const ordered_json page{{"text/html", {{"schema", {{"type", "string"}}}}}};
  for (const auto& row : requests()) {
    paths["/v1/" + row.name] =
        request_path(row, row.name, row.summary,
                     json_content(reference(component(result_schema(row)))));
    if (row.html)
      paths["/v1/" + row.name + "/report"] =
          request_path(row, row.name + "-report", "the same as a report to print", page);
    add_schema(schemas, folder, request_schema(row));
    add_schema(schemas, folder, result_schema(row));
  }
  const std::pair<const char*, std::vector<std::string>> listings[] = {
      {"materials", {"material"}},
      {"tools", {"tool", "fixed-tool", "milling-cutter"}},
      {"machines", {"lathe"}},
      {"shops", {"shop"}},
      {"parts", {"part"}}};
  for (const auto& [what, documents] : listings) {
    add_listing(paths, what, documents);
    for (const auto& schema : documents) add_schema(schemas, folder, schema + ".json");
  }
  add_batches(paths);
  const ordered_json text{{"text/plain", {{"schema", {{"type", "string"}}}}}};
  const auto none = ordered_json::array();
  paths["/healthz"] = get("health", "the process answers", text, none);
  paths["/readyz"] = get("ready", "calls are taken", text, none);
  paths["/metrics"] = get("metrics", "Prometheus text exposition", text, none);
  paths["/"] =
      get("page",
          "the planner's page; lang of its html element is the language of the program, "
          "which "
          "the page speaks",
          page,
          ordered_json::array(
              {{{"name", "language"},
                {"in", "query"},
                {"description", "what the page speaks instead; given once or not at all"},
                {"schema", {{"enum", kPageLanguages}}}}}));
  for (const char* open : {"/", "/healthz", "/readyz"})
    paths[open]["get"]["security"] = {ordered_json::object()};
  add_own_schemas(schemas);
  copy_members(schemas, ordered_json(schemas));
  return {{"openapi", "3.1.0"},
          {"info",
           {{"title", "Turnwright"},
            {"version", version()},
            {"summary", "Certified plans of turned parts."},
            {"license", {{"name", "Apache-2.0"}, {"identifier", "Apache-2.0"}}}}},
          {"servers", {{{"url", "/"}}}},
          {"security", {ordered_json::object(), {{"key", ordered_json::array()}}}},
          {"paths", std::move(paths)},
          {"components",
           {{"schemas", std::move(schemas)},
            {"securitySchemes", {{"key", {{"type", "http"}, {"scheme", "bearer"}}}}}}}};
}

}  // namespace turnwright::service
