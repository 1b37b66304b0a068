#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <optional>

#include "call_log.hpp"
#include "host.hpp"
#include "keys.hpp"
#include "service/log.hpp"
#include "state.hpp"
#include "target.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::service {
namespace {

using Parser = http::request_parser<http::string_body>;
using beast::error_code;
using Clock = std::chrono::steady_clock;

/// Cancels the socket's operation after a time.  (Beast's own timeouts close the socket,
/// so that no answer can be sent to the client.)
class Alarm {
 public:
  Alarm(tcp::socket& socket, std::chrono::milliseconds after)
      : timer_(socket.get_executor(), after) {
    timer_.async_wait([state = state_, &socket](error_code) {
      if (*state != State::set) return;
      *state = State::rang;
      socket.cancel();
    });
  }
  Alarm(const Alarm&) = delete;
  Alarm& operator=(const Alarm&) = delete;
  ~Alarm() {
    if (!rang()) *state_ = State::off;
  }
  bool rang() const { return *state_ == State::rang; }

 private:
  enum class State { set, rang, off };
  std::shared_ptr<State> state_ = std::make_shared<State>(State::set);
  asio::steady_timer timer_;
};

auto into(error_code& ec) { return asio::redirect_error(asio::use_awaitable, ec); }

std::string text(beast::string_view view) { return {view.data(), view.size()}; }

/// Date header's form (RFC 9110, 5.6.7), English in any locale.
std::string date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  static constexpr std::array kDays = {"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
  static constexpr std::array kMonths = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                         "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  return fmt::format("{}, {:02} {} {:04} {:02}:{:02}:{:02} GMT",
                     kDays[static_cast<std::size_t>(utc.tm_wday)], utc.tm_mday,
                     kMonths[static_cast<std::size_t>(utc.tm_mon)], utc.tm_year + 1900,
                     utc.tm_hour, utc.tm_min, utc.tm_sec);
}

bool is_request_id(beast::string_view id) {
  if (id.empty() || id.size() > 64) return false;
  return std::all_of(id.begin(), id.end(), is_of_name);
}

