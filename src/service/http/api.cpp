#include "api.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <functional>

#include "base/say.hpp"
#include "document/json/parse.hpp"
#include "openapi.hpp"
#include "page.hpp"
#include "service/batch/spool.hpp"
#include "service/documents.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::service {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kDocumentBytes = document::ParseLimits{}.bytes;
constexpr std::size_t kBatchBytes = 256'000'000;
constexpr const char* kReportPolicy =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; sandbox";
constexpr std::size_t kResultBytes = 8'000'000;  // of one page of a batch's results

std::string text_of(const ordered_json& document) { return document.dump(2) + '\n'; }

std::vector<std::string_view> segments(std::string_view path) {
  std::vector<std::string_view> out;
  while (!path.empty()) {
    path.remove_prefix(1);  // the slash
    const auto end = std::min(path.find('/'), path.size());
    out.push_back(path.substr(0, end));
    path.remove_prefix(end);
  }
  return out;
}

std::optional<std::int64_t> number(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 1)
    return std::nullopt;
  return value;
}

Reply wrong_type(const Call& call, const std::string& wanted) {
  return problem(
      415, "media-type",
      say("got Content-Type '{}', expected {} (UTF-8)", call.content_type, wanted), call);
}

ordered_json to_json(const Job& job) {
  return {{"id", job.id},
          {"state", job.state},
          {"lines", job.lines},
          {"done", job.done},
          {"errors", job.errors}};
}

Reply answer_with_result(const Request& row, const nlohmann::json& request,
                         const Context& context) {
  return {200, "application/json", text_of(answer(row, request, context)), {}};
}

Reply answer_with_report(const Request& row, const nlohmann::json& request,
                         const Context& context) {
  const auto report = html_report(row, request, drawn_answer(row, request, context));
  Reply reply{200, "text/html; charset=utf-8", report, {}};
  reply.headers.emplace_back("Content-Security-Policy", kReportPolicy);
  return reply;
}

using Answer = Reply (*)(const Request& row, const nlohmann::json& request,
                         const Context& context);

Reply answer_request(const Request& row, Answer answer, const Call& call,
                     const Context& context) {
  if (!is_type(call.content_type, "application/json"))
    return wrong_type(call, "application/json");
  nlohmann::json request;
  try {
    request = document::parse(call.body, row.name);
  } catch (const InputError& error) {
    return problem(400, "no-json", tr("the body is not a JSON document"), call,
                   error.problems());
  }
  try {
    return answer(row, request, context);
  } catch (const InputError& error) {
    const auto count = error.problems().size();
    return problem(422, "wrong-input",
                   count == 1 ? tr("the document has a problem")
                              : say("the document has {} problems", count),
                   call, error.problems());
  } catch (const ModelRangeError& error) {
    return problem(422, "model-range", error.what(), call);
  }
}

}  // namespace

/// The value of each {..} of the route in the path.
using Arguments = std::vector<std::string_view>;

struct HttpApi::Route {
  std::string path;
  std::string method;
  std::function<Reply(const HttpApi&, const Call&, const Arguments&, std::stop_token)>
      reply;
  std::string parameter = {};            ///< of the query; "": no query is allowed
  std::vector<std::string> values = {};  ///< of the parameter; none: an integer >= 1

  /// The arguments, if the path is of this route.
  std::optional<Arguments> match(const std::vector<std::string_view>& given) const {
    const auto own = segments(path);
    if (own.size() != given.size()) return std::nullopt;
    Arguments arguments;
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (own[i].starts_with('{'))
        arguments.push_back(given[i]);
      else if (own[i] != given[i])
        return std::nullopt;
    }
    return arguments;
  }
};

