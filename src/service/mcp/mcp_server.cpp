#include "mcp_server.hpp"

#include <atomic>
#include <utility>

#include "base/say.hpp"
#include "document/json/parse.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::service::mcp {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// Requests a stop when the time is over.
class Deadline {
 public:
  Deadline(std::stop_source work, std::chrono::milliseconds after)
      : watch_([this, work, after](const std::stop_token& done) mutable {
          std::mutex own;
          std::unique_lock lock(own);
          std::condition_variable_any never;
          never.wait_for(lock, done, after, [] { return false; });
          if (done.stop_requested()) return;
          passed_ = true;
          work.request_stop();
        }) {}
  bool passed() const { return passed_; }

 private:
  std::atomic<bool> passed_ = false;
  std::jthread watch_;
};

bool is_id(const json& id) { return id.is_string() || id.is_number_integer(); }

/// A member of an object; null where it is absent.
json member(const json& object, const char* key) { return object.value(key, json()); }

}  // namespace

Server::Server(const std::filesystem::path& folder, const document::Catalogue& catalogue,
               Send send, Limits limits)
    : catalogue_(catalogue),
      send_(std::move(send)),
      limits_(limits),
      resources_(folder),
      worker_([this] { work(); }) {}

Server::~Server() {
  {
    const std::lock_guard lock(calling_);
    closed_ = true;
  }
  changed_.notify_all();
  worker_.join();
}

void Server::send(const ordered_json& message) {
  const std::lock_guard lock(sending_);
  send_(message);
}

void Server::refuse(const json& id) {
  send(error(
      id, Fault::invalid_request,
      tr("expected one object with \"jsonrpc\": \"2.0\", a method, params that are an "
         "object, and an id (text or an integer) or none")));
}

void Server::receive(std::string_view line) {
  json message;
  try {
    message = document::parse(line, tr("message"));
  } catch (const InputError& e) {
    return send(error(nullptr, Fault::parse, e.what()));
  }
  if (!message.is_object()) return refuse(nullptr);
  const json id = member(message, "id"), method = member(message, "method"),
             parameters = message.value("params", json::object());
  if (is_id(id) && !message.contains("method") &&
      (message.contains("result") || message.contains("error")))
    return;  // an answer, though nothing was asked
  if (!method.is_string() || member(message, "jsonrpc") != "2.0" ||
      (message.contains("id") && !is_id(id)) || !parameters.is_object())
    return refuse(is_id(id) ? id : json());
  if (message.contains("id"))
    answer_request(id, method, parameters);
  else if (method == "notifications/cancelled")
    cancel(parameters);
}

void Server::answer_request(const json& id, const std::string& method,
                            const json& parameters) {
  if (method == "initialize") return send(response(id, welcome(parameters)));
  if (method == "ping") return send(response(id, ordered_json::object()));
  if (method == "tools/list") return send(response(id, tools()));
  if (method == "tools/call") return take_call(id, parameters);
  if (method == "resources/list") return send(response(id, resources_.list()));
  if (method == "resources/templates/list")
    return send(response(id, {{"resourceTemplates", ordered_json::array()}}));
  if (method == "resources/read") {
    const auto uri = member(parameters, "uri");
    if (!uri.is_string())
      return send(error(id, Fault::invalid_parameters, tr("uri: expected text")));
    const auto found = resources_.read(uri);
    return send(found ? response(id, *found)
                      : error(id, Fault::unknown_resource,
                              say("no resource {}; resources/list has all of them",
                                  uri.get<std::string>())));
  }
  send(error(id, Fault::unknown_method, say("no method {}", method)));
}

void Server::take_call(const json& id, const json& parameters) {
  const auto name = member(parameters, "name");
  const auto* row = name.is_string() ? find_request(name.get<std::string>()) : nullptr;
  if (!row)
    return send(error(id, Fault::invalid_parameters,
                      say("name: got {}, expected a tool of tools/list", name.dump())));
  const auto about = member(parameters, "_meta");
  Call call{row,
            id,
            parameters.value("arguments", json::object()),
            about.is_object() ? member(about, "progressToken") : json(),
            {}};
  const std::unique_lock lock(calling_);
  if (calls_.size() > limits_.waiting)
    return send(
        error(id, Fault::busy, say("{} calls wait; call again later", calls_.size())));
  calls_.push_back(std::move(call));
  changed_.notify_all();
}

void Server::cancel(const json& parameters) {
  const std::lock_guard lock(calling_);
  for (auto& call : calls_)
    if (call.id == member(parameters, "requestId")) call.stop.request_stop();
}

void Server::work() {
  for (;;) {
    std::unique_lock lock(calling_);
    changed_.wait(lock, [this] { return closed_ || !calls_.empty(); });
    if (calls_.empty()) return;
    const Call& call = calls_.front();  // stays where it is when more are added
    lock.unlock();
    if (const auto answer = answered(call)) send(*answer);
    lock.lock();
    calls_.pop_front();
  }
}

std::optional<ordered_json> Server::answered(const Call& call) {
  const auto fails = [&](const std::string& why) {
    return response(call.id, tool_failure(why));
  };
  const Deadline deadline(call.stop, limits_.deadline);
  const auto tell = [&](std::size_t done, std::size_t all) {
    if (!call.progress.is_null())
      send({{"jsonrpc", "2.0"},
            {"method", "notifications/progress"},
            {"params",
             {{"progressToken", call.progress}, {"progress", done}, {"total", all}}}});
  };
  try {
    auto result =
        answer(*call.row, call.arguments, {catalogue_, call.stop.get_token(), tell});
    if (call.stop.stop_requested() && !deadline.passed()) return std::nullopt;
    return response(call.id, tool_result(*call.row, std::move(result)));
  } catch (const InputError& e) {
    return fails(e.what());
  } catch (const ModelRangeError& e) {
    return fails(visible(e.what()));
  } catch (const Cancelled&) {
    if (!deadline.passed()) return std::nullopt;
    return fails(say("not done within {} ms", limits_.deadline.count()));
  } catch (const std::exception& e) {
    return error(call.id, Fault::internal, visible(e.what()));
  }
}

}  // namespace turnwright::service::mcp