/// The call as far as its header determines it, with the caller's own id if it has one.
Call call_of(const Parser& parser, ServerState& state) {
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

asio::awaitable<bool> write(ServerState& state, Connection& connection, const Call& call,
                            Reply reply, bool keep_alive) {
  http::response<http::string_body> message;
  message.version(11);
  message.result(static_cast<unsigned>(reply.status));
  message.reason(
      beast::string_view(reason(reply.status).data(), reason(reply.status).size()));
  message.set(http::field::date, date());
  message.set("X-Request-Id", call.request_id);
  message.set("X-Content-Type-Options", "nosniff");
  if (!reply.content_type.empty())
    message.set(http::field::content_type, reply.content_type);
  for (const auto& [name, value] : reply.headers) message.set(name, value);
  message.keep_alive(keep_alive);
  if (reply.status != 204) message.content_length(reply.body.size());
  if (call.method != "HEAD") message.body() = std::move(reply.body);
  http::response_serializer<http::string_body> serializer(message);
  const Alarm alarm(connection.socket, state.options.writing);
  error_code ec;
  co_await http::async_write(connection.socket, serializer, into(ec));
  co_return !ec;
}

/// Lets the client read the last answer before the connection is reset: bytes that it
/// still sends are read and dropped for a limited time.
asio::awaitable<void> close(Connection& connection) {
  constexpr auto kPatience = std::chrono::seconds(2);
  constexpr std::size_t kDropped = 4'000'000;
  error_code ec;
  connection.socket.shutdown(tcp::socket::shutdown_send, ec);
  const Alarm alarm(connection.socket, kPatience);
  std::vector<char> sink(65'536);
  for (std::size_t dropped = 0; !ec && dropped < kDropped;)
    dropped += co_await connection.socket.async_read_some(asio::buffer(sink), into(ec));
  connection.socket.close(ec);
}

/// A call on its way through the pool.
struct Pending {
  explicit Pending(asio::io_context& io) : done(io) {}
  asio::steady_timer done;  ///< cancelled when the answer is ready or the client has gone
  std::optional<Reply> reply;
  std::stop_source stop;
  bool gone = false;  ///< the client left
};

/// The answer to a fault of this program, which must be possible without free memory.
Reply fault(const Call& call, const char* what) {
  try {
    log_fault(call, what);
    return problem(500, "fault", "a fault of this program; the log has more", call);
  } catch (const std::exception&) {
    return {500, "", "", {}};
  }
}

/// Does not throw, because nothing catches exceptions of the pool's threads.
Reply answer(const HttpApi& api, const Call& call, const std::stop_token& stop) {
  try {
    Reply reply = api.reply(call, stop);
    compress_for(call, reply);
    return reply;
  } catch (const Cancelled&) {
    return {};  // nobody reads it
  } catch (const std::exception& error) {
    return fault(call, error.what());
  }
}

void watch(tcp::socket& socket, const std::shared_ptr<Pending>& pending) {
  socket.async_wait(tcp::socket::wait_read,
                    [pending, fd = socket.native_handle()](error_code ec) {
                      char byte = 0;
                      if (ec || ::recv(fd, &byte, 1, MSG_PEEK | MSG_DONTWAIT) > 0) return;
                      pending->gone = true;
                      pending->stop.request_stop();
                      pending->done.cancel();
                    });
}

/// The answer from the pool; none if the client left.
asio::awaitable<std::optional<Reply>> computed(ServerState& state, Connection& connection,
                                               Call call) {
  auto pending = std::make_shared<Pending>(state.io);
  ++state.waiting;
  state.metrics.waiting.Increment();
  asio::post(state.pool, [&state, pending, call] {
    auto reply = answer(state.api, call, pending->stop.get_token());
    asio::post(state.io, [&state, pending, reply = std::move(reply)]() mutable {
      --state.waiting;
      state.metrics.waiting.Decrement();
      pending->reply = std::move(reply);
      pending->done.cancel();
    });
  });
  watch(connection.socket, pending);
  pending->done.expires_after(state.options.deadline);
  error_code ec;
  co_await pending->done.async_wait(into(ec));
  connection.socket.cancel(ec);
  if (pending->gone) co_return std::nullopt;
  if (pending->reply) co_return std::move(*pending->reply);
  pending->stop.request_stop();
  co_return problem(504, "deadline",
                    "not done within " + std::to_string(state.options.deadline.count()) +
                        " ms; send it as a batch",
                    call);
}

/// The answer to a call without its key, or to one that is not of the API.
std::optional<Reply> refused(const ServerState& state, const Call& call) {
  const auto path = call.path();
  const bool open = path == "/" || path == "/healthz" || path == "/readyz";
  if (!state.options.keys.empty() && !open &&
      !authorized(state.options.keys, call.authorization)) {
    Reply reply = problem(401, "key", "expected Authorization: Bearer and a key", call);
    reply.headers.emplace_back("WWW-Authenticate", "Bearer");
    return reply;
  }
  return state.api.at_once(call);
}

/// The answer to calls that need no computing and must be answered while the pool is
/// busy.
std::optional<Reply> at_once(const ServerState& state, const Call& call) {
  if (auto reply = refused(state, call)) return reply;
  const auto path = call.path();
  if (path == "/healthz") return state.api.reply(call, {});
  if (path == "/readyz")
    return state.full() || state.draining
               ? problem(503, "busy", "not ready for calls", call)
               : Reply{200, "text/plain; charset=utf-8", "ready\n", {}};
  if (path == "/metrics")
    return Reply{200, "text/plain; version=0.0.4", state.metrics.text(), {}};
  if (!state.full()) return std::nullopt;
  Reply reply = problem(503, "busy", "too many calls wait already", call);
  reply.headers.emplace_back("Retry-After", "1");
  return reply;
}

/// The refusal of an ambiguous request (RFC 9112, 3.2 and 6.1) or of one that a page of
/// another origin made a browser send; none for other requests.
std::optional<Reply> objection(const ServerState& state, const Parser& parser,
                               const Call& call) {
  const auto& message = parser.get();
  if (call.method == "CONNECT")  // the bytes that follow would be for another server
    return problem(501, "method", "CONNECT is not for this server", call);
  for (const auto field :
       {http::field::host, http::field::content_type, http::field::content_encoding,
        http::field::transfer_encoding, http::field::authorization, http::field::origin})
    if (message.count(field) > 1)
      return problem(400, "header", "expected one " + text(http::to_string(field)), call);
  const auto hosts = message.count(http::field::host);
  if (hosts == 0 && message.version() >= 11)
    return problem(400, "host", "expected one Host", call);
  for (const auto& host : {text(message[http::field::host]), call.host})
    if (!is_host(host))
      return problem(400, "host", "got '" + host + "', expected a host", call);
  const auto coding = text(message[http::field::transfer_encoding]);
  if (!coding.empty() && (!beast::iequals(coding, "chunked") || message.version() < 11))
    return problem(501, "transfer-coding",
                   "got '" + coding + "', expected chunked or none", call);
  const auto encoding = text(message[http::field::content_encoding]);
  if (!encoding.empty() && !beast::iequals(encoding, "identity"))
    return problem(415, "content-coding", "got '" + encoding + "', expected none", call);
  if (!state.options.keys.empty())
    return std::nullopt;  // no browser sends a key by itself
  const auto origin = text(message[http::field::origin]);
  if (!origin.empty() && !origin_is(origin, call.host))
    return problem(403, "origin", "pages of " + origin + " may not ask here", call);
  if (!call.host.empty() && !is_local(call.host))
    return problem(421, "host",
                   "got Host '" + call.host +
                       "', expected an address or a name without a dot; others need "
                       "keys (--keys)",
                   call);
  return std::nullopt;
}

/// The answer to a call that could not be read; none if the client has gone.
std::optional<Reply> refusal(const error_code& ec, const Call& call) {
  const auto megabytes = HttpApi::body_limit(call) / 1'000'000;
  if (ec == beast::error::timeout)
    return problem(408, "timeout", "the request did not arrive in time", call);
  if (ec == http::error::header_limit || ec == http::error::buffer_overflow)
    return call.target.empty()
               ? problem(414, "target", "the request line is too long", call)
               : problem(431, "header", "the header is too long", call);
  if (ec == http::error::body_limit)
    return problem(413, "body", "expected at most " + std::to_string(megabytes) + " MB",
                   call);
  if (ec.category() == http::make_error_code(http::error::bad_version).category() &&
      ec != http::error::end_of_stream && ec != http::error::partial_message)
    return problem(400, "no-http", ec.message(), call);
  return std::nullopt;
}

/// Reads the rest of a call whose header has been read.
asio::awaitable<error_code> read_call_body(const ServerState& state,
                                           Connection& connection, Parser& parser,
                                           Call& call) {
  error_code ec;
  parser.body_limit(HttpApi::body_limit(call));
  const Alarm alarm(connection.socket, state.options.body);
  if (parser.get().version() >= 11 &&
      beast::iequals(parser.get()[http::field::expect], "100-continue")) {
    constexpr char kGo[] = "HTTP/1.1 100 Continue\r\n\r\n";
    co_await asio::async_write(connection.socket, asio::buffer(kGo, sizeof kGo - 1),
                               into(ec));
    if (ec) co_return ec;
  }
  co_await http::async_read(connection.socket, connection.buffer, parser, into(ec));
  call.body = std::move(parser.get().body());
  co_return alarm.rang() ? error_code(beast::error::timeout) : ec;
}

asio::awaitable<error_code> read_call_header(const ServerState& state,
                                             Connection& connection, Parser& parser) {
  parser.header_limit(static_cast<std::uint32_t>(state.options.header_bytes));
  parser.body_limit(HttpApi::body_limit({"POST", "/v1/batches", {}, {}, {}, {}, {}}));
  const Alarm alarm(connection.socket, state.options.header);
  error_code ec;
  co_await http::async_read_header(connection.socket, connection.buffer, parser,
                                   into(ec));
  co_return alarm.rang() ? error_code(beast::error::timeout) : ec;
}

/// Answers a refused call without reading a large body.  Only its header has been read,
/// so a client without a key cannot fill the memory.
std::optional<Reply> refused_unread(const ServerState& state, const Parser& parser,
                                    const Call& call) {
  constexpr std::uint64_t kReadAnyway = 65'536;  // keeps the connection for more calls
  const auto length = parser.content_length();
  const bool expects = parser.get().count(http::field::expect) > 0;
  if (parser.is_done() || (length && *length <= kReadAnyway && !expects))
    return std::nullopt;
  return refused(state, call);
}

/// Whether a byte of another call has arrived.
bool has_arrived(const Connection& connection) {
  error_code ec;
  return connection.buffer.size() > 0 || connection.socket.available(ec) > 0;
}

/// One call.  @return whether the connection may carry another.
asio::awaitable<bool> serve_call(ServerState& state, Connection& connection) {
  Parser parser;
  error_code ec = co_await read_call_header(state, connection, parser);
  Call call = call_of(parser, state);
  std::optional<Reply> reply;
  if (!ec && parser.content_length() &&
      *parser.content_length() > HttpApi::body_limit(call))
    ec = http::make_error_code(http::error::body_limit);
  if (!ec && !(reply = objection(state, parser, call)))
    reply = refused_unread(state, parser, call);
  const bool taken = !ec && !reply;
  if (taken) ec = co_await read_call_body(state, connection, parser, call);
  const auto arrived = Clock::now();
  if (ec)
    reply = refusal(ec, call);
  else if (taken && !(reply = at_once(state, call)))
    reply = co_await computed(state, connection, call);
  // A client of HTTP/1.0 would need a header that allows it to send more.
  const bool keep_alive = taken && !ec && parser.get().version() >= 11 &&
                          parser.get().keep_alive() &&
                          (!state.draining || has_arrived(connection));
  const int status = reply ? reply->status : 499;
  const std::size_t bytes = reply ? reply->body.size() : 0;
  if (ec && !reply) co_return false;
  bool written = false;
  if (reply)
    written = co_await write(state, connection, call, std::move(*reply), keep_alive);
  const std::chrono::duration<double> took = Clock::now() - arrived;
  state.metrics.answered(state.api.route(call), status, took.count());
  log_call(call, status, bytes, took.count());
  const bool again = written && keep_alive;
  if (written && !again) co_await close(connection);
  co_return again;
}

/// Drops empty lines before a call (RFC 9112, 2.2).  @return whether a byte of it is
/// there.
bool has_begun(beast::flat_buffer& buffer) {
  const auto seen = [&buffer] {
    return std::string_view(static_cast<const char*>(buffer.data().data()),
                            buffer.size());
  };
  while (seen().starts_with("\r\n")) buffer.consume(2);
  return !seen().empty() && seen() != "\r";
}

/// Whether a byte of another call is there, or comes in time.
asio::awaitable<bool> next_call(const ServerState& state, Connection& connection) {
  const Alarm alarm(connection.socket, state.options.idle);
  error_code ec;
  while (!has_begun(connection.buffer) && !state.draining && !ec && !alarm.rang()) {
    connection.idle = true;
    const auto bytes = co_await connection.socket.async_read_some(
        connection.buffer.prepare(4096), into(ec));
    connection.idle = false;
    connection.buffer.commit(bytes);
  }
  co_return has_begun(connection.buffer) || (state.draining && has_arrived(connection));
}

/// A connection among those of the server, as long as it lives.
class Listed {
 public:
  Listed(ServerState& state, Connection& connection)
      : state_(state), connection_(connection) {
    state_.connections.insert(&connection_);
    state_.metrics.connections.Increment();
  }
  Listed(const Listed&) = delete;
  Listed& operator=(const Listed&) = delete;
  ~Listed() {
    state_.connections.erase(&connection_);
    state_.metrics.connections.Decrement();
    if (state_.draining && state_.connections.empty()) state_.drain.cancel();
  }

 private:
  ServerState& state_;
  Connection& connection_;
};

}  // namespace

asio::awaitable<void> serve(ServerState& state, tcp::socket socket) {
  Connection connection(std::move(socket));
  const Listed listed(state, connection);
  error_code ec;
  connection.socket.set_option(tcp::no_delay(true), ec);
  try {
    bool more = true;
    while (more) {
      more = co_await next_call(state, connection);
      if (more) more = co_await serve_call(state, connection);
    }
  } catch (const std::exception& error) {
    log_event("connection lost", error.what());
  }
}

asio::awaitable<void> turn_away(ServerState& state, tcp::socket socket) {
  Connection connection(std::move(socket));
  const Call nobody;
  Reply reply = problem(503, "busy", "too many connections", nobody);
  reply.headers.emplace_back("Retry-After", "1");
  if (co_await write(state, connection, nobody, std::move(reply), false))
    co_await close(connection);
}

}  // namespace turnwright::service