namespace {

Reply plain(std::string text) { return {200, "text/plain; charset=utf-8", text, {}}; }

Reply missing(const Call& call) {
  return problem(404, "not-found", say("nothing is at {}", call.path()), call);
}

/// The route of a path.
std::string method_of(const Call& call) {
  return call.method == "HEAD" ? "GET" : call.method;
}

Reply methods(const std::string& allowed) {
  return {204, "", "", {{"Allow", allowed + ", OPTIONS"}}};
}

/// The errors of a call's query, in which `parameter` may appear once, with one of its
/// values or, where there are none, an integer >= 1.
std::optional<Reply> wrong_query(const std::string& parameter,
                                 const std::vector<std::string>& values,
                                 const Call& call) {
  std::vector<Problem> wrong;
  bool given = false;
  for (const auto& [name, value] : call.query()) {
    const auto add = [&wrong, n = std::string(name),
                      got = '"' + std::string(value) + '"'](const std::string& expected,
                                                            const char* code) {
      wrong.push_back({n, got, expected, code});
    };
    if (name != parameter)
      add(tr("no such parameter"), "unknown-key");
    else if (std::exchange(given, true))
      add(tr("the parameter once"), "duplicate");
    else if (!values.empty() && std::ranges::find(values, value) == values.end())
      add(fmt::format("{}", fmt::join(values, ", ")), "choice");
    else if (values.empty() && !number(value))
      add(tr("an integer >= 1"), "range");
  }
  if (wrong.empty()) return std::nullopt;
  std::string names;
  for (const auto& problem : wrong)
    names += (names.empty() ? "" : ", ") + problem.pointer;
  return problem(400, "query", say("wrong in the query: {}", names), call, wrong);
}

Reply job_reply(Batches& batches, std::int64_t id, const Call& call) {
  const auto job = batches.store().job(id);
  if (!job) return missing(call);
  return {200, "application/json", text_of(to_json(*job)), {}};
}

std::optional<std::int64_t> stored(JobStore& store, const Call& call,
                                   const std::stop_token& stop) {
  if (!call.lines) return store.submit(call.body, stop);
  auto lines = call.lines->lines();
  return store.submit([&lines](std::string& line) { return lines.next(line); }, stop);
}

Reply submit(Batches& batches, const Call& call, const std::stop_token& stop) {
  if (!is_type(call.content_type, "application/jsonl"))
    return wrong_type(call, "application/jsonl");
  const auto id = stored(batches.store(), call, stop);
  if (!id)
    return problem(413, "lines", say("expected at most {} lines", JobStore::kMostLines),
                   call);
  batches.wake();
  Reply reply = job_reply(batches, *id, call);
  reply.status = 202;
  reply.headers.emplace_back("Location", fmt::format("/v1/batches/{}", *id));
  return reply;
}

Reply list_jobs(Batches& batches) {
  auto list = ordered_json::array();
  for (const auto& job : batches.store().jobs()) list.push_back(to_json(job));
  return {200, "application/json", text_of(list), {}};
}

Reply results(Batches& batches, std::int64_t id, const Call& call) {
  if (!batches.store().job(id)) return missing(call);
  const auto query = call.query();  // known to be right
  const auto from = query.empty() ? 1 : number(query[0].second);
  auto page = batches.store().results(id, *from, kResultBytes);
  Reply reply{200, "application/jsonl", std::move(page.jsonl), {}};
  reply.headers.emplace_back(
      "Link",
      fmt::format("</v1/batches/{}/results?from={}>; rel=\"next\"", id, page.next));
  return reply;
}

}  // namespace

