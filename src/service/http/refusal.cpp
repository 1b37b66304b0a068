#include "refusal.hpp"

#include <algorithm>
#include <iterator>

#include "base/say.hpp"
#include "host.hpp"
#include "keys.hpp"
#include "target.hpp"

namespace turnwright::service {
namespace {

constexpr int kMostFields = 100;  // a field takes more memory than its bytes

std::string text(beast::string_view view) { return {view.data(), view.size()}; }

bool is_request_id(beast::string_view id) {
  if (id.empty() || id.size() > 64) return false;
  return std::all_of(id.begin(), id.end(), is_of_name);
}

/// The answer to a call without its key, or to one that is not of the API.
std::optional<Reply> refused(const ServerState& state, const Call& call) {
  const auto path = call.path();
  const bool open = path == "/" || path == "/healthz" || path == "/readyz";
  if (!state.options.keys.empty() && !open &&
      !authorized(state.options.keys, call.authorization)) {
    Reply reply =
        problem(401, "key", tr("expected Authorization: Bearer and a key"), call);
    reply.headers.emplace_back("WWW-Authenticate", "Bearer");
    return reply;
  }
  return state.api.at_once(call);
}

}  // namespace

Call call_of(const HeaderParser& parser, ServerState& state) {
  const auto& message = parser.get();
  const auto id = message["X-Request-Id"];
  auto target = read_target(text(message.method_string()), text(message.target()));
  return {text(message.method_string()),
          std::move(target.path),
          text(message[http::field::content_type]),
          text(message[http::field::accept_encoding]),
          text(message[http::field::authorization]),
          is_request_id(id) ? text(id) : state.name + '-' + std::to_string(++state.calls),
          {},
          target.host.empty() ? text(message[http::field::host]) : target.host};
}

std::optional<Reply> objection(const ServerState& state, const HeaderParser& parser,
                               const Call& call) {
  const auto& message = parser.get();
  if (call.method == "CONNECT")  // the bytes that follow would be for another server
    return problem(501, "method", tr("CONNECT is not for this server"), call);
  if (std::distance(message.begin(), message.end()) > kMostFields)
    return problem(431, "header", say("expected at most {} fields", kMostFields), call);
  for (const auto field :
       {http::field::host, http::field::content_type, http::field::content_encoding,
        http::field::transfer_encoding, http::field::authorization, http::field::origin})
    if (message.count(field) > 1)
      return problem(400, "header", say("expected one {}", text(http::to_string(field))),
                     call);
  const auto hosts = message.count(http::field::host);
  if (hosts == 0 && message.version() >= 11)
    return problem(400, "host", tr("expected one Host"), call);
  for (const auto& host : {text(message[http::field::host]), call.host})
    if (!is_host(host))
      return problem(400, "host", say("got '{}', expected a host", host), call);
  const auto coding = text(message[http::field::transfer_encoding]);
  if (!coding.empty() && (!beast::iequals(coding, "chunked") || message.version() < 11))
    return problem(501, "transfer-coding",
                   say("got '{}', expected chunked or none", coding), call);
  const auto encoding = text(message[http::field::content_encoding]);
  if (!encoding.empty() && !beast::iequals(encoding, "identity"))
    return problem(415, "content-coding", say("got '{}', expected none", encoding), call);
  if (!state.options.keys.empty())
    return std::nullopt;  // no browser sends a key by itself
  const auto origin = text(message[http::field::origin]);
  if (!origin.empty() && !origin_is(origin, call.host))
    return problem(403, "origin", say("pages of {} may not ask here", origin), call);
  if (!call.host.empty() && !is_local(call.host))
    return problem(421, "host",
                   say("got Host '{}', expected an address or a name without a dot; "
                       "others need keys "
                       "(--keys)",
                       call.host),
                   call);
  return std::nullopt;
}

std::optional<Reply> refused_unread(const ServerState& state, const HeaderParser& parser,
                                    const Call& call) {
  constexpr std::uint64_t kReadAnyway = 65'536;  // keeps the connection for more calls
  const auto length = parser.content_length();
  const bool expects = parser.get().count(http::field::expect) > 0;
  if (parser.is_done() || (length && *length <= kReadAnyway && !expects))
    return std::nullopt;
  return refused(state, call);
}

std::optional<Reply> refusal(const beast::error_code& ec, const Call& call) {
  const auto megabytes = HttpApi::body_limit(call) / 1'000'000;
  if (ec == beast::error::timeout)
    return problem(408, "timeout", tr("the request did not arrive in time"), call);
  if (ec == http::error::header_limit)
    return call.target.empty()
               ? problem(414, "target", tr("the request line is too long"), call)
               : problem(431, "header", tr("the header is too long"), call);
  if (ec == http::error::body_limit)
    return problem(413, "body", say("expected at most {} MB", megabytes), call);
  if (ec == boost::system::errc::not_enough_memory)
    return busy(to_translate(
                    "the bodies of other calls fill the memory for them (--body-memory)"),
                call);
  if (ec == boost::system::errc::no_space_on_device)
    return busy(to_translate("no room to keep the lines of another batch"), call);
  if (ec.category() == http::make_error_code(http::error::bad_version).category() &&
      ec != http::error::end_of_stream && ec != http::error::partial_message)
    return problem(400, "no-http", ec.message(), call);
  return std::nullopt;
}

std::optional<Reply> at_once(const ServerState& state, const Call& call) {
  if (auto reply = refused(state, call)) return reply;
  const auto path = call.path();
  if (path == "/healthz") return state.api.reply(call, {});
  if (path == "/readyz")
    return state.full() || state.draining
               ? problem(503, "busy", tr("not ready for calls"), call)
               : Reply{200, "text/plain; charset=utf-8", "ready\n", {}};
  if (path == "/metrics") {
    state.metrics.held_bytes.Set(static_cast<double>(state.memory.used()));
    return Reply{200, "text/plain; version=0.0.4", state.metrics.text(), {}};
  }
  if (!state.full()) return std::nullopt;
  return busy(to_translate("too many calls wait already"), call);
}

Reply busy(const char* detail, const Call& call) {
  Reply reply = problem(503, "busy", tr(detail), call);
  reply.headers.emplace_back("Retry-After", "1");
  return reply;
}

}  // namespace turnwright::service