const std::vector<HttpApi::Route>& HttpApi::routes() {
  using Stop = std::stop_token;
  // A route of batches: with the job's number, where the path has one.
  const auto of_batches = [](auto reply) {
    return
        [reply](const HttpApi& api, const Call& call, const Arguments& arguments, Stop) {
          const auto id = arguments.empty() ? 0 : number(arguments[0]);
          return api.batches_ && id ? reply(*api.batches_, *id, call) : missing(call);
        };
  };
  static const std::vector<Route> kRoutes = [&] {
    std::vector<Route> all;
    const auto add = [&](const Request& row, const std::string& path, Answer answer) {
      all.push_back(
          {path, "POST",
           [&row, answer](const HttpApi& api, const Call& call, const Arguments&,
                          Stop stop) {
             return answer_request(row, answer, call, {api.catalogue_, std::move(stop)});
           }});
    };
    for (const auto& row : requests()) {
      add(row, "/v1/" + row.name, answer_with_result);
      if (row.html) add(row, "/v1/" + row.name + "/report", answer_with_report);
    }
    for (const char* what : {"materials", "tools", "machines", "shops", "parts"}) {
      const std::string path = std::string("/v1/") + what;
      all.push_back(
          {path, "GET",
           [what](const HttpApi& api, const Call&, const Arguments&, Stop) -> Reply {
             return {200, "application/json", api.listings_.at(what).index, {}};
           }});
      all.push_back({path + "/{id}", "GET",
                     [what](const HttpApi& api, const Call& call, const Arguments& id,
                            Stop) -> Reply {
                       const auto& documents = api.listings_.at(what).documents;
                       const auto found = documents.find(std::string(id[0]));
                       if (found == documents.end()) return missing(call);
                       return {200, "application/json", found->second, {}};
                     }});
    }
    all.push_back({"/v1/batches", "POST",
                   [](const HttpApi& api, const Call& call, const Arguments&, Stop stop) {
                     return api.batches_ ? submit(*api.batches_, call, stop)
                                         : missing(call);
                   }});
    all.push_back(
        {"/v1/batches", "GET",
         of_batches([](Batches& b, std::int64_t, const Call&) { return list_jobs(b); })});
    all.push_back({"/v1/batches/{id}", "GET", of_batches(job_reply)});
    all.push_back({"/v1/batches/{id}", "DELETE",
                   of_batches([](Batches& b, std::int64_t id, const Call& call) -> Reply {
                     if (!b.remove(id)) return missing(call);
                     return {204, "", "", {}};
                   })});
    all.push_back({"/v1/batches/{id}/cancel", "POST",
                   of_batches([](Batches& b, std::int64_t id, const Call& call) {
                     b.cancel(id);
                     return job_reply(b, id, call);
                   })});
    all.push_back({"/v1/batches/{id}/results", "GET", of_batches(results), "from"});
    all.push_back(
        {"/healthz", "GET", [](const HttpApi&, const Call&, const Arguments&, Stop) {
           return plain("ok\n");
         }});
    for (const char* own : {"/readyz", "/metrics"})
      all.push_back(
          {own, "GET", [](const HttpApi&, const Call& call, const Arguments&, Stop) {
             return missing(call);
           }});
    all.push_back({"/", "GET",
                   [](const HttpApi& api, const Call&, const Arguments&, Stop) {
                     return page_reply(api.page_());
                   },
                   "language", kPageLanguages});
    all.push_back({"/openapi.json", "GET",
                   [](const HttpApi& api, const Call&, const Arguments&, Stop) -> Reply {
                     return {200, "application/json", api.openapi_, {}};
                   }});
    return all;
  }();
  return kRoutes;
}

HttpApi::HttpApi(const std::filesystem::path& folder,
                 const document::Catalogue& catalogue, Batches* batches, Page page)
    : catalogue_(catalogue),
      batches_(batches),
      page_(std::move(page)),
      openapi_(text_of(openapi(folder))) {
  for (auto& [what, documents] : read_documents(folder)) {
    auto index = ordered_json::array();
    for (const auto& [id, name] : documents.names)
      index.push_back({{"id", id}, {"name", name}});
    listings_[what] = {text_of(index), std::move(documents.texts)};
  }
}

std::shared_ptr<Spool> HttpApi::spool(const Call& call) const {
  const bool batch = call.method == "POST" && call.path() == "/v1/batches";
  return batches_ && batch ? batches_->store().spool() : nullptr;
}

std::size_t HttpApi::body_limit(const Call& call) {
  return call.path() == "/v1/batches" ? kBatchBytes : kDocumentBytes;
}

std::string HttpApi::route(const Call& call) const {
  const auto given = segments(call.path());
  for (const auto& route : routes())
    if (route.match(given)) return route.path;
  return "other";
}

std::optional<Reply> HttpApi::at_once(const Call& call) const {
  const auto known = {"GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS"};
  if (std::find(known.begin(), known.end(), call.method) == known.end())
    return problem(501, "method", say("{} is not for this server", call.method), call);
  if (call.method == "OPTIONS" && call.target == "*")
    return methods("GET, HEAD, POST, DELETE");
  if (!call.target.starts_with('/'))
    return problem(400, "target", say("got '{}', expected a path", call.target), call);
  const auto given = segments(call.path());
  std::string allowed;
  for (const auto& route : routes()) {
    if (!route.match(given)) continue;
    if (route.method == method_of(call))
      return wrong_query(route.parameter, route.values, call);
    allowed += (allowed.empty() ? "" : ", ") + route.method;
    if (route.method == "GET") allowed += ", HEAD";
  }
  if (allowed.empty()) return missing(call);
  auto reply = methods(allowed);
  if (call.method == "OPTIONS") return reply;
  auto headers = std::move(reply.headers);
  reply = problem(405, "method",
                  say("{} is not for this path, only {}", call.method, headers[0].second),
                  call);
  reply.headers = std::move(headers);
  return reply;
}

Reply HttpApi::reply(const Call& call, std::stop_token stop) const {
  if (auto reply = at_once(call)) return std::move(*reply);
  const auto given = segments(call.path());
  for (const auto& route : routes())
    if (const auto arguments = route.match(given);
        arguments && route.method == method_of(call))
      return route.reply(*this, call, *arguments, stop);
  return missing(call);
}

}  // namespace turnwright::service
